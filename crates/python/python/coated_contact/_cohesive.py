"""An attraction of finite range, from DMT to JKR."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, final, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Errors, evaluate, integer, located, number, real, scalar_or_array
from ._bodies import System
from ._columns import Array
from ._control import Control, native_control
from ._magnitudes import warn_of_work
from ._results import CohesiveState, CohesiveStates, cohesive_states
from ._stack import StackSystem
from ._values import Native, set_field, set_numbers


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Cohesive(Native):
    """A paraboloid on a film or a stack, with an attraction of finite range (Dugdale's law).

    The traction w/z0 acts wherever the gap is below z0: in an annulus around the contact (Maugis,
    J. Colloid Interface Sci. 150, 243, 1992, for the half-space). Long ranges give DMT's
    -2 pi w R as the pull-off load on every film, short ones JKR. Every state is solved directly,
    for contacts and annuli up to 120 times as wide as the (top) layer is thick.

    Parameters
    ----------
    system : System or StackSystem
        The bodies. The probe must be a paraboloid.
    work_of_adhesion : float
        Work of adhesion w, J/m^2, above 0.
    interaction_range : float
        The range z0, m, above 0 and below the radius of the sphere.

    Examples
    --------
    >>> from coated_contact import Elastic
    >>> rubber = Elastic(young_modulus=1e6, poisson_ratio=0.5)
    >>> silicon = Elastic(young_modulus=2e11, poisson_ratio=0.25)
    >>> system = System(sphere_radius=1e-5, sphere_modulus=7.5e10, film=rubber,
    ...                 film_thickness=1e-6, substrate=silicon)
    >>> cohesive = Cohesive(system=system, work_of_adhesion=0.05, interaction_range=10e-9)
    >>> pull_off = cohesive.pull_off()
    >>> print(f"{pull_off.load:.3e} N at a = {pull_off.contact_radius:.3e} m")
    -3.233e-06 N at a = 1.974e-06 m
    """

    system: System | StackSystem
    work_of_adhesion: float
    interaction_range: float

    def __post_init__(self) -> None:
        if not isinstance(self.system, System | StackSystem):
            given = type(self.system).__name__
            raise TypeError(f"system must be a System or a StackSystem, not {given}")
        set_numbers(self, "work_of_adhesion", "interaction_range")
        native = _core.Cohesive(self.system._native, self.work_of_adhesion, self.interaction_range)
        set_field(self, "_native", native)
        warn_of_work(self.work_of_adhesion)

    @overload
    def state(self, a: float, *, errors: Errors = "raise") -> CohesiveState: ...
    @overload
    def state(self, a: ArrayLike, *, errors: Errors = "raise") -> CohesiveStates: ...
    def state(self, a: ArrayLike, *, errors: Errors = "raise") -> CohesiveState | CohesiveStates:
        """Return the state at a contact radius; many are solved on all cores.

        Of several outer radii at which the gap is z0, it is that of the smallest.

        Parameters
        ----------
        a : array_like
            Contact radius, m.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Raises
        ------
        SolveError
            For a radius that is not positive or out of reach, or whose annulus is.
        NoContactError
            Where the contact would open inside, or the gap in the annulus is not between 0 and z0.
        """
        return cohesive_states(evaluate(self._native.state, errors, contact_radius=a))

    @overload
    def without_contact(self, c: float, *, errors: Errors = "raise") -> CohesiveState: ...
    @overload
    def without_contact(self, c: ArrayLike, *, errors: Errors = "raise") -> CohesiveStates: ...
    def without_contact(
        self, c: ArrayLike, *, errors: Errors = "raise"
    ) -> CohesiveState | CohesiveStates:
        """Return the state before the contact in which the attraction acts within a radius.

        Parameters
        ----------
        c : array_like
            The radius, m.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Raises
        ------
        SolveError
            For a radius that is not positive, beyond that at which the contact begins, or beyond
            120 times the thickness of the (top) layer.
        NoContactError
            For a load or penetration that overflows a float.
        """
        return cohesive_states(evaluate(self._native.without_contact, errors, outer_radius=c))

    def branch(self, contact_radii: tuple[float, float], count: int = 50) -> CohesiveStates:
        """Return the states at radii that are evenly spaced in their logarithm.

        Parameters
        ----------
        contact_radii : tuple of float
            The first and the last contact radius, m.
        count : int
            The number of states, from 2 to 1,000,000.
        """
        first, last = contact_radii
        ends = [number("contact radius", first), number("contact radius", last)]
        whole = integer("number of radii", count, 2, 1_000_001)
        return CohesiveStates(*self._native.branch(ends, whole))

    def pull_off(self, *, control: Control = "load") -> CohesiveState:
        """Return the last stable state of a separation.

        It may be a state before the contact, of radius 0: a long range holds the surface up after
        the contact has closed.

        Parameters
        ----------
        control : {"load", "displacement"} or Spring
            What is imposed.
        """
        return CohesiveState(*self._native.pull_off(native_control(control)))

    def pressure(self, a: float, r: ArrayLike) -> Any:
        """Return the pressure inside a contact, Pa, positive in compression.

        Parameters
        ----------
        a : float
            Contact radius, m.
        r : array_like
            Distances from the axis, m, from 0 to ``a``, where the pressure is -w/z0.
        """
        return _field(self._native.pressure, a, r)

    def gap(self, a: float, r: ArrayLike) -> Any:
        """Return the gap outside a contact, m.

        Parameters
        ----------
        a : float
            Contact radius, m.
        r : array_like
            Distances from the axis, m, from ``a`` to twice the outer radius of the attraction.
        """
        return _field(self._native.gap, a, r)


def _field(native: Callable[..., Array], a: float, r: ArrayLike) -> Any:
    """Return a field of the contact of radius ``a`` at distances from the axis."""
    radii = real("r", r)
    flat = np.ascontiguousarray(radii).reshape(-1)
    with located("radius", radii):
        return scalar_or_array(native(number("a", a), flat).reshape(radii.shape))
