"""A child of fork computes what its parent computes.

The limits of time end a child that hangs; nothing is asserted about time.
"""

import multiprocessing
import os
import pickle
import select
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from coated_contact import Cohesive, SolvedCurve, Table, fit_map, generate, solve
from conftest import RUBBER_ON_GLASS, make_system
from test_fit import WANTED, lens

pytestmark = [
    pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork"),
    # Python warns that a process with threads forks, which is what is tested.
    pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning"),
]

LIMIT = 120
X = [0.5, 1.0, 2.0]


def solved():
    return solve(X, 1.75, 0.3, 1e5).eeq.tolist()


def mapped():
    found = fit_map([lens(seed=seed) for seed in range(4)], WANTED)
    return found.params["sphere_modulus"].tolist()


def generated():
    return generate(RUBBER_ON_GLASS, progress=False).to_packed()


def looked_up():
    return Table.embedded().quantities(X, 1.75, 0.3, 1e5).eeq.tolist()


def of_a_curve():
    return SolvedCurve(a_over_t=(0.1, 20)).contact(make_system()).pull_off(0.04).load


def cohesive():
    made = Cohesive(system=make_system(), work_of_adhesion=0.04, interaction_range=1e-6)
    return made.state([3e-5, 4e-5]).load.tolist()


WORK = [solved, mapped, generated, looked_up, of_a_curve, cohesive]


def every():
    return [work() for work in WORK]


def in_child(work):
    """Return what a child of a fork returns; fail if it hangs."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            with os.fdopen(writer, "wb") as pipe:
                pickle.dump(work(), pipe)
        finally:
            os._exit(0)
    os.close(writer)
    try:
        with os.fdopen(reader, "rb") as pipe:
            ready, _, _ = select.select([pipe], [], [], LIMIT)
            assert ready, f"the child has not answered within {LIMIT} s"
            return pickle.load(pipe)
    finally:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)


@pytest.fixture(scope="module")
def expected():
    """What the parent computes, before any of the forks."""
    return every()


@pytest.mark.parametrize("number", range(len(WORK)), ids=lambda i: WORK[i].__name__)
def test_a_child_computes_what_its_parent_computes(expected, number):
    assert in_child(WORK[number]) == expected[number]


def test_a_child_of_a_child_computes_too_and_the_parent_goes_on(expected):
    assert in_child(lambda: every() == in_child(every) == expected)
    assert every() == expected


def test_processes_of_multiprocessing_compute(expected):
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for found in pool.map_async(_every, range(4), chunksize=1).get(timeout=LIMIT):
            assert found == expected


def _every(_):
    return every()


def test_many_threads_of_a_child_compute_at_once(expected):
    def child():
        with ThreadPoolExecutor(64) as pool:
            return all(found == expected[0] for found in pool.map(lambda _: solved(), range(256)))

    assert child()
    assert in_child(child)


def test_a_child_of_a_parent_whose_threads_compute(expected):
    """The other threads are at any place of their work when the process forks."""
    stop = threading.Event()

    def busy(work):
        while not stop.is_set():
            work()

    threads = [threading.Thread(target=busy, args=(work,)) for work in (solved, mapped, looked_up)]
    for thread in threads:
        thread.start()
    try:
        for _ in range(20):
            assert in_child(solved) == expected[0]
            assert in_child(mapped) == expected[1]
    finally:
        stop.set()
        for thread in threads:
            thread.join()


def test_a_solve_without_a_further_thread_is_an_error_of_the_system():
    """A stack that no machine has room for stands for a limit on the number of threads."""
    script = "from coated_contact import solve\nsolve([1.0], 1.75, 0.3, 1e5)"
    environment = {
        **os.environ,
        "RUST_MIN_STACK": str(10**18),
        "PYTHONPATH": os.pathsep.join(sys.path),
    }
    run = subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True
    )
    assert "BlockingIOError" in run.stderr, run.stderr
    assert "panic" not in run.stderr
