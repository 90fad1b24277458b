"""The shape of the probe."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import real, scalar_or_array
from ._values import Native, set_field, set_numbers


@dataclass(frozen=True, kw_only=True, slots=True)
class Probe(Native):
    """The shape of a probe: the height f(r) of its surface above its lowest point.

    Here r is the distance from the axis. The shapes are :class:`Paraboloid`, :class:`Sphere`,
    :class:`PowerLaw`, :class:`Cone`, :class:`RoundedCone`, :class:`FlatPunch`,
    :class:`FlatEndedCone` and :class:`Profile`. Only the contact without adhesion depends on the
    shape; film, substrate and the elasticity of the probe enter as for a sphere. All shapes are
    convex, such that a contact is one disc; rounded numbers of a straight flank are taken.

    A shape whose lengths or angle cannot be raises an InputError.
    """

    #: The name in words.
    name: ClassVar[str]

    def __post_init__(self) -> None:
        if type(self) is Probe:
            raise TypeError("choose a shape, such as Sphere(radius=1e-3)")
        names = [one.name for one in fields(self) if one.init]
        set_numbers(self, *names)
        numbers = np.array([getattr(self, name) for name in names])
        set_field(self, "_native", _core.Probe(self.name, numbers))

    def height(self, r: ArrayLike) -> Any:
        """Return the heights f (m) at the distances ``r`` (m) from the axis, of their shape.

        They are infinite where the probe has no surface: beyond the radius of a sphere or a punch
        and beyond the last point of a profile.
        """
        at = np.abs(real("r", r))
        return scalar_or_array(np.where(np.isnan(at), at, self._height(at)))

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        raise NotImplementedError


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Paraboloid(Probe):
    """The paraboloid ``f = r^2/(2 R)``, which JKR and Barthel's model put in place of a sphere.

    Parameters
    ----------
    radius : float
        The radius of curvature R, m.
    """

    name = "paraboloid"
    radius: float

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        return r * r / (2 * self.radius)


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Sphere(Probe):
    """The sphere itself, ``f = R - sqrt(R^2 - r^2)``.

    On a film contacts up to 0.55 R are computed, load and penetration to 1e-6.

    Parameters
    ----------
    radius : float
        The radius R, m.
    """

    name = "sphere"
    radius: float

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        s = np.minimum(r / self.radius, 1.0)
        # 1 - sqrt(1 - s^2) without cancellation.
        height = self.radius * s * s / (1 + np.sqrt((1 - s) * (1 + s)))
        return np.where(r <= self.radius, height, np.inf)


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class PowerLaw(Probe):
    """The power law ``f = c r^n``.

    Parameters
    ----------
    coefficient : float
        The coefficient c, in m to the power 1 - n.
    exponent : float
        The exponent n, any number from 1 to 20.
    """

    name = "power law"
    coefficient: float
    exponent: float

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        return self.coefficient * r**self.exponent


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Cone(Probe):
    """The cone ``f = r cot(half_angle)``.

    Parameters
    ----------
    half_angle : float
        The angle between the axis and the flank, RADIANS, between 0 and pi/2.
    """

    name = "cone"
    half_angle: float

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        return r / np.tan(self.half_angle)


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class RoundedCone(Probe):
    """A cone with a round end.

    ``f = r^2/(2 R)`` up to ``r = R cot(half_angle)``, where the flank of the cone continues it with
    the same slope.

    Parameters
    ----------
    radius : float
        The radius of curvature R of the end, m.
    half_angle : float
        The angle between the axis and the flank, RADIANS, between 0 and pi/2.
    """

    name = "rounded cone"
    radius: float
    half_angle: float

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        slope = 1 / np.tan(self.half_angle)
        end = np.minimum(r, self.radius * slope)
        return end * end / (2 * self.radius) + (r - end) * slope


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class FlatPunch(Probe):
    """A flat cylindrical punch, whose contact has one radius: that of the punch.

    Parameters
    ----------
    radius : float
        The radius of the punch, m.
    """

    name = "flat punch"
    radius: float

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.where(r <= self.radius, 0.0, np.inf)


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class FlatEndedCone(Probe):
    """A cone with a flat end: ``f = 0`` up to its radius, ``(r - radius) cot(half_angle)`` beyond.

    Parameters
    ----------
    radius : float
        The radius of the flat end, m. A contact is at least as large.
    half_angle : float
        The angle between the axis and the flank, RADIANS, between 0 and pi/2.
    """

    name = "flat-ended cone"
    radius: float
    half_angle: float

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.maximum(r - self.radius, 0.0) / np.tan(self.half_angle)


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Profile(Probe):
    """A measured shape with rotational symmetry.

    The slope of the shape is 0 on the axis, that of the straight line between two points midway
    between them, and a linear function of the distance in between. Evenly spaced points of a
    paraboloid give the paraboloid. At the edge of a flat end the slope rises within the distance
    to the nearer of the points beside it.

    Parameters
    ----------
    points : array_like
        Rows of the distance from the axis, ascending, and of the height above the lowest point, m:
        2 to 200 points of a convex shape. It becomes a tuple of pairs.

    Raises
    ------
    InputError
        For points that are no convex shape, with the number of the row, from 1.
    """

    name = "profile"
    points: Any

    def __post_init__(self) -> None:
        points = real("points", self.points)
        if points.ndim != 2 or points.shape[1] != 2:
            raise TypeError(f"points must have two columns, r and z, not the shape {points.shape}")
        set_field(self, "points", tuple((float(r), float(z)) for r, z in points))
        set_field(self, "_native", _core.Probe(self.name, np.ravel(points)))

    def _height(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        points = np.array(self.points)
        if points[0, 0] > 0:
            points = np.vstack([np.zeros(2), points])
        distances, heights = points.T
        # Where the slope bends, the slopes there, and the heights: their integral.
        bends = np.append(0.0, 0.5 * (distances[:-1] + distances[1:]))
        slopes = np.append(0.0, np.diff(heights) / np.diff(distances))
        # They may fall by the rounding of text, and are taken as the steepest before.
        slopes = np.maximum.accumulate(slopes)
        steps = np.diff(bends)
        at_bends = np.append(0.0, np.cumsum(0.5 * (slopes[:-1] + slopes[1:]) * steps))
        inside = np.minimum(r, distances[-1])
        # Beyond the last bend the slope goes on as before it.
        i = np.clip(np.searchsorted(bends, inside, side="right") - 1, 0, len(steps) - 1)
        s = inside - bends[i]
        height = at_bends[i] + s * (slopes[i] + 0.5 * s * (np.diff(slopes) / steps)[i])
        return np.where(r <= distances[-1], height, np.inf)


def probe_of(probe: Probe | None, sphere_radius: float | None) -> Probe:
    """Return the probe of an instance that is given by it or by the radius of a sphere."""
    if sphere_radius is not None:
        if probe is not None:
            raise TypeError(
                "probe and sphere_radius are both given: give one of them; sphere_radius=R is "
                "short for probe=Paraboloid(radius=R)"
            )
        return Paraboloid(radius=sphere_radius)
    if not isinstance(probe, Probe):
        given = "nothing" if probe is None else type(probe).__name__
        raise TypeError(
            f"probe must be a Probe, such as Sphere(radius=1e-3), not {given}; sphere_radius=R is "
            "short for probe=Paraboloid(radius=R)"
        )
    return probe


def with_radius(probe: Probe, sphere_radius: float) -> Probe:
    """Return a sphere or a paraboloid with another radius; refuse other probes."""
    if not isinstance(probe, Paraboloid | Sphere):
        raise TypeError(
            f"sphere_radius is the radius of a Paraboloid or a Sphere, and the probe is a "
            f"{type(probe).__name__}: replace the probe, probe=..."
        )
    return replace(probe, radius=sphere_radius)
