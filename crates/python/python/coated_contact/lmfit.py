"""A model of lmfit over the functions that :func:`coated_contact.fit` fits; needs lmfit.

Use it where lmfit's constraints, confidence intervals or samplers are wanted.
:func:`coated_contact.fit` finds its own start, warns of doubtful results, and is faster.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from inspect import Parameter as Argument
from inspect import Signature
from typing import Any

import numpy as np
from lmfit import Parameters
from lmfit.model import Model as LmfitModel
from lmfit.model import ModelResult
from numpy.typing import ArrayLike

from ._arrays import real
from ._bodies import HalfSpace
from ._experiment import Experiment, ParameterName
from ._model import Prediction, branches, predict
from ._results import Array
from ._table import Table

__all__ = ["Model"]

# The methods of lmfit that take a Jacobian.
WITH_JACOBIAN = ("leastsq", "least_squares")


class Model(LmfitModel):  # type: ignore[misc]
    """The ordinates of an experiment as a model of lmfit.

    The independent variable ``x`` is the abscissa. The parameters are those of
    :class:`coated_contact.Free` that the kind of experiment has, with the values of the experiment;
    those in ``free`` vary. With the methods ``"leastsq"`` and ``"least_squares"`` the fit uses the
    exact derivatives, unless a parameter has an expression. Give the weights 1/noise:
    ``"least_squares"`` stops by an absolute gradient, which is tiny in newtons.

    At the abscissae of the experiment the branch of each point is read from its data, as
    :func:`coated_contact.branches` does, and points in a jump do not count. At other abscissae the
    model decides.

    Parameters
    ----------
    experiment : Experiment
        What was measured, and the values of all parameters. The values of free ones are the start.
    free : iterable of str
        The parameters that vary.
    table : Table, optional
        The table; by default the embedded one.

    Examples
    --------
    >>> import numpy as np
    >>> from coated_contact import Elastic, Experiment, HalfSpace, simulate
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
    >>> plan = Experiment(kind="load-radius", abscissa=np.linspace(5e-5, 1e-4, 20),
    ...                   system=system, work_of_adhesion=0.04)
    >>> lens = simulate(plan, noise=2e-6, seed=1)
    >>> model = Model(lens, ["sphere_modulus", "work_of_adhesion"])
    >>> found = model.fit(lens.ordinate, x=lens.abscissa, sphere_modulus=1e6)
    >>> print(f"{found.best_values['sphere_modulus']:.2e} Pa")
    2.00e+06 Pa
    """

    def __init__(
        self,
        experiment: Experiment,
        free: Iterable[ParameterName],
        *,
        table: Table | None = None,
        **kwargs: Any,
    ) -> None:
        varied = list(free)
        self._experiment, self._table = experiment, table
        measured = not np.isnan(experiment.ordinate).any()
        self._branches = branches(experiment, varied) if measured else None
        names = parameters_of(experiment)
        unknown = [name for name in varied if name not in names]
        if unknown:
            raise ValueError(f"{unknown} are no parameters of this experiment: {', '.join(names)}")

        def ordinate(x: ArrayLike, **values: float) -> Array:
            found = self._predict(x, values, []).ordinate
            return np.where(np.isnan(found), 0.0, found)

        # lmfit takes the names of the parameters from the arguments.
        arguments = [Argument(name, Argument.POSITIONAL_OR_KEYWORD) for name in ("x", *names)]
        ordinate.__signature__ = Signature(arguments)  # type: ignore[attr-defined]
        super().__init__(ordinate, ["x"], names, name="coated_contact", **kwargs)
        for name in names:
            bounds = {"film_poisson_ratio": (0.0, 0.5)}.get(
                name, (0.0 if name in POSITIVE else -np.inf, np.inf)
            )
            self.set_param_hint(
                name,
                value=value_of(experiment, name),
                min=bounds[0],
                max=bounds[1],
                vary=name in varied,
            )

    def fit(
        self, data: ArrayLike, params: Parameters | None = None, *args: Any, **kwargs: Any
    ) -> ModelResult:
        """Fit the model to data, as ``lmfit.Model.fit`` does, with exact derivatives."""
        method = args[1] if len(args) > 1 else kwargs.get("method", "leastsq")
        settings = dict(kwargs.pop("fit_kws", None) or {})
        if method in WITH_JACOBIAN and not any(
            parameter.expr is not None for parameter in (params or {}).values()
        ):
            settings.setdefault("Dfun", self._jacobian)
        return super().fit(data, params, *args, fit_kws=settings, **kwargs)

    def _residual(self, params: Parameters, data: Any, weights: Any, **kwargs: Any) -> Any:
        """Return the weighted residuals; 0 for points that do not count."""
        residual = super()._residual(params, data, weights, **kwargs)
        if self._branches is not None and np.size(residual) == len(self._branches):
            residual[self._left_out()] = 0.0
        return residual

    def _left_out(self) -> list[int]:
        return [i for i, branch in enumerate(self._branches or ()) if branch == "left-out"]

    def _jacobian(self, params: Parameters, data: Any, weights: Any, **kwargs: Any) -> Array:
        """Return the derivatives of the residuals ``(data - model) weights``, a column for each."""
        varied = [name for name, parameter in params.items() if parameter.vary]
        values = {name: params[name].value for name in self.param_names}
        found = self._predict(kwargs["x"], values, varied)
        columns = np.stack([found.derivatives[name] for name in varied], axis=1)
        columns = np.where(np.isnan(columns), 0.0, columns)
        return -columns if weights is None else -columns * np.reshape(weights, (-1, 1))

    def _predict(self, x: ArrayLike, values: dict[str, float], by: list[str]) -> Prediction:
        abscissa = np.atleast_1d(real("x", x))
        experiment, words = self._experiment, self._branches
        if not np.array_equal(abscissa, experiment.abscissa):
            retract = experiment.retract
            same = retract is not None and (retract.all() or not retract.any())
            direction = np.full(abscissa.shape, bool(retract[0])) if same else None
            experiment, words = (
                replace(experiment, abscissa=abscissa, ordinate=None, retract=direction),
                None,
            )
        return predict(
            with_values(experiment, values),
            by,  # type: ignore[arg-type]
            branches=words,
            table=self._table,
        )


POSITIVE = (
    "sphere_modulus",
    "film_modulus",
    "film_thickness",
    "work_of_adhesion",
    "work_of_adhesion_receding",
    "stiffness",
)


def parameters_of(experiment: Experiment) -> list[str]:
    """Return the names of the parameters that have an effect and a finite value."""
    kind, coated = experiment.kind, not isinstance(experiment.system, HalfSpace)
    names = ["sphere_modulus", "film_modulus", "film_poisson_ratio"]
    names += ["film_thickness"] if coated else []
    names += ["work_of_adhesion"]
    names += ["work_of_adhesion_receding"] if experiment.work_of_adhesion_receding else []
    names += ["load_offset"] if kind == "load-radius" else ["contact_point"]
    if kind in ("load-penetration", "force-height"):
        names += ["baseline", "baseline_slope"]
    names += ["stiffness"] if kind == "force-height" else []
    return [name for name in names if np.isfinite(value_of(experiment, name))]


def value_of(experiment: Experiment, name: str) -> float:
    """Return the value of a parameter of an experiment."""
    system = experiment.system
    film = system.solid if isinstance(system, HalfSpace) else system.film
    owner = {
        "sphere_modulus": (system, "sphere_modulus"),
        "film_thickness": (system, "film_thickness"),
        "film_modulus": (film, "young_modulus"),
        "film_poisson_ratio": (film, "poisson_ratio"),
    }.get(name, (experiment, name))
    return float(getattr(*owner))


def with_values(experiment: Experiment, values: dict[str, float]) -> Experiment:
    """Return an experiment with other values of parameters."""
    system = experiment.system
    is_half_space = isinstance(system, HalfSpace)
    film = system.solid if isinstance(system, HalfSpace) else system.film
    of_film = {"film_modulus": "young_modulus", "film_poisson_ratio": "poisson_ratio"}
    of_system = ("sphere_modulus", "film_thickness")
    film = replace(film, **{of_film[n]: v for n, v in values.items() if n in of_film})
    changes: dict[str, Any] = {n: v for n, v in values.items() if n in of_system}
    changes["solid" if is_half_space else "film"] = film
    own: dict[str, Any] = {
        n: v for n, v in values.items() if n not in of_film and n not in of_system
    }
    return replace(experiment, system=replace(system, **changes), **own)
