"""What is imposed on a contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ._arrays import number
from ._errors import InputError


@dataclass(frozen=True, kw_only=True, slots=True)
class Spring:
    """A spring in series with the contact, such as a cantilever.

    The position delta + F/k (m) of its far end is imposed. It is 0 where the sphere would just
    touch.

    Parameters
    ----------
    stiffness : float
        The stiffness k of the spring, N/m, from 1e-100 to 1e100.
    """

    stiffness: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "stiffness", number("stiffness of the spring", self.stiffness))


Control = Literal["load", "displacement"] | Spring


def native_control(control: Control) -> tuple[str, float]:
    """Return a control as the native part takes it."""
    if isinstance(control, Spring):
        return "spring", control.stiffness
    if control in ("load", "displacement"):
        return control, 0.0
    raise InputError(
        f'control = {control!r} cannot be used: give "load", "displacement" or Spring(stiffness=k)',
        axis="control",
        allowed='"load", "displacement" or Spring(stiffness=k)',
    )


def check_friction(friction: str, sphere_poisson_ratio: float, advancing: float) -> None:
    """Refuse numbers of friction where there is none."""
    if friction == "none" and (sphere_poisson_ratio, advancing) != (0.5, 1.0):
        raise InputError(
            "sphere_poisson_ratio and advancing have no effect without friction: give "
            'friction="stick", or leave them out',
            axis="friction",
        )
