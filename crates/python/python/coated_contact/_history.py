"""Contacts in time where the bodies relax."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import located, number, paired, real, scalar_or_array
from ._columns import Array, TimedColumns
from ._control import Control, Spring, native_control
from ._errors import InputError
from ._values import set_field, set_numbers

if TYPE_CHECKING:
    import pandas
    import xarray

    from ._contact import Contact


# The laws, each with the field that has no effect in it.
WITHOUT_EFFECT = {
    "prony": "exponent",
    "power_law": "relaxed",
    "modified_power_law": None,
    "fractional_zener": None,
}


@dataclass(frozen=True, slots=True)
class Relaxation:
    """How Young's modulus falls after a step of the strain: ``E(t) = E_ref phi(t)``.

    The Poisson ratio is constant. The modulus of a contact is ``E_ref``: the instantaneous one, and
    under a power law that at its ``time``. Make one with :meth:`prony`, :meth:`power_law`,
    :meth:`modified_power_law` or :meth:`fractional_zener`.

    A gel also relaxes by flow of its solvent, which is no law of the material: its time grows like
    the square of the contact radius. Measurements at two radii tell.

    Examples
    --------
    >>> law = Relaxation.power_law(exponent=0.2, time=1.0)
    >>> float(law.modulus(1.0))
    1.0
    >>> storage, loss = law.complex(10.0)
    >>> round(float(loss / storage), 6)  # tan(pi exponent/2) at every frequency
    0.32492
    """

    law: str
    relaxed: float = 0.0
    exponent: float = 0.0
    times: tuple[float, ...] = ()
    weights: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.law, str) or self.law not in WITHOUT_EFFECT:
            laws = ", ".join(f'"{law}"' for law in WITHOUT_EFFECT)
            raise InputError(f"law = {self.law!r} cannot be used: give one of {laws}", axis="law")
        set_numbers(self, "relaxed", "exponent")
        for name in ("times", "weights"):
            row = np.atleast_1d(real(name, getattr(self, name))).ravel()
            set_field(self, name, tuple(row.tolist()))
        times, weights = len(self.times), len(self.weights)
        if self.law == "prony" and weights != times:
            raise InputError(
                f"there are {weights} weights for {times} times: give one for each", axis="weights"
            )
        if self.law != "prony" and (times, weights) != (1, 0):
            raise InputError(
                f'the law "{self.law}" has one time and no weights, and {times} times and '
                f"{weights} weights are given: give times=(1.0,), or use Relaxation.{self.law}",
                axis="weights" if weights else "times",
            )
        without = WITHOUT_EFFECT[self.law]
        if without and getattr(self, without) != 0.0:
            value = getattr(self, without)
            raise InputError(
                f'{without} = {value!r} has no effect in the law "{self.law}": leave it 0, or make '
                "another law",
                axis=without,
                value=value,
            )
        _core.check_relaxation(self._numbers())

    def _numbers(self) -> tuple[Any, ...]:
        return (self.law, self.relaxed, self.exponent, list(self.times), list(self.weights))

    @classmethod
    def prony(
        cls, relaxed: float, times: ArrayLike, weights: ArrayLike | None = None
    ) -> Relaxation:
        """Return ``relaxed + sum weight exp(-t/time)``; one time is the standard linear solid.

        Parameters
        ----------
        relaxed : float
            The part of the modulus that is left in the end, from 0 to 1.
        times : array_like
            Relaxation times, s.
        weights : array_like, optional
            Their weights, which sum to 1 with ``relaxed``; by default that of one time.
        """
        part = number("relaxed", relaxed)
        several = np.atleast_1d(real("times", times)).ravel()
        if weights is None:
            if several.size != 1:
                raise InputError(
                    f"weights are missing: give one for each of the {several.size} times",
                    axis="weights",
                )
            weights = 1.0 - part
        own = np.atleast_1d(real("weights", weights)).ravel()
        return cls("prony", part, times=tuple(several.tolist()), weights=tuple(own.tolist()))

    @classmethod
    def power_law(cls, exponent: float, time: float = 1.0) -> Relaxation:
        """Return ``(t/time)^-exponent``, with an exponent from 1e-9 to below 1."""
        return cls("power_law", 0.0, number("exponent", exponent), (number("time", time),))

    @classmethod
    def modified_power_law(cls, relaxed: float, exponent: float, time: float) -> Relaxation:
        """Return ``relaxed + (1 - relaxed) (1 + t/time)^-exponent``.

        The exponent is from 1e-9 to below 1.
        """
        numbers = (number("relaxed", relaxed), number("exponent", exponent))
        return cls("modified_power_law", *numbers, (number("time", time),))

    @classmethod
    def fractional_zener(cls, relaxed: float, exponent: float, time: float) -> Relaxation:
        """Return ``relaxed + (1 - relaxed) E(-(t/time)^exponent)`` (Mittag-Leffler).

        The exponent is from 0.001 to 0.99.
        """
        numbers = (number("relaxed", relaxed), number("exponent", exponent))
        return cls("fractional_zener", *numbers, (number("time", time),))

    def modulus(self, time: ArrayLike) -> Any:
        """Return ``E(t)/E_ref`` at times (s) after a step of the strain."""
        return self._at("modulus", "time", time)

    def creep(self, time: ArrayLike) -> Any:
        """Return the creep compliance times ``E_ref`` at times (s) after a step of the stress."""
        return self._at("creep", "time", time)

    def complex(self, omega: ArrayLike) -> tuple[Any, Any]:
        """Return storage and loss modulus over ``E_ref`` at angular frequencies (rad/s)."""
        at = real("omega", omega)
        both = self._values("complex", "omega", at).reshape(-1, 2)
        storage, loss = (scalar_or_array(both[:, i].reshape(at.shape)) for i in (0, 1))
        return storage, loss

    def _at(self, what: str, name: str, where: ArrayLike) -> Any:
        at = real(name, where)
        return scalar_or_array(self._values(what, name, at).reshape(at.shape))

    def _values(self, what: str, name: str, at: Array) -> Array:
        with located(name, at):
            return _core.relaxation_values(self._numbers(), what, at.ravel().tolist())


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class HistoryStates(TimedColumns):
    """The states of a contact in time.

    Attributes
    ----------
    time : numpy.ndarray
        Times, s.
    contact_radius, load, penetration : numpy.ndarray
        Contact radii (m), loads (N) and penetrations (m). Radius and load are 0 without contact.
    phase : numpy.ndarray
        ``"advancing"``, ``"resting"``, ``"receding"`` or ``"separated"``.
    error : float
        The estimated largest error of the columns, in parts of the largest value of each. That of
        the elastic curve adds.
    unlike_bodies : float
        The bound of the error by bodies that do not relax: of the loads, in parts of the largest
        one, or where loads are imposed of the penetrations; 0 without ``rigid``.
    """

    time: Array
    contact_radius: Array
    load: Array
    penetration: Array
    phase: NDArray[np.str_]
    error: float
    unlike_bodies: float

    def _columns(self) -> dict[str, Array]:
        return {
            "time": self.time,
            "contact_radius": self.contact_radius,
            "load": self.load,
            "penetration": self.penetration,
        }

    def to_pandas(self) -> pandas.DataFrame:
        """Return a row for each state, with its phase; needs pandas."""
        return TimedColumns.to_pandas(self).assign(phase=self.phase)

    def to_xarray(self) -> xarray.Dataset:
        """Return a Dataset over ``time``, with the phase of each state; needs xarray."""
        return TimedColumns.to_xarray(self).assign(phase=("time", self.phase))


def history(
    contact: Contact,
    time: ArrayLike,
    relaxation: Relaxation,
    *,
    penetration: ArrayLike | None,
    load: ArrayLike | None,
    height: ArrayLike | None,
    stiffness: float | None,
    at: ArrayLike | None,
    receding: float,
    rigid: Contact | None,
    tolerance: float | None,
) -> HistoryStates:
    """Follow a program; see ``Contact.history``."""
    if not isinstance(relaxation, Relaxation):
        raise TypeError(f"relaxation must be a Relaxation, not {type(relaxation).__name__}")
    given = {"penetration": penetration, "load": load, "height": height}
    imposed = {name: value for name, value in given.items() if value is not None}
    if len(imposed) != 1:
        raise InputError(
            f"give one of penetration, load and height, which is imposed; {len(imposed)} are given"
        )
    ((name, value),) = imposed.items()
    if (name == "height") != (stiffness is not None):
        raise InputError(
            "stiffness and height belong together: give the stiffness (N/m) of the cantilever with "
            "its heights, and none otherwise",
            axis="stiffness",
        )
    control: Control = "load" if name == "load" else "displacement"
    if stiffness is not None:
        control = Spring(stiffness=stiffness)
    paired({"time": time, name: value})
    times, values = real("time", time), real(name, value)
    if times.ndim != 1 or times.shape != values.shape:
        raise InputError(
            f"time and {name} must be rows of one length, and have the shapes {times.shape} and "
            f"{values.shape}"
        )
    asked = times if at is None else np.atleast_1d(real("at", at))
    if asked.ndim != 1:
        raise InputError(f"at must be one time or a row of times, and has the shape {asked.shape}")
    if rigid is not None and type(rigid) is not type(contact):
        raise TypeError(
            "rigid must be the Contact of the same film between a rigid probe and a rigid "
            f"substrate, not {rigid!r}"
        )
    energy = number("receding", receding)
    if energy < 0.0:
        raise InputError(
            f"receding = {energy!r} cannot be used: it must be 0, or the energy of the receding "
            "line, J/m^2",
            axis="receding",
            value=energy,
        )
    order = np.argsort(asked, kind="stable")
    columns, phases, error, unlike = _core.history(
        contact._native,
        relaxation._numbers(),
        native_control(control),
        time=times.tolist(),
        value=values.tolist(),
        at=asked[order].tolist(),
        receding=energy,
        rigid=None if rigid is None else rigid._native,
        tolerance=None if tolerance is None else number("tolerance", tolerance),
    )
    back = np.argsort(order, kind="stable")
    found, radii, loads, depths = (column[back] for column in columns)
    phase = np.array(phases, dtype=np.str_)[back]
    return HistoryStates(found, radii, loads, depths, phase, error, unlike)
