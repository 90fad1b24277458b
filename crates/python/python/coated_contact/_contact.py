"""The contact of one system, in SI units."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, final, overload

from numpy.typing import ArrayLike

from . import _core, _html
from ._arrays import Errors, evaluate, evaluate_flat, fixed, number, scalar_or_array
from ._bodies import HalfSpace, System
from ._cohesive_zone import ShortZone
from ._columns import Array
from ._control import Control, check_friction, native_control
from ._equilibria import Equilibria
from ._errors import InputError
from ._results import ForceDisplacement, Gradient, State, States, states
from ._stack import StackSystem
from ._validity import Validity, ZoneSize, validity
from ._values import Native, set_field, set_numbers

if TYPE_CHECKING:
    from ._history import HistoryStates, Relaxation
    from ._line import ContactLine, Law
    from ._table import Table


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class Contact(Native):
    """A contact of a probe with a coated substrate, a stack of layers or a half-space.

    ``Table.contact``, ``Stack.contact`` and ``SolvedCurve.contact`` make it. It is frozen, hashable
    and picklable.

    Its methods broadcast over their arguments as numpy's functions do: scalars give a scalar,
    arrays give an array. The interpreter's lock is released meanwhile. The argument ``errors``
    tells what a point with an error gives: an exception (``"raise"``), whose ``index`` is the first
    such point, or NaN (``"nan"``).

    Parameters
    ----------
    system : System, HalfSpace or StackSystem
        The bodies in contact.
    table : Table, SolvedCurve or None
        The table, of films or of the stack of the system; a solved curve; None on a half-space.

    Examples
    --------
    >>> import numpy as np
    >>> from coated_contact import Elastic, System, Table
    >>> rubber = Elastic(young_modulus=3.5e6, poisson_ratio=0.5)
    >>> silicon = Elastic(young_modulus=2e11, poisson_ratio=0.25)
    >>> system = System(sphere_radius=1e-3, sphere_modulus=2e6, film=rubber,
    ...                 film_thickness=1e-5, substrate=silicon)
    >>> contact = Table.embedded().contact(system)
    >>> contact.load(np.array([40e-6, 100e-6]), 0.04).round(7)
    array([-0.0001919,  0.0011804])
    """

    system: System | HalfSpace | StackSystem
    table: Table | SolvedCurve | None

    def __post_init__(self) -> None:
        set_field(self, "_native", _native(self.system, self.table))

    @classmethod
    def half_space(cls, system: HalfSpace) -> Contact:
        """Make the contact of a probe on a half-space: under a paraboloid JKR, to rounding.

        Examples
        --------
        >>> from math import pi
        >>> from coated_contact import Contact, Elastic, HalfSpace
        >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
        >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
        >>> pull_off = Contact.half_space(system).pull_off(0.04)
        >>> abs(pull_off.load / (-1.5 * pi * 0.04 * 1e-3) - 1) < 1e-14
        True
        """
        return cls(system=system, table=None)

    @property
    def contact_radius_range(self) -> tuple[float, float]:
        """The smallest and the largest contact radius (m) among which states are sought."""
        smallest, largest = self._native.contact_radius_range()
        return smallest, largest

    @overload
    def load(self, a: float, w: float, *, errors: Errors = "raise") -> float: ...
    @overload
    def load(self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise") -> Array: ...
    def load(self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise") -> float | Array:
        """Return the load F at a contact radius, eq. 9 of the model.

        Parameters
        ----------
        a : array_like
            Contact radius, m, that the probe can have: below the radius of a sphere.
        w : array_like
            Work of adhesion, J/m^2, 0 or more.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Returns
        -------
        float or numpy.ndarray
            Load, N, positive in compression. Each of the two terms of eq. 9 has the relative error
            of the table.

        Raises
        ------
        OutsideTableError
            Where the table does not cover a/t.
        InputError
            For an ``a`` that is not below the radius of the sphere.
            For ``a`` <= 0, ``w`` < 0, infinity, NaN, or a load that overflows a float.
        """
        (load,) = evaluate(self._native.load, errors, contact_radius=a, work_of_adhesion=w)
        return scalar_or_array(load)

    @overload
    def penetration(self, a: float, w: float, *, errors: Errors = "raise") -> float: ...
    @overload
    def penetration(self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise") -> Array: ...
    def penetration(self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise") -> float | Array:
        """Return the penetration delta at a contact radius.

        Parameters and errors are those of :meth:`load`.

        Returns
        -------
        float or numpy.ndarray
            Penetration, m, positive when the sphere is below the undeformed surface.
        """
        return self.load_and_penetration(a, w, errors=errors)[1]

    @overload
    def load_and_penetration(
        self, a: float, w: float, *, errors: Errors = "raise"
    ) -> tuple[float, float]: ...
    @overload
    def load_and_penetration(
        self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise"
    ) -> tuple[Array, Array]: ...
    def load_and_penetration(
        self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise"
    ) -> tuple[float, float] | tuple[Array, Array]:
        """Return load and penetration at a contact radius, together at less cost.

        Parameters and errors are those of :meth:`load`.

        Returns
        -------
        load : float or numpy.ndarray
            Load, N, positive in compression.
        penetration : float or numpy.ndarray
            Penetration, m, positive when the sphere is below the undeformed surface.
        """
        load, penetration = evaluate(
            self._native.load_and_penetration, errors, contact_radius=a, work_of_adhesion=w
        )
        return scalar_or_array(load), scalar_or_array(penetration)

    @overload
    def stiffness(self, a: float, *, errors: Errors = "raise") -> float: ...
    @overload
    def stiffness(self, a: ArrayLike, *, errors: Errors = "raise") -> Array: ...
    def stiffness(self, a: ArrayLike, *, errors: Errors = "raise") -> float | Array:
        """Return the contact stiffness S = 2 a E* Eeq at a contact radius, eq. 5 of the model.

        Parameters
        ----------
        a : array_like
            Contact radius, m, that the probe can have: below the radius of a sphere.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Returns
        -------
        float or numpy.ndarray
            Stiffness, N/m.
        """
        (stiffness,) = evaluate(self._native.stiffness, errors, contact_radius=a)
        return scalar_or_array(stiffness)

    @overload
    def moving_stiffness(self, a: float, w: float, *, errors: Errors = "raise") -> float: ...
    @overload
    def moving_stiffness(
        self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise"
    ) -> float | Array: ...
    def moving_stiffness(
        self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise"
    ) -> float | Array:
        """Return the slope K = dF/d delta of the force curve, where the contact line moves.

        It is the stiffness of slow loading, in equilibrium at a work of adhesion. A small fast
        oscillation, under which the line stays, measures :meth:`stiffness`. Without adhesion both
        are equal. K is 0 at the pull-off under a load, and negative from there to the pull-off
        under a displacement. A flat punch, whose contact line cannot move, has none.

        Parameters
        ----------
        a : array_like
            Contact radius, m.
        w : array_like
            Work of adhesion, J/m^2.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Returns
        -------
        float or numpy.ndarray
            Stiffness, N/m.
        """
        (stiffness,) = evaluate(
            self._native.moving_stiffness, errors, contact_radius=a, work_of_adhesion=w
        )
        return scalar_or_array(stiffness)

    def gradient(self, a: ArrayLike, w: ArrayLike, *, errors: Errors = "raise") -> Gradient:
        """Return load and penetration with their derivatives by every input.

        They are derivatives of the interpolated curve; that by the Poisson ratio of a nearly
        incompressible film is a difference of lookups. The certificate of a table does not cover
        them.

        Parameters and errors are those of :meth:`load`, but above the nodes in a/t it is always an
        OutsideTableError.

        Returns
        -------
        Gradient
            ``load`` (N), ``penetration`` (m), and ``by(name)`` with the derivatives.

        Examples
        --------
        >>> from coated_contact import Contact, Elastic, HalfSpace
        >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
        >>> system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
        >>> gradient = Contact.half_space(system).gradient(5e-5, 0.0)
        >>> print(f"{gradient.by('contact_radius').load:.3f} N/m")  # Hertz: 4 E* a^2 / R
        19.999 N/m
        """
        (values, pairs), shape = evaluate_flat(
            self._native.gradient, errors, contact_radius=a, work_of_adhesion=w
        )
        load, penetration = (scalar_or_array(column.reshape(shape)) for column in values)
        derivatives = {
            name: (by_load.reshape(shape), by_penetration.reshape(shape))
            for name, (by_load, by_penetration) in pairs.items()
        }
        return Gradient(load, penetration, derivatives, errors)

    @overload
    def pull_off(
        self, w: float, *, control: Control = "load", errors: Errors = "raise"
    ) -> State: ...
    @overload
    def pull_off(
        self, w: ArrayLike, *, control: Control = "load", errors: Errors = "raise"
    ) -> States: ...
    def pull_off(
        self, w: ArrayLike, *, control: Control = "load", errors: Errors = "raise"
    ) -> State | States:
        """Return the state in which the contact finally separates on unloading.

        Parameters
        ----------
        w : array_like
            Work of adhesion, J/m^2. At 0 the state is that of the first touch.
        control : {"load", "displacement"} or Spring
            What is imposed: a dead weight, a rigid machine, or a spring such as a cantilever.
        errors : {"raise", "nan"}
            What a point with an error gives.
        """
        imposed = native_control(control)
        return states(
            evaluate(
                lambda points, w: self._native.pull_off(points, w, imposed),
                errors,
                work_of_adhesion=w,
            )
        )

    @overload
    def work_of_adhesion_at_pull_off(
        self, load: float, *, control: Control = "load", errors: Errors = "raise"
    ) -> float: ...
    @overload
    def work_of_adhesion_at_pull_off(
        self, load: ArrayLike, *, control: Control = "load", errors: Errors = "raise"
    ) -> float | Array: ...
    def work_of_adhesion_at_pull_off(
        self, load: ArrayLike, *, control: Control = "load", errors: Errors = "raise"
    ) -> float | Array:
        """Return the work of adhesion of a measured pull-off load.

        Parameters
        ----------
        load : array_like
            The load at the pull-off, N, below 0.
        control : {"load", "displacement"} or Spring
            What is imposed.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Returns
        -------
        float or numpy.ndarray
            The work of adhesion, J/m^2, with which :meth:`pull_off` is at this load.
        """
        imposed = native_control(control)
        (work,) = evaluate(
            lambda points, load: self._native.work_of_adhesion_at_pull_off(points, load, imposed),
            errors,
            load=load,
        )
        return scalar_or_array(work)

    def energy_release_rate(
        self,
        a: ArrayLike,
        *,
        load: ArrayLike | None = None,
        penetration: ArrayLike | None = None,
        errors: Errors = "raise",
    ) -> float | Array:
        """Return the energy release rate G of measured contact radii and loads or penetrations.

        It is the work of adhesion of a contact in equilibrium. Along radii in time it shows how
        adhesion depends on the speed of the contact line (:class:`RateDependent`).

        Parameters
        ----------
        a : array_like
            Contact radius, m, that the probe can have: below the radius of a sphere.
        load, penetration : array_like
            The load, N, or the penetration, m: one of the two.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Returns
        -------
        float or numpy.ndarray
            G, J/m^2; below 0 where the contact is pressed more than without adhesion.

        Raises
        ------
        TypeError
            Without load and penetration, or with both.
        OutsideTableError
            Where the table does not cover a/t.
        InputError
            For an ``a`` that is not below the radius of the sphere, ``a`` <= 0, infinity, or NaN.

        Examples
        --------
        >>> from coated_contact import Contact, Elastic, HalfSpace
        >>> film = Elastic(young_modulus=3e6, poisson_ratio=0.5)
        >>> bodies = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=film)
        >>> contact = Contact.half_space(bodies)
        >>> round(contact.energy_release_rate(1e-4, load=contact.load(1e-4, 0.05)), 12)
        0.05
        """
        native = self._native
        if load is not None and penetration is None:
            at_load = native.energy_release_rate_at_load
            (rate,) = evaluate(at_load, errors, contact_radius=a, load=load)
        elif penetration is not None and load is None:
            at = native.energy_release_rate_at_penetration
            (rate,) = evaluate(at, errors, contact_radius=a, penetration=penetration)
        else:
            raise TypeError("give load or penetration, one of the two")
        return scalar_or_array(rate)

    def equilibria(self, w: float, *, control: Control = "load") -> Equilibria:
        """Return the equilibria with one work of adhesion under one control.

        Parameters
        ----------
        w : float
            Work of adhesion, J/m^2.
        control : {"load", "displacement"} or Spring
            What is imposed.
        """
        return Equilibria(contact=self, work_of_adhesion=w, control=control)

    def force_displacement(
        self, w: float, *, control: Control = "displacement", most: float, points: int = 200
    ) -> ForceDisplacement:
        """Return loading from the first touch and unloading until separation, with the jumps.

        Parameters
        ----------
        w : float
            Work of adhesion, J/m^2.
        control : {"load", "displacement"} or Spring
            What is imposed.
        most : float
            The largest imposed value: a load (N), a penetration (m) or a position of the spring
            (m).
        points : int
            The number of states of each branch, evenly spaced in contact radius, from 2 to
            1,000,000.
        """
        return self.equilibria(w, control=control).force_displacement(most=most, points=points)

    def line(self, law: Law, a: float) -> ContactLine:
        """Return the line of a contact that has slowly grown to a radius under a law.

        Parameters
        ----------
        law : float, Hysteresis or RateDependent
            The law of the line; a number is a constant work of adhesion, J/m^2.
        a : float
            Contact radius, m.

        Returns
        -------
        ContactLine
            The line, which ``impose`` and ``ramp`` move.
        """
        from ._line import ContactLine

        return ContactLine(self, law, a)

    def history(
        self,
        time: ArrayLike,
        relaxation: Relaxation,
        *,
        penetration: ArrayLike | None = None,
        load: ArrayLike | None = None,
        height: ArrayLike | None = None,
        stiffness: float | None = None,
        at: ArrayLike | None = None,
        receding: float = 0.0,
        rigid: Contact | None = None,
        tolerance: float | None = None,
    ) -> HistoryStates:
        """Follow a penetration, a load or a height in time where the bodies relax.

        All bodies that deform relax by one law, at any thickness of the film. The modulus of this
        contact is the law's ``E_ref``. One of ``penetration``, ``load`` and ``height`` is given at
        ``time``, with straight lines between.

        Parameters
        ----------
        time : array_like
            Times, s, rising. The first value imposed must be 0 or less: before the contact.
        relaxation : Relaxation
            The law.
        penetration, load, height : array_like, optional
            What is imposed: penetrations (m), loads (N), or the distance (m) by which the base of
            the cantilever has moved towards the sample since the first touch.
        stiffness : float, optional
            The stiffness of the cantilever, N/m, with ``height``.
        at : array_like, optional
            The times of the states, by default ``time``. The last value is held as long as a time
            is asked for.
        receding : float
            Work of adhesion of a receding line, J/m^2, after one approach under an imposed
            penetration. The line advances without adhesion.
        rigid : Contact, optional
            The same film between a rigid probe and a rigid substrate, if only the film relaxes: the
            error of that is estimated, and above 2 % refused.
        tolerance : float, optional
            The tolerance relative to the largest load, radius and penetration, from 1e-10 to 1e-2.
            Without one the error is as near to 1e-8 as possible, or to 1e-5 where the contact grows
            again after a retract, under a load that falls and for heights; above 0.5 it is raised.

        Returns
        -------
        HistoryStates
            The states, their phases and their error.

        Examples
        --------
        >>> from coated_contact import Elastic, Relaxation, System, Table
        >>> system = System(
        ...     sphere_radius=1e-5,
        ...     sphere_modulus=float("inf"),
        ...     film=Elastic(young_modulus=1e3, poisson_ratio=0.5),
        ...     film_thickness=5e-6,
        ...     substrate=Elastic(young_modulus=float("inf"), poisson_ratio=0.25),
        ... )
        >>> contact = Table.embedded().contact(system)
        >>> law = Relaxation.power_law(exponent=0.2)
        >>> out = contact.history([0, 1, 2], law, penetration=[0, 1e-6, 0], at=[0.5, 1.5])
        >>> bool(out.load[1] < out.load[0])  # hysteresis
        True
        """
        from ._history import history

        return history(
            self,
            time,
            relaxation,
            penetration=penetration,
            load=load,
            height=height,
            stiffness=stiffness,
            at=at,
            receding=receding,
            rigid=rigid,
            tolerance=tolerance,
        )

    def validity(self, a: ArrayLike, *, errors: Errors = "raise") -> Validity:
        """Compare contacts of given radii with the assumptions of the model.

        The size of friction takes two solves for each radius, which ``Validity.friction`` makes.

        Parameters
        ----------
        a : array_like
            Contact radius, m, that the probe can have: below the radius of a sphere.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Returns
        -------
        Validity
            a/R, a/t, compressibility, strain and more, and the neglected effects that matter.

        Examples
        --------
        >>> from coated_contact import Elastic, System, Table
        >>> system = System(sphere_radius=1e-3, sphere_modulus=2e6,
        ...                 film=Elastic(young_modulus=3.5e6, poisson_ratio=0.5),
        ...                 film_thickness=1e-5,
        ...                 substrate=Elastic(young_modulus=2e11, poisson_ratio=0.25))
        >>> validity = Table.embedded().contact(system).validity(6.5e-5)
        >>> round(validity.a_over_r, 9), validity.is_large_contact, validity.is_confined
        (0.065, False, True)
        """
        found, shape = evaluate_flat(self._native.validity, errors, contact_radius=a)
        return validity(found, shape, self, fixed(a), errors)

    def zone_size(
        self, w: ArrayLike, *, interaction_range: ArrayLike = 3e-10, errors: Errors = "raise"
    ) -> ZoneSize:
        """Compare an attraction of a given range with the JKR limit, which the model assumes.

        Parameters
        ----------
        w : array_like
            Work of adhesion, J/m^2, above 0.
        interaction_range : array_like
            The distance z0 (m) at which the attraction is largest or ends; for van der Waals forces
            that of an atom.
        errors : {"raise", "nan"}
            What a point with an error gives.

        Returns
        -------
        ZoneSize
            Tabor's parameter, the length of the cohesive zone, and the tension at pull-off.
        """
        found = evaluate(
            self._native.zone_size,
            errors,
            work_of_adhesion=w,
            interaction_range=interaction_range,
        )
        tabor, zone, part, tension = map(scalar_or_array, found)
        given = (fixed(w), fixed(interaction_range))
        return ZoneSize(tabor, zone, part, tension, self, *given, errors)

    def cohesive_zone(self, w: float, *, stress: float) -> ShortZone:
        """Correct the contact for an attraction of short, finite range, to first order.

        Errors are those of :class:`ShortZone`. :class:`Cohesive` solves zones that are not short.

        Parameters
        ----------
        w : float
            Work of adhesion, J/m^2, above 0.
        stress : float
            The traction of the attraction, Pa, above 0. It acts where the gap is below
            ``w / stress``.

        Returns
        -------
        ShortZone
            The contact with its cohesive zone: states, equilibria and pull-off.

        Examples
        --------
        >>> from coated_contact import Contact, Elastic, HalfSpace
        >>> gel = Elastic(young_modulus=1e7, poisson_ratio=0.5)
        >>> system = HalfSpace(sphere_radius=1e-6, sphere_modulus=float("inf"), solid=gel)
        >>> contact = Contact.half_space(system)
        >>> corrected = contact.cohesive_zone(0.05, stress=1e7).pull_off()
        >>> f"{contact.pull_off(0.05).load:.4e} N, {corrected.load:.4e} N"
        '-2.3562e-07 N, -2.3649e-07 N'
        """
        return ShortZone(contact=self, work_of_adhesion=w, stress=stress)

    def _repr_html_(self) -> str:
        """Return what a notebook shows: the bodies, drawn to scale, and their moduli."""
        return _html.contact(self.system)


@final
@dataclass(frozen=True, kw_only=True, slots=True)
class SolvedCurve:
    """What a contact is made of in place of a table: direct solves along a/t.

    It takes some milliseconds for each contact, and has neither expansions beyond its ends nor
    derivatives with respect to the material.

    Parameters
    ----------
    a_over_t : tuple of float
        The smallest and the largest contact radius over the thickness of the film or stack.
    tolerance : float
        The largest relative error of the quantities, from 1e-12 to 1e-2, with ``"stick"`` from
        1e-10. The integrals of another shape than a paraboloid may add up to 1e-6 if the range
        begins at a large a/t: begin at 1e-3 or below.
    friction : {"none", "stick"}
        Whether the surfaces slide freely, or never slide where they have touched. A sphere that
        sticks is solved where Dundurs' beta of sphere and film is 0: a film of Poisson ratio 0.5
        under a rigid sphere or one of Poisson ratio 0.5, or sphere and film of one material; up to
        an a/t of 30.
    sphere_poisson_ratio : float
        With ``friction="stick"``: the Poisson ratio of the sphere. A rigid one needs none.
    advancing : float
        With ``friction="stick"``: the work of adhesion with which the contact has grown over that
        with which it recedes, the ``w`` of all questions. 1 is a contact with one work of adhesion;
        0 one that was pressed on without attraction.

    Examples
    --------
    >>> from coated_contact import Elastic, System, Table
    >>> rubber = Elastic(young_modulus=3.5e6, poisson_ratio=0.5)
    >>> silicon = Elastic(young_modulus=2e11, poisson_ratio=0.25)
    >>> system = System(sphere_radius=1e-3, sphere_modulus=2e6, film=rubber,
    ...                 film_thickness=1e-5, substrate=silicon)
    >>> solved = SolvedCurve(a_over_t=(0.1, 20), tolerance=1e-10).contact(system)
    >>> looked_up = Table.embedded().contact(system)
    >>> abs(solved.stiffness(65e-6) / looked_up.stiffness(65e-6) - 1) < 1e-6
    True
    """

    a_over_t: tuple[float, float]
    tolerance: float = 1e-8
    friction: Literal["none", "stick"] = "none"
    sphere_poisson_ratio: float = 0.5
    advancing: float = 1.0

    def __post_init__(self) -> None:
        first, last = self.a_over_t
        set_field(self, "a_over_t", (number("a_over_t", first), number("a_over_t", last)))
        least, most = self.a_over_t
        if not least < most:
            raise InputError(
                f"a_over_t = {self.a_over_t} cannot be used: the first must be below the second",
                axis="a_over_t",
                value=least,
            )
        set_numbers(self, "tolerance", "sphere_poisson_ratio", "advancing")
        if self.friction not in ("none", "stick"):
            raise ValueError(f'friction is {self.friction!r}, but must be "none" or "stick"')
        check_friction(self.friction, self.sphere_poisson_ratio, self.advancing)

    def contact(self, system: System | StackSystem) -> Contact:
        """Solve the contact of a system."""
        return Contact(system=system, table=self)


def _native(system: object, table: object) -> Any:
    """Make the native contact."""
    native: Any = getattr(table, "_native", None)
    if isinstance(native, _core.Table) and isinstance(system, (System, StackSystem)):
        own: Any = getattr(table, "stack", None) if isinstance(system, StackSystem) else None
        return _core.Contact.in_table(native, system._native, own and own._native)
    if isinstance(system, HalfSpace) and table is None:
        return _core.Contact.half_space(system._native)
    if isinstance(table, SolvedCurve) and isinstance(system, (System, StackSystem)):
        settings = (system._native, table.a_over_t, table.tolerance)
        if table.friction == "stick":
            return _core.Contact.stuck(*settings, table.sphere_poisson_ratio, table.advancing)
        return _core.Contact.solved(*settings)
    raise TypeError(
        "a contact needs a System or a StackSystem and a Table or SolvedCurve, "
        "or a HalfSpace and no table"
    )
