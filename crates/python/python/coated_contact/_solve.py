"""Direct solves, to the accuracy asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _html
from ._arrays import Errors, evaluate, fixed, real, scalar_or_array
from ._columns import axes
from ._stack import Stack
from ._values import OneLine

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

QUANTITIES = {
    "pi0": "adhesionless load, F0 = a^3 E* pi0 / (2 R)",
    "eeq": "contact stiffness, S = 2 a E* eeq",
    "gamma": "edge singularity per flat-punch penetration",
    "delta0": "adhesionless penetration, delta0 a^2 / R",
    "error": "estimated largest relative error of the four",
}


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Solution(OneLine):
    """The four dimensionless quantities, each with the shape of the broadcast parameters.

    Attributes
    ----------
    pi0 : float or numpy.ndarray
        Adhesionless load, F0 = a^3 E* pi0 / (2 R).
    eeq : float or numpy.ndarray
        Contact stiffness, S = 2 a E* eeq.
    gamma : float or numpy.ndarray
        Edge singularity per flat-punch penetration.
    delta0 : float or numpy.ndarray
        Adhesionless penetration, a^2 delta0 / R.
    error : float or numpy.ndarray
        The estimated largest relative error of the four: truncation, quadrature and rounding; of
        a lookup that of the table.
    """

    pi0: Any
    eeq: Any
    gamma: Any
    delta0: Any
    error: Any
    _parameters: dict[str, ArrayLike] = field(repr=False)

    def to_xarray(self) -> xarray.Dataset:
        """Return the quantities over their parameters; needs xarray.

        A dimension along which one parameter varies alone has its name and its values as
        coordinates. Other dimensions are called ``dim_0``, ``dim_1`` and so on; parameters that
        vary along them, or along several dimensions, are coordinates of their dimensions.

        Examples
        --------
        >>> import numpy as np
        >>> x, nu1 = np.array([0.1, 1.0, 10.0]), np.array([0.3, 0.5])
        >>> dict(solve(x[:, None], 1.75, nu1, 1e5).to_xarray().sizes)
        {'a_over_t': 3, 'nu1': 2}
        """
        import xarray

        values = {name: np.asarray(getattr(self, name)) for name in QUANTITIES}
        ndim = values["pi0"].ndim
        given = {name: real(name, value) for name, value in self._parameters.items()}
        varied = {
            name: tuple(i + ndim - array.ndim for i, n in enumerate(array.shape) if n != 1)
            for name, array in given.items()
        }
        dimensions = [
            alone[0] if len(alone) == 1 else f"dim_{axis}"
            for axis in range(ndim)
            for alone in [[name for name, along in varied.items() if along == (axis,)]]
        ]
        coordinates = {
            name: ([dimensions[axis] for axis in varied[name]], array.squeeze())
            for name, array in given.items()
        }
        variables = {
            name: (dimensions, value, {"long_name": QUANTITIES[name], "units": "1"})
            for name, value in values.items()
        }
        return xarray.Dataset(variables, coordinates)

    def to_pandas(self) -> pandas.DataFrame:
        """Return a row for each point: the parameters and the quantities; needs pandas."""
        import pandas

        return pandas.DataFrame(self._columns())

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the four quantities over the first parameter that varies; needs matplotlib.

        It draws into ``ax``, by default the current axes, and returns the axes. If no parameter
        varies, it raises a ValueError.
        """
        columns = self._columns()
        varied = [name for name in self._parameters if len(np.unique(columns[name])) > 1]
        if not varied:
            raise ValueError("all parameters are single numbers: solve for several, to draw them")
        ax = axes(ax)
        x = columns[varied[0]]
        order, line = np.argsort(x, kind="stable"), "-" if len(varied) == 1 else "."
        for quantity in [one for one in QUANTITIES if one != "error"]:
            ax.loglog(x[order], columns[quantity][order], line, label=quantity)
        ax.set_xlabel(varied[0])
        ax.legend()
        return ax

    def _repr_html_(self) -> str:
        """Return what a notebook shows: the first points."""
        return _html.numbers(self._columns())

    def _columns(self) -> dict[str, NDArray[np.float64]]:
        """Return the parameters and the quantities, as flat arrays."""
        values = {name: np.asarray(getattr(self, name)) for name in QUANTITIES}
        shape = values["error"].shape
        given = {
            name: np.broadcast_to(real(name, value), shape)
            for name, value in self._parameters.items()
        }
        return {name: array.ravel() for name, array in (given | values).items()}


def solve(
    a_over_t: ArrayLike,
    e1_over_e2: ArrayLike,
    nu1: ArrayLike,
    e0_over_e2: ArrayLike,
    nu0: ArrayLike = 0.25,
    tolerance: ArrayLike = 1e-8,
    *,
    errors: Errors = "raise",
) -> Solution:
    """Solve contacts directly, without a table, on all cores.

    The parameters broadcast as numpy's functions do. The results do not depend on the number of
    cores.

    Parameters
    ----------
    a_over_t : array_like
        Contact radius over film thickness, 1e-6 to 1e6.
    e1_over_e2 : array_like
        Young's modulus of the film over the sphere's reduced modulus E2*; 0 is a rigid sphere: then
        the quantities are in units of the film's reduced modulus, and ``e0_over_e2`` is E0/E1.
    nu1 : array_like
        Poisson ratio of the film, above -1 and at most 0.5.
    e0_over_e2 : array_like
        Young's modulus of the substrate over E2*; infinity is a rigid substrate.
    nu0 : array_like
        Poisson ratio of the substrate, above -1 and at most 0.5.
    tolerance : array_like
        The largest relative error allowed, 1e-13 to 1e-2.
    errors : {"raise", "nan"}
        What a point with an error gives: an exception, or NaN.

    Returns
    -------
    Solution
        The four quantities in units of E2*, and their estimated error.

    Examples
    --------
    >>> solution = solve(65.0, 1.75, 0.5, 1e5, tolerance=1e-10)
    >>> solution.error <= 1e-10
    True
    >>> solve([0.1, 1.0], 1.75, 0.5, 1e5).eeq.round(4)
    array([0.7243, 0.8912])
    """
    parameters: dict[str, ArrayLike] = {
        "a_over_t": a_over_t,
        "e1_over_e2": e1_over_e2,
        "nu1": nu1,
        "e0_over_e2": e0_over_e2,
        "nu0": nu0,
    }
    return solution(_core.solve, errors, parameters, tolerance=tolerance)


def solve_stack(
    a_over_t: ArrayLike,
    stack: Stack,
    sphere_modulus: ArrayLike,
    tolerance: ArrayLike = 1e-8,
    *,
    errors: Errors = "raise",
) -> Solution:
    """Solve contacts of a sphere with a stack of layers, on all cores.

    Parameters
    ----------
    a_over_t : array_like
        Contact radius over the thickness of the whole stack. The contact radius is at most 1000
        times the thickness of the top layer.
    stack : Stack
        The layers and their base.
    sphere_modulus : array_like
        Reduced modulus E2* of the sphere, Pa; infinity is a rigid sphere: then the quantities are
        in units of the reduced modulus of the solid that the sphere touches.
    tolerance : array_like
        The largest relative error allowed, 1e-13 to 1e-2.
    errors : {"raise", "nan"}
        What a point with an error gives: an exception, or NaN.

    Returns
    -------
    Solution
        The four quantities in units of E2*, and their estimated error.

    Examples
    --------
    >>> from coated_contact import Elastic, Layer
    >>> primer = Elastic(young_modulus=0.5e6, poisson_ratio=0.5)
    >>> elastomer = Elastic(young_modulus=3.5e6, poisson_ratio=0.5)
    >>> stack = Stack(base=Elastic(young_modulus=2e11, poisson_ratio=0.25),
    ...               layers=[Layer(material=primer, thickness=2.5e-6),
    ...                       Layer(material=elastomer, thickness=7.5e-6)])
    >>> solve_stack([0.1, 1.0, 6.5], stack, 2e6).eeq.round(4)
    array([0.7123, 0.8471, 0.9748])
    """
    if not isinstance(stack, Stack):
        raise TypeError(f"stack must be a Stack, not {type(stack).__name__}")
    parameters: dict[str, ArrayLike] = {"a_over_t": a_over_t, "sphere_modulus": sphere_modulus}
    native = partial(_core.solve_stack, stack._native)
    return solution(native, errors, parameters, tolerance=tolerance)


def solution(
    native: Callable[..., Any],
    errors: Errors,
    parameters: dict[str, ArrayLike],
    **further: ArrayLike,
) -> Solution:
    """Evaluate the broadcast parameters, and further numbers that are none of the solution's."""
    found = evaluate(native, errors, **parameters, **further)
    pi0, eeq, gamma, delta0, error = map(scalar_or_array, found)
    given: dict[str, ArrayLike] = {
        name: fixed(real(name, value)) for name, value in parameters.items()
    }
    return Solution(pi0, eeq, gamma, delta0, error, given)
