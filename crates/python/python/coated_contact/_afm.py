"""Force curves and force maps from the files of AFMs, by the package afmformats."""

from __future__ import annotations

import logging
import os
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import number, real
from ._bodies import HalfSpace, System
from ._columns import Array
from ._errors import ContactError, FitError
from ._experiment import Experiment, one_of
from ._force_map import ForceMap
from ._magnitudes import unchecked
from ._read import Direction
from ._stack import StackSystem

# What afmformats calls the readings of a curve.
FORCE, HEIGHTS, TIP = "force", ("height (measured)", "height (piezo)"), "tip position"
# What tells the surface where only the height of the substrate is known: the part of the approach
# that is far from it, and the number of standard deviations of the force that is a contact.
FAR, TOUCH = 0.2, 5.0
# A segment that moves by less than this part of the range of heights is a pause.
PAUSE = 0.5


def read_afm(
    path: str | os.PathLike[str],
    *,
    system: System | HalfSpace | StackSystem,
    stiffness: float | None = None,
    sensitivity: float | None = None,
    only: Direction | None = None,
    film_thickness: ArrayLike | None = None,
    height_image: ArrayLike | None = None,
    zero_level: float | None = None,
    **known: Any,
) -> ForceMap:
    """Read the force curves of a file of an AFM: those formats that afmformats reads.

    They are JPK (``.jpk-force``, ``.jpk-force-map``, ``.jpk-qi-data``), Asylum Research (``.ibw``),
    AFM workshop, NT-MDT, Optics11 Chiaro, and HDF5 or text of afmformats itself. Each curve becomes
    an experiment of forces against heights. Heights are those of the base of the cantilever,
    measured where the file has them, else of the piezo. Points of a pause are left out, but with a
    ``relaxation`` those after the first approach are kept, and all have their times. A curve
    whose segments the file does not tell is split at its smallest height. Needs afmformats.

    Parameters
    ----------
    path : str or os.PathLike
        The file.
    system : System, HalfSpace or StackSystem
        The bodies. The file knows nothing of them.
    stiffness : float, optional
        Stiffness of the cantilever, N/m; by default that of the file. Where the file holds forces
        (some of AFM workshop), it must be the one with which the instrument made them.
    sensitivity : float, optional
        Sensitivity, m/V, of deflections in volts; by default that of the file. Text of NT-MDT has
        deflections in nA: give m/A.
    only : {"approach", "retract"}, optional
        The only direction that is kept.
    film_thickness : array_like, optional
        Thickness of the film, m: one for each curve in the order of the measurement, or for each
        pixel of the map, rows first.
    height_image : array_like, optional
        Height of the surface of the film, m, in the same form. The thickness is this height less
        ``zero_level``.
    zero_level : float, optional
        Height of the surface of the substrate, m. Without a ``height_image`` the height of the film
        is that of the tip at the last point of the approach whose force is within 5 standard
        deviations of that far from the surface.
    **known
        What else is known: further fields of :class:`Experiment`, such as ``work_of_adhesion`` or
        ``noise``.

    Returns
    -------
    ForceMap
        The experiments in the order of the measurement, with their times and places. ``refused``
        tells why a curve is none.

    Raises
    ------
    ModuleNotFoundError
        Without afmformats.
    FitError
        For a file that afmformats does not read, for one without the stiffness of the cantilever
        where none is given, and for one without a curve that can be used.

    Examples
    --------
    >>> from coated_contact import Elastic, System, fit_map
    >>> glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
    >>> gel = Elastic(young_modulus=1e3, poisson_ratio=0.5)
    >>> system = System(sphere_radius=1e-5, sphere_modulus=glass.reduced_modulus, film=gel,
    ...                 film_thickness=2e-5, substrate=glass)
    >>> curves = read_afm("map.jpk-force-map", system=system, only="approach")  # doctest: +SKIP
    >>> found = fit_map(curves, ["film_modulus", "contact_point", "baseline"])  # doctest: +SKIP
    >>> curves.plot(found.params["film_modulus"], "film modulus", "Pa")  # doctest: +SKIP
    """
    if only is not None:
        one_of("only", only, get_args(Direction))
    given = {"spring constant": stiffness, "sensitivity": sensitivity}
    overridden = {
        name: _positive(name, value) for name, value in given.items() if value is not None
    }
    thickness = _Thickness(system, film_thickness, height_image, zero_level)
    file = Path(os.fsdecode(path))
    relaxes = known.get("relaxation") is not None
    experiments, places, times = [], [], []
    refused: dict[int, str] = {}
    curves = _load(file, overridden)
    holds_forces = _holds_forces(file, curves, overridden)
    if holds_forces and sensitivity is not None:
        raise FitError(
            f"{file}: it holds forces in newtons, which no sensitivity changes: leave it out",
            axis="sensitivity",
        )
    for i, curve in enumerate(curves):
        place = _Place(curve.metadata)
        name = f"{file}, curve {i}" if len(curves) > 1 else str(file)
        try:
            with _foreign(name):
                fields, time = _fields(curve, name, only, relaxes)
            if holds_forces:
                fields["reading"] += ", with which the instrument made the forces"
            system_there = thickness.at(i, len(curves), place, fields)
            one = Experiment(system=system_there, name=name, **{**fields, **known})
        except ContactError as error:
            refused[i] = str(error)
            continue
        experiments.append(one)
        times.append(time)
        places.append(place)
    if not experiments:
        reasons = " ".join(dict.fromkeys(refused.values())) or f"{file}: it holds no curve"
        raise FitError(reasons)
    # Curves without a place in a map, and those of a smaller one in the same file, are not of it.
    shapes = Counter(place.shape for place in places if place.shape is not None)
    shape = shapes.most_common(1)[0][0] if shapes else None
    return ForceMap(
        experiments=tuple(experiments),
        times=tuple(times),
        position=np.array([place.position for place in places]),
        pixel=np.array([place.pixel if place.shape == shape else (-1, -1) for place in places]),
        shape=shape,
        pixel_size=next(place.pixel_size for place in places if place.shape == shape),
        refused=refused,
    )


def _positive(name: str, value: float) -> float:
    """Return a positive number."""
    found = number(name, value)
    if not 0 < found < np.inf:
        raise FitError(f"{name} = {found!r} cannot be used: it must be positive", axis=name)
    return found


def _load(file: Path, overridden: dict[str, float]) -> list[Any]:
    """Load the curves of a file."""
    try:
        import afmformats
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            f"read_afm needs the package {error.name}: pip install afmformats", name=error.name
        ) from error
    with file.open("rb"):
        pass  # So that a file that is not there is an OSError.
    # Whatever the package logs is in the error, too.
    logger = logging.getLogger("afmformats.formats")
    was_disabled, logger.disabled = logger.disabled, True
    try:
        with _foreign(str(file)):
            if file.suffix not in afmformats.formats.supported_extensions:
                known = ", ".join(afmformats.formats.supported_extensions)
                raise FitError(
                    f"{file}: afmformats reads {known}, not {file.suffix!r}; read_experiment reads "
                    "tables of text"
                )
            return _in_order(list(afmformats.load_data(file, meta_override=overridden)))
    finally:
        logger.disabled = was_disabled


def _holds_forces(file: Path, curves: list[Any], overridden: dict[str, float]) -> bool:
    """Tell whether the forces of a file do not follow the stiffness and the sensitivity given."""
    # Those of JPK do, and such a file may be large.
    if not overridden or not curves or file.suffix.startswith(".jpk"):
        return False
    if FORCE not in curves[0].columns:
        return False
    changed = {name: value * (2 if value < 1 else 0.5) for name, value in overridden.items()}
    others = _load(file, changed)
    return np.array_equal(curves[0][FORCE], others[0][FORCE], equal_nan=True)


def _in_order(curves: list[Any]) -> list[Any]:
    """Return curves in the order in which they were measured, where each tells its number.

    afmformats reads the groups of an HDF5 file in the order of their names: 0, 1, 10, 11, 2.
    """
    numbers = [curve.metadata.get("enum") for curve in curves]
    if None in numbers:
        return curves
    return [curves[i] for i in sorted(range(len(curves)), key=numbers.__getitem__)]


@contextmanager
def _foreign(name: str) -> Iterator[None]:
    """Turn the errors of afmformats, some of which are no Exception, into a FitError."""
    try:
        yield
    except (ContactError, KeyboardInterrupt, SystemExit, GeneratorExit, MemoryError):
        raise
    except NotImplementedError as error:
        raise FitError(
            f"{name}: this format has a stiffness and a sensitivity of its own: leave those out"
        ) from error
    except BaseException as error:
        missing = getattr(error, "meta_keys", None)
        if missing is None:
            raise FitError(
                f"{name} cannot be read: {type(error).__name__}: {error}; export it as text for "
                "read_experiment"
            ) from error
        # A KeyError of a value that the file does not have is one of these, too.
        arguments = {
            "spring constant": "stiffness=, N/m",
            "sensitivity": "sensitivity=, m/V (text of NT-MDT has deflections in nA: m/A)",
        }
        wanted = " and ".join(arguments.get(key, key) for key in missing)
        raise FitError(
            f"{name}: the file does not tell the {' and the '.join(missing)}: give {wanted}",
            axis=missing[0],
        ) from error


def _fields(
    curve: Any, name: str, only: Direction | None, relaxes: bool
) -> tuple[dict[str, Any], Array | None]:
    """Return the fields of an experiment, and the times of its points."""
    columns, metadata = set(curve.columns), curve.metadata
    stiffness = metadata.get("spring constant", np.nan)
    if not 0 < stiffness < np.inf:
        raise FitError(
            f"{name}: the file does not tell the stiffness of the cantilever: give stiffness=, N/m",
            axis="stiffness",
        )
    if FORCE not in columns:
        raise FitError(f"{name}: it has no forces, but {', '.join(sorted(columns))}")
    force = np.asarray(curve[FORCE], dtype=np.float64)
    height_name = next((one for one in HEIGHTS if one in columns), None)
    if TIP in curve.columns_innate:
        # The instrument's own position of the tip; its "height" may be anything.
        height, height_name = np.asarray(curve[TIP], dtype=np.float64) - force / stiffness, TIP
    elif height_name is None:
        raise FitError(f"{name}: it has no heights, but {', '.join(sorted(columns))}")
    else:
        height = np.asarray(curve[height_name], dtype=np.float64)
    retract, kept = _segments(np.asarray(curve["segment"]), height, curve.modality)
    if relaxes and kept.any():
        # A hold is a part of the history of a film that relaxes.
        kept[np.argmax(kept) :] = True
    if only is not None:
        kept &= retract == (only == "retract")
    if not kept.any():
        raise FitError(f"{name}: it has no points on {only or 'approach or retract'}")
    time = np.asarray(curve["time"], dtype=np.float64)[kept] if "time" in columns else None
    fields = {
        "kind": "force-height",
        "abscissa": height[kept],
        "ordinate": force[kept],
        "retract": retract[kept],
        "stiffness": float(stiffness),
        # A force of an AFM is a deflection of its cantilever.
        "from_deflection": True,
        "reading": f"{metadata.get('format', 'afmformats')}: force, {height_name}; "
        f"{int(kept.sum())} of {len(kept)} points; stiffness {stiffness:.6g} N/m",
    }
    if relaxes:
        fields["time"] = time
    return fields, time


def _segments(
    segment: NDArray[Any], height: Array, modality: str
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Tell which points are of the retract, and which are of approach or retract."""
    if np.all(segment == segment[:1]):
        turn = int(np.argmin(height))
        return np.arange(len(height)) > turn, np.full(len(height), True)
    if modality == "force-distance":
        return segment == 1, (segment == 0) | (segment == 1)
    # Between and before the ways there are pauses, with a constant height or force.
    retract, kept = np.full((2, len(height)), False)
    least = PAUSE * np.ptp(height)
    for one in np.unique(segment):
        own = segment == one
        way = height[own][-1] - height[own][0]
        retract |= own & (way > least)
        kept |= own & (abs(way) > least)
    return retract, kept


class _Place:
    """Where a curve was measured: in the laboratory, and in the map."""

    def __init__(self, metadata: Any) -> None:
        def read(key: str, axis: str) -> float:
            return float(metadata[f"{key} {axis}"]) if f"{key} {axis}" in metadata else np.nan

        self.position = (read("position", "x"), read("position", "y"))
        row, column = read("grid index", "y"), read("grid index", "x")
        rows, columns = read("grid shape", "y"), read("grid shape", "x")
        self.pixel = (-1, -1)
        self.shape: tuple[int, int] | None = None
        self.pixel_size: tuple[float, float] | None = None
        if 0 <= row < rows and 0 <= column < columns:
            self.pixel = (int(row), int(column))
            self.shape = (int(rows), int(columns))
            self.pixel_size = (read("grid size", "y") / rows, read("grid size", "x") / columns)


class _Thickness:
    """The thickness of the film under each curve."""

    def __init__(
        self,
        system: System | HalfSpace | StackSystem,
        thickness: ArrayLike | None,
        height_image: ArrayLike | None,
        zero_level: float | None,
    ) -> None:
        self.system = system
        self.zero = None if zero_level is None else number("zero_level", zero_level)
        self.values, self.name = None, "film_thickness"
        if thickness is not None and (height_image is not None or self.zero is not None):
            raise FitError("film_thickness stands beside height_image or zero_level: give one")
        if height_image is not None and self.zero is None:
            raise FitError("height_image needs zero_level, the height of the substrate, m")
        if thickness is not None:
            self.values = real("film_thickness", thickness)
        elif height_image is not None:
            self.values, self.name = real("height_image", height_image), "height_image"
        if (self.values is not None or self.zero is not None) and not isinstance(system, System):
            raise FitError(
                f"a {type(system).__name__} has no film whose thickness changes: give a System"
            )

    def at(self, i: int, count: int, place: _Place, fields: dict[str, Any]) -> Any:
        """Return the bodies under a curve."""
        if not isinstance(self.system, System) or (self.values is None and self.zero is None):
            return self.system
        if self.values is None:
            value = _surface(fields)
        elif self.values.shape == (count,):
            value = float(self.values[i])
        elif self.values.shape == place.shape:
            value = float(self.values[place.pixel])
        else:
            shape = "" if place.shape is None else f" or {place.shape}, the pixels of the map"
            raise FitError(
                f"{self.name} has the shape {self.values.shape}: give ({count},), one for each "
                f"curve{shape}",
                axis=self.name,
            )
        thickness = value - (self.zero or 0.0)
        if not 0 < thickness < np.inf:
            raise FitError(
                f"curve {i}: the film is {thickness:.4g} m thick there: its surface is at "
                f"{value:.4g} m, zero_level at {self.zero or 0.0:.4g} m",
                axis="film_thickness",
                value=thickness,
            )
        with unchecked():
            return replace(self.system, film_thickness=thickness)


def _surface(fields: dict[str, Any]) -> float:
    """Return the height of the tip where the approach meets the surface."""
    approach = ~fields["retract"]
    height, force = fields["abscissa"][approach], fields["ordinate"][approach]
    order = np.argsort(-height, kind="stable")
    height, force = height[order], force[order]
    far = force[: int(FAR * len(force))]
    if len(far) < 5:
        raise FitError("zero_level: the approach has too few points to tell the surface")
    level = np.median(far)
    noise = 1.4826 * np.median(np.abs(far - level))
    outside = np.flatnonzero(np.abs(force - level) <= TOUCH * noise)
    last = int(outside[-1]) if outside.size else -1
    if not 0 <= last < len(force) - 1:
        raise FitError("zero_level: the approach shows no contact that tells the surface")
    return float(height[last] + (force[last] - level) / fields["stiffness"])
