"""The flat punch that never slides."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from . import _core
from ._arrays import Errors, evaluate, scalar_or_array
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

    Raises
    ------
    SolveError
        For a parameter outside the domain.
        Where double precision does not allow the tolerance.

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
