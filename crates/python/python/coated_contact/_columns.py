"""Results that are columns: arrays of one shape with units, as tables and drawings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from . import _html
from ._values import OneLine

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

# The units of all columns.
UNITS = {
    "time": "s",
    "contact_radius": "m",
    "outer_radius": "m",
    "load": "N",
    "penetration": "m",
    "energy_release_rate": "J/m^2",
}


class Columns(OneLine):
    """An instance of a dataclass whose fields are arrays of one shape."""

    __slots__ = ()
    # What is drawn: the abscissa, then the ordinate.
    _drawn: ClassVar[tuple[str, str]] = ("penetration", "load")

    def _columns(self) -> dict[str, Array]:
        return {one.name: getattr(self, one.name) for one in fields(self)}  # type: ignore[arg-type]

    def __len__(self) -> int:
        first, *_ = self._columns().values()
        return first.size

    def _rows(self) -> Iterator[tuple[float, ...]]:
        """Return the rows of the flattened arrays."""
        return zip(*(array.ravel().tolist() for array in self._columns().values()), strict=True)

    def to_pandas(self) -> pandas.DataFrame:
        """Return a row for each state, in the order of the flattened arrays; needs pandas."""
        import pandas

        return pandas.DataFrame({name: array.ravel() for name, array in self._columns().items()})

    def to_xarray(self) -> xarray.Dataset:
        """Return a Dataset with the dimensions of the arrays, ``dim_0`` and so on; needs xarray."""
        import xarray

        return xarray.Dataset(
            {
                name: ([f"dim_{axis}" for axis in range(array.ndim)], array, {"units": UNITS[name]})
                for name, array in self._columns().items()
            }
        )

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw load against penetration, or against time where there is one; needs matplotlib.

        It draws into ``ax``, by default the current axes, and returns the axes.
        """
        ax = axes(ax)
        x, y = (getattr(self, name).ravel() for name in self._drawn)
        ax.plot(x, y)
        name_axes(ax, *map(label, self._drawn))
        return ax

    def _repr_html_(self) -> str:
        """Return what a notebook shows: the first states."""
        return _html.numbers({label(name): a.ravel() for name, a in self._columns().items()})


class TimedColumns(Columns):
    """Columns over the time."""

    __slots__ = ()
    _drawn = ("time", "load")

    def to_xarray(self) -> xarray.Dataset:
        """Return a Dataset over ``time``; needs xarray."""
        return super().to_xarray().swap_dims(dim_0="time").set_coords("time")


def label(name: str) -> str:
    """Return the name of a column in words, with its unit."""
    return f"{name.replace('_', ' ')} ({UNITS[name]})"


def axes(given: Axes | None) -> Axes:
    """Return the axes given, or the current ones of matplotlib."""
    if given is not None:
        return given
    from matplotlib import pyplot

    return pyplot.gca()


def name_axes(ax: Axes, abscissa: str, ordinate: str) -> None:
    """Label the axes of coordinates in SI units.

    The prefix stands at the numbers along them, so that each number stays right where another label
    or another drawing is added.
    """
    from matplotlib.ticker import EngFormatter

    for axis, name in ((ax.xaxis, abscissa), (ax.yaxis, ordinate)):
        axis.set_label_text(name)
        axis.set_major_formatter(EngFormatter())
