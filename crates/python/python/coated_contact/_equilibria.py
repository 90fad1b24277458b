"""The equilibria of a contact under a load, a penetration or a spring."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

from numpy.typing import ArrayLike

from ._arrays import Errors, evaluate, number
from ._control import Control, native_control
from ._magnitudes import warn_of_work
from ._results import Equilibrium, ForceDisplacement, Jump, State, States, states

if TYPE_CHECKING:
    from ._contact import Contact


@dataclass(frozen=True, kw_only=True, slots=True)
class Equilibria:
    """The equilibria of a contact with one work of adhesion under one control.

    ``Contact.equilibria`` makes it. An imposed value is a load (N), a penetration (m) or a position
    of the spring (m), positive in compression. An equilibrium is stable where the imposed value
    grows with the contact radius. States are sought among the radii of
    ``Contact.contact_radius_range``.

    Parameters
    ----------
    contact : Contact
        The contact.
    work_of_adhesion : float
        Work of adhesion, J/m^2.
    control : {"load", "displacement"} or Spring
        What is imposed.

    Examples
    --------
    >>> from coated_contact import Contact, Elastic, HalfSpace
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
    >>> equilibria = Contact.half_space(system).equilibria(0.04)
    >>> [equilibrium.stable for equilibrium in equilibria.at(-1e-4)]
    [False, True]
    >>> print(f"{equilibria.unloading(0.0).contact_radius:.4e} m")  # (9 pi w R^2 / (2 E*))^(1/3)
    6.5635e-05 m
    """

    contact: Contact
    work_of_adhesion: float
    control: Control

    def __post_init__(self) -> None:
        w = number("work of adhesion", self.work_of_adhesion)
        object.__setattr__(self, "work_of_adhesion", w)
        self._native.check_equilibria(w, native_control(self.control))
        warn_of_work(w)

    @property
    def _native(self) -> Any:
        return self.contact._native

    def at(self, imposed: float) -> list[Equilibrium]:
        """Return all equilibria at an imposed value, in ascending order of contact radius.

        There are none beyond pull-off.
        """
        found = self._native.equilibria_at(
            self.work_of_adhesion, native_control(self.control), number("imposed", imposed)
        )
        return [Equilibrium(State(*numbers), stable) for numbers, stable in found]

    @overload
    def loading(self, imposed: float, *, errors: Errors = "raise") -> State: ...
    @overload
    def loading(self, imposed: ArrayLike, *, errors: Errors = "raise") -> States: ...
    def loading(self, imposed: ArrayLike, *, errors: Errors = "raise") -> State | States:
        """Return the stable state that loading reaches, that of the smallest contact radius.

        There is none at a negative value, at which the sphere does not touch yet.
        """
        return self._branch("loading", imposed, errors)

    @overload
    def unloading(self, imposed: float, *, errors: Errors = "raise") -> State: ...
    @overload
    def unloading(self, imposed: ArrayLike, *, errors: Errors = "raise") -> States: ...
    def unloading(self, imposed: ArrayLike, *, errors: Errors = "raise") -> State | States:
        """Return the stable state that unloading reaches, that of the largest contact radius.

        There is none at a value below that of the pull-off.
        """
        return self._branch("unloading", imposed, errors)

    def pull_off(self) -> State:
        """Return the state in which the contact finally separates on unloading."""
        return self.contact.pull_off(self.work_of_adhesion, control=self.control)

    def force_displacement(self, *, most: float, points: int = 200) -> ForceDisplacement:
        """Return loading up to the imposed value ``most`` and unloading, as ``Contact`` does."""
        loading, unloading, jumps = self._native.force_displacement(
            self.work_of_adhesion,
            native_control(self.control),
            number("most", most),
            operator.index(points),
        )
        return ForceDisplacement(
            loading=tuple(States(*branch) for branch in loading),
            unloading=tuple(States(*branch) for branch in unloading),
            jumps=tuple(
                Jump(State(*before), None if after is None else State(*after))
                for before, after in jumps
            ),
        )

    def _branch(
        self, branch: Literal["loading", "unloading"], imposed: ArrayLike, errors: Errors
    ) -> State | States:
        control = native_control(self.control)
        return states(
            evaluate(
                lambda points, values: self._native.states(
                    points, values, self.work_of_adhesion, control, branch
                ),
                errors,
                imposed=imposed,
            )
        )
