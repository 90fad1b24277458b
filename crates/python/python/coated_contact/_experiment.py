"""What was measured, what is known about it, and what is to be found."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
from numpy import ma
from numpy.typing import NDArray

from . import _core
from ._arrays import UNIT_OF, fixed, labels_of, number, paired_labels, real
from ._bodies import HalfSpace, System
from ._control import check_friction
from ._errors import FitError
from ._history import Relaxation
from ._indentation import Indentation
from ._stack import StackSystem
from ._values import OneLine, Remade, set_flags, set_numbers

Kind = Literal[
    "load-radius",
    "penetration-radius",
    "load-penetration",
    "force-height",
    "stiffness-radius",
    "stiffness-load",
    "stiffness-depth",
]
# The name of a parameter: one of _core.PARAMETERS, LAYER.modulus, LAYER.thickness or
# LAYER.interface_stiffness of the layer of a stack that has the name LAYER, or with a number that
# of a further relaxation time or its weight: "relaxation_time.2".
ParameterName = str


def unit_of(parameter: object) -> str:
    """Return the SI unit of a parameter; refuse other words."""
    unit: str | None = _core.unit_of(parameter) if isinstance(parameter, str) else None
    if unit is not None:
        return unit
    words = ", ".join(f'"{word}"' for word in _core.PARAMETERS)
    raise FitError(
        f"parameter = {parameter!r} cannot be used: give one of {words}, or with a stack "
        '"LAYER.modulus", "LAYER.thickness" or "LAYER.interface_stiffness" of a layer by its name',
        axis="parameter",
    )


def listed(name: str, parameters: Iterable[Any]) -> list[Any]:
    """Return parameters as a list; refuse one word, and a mapping, of which only keys count."""
    if isinstance(parameters, str):
        raise TypeError(f"{name} must be a list of parameters: [{parameters!r}]")
    if isinstance(parameters, Mapping):
        raise TypeError(
            f"{name} must be a list of parameters, not a mapping, whose values would have no "
            "effect: a start and bounds are those of Free(parameter=..., start=..., bounds=...)"
        )
    return list(parameters)


def one_of(name: str, value: object, allowed: tuple[str, ...]) -> None:
    """Refuse a word that is not one of those allowed."""
    if value not in allowed:
        words = ", ".join(f'"{word}"' for word in allowed)
        raise FitError(f"{name} = {value!r} cannot be used: give one of {words}", axis=name)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Experiment(Remade, OneLine):
    """A measurement with what is known about it, in SI units.

    Each value below is fixed, or the start of the fit where the parameter is free and its
    :class:`Free` says so.

    Parameters
    ----------
    kind : {"load-radius", "penetration-radius", "load-penetration", "force-height", \
"stiffness-radius", "stiffness-load", "stiffness-depth"}
        What is measured: the ordinate, then the abscissa. A contact stiffness is described by the
        ``indentation``. Heights are those of the base of a
        cantilever: contact point - height = penetration + force / stiffness.
    abscissa : array_like
        Contact radii, penetrations or heights, m, or loads, N, in the order measured.
    ordinate : array_like, optional
        Loads or forces, N, positive in compression; penetrations, m; or contact stiffnesses, N/m.
        None where they are not
        measured yet: then they are NaN, which :func:`simulate` and :func:`forecast` accept.
    system : System, HalfSpace or StackSystem
        The bodies. On a half-space the parameters of the film are those of the solid. On a stack
        those of the layers take their place; contacts are looked up in a table of this stack,
        whose layers are fixed, and beside a table of films solved directly, in some milliseconds.
    retract : array_like of bool, optional
        Whether each point was measured on retract; None where that is not known.
    work_of_adhesion : float
        Work of adhesion, J/m^2; 0 is a contact without adhesion.
    work_of_adhesion_receding : float, optional
        Work of adhesion on retract, J/m^2; None is that of approach.
    doubling_speed : float, optional
        Speed of the contact line at which the work of adhesion, then that of a line at rest, is
        doubled where the line recedes and halved where it advances, m/s: the v0 of
        :class:`RateDependent`. None, also for ``speed_exponent``, is adhesion that does not depend
        on the speed. The speeds are read from contact radii and ``time``.
    speed_exponent : float, optional
        The exponent n of the speed of the contact line.
    load_offset : float
        What a load reads without a force, N.
    contact_point : float
        The penetration or height at which the sphere would just touch, m.
    baseline : float
        The force that is read at the contact point without a contact, N.
    baseline_slope : float
        The slope of the force that is read without a contact, N/m.
    stiffness : float, optional
        Stiffness of the cantilever, N/m, which ``"force-height"`` needs.
    from_deflection : bool
        Whether the ordinates are this ``stiffness`` times a measured deflection, as
        :func:`read_experiment` finds for deflections, and for forces beside separations or in a
        file whose head names this stiffness; then what is known of the stiffness holds for the
        forces, too. Another stiffness needs other ordinates: read the file again.
    noise : float or array_like, optional
        Standard deviation of an ordinate, N or m, or one for each point; None estimates it from
        the residuals. One number for a contact stiffness is relative to it, 0.01 is 1 %.
    abscissa_noise : float or array_like
        Standard deviation of an abscissa, m, or one for each point; 0 is exact. It counts by the
        slope of the model: a point has the variance ``noise**2 + (slope * abscissa_noise)**2``,
        with the mean square of the change where the model bends.
    friction : {"none", "stick"}
        Whether the surfaces slide freely, or never slide where they have touched. Contacts that
        stick are solved directly, for each change of a modulus or thickness, where Dundurs' beta of
        sphere and film is 0: see :class:`SolvedCurve`.
    sphere_poisson_ratio : float
        With ``friction="stick"``: the Poisson ratio of the sphere. A rigid one needs none.
    advancing : float
        With ``friction="stick"``: the work of adhesion with which the contact has grown over
        ``work_of_adhesion``, with which it recedes; a fit keeps this ratio. Below 1 all points must
        be of retract, or without a direction.
    indentation : Indentation, optional
        What is known of a measurement of contact stiffness; None is the usual. Other kinds do not
        use it.
    time : array_like, optional
        Time of each point, s. With a ``doubling_speed`` or a ``relaxation`` times rise; with a
        ``relaxation`` the points begin before the contact: an approach, which may be held, and a
        retract.
    relaxation : Relaxation, optional
        How the film relaxes in time: then moduli are its ``E_ref``, and there is no adhesion. Its
        numbers are parameters: ``"relaxed_fraction"``, ``"relaxation_exponent"``,
        ``"relaxation_time"`` and, of several terms, ``"relaxation_time.2"`` and
        ``"relaxation_weight.2"``, where the first weight is what the others leave. Free ones start
        from the data. A gel also relaxes by flow of its solvent, with a time that grows like the
        square of the contact radius: fits at two radii tell it from a law of the material.
    all_relax : bool
        Whether probe and substrate relax like the film. If not, the error of taking them so is
        estimated, and refused above 2 % of the largest load.
    name : str
        The name of the measurement in messages. Of several experiments of one name each gets its
        number in the list, from 0.
    reading : str
        How :func:`read_experiment` read the points, in one line; empty for other points.
    """

    kind: Kind
    abscissa: Any
    ordinate: Any = None
    system: System | HalfSpace | StackSystem
    retract: Any = None
    work_of_adhesion: float = 0.0
    work_of_adhesion_receding: float | None = None
    doubling_speed: float | None = None
    speed_exponent: float | None = None
    load_offset: float = 0.0
    contact_point: float = 0.0
    baseline: float = 0.0
    baseline_slope: float = 0.0
    stiffness: float | None = None
    from_deflection: bool = False
    noise: Any = None
    abscissa_noise: Any = 0.0
    friction: Literal["none", "stick"] = "none"
    sphere_poisson_ratio: float = 0.5
    advancing: float = 1.0
    indentation: Indentation | None = None
    time: Any = None
    relaxation: Relaxation | None = None
    all_relax: bool = False
    name: str = "experiment"
    reading: str = ""

    def __post_init__(self) -> None:
        one_of("kind", self.kind, get_args(Kind))
        if self.indentation is not None and not isinstance(self.indentation, Indentation):
            raise TypeError(f"indentation must be an Indentation, not {self.indentation!r}")
        if self.relaxation is not None and not isinstance(self.relaxation, Relaxation):
            raise TypeError(f"relaxation must be a Relaxation, not {self.relaxation!r}")
        set_flags(self, "all_relax", "from_deflection")
        for name in ("name", "reading"):
            if not isinstance(getattr(self, name), str):
                raise TypeError(f"{name} must be a str, not {getattr(self, name)!r}")
        if not isinstance(self.system, System | HalfSpace | StackSystem):
            raise TypeError(
                f"system must be a System, a HalfSpace or a StackSystem, not {self.system!r}"
            )
        one_of("friction", self.friction, ("none", "stick"))
        check_friction(self.friction, self.sphere_poisson_ratio, self.advancing)
        if self.friction == "stick" and self.work_of_adhesion_receding is not None:
            raise FitError(
                "work_of_adhesion_receding has no effect with friction: give work_of_adhesion, "
                "with which the contact recedes, and advancing, the ratio to it of that with which "
                "it has grown",
                axis="work_of_adhesion_receding",
            )
        if self.friction == "stick" and isinstance(self.system, HalfSpace):
            raise FitError(
                "friction on a half-space is not fitted (none at a Poisson ratio of 0.5): "
                "give a film or a stack, or leave friction out",
                axis="friction",
            )
        if isinstance(self.system, StackSystem) and self.system.stack.surface is not None:
            raise FitError(
                "the stack has a surface of its own, which fits do not take: leave it out with "
                "dataclasses.replace(stack, surface=None)",
                axis="surface",
            )
        if self.ordinate is None or _is_planned(self.abscissa, self.ordinate):
            object.__setattr__(self, "ordinate", np.full(np.shape(self.abscissa), np.nan))
        pointwise = ("abscissa", "ordinate", "retract", "time", "noise", "abscissa_noise")
        labels = {name: labels_of(getattr(self, name)) for name in pointwise}
        paired_labels(labels | (self.indentation._labels if self.indentation else {}))
        points = []
        # A kind is the ordinate over the abscissa.
        for name, word in zip(pointwise[:2], reversed(self.kind.split("-")), strict=True):
            points.append(real(name, getattr(self, name), _UNIT_OF_KIND[word]))
            object.__setattr__(self, name, fixed(points[-1]))
        shapes = {array.shape for array in points}
        if self.retract is not None:
            retract = np.asarray(self.retract)
            if retract.dtype != np.bool_ or ma.is_masked(self.retract):
                kind = "masked" if ma.is_masked(self.retract) else f"of the type {retract.dtype}"
                raise TypeError(f"retract must be True or False, not {kind}")
            object.__setattr__(self, "retract", fixed(retract))
            shapes.add(retract.shape)
        if self.time is not None:
            time = fixed(real("time", self.time))
            if time.shape != points[0].shape:
                count = points[0].shape
                raise FitError(
                    f"time must have one number for each point, {count}, not {time.shape}",
                    axis="time",
                )
            object.__setattr__(self, "time", time)
        if len(shapes) != 1 or points[0].ndim != 1:
            raise FitError(f"abscissa, ordinate and retract must be as long, not {shapes}")
        advances = self.retract is not None and not np.all(self.retract)
        if self.friction == "stick" and self.advancing != 1.0 and advances:
            raise FitError(
                f"advancing = {self.advancing} describes the retract only, and there are points of "
                "approach: leave them out, or leave out advancing",
                axis="advancing",
            )
        set_numbers(self, *(name for name in _NUMBERS if getattr(self, name) is not None))
        for name in ("noise", "abscissa_noise"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, _deviation(name, value, points[0].shape))

    @property
    def bodies(self) -> Any:
        """The bodies, as the native part takes them."""
        return self.system._native

    @property
    def law(self) -> Any:
        """The numbers of the relaxation, as the native part takes them."""
        return None if self.relaxation is None else self.relaxation._numbers()


# The units of what a kind names.
_UNIT_OF_KIND = UNIT_OF | {"force": "N", "depth": "m", "stiffness": "N/m or J/m^2"}

_NUMBERS = (
    "work_of_adhesion",
    "work_of_adhesion_receding",
    "doubling_speed",
    "speed_exponent",
    "load_offset",
    "contact_point",
    "baseline",
    "baseline_slope",
    "stiffness",
    "sphere_poisson_ratio",
    "advancing",
)


def _is_planned(abscissa: Any, ordinate: Any) -> bool:
    """Tell whether ordinates are those of other abscissae, and not measured yet.

    ``dataclasses.replace(plan, abscissa=...)`` gives these.
    """
    return np.shape(abscissa) != np.shape(ordinate) and bool(
        np.isnan(real("ordinate", ordinate)).all()
    )


def _deviation(name: str, value: Any, shape: tuple[int, ...]) -> float | NDArray[np.float64]:
    """Return a standard deviation: a float, or one for each point."""
    array = real(name, value)
    if array.ndim == 0:
        return float(array)
    if array.shape != shape:
        raise FitError(
            f"{name} must be one number or one for each point, {shape}, not {array.shape}",
            axis=name,
        )
    return fixed(array)


@dataclass(frozen=True, kw_only=True, slots=True)
class Free:
    """A parameter to be found.

    Parameters
    ----------
    parameter : str
        Its name, such as ``"film_modulus"``, or with a stack ``"LAYER.modulus"``,
        ``"LAYER.thickness"`` or ``"LAYER.interface_stiffness"`` (tangential, of the interface below
        the layer) of a layer by its name, such as ``"primer.modulus"``.
    start : float, optional
        Where the fit starts. By default moduli, works of adhesion, offsets, contact points and
        baselines start from the data themselves; Poisson ratio, thicknesses, stiffness and the
        moduli of layers from the value of the experiment. Experiments that share a parameter must
        have one value of it, or the fit one start.
    bounds : tuple of float, optional
        The smallest and the largest value allowed. A Poisson ratio has the bounds 0 and 0.5.
    prior : tuple of float, optional
        A value known from elsewhere, and its standard error.
    own : bool, optional
        Whether each experiment has its own value. By default offsets, contact points and baselines
        are each experiment's own, all else is shared.
    """

    parameter: ParameterName
    start: float | None = None
    bounds: tuple[float, float] | None = None
    prior: tuple[float, float] | None = None
    own: bool | None = None

    def __post_init__(self) -> None:
        unit_of(self.parameter)
        if self.own is not None:
            set_flags(self, "own")
        if self.start is not None:
            object.__setattr__(self, "start", number("start", self.start))
        for name in ("bounds", "prior"):
            if getattr(self, name) is not None:
                first, second = getattr(self, name)
                pair = number(name, first), number(name, second)
                object.__setattr__(self, name, pair)
