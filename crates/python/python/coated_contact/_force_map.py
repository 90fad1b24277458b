"""The curves of a force map with their times and places, maps of values, and pictures of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import real
from ._columns import Array, axes
from ._errors import FitError
from ._experiment import Experiment, unit_of
from ._values import OneLine

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

    from ._fit_map import FitMap


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class ForceMap(OneLine):
    """Force curves of one file, in its order: see :func:`read_afm`.

    It is a sequence of experiments, which :func:`fit_map` takes as it is.

    Attributes
    ----------
    experiments : tuple of Experiment
        The curves.
    times : tuple of numpy.ndarray or None
        The time of each point of each curve, s; None where the file does not tell it.
    position : numpy.ndarray
        The place x, y of each curve in the coordinates of the instrument, m; NaN where the file
        does not tell it.
    pixel : numpy.ndarray
        The row and the column of each curve in the map; -1 of a curve that is not of it.
    shape : tuple of int or None
        The rows and columns of the map; None without a map.
    pixel_size : tuple of float or None
        The height and the width of a pixel, m.
    refused : dict of int to str
        Why a curve of the file is no experiment, by its number in the file.
    """

    experiments: tuple[Experiment, ...]
    times: tuple[Array | None, ...]
    position: Array
    pixel: NDArray[np.int64]
    shape: tuple[int, int] | None
    pixel_size: tuple[float, float] | None
    refused: dict[int, str]

    def __len__(self) -> int:
        return len(self.experiments)

    def __getitem__(self, i: int) -> Experiment:
        return self.experiments[i]

    def __iter__(self) -> Iterator[Experiment]:
        return iter(self.experiments)

    def __repr__(self) -> str:
        """Return the numbers of curves on one line."""
        grid = "" if self.shape is None else f" on {self.shape[0]} x {self.shape[1]} pixels"
        return f"<ForceMap of {len(self)} curves{grid}, {len(self.refused)} refused>"

    def image(self, values: ArrayLike) -> Array:
        """Return one value for each curve as an array of the map; NaN where there is no curve.

        Curves that are not of the map are left out.

        Raises
        ------
        FitError
            For a file without a map, for another number of values than curves, and for two values
            of one pixel.

        Examples
        --------
        >>> curves = read_afm("map.jpk-force-map", system=system)  # doctest: +SKIP
        >>> curves.image([one.system.film_thickness for one in curves])  # doctest: +SKIP
        """
        column = real("values", values)
        if self.shape is None:
            raise FitError("the file holds no map: its curves have no pixels")
        if column.shape != (len(self),):
            raise FitError(
                f"values has the shape {column.shape}: give ({len(self)},), one for each curve",
                axis="values",
            )
        image = np.full(self.shape, np.nan)
        pixels: dict[tuple[int, int], int] = {}
        for i in np.flatnonzero((self.pixel[:, 0] >= 0) & ~np.isnan(column)).tolist():
            pixel = (int(self.pixel[i, 0]), int(self.pixel[i, 1]))
            if (before := pixels.setdefault(pixel, i)) != i:
                raise FitError(
                    f"curves {before} and {i} are of one pixel, {pixel}: give NaN for one of them",
                    axis="values",
                )
            image[pixel] = column[i]
        return image

    def to_xarray(self, found: FitMap) -> xarray.Dataset:
        """Return the results of the curves as maps over ``y`` and ``x``, m; needs xarray.

        ``y`` and ``x`` are the centres of the pixels, from the corner of the map on.
        """
        import xarray

        variables = {}
        for name, values in found.params.items():
            units = {"units": unit_of(name)}
            variables[name] = (("y", "x"), self.image(values), units)
            variables[f"{name}_stderr"] = (("y", "x"), self.image(found.stderr[name]), units)
        variables["chi_squared"] = (("y", "x"), self.image(found.chi_squared), {"units": "1"})
        sizes = zip("yx", self.shape or (), self.pixel_size or (), strict=True)
        places = {
            axis: (axis, (np.arange(count) + 0.5) * size, {"units": "m"})
            for axis, count, size in sizes
        }
        return xarray.Dataset(variables, coords=places)

    def plot(
        self, values: ArrayLike, name: str = "", unit: str = "", *, ax: Axes | None = None
    ) -> Axes:
        """Draw one value for each curve as a map with a scale bar; needs matplotlib.

        Parameters
        ----------
        values : array_like
            The values, such as ``found.params["film_modulus"]`` of a :class:`FitMap`, in ``unit``.
        name, unit : str
            What is drawn, and its SI unit. With one, the numbers beside the colours have prefixes.
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default the current axes.

        Returns
        -------
        matplotlib.axes.Axes
            The axes; their coordinates are m from the corner of the map. Pixels without a value are
            left empty.
        """
        from matplotlib.ticker import EngFormatter
        from mpl_toolkits.axes_grid1.anchored_artists import AnchoredSizeBar

        image, ax = self.image(values), axes(ax)
        (height, width), (rows, columns) = self.pixel_size or (1.0, 1.0), image.shape
        sides = (0.0, width * columns, 0.0, height * rows)
        drawn = ax.imshow(image, origin="lower", extent=sides)
        units, prefixes = (f" ({unit})", EngFormatter()) if unit else ("", None)
        ax.figure.colorbar(drawn, ax=ax, label=f"{name}{units}", format=prefixes)
        ax.set_xticks([])
        ax.set_yticks([])
        length = _round_below(width * columns / 3)
        if np.isfinite(length):
            bar = AnchoredSizeBar(
                ax.transData,
                length,
                EngFormatter("m")(length),
                "lower right",
                size_vertical=0.015 * height * rows,
                bbox_to_anchor=(1.0, 0.0),
                bbox_transform=ax.transAxes,
            )
            bar.patch.set_alpha(0.8)
            ax.add_artist(bar)
        return ax


def _round_below(most: float) -> float:
    """Return the largest of 1, 2, 5, 10, ... that is not above a length."""
    if not 0 < most < np.inf:
        return np.nan
    power = 10.0 ** np.floor(np.log10(most))
    return float(power * max(one for one in (1, 2, 5) if one * power <= most * (1 + 1e-12)))
