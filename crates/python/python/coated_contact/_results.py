"""Results: states, equilibria, curves and derivatives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _core, _html
from ._arrays import Errors, scalar_or_array
from ._columns import UNITS, Array, Columns, axes, label, name_axes
from ._values import OneLine

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

InputName = Literal[
    "contact_radius",
    "work_of_adhesion",
    "sphere_radius",
    "sphere_modulus",
    "film_thickness",
    "film_modulus",
    "film_poisson_ratio",
    "substrate_modulus",
    "substrate_poisson_ratio",
]


@dataclass(frozen=True, slots=True)
class State:
    """A state of a contact.

    Attributes
    ----------
    contact_radius : float
        Contact radius a, m.
    load : float
        Load F, N, positive in compression.
    penetration : float
        Penetration delta, m, positive when the sphere has moved in.
    """

    contact_radius: float
    load: float
    penetration: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class States(Columns):
    """Many states: the attributes of :class:`State`, as arrays of one shape."""

    contact_radius: Array
    load: Array
    penetration: Array

    def __iter__(self) -> Iterator[State]:
        """Iterate over the states in the order of the flattened arrays."""
        return (State(*row) for row in self._rows())


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """An equilibrium at an imposed value.

    Attributes
    ----------
    state : State
        The state of the contact.
    stable : bool
        Whether the contact returns to this state after a small change of its radius.
    """

    state: State
    stable: bool


@dataclass(frozen=True, slots=True)
class CohesiveState:
    """A state with an annulus of attraction.

    Attributes
    ----------
    contact_radius : float
        Contact radius a, m; 0 before the contact.
    outer_radius : float
        Outer radius c of the attraction, m.
    load : float
        Load F, N, positive in compression.
    penetration : float
        Penetration delta, m, positive when the sphere has moved in.
    """

    contact_radius: float
    outer_radius: float
    load: float
    penetration: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class CohesiveStates(Columns):
    """Many states: the attributes of :class:`CohesiveState`, as arrays of one shape."""

    contact_radius: Array
    outer_radius: Array
    load: Array
    penetration: Array

    def __iter__(self) -> Iterator[CohesiveState]:
        """Iterate over the states in the order of the flattened arrays."""
        return (CohesiveState(*row) for row in self._rows())


@dataclass(frozen=True, slots=True)
class CohesiveEquilibrium:
    """An equilibrium at an imposed value, with an annulus of attraction.

    Attributes
    ----------
    state : CohesiveState
        The state of the contact.
    stable : bool
        Whether the contact returns to this state after a small change of its radius.
    """

    state: CohesiveState
    stable: bool


@dataclass(frozen=True, slots=True)
class Jump:
    """A sudden change of the contact at a fixed imposed value.

    Attributes
    ----------
    from_ : State
        The state in which stability is lost, or in which the surfaces meet.
    to : State or None
        The state in which the contact, or the separated sphere, comes to rest. None if the contact
        separates under a load, where the sphere does not come to rest.
    """

    from_: State
    to: State | None


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ForceDisplacement(OneLine):
    """Infinitely slow loading from the first touch, and unloading until separation.

    Attributes
    ----------
    loading : tuple of States
        The branches of stable states in order, up to the largest imposed value. A jump precedes
        each branch; the first jump is that into contact.
    unloading : tuple of States
        The branches of stable states in order, down to separation. A jump follows each branch; the
        last jump is the separation.
    jumps : tuple of Jump
        All jumps in order. Without adhesion there is none at first touch and none at separation.
    """

    loading: tuple[States, ...]
    unloading: tuple[States, ...]
    jumps: tuple[Jump, ...]

    def to_pandas(self) -> pandas.DataFrame:
        """Return a row for each state, with its direction and the number of its branch.

        Needs pandas.
        """
        import pandas

        directions = {"loading": self.loading, "unloading": self.unloading}
        frames = [
            states.to_pandas().assign(direction=direction, branch=number)
            for direction, branches in directions.items()
            for number, states in enumerate(branches)
        ]
        return pandas.concat(frames, ignore_index=True)

    def to_xarray(self) -> xarray.Dataset:
        """Return :meth:`to_pandas` as a Dataset over ``state``; needs pandas and xarray."""
        data = self.to_pandas().rename_axis("state").to_xarray()
        for name, unit in UNITS.items():
            if name in data:
                data[name].attrs["units"] = unit
        return data

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw load against penetration: branches as lines, jumps dashed; needs matplotlib.

        It draws into ``ax``, by default the current axes, and returns the axes.
        """
        ax = axes(ax)
        for colour, branches in (("C0", self.loading), ("C1", self.unloading)):
            name = "loading" if branches is self.loading else "unloading"
            for states in branches:
                ax.plot(states.penetration, states.load, color=colour, label=name)
                name = "_nolegend_"
        for jump in self.jumps:
            if jump.to is not None:
                ax.plot(
                    [jump.from_.penetration, jump.to.penetration],
                    [jump.from_.load, jump.to.load],
                    color="0.5",
                    linestyle="--",
                    linewidth=1,
                )
        name_axes(ax, label("penetration"), label("load"))
        ax.legend()
        return ax

    def _repr_html_(self) -> str:
        """Return what a notebook shows: the ends of each branch."""
        directions = {"loading": self.loading, "unloading": self.unloading}
        rows = [
            (direction, number, len(states), *(f"{end:.6g}" for end in _ends(states)))
            for direction, branches in directions.items()
            for number, states in enumerate(branches)
        ]
        ends = [f"{which} {label(name)}" for which in ("first", "last") for name in _ENDS]
        return _html.table(("direction", "branch", "states", *ends), rows)


_ENDS = ("penetration", "load")


def _ends(states: States) -> list[float]:
    """Return penetration and load of the first and of the last state."""
    return [float(getattr(states, name)[i]) for i in (0, -1) for name in _ENDS]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Derivatives(OneLine):
    """The derivatives of load and penetration with respect to one input, at fixed other inputs.

    Attributes
    ----------
    load : float or numpy.ndarray
        The derivative of the load, N per unit of the input.
    penetration : float or numpy.ndarray
        The derivative of the penetration, m per unit of the input.
    """

    load: Any
    penetration: Any


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Gradient(OneLine):
    """Load and penetration with their derivatives.

    Attributes
    ----------
    load : float or numpy.ndarray
        Load F, N.
    penetration : float or numpy.ndarray
        Penetration delta, m.
    """

    load: Any
    penetration: Any
    _derivatives: Mapping[InputName, tuple[Array, Array]] = field(repr=False)
    _errors: Errors = field(repr=False)

    def by(self, name: InputName) -> Derivatives:
        """Return the derivatives with respect to one input, in its SI unit.

        They are 0 with respect to the modulus and the Poisson ratio of a rigid body.

        Parameters
        ----------
        name : str
            ``contact_radius``, ``work_of_adhesion``, ``sphere_radius``, ``sphere_modulus``,
            ``film_thickness``, ``film_modulus``, ``film_poisson_ratio``, ``substrate_modulus`` or
            ``substrate_poisson_ratio``.

        Raises
        ------
        InputError
            For an input whose derivative needs a parameter that the table fixes, an input of the
            film on a half-space, and the work of adhesion where it is 0. Not where the gradient was
            computed with ``errors="nan"``.
        KeyError
            For another name; the message lists the names.
        """
        if name not in self._derivatives:
            names = ", ".join(self._derivatives)
            raise KeyError(f"{name!r} is no input: choose among {names}")
        load, penetration = self._derivatives[name]
        if self._errors == "raise" and np.isnan(load).any():
            raise _core.no_derivative(name)
        return Derivatives(scalar_or_array(load), scalar_or_array(penetration))


def states(arrays: list[Array]) -> State | States:
    """Return one state for arrays without dimensions, else many."""
    if arrays[0].ndim == 0:
        return State(*map(float, arrays))
    return States(*arrays)


def cohesive_states(arrays: list[Array]) -> CohesiveState | CohesiveStates:
    """Return one state for arrays without dimensions, else many."""
    if arrays[0].ndim == 0:
        return CohesiveState(*map(float, arrays))
    return CohesiveStates(*arrays)
