"""Fits of measured contacts: JKR tests and force curves."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from . import _core
from ._arrays import Errors, number
from ._distributed import unordered
from ._errors import ContactError
from ._experiment import Experiment, Free, ParameterName, listed, one_of
from ._fit_map import FitMap
from ._fit_results import (
    Fit,
    FittedExperiment,
    correlation_of,
    estimates_of,
    fixed_values_of,
    warnings_of,
    without_film_of,
)
from ._table import Table, native_table

if TYPE_CHECKING:
    from distributed import Client

Loss = Literal["squares", "huber", "soft-l1"]
Allowed = Literal["magnitudes", "left-out"]


def fit(
    experiments: Experiment | Iterable[Experiment],
    free: Iterable[ParameterName | Free],
    *,
    table: Table | None = None,
    loss: Loss = "squares",
    profile_level: float | None = None,
    interaction_range: float = 3e-10,
    known: Mapping[str, float] | None = None,
    fixed_values: bool = True,
    allow: Iterable[Allowed] = (),
) -> Fit:
    """Find the free parameters of one or several experiments together.

    Levenberg and Marquardt's method with exact derivatives (on a stack and of contact stiffnesses
    with central differences) minimises the loss. The start comes from the data. The fit is
    deterministic.

    Parameters
    ----------
    experiments : Experiment or iterable of Experiment
        The measurements with what is known about them.
    free : iterable of str or Free
        The parameters to be found.
    table : Table, optional
        The table; by default the embedded one, of films. Contacts on a stack are looked up in the
        table of this stack, and solved beside a table of films.
    loss : {"squares", "huber", "soft-l1"}
        What a residual adds to the sum. The last two forgive outliers.
    profile_level : float, optional
        The level, such as 0.95, of profile-likelihood intervals. An interval takes some twenty
        further fits for each parameter.
    interaction_range : float
        The range of the attraction, m, for the warning about Tabor's parameter.
    known : mapping of str to float, optional
        Standard errors of values that are not free, in SI units, such as
        ``{"film_thickness": 1e-7}``; also ``sphere_radius``, ``half_angle``,
        ``substrate_modulus`` and ``substrate_poisson_ratio``, and ``beta`` of a contact
        stiffness. ``{"load": 0.02}`` is a calibration by which all loads err together, by 2 %;
        ``contact_radius``, ``penetration``, ``height`` and ``contact_stiffness`` have one, too, and
        ``contact_radius_zero`` is the length (m) by which a threshold reads all radii too large,
        ``position_drift`` the speed (m/s) with which penetrations or heights that have times drift.
        The fit keeps the values, and their errors add to the standard errors and the
        correlation: to the first order, independent of one another. Where experiments have
        different values, the error is that of the first, and the others err in proportion;
        Poisson ratios and zeros are off by the same number. ``reference_modulus`` and
        ``reference_poisson_ratio`` are those of a sample without layers. A prior of a
        :class:`Free` instead lets the data move a free value.
    fixed_values : bool
        Whether ``Fit.fixed_values`` tells what the values that are not free do to the result.
    allow : iterable of {"magnitudes", "left-out"}
        Doubts with which the fit goes on. ``"magnitudes"``: numbers, given or found, that no
        experiment has, such as a sphere of 2 m or a film of 3000 GPa. ``"left-out"``: more than a
        third of the points in contact does not count.

    Returns
    -------
    Fit
        Values, standard errors, covariance, warnings. A fit that does not converge is no error:
        see ``Fit.converged``.

    Raises
    ------
    FitError
        For points, parameters or options that cannot be used, and for numbers that no experiment
        has. Points are counted from 0. For parameters that the data do not determine, so that no
        standard error is finite, and for more than a third of the points in contact left out.

    Examples
    --------
    >>> from coated_contact import Elastic, System
    >>> system = System(sphere_radius=1e-3, sphere_modulus=2e6,
    ...                 film=Elastic(young_modulus=3.5e6, poisson_ratio=0.5), film_thickness=1e-5,
    ...                 substrate=Elastic(young_modulus=2e11, poisson_ratio=0.25))
    >>> lens = Experiment(kind="load-radius", system=system,
    ...                   abscissa=[40e-6, 60e-6, 80e-6, 100e-6],
    ...                   ordinate=[-1.909e-4, -1.016e-4, 3.12e-4, 1.179e-3])
    >>> found = fit(lens, ["sphere_modulus", "work_of_adhesion"])
    >>> print(f"{found.params['sphere_modulus']:.2e} Pa")
    2.00e+06 Pa

    ``print(found)`` prints the report of the program ``tabulate fit``, and ``found.plot()`` draws
    the data and the fit.
    """
    errors = [(name, number(f"known[{name!r}]", error)) for name, error in (known or {}).items()]
    options = (loss, profile_level, interaction_range, allowed_of(allow))
    given = told_apart(experiments)
    found = _native(_core.fit, given, free, table, *options, errors, fixed_values)
    film = found["without_film"]
    return Fit(
        estimates=estimates_of(found),
        correlation=correlation_of(found),
        converged=found["converged"],
        evaluations=found["evaluations"],
        chi_squared=found["chi_squared"],
        degrees_of_freedom=found["degrees_of_freedom"],
        reduced_chi_squared=found["reduced_chi_squared"],
        warnings=warnings_of(found),
        experiments=tuple(FittedExperiment(**points) for points in found["experiments"]),
        report=found["report"],
        without_film=film and without_film_of(film, len(found["experiments"])),
        undetermined=tuple(found["undetermined"]),
        fixed_values=fixed_values_of(found, len(found["experiments"])),
    )


def fit_map(
    curves: Iterable[Experiment],
    free: Iterable[ParameterName | Free],
    *,
    table: Table | None = None,
    loss: Loss = "squares",
    interaction_range: float = 3e-10,
    allow: Iterable[Allowed] = (),
    errors: Errors = "raise",
    client: Client | None = None,
) -> FitMap:
    """Fit each of many curves by itself, on all cores.

    The numbers are those of :func:`fit` for each curve, and do not depend on the number of cores.
    ``curves`` may be a generator: only some blocks of curves are held at a time.

    Parameters
    ----------
    curves : iterable of Experiment
        The measurements, such as those of a force map.
    free, table, loss, interaction_range, allow
        As :func:`fit`. Intervals by profiles are those of ``fit`` alone.
    errors : {"raise", "nan"}
        What a curve without a result gives: the exception of the first one, or NaN and an entry in
        ``FitMap.failures``.
    client : distributed.Client, optional
        A client of dask: its workers fit the curves, block by block. The blocks of a worker that is
        lost are fitted by another one. Workers on another kind of processor may differ in the last
        digits.

    Returns
    -------
    FitMap
        Arrays over the curves.
    """
    if errors not in ("raise", "nan"):
        raise ValueError(f'errors = {errors!r} cannot be used: give "raise" or "nan"')
    free = free_of(free)
    options = (loss, None, interaction_range, allowed_of(allow))
    given = _batched(curves)
    done: dict[int, FitMap] = {}
    blocks: Iterator[tuple[int, FitMap]]
    if client is None:
        blocks = ((i, fit_block(block, free, table, options)) for i, block in enumerate(given))
    else:
        # A task of its own, so that a large table is not sent with every block.
        shared = None if table is None else client.submit(_itself, table, pure=False)
        tasks = ((fit_block, (block, free, shared, options)) for block in given)
        blocks = unordered(client, tasks)
    for i, block in blocks:
        done[i] = block
        if errors == "raise" and client is None and block.failures:
            break
    found = joined([done[i] for i in sorted(done)], [one.parameter for one in free])
    if errors == "raise" and found.failures:
        raise found.failures[min(found.failures)]
    return found


# The number of curves in a block: half a second of fits, and a megabyte of points.
BLOCK = 256


def fit_block(
    curves: Iterable[Experiment],
    free: list[Free],
    table: Table | None,
    options: tuple[Loss, None, float, set[Allowed]],
) -> FitMap:
    """Fit some of the curves of a map."""
    results = _native(_core.fit_map, curves, free, table, *options)
    names, count = [one.parameter for one in free], len(results)
    failures = {i: found for i, found in enumerate(results) if isinstance(found, ContactError)}
    values, deviations = np.full((2, len(names), count), np.nan)
    covariance = np.full((count, len(names), len(names)), np.nan)
    converged, chi_squared = np.zeros(count, dtype=np.bool_), np.full(count, np.nan)
    for i, found in enumerate(results):
        if i in failures:
            continue
        estimates = estimates_of(found)
        values[:, i] = [estimate.value for estimate in estimates]
        deviations[:, i] = [estimate.standard_error for estimate in estimates]
        covariance[i] = correlation_of(found) * np.outer(deviations[:, i], deviations[:, i])
        converged[i], chi_squared[i] = found["converged"], found["chi_squared"]
    return FitMap(
        params=dict(zip(names, values, strict=True)),
        stderr=dict(zip(names, deviations, strict=True)),
        covariance=covariance,
        converged=converged,
        chi_squared=chi_squared,
        warnings=tuple(() if i in failures else warnings_of(r) for i, r in enumerate(results)),
        failures=failures,
    )


def joined(blocks: list[FitMap], names: list[ParameterName]) -> FitMap:
    """Join the results of blocks of curves, whose failures get the numbers of their curves."""
    failures: dict[int, ContactError] = {}
    start = 0
    for block in blocks:
        for i, error in block.failures.items():
            error.index = (start + i,)
            error.add_note(f"curve {start + i}")
            failures[start + i] = error
        start += len(block)
    none, square = np.empty(0), np.empty((0, len(names), len(names)))
    return FitMap(
        params={n: np.concatenate([none, *(block.params[n] for block in blocks)]) for n in names},
        stderr={n: np.concatenate([none, *(block.stderr[n] for block in blocks)]) for n in names},
        covariance=np.concatenate([square, *(block.covariance for block in blocks)]),
        converged=np.concatenate([none.astype(np.bool_), *(block.converged for block in blocks)]),
        chi_squared=np.concatenate([none, *(block.chi_squared for block in blocks)]),
        warnings=tuple(one for block in blocks for one in block.warnings),
        failures=failures,
    )


def _batched(curves: Iterable[Experiment]) -> Iterator[tuple[Experiment, ...]]:
    """Return blocks of curves."""
    rest = iter(curves)
    while block := tuple(itertools.islice(rest, BLOCK)):
        yield block


def _itself(table: Table) -> Table:
    return table


def _native(
    function: Callable[..., Any],
    experiments: Experiment | Iterable[Experiment],
    free: Iterable[ParameterName | Free],
    table: Table | None,
    loss: Loss,
    profile_level: float | None,
    interaction_range: float,
    allowed: set[Allowed],
    *further: Any,
) -> Any:
    """Check the arguments and call the native part."""
    one_of("loss", loss, get_args(Loss))
    given = experiments_of(experiments)
    level = None if profile_level is None else number("profile_level", profile_level)
    attraction = number("interaction_range", interaction_range)
    options = (loss, level, attraction, "magnitudes" in allowed, "left-out" in allowed)
    return function(native_table(table), given, free_of(free), options, *further)


def allowed_of(allow: Iterable[Allowed]) -> set[Allowed]:
    """Return the doubts that are allowed; refuse other words."""
    if isinstance(allow, str):
        raise TypeError(f"allow must be a list of words: [{allow!r}]")
    for one in (words := list(allow)):
        one_of("allow", one, get_args(Allowed))
    return set(words)


def experiments_of(given: Experiment | Iterable[Experiment]) -> list[Experiment]:
    """Return experiments as a list; refuse other objects."""
    experiments = [given] if isinstance(given, Experiment) else list(given)
    for one in experiments:
        if not isinstance(one, Experiment):
            raise TypeError(f"an experiment must be an Experiment, not {type(one).__name__}")
    return experiments


def told_apart(given: Experiment | Iterable[Experiment]) -> list[Experiment]:
    """Return experiments that messages tell apart: those of one name with their numbers."""
    experiments = experiments_of(given)
    counts = Counter(one.name for one in experiments)
    return [
        one if counts[one.name] == 1 else replace(one, name=f"{one.name} {i}")
        for i, one in enumerate(experiments)
    ]


def free_of(free: Iterable[ParameterName | Free]) -> list[Free]:
    """Return the free parameters, those without further wishes too."""
    return [one if isinstance(one, Free) else Free(parameter=one) for one in listed("free", free)]
