"""Contact stiffness as a measurement: what is known of the indenter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal, get_args

import numpy as np

from ._arrays import fixed, labels_of, real
from ._errors import FitError
from ._values import OneLine, Remade, set_flags, set_numbers

ContactDepth = Literal["oliver-pharr", "loubet"]

_NUMBERS = (
    "beta",
    "epsilon",
    "thinning",
    "hardness",
    "tip_rounding",
    "frame_compliance",
    "loss_tangent",
)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Indentation(Remade, OneLine):
    """What is known of a measurement of contact stiffness beside its points.

    The stiffness is that of a contact line that stays, ``S = 2 beta a E* eeq``, which a small fast
    oscillation measures: CSM of nanoindenters, dynamic AFM. The contact radius ``a`` is

    - ``"stiffness-radius"``: the abscissa,
    - ``"stiffness-load"`` without a hardness: that of the load in an elastic contact, on loading,
    - ``"stiffness-load"`` with a hardness H: ``sqrt(P / (pi H))``,
    - ``"stiffness-depth"``: that of the area function at the contact depth.

    Parameters
    ----------
    beta : float
        Factor of indenters that are not bodies of revolution: 1.034 of a Berkovich pyramid (King,
        1987), 1.012 of Vickers' pyramid, 1 of spheres.
    epsilon : float
        Factor of the contact depth of Oliver and Pharr: 0.75 of paraboloids and pyramids, 0.72 of
        cones, 1 of flat punches.
    area : float or sequence of float
        Coefficients C0, C1, .. of the area function C0 h^2 + C1 h + C2 h^(1/2) + .. + C8 h^(1/128)
        in powers of nanometres.
    contact_depth : {"oliver-pharr", "loubet"}
        ``h - epsilon P/S + h0``, or ``1.2 (h - P/S + h0)`` for metals that pile up.
    thinning : float
        Part of the contact depth by which the film or the top layer is thinner under the tip.
    hardness : float, optional
        Hardness H, Pa, one for all points. Simulated depths need it, too.
    tip_rounding : float
        Depth h0, m, by which the tip is blunter than its area function.
    frame_compliance : float
        Compliance of the frame, m/N: ``1/S`` is read too large by it, the depth by it times the
        load.
    loads : array_like, optional
        Load of each point, N, which ``"stiffness-depth"`` needs.
    phases : array_like, optional
        Phase of each point, rad: the angle of the complex stiffness, of which the ordinates are the
        storage part. Then the modulus of the film is the absolute value of the complex one, and
        ``FittedExperiment.loss`` its loss tangent, up to 1.
    loss_tangent : float
        The loss tangent of the film or top layer, 0 to 1, of which :func:`simulate` makes the
        phases; 0 makes none. Fits find their own and do not use it.
    reference : bool
        Whether the sample, a :class:`HalfSpace`, is a bare one of known modulus, which tells tip
        and frame: the parameters of the film are not its own.

    Examples
    --------
    >>> berkovich = Indentation(beta=1.034, tip_rounding=6e-9)
    >>> berkovich.contact_depth
    'oliver-pharr'
    """

    beta: float = 1.0
    epsilon: float = 0.75
    area: Any = (24.56,)
    contact_depth: ContactDepth = "oliver-pharr"
    thinning: float = 0.0
    hardness: float | None = None
    tip_rounding: float = 0.0
    frame_compliance: float = 0.0
    loads: Any = None
    phases: Any = None
    loss_tangent: float = 0.0
    reference: bool = False
    # Those of the loads and phases, which an Experiment compares with those of its points.
    _labels: ClassVar[dict[str, list[tuple[Any, Any]]]] = {}

    def __post_init__(self) -> None:
        set_numbers(self, *(name for name in _NUMBERS if getattr(self, name) is not None))
        if self.contact_depth not in get_args(ContactDepth):
            words = ", ".join(f'"{word}"' for word in get_args(ContactDepth))
            raise FitError(
                f"contact_depth = {self.contact_depth!r} cannot be used: give one of {words}",
                axis="contact_depth",
            )
        area = np.atleast_1d(real("area", self.area))
        object.__setattr__(self, "area", tuple(float(one) for one in area))
        given = {name: getattr(self, name) for name in ("loads", "phases")}
        object.__setattr__(self, "_labels", {name: labels_of(one) for name, one in given.items()})
        for name, one in given.items():
            if one is not None:
                object.__setattr__(self, name, fixed(real(name, one)))
        set_flags(self, "reference")
