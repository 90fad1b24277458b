"""Stacks of layers on an elastic or rigid base."""

from __future__ import annotations

import operator
import os
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any, final

from . import _core
from ._bodies import Elastic, check_solid
from ._errors import StackError
from ._probe import Probe, probe_of, radius_of
from ._values import Remade, set_field, set_number, set_numbers

if TYPE_CHECKING:
    from ._contact import Contact


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Layer:
    """One layer of a stack.

    Parameters
    ----------
    material : Elastic
        The solid.
    thickness : float
        The thickness, m.
    name : str, optional
        A name for messages.
    """

    material: Elastic
    thickness: float
    name: str | None = None

    def __post_init__(self) -> None:
        check_solid("material", self.material)
        set_numbers(self, "thickness")


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Stack(Remade):
    """Layers on a base, perfectly bonded.

    Layers are counted from the base up: the first one is bonded to the base, and the probe touches
    the last one. They enter through the compliance of the surface alone, and a/t of a stack is the
    contact radius over the sum of all thicknesses. Stacks are solved directly: no table holds them.

    Parameters
    ----------
    base : Elastic
        The base; an infinite Young's modulus is rigid.
    layers : iterable of Layer
        The layers from the base up. It becomes a tuple.
    surface : Elastic, optional
        The solid that the probe touches, where it is not that of the top layer: :meth:`graded`
        gives it.

    Raises
    ------
    StackError
        Without a layer; for a thickness that is not positive and finite, a rigid layer, or a
        Young's modulus more than 1e9 times that of another body.

    Examples
    --------
    >>> primer = Elastic(young_modulus=0.5e6, poisson_ratio=0.5)
    >>> elastomer = Elastic(young_modulus=3.5e6, poisson_ratio=0.5)
    >>> stack = Stack(
    ...     base=Elastic(young_modulus=2e11, poisson_ratio=0.25),
    ...     layers=[Layer(material=primer, thickness=2.5e-6, name="primer"),
    ...             Layer(material=elastomer, thickness=7.5e-6)],
    ... )
    >>> contact = stack.contact(sphere_radius=1e-3, sphere_modulus=2e6, a_over_t=(0.1, 20))
    >>> print(f"{contact.load(65e-6, 0.04):.3e} N, {contact.pull_off(0.04).load:.3e} N")
    -4.684e-05 N, -1.955e-04 N
    """

    base: Elastic
    layers: tuple[Layer, ...]
    surface: Elastic | None = None
    _native: Any = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        check_solid("base", self.base)
        set_field(self, "layers", tuple(self.layers))
        for layer in self.layers:
            if not isinstance(layer, Layer):
                raise TypeError(f"layers must be Layer, not {type(layer).__name__}")
        names = [layer.name for layer in self.layers if layer.name is not None]
        for name in names:
            if names.count(name) > 1:
                raise StackError(f"two layers have the name {name!r}: give another", axis="name")
        if self.surface is not None:
            check_solid("surface", self.surface)
        native = _core.Stack(
            self.base._numbers(),
            [(layer.material._numbers(), layer.thickness) for layer in self.layers],
            None if self.surface is None else self.surface._numbers(),
        )
        set_field(self, "_native", native)

    @classmethod
    def graded(
        cls,
        *,
        base: Elastic,
        thickness: float,
        count: int,
        material: Callable[[float], Elastic],
    ) -> Stack:
        """Make a film whose material changes with the height above the base.

        It has sublayers of equal thickness, each of the solid at its middle height. The error falls
        with the square of their number: for an exponential gradient of 20:1 on a base like its
        lower face, 40 sublayers give at most 6.1e-4, 4.1e-4 and 6.4e-5 at a/t of 0.3, 1 and 5.

        Parameters
        ----------
        base : Elastic
            The base.
        thickness : float
            The thickness of the film, m.
        count : int
            The number of sublayers.
        material : callable
            Takes the height above the base, m, and returns the solid there.

        Examples
        --------
        >>> def material(height):
        ...     return Elastic(young_modulus=1e6 * 2 ** (height / 1e-5), poisson_ratio=0.45)
        >>> stack = Stack.graded(base=Elastic(young_modulus=2e11, poisson_ratio=0.25),
        ...                      thickness=1e-5, count=40, material=material)
        >>> len(stack.layers), stack.surface.young_modulus
        (40, 2000000.0)
        """
        count = operator.index(count)
        middles = [thickness * ((i + 0.5) / count) for i in range(count)]
        layers = [Layer(material=material(z), thickness=thickness / count) for z in middles]
        return cls(base=base, layers=tuple(layers), surface=material(thickness))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Stack:
        """Read a stack from a TOML file, as ``tabulate solve --stack`` does.

        ``base = { young_modulus = .., poisson_ratio = .. }`` and, from the base up, ``[[layers]]``
        with ``young_modulus``, ``poisson_ratio``, ``thickness`` and perhaps a ``name``, in SI
        units. A base with ``young_modulus = inf`` is rigid and needs no Poisson ratio.

        Raises
        ------
        OSError
            If the file cannot be read.
        StackError
            If it is no stack; the message names the file and the layer.
        """
        path = Path(path)
        try:
            text = tomllib.loads(path.read_text(encoding="utf-8"))
            _keys("the file", text, {"base", "layers"})
            layers = [_layer(i + 1, layer) for i, layer in enumerate(text.get("layers", []))]
            return cls(base=_base(text.get("base")), layers=tuple(layers))
        except (ValueError, TypeError) as error:
            raise StackError(f"{path}: {error}") from error

    @property
    def thickness(self) -> float:
        """The sum of all thicknesses, m."""
        return self._native.thickness()

    @property
    def compressibility(self) -> float:
        """The compressibility of the layers in a wide contact, over (a/t)^2.

        ``Validity.compressibility`` is this number times (a/t)^2. It is 3/16 (1 - 2 nu)/(1 - nu)
        for one film, however it is cut into layers.
        """
        return self._native.compressibility()

    def contact(
        self,
        *,
        probe: Probe | None = None,
        sphere_radius: float | None = None,
        sphere_modulus: float,
        a_over_t: tuple[float, float],
        tolerance: float = 1e-8,
    ) -> Contact:
        """Solve the contact of a probe with this stack along a range of a/t.

        The contact answers all that one from a table answers, but derivatives with respect to the
        material, and nothing beyond the ends of the range.

        Parameters
        ----------
        probe : Probe
            The shape of the probe: a paraboloid or a flat punch.
        sphere_radius : float
            In place of ``probe``: the radius R, m, of the paraboloid.
        sphere_modulus : float
            Reduced modulus E2* of the probe, Pa; infinity is a rigid one.
        a_over_t : tuple of float
            The smallest and the largest contact radius over the thickness of the stack. The
            largest radius is up to 1000 times the thickness of the top layer.
        tolerance : float
            The largest relative error of the quantities.

        Raises
        ------
        DomainError
            For a range out of reach.
        NotConvergedError
            Where double precision does not allow the tolerance.
        OtherProbeError
            For another shape.
        """
        from ._contact import SolvedCurve

        system = StackSystem(
            stack=self, probe=probe, sphere_radius=sphere_radius, sphere_modulus=sphere_modulus
        )
        return SolvedCurve(a_over_t=a_over_t, tolerance=tolerance).contact(system)


@final
@dataclass(frozen=True, init=False, slots=True)
class StackSystem(Remade):
    """A probe on a stack of layers.

    Parameters
    ----------
    probe : Probe
        The shape of the probe.
    sphere_radius : float
        In place of ``probe``: the radius R, m, of the paraboloid.
    sphere_modulus : float
        Reduced modulus E2* of the probe, Pa; infinity is a rigid one.
    stack : Stack
        The layers and their base.
    """

    probe: Probe
    sphere_modulus: float
    stack: Stack
    _native: Any = field(init=False, repr=False, compare=False)

    def __init__(
        self,
        *,
        probe: Probe | None = None,
        sphere_radius: float | None = None,
        sphere_modulus: float,
        stack: Stack,
    ) -> None:
        if not isinstance(stack, Stack):
            raise TypeError(f"stack must be a Stack, not {type(stack).__name__}")
        probe = probe_of(probe, sphere_radius)
        set_field(self, "probe", probe)
        sphere_modulus = set_number(self, "sphere_modulus", sphere_modulus)
        set_field(self, "stack", stack)
        native = _core.StackSystem(probe._native, sphere_modulus, stack._native)
        set_field(self, "_native", native)

    @property
    def sphere_radius(self) -> float | None:
        """The radius R of the sphere or of its paraboloid, m; None for another probe."""
        return radius_of(self.probe)


def _keys(where: str, found: object, allowed: Iterable[str]) -> Mapping[str, Any]:
    """Return a table of TOML; refuse keys that it cannot have."""
    if not isinstance(found, Mapping):
        raise StackError(f"{where} is missing, or no table")
    for key in found:
        if key not in allowed:
            words = ", ".join(sorted(allowed))
            raise StackError(f"{where}: {key} is unknown; the keys are {words}", axis=key)
    return found


def _value(where: str, table: Mapping[str, Any], key: str) -> Any:
    if key not in table:
        raise StackError(f"{where}: {key} is missing", axis=key)
    return table[key]


def _base(found: object) -> Elastic:
    base = _keys("base", found, {"young_modulus", "poisson_ratio"})
    young = _value("base", base, "young_modulus")
    # A rigid body has no Poisson ratio; any one serves.
    poisson = base.get("poisson_ratio", 0.0) if young == inf else None
    poisson = _value("base", base, "poisson_ratio") if poisson is None else poisson
    return Elastic(young_modulus=young, poisson_ratio=poisson)


def _layer(number: int, found: object) -> Layer:
    where = f"layer {number} from the base"
    layer = _keys(where, found, {"name", "young_modulus", "poisson_ratio", "thickness"})
    young, poisson, thickness = (
        _value(where, layer, key) for key in ("young_modulus", "poisson_ratio", "thickness")
    )
    try:
        material = Elastic(young_modulus=young, poisson_ratio=poisson)
        return Layer(material=material, thickness=thickness, name=layer.get("name"))
    except (ValueError, TypeError) as error:
        raise StackError(f"{where}: {error}") from error
