"""Measures the times that the README states, and compares fits with those of scipy.

Run it on a quiet machine: ``python benches/measure.py`` (needs scipy). CPU times count all threads.
"""

import os
import threading
from dataclasses import replace
from time import perf_counter, process_time

import numpy as np
from scipy.optimize import least_squares

from coated_contact import (
    Elastic,
    Experiment,
    Spring,
    System,
    Table,
    fit,
    fit_map,
    log_likelihood,
    predict,
    simulate,
)


def best(work, repeats=7, clock=perf_counter):
    """Return the least time of one call."""
    times = []
    for _ in range(repeats):
        start = clock()
        work()
        times.append(clock() - start)
    return min(times)


def made(film_modulus=3.5e6, **changes):
    """Barthel's elastomer sphere on a film on silicon."""
    known = {"sphere_radius": 1e-3, "sphere_modulus": 2e6, "film_thickness": 1e-5} | changes
    film = Elastic(young_modulus=film_modulus, poisson_ratio=0.45)
    silicon = Elastic(young_modulus=2e11, poisson_ratio=0.25)
    return System(film=film, substrate=silicon, **known)


def lookups():
    """Measure loads, threads and contacts."""
    contact = Table.embedded().contact(made())
    a = np.linspace(40e-6, 100e-6, 1_000_000)
    alone = best(lambda: contact.load(a, 0.04))
    print(f"load of 1e6 points      {1e9 * alone / len(a):8.1f} ns a point")

    def both():
        threads = [threading.Thread(target=contact.load, args=(a, 0.04)) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    print(f"two threads             {2 * alone / best(both):8.2f} times the points in a time")
    systems = [made(film_modulus=1e6 + i) for i in range(300)]
    table = Table.embedded()
    each = best(lambda: [table.contact(one) for one in systems]) / len(systems)
    print(f"contact of a System     {1e6 * each:8.1f} us")


TRUTH = {"film_modulus": 5e5, "work_of_adhesion": 0.04, "contact_point": 4e-6}


def retract(seed, points=300):
    """Return a curve of a cantilever with three unknowns."""
    system = made(film_modulus=TRUTH["film_modulus"])
    plan = Experiment(
        kind="force-height",
        abscissa=np.linspace(-0.5e-6, 5.5e-6, points),
        retract=np.full(points, True),
        system=system,
        work_of_adhesion=TRUTH["work_of_adhesion"],
        contact_point=TRUTH["contact_point"],
        stiffness=200.0,
        noise=1e-6,
    )
    return simulate(plan, noise=1e-6, seed=seed)


def with_values(curve, modulus, w, contact_point):
    """Return the curve with other values of the unknowns."""
    film = replace(curve.system.film, young_modulus=modulus)
    return replace(
        curve,
        system=replace(curve.system, film=film),
        work_of_adhesion=w,
        contact_point=contact_point,
    )


def fits():
    """Measure fits beside scipy's least squares, from one start, in CPU time."""
    free = list(TRUTH)
    curves = [retract(seed) for seed in range(500)]
    fit_map(curves[:20], free)
    start, wall = process_time(), perf_counter()
    found = fit_map(curves, free, errors="nan")
    cpu, wall = process_time() - start, perf_counter() - wall
    print(
        f"map of 500 curves       {1e3 * cpu / 500:8.2f} ms of CPU a fit, "
        f"{1e3 * wall / 500:.2f} ms on {os.cpu_count()} cores"
    )
    off = (found.params["film_modulus"] - 5e5) / found.stderr["film_modulus"]
    print(f"                        errors in their units: {np.nanstd(off):.2f}")
    one = curves[0]
    ours = best(lambda: fit(one, free), clock=process_time)
    scale = np.array([5e5, 0.04, 1e-6])
    x0 = np.array([1.6, 1.6, 4.3])
    branch = ["receding"] * len(one.abscissa)

    def residual(x):
        values = predict(with_values(one, *(x * scale)), branches=branch)
        return (values.ordinate - one.ordinate) / 1e-6

    def jacobian(x):
        values = predict(with_values(one, *(x * scale)), free, branches=branch)
        return np.stack([values.derivatives[name] for name in free], axis=1) * scale / 1e-6

    def by_states(x):
        modulus, w, contact_point = x * scale
        system = with_values(one, modulus, w, contact_point).system
        contact = Table.embedded().contact(system)
        equilibria = contact.equilibria(w, control=Spring(stiffness=200.0))
        force = np.array([point(equilibria, contact_point - height) for height in one.abscissa])
        return (force - one.ordinate) / 1e-6

    def point(equilibria, position):
        try:
            return equilibria.unloading(position).load
        except ValueError:
            return 0.0

    rivals = {
        "exact derivatives of predict": lambda: least_squares(residual, x0, jacobian),
        "differences of predict": lambda: least_squares(residual, x0),
        "differences of single states": lambda: least_squares(by_states, x0),
    }
    print(f"one fit                 {1e3 * ours:8.2f} ms of CPU")
    for name, work in rivals.items():
        repeats = 1 if "single" in name else 5
        time, result = best(work, repeats, process_time), work()
        print(
            f"scipy, {name:30} {1e3 * time:8.2f} ms, {time / ours:6.1f} times ours, "
            f"{result.nfev} evaluations, modulus {result.x[0] * scale[0]:.4g}"
        )
    print(f"ours {fit(one, free).params['film_modulus']:.4g} Pa")


def likelihoods():
    """Measure likelihoods of 300 points, one vector of parameters a call, in CPU time."""
    lens = Experiment(
        kind="load-radius",
        abscissa=np.linspace(3e-5, 1.2e-4, 300),
        system=made(),
        work_of_adhesion=0.04,
        noise=2e-6,
    )
    curve = replace(retract(0), noise=1e-9)
    film = ["film_modulus", "work_of_adhesion"]
    cases = {
        "at contact radii": (simulate(lens, noise=2e-6, seed=0), film, [3.5e6, 0.04]),
        "against heights": (curve, list(TRUTH), list(TRUTH.values())),
    }
    for name, (given, free, values) in cases.items():
        likelihood = log_likelihood(given, free)
        rows = np.array(values) * (1 + 1e-6 * np.arange(1000)[:, np.newaxis])

        def alone(likelihood=likelihood, rows=rows):
            for row in rows:
                likelihood(row)

        def gradients(likelihood=likelihood, rows=rows):
            for row in rows:
                likelihood.gradient(row)

        times = [1e6 * best(work, 5, process_time) / len(rows) for work in (alone, gradients)]
        print(f"likelihood {name:16} {times[0]:5.1f} us, with its gradient {times[1]:5.1f} us")


if __name__ == "__main__":
    lookups()
    fits()
    likelihoods()
