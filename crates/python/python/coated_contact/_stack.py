"""Stacks of layers on an elastic or rigid base."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any, Literal, final

from . import _core
from ._bodies import Elastic, UnderProbe, check_solid
from ._errors import InputError
from ._probe import Probe
from ._values import Native, set_field, set_numbers

if TYPE_CHECKING:
    from ._contact import Contact


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Springs:
    """Springs between a layer and what lies below it, per area.

    A layer of glue of the thickness d and the shear modulus G, much thinner than the layers that it
    joins, is the springs G/d and 2 G (1 - nu)/((1 - 2 nu) d).

    Parameters
    ----------
    tangential_stiffness : float
        Shear stress over the displacement sideways, Pa/m, 0 or more; infinity is allowed.
    normal_stiffness : float
        Normal stress over the displacement normal to the interface, Pa/m, above 0.
    """

    tangential_stiffness: float
    normal_stiffness: float = inf

    def __post_init__(self) -> None:
        set_numbers(self, "tangential_stiffness", "normal_stiffness")


Interface = Literal["bonded", "sliding"] | Springs

# The stiffnesses of the interfaces that have a name.
_NAMED: dict[str, tuple[float, float]] = {"bonded": (inf, inf), "sliding": (0.0, inf)}


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
        A name for messages and for the parameters of fits, ``"NAME.modulus"``,
        ``"NAME.thickness"`` and ``"NAME.interface_stiffness"`` (tangential, Pa/m).
    interface : {"bonded", "sliding"} or Springs
        What joins the layer to the layer below it, or to the base. A layer that slides has no
        friction there, as on a lubricant. It is held by tension where it would rise: a dry layer
        that lifts off is not modelled.
    """

    material: Elastic
    thickness: float
    name: str | None = None
    interface: Interface = "bonded"

    def __post_init__(self) -> None:
        check_solid("material", self.material)
        set_numbers(self, "thickness")
        if self.name is not None and not isinstance(self.name, str):
            raise TypeError(f"name must be a str, not {type(self.name).__name__}")
        if not isinstance(self.interface, Springs) and self.interface not in _NAMED:
            raise InputError(
                f'interface = {self.interface!r} is none: give "bonded", "sliding" or Springs',
                axis="interface",
            )
        # Springs that are no springs have a name.
        set_field(self, "interface", _interface(*self._stiffnesses()))

    def _stiffnesses(self) -> tuple[float, float]:
        """Return the tangential and the normal stiffness of the interface."""
        if isinstance(self.interface, Springs):
            return (self.interface.tangential_stiffness, self.interface.normal_stiffness)
        return _NAMED[self.interface]


def _interface(tangential: float, normal: float) -> Interface:
    """Return the interface of two stiffnesses, by its name if it has one."""
    if normal == inf and tangential == inf:
        return "bonded"
    if normal == inf and tangential == 0:
        return "sliding"
    return Springs(tangential_stiffness=tangential, normal_stiffness=normal)


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Stack(Native):
    """Layers on a base.

    Layers are counted from the base up: the first one is on the base, and the probe touches the
    last one. Each is bonded to what lies below it, slides on it, or is joined to it by springs
    (``Layer.interface``). They enter through the compliance of the surface alone, and a/t of a
    stack is the contact radius over the sum of all thicknesses. Stacks are solved directly, in
    milliseconds (:meth:`contact`), or looked up in a table of one stack (:func:`generate`,
    ``Table.contact``).

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
    InputError
        Without a layer; for a thickness that is not positive and finite, a rigid layer, or a
        Young's modulus more than 1e9 times that of another body; for a stiffness of an interface
        that is negative or NaN, and a normal one that is 0 or too small.

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

    The same elastomer on a lubricated base:

    >>> film = Layer(material=elastomer, thickness=7.5e-6, interface="sliding")
    >>> sliding = Stack(base=stack.base, layers=[film])
    >>> contact = sliding.contact(sphere_radius=1e-3, sphere_modulus=2e6, a_over_t=(0.1, 20))
    >>> print(f"{contact.load(65e-6, 0.04):.3e} N")
    -4.810e-05 N
    """

    base: Elastic
    layers: Sequence[Layer]
    surface: Elastic | None = None

    def __post_init__(self) -> None:
        check_solid("base", self.base)
        set_field(self, "layers", tuple(self.layers))
        for layer in self.layers:
            if not isinstance(layer, Layer):
                raise TypeError(f"layers must be Layer, not {type(layer).__name__}")
        names = [layer.name for layer in self.layers if layer.name is not None]
        for name in names:
            if names.count(name) > 1:
                raise InputError(f"two layers have the name {name!r}: give another", axis="name")
        if self.surface is not None:
            check_solid("surface", self.surface)
        native = _core.Stack(
            self.base._numbers(),
            [
                (one.material._numbers(), one.thickness, one.name, one._stiffnesses())
                for one in self.layers
            ],
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
        lower face, 40 sublayers give at most 2.6e-3, 1.1e-3 and 3.3e-4 at a/t of 0.3, 1 and 5 for
        Poisson ratios from 0 to 0.5, and a quarter of that where the film is incompressible.

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
        return cls(base=base, layers=layers, surface=material(thickness))

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Stack:
        """Read a stack from a TOML file, by the reader of ``tabulate solve --stack``.

        ``base = { young_modulus = .., poisson_ratio = .. }`` and, from the base up, ``[[layers]]``
        with ``young_modulus``, ``poisson_ratio``, ``thickness`` and perhaps a ``name`` and an
        ``interface``, in SI units. The interface is ``"bonded"``, ``"sliding"`` or
        ``{ tangential_stiffness = .., normal_stiffness = .. }``. A base with
        ``young_modulus = inf`` is rigid and needs no Poisson ratio.

        Raises
        ------
        InputError
            If it is no stack; the message names the file and the layer.
        """
        return cls._of_parts(*_core.read_stack(os.fsdecode(path)))

    @classmethod
    def _of_parts(
        cls,
        base: tuple[float, float],
        layers: Iterable[tuple[tuple[float, float], float, str | None, tuple[float, float]]],
    ) -> Stack:
        """Make a stack of what the native part returns."""

        def solid(young: float, poisson: float) -> Elastic:
            return Elastic(young_modulus=young, poisson_ratio=poisson)

        made = [
            Layer(
                material=solid(*material),
                thickness=thickness,
                name=name,
                interface=_interface(*stiffnesses),
            )
            for material, thickness, name, stiffnesses in layers
        ]
        return cls(base=solid(*base), layers=made)

    def _scene(self) -> dict[str, Any]:
        """Return the stack as the mapping of its file."""
        if self.surface is not None:
            raise InputError(
                "the stack has a surface of its own, which a scene cannot state: leave it out with "
                "dataclasses.replace(stack, surface=None)",
                axis="surface",
            )

        def solid(one: Elastic) -> dict[str, Any]:
            return {"young_modulus": one.young_modulus, "poisson_ratio": one.poisson_ratio}

        layers = [
            ({} if one.name is None else {"name": one.name})
            | solid(one.material)
            | {"thickness": one.thickness}
            | _interface_key(one.interface)
            for one in self.layers
        ]
        return {"base": solid(self.base), "layers": layers}

    @property
    def thickness(self) -> float:
        """The sum of all thicknesses, m."""
        return self._native.thickness()

    @property
    def compressibility(self) -> float:
        """The compressibility of the layers in a wide contact, over (a/t)^2.

        ``Validity.compressibility`` is this number times (a/t)^2. It is 3/16 (1 - 2 nu)/(1 - nu)
        for one film, however it is cut into layers, and NaN where an interface is not bonded.
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
            The shape of the probe.
        sphere_radius : float
            In place of ``probe``: the radius R, m, of the paraboloid.
        sphere_modulus : float
            Reduced modulus E2* of the probe, Pa, at most 1e25; infinity is a rigid one.
        a_over_t : tuple of float
            The smallest and the largest contact radius over the thickness of the stack. The
            largest radius is up to 1000 times the thickness of the top layer. Under another probe
            than a paraboloid or a flat punch, the smallest one is a hundredth of that thickness or
            below, and the largest one 1.5 times that of the contacts.
        tolerance : float
            The largest relative error of the quantities.
        """
        from ._contact import SolvedCurve

        system = StackSystem(
            stack=self, probe=probe, sphere_radius=sphere_radius, sphere_modulus=sphere_modulus
        )
        return SolvedCurve(a_over_t=a_over_t, tolerance=tolerance).contact(system)


def _interface_key(interface: Interface) -> dict[str, Any]:
    """Return the key of an interface in a stack file."""
    if interface == "bonded":
        return {}
    if isinstance(interface, Springs):
        return {
            "interface": {
                "tangential_stiffness": interface.tangential_stiffness,
                "normal_stiffness": interface.normal_stiffness,
            }
        }
    return {"interface": interface}


@final
@dataclass(frozen=True, init=False, slots=True)
class StackSystem(UnderProbe):
    """A probe on a stack of layers.

    Parameters
    ----------
    probe : Probe
        The shape of the probe.
    sphere_radius : float
        In place of ``probe``: the radius R, m, of the paraboloid.
    sphere_modulus : float
        Reduced modulus E2* of the probe, Pa, at most 1e25; infinity is a rigid one.
    stack : Stack
        The layers and their base.
    """

    stack: Stack

    def __init__(
        self,
        *,
        probe: Probe | None = None,
        sphere_radius: float | None = None,
        sphere_modulus: float,
        stack: Stack,
        _replaced: Probe | None = None,
    ) -> None:
        if not isinstance(stack, Stack):
            raise TypeError(f"stack must be a Stack, not {type(stack).__name__}")
        touching = self._set_probe(probe, sphere_radius, sphere_modulus, _replaced)
        set_field(self, "stack", stack)
        self._set_native(_core.Coated.on_layers(*touching, stack._native))
