"""Numbers that compare a contact with the assumptions of the model."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import Errors, evaluate, scalar_or_array
from ._bodies import HalfSpace
from ._stick import stick_stiffening
from ._values import OneLine

if TYPE_CHECKING:
    from ._contact import Contact


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Validity(OneLine):
    """The geometry of a contact, compared with the assumptions of the model.

    Each number has the shape of the contact radii given. With ``errors="nan"`` numbers are NaN at a
    radius that the contact cannot have, and answers to yes or no, which cannot be NaN, are False:
    there ``neglected`` says nothing.

    Attributes
    ----------
    a_over_r : float or numpy.ndarray
        Contact radius over sphere radius; for a shape without a radius of curvature the slope of
        the shape at the edge, which under a paraboloid is a/R, and 0 under a flat punch. A
        paraboloid in place of a rigid sphere has an adhesionless penetration that is too small by
        the part ``(a/R)^2 / 3`` and more (Sneddon, Int. J. Eng. Sci. 3, 47, 1965).
    shape : float or numpy.ndarray
        The part by which the load at a given penetration falls if a sphere stands for its
        paraboloid, to the first order in ``(a/R)^2``; 0 for other probes. ``Sphere`` adds this
        effect. It is ``delta0/(10 R)`` on a half-space, and up to ten times as much on thin films.
        With friction, and on a stack whose a/t begins at too large a value, it is that of the
        half-space.
    sideways : float or numpy.ndarray
        The part by which the load at a given penetration rises because the surface moves sideways
        under the sloping probe, which the model neglects: ``3/(4 pi) (1 - 2 nu)/(1 - nu) a/R``
        times ``1 - probe_share``. It follows from the displacements of Hertz's contact; on a thin
        film it is an order of magnitude. An elastic probe is taken as incompressible, because the
        model does not know its Poisson ratio.
    probe_share : float or numpy.ndarray
        The share of the probe in the compliance of probe and film, or half-space.
    surface_tension : float or numpy.ndarray
        The surface tension (N/m) that would raise the load of the contact without adhesion at its
        penetration by a tenth, to the first order; the model has none. On a half-space it is
        ``0.1 pi Es* a/6``, and under a flat punch some ``0.03 Es* a``. Soft gels and elastomers in
        air have 0.02 to 0.07 N/m, the cortex of a cell 1e-4 to 1e-3 N/m; a film under a residual
        stress carries this stress times its thickness.
    a_over_t : float, numpy.ndarray or None
        Contact radius over film thickness, the degree of confinement; None on a half-space.
    compressibility : float, numpy.ndarray or None
        ``(3/16) (1 - 2 nu1)/(1 - nu1) (a/t)^2``: the stiffness of a thin film whose volume is fixed
        over that of one that cannot move sideways (Johnson, *Contact Mechanics*, 5.8). Above 1 a
        thin film deforms by a change of its volume; below 1 it behaves as incompressible. Of a
        stack it is that of all layers together. None on a half-space.
    strain : float, numpy.ndarray or None
        The compression of the film over its thickness, the size of its strain: the part of the
        penetration without adhesion that the bare substrate would not have at the same load. The
        model is linear. Negative where the substrate is softer than the film; None on a half-space.
    bending : float, numpy.ndarray or None
        The part of its thickness by which the contact without adhesion bends a film, or top layer,
        that is stiffer than what lies below it; 0 for a softer one. It is stretched then, too,
        which stiffens it and is left out. None on a half-space.
    in_range : bool, numpy.ndarray or None
        Whether a/t is between the nodes of the table or curve. Beyond them an expansion is used, or
        there is an error. None on a half-space.
    no_disc : bool, numpy.ndarray or None
        Whether the contact without adhesion may be no disc: the film is so much stiffer than the
        substrate that it bends as a plate. Under a cone on a film more than 150 times as stiff it
        touches the flank outside the disc; under a flat punch on one more than 20 times, and under
        another flat end on one more than 30 times as stiff, it lifts off inside. So does a layer
        under a flat punch on layers that are less than a tenth as stiff; under other probes layers
        count as the film that bends as they do. That is not modelled, and the loads are wrong. None
        on a half-space.
    neglected : dict of str to bool or numpy.ndarray
        Which neglected effects are larger than the difference between a sphere and its paraboloid:
        ``sideways`` (the displacement sideways; under other probes where it is above 0.1 %),
        ``elastic_probe`` (an elastic probe is no half-space; above an a/R and a share of 0.1),
        ``strain`` (above 0.1) and ``bending`` (above 0.3). While there is one, ``Sphere`` in place
        of ``Paraboloid`` gains nothing for loads at given penetrations.
    """

    a_over_r: Any
    shape: Any
    sideways: Any
    probe_share: Any
    surface_tension: Any
    a_over_t: Any
    compressibility: Any
    strain: Any
    bending: Any
    in_range: Any
    no_disc: Any
    neglected: dict[str, Any]
    _contact: Contact = field(repr=False)
    _contact_radius: ArrayLike = field(repr=False)
    _errors: Errors = field(repr=False)

    def friction(
        self, *, sphere_poisson_ratio: ArrayLike = 0.5, errors: Errors | None = None
    ) -> Any:
        """Return the part by which full friction would raise the load of a punch of this radius.

        It is ``stick_stiffening - 1``: two solves for each contact radius, made when they are asked
        for. Under a sphere on an incompressible film the load at equal penetration rises by 0.45 to
        0.99 of it.

        Parameters
        ----------
        sphere_poisson_ratio : array_like
            Poisson ratio of the sphere; a rigid one needs none.
        errors : {"raise", "nan"}, optional
            What a point with an error gives; by default what was given to ``Contact.validity``.

        Returns
        -------
        float, numpy.ndarray or None
            The part, 0 or more. None on a half-space.

        Examples
        --------
        >>> from coated_contact import Elastic, SolvedCurve, System
        >>> gel = System(sphere_radius=1e-4, sphere_modulus=float("inf"),
        ...              film=Elastic(young_modulus=1e4, poisson_ratio=0.5), film_thickness=1e-5,
        ...              substrate=Elastic(young_modulus=float("inf"), poisson_ratio=0.25))
        >>> contact = SolvedCurve(a_over_t=(1e-3, 10.0)).contact(gel)
        >>> contact.validity([1e-6, 1e-5, 2e-5]).friction().round(3)
        array([0.   , 0.086, 0.366])
        """
        system = self._contact.system
        if isinstance(system, HalfSpace):
            return None
        # No radius where the contact has none, such as beyond the sphere.
        there = np.where(np.isnan(self.a_over_r), np.nan, self._contact_radius)
        ratio = stick_stiffening(
            system,
            there,
            sphere_poisson_ratio=sphere_poisson_ratio,
            errors=self._errors if errors is None else errors,
        )
        return ratio - 1.0

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


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ZoneSize(OneLine):
    """The range of the attraction, compared with the JKR limit, in which it is zero.

    Attributes
    ----------
    tabor : float or numpy.ndarray
        Tabor's parameter ``(R w^2 / (Es*^2 z0^3))^(1/3)``, with the compound modulus Es* of sphere
        and film.
    cohesive_zone : float or numpy.ndarray
        The length (m) outside the contact in which the attraction acts, ``(pi/4) Es* z0^2 / w``
        (Maugis, J. Colloid Interface Sci. 150, 243, 1992).
    range_over_thickness : float or numpy.ndarray
        The range over the thickness of the film, or of all layers of a stack; 0 on a half-space.
    tension : float or numpy.ndarray
        The mean tension ``|F| / (pi a^2)`` of JKR's contact at pull-off under an imposed load over
        the stress ``w / z0``, the largest that the attraction bears; NaN where that pull-off is not
        known. On a half-space it is ``0.65 / tabor``. On a confined film, which can hardly yield,
        it may be above 1: such a contact opens inside.
    """

    tabor: Any
    cohesive_zone: Any
    range_over_thickness: Any
    tension: Any
    _contact: Contact = field(repr=False)
    _work_of_adhesion: ArrayLike = field(repr=False)
    _interaction_range: ArrayLike = field(repr=False)
    _errors: Errors = field(repr=False)

    @property
    def is_jkr(self) -> Any:
        """Whether JKR holds: its pull-off load under an imposed load errs by up to 0.7 %.

        That is Dugdale's law where Tabor's parameter is 5 or more, the range a tenth of the
        thickness or less, and ``tension`` 0.3 or less. Above 1 the load errs by 5 to 30 %.
        """
        tabor, thin, tense = _core.JKR_LIMITS
        is_thin = np.less_equal(self.range_over_thickness, thin)
        return _plain(
            np.greater_equal(self.tabor, tabor) & is_thin & np.less_equal(self.tension, tense)
        )

    def is_short_beside(self, length: float) -> Any:
        """Return whether the cohesive zone is at most a tenth of a length (m)."""
        return _plain(np.less_equal(self.cohesive_zone, 0.1 * length))

    def pull_off_error(self, *, errors: Errors | None = None) -> Any:
        """Return the part by which the pull-off load of JKR is too small, under an imposed load.

        It is for Dugdale's law, and to first order in the length of the cohesive zone: on a
        half-space ``0.0859 / tabor^2``. Against an independent program: where the zone is a
        twentieth of the shorter of contact radius and film thickness, up to 7 % of itself too large
        or 2 % too small; where it is a fifth, 26 % and 9 %.

        Parameters
        ----------
        errors : {"raise", "nan"}, optional
            What a point with an error gives; by default what was given to
            ``Contact.zone_size``.

        Returns
        -------
        float or numpy.ndarray
            F / F_JKR - 1.

        Raises
        ------
        InputError
            For a zone that is not short beside the contact radius or the film, or top layer.
            For a shape with an edge or a bend.

        Examples
        --------
        >>> from coated_contact import Contact, Elastic, HalfSpace
        >>> gel = Elastic(young_modulus=1e7, poisson_ratio=0.5)
        >>> system = HalfSpace(sphere_radius=1e-6, sphere_modulus=float("inf"), solid=gel)
        >>> attraction = Contact.half_space(system).zone_size(0.05, interaction_range=5e-9)
        >>> f"{attraction.pull_off_error():.2e}", f"{0.0859 / attraction.tabor**2:.2e}"
        ('3.69e-03', '3.69e-03')
        """
        (found,) = evaluate(
            self._contact._native.pull_off_error,
            self._errors if errors is None else errors,
            work_of_adhesion=self._work_of_adhesion,
            interaction_range=self._interaction_range,
        )
        return scalar_or_array(found)


def validity(
    found: dict[str, Any],
    shape: tuple[int, ...],
    contact: Contact,
    a: ArrayLike,
    errors: Errors,
) -> Validity:
    """Return what the native part finds."""
    neglected = found.pop("neglected")
    fields = {name: _plain(array.reshape(shape)) for name, array in found.items()}
    if isinstance(contact.system, HalfSpace):
        of_film = ("a_over_t", "compressibility", "strain", "bending", "in_range", "no_disc")
        fields.update(dict.fromkeys(of_film))
    return Validity(
        **fields,
        neglected={name: _plain(array.reshape(shape)) for name, array in neglected.items()},
        _contact=contact,
        _contact_radius=a,
        _errors=errors,
    )


def _plain(array: Any) -> Any:
    """Return a number or a bool for an array without dimensions, else the array."""
    return array if np.ndim(array) else np.asarray(array).item()
