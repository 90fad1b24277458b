"""What notebooks show of contacts and fits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from math import inf

import numpy as np
from numpy.typing import NDArray

from ._bodies import Elastic, HalfSpace, System
from ._probe import FlatPunch, Paraboloid, Probe, Profile, Sphere
from ._stack import StackSystem

# The width and the height of a drawing, and the height of the surface in it, in pixels.
WIDTH, HEIGHT, SURFACE = 320, 140, 90
# The points of the outline of half a probe.
POINTS = 60
# The colours of neighbouring layers.
FILMS = ("#fc8", "#fe9", "#da8")
# The largest number of rows that are listed.
MOST_ROWS = 12


def table(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table; every cell is text."""

    def line(tag: str, cells: Sequence[object]) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(str(c))}</{tag}>" for c in cells) + "</tr>"

    return "<table>" + line("th", header) + "".join(line("td", row) for row in rows) + "</table>"


def numbers(columns: Mapping[str, NDArray[np.float64]]) -> str:
    """Return the first rows of flat arrays."""
    count = len(next(iter(columns.values())))
    rows = zip(*(column[:MOST_ROWS] for column in columns.values()), strict=True)
    shown: list[list[str]] = [[f"{value:.6g}" for value in row] for row in rows]
    if count > MOST_ROWS:
        shown.append([f"{count - MOST_ROWS} more", *[""] * (len(columns) - 1)])
    return table(list(columns), shown)


def contact(system: System | HalfSpace | StackSystem) -> str:
    """Return a contact as a drawing to scale and a table of its bodies."""
    rows = [(system.probe.name, _size(system.probe), f"E2* = {system.sphere_modulus:g} Pa", "")]
    for name, solid, thickness in reversed(_solids(system)):
        size = "" if thickness is None else f"t = {thickness:g} m"
        rows.append((name, size, f"E = {solid.young_modulus:g} Pa", f"{solid.poisson_ratio:g}"))
    if len(rows) > MOST_ROWS:
        left_out = len(rows) - (MOST_ROWS - 1)
        rows[MOST_ROWS - 2 : -1] = [(f"{left_out} more layers", "", "", "")]
    return drawing(system) + table(("body", "size", "modulus", "Poisson ratio"), rows)


def _size(probe: Probe) -> str:
    """Return the numbers of a probe."""
    if isinstance(probe, Profile):
        return f"{len(probe.points)} points up to {probe.points[-1][0]:g} m"
    words = {
        "radius": "R = {:g} m",
        "half_angle": "half angle {:g} rad",
        "coefficient": "c = {:g}",
        "exponent": "n = {:g}",
    }
    sizes = [text.format(getattr(probe, n)) for n, text in words.items() if hasattr(probe, n)]
    return ", ".join(sizes)


def _solids(
    system: System | HalfSpace | StackSystem,
) -> list[tuple[str, Elastic, float | None]]:
    """Return name, solid and thickness of each body from the base up; a base has no thickness."""
    if isinstance(system, HalfSpace):
        return [("half-space", system.solid, None)]
    if isinstance(system, System):
        film = ("film", system.film, system.film_thickness)
        return [("substrate", system.substrate, None), film]
    layers = system.stack.layers
    named = [
        (layer.name or f"layer {i}", layer.material, layer.thickness)
        for i, layer in enumerate(layers, 1)
    ]
    return [("base", system.stack.base, None), *named]


def drawing(system: System | HalfSpace | StackSystem) -> str:
    """Return the undeformed bodies to scale.

    The probe is drawn to a height of about four thicknesses above the surface.
    """
    solids = _solids(system)
    thickness = sum(t for _, _, t in solids if t is not None)
    half = _half_width(system.probe, thickness)
    scale = WIDTH / 2 / half
    parts = [f'<rect x="0" y="{SURFACE}" width="{WIDTH}" height="{HEIGHT}" fill="#bbb"/>']
    top = float(SURFACE)
    for i, (_, _, t) in enumerate(reversed(solids)):
        if t is not None and top < HEIGHT:
            height = min(t * scale, HEIGHT - top)
            parts.append(
                f'<rect x="0" y="{top:g}" width="{WIDTH}" height="{height:g}" '
                f'fill="{FILMS[i % len(FILMS)]}"/>'
            )
            top += height
    r = np.linspace(-half, half, 2 * POINTS + 1)
    z = np.minimum(system.probe.height(r) * scale, 2.0 * HEIGHT)
    pixels = zip(WIDTH / 2 + r * scale, SURFACE - z, strict=True)
    outline = [f"{x:.1f},{y:.1f}" for x, y in pixels]
    corners = f"{WIDTH},{-HEIGHT} 0,{-HEIGHT}"
    probe = f'<polygon points="{" ".join(outline)} {corners}" fill="#9bd" stroke="#357"/>'
    return (
        f'<svg width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}">'
        + "".join([*parts, probe])
        + "</svg>"
    )


def _half_width(probe: Probe, thickness: float) -> float:
    """Return half the width (m) that is drawn."""
    most = inf
    if isinstance(probe, Profile):
        most = 1.1 * probe.points[-1][0]
    elif isinstance(probe, Paraboloid | Sphere | FlatPunch):
        most = 1.1 * probe.radius
    if isinstance(probe, FlatPunch) or not thickness:
        return most if most < inf else _radius_at(probe, 1e-6)
    return min(most, _radius_at(probe, 4 * thickness))


def _radius_at(probe: Probe, height: float) -> float:
    """Return the distance from the axis at which a probe has a height, to one part in a hundred."""
    radii = np.geomspace(1e-6 * height, 1e6 * height, 2 * POINTS * POINTS)
    return float(radii[np.searchsorted(probe.height(radii), height).clip(max=len(radii) - 1)])
