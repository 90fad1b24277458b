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
from lmfit import Parameter, Parameters
from lmfit.model import Model as LmfitModel
from lmfit.model import ModelResult
from lmfit.parameter import valid_symbol_name
from numpy.typing import ArrayLike

from ._arrays import real
from ._bodies import Elastic, HalfSpace, System
from ._columns import Array
from ._errors import FitError
from ._experiment import Experiment, ParameterName, listed
from ._magnitudes import unchecked
from ._model import Prediction, branches, predict
from ._stack import Layer, Springs, StackSystem
from ._table import Table

__all__ = ["Model"]

# The methods of lmfit that take a Jacobian.
WITH_JACOBIAN = ("leastsq", "least_squares")


class Model(LmfitModel):  # type: ignore[misc]
    """The ordinates of an experiment as a model of lmfit.

    The independent variable ``x`` is the abscissa. The parameters are those of
    :class:`coated_contact.Free` that the kind of experiment has, with the values of the experiment,
    but for numbers of a relaxation and for hardness, tip and frame, which keep their values; those
    in ``free`` vary. With the methods ``"leastsq"`` and ``"least_squares"`` the fit uses the
    derivatives, unless a parameter has an expression. Give the weights 1/noise:
    ``"least_squares"`` stops by an absolute gradient, which is tiny in newtons. ``"leastsq"``
    cannot move a parameter from its bound: give a start within, such as a work of adhesion above 0.
    ``"nelder"``, ``"powell"``, ``"slsqp"`` and ``"emcee"`` work, too. ``"lbfgsb"``, ``"cobyla"``
    and ``"cg"`` stop at the start, some as if with success, because moduli in Pa and works of
    adhesion in J/m^2 differ by many orders of magnitude.

    The model and its results can be pickled.

    With a stack the parameters of a layer of the name ``primer`` are ``primer_modulus`` and
    ``primer_thickness`` in lmfit, and ``"primer.modulus"`` and ``"primer.thickness"`` in ``free``;
    with springs below it also ``primer_interface_stiffness`` and ``"primer.interface_stiffness"``,
    the tangential one.
    Layers whose names lmfit cannot take are fixed, and so is the modulus of one called ``sphere``.

    At the abscissae of the experiment the branch of each point is read from its data, as
    :func:`coated_contact.branches` does, and points in a jump do not count: there the model is NaN,
    and a composite model needs ``nan_policy="omit"``. Each curve needs its own model: data of other
    branches are refused. At other abscissae the model decides. Under a relaxation, of the kind
    ``"stiffness-depth"``, and of approach and retract together there is no model at other
    abscissae: it needs the time, the load or the direction of each point.

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
        varied = listed("free", free)
        self._experiment, self._varied, self._table = experiment, varied, table
        measured = not np.isnan(experiment.ordinate).any()
        self._branches = branches(experiment, varied) if measured else None
        self._known = parameters_of(experiment)
        names = list(self._known)
        unknown = [name for name in varied if name not in self._known.values()]
        if unknown:
            known = ", ".join(self._known.values())
            raise ValueError(f"{unknown} are no parameters of this experiment: {known}")

        super().__init__(_Ordinate(self, names), ["x"], names, name="coated_contact", **kwargs)
        for name, parameter in self._known.items():
            is_positive = parameter in POSITIVE or "." in parameter
            bounds = {"film_poisson_ratio": (0.0, 0.5)}.get(
                parameter, (0.0 if is_positive else -np.inf, np.inf)
            )
            self.set_param_hint(
                name,
                value=value_of(experiment, parameter),
                min=bounds[0],
                max=bounds[1],
                vary=parameter in varied,
            )

    def fit(
        self, data: ArrayLike, params: Parameters | None = None, *args: Any, **kwargs: Any
    ) -> ModelResult:
        """Fit the model to data, as ``lmfit.Model.fit`` does, with its derivatives."""
        method = args[1] if len(args) > 1 else kwargs.get("method", "leastsq")
        settings = dict(kwargs.pop("fit_kws", None) or {})
        start = self.make_params() if params is None else params
        given = [one for one in kwargs.values() if isinstance(one, Parameter)]
        if method in WITH_JACOBIAN and not _has_expression([*start.values(), *given]):
            settings.setdefault("Dfun", self._jacobian)
        if method == "leastsq" and settings.get("Dfun") is not None:
            self._refuse_bounds(start, kwargs)
        if method == "least_squares":
            # Or steps in metres and joules would count as nothing beside those in pascals.
            settings.setdefault("x_scale", "jac")
        self._refuse_other_branches(data, kwargs.get("x"))
        return super().fit(data, params, *args, fit_kws=settings, **kwargs)

    def _refuse_bounds(self, start: Parameters, given: dict[str, Any]) -> None:
        """Refuse free parameters that start at a bound, where lmfit's variables have no slope."""
        for name in self.param_names:
            one = start.get(name)
            value = given.get(name, one)
            if isinstance(value, Parameter):
                one, value = value, value.value
            if one is not None and one.vary and one.expr is None and value in (one.min, one.max):
                side = "above" if value == one.min else "below"
                raise ValueError(
                    f"{name} starts at its bound {value:g}, from which lmfit's leastsq cannot move "
                    f"it: give a start {side} it, or fix it"
                )

    def _refuse_other_branches(self, data: ArrayLike, x: ArrayLike | None) -> None:
        """Refuse data whose points are on other branches than those of the experiment."""
        words, experiment = self._branches, self._experiment
        if words is None or x is None or not np.array_equal(x, experiment.abscissa):
            return
        measured = np.asarray(data, dtype=float)
        if measured.shape != experiment.abscissa.shape or np.isnan(measured).any():
            return
        other = branches(replace(experiment, ordinate=measured), self._varied)
        if other != words:
            raise ValueError(
                "other branches are read from these data than from the experiment of this model: "
                "make a model of an experiment that has these data as its ordinate"
            )

    def _residual(self, params: Parameters, data: Any, weights: Any, **kwargs: Any) -> Any:
        """Return the weighted residuals of the points that count."""
        residual = np.asarray(data) - self.eval(params, **kwargs)
        weighted = residual if weights is None else residual * weights
        return np.delete(weighted, self._left_out(kwargs["x"]))

    def _left_out(self, x: ArrayLike) -> list[int]:
        """Return the points that do not count: at other abscissae none."""
        if not np.array_equal(x, self._experiment.abscissa):
            return []
        return [i for i, branch in enumerate(self._branches or ()) if branch == "left-out"]

    def _jacobian(self, params: Parameters, data: Any, weights: Any, **kwargs: Any) -> Array:
        """Return the derivatives of the residuals ``(data - model) weights``, a column for each."""
        if _has_expression(params.values()):
            raise ValueError(
                "a result whose fit had no expressions cannot be fitted again with them: call fit "
                "of the model"
            )
        roots = {name: name.removeprefix(self.prefix) for name in self.param_names}
        values = {root: params[name].value for name, root in roots.items()}
        # Parameters that the model does not have change nothing.
        varied = [
            self._known[roots[name]] if name in roots else None
            for name, one in params.items()
            if one.vary
        ]
        found = self._predict(kwargs["x"], values, [name for name in varied if name is not None])
        nothing = np.zeros_like(found.ordinate)
        columns = [nothing if name is None else found.derivatives[name] for name in varied]
        jacobian = -np.stack(columns, axis=1)
        if weights is not None:
            jacobian *= np.reshape(weights, (-1, 1))
        return np.delete(jacobian, self._left_out(kwargs["x"]), axis=0)

    def _predict(
        self, x: ArrayLike, values: dict[str, float], by: list[ParameterName]
    ) -> Prediction:
        """Predict at the abscissae ``x``, with values by their names in lmfit, without a prefix."""
        abscissa = np.atleast_1d(real("x", x))
        experiment, words = self._experiment, self._branches
        if not np.array_equal(abscissa, experiment.abscissa):
            experiment, words = _at(experiment, abscissa), None
        changed = with_values(experiment, {self._known[name]: v for name, v in values.items()})
        return predict(changed, by, branches=words, table=self._table)


class _Ordinate:
    """The function that lmfit calls; it can be pickled, which one within a method cannot."""

    __name__ = "ordinate"

    def __init__(self, model: Model, names: list[str]) -> None:
        # lmfit takes the names of the parameters from the arguments.
        arguments = [Argument(name, Argument.POSITIONAL_OR_KEYWORD) for name in ("x", *names)]
        self.model, self.__signature__ = model, Signature(arguments)

    def __call__(self, x: ArrayLike, **values: float) -> Array:
        """Return the ordinates at abscissae."""
        return self.model._predict(x, values, []).ordinate


def _has_expression(parameters: Iterable[Parameter]) -> bool:
    return any(one.expr is not None for one in parameters)


def _at(experiment: Experiment, abscissa: Array) -> Experiment:
    """Return an experiment at other abscissae, without what is known of each point."""
    needed = "loads" if experiment.kind == "stiffness-depth" else "times"
    in_time = experiment.relaxation is not None or experiment.doubling_speed is not None
    if needed == "loads" or in_time:
        raise FitError(
            f"the {needed} at other abscissae, which this model needs, are not known: give the "
            "abscissae of the experiment",
            axis="x",
        )
    retract, indentation = experiment.retract, experiment.indentation
    same = retract is not None and (retract.all() or not retract.any())
    if retract is not None and not same:
        raise FitError(
            "which points are of approach and which of retract is not known at other abscissae: "
            "give those of the experiment, or make a model of one direction",
            axis="x",
        )
    if indentation is not None:
        indentation = replace(indentation, loads=None, phases=None)
    return replace(
        experiment,
        abscissa=abscissa,
        ordinate=None,
        retract=np.full(abscissa.shape, bool(retract[0])) if same else None,
        noise=None,
        abscissa_noise=0.0,
        time=None,
        indentation=indentation,
    )


POSITIVE = (
    "sphere_modulus",
    "film_modulus",
    "film_thickness",
    "work_of_adhesion",
    "work_of_adhesion_receding",
    "doubling_speed",
    "speed_exponent",
    "stiffness",
)

# The parameters of the solid of a film or half-space, by the names of its attributes.
OF_FILM = {"film_modulus": "young_modulus", "film_poisson_ratio": "poisson_ratio"}


def parameters_of(experiment: Experiment) -> dict[str, ParameterName]:
    """Return the parameters that have an effect and a finite value, by their names in lmfit."""
    kind, system = experiment.kind, experiment.system
    names = ["sphere_modulus"]
    if not isinstance(system, StackSystem):
        names += ["film_modulus", "film_poisson_ratio"]
    names += ["film_thickness"] if isinstance(system, System) else []
    names += ["work_of_adhesion"]
    names += ["work_of_adhesion_receding"] if experiment.work_of_adhesion_receding else []
    if experiment.doubling_speed is not None:
        names += ["doubling_speed", "speed_exponent"]
    names += ["load_offset"] if kind == "load-radius" else []
    names += [] if kind == "load-radius" or kind.startswith("stiffness") else ["contact_point"]
    if kind in ("load-penetration", "force-height"):
        names += ["baseline", "baseline_slope"]
    names += ["stiffness"] if kind == "force-height" else []
    named = {name: name for name in names if np.isfinite(value_of(experiment, name))}
    if isinstance(system, StackSystem):
        for layer in system.stack.layers:
            for what in ("modulus", "thickness", "interface_stiffness"):
                name = f"{layer.name}_{what}"
                if what == "interface_stiffness" and not 0.0 < _tangential(layer) < np.inf:
                    continue
                if layer.name is not None and name not in named and valid_symbol_name(name):
                    named[name] = f"{layer.name}.{what}"
    return named


def value_of(experiment: Experiment, name: ParameterName) -> float:
    """Return the value of a parameter of an experiment."""
    system = experiment.system
    if isinstance(system, StackSystem) and "." in name:
        layer, _, what = name.rpartition(".")
        found = next(one for one in system.stack.layers if one.name == layer)
        if what == "interface_stiffness":
            return _tangential(found)
        return found.thickness if what == "thickness" else found.material.young_modulus
    if not isinstance(system, StackSystem) and name in OF_FILM:
        return float(getattr(_film(system), OF_FILM[name]))
    owner = system if name in ("sphere_modulus", "film_thickness") else experiment
    return float(getattr(owner, name))


def with_values(experiment: Experiment, values: dict[ParameterName, float]) -> Experiment:
    """Return an experiment with other values of parameters."""
    system = experiment.system
    own: dict[str, Any] = {}
    changes: dict[str, Any] = {}
    of_film: dict[str, float] = {}
    for name, value in values.items():
        if name in OF_FILM:
            of_film[OF_FILM[name]] = value
        elif name in ("sphere_modulus", "film_thickness"):
            changes[name] = value
        elif "." not in name:
            own[name] = value
    if isinstance(system, StackSystem):
        layers = [_layer_with(one, values) for one in system.stack.layers]
        changes["stack"] = replace(system.stack, layers=layers)
    else:
        film = "solid" if isinstance(system, HalfSpace) else "film"
        changes[film] = replace(_film(system), **of_film)
    with unchecked():
        return replace(experiment, system=replace(system, **changes), **own)


def _layer_with(layer: Layer, values: dict[ParameterName, float]) -> Layer:
    """Return a layer with the values of its parameters."""
    if layer.name is None:
        return layer
    young = values.get(f"{layer.name}.modulus", layer.material.young_modulus)
    thickness = values.get(f"{layer.name}.thickness", layer.thickness)
    material = replace(layer.material, young_modulus=young)
    interface = layer.interface
    if isinstance(interface, Springs):
        tangential = values.get(f"{layer.name}.interface_stiffness", _tangential(layer))
        interface = replace(interface, tangential_stiffness=tangential)
    return replace(layer, material=material, thickness=thickness, interface=interface)


def _tangential(layer: Layer) -> float:
    """Return the tangential stiffness of the springs below a layer; 0 without springs."""
    springs = layer.interface
    return springs.tangential_stiffness if isinstance(springs, Springs) else 0.0


def _film(system: System | HalfSpace) -> Elastic:
    return system.solid if isinstance(system, HalfSpace) else system.film
