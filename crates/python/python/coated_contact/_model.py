"""The model of measured contacts: predictions, synthetic data, and the errors of planned ones."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._arrays import integer, number
from ._columns import Array
from ._experiment import Experiment, Free, ParameterName, listed, one_of, unit_of
from ._fit import Allowed, allowed_of, experiments_of, free_of, told_apart
from ._fit_results import (
    Forecast,
    correlation_of,
    estimates_of,
    fixed_values_of,
    name_of,
    warnings_of,
)
from ._indentation import Indentation
from ._table import Table, native_table
from ._values import OneLine

if TYPE_CHECKING:
    import pandas

BranchName = Literal["advancing", "receding", "pinned", "baseline", "left-out"]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Prediction(OneLine):
    """The ordinates that the values of an experiment give at its points.

    Attributes
    ----------
    ordinate : numpy.ndarray
        Loads or forces, N, or penetrations, m; NaN for a point that is left out.
    contact_radius : numpy.ndarray
        Contact radii, m; 0 without a contact, NaN for a point that is left out.
    branch : list of str
        ``"advancing"``, ``"receding"``, ``"pinned"``, ``"baseline"`` or ``"left-out"``. A point is
        pinned where the line rests after the turn, as the model has it.
    beyond : numpy.ndarray
        Whether a point is in contact according to its branch, but beyond the end of the stable
        states. There a straight line continues the branch, so that a sum of squares has no jump.
    derivatives : dict of str to numpy.ndarray
        The derivatives of the ordinates at a fixed abscissa, in SI units, by parameter.
    """

    ordinate: Array
    contact_radius: Array
    branch: list[str]
    beyond: NDArray[np.bool_]
    derivatives: dict[str, Array]

    def to_pandas(self) -> pandas.DataFrame:
        """Return a row for each point; a derivative is called ``by_film_modulus``; needs pandas."""
        import pandas

        names = ("ordinate", "contact_radius", "branch", "beyond")
        columns = {name: getattr(self, name) for name in names}
        by = {f"by_{name}": column for name, column in self.derivatives.items()}
        return pandas.DataFrame(columns | by)


def branches(experiment: Experiment, free: Iterable[ParameterName] = ()) -> list[str]:
    """Read from the data on which branch each point is, as :func:`fit` does.

    Against penetrations or heights, points before the jump to the baseline are in contact, those
    after it are on the baseline. A model that jumps within the residual has wrong optima, so the
    branches are fixed before a fit.

    Parameters
    ----------
    experiment : Experiment
        The measurement.
    free : iterable of str
        The parameters that will be fitted. A free offset or baseline leaves the level of the
        baseline to the data.

    Returns
    -------
    list of str
        ``"advancing"``, ``"receding"``, ``"pinned"``, ``"baseline"`` or ``"left-out"``.
    """
    experiments_of([experiment])
    return _core.branches(experiment, _names("free", free))


def predict(
    experiment: Experiment,
    by: Iterable[ParameterName] = (),
    *,
    branches: Sequence[BranchName | str] | None = None,
    table: Table | None = None,
) -> Prediction:
    """Return the ordinates that the values of an experiment give, with derivatives.

    The derivatives are exact. On a stack, of contact stiffnesses and beyond the nodes of the table
    in ``a/t`` they are central differences, on a stack with errors of at most 1e-5 of the largest.

    This is the function that :func:`fit` fits, for other methods: least squares of scipy, samplers.

    Parameters
    ----------
    experiment : Experiment
        Where is measured, and the values of all parameters. Its ordinates are not used, but of the
        kind ``"stiffness-depth"`` measured stiffnesses are needed: they tell the contact depth.
    by : iterable of str
        The parameters whose derivatives are wanted.
    branches : sequence of str, optional
        The branch of each point, such as :func:`branches` reads from data. By default the model
        decides: points beyond the end of the stable branch are on the baseline.
    table : Table, optional
        The table; by default the embedded one, of films. Contacts on a stack are looked up in the
        table of this stack, and solved beside a table of films.

    Examples
    --------
    >>> from coated_contact import Elastic, HalfSpace
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
    >>> lens = Experiment(kind="load-radius", abscissa=[5e-5, 1e-4], system=system,
    ...                   work_of_adhesion=0.04)
    >>> found = predict(lens, ["work_of_adhesion"])
    >>> found.ordinate.round(7), found.derivatives["work_of_adhesion"].round(5)
    (array([-0.000168 ,  0.0012486]), array([-0.00627, -0.01772]))
    """
    experiments_of([experiment])
    names = _names("by", by)
    words = None if branches is None else list(branches)
    for word in words or ():
        one_of("branch", word, get_args(BranchName))
    found = _core.predict(native_table(table), experiment, words, names)
    columns = found.pop("derivatives").T
    return Prediction(derivatives=dict(zip(names, columns, strict=True)), **found)


def simulate(
    experiment: Experiment,
    *,
    noise: float,
    seed: int,
    table: Table | None = None,
    allow: Iterable[Allowed] = (),
) -> Experiment:
    """Return the experiment with synthetic ordinates.

    On approach the contact forms at the contact point; on retract, and without a direction, it
    lasts to the end of the stable branch. Points at contact radii are in contact.

    Parameters
    ----------
    experiment : Experiment
        Where to measure, and the true values. Its ordinates are not used; its ``abscissa_noise`` is
        added to the abscissae.
    noise : float
        Standard deviation of the normal noise that is added to each ordinate, N or m. Of a contact
        stiffness it is relative, 0.01 is 1 %, and its logarithm is normal.
    seed : int
        One seed always gives one measurement, that of ``tabulate simulate``.
    table : Table, optional
        The table; by default the embedded one, of films. Contacts on a stack are looked up in the
        table of this stack, and solved beside a table of films.
    allow : iterable of {"magnitudes"}
        Take numbers that no contact experiment has, such as a film of 1 m.

    Returns
    -------
    Experiment
        A copy with ordinates, with the loads of a contact stiffness at depths, and with the phases
        where the indentation has a loss tangent; a phase has the noise of a stiffness, in rad.

    Examples
    --------
    >>> from coated_contact import Elastic, HalfSpace
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
    >>> plan = Experiment(kind="load-radius", abscissa=[5e-5, 1e-4], system=system,
    ...                   work_of_adhesion=0.04)
    >>> simulate(plan, noise=0.0, seed=1).ordinate.round(7)
    array([-0.000168 ,  0.0012486])
    """
    experiments_of([experiment])
    native = native_table(table)
    whole = integer("seed", seed, 0, 2**63)
    abscissa, ordinate, loads, phases = _core.simulate(
        native, experiment, number("noise", noise), whole, "magnitudes" in allowed_of(allow)
    )
    indentation = experiment.indentation
    if loads.size or phases.size:
        made = {"loads": loads, "phases": phases}
        made = {name: array for name, array in made.items() if array.size}
        indentation = replace(indentation or Indentation(), **made)
    return replace(experiment, abscissa=abscissa, ordinate=ordinate, indentation=indentation)


def forecast(
    experiments: Experiment | Iterable[Experiment],
    free: Iterable[ParameterName | Free],
    *,
    table: Table | None = None,
    allow: Iterable[Allowed] = (),
) -> Forecast:
    """Return the standard errors that planned experiments would give, before they are made.

    Where the force jumps, the errors of a fit are larger than these: it leaves out points near the
    ends of the branches by the noise of the data.

    Parameters
    ----------
    experiments : Experiment or iterable of Experiment
        Where to measure, the true values, and the ``noise``, which each needs. The
        ``abscissa_noise`` counts as well. Ordinates are not used.
    free : iterable of str or Free
        The parameters to be found. Priors count; starts and bounds are not used.
    table : Table, optional
        The table; by default the embedded one, of films. Contacts on a stack are looked up in the
        table of this stack, and solved beside a table of films.
    allow : iterable of {"magnitudes"}
        Take numbers that no contact experiment has, such as a film of 1 m.

    Returns
    -------
    Forecast
        The estimates with the errors expected, what would not be determined, and the assumptions
        of the model that the contacts would leave.

    Examples
    --------
    >>> import numpy as np
    >>> from coated_contact import Elastic, HalfSpace
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
    >>> plan = Experiment(kind="load-radius", abscissa=np.linspace(5e-5, 1e-4, 20), system=system,
    ...                   work_of_adhesion=0.04, noise=5e-6)
    >>> expected = forecast(plan, ["sphere_modulus", "work_of_adhesion"])
    >>> print(f"{expected.stderr['sphere_modulus']:.1e} Pa")
    6.8e+03 Pa
    """
    given = told_apart(experiments)
    native = native_table(table)
    found = _core.forecast(native, given, free_of(free), "magnitudes" in allowed_of(allow))
    estimates = estimates_of(found)
    names = [name_of(one, len(given)) for one in estimates]
    return Forecast(
        estimates=estimates,
        correlation=correlation_of(found),
        undetermined=tuple(dict.fromkeys(words for words, _ in found["undetermined"])),
        fixed_values=fixed_values_of(found, len(given)),
        stderr={name: one.standard_error for name, one in zip(names, estimates, strict=True)},
        warnings=warnings_of(found),
        _undetermined=frozenset(names[i] for _, parts in found["undetermined"] for i in parts),
    )


def _names(argument: str, parameters: Iterable[ParameterName]) -> list[str]:
    """Return the names of parameters of an argument; refuse others."""
    names = listed(argument, parameters)
    for name in names:
        unit_of(name)
    return names
