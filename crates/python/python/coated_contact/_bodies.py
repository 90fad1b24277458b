"""Probe, film and substrate in SI units."""

from __future__ import annotations

from dataclasses import InitVar, dataclass
from typing import Any, final

from . import _core
from ._magnitudes import warn_of
from ._probe import Paraboloid, Probe, Sphere, probe_of, with_radius
from ._values import Native, set_field, set_number, set_numbers


def check_solid(name: str, value: object) -> None:
    """Refuse what is not a solid."""
    if not isinstance(value, Elastic):
        raise TypeError(f"{name} must be an Elastic, not {type(value).__name__}")


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Elastic:
    """An isotropic elastic solid.

    Parameters
    ----------
    young_modulus : float
        Young's modulus, Pa; infinity is rigid.
    poisson_ratio : float
        Poisson ratio, above -1 and at most 0.5.

    Examples
    --------
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> print(f"{glass.reduced_modulus:.4e} Pa")
    6.6667e+10 Pa
    """

    young_modulus: float
    poisson_ratio: float

    def __post_init__(self) -> None:
        set_numbers(self, "young_modulus", "poisson_ratio")
        _core.check_elastic(self.young_modulus, self.poisson_ratio)

    @property
    def reduced_modulus(self) -> float:
        """The reduced modulus E/(1 - nu^2), Pa."""
        return _core.check_elastic(self.young_modulus, self.poisson_ratio)

    def _numbers(self) -> tuple[float, float]:
        return self.young_modulus, self.poisson_ratio


@dataclass(frozen=True, init=False, slots=True)
class UnderProbe(Native):
    """What ``System``, ``HalfSpace`` and ``StackSystem`` have in common: the probe.

    A length or a modulus that no contact has is warned of, see ``MagnitudeWarning``.

    ``dataclasses.replace(system, sphere_radius=R)`` gives the sphere or the paraboloid of the
    system another radius.
    """

    probe: Probe
    sphere_modulus: float
    # `dataclasses.replace` passes the value of this attribute to the new instance, which so knows
    # the probe that was not asked for.
    _replaced: InitVar[Probe | None]

    @property
    def _replaced(self) -> Probe:
        return self.probe

    @property
    def sphere_radius(self) -> float | None:
        """The radius R of the sphere or of its paraboloid, m; None for another probe."""
        return self.probe.radius if isinstance(self.probe, Paraboloid | Sphere) else None

    def _set_probe(
        self,
        probe: Probe | None,
        sphere_radius: float | None,
        sphere_modulus: float,
        replaced: Probe | None,
    ) -> tuple[Any, float]:
        """Set the probe and its modulus, and return them as the native part takes them."""
        if sphere_radius is not None and replaced is not None and probe is replaced:
            probe, sphere_radius = with_radius(replaced, sphere_radius), None
        chosen = probe_of(probe, sphere_radius)
        set_field(self, "probe", chosen)
        return chosen._native, set_number(self, "sphere_modulus", sphere_modulus)

    def _set_native(self, native: Any) -> None:
        """Set the native part, and warn of what no contact has."""
        set_field(self, "_native", native)
        warn_of(native.magnitudes())


@final
@dataclass(frozen=True, init=False, slots=True)
class System(UnderProbe):
    """Probe, film and substrate.

    Parameters
    ----------
    probe : Probe
        The shape of the probe, such as ``Sphere(radius=1e-3)`` or ``Cone(half_angle=1.2)``.
    sphere_radius : float
        In place of ``probe``: the radius R, m, of the paraboloid that JKR and Barthel's model put
        in place of a sphere.
    sphere_modulus : float
        Reduced modulus E2* = E2/(1 - nu2^2) of the sphere, or of any other probe, Pa, at most
        1e25; infinity is a rigid one.
    film : Elastic
        The film (body 1).
    film_thickness : float
        Thickness t of the film, m.
    substrate : Elastic
        The substrate (body 0).

    Raises
    ------
    InputError
        For a length or modulus that is not positive, or a rigid film.

    Examples
    --------
    >>> from coated_contact import Cone, Table
    >>> gel = Elastic(young_modulus=2e4, poisson_ratio=0.5)
    >>> glass = Elastic(young_modulus=5e10, poisson_ratio=0.2)
    >>> system = System(probe=Cone(half_angle=1.2), sphere_modulus=float("inf"), film=gel,
    ...                 film_thickness=1e-5, substrate=glass)
    >>> pull_off = Table.embedded().contact(system).pull_off(1e-4, control="displacement")
    >>> print(f"{pull_off.load:.2e} N")
    -1.21e-11 N
    """

    film: Elastic
    film_thickness: float
    substrate: Elastic

    def __init__(
        self,
        *,
        probe: Probe | None = None,
        sphere_radius: float | None = None,
        sphere_modulus: float,
        film: Elastic,
        film_thickness: float,
        substrate: Elastic,
        _replaced: Probe | None = None,
    ) -> None:
        check_solid("film", film)
        check_solid("substrate", substrate)
        touching = self._set_probe(probe, sphere_radius, sphere_modulus, _replaced)
        set_field(self, "film", film)
        film_thickness = set_number(self, "film_thickness", film_thickness)
        set_field(self, "substrate", substrate)
        native = _core.Coated(*touching, film._numbers(), film_thickness, substrate._numbers())
        self._set_native(native)

    def without_film(self) -> HalfSpace:
        """Return the probe of this system on the bare substrate."""
        return HalfSpace(probe=self.probe, sphere_modulus=self.sphere_modulus, solid=self.substrate)


@final
@dataclass(frozen=True, init=False, slots=True)
class HalfSpace(UnderProbe):
    """A probe on a half-space without a film: the system of JKR, which needs no table.

    Parameters
    ----------
    probe : Probe
        The shape of the probe.
    sphere_radius : float
        In place of ``probe``: the radius R, m, of the paraboloid of JKR.
    sphere_modulus : float
        Reduced modulus E2* = E2/(1 - nu2^2) of the sphere, or of any other probe, Pa, at most
        1e25; infinity is a rigid one.
    solid : Elastic
        The solid that fills the half-space.

    Raises
    ------
    InputError
        For a length or modulus that is not positive, or a rigid sphere on a rigid solid.
    """

    solid: Elastic

    def __init__(
        self,
        *,
        probe: Probe | None = None,
        sphere_radius: float | None = None,
        sphere_modulus: float,
        solid: Elastic,
        _replaced: Probe | None = None,
    ) -> None:
        check_solid("solid", solid)
        touching = self._set_probe(probe, sphere_radius, sphere_modulus, _replaced)
        set_field(self, "solid", solid)
        self._set_native(_core.HalfSpace(*touching, solid._numbers()))

    @property
    def compound_modulus(self) -> float:
        """The compound modulus E* of sphere and solid, Pa: 1/E* = (1 - nu2^2)/E2 + (1 - nu^2)/E."""
        return self._native.compound_modulus()
