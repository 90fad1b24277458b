"""The results of a map of separate fits."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _html
from ._columns import Array, axes
from ._errors import ContactError
from ._experiment import unit_of
from ._fit_results import FitWarning
from ._values import OneLine

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class FitMap(OneLine):
    """The results of separate fits of many curves, as arrays over the curves.

    A curve without a result has NaN, and its error in ``failures``.

    Attributes
    ----------
    params : dict of str to numpy.ndarray
        The values found, in SI units, by the name of the parameter.
    stderr : dict of str to numpy.ndarray
        The standard errors, in SI units.
    covariance : numpy.ndarray
        The covariance matrices, in the order of ``params``; the first axis is the curves.
    converged : numpy.ndarray
        Whether the method found a minimum.
    chi_squared : numpy.ndarray
        The sums of the squared residuals, in units of the noise.
    warnings : tuple of tuple of FitWarning
        The doubts about each result.
    failures : dict of int to ContactError
        The error of each curve that has no result.
    """

    params: dict[str, Array]
    stderr: dict[str, Array]
    covariance: Array
    converged: NDArray[np.bool_]
    chi_squared: Array
    warnings: tuple[tuple[FitWarning, ...], ...]
    failures: dict[int, ContactError]

    def __len__(self) -> int:
        return len(self.converged)

    def __repr__(self) -> str:
        """Return the numbers of curves on one line."""
        names = ", ".join(self.params)
        return f"<FitMap of {len(self)} curves, {len(self.failures)} without a result: {names}>"

    def __str__(self) -> str:
        """Return medians and quartiles, and how often there are doubts."""
        lines = [f"{len(self)} curves, {int(self.converged.sum())} converged"]
        lines += [
            f"  {name:<25} median {median} ({low} to {high} in the middle half), "
            f"median standard error {error} {unit_of(name)}"
            for name, low, median, high, error in self._medians()
        ]
        return "\n".join(lines + [f"{kind}: {count} curves" for kind, count in self._doubts()])

    def _medians(self) -> list[tuple[str, ...]]:
        """Return name, quartiles and median standard error of each parameter, of converged fits."""
        rows = []
        for name, values in self.params.items():
            converged = self.converged & ~np.isnan(values)
            found, errors = values[converged], self.stderr[name][converged]
            quartiles = np.quantile(found, [0.25, 0.5, 0.75]) if len(found) else [np.nan] * 3
            known = errors[np.isfinite(errors)]
            error = np.median(known) if len(known) else np.nan
            rows.append((name, *(f"{value:.4g}" for value in quartiles), f"{error:.2g}"))
        return rows

    def _doubts(self) -> list[tuple[str, int]]:
        """Return each kind of warning with the number of curves that have it."""
        kinds = Counter(kind for doubts in self.warnings for kind in {one.kind for one in doubts})
        failed = [("no result", len(self.failures))] if self.failures else []
        return kinds.most_common() + failed

    def _repr_html_(self) -> str:
        """Return what a notebook shows: medians and quartiles, and how often there are doubts."""
        header = ("parameter (SI)", "first quartile", "median", "third quartile")
        table = _html.table((*header, "median standard error"), self._medians())
        doubts = self._doubts()
        return table + (
            _html.table(("warning", f"of {len(self)} curves"), doubts) if doubts else ""
        )

    def plot(
        self,
        parameter: str | None = None,
        *,
        shape: tuple[int, int] | None = None,
        ax: Axes | None = None,
    ) -> Axes:
        """Draw one parameter over the curves, as a map where its shape is given; needs matplotlib.

        Parameters
        ----------
        parameter : str, optional
            The parameter; by default the first one.
        shape : tuple of int, optional
            Rows and columns of the map: the curves are in the order of its rows, the first of which
            is drawn below. Without it the values are drawn with their standard errors over the
            numbers of the curves.
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default the current axes.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. Curves without a result are left empty.
        """
        from matplotlib.ticker import EngFormatter, MaxNLocator, ScalarFormatter

        name = next(iter(self.params)) if parameter is None else parameter
        if name not in self.params:
            raise ValueError(f"{name!r} was not fitted: give one of {', '.join(self.params)}")
        values, unit = self.params[name], unit_of(name)
        label, prefixes = f"{name} ({unit})", EngFormatter() if unit != "1" else ScalarFormatter()
        ax = axes(ax)
        if shape is None:
            ax.errorbar(np.arange(len(self)), values, self.stderr[name], fmt=".", capsize=2)
            ax.set_xlabel("curve")
            ax.set_ylabel(label)
            ax.yaxis.set_major_formatter(prefixes)
            return ax
        if np.prod(shape) != len(self):
            raise ValueError(f"shape = {shape} is that of {np.prod(shape)} curves, not {len(self)}")
        image = ax.imshow(values.reshape(shape), origin="lower")
        ax.figure.colorbar(image, ax=ax, label=label, format=prefixes)
        for axis, counted in ((ax.xaxis, "column"), (ax.yaxis, "row")):
            axis.set_label_text(counted)
            axis.set_major_locator(MaxNLocator(integer=True))
        return ax

    def to_pandas(self) -> pandas.DataFrame:
        """Return a row for each curve: values, standard errors and kinds of warnings.

        Needs pandas.
        """
        import pandas

        columns: dict[str, Any] = {}
        for name, values in self.params.items():
            columns[name], columns[f"{name}_stderr"] = values, self.stderr[name]
        columns["converged"], columns["chi_squared"] = self.converged, self.chi_squared
        columns["warnings"] = [
            " ".join(warning.kind for warning in warnings) for warnings in self.warnings
        ]
        return pandas.DataFrame(columns).rename_axis("curve")

    def to_xarray(self) -> xarray.Dataset:
        """Return the values and the standard errors over ``curve``; needs xarray.

        Examples
        --------
        >>> from coated_contact import fit_map
        >>> fit_map([], ["film_modulus"]).to_xarray()["film_modulus"].attrs["units"]
        'Pa'
        """
        import xarray

        variables: dict[str, Any] = {}
        for name, values in self.params.items():
            units = {"units": unit_of(name)}
            variables[name] = ("curve", values, units)
            variables[f"{name}_stderr"] = ("curve", self.stderr[name], units)
        variables["converged"] = ("curve", self.converged)
        variables["chi_squared"] = ("curve", self.chi_squared)
        return xarray.Dataset(variables)
