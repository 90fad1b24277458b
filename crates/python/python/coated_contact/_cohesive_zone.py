"""A short cohesive zone, as a correction of JKR's contact."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, final, overload

from numpy.typing import ArrayLike

from . import _core
from ._arrays import Errors, evaluate, number
from ._control import Control, native_control
from ._magnitudes import warn_of_work
from ._results import (
    CohesiveEquilibrium,
    CohesiveState,
    CohesiveStates,
    cohesive_states,
)
from ._values import set_numbers

if TYPE_CHECKING:
    from ._contact import Contact


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class ShortZone:
    """A contact with a short cohesive zone, which ``Contact.cohesive_zone`` makes.

    The attraction is a constant traction over a finite range (Dugdale's law). It acts in a zone of
    the length ``l = pi Es* w / (4 stress^2)`` outside the contact, with the compound modulus Es* of
    probe and film, or top layer. JKR's contact is corrected to first order in ``l`` over the
    contact radius and over the thickness of the film, or top layer, at the cost of JKR.

    Against solves, the load at pull-off errs by up to 0.7 % where ``l`` is a fifth of the shorter
    of contact radius and thickness, and by 0.06 % where it is a twentieth; at an imposed
    displacement by 3 % and 0.4 %, and by up to 40 % where the curve has two nearly equal least
    penetrations. At a given contact radius load and penetration err by more. A confined film that
    pulls harder than the attraction bears opens inside, and is an InputError. :class:`Cohesive`
    solves zones of any length.

    Parameters
    ----------
    contact : Contact
        The contact.
    work_of_adhesion : float
        Work of adhesion w, J/m^2, above 0.
    stress : float
        The traction, Pa, above 0. It acts where the gap is below ``work_of_adhesion / stress``.

    Raises
    ------
    InputError
        For a work of adhesion or a stress that is not positive and finite.
        For a zone longer than ``LONGEST`` times the film, or top layer, or largest contact.
        For a shape with an edge or a bend.

    Attributes
    ----------
    LONGEST : float
        The longest zone that counts as short, over the contact radius and over the thickness. A
        stable state with a contact radius below ``zone / LONGEST`` is an InputError.
    """

    LONGEST: ClassVar[float] = _core.LONGEST_ZONE

    contact: Contact
    work_of_adhesion: float
    stress: float

    def __post_init__(self) -> None:
        set_numbers(self, "work_of_adhesion", "stress")
        _core.zone_length(*self._native)
        warn_of_work(self.work_of_adhesion)

    @property
    def _native(self) -> tuple[Any, tuple[float, float]]:
        return self.contact._native, (self.work_of_adhesion, self.stress)

    @property
    def zone(self) -> float:
        """The length of the cohesive zone, m."""
        return _core.zone_length(*self._native)

    @overload
    def state(self, a: float, *, errors: Errors = "raise") -> CohesiveState: ...
    @overload
    def state(self, a: ArrayLike, *, errors: Errors = "raise") -> CohesiveStates: ...
    def state(self, a: ArrayLike, *, errors: Errors = "raise") -> CohesiveState | CohesiveStates:
        """Return the state at a contact radius.

        Parameters
        ----------
        a : array_like
            Contact radius, m.
        errors : {"raise", "nan"}
            What a point with an error gives.
        """
        native = partial(_core.zone_states, *self._native)
        return cohesive_states(evaluate(native, errors, contact_radius=a))

    def pull_off(self, *, control: Control = "load") -> CohesiveState:
        """Return the state in which the contact separates on unloading.

        Parameters
        ----------
        control : {"load", "displacement"} or Spring
            What is imposed.
        """
        return CohesiveState(*_core.zone_pull_off(*self._native, native_control(control)))

    def equilibria(self, imposed: float, *, control: Control = "load") -> list[CohesiveEquilibrium]:
        """Return the equilibria at an imposed value, in ascending order of contact radius.

        Unstable ones whose contact radius is below the zone over ``LONGEST`` are left out.

        Parameters
        ----------
        imposed : float
            A load (N), a penetration (m) or a position of the spring (m).
        control : {"load", "displacement"} or Spring
            What is imposed.
        """
        found = _core.zone_equilibria(
            *self._native, native_control(control), number("imposed", imposed)
        )
        return [CohesiveEquilibrium(CohesiveState(*numbers), stable) for numbers, stable in found]
