"""The contact line under other laws than a constant work of adhesion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _core
from ._arrays import number
from ._columns import Array, TimedColumns
from ._contact import Contact
from ._control import Control, native_control
from ._errors import InputError
from ._magnitudes import warn_of_work
from ._results import State
from ._values import set_numbers


@dataclass(frozen=True, kw_only=True, slots=True)
class Hysteresis:
    """A law with one energy for a line that advances and another for one that recedes.

    The line is pinned while the energy release rate G is between them.

    Parameters
    ----------
    advancing : float
        The energy that an advancing line gains, J/m^2.
    receding : float
        The energy that a receding line costs, J/m^2; not below ``advancing``.
    """

    advancing: float
    receding: float

    def __post_init__(self) -> None:
        set_numbers(self, "advancing", "receding")
        if self.receding < self.advancing:
            raise InputError(
                f"receding energy = {self.receding!r} is below the advancing one = "
                f"{self.advancing!r}: a receding line costs at least what an advancing one gains",
                axis="receding",
                value=self.receding,
                range=(self.advancing, np.inf),
            )
        _core.check_law(self._numbers())
        warn_of_work(self.receding)

    def _numbers(self) -> tuple[Any, ...]:
        return (self.advancing, self.receding, None)


@dataclass(frozen=True, kw_only=True, slots=True)
class RateDependent:
    """A law whose energies depend on the speed v of the line.

    The line recedes at ``G = receding (1 + (v/v0)^n)`` and advances at
    ``G = advancing / (1 + (|v|/v0)^n)``: the power law for elastomers, with n between 0.1 and 0.8
    (Gent and Schultz, J. Adhes. 3, 281, 1972; Maugis and Barquins, J. Phys. D 11, 1989, 1978; for
    the closing crack Greenwood, J. Phys. D 37, 2557, 2004).

    Parameters
    ----------
    slow : float or Hysteresis
        The work of adhesion of a slow line, J/m^2, or its two energies.
    v0 : float
        The speed at which the energy is doubled or halved, m/s.
    n : float
        The exponent.

    Examples
    --------
    >>> law = RateDependent(slow=0.04, v0=1e-6, n=0.6)
    >>> round(law.energy_release_rate(1e-6), 12), round(law.energy_release_rate(-1e-6), 12)
    (0.08, 0.02)
    """

    slow: float | Hysteresis
    v0: float
    n: float

    def __post_init__(self) -> None:
        if not isinstance(self.slow, Hysteresis):
            object.__setattr__(self, "slow", number("slow", self.slow))
        set_numbers(self, "v0", "n")
        _core.check_law(self._numbers())

    def energy_release_rate(self, speed: float) -> float:
        """Return G (J/m^2) at which the line moves with a speed (m/s, positive when it recedes)."""
        advancing, receding, rate = self._numbers()
        return _core.energy_of_speed((advancing, receding), rate, number("speed", speed))

    def _numbers(self) -> tuple[Any, ...]:
        advancing, receding, _ = law_numbers(self.slow)
        return (advancing, receding, (self.v0, self.n))


Law = float | Hysteresis | RateDependent


def law_numbers(law: Law) -> tuple[Any, ...]:
    """Return a law as the native part takes it; a number is a constant work of adhesion."""
    if isinstance(law, Hysteresis | RateDependent):
        return law._numbers()
    w = number("law", law)
    return (w, w, None)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class TimedStates(TimedColumns):
    """The states of a contact at many times.

    Attributes
    ----------
    time : numpy.ndarray
        Time since the ramp began, s.
    contact_radius : numpy.ndarray
        Contact radii, m.
    load : numpy.ndarray
        Loads, N, positive in compression.
    penetration : numpy.ndarray
        Penetrations, m.
    energy_release_rate : numpy.ndarray
        Energy release rates G, J/m^2.
    """

    time: Array
    contact_radius: Array
    load: Array
    penetration: Array
    energy_release_rate: Array


class ContactLine:
    """A contact with the position of its line, which moves by a law.

    :meth:`impose` changes a load, a penetration or the position of a spring so slowly that the line
    is at rest all the time. :meth:`ramp` changes it in a given time. Both change ``state``.

    Parameters
    ----------
    contact : Contact
        The contact.
    law : float, Hysteresis or RateDependent
        The law of the line; a number is a constant work of adhesion, J/m^2.
    contact_radius : float
        The radius (m) to which the contact has slowly grown.

    Attributes
    ----------
    contact : Contact
        The contact.
    law : float, Hysteresis or RateDependent
        The law.
    state : State or None
        The present state; None after the contact has separated. It does not form again.

    Examples
    --------
    >>> from coated_contact import Contact, Elastic, HalfSpace
    >>> solid = Elastic(young_modulus=2e11, poisson_ratio=0.25)
    >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=solid)
    >>> line = Contact.half_space(system).line(Hysteresis(advancing=0.03, receding=0.05), 50e-6)
    >>> loaded = line.impose("load", 1e-3)
    >>> unloaded = line.impose("load", 0.8e-3)
    >>> unloaded.contact_radius == loaded.contact_radius  # pinned
    True
    >>> line.impose("load", -0.3e-3) is None  # pulled off
    True
    """

    contact: Contact
    law: Law
    state: State | None

    def __init__(self, contact: Contact, law: Law, contact_radius: float) -> None:
        self.contact, self.law = contact, law
        radius = number("contact_radius", contact_radius)
        self.state = State(*_core.line(contact._native, law_numbers(law), radius))

    def impose(self, control: Control, value: float) -> State | None:
        """Bring the load (N), penetration (m) or position of the spring (m) slowly to a value.

        The line does not move while G is between the two energies of the law at rest. Outside them
        it moves to the nearest stable equilibrium, possibly by a jump. Without one the contact
        separates.

        Parameters
        ----------
        control : {"load", "displacement"} or Spring
            What is imposed.
        value : float
            The imposed value.

        Returns
        -------
        State or None
            The new state; None after the contact has separated.

        Raises
        ------
        NoContactError
            Where the line may leave the table. The state is then that before the call.
        """
        found = _core.impose(*self._native(), native_control(control), number("value", value))
        self.state = None if found is None else State(*found)
        return self.state

    def ramp(
        self, control: Control, value: float, *, duration: float, tolerance: float = 1e-6
    ) -> TimedStates:
        """Bring the load (N), penetration (m) or position of the spring (m) to a value in a time.

        The rate is constant; the sphere has no inertia. To hold a value, impose the present one.

        Parameters
        ----------
        control : {"load", "displacement"} or Spring
            What is imposed.
        value : float
            The imposed value at the end.
        duration : float
            The time, s.
        tolerance : float
            The largest error in one step, 1e-10 to 1e-2, relative to the first radius and to the
            duration.

        Returns
        -------
        TimedStates
            The states to the end of the ramp, or to the separation, after which ``state`` is None.

        Raises
        ------
        InputError
            For a law without finite speeds, which only :meth:`impose` can follow, and for a
            tolerance out of range.
        NoContactError
            Where the line leaves the table. The state is then that before the call.
        ContactError
            Where the ramp is too slow for the solver; :meth:`impose` is accurate there.
        """
        columns, last = _core.ramp(
            *self._native(),
            native_control(control),
            value=number("value", value),
            duration=number("duration", duration),
            tolerance=number("tolerance", tolerance),
        )
        self.state = None if last is None else State(*last)
        return TimedStates(*columns)

    def _native(self) -> tuple[Any, ...]:
        state = self.state
        numbers = state and (state.contact_radius, state.load, state.penetration)
        return self.contact._native, law_numbers(self.law), numbers

    def __repr__(self) -> str:
        return f"<ContactLine {self.law!r}, {self.state!r}>"
