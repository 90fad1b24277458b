"""The flat punch that never slides, and the size of friction."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any

from numpy.typing import ArrayLike

from . import _core
from ._arrays import Errors, evaluate, scalar_or_array
from ._bodies import System
from ._stack import StackSystem
from ._values import OneLine


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class StickPunch(OneLine):
    """The flat punch with full friction, each number with the shape of the broadcast parameters.

    Attributes
    ----------
    eeq_s : float or numpy.ndarray
        Contact stiffness, S = 2 a E* eeq_s.
    gamma_s : float or numpy.ndarray
        Edge singularity of the normal stress; NaN where Dundurs' beta of sphere and film is not 0.
    gamma_t : float or numpy.ndarray
        Edge singularity of the shear stress; NaN where Dundurs' beta is not 0.
    gamma_eff : float or numpy.ndarray
        Edge singularity of both together, which gives the energy release rate.
    error : float or numpy.ndarray
        The estimated largest relative error; that of ``gamma_t`` is relative to ``gamma_eff``.
    """

    eeq_s: Any
    gamma_s: Any
    gamma_t: Any
    gamma_eff: Any
    error: Any


def solve_stick_punch(
    a_over_t: ArrayLike,
    e1_over_e2: ArrayLike,
    nu1: ArrayLike,
    e0_over_e2: ArrayLike,
    nu0: ArrayLike = 0.25,
    nu2: ArrayLike = 0.5,
    tolerance: ArrayLike = 1e-8,
    *,
    errors: Errors = "raise",
) -> StickPunch:
    """Solve flat punches that never slide, for every Poisson ratio, on all cores.

    Parameters
    ----------
    a_over_t : array_like
        Contact radius over film thickness, 1e-6 to 300.
    e1_over_e2, nu1, e0_over_e2, nu0 : array_like
        Film and substrate, as in ``solve``.
    nu2 : array_like
        Poisson ratio of the punch; a rigid one needs none.
    tolerance : array_like
        The largest relative error allowed, 1e-13 to 1e-2.
    errors : {"raise", "nan"}
        What a point with an error gives: an exception, or NaN.

    Returns
    -------
    StickPunch
        The numbers in units of E2*, under a rigid punch of the film's reduced modulus.

    Examples
    --------
    >>> stuck = solve_stick_punch([0.5, 1.0, 2.0], 0.0, 0.5, float("inf"))
    >>> from coated_contact import solve
    >>> (stuck.eeq_s / solve([0.5, 1.0, 2.0], 0.0, 0.5, float("inf")).eeq).round(3)
    array([1.01 , 1.086, 1.366])
    """
    found = evaluate(
        _core.solve_stick_punch,
        errors,
        a_over_t=a_over_t,
        e1_over_e2=e1_over_e2,
        nu1=nu1,
        e0_over_e2=e0_over_e2,
        nu0=nu0,
        nu2=nu2,
        tolerance=tolerance,
    )
    return StickPunch(*map(scalar_or_array, found))


def stick_stiffening(
    system: System | StackSystem,
    a: ArrayLike,
    *,
    sphere_poisson_ratio: ArrayLike = 0.5,
    tolerance: ArrayLike = 1e-6,
    errors: Errors = "raise",
) -> Any:
    """Return the size of friction: the load with full friction over that without.

    It is that of flat punches at equal penetration, one solve each. Under a sphere on an
    incompressible film the load at equal penetration rises by 0.45 to 0.99 of it. A model without
    friction finds moduli of a film that are at most larger by this factor (on a stiff base under a
    stiff sphere). ``Contact.validity`` compares the other assumptions of the model.

    Parameters
    ----------
    system : System or StackSystem
        The bodies. The shape of the probe does not matter.
    a : array_like
        Contact radius, m, up to 300 times the thickness of the film or top layer.
    sphere_poisson_ratio : array_like
        Poisson ratio of the sphere; a rigid one needs none.
    tolerance : array_like
        The largest relative error of each of the two solves, 1e-13 to 1e-2.
    errors : {"raise", "nan"}
        What a point with an error gives: an exception, or NaN.

    Returns
    -------
    float or numpy.ndarray
        The factor, 1 or more.

    Examples
    --------
    >>> from coated_contact import Elastic
    >>> gel = System(sphere_radius=1e-4, sphere_modulus=float("inf"),
    ...              film=Elastic(young_modulus=1e4, poisson_ratio=0.5), film_thickness=1e-5,
    ...              substrate=Elastic(young_modulus=float("inf"), poisson_ratio=0.25))
    >>> stick_stiffening(gel, [5e-6, 1e-5, 2e-5]).round(3)
    array([1.01 , 1.086, 1.366])
    """
    if not isinstance(system, System | StackSystem):
        raise TypeError(f"system must be a System or a StackSystem, not {system!r}")
    (found,) = evaluate(
        partial(_core.stick_stiffening, system._native),
        errors,
        contact_radius=a,
        sphere_poisson_ratio=sphere_poisson_ratio,
        tolerance=tolerance,
    )
    return scalar_or_array(found)
