"""Numbers that compare a contact with the assumptions of the model."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True, slots=True, eq=False)
class Validity:
    """The geometry of a contact, compared with the assumptions of the model.

    Each number has the shape of the contact radii given.

    Attributes
    ----------
    a_over_r : float or numpy.ndarray
        Contact radius over sphere radius. The model replaces the sphere by a paraboloid. The
        adhesionless penetration of a true rigid sphere is larger by the part ``(a/R)^2 / 3`` and
        more (Sneddon, Int. J. Eng. Sci. 3, 47, 1965).
    a_over_t : float, numpy.ndarray or None
        Contact radius over film thickness, the degree of confinement; None on a half-space.
    compressibility : float, numpy.ndarray or None
        ``(3/16) (1 - 2 nu1)/(1 - nu1) (a/t)^2``: the stiffness of a thin film whose volume is fixed
        over that of one that cannot move sideways (Johnson, *Contact Mechanics*, 5.8). Above 1 a
        thin film deforms by a change of its volume; below 1 it behaves as incompressible.
    in_range : bool, numpy.ndarray or None
        Whether a/t is between the nodes of the table. Beyond them an expansion is used.
    """

    a_over_r: Any
    a_over_t: Any
    compressibility: Any
    in_range: Any

    @property
    def is_large_contact(self) -> Any:
        """Whether a/R is above 0.1, where the paraboloid changes the penetration by 0.3 %."""
        return _plain(np.greater(self.a_over_r, 0.1))

    @property
    def is_confined(self) -> Any:
        """Whether the film is thin beside the contact and can only yield sideways.

        That is, a/t is above 1 and ``compressibility`` below 1. Under tension a soft film of this
        kind may cavitate or finger, which the model does not describe. None on a half-space.
        """
        if self.a_over_t is None:
            return None
        return _plain(np.greater(self.a_over_t, 1.0) & np.less(self.compressibility, 1.0))


@dataclass(frozen=True, slots=True, eq=False)
class AdhesionRange:
    """The range of the attraction, compared with the JKR limit, in which it is zero.

    Attributes
    ----------
    tabor : float or numpy.ndarray
        Tabor's parameter ``(R w^2 / (Es*^2 z0^3))^(1/3)``, with the compound modulus Es* of sphere
        and film.
    cohesive_zone : float or numpy.ndarray
        The length (m) outside the contact in which the attraction acts, ``(pi/4) Es* z0^2 / w``
        (Maugis, J. Colloid Interface Sci. 150, 243, 1992).
    """

    tabor: Any
    cohesive_zone: Any

    @property
    def is_jkr(self) -> Any:
        """Whether Tabor's parameter is 5 or more, from which JKR holds."""
        return _plain(np.greater_equal(self.tabor, 5.0))

    def is_short_beside(self, length: float) -> Any:
        """Return whether the cohesive zone is at most a tenth of a length (m)."""
        return _plain(np.less_equal(self.cohesive_zone, 0.1 * length))


def _plain(array: Any) -> Any:
    """Return a bool for an array without dimensions, else the array."""
    return bool(array) if np.ndim(array) == 0 else array
