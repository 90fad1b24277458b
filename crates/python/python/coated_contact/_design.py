"""Which of several planned experiments tells most about a parameter."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from . import _html
from ._columns import axes
from ._errors import ContactError, FitError
from ._experiment import Experiment, Free, ParameterName, unit_of
from ._fit import Allowed, allowed_of, free_of
from ._fit_results import Forecast
from ._model import forecast
from ._table import Table
from ._values import OneLine

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Plan = Experiment | Iterable[Experiment]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Design(OneLine):
    """What each of several plans would tell about one parameter: the best plan first.

    Attributes
    ----------
    about : str
        The parameter.
    forecasts : dict of str to Forecast
        What each plan would tell, by its name; by the standard error of the parameter.
    stderr : dict of str to float
        The standard error of the parameter, in its SI unit; infinite where it is not determined.
    repeats : dict of str to float
        How often a plan must be made, with independent noise, to tell as much as the best one: the
        square of the ratio of the standard errors.
    """

    about: str
    forecasts: dict[str, Forecast]
    stderr: dict[str, float]
    repeats: dict[str, float]

    @property
    def best(self) -> str:
        """The name of the plan with the smallest standard error."""
        return next(iter(self.stderr))

    def __str__(self) -> str:
        """Return a line for each plan."""
        width = max(len(name) for name in self.stderr)
        rows = (f"  {name:<{width}}  {error}  {repeats}" for name, error, repeats in self._rows())
        return "\n".join([f"standard error of {self.about}, and repeats to match the best", *rows])

    def _rows(self) -> list[tuple[str, str, str]]:
        unit = _unit(self.about)
        return [
            (name, f"{error:.3g} {unit}", f"{self.repeats[name]:.3g}")
            for name, error in self.stderr.items()
        ]

    def _repr_html_(self) -> str:
        """Return what a notebook shows: a row for each plan."""
        header = ("plan", f"standard error of {self.about}", "repeats to match the best")
        return _html.table(header, self._rows())

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the standard errors of the plans as bars, the best one above; needs matplotlib.

        It draws into ``ax``, by default the current axes, and returns the axes, with a logarithmic
        scale. A plan that does not determine the parameter has no bar, and says so.
        """
        ax = axes(ax)
        errors = np.array(list(self.stderr.values()))
        known = np.isfinite(errors)
        # The length of a bar on a logarithmic scale means nothing, so a point stands at its end.
        places = np.arange(len(errors))
        least = errors[known].min() / 2
        ax.hlines(places[known], least, errors[known], color="0.8", linewidth=2)
        ax.plot(errors[known], places[known], "o", color="C0")
        # Inside the axes, where a long name is not cut off.
        for place, name in enumerate(self.stderr):
            ax.text(
                least, place, f" {name}{'' if known[place] else ': not determined'}", va="bottom"
            )
        ax.set_xscale("log")
        ax.set_xlim(least, errors[known].max() * 2)
        ax.set_ylim(len(errors) - 0.5, -0.5)
        ax.set_yticks([])
        ax.set_xlabel(f"standard error of {self.about} ({_unit(self.about)})")
        return ax


def design(
    plans: Mapping[str, Plan] | Iterable[Plan],
    free: Iterable[ParameterName | Free],
    *,
    about: str,
    table: Table | None = None,
    allow: Iterable[Allowed] = (),
) -> Design:
    """Return which of several planned experiments tells most about one parameter.

    Each plan gets the standard errors of :func:`forecast`, with the same free parameters: those
    which are not asked about are found, too, and cost accuracy.

    Parameters
    ----------
    plans : mapping or iterable
        The plans by their names, or without names, numbered from 0. Each is an experiment, or
        several that are fitted together.
    free : iterable of str or Free
        The parameters to be found by each plan.
    about : str
        The parameter of interest; ``contact_point[1]`` is that of the second experiment of a plan.
    table : Table, optional
        The table; by default the embedded one, of films.
    allow : iterable of {"magnitudes"}
        Take numbers that no contact experiment has, such as a film of 1 m.

    Returns
    -------
    Design
        The plans by their standard errors, the best one first.

    Raises
    ------
    FitError
        Without a plan; for a parameter that is not free, or that no plan determines; for a plan
        without a noise, or to which a free parameter does not apply, by its name.

    Examples
    --------
    >>> from coated_contact import Elastic, System
    >>> system = System(sphere_radius=1e-3, sphere_modulus=2e6,
    ...                 film=Elastic(young_modulus=3.5e6, poisson_ratio=0.5), film_thickness=1e-5,
    ...                 substrate=Elastic(young_modulus=2e11, poisson_ratio=0.25))
    >>> def lens(largest):
    ...     return Experiment(kind="load-radius", abscissa=np.linspace(3e-5, largest, 30),
    ...                       system=system, work_of_adhesion=0.04, noise=2e-6)
    >>> found = design({"small": lens(6e-5), "large": lens(1.2e-4)},
    ...                ["film_modulus", "work_of_adhesion"], about="film_modulus")
    >>> found.best
    'large'
    """
    given = _named(plans)
    wanted, allow = free_of(free), allowed_of(allow)
    if not given:
        raise FitError("there is no plan: give one experiment or more", axis="plans")
    _unit(about)
    forecasts: dict[str, Forecast] = {}
    for name, plan in given.items():
        try:
            expected = forecast(plan, wanted, table=table, allow=allow)
        except ContactError as error:
            error.add_note(f"plan {name!r}")
            raise
        if about not in expected.stderr:
            raise FitError(
                f"about = {about!r} is not free in the plan {name!r}: give one of "
                f"{', '.join(expected.stderr)}",
                axis="about",
            )
        forecasts[name] = expected
    errors = {name: _error(one, about) for name, one in forecasts.items()}
    order = sorted(errors, key=lambda name: errors[name])
    least = errors[order[0]]
    if least == np.inf:
        doubts = dict.fromkeys(words for one in forecasts.values() for words in one.undetermined)
        raise FitError(
            f"no plan determines {about}: {'; '.join(doubts) or 'its standard error is infinite'}",
            axis="about",
        )
    return Design(
        about=about,
        forecasts={name: forecasts[name] for name in order},
        stderr={name: errors[name] for name in order},
        repeats={name: (errors[name] / least) ** 2 for name in order},
    )


def _named(plans: Mapping[str, Plan] | Iterable[Plan]) -> dict[str, Plan]:
    """Return the plans with names."""
    if isinstance(plans, Experiment):
        raise TypeError("plans must be several: a mapping of names to experiments, or a list")
    if isinstance(plans, Mapping):
        return {str(name): plan for name, plan in plans.items()}
    return {f"plan {i}": plan for i, plan in enumerate(plans)}


def _unit(about: object) -> str:
    """Return the unit of a parameter, with the number of its experiment or without."""
    return unit_of(about.partition("[")[0] if isinstance(about, str) else about)


def _error(expected: Forecast, about: str) -> float:
    """Return the standard error; infinity where the plan does not determine the parameter."""
    error = expected.stderr[about]
    return error if np.isfinite(error) and about not in expected._undetermined else np.inf
