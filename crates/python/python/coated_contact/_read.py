"""Measurements from files of text."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal, get_args

import numpy as np

from . import _core
from ._arrays import number
from ._bodies import HalfSpace, System
from ._errors import FitError
from ._experiment import Experiment, Kind, one_of
from ._indentation import Indentation
from ._stack import StackSystem

Role = Literal[
    "contact_radius",
    "load",
    "penetration",
    "height",
    "deflection",
    "separation",
    "segment",
    "contact_radius_error",
    "load_error",
    "penetration_error",
    "height_error",
    "contact_stiffness",
    "contact_area",
    "phase_shift",
    "loss_stiffness",
    "time",
    "contact_stiffness_error",
]
Segments = Literal["auto", "file", "split"]
Direction = Literal["approach", "retract"]


def read_experiment(
    path: str | os.PathLike[str],
    kind: Kind | None = None,
    *,
    system: System | HalfSpace | StackSystem,
    columns: Mapping[Role, str | int | Sequence[str]] | None = None,
    segments: Segments = "auto",
    only: Direction | None = None,
    between: tuple[float, float] | None = None,
    stiffness: float | None = None,
    sensitivity: float | None = None,
    **known: Any,
) -> Experiment:
    """Read a measurement from a file of text, such as an instrument exports.

    The reader is that of ``tabulate fit``: cells between tabs, semicolons, commas or spaces, a
    decimal point or comma, UTF-8, UTF-16 or Latin-1, comment lines and other lines above the
    headings. Columns are recognised by headings with a unit, such as ``Force [mN]``, ``Displacement
    Into Surface (nm)`` or ``height_nm``. Segments of the file may have columns of their own;
    pauses are left out. Numbers become SI units.

    Parameters
    ----------
    path : str or os.PathLike
        The file.
    kind : {"load-radius", "penetration-radius", "load-penetration", "force-height", \
"stiffness-radius", "stiffness-load", "stiffness-depth"}, optional
        What is measured; by default the only kind that the columns fit.
    system : System, HalfSpace or StackSystem
        The bodies.
    columns : mapping, optional
        Columns that are not recognised: the heading, with a unit if the file has none, or the
        number from 1, for ``"contact_radius"``, ``"load"``, ``"penetration"``, ``"height"``,
        ``"deflection"``, ``"separation"``, ``"segment"``, ``"contact_stiffness"``,
        ``"contact_area"``, ``"phase_shift"``, ``"loss_stiffness"`` or ``"time"``, and for the
        standard deviation of one of them with ``_error``, such as ``"load_error"``. A minus
        before it turns the sign. Where approach and retract have columns of their own, give both
        headings.
    segments : {"auto", "file", "split"}
        ``"file"``: directions come from the file. ``"split"``: the points are split at the turn of
        the height, penetration or load that is the abscissa, and at contact radii at the largest
        ordinate. ``"auto"``: from the file, and heights without a direction are split.
    only : {"approach", "retract"}, optional
        The only direction that is kept. Of a contact stiffness at loads or depths it is the
        approach, unless another is asked for.
    between : tuple of float, optional
        The least and the largest abscissa that are kept, m or N.
    stiffness : float, optional
        Stiffness of the cantilever, N/m; by default that which the head of the file names.
    sensitivity : float, optional
        Sensitivity, m/V, of a deflection in volts; by default that of the head of the file.
    **known
        What else is known: further fields of :class:`Experiment`, such as ``work_of_adhesion`` or
        ``noise``.

    Returns
    -------
    Experiment
        The measurement. Its ``reading`` says how the file was read, and where the stiffness is
        from.

    Raises
    ------
    FitError
        For a file that is no such table, naming the line, the column and what to give.

    Warns
    -----
    UserWarning
        Where a column seems to count in the opposite sense, the baseline seems tilted, commas or
        points may part thousands, the directions seem wrong, or the file seems to hold several
        curves.

    Examples
    --------
    >>> from coated_contact import Elastic, HalfSpace
    >>> gel = Elastic(young_modulus=5e3, poisson_ratio=0.5)
    >>> system = HalfSpace(sphere_radius=1e-5, sphere_modulus=float("inf"), solid=gel)
    >>> curve = read_experiment("curve.txt", "force-height", system=system)  # doctest: +SKIP
    >>> curve.stiffness  # doctest: +SKIP
    0.0223
    """
    if kind is not None:
        one_of("kind", kind, get_args(Kind))
    one_of("segments", segments, get_args(Segments))
    if only is not None:
        one_of("only", only, get_args(Direction))
    given = {
        "kind": kind,
        "columns": _columns(columns or {}),
        "stiffness": None if stiffness is None else number("stiffness", stiffness),
        "sensitivity": None if sensitivity is None else number("sensitivity", sensitivity),
        "segments": segments,
        "only": only,
        "between": None if between is None else _ends(between),
        # A hold is a part of the history of a film that relaxes.
        "keep_pauses": known.get("relaxation") is not None,
    }
    fields, doubt = _core.read_file(os.fsdecode(path), given)
    if doubt is not None:
        warnings.warn(f"{fields['name']}: {doubt}", stacklevel=2)
    if stiffness is not None:
        fields["stiffness"] = stiffness
    beside = {name: fields.pop(name) for name in ("loads", "phases") if name in fields}
    if beside:
        indentation = known.pop("indentation", None) or Indentation()
        fields["indentation"] = replace(indentation, **beside)
    return Experiment(system=system, **{**fields, **known})


def _ends(between: tuple[float, float]) -> tuple[float, float]:
    """Return the ends of a range."""
    least, most = (number("between", end) for end in between)
    if not least < most:
        raise FitError(f"between = {between!r} cannot be used: the first must be below the second")
    return least, most


def _columns(given: Mapping[Role, str | int | Sequence[str]]) -> list[tuple[str, str]]:
    """Return what each column holds and its heading."""
    found: list[tuple[str, str]] = []
    for role, headings in given.items():
        one_of("columns", role, get_args(Role))
        if isinstance(headings, int | np.integer):
            headings = str(headings)
        for heading in [headings] if isinstance(headings, str) else headings:
            if not isinstance(heading, str):
                raise TypeError(f"columns: the heading of {role} must be a str, not {heading!r}")
            if not heading.strip().removeprefix("-").strip():
                raise FitError(
                    f"columns: the heading of {role!r} is empty: give its text or its number",
                    axis="columns",
                )
            found.append((role, heading))
    return found
