"""Tables of one's own, made from a scene."""

from __future__ import annotations

import json
import logging
import os
import tempfile
import warnings
from collections.abc import Callable, Mapping
from contextlib import closing, nullcontext
from math import isinf, isnan
from numbers import Integral
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._arrays import integer, number
from ._distributed import solved_pieces
from ._stack import Stack
from ._table import Table

if TYPE_CHECKING:
    from distributed import Client

Progress = Callable[[str, int, int], object]
Scene = str | os.PathLike[str] | Mapping[str, Any]

LOGGER = logging.getLogger("coated_contact")


def generate(
    scene: Scene,
    path: str | os.PathLike[str] | None = None,
    *,
    tolerance: float | None = None,
    progress: bool | Progress = True,
    resume: bool = False,
    certificate_points: int | None = None,
    seed: int = 1,
    client: Client | None = None,
) -> Table:
    """Make the table of a scene: choose the nodes, solve them, and measure the accuracy.

    An axis that leaves too large an error gets more nodes, and the table is made again. Finished
    pieces are kept in the file ``<path>.unfinished`` until the table is complete: after Ctrl-C, or
    after any other end of the program, ``resume=True`` goes on from them. An existing file at
    ``path`` is not touched until then.

    The file depends on the scene, the certificate's points and seed, and this build of the package
    on this kind of processor alone. It does not depend on the number of cores, on interruptions, or
    on a ``client``.

    Parameters
    ----------
    scene : mapping, path or str
        The scene: a mapping of its keys, the path of a TOML file (a ``pathlib.Path``), or TOML text
        (a ``str``). The keys are ``title``, ``a_over_t``, ``e1_over_e2``, ``nu1``, ``e0_over_e2``
        (each a number, or a mapping with ``from``, ``to`` and, if wanted, ``nodes``), and
        optionally ``nu0``, ``quantities`` and ``tolerance``. With ``stack``, a :class:`Stack` or
        the mapping of its file, the table is of these layers under spheres of any modulus:
        ``a_over_t`` is over the thickness of all layers, ``e1_over_e2`` of the top layer, and
        ``nu1``, ``e0_over_e2`` and ``nu0`` are left out.
    path : path, optional
        The file to write: packed to a name that ends in ``.bin``, which :meth:`Table.read` reads;
        to other names HDF5, which needs a package that was built with the feature ``hdf5``. By
        default no file is written, and nothing is left after an interruption.
    tolerance : float, optional
        The largest relative error between the nodes, instead of the scene's.
    progress : bool or callable
        Whether to show a bar: on a terminal, after two seconds, and where tqdm is installed. A
        function is called with the stage (``"solving"`` or ``"checking"``), the number of its
        points, and that of the finished ones; if it raises, the generation ends like by Ctrl-C.
    resume : bool
        Whether to go on from the finished pieces of an interrupted generation of the same scene.
        Without it, pieces that are kept are a :class:`TableError` that names their file.
    certificate_points : int, optional
        The number of points at which the accuracy is measured; by default 2500 for each axis.
    seed : int
        The seed of these points.
    client : distributed.Client, optional
        A client of dask: its workers solve the pieces of the sweep. They need this build of the
        package and the same kind of processor. The certificate is measured here.

    Returns
    -------
    Table
        The table with its certificate. If its error exceeds the tolerance, because the scene states
        its nodes, there is a ``UserWarning``.

    Raises
    ------
    TableError
        For a scene that cannot be used, a table that would be too large, pieces of another
        generation, or workers of another build.

    Examples
    --------
    >>> table = generate({
    ...     "title": "Rubber on glass",
    ...     "tolerance": 1e-3,
    ...     "a_over_t": {"from": 0.1, "to": 10.0},
    ...     "e1_over_e2": 1.75, "nu1": 0.5, "e0_over_e2": 1e5,
    ... }, progress=False)
    >>> table.max_error < 1e-3
    True
    """
    given_scene = scene_of(scene, tolerance)
    if certificate_points is not None:
        integer("certificate_points", certificate_points, 1, 2**31)
    integer("seed", seed, 0, 2**63)
    with tempfile.TemporaryDirectory() if path is None else nullcontext() as folder:
        file = path if folder is None else Path(folder) / "table.bin"
        given = {
            "scene": given_scene,
            "path": file,
            "certificate_points": certificate_points,
            "seed": seed,
            "resume": resume,
        }
        pieces = None if client is None else solved_pieces(client, given_scene)
        with closing(Bar(progress)) as bar:
            table = Table(_core.generate(given, bar.told, LOGGER.warning, pieces))
    if not table.max_error <= table.tolerance:
        name = "the table" if path is None else os.fsdecode(path)
        warnings.warn(
            f"{name}: the measured error {table.max_error:.1e} exceeds the tolerance "
            f"{table.tolerance:g}: give the axes more nodes",
            stacklevel=2,
        )
    return table


def scene_of(scene: Scene, tolerance: float | None) -> dict[str, Any]:
    """Return a scene as the native part takes it."""
    wanted = None if tolerance is None else number("tolerance", tolerance)
    if isinstance(scene, Mapping):
        return {"file": None, "text": toml(scene), "tolerance": wanted}
    if isinstance(scene, os.PathLike):
        return {"file": os.fsdecode(scene), "text": "", "tolerance": wanted}
    if not isinstance(scene, str):
        raise TypeError(f"a scene is a mapping, a path or text, not {type(scene).__name__}")
    if "=" not in scene:
        raise ValueError(
            f"{scene!r} is no text of a scene: give the path of a file as pathlib.Path"
        )
    return {"file": None, "text": scene, "tolerance": wanted}


def toml(scene: Mapping[str, Any]) -> str:
    """Return the text of a scene."""
    return "".join(f"{json.dumps(str(key))} = {_value(value)}\n" for key, value in scene.items())


def _value(value: Any) -> str:
    """Return a value as TOML."""
    if isinstance(value, Stack):
        return _value(value._scene())
    if isinstance(value, Mapping):
        pairs = (f"{json.dumps(str(key))} = {_value(one)}" for key, one in value.items())
        return "{ " + ", ".join(pairs) + " }"
    if isinstance(value, str):
        # The escapes of JSON are those of TOML.
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, Integral) and not isinstance(value, bool):
        return str(int(value))
    plain = number("a value of the scene", value)
    if isinf(plain) or isnan(plain):
        return str(plain)
    return repr(plain)


class Bar:
    """The progress that a user sees: a function of theirs, a bar of tqdm, or nothing."""

    def __init__(self, progress: bool | Progress) -> None:
        self._bar: Any = None
        self._stage = ""
        self.told: Progress | None = None
        if callable(progress):
            self.told = progress
        elif progress:
            try:
                from tqdm import tqdm
            except ImportError:
                return
            self._tqdm, self.told = tqdm, self._show

    def _show(self, stage: str, points: int, finished: int) -> None:
        """Show the progress of a stage; each stage has a bar of its own."""
        if self._bar is None or stage != self._stage or points != self._bar.total:
            self.close()
            # None: on a terminal only.
            self._bar = self._tqdm(
                total=points, desc=stage, unit=" contacts", delay=2, leave=False, disable=None
            )
            self._stage = stage
        self._bar.update(finished - self._bar.n)

    def close(self) -> None:
        """Remove the bar."""
        if self._bar is not None:
            self._bar.close()
