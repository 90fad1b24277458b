"""Sphere, film and substrate in SI units."""

from __future__ import annotations

from dataclasses import dataclass, fields

from . import _core
from ._arrays import number


def _floats(instance: object) -> None:
    """Turn the numbers of a frozen instance into floats."""
    for field in fields(instance):  # type: ignore[arg-type]
        value = getattr(instance, field.name)
        if not isinstance(value, Elastic):
            object.__setattr__(instance, field.name, number(field.name, value))


def _solid(name: str, value: object) -> None:
    """Refuse what is not a solid."""
    if not isinstance(value, Elastic):
        raise TypeError(f"{name} must be an Elastic, not {type(value).__name__}")


@dataclass(frozen=True, kw_only=True, slots=True)
class Elastic:
    """An isotropic elastic solid.

    Parameters
    ----------
    young_modulus : float
        Young's modulus, Pa; infinity is rigid.
    poisson_ratio : float
        Poisson ratio, above -1 and at most 0.5.

    Raises
    ------
    UnphysicalError
        For other values.

    Examples
    --------
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> print(f"{glass.reduced_modulus:.4e} Pa")
    6.6667e+10 Pa
    """

    young_modulus: float
    poisson_ratio: float

    def __post_init__(self) -> None:
        _floats(self)
        _core.check_elastic(self.young_modulus, self.poisson_ratio)

    @property
    def reduced_modulus(self) -> float:
        """The reduced modulus E/(1 - nu^2), Pa."""
        return _core.check_elastic(self.young_modulus, self.poisson_ratio)


@dataclass(frozen=True, kw_only=True, slots=True)
class System:
    """Sphere, film and substrate.

    Parameters
    ----------
    sphere_radius : float
        Radius R of the sphere, m.
    sphere_modulus : float
        Reduced modulus E2* = E2/(1 - nu2^2) of the sphere, Pa; infinity is a rigid sphere.
    film : Elastic
        The film (body 1).
    film_thickness : float
        Thickness t of the film, m.
    substrate : Elastic
        The substrate (body 0).

    Raises
    ------
    UnphysicalError
        For a length or modulus that is not positive, or a rigid film.
    """

    sphere_radius: float
    sphere_modulus: float
    film: Elastic
    film_thickness: float
    substrate: Elastic

    def __post_init__(self) -> None:
        _solid("film", self.film)
        _solid("substrate", self.substrate)
        _floats(self)
        _core.check_system(self._numbers())

    def without_film(self) -> HalfSpace:
        """Return the sphere of this system on the bare substrate."""
        return HalfSpace(
            sphere_radius=self.sphere_radius,
            sphere_modulus=self.sphere_modulus,
            solid=self.substrate,
        )

    def _numbers(self) -> tuple[float, ...]:
        film, substrate = self.film, self.substrate
        return (
            self.sphere_radius,
            self.sphere_modulus,
            film.young_modulus,
            film.poisson_ratio,
            self.film_thickness,
            substrate.young_modulus,
            substrate.poisson_ratio,
        )


@dataclass(frozen=True, kw_only=True, slots=True)
class HalfSpace:
    """A sphere on a half-space without a film: the system of JKR, which needs no table.

    Parameters
    ----------
    sphere_radius : float
        Radius R of the sphere, m.
    sphere_modulus : float
        Reduced modulus E2* = E2/(1 - nu2^2) of the sphere, Pa; infinity is a rigid sphere.
    solid : Elastic
        The solid that fills the half-space.

    Raises
    ------
    UnphysicalError
        For a radius or modulus that is not positive, or a rigid sphere on a rigid solid.
    """

    sphere_radius: float
    sphere_modulus: float
    solid: Elastic

    def __post_init__(self) -> None:
        _solid("solid", self.solid)
        _floats(self)
        _core.check_half_space(self._numbers())

    @property
    def compound_modulus(self) -> float:
        """The compound modulus E* of sphere and solid, Pa: 1/E* = (1 - nu2^2)/E2 + (1 - nu^2)/E."""
        return _core.check_half_space(self._numbers())

    def _numbers(self) -> tuple[float, ...]:
        solid = self.solid
        return (
            self.sphere_radius,
            self.sphere_modulus,
            solid.young_modulus,
            solid.poisson_ratio,
        )
