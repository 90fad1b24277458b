"""Work on the workers of dask: pieces of a sweep, and blocks of curves.

dask sends tasks to workers, and sends those of a lost worker to another one. The tasks here are
pure functions of what they are sent, so that their results do not depend on the workers.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._errors import TableError

if TYPE_CHECKING:
    from distributed import Client

Axes = list[tuple[str, list[float]]]


def solved_pieces(
    client: Client, scene: Any
) -> Callable[[Axes, list[int]], Iterator[tuple[int, NDArray[np.float64]]]]:
    """Return a function that solves pieces of the sweep of a scene on the workers."""

    def pieces(axes: Axes, missing: list[int]) -> Iterator[tuple[int, NDArray[np.float64]]]:
        nodes = [values for _, values in axes]
        own = _core.build()
        tasks = ((solve_piece, (scene, nodes, piece)) for piece in missing)
        for index, (build, values) in unordered(client, tasks):
            if build != own:
                raise TableError(
                    f"a worker runs another build of the package or another processor, {build}, "
                    f"and this is {own}: the last digits may differ; install one wheel everywhere"
                )
            # A copy: what dask has received may not be aligned.
            yield missing[index], np.array(values)

    return pieces


def solve_piece(
    scene: Any, nodes: list[list[float]], piece: int
) -> tuple[str, NDArray[np.float64]]:
    """Solve a piece on a worker; return the name of its build and the values."""
    return _core.solve_piece(scene, nodes, piece)


def unordered(
    client: Client, tasks: Iterable[tuple[Callable[..., Any], tuple[Any, ...]]]
) -> Iterator[tuple[int, Any]]:
    """Return number and result of each task, as they come.

    At most four tasks for each thread of the workers are under way, so that tasks may be many and
    large. Tasks that are under way when the caller stops are cancelled.
    """
    from distributed import as_completed

    numbered = enumerate(tasks)
    numbers: dict[Any, int] = {}
    completed = as_completed(with_results=True)

    def submit() -> None:
        for number, (function, arguments) in itertools.islice(numbered, 1):
            # Not pure: no hash over large arguments.
            future = client.submit(function, *arguments, pure=False)
            numbers[future] = number
            completed.add(future)

    try:
        for _ in range(4 * max(1, sum(client.nthreads().values()))):
            submit()
        for future, result in completed:
            number = numbers.pop(future)
            submit()
            yield number, result
    finally:
        client.cancel(list(numbers))
