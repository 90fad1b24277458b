"""What notebooks show of contacts and fits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from math import sqrt

from ._bodies import HalfSpace, System

# The width and the height of a drawing, and the height of the surface in it, in pixels.
WIDTH, HEIGHT, SURFACE = 320, 140, 90


def table(header: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table; every cell is text."""

    def line(tag: str, cells: Sequence[object]) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(str(c))}</{tag}>" for c in cells) + "</tr>"

    return "<table>" + line("th", header) + "".join(line("td", row) for row in rows) + "</table>"


def contact(system: System | HalfSpace) -> str:
    """Return a contact as a drawing to scale and a table of its bodies."""
    film = system.film if isinstance(system, System) else None
    base = system.substrate if isinstance(system, System) else system.solid
    rows: list[tuple[str, str, str, str]] = [
        ("sphere", f"R = {system.sphere_radius:g} m", f"E2* = {system.sphere_modulus:g} Pa", "")
    ]
    if isinstance(system, System) and film is not None:
        size = f"t = {system.film_thickness:g} m"
        rows.append(("film", size, f"E1 = {film.young_modulus:g} Pa", f"{film.poisson_ratio:g}"))
    rows.append(
        (
            "substrate" if film else "half-space",
            "",
            f"E0 = {base.young_modulus:g} Pa",
            f"{base.poisson_ratio:g}",
        )
    )
    return drawing(system) + table(("body", "size", "modulus", "Poisson ratio"), rows)


def drawing(system: System | HalfSpace) -> str:
    """Return the undeformed bodies to scale: where the sphere is some four thicknesses high."""
    radius = system.sphere_radius
    thickness = system.film_thickness if isinstance(system, System) else 0.0
    half = 1.1 * radius
    if thickness:
        half = min(half, 2 * sqrt(2 * radius) * sqrt(thickness))
    scale = WIDTH / 2 / half
    film = min(thickness * scale, HEIGHT)
    return (
        f'<svg width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}">'
        f'<circle cx="{WIDTH / 2}" cy="{SURFACE - radius * scale}" r="{radius * scale}" '
        'fill="#9bd" stroke="#357"/>'
        f'<rect x="0" y="{SURFACE}" width="{WIDTH}" height="{HEIGHT}" fill="#bbb"/>'
        f'<rect x="0" y="{SURFACE}" width="{WIDTH}" height="{film}" fill="#fc8"/>'
        "</svg>"
    )
