"""Drawings of fits: the data as measured, and the reduced JKR plot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from ._columns import Array, axes, name_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._fit_results import FittedExperiment

PlotKind = Literal["data", "jkr"]

# What is measured, with its unit: abscissa and ordinate.
QUANTITIES = {
    "load-radius": ("contact radius (m)", "load (N)"),
    "penetration-radius": ("contact radius (m)", "penetration (m)"),
    "load-penetration": ("penetration (m)", "load (N)"),
    "force-height": ("height (m)", "force (N)"),
    "stiffness-radius": ("contact radius (m)", "contact stiffness (N/m)"),
    "stiffness-load": ("load (N)", "contact stiffness (N/m)"),
    "stiffness-depth": ("depth (m)", "contact stiffness (N/m)"),
}
JKR = (
    r"$a^{3/2} / (\sqrt{\pi}\, R)$  (m$^{1/2}$)",
    r"$F / (\sqrt{6\pi}\, a^{3/2})$  (N m$^{-3/2}$)",
)


@dataclass(frozen=True)
class Curve:
    """The points of an experiment as they are drawn."""

    x: Array
    data: Array
    fit: Array
    without_film: Array
    branch: NDArray[np.str_]
    retract: NDArray[np.bool_]
    used: NDArray[np.bool_]

    def lines(self, y: Array) -> Iterator[tuple[Array, Array, bool]]:
        """Return the line through the points of each branch and direction that have a value."""
        for retract in (False, True):
            for branch in dict.fromkeys(self.branch.tolist()):
                on = (self.branch == branch) & (self.retract == retract) & ~np.isnan(y)
                x, values = self.x[on], y[on]
                # Points at one place, those of a hold, stay beside those before and after in time.
                if x.size and x[0] > x[-1]:
                    x, values = x[::-1], values[::-1]
                order = np.argsort(x, kind="stable")
                if order.size:
                    yield x[order], values[order], retract


def draw(experiments: tuple[FittedExperiment, ...], kind: PlotKind, ax: Axes | None) -> Axes:
    """Draw experiments of one kind."""
    if kind not in get_args(PlotKind):
        raise ValueError(f'kind = {kind!r} cannot be drawn: give "data" or "jkr"')
    if len({one.kind for one in experiments}) > 1:
        raise ValueError(
            "the experiments measure different quantities, which one pair of axes cannot show: "
            "give the number of one, experiment=0"
        )
    curves = [_curve(one, kind) for one in experiments]
    ax = axes(ax)
    alone = len(curves) == 1
    both = any(curve.retract.any() and not curve.retract.all() for curve in curves)
    for i, (curve, one) in enumerate(zip(curves, experiments, strict=True)):
        for retract in (False, True):
            on = curve.used & (curve.retract == retract)
            if on.any():
                colour = f"C{int(retract)}" if alone else f"C{i % 10}"
                name = "data" if alone else one.name
                # Open markers are those of retract, in print without colours too.
                ax.plot(
                    curve.x[on],
                    curve.data[on],
                    "o",
                    color=colour,
                    markersize=4,
                    markerfacecolor="none" if retract else colour,
                    label=_label(name, retract, both),
                )
        if not curve.used.all():
            off = ~curve.used
            ax.plot(curve.x[off], curve.data[off], "x", color="0.6", label="left out or far off")
    for curve in curves:
        for x, y, retract in curve.lines(curve.fit):
            ax.plot(x, y, "--" if retract else "-", color="k", label=_label("fit", retract, both))
        for x, y, _ in curve.lines(curve.without_film):
            ax.plot(x, y, ":", color="0.4", label="fit without the film")
    if kind == "jkr":
        ax.set_xlabel(JKR[0])
        ax.set_ylabel(JKR[1])
    else:
        name_axes(ax, *QUANTITIES[experiments[0].kind])
    # Each name once.
    handles, labels = ax.get_legend_handles_labels()
    named = dict(zip(labels, handles, strict=True))
    ax.legend(named.values(), named.keys())
    return ax


def _label(name: str, retract: bool, both: bool) -> str:
    """Return a name in the legend, with the direction where there are two."""
    return f"{name}, {'retract' if retract else 'approach'}" if both else name


def _curve(one: FittedExperiment, kind: PlotKind) -> Curve:
    """Return what is drawn of an experiment."""
    branch = np.array(one.branch, dtype=np.str_)
    retract = branch == "receding" if one.retract is None else one.retract
    used = ~np.isnan(one.fit) & ~one.outlier
    if kind == "data":
        x, data, fit, without = one.abscissa, one.ordinate, one.fit, one.without_film
        return Curve(x, data, fit, without, branch, retract, used)
    plot = one.jkr()
    there = ~np.isnan(plot["jkr_abscissa"])
    x, data, fit, without = (column[there] for column in plot.values())
    return Curve(x, data, fit, without, branch[there], retract[there], used[there])
