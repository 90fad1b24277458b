"""Maps of fits and tables on the workers of dask: the numbers of one process."""

import os
import signal
from dataclasses import replace

import numpy as np
import pytest

from coated_contact import ContactError, Table, fit_map, generate, simulate
from coated_contact import _fit as fitting
from conftest import ROOT, refuses, without_result
from test_fit import WANTED, lens
from test_generate import SCENE, StoppedHereError
from test_relaxing import FREE, plan
from test_stack_fit import lens as lens_on
from test_stack_table import scene as stack_scene

distributed = pytest.importorskip("distributed")

# What dask itself does when workers start, are lost, and stop.
pytestmark = [
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]


@pytest.fixture(scope="module")
def client():
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as connected,
    ):
        yield connected


@pytest.fixture
def small_blocks(monkeypatch):
    """Blocks of a few curves, so that a small map has many."""
    monkeypatch.setattr(fitting, "BLOCK", 10)


def assert_equal(found, expected):
    assert list(found.params) == list(expected.params)
    for name in found.params:
        assert np.array_equal(found.params[name], expected.params[name], equal_nan=True)
        assert np.array_equal(found.stderr[name], expected.stderr[name], equal_nan=True)
    assert np.array_equal(found.covariance, expected.covariance, equal_nan=True)
    assert np.array_equal(found.chi_squared, expected.chi_squared, equal_nan=True)
    assert np.array_equal(found.converged, expected.converged)
    assert found.warnings == expected.warnings
    assert list(found.failures) == list(expected.failures)


def test_a_map_survives_the_loss_of_a_worker(client, small_blocks):
    curves = [lens(seed=seed) for seed in range(300)]
    expected = fit_map(curves, WANTED)
    workers = client.run(os.getpid)
    killed = []

    def given():
        """The curves; when half of them are on their way, a worker is killed."""
        for i, curve in enumerate(curves):
            if i == 150:
                killed.append(next(iter(workers.values())))
                os.kill(killed[0], signal.SIGKILL)
            yield curve

    assert_equal(fit_map(given(), WANTED, client=client), expected)
    client.wait_for_workers(2, timeout=60)
    assert killed[0] not in client.run(os.getpid).values()


def test_curves_without_a_result_keep_their_numbers(client, small_blocks):
    curves = [lens(seed=seed) for seed in range(35)]
    for i in (12, 27):
        curves[i] = without_result(curves[i])
    found = fit_map(curves, WANTED, errors="nan", client=client)
    assert list(found.failures) == [12, 27]
    assert found.failures[27].index == (27,)
    assert_equal(found, fit_map(curves, WANTED, errors="nan"))
    for where in (None, client):
        with pytest.raises(ContactError) as caught:
            fit_map(curves, WANTED, client=where)
        assert caught.value.index == (12,)


def test_curves_on_a_stack(client, stack):
    curves = [simulate(lens_on(stack), noise=2e-6, seed=seed) for seed in range(3)]
    found = fit_map(curves, WANTED, client=client)
    assert_equal(found, fit_map(curves, WANTED))


def test_curves_that_relax(client):
    curves = [simulate(plan(), noise=1e-10, seed=seed) for seed in range(3)]
    found = fit_map(curves, FREE, client=client)
    assert "relaxation_exponent" in found.params
    assert_equal(found, fit_map(curves, FREE))


def test_a_table_of_ones_own_goes_to_the_workers(client, small_blocks):
    table = Table.read(ROOT / "tables" / "paper.bin")
    curves = [lens(seed=seed) for seed in range(25)]
    found = fit_map(curves, WANTED, table=table, client=client)
    assert_equal(found, fit_map(curves, WANTED, table=table))


@pytest.mark.parametrize("of_stack", [False, True])
def test_a_table_is_the_same_to_the_byte(client, tmp_path, stack, of_stack):
    paths = [tmp_path / "here.bin", tmp_path / "there.bin"]
    scene = stack_scene(stack, 1e-3) if of_stack else SCENE
    generate(scene, paths[0], progress=False)
    told = []
    generate(scene, paths[1], progress=lambda *event: told.append(event), client=client)
    assert paths[0].read_bytes() == paths[1].read_bytes()
    assert told[0][0] == "solving"
    assert [event for event in told if event[0] == "solving"][-1][2] == told[0][1]


def test_an_interruption_keeps_what_the_workers_have_solved(client, tmp_path):
    path, whole = tmp_path / "table.bin", tmp_path / "whole.bin"

    def stop(stage, points, finished):
        if finished > points / 2:
            raise StoppedHereError

    with pytest.raises(StoppedHereError):
        generate(SCENE, path, progress=stop, client=client)
    assert os.listdir(tmp_path) == ["table.bin.unfinished"]
    told = []
    generate(SCENE, path, resume=True, progress=lambda *event: told.append(event), client=client)
    assert told[0][2] > told[0][1] / 2 - 1
    generate(SCENE, whole, progress=False)
    assert path.read_bytes() == whole.read_bytes()


def test_an_error_of_a_worker_is_raised_here(client):
    with pytest.raises(ContactError, match="nu1"):
        generate({**SCENE, "nu1": 0.6}, progress=False, client=client)
    bad = lens(seed=1)
    refuses(TypeError, "must be an Experiment", lambda: fit_map([bad, 3], WANTED, client=client))


@pytest.mark.large
def test_a_map_of_100_000_curves(client):
    """Two minutes on two cores: `pytest -m large`."""
    plan = lens(seed=1)
    curves = (replace(plan, ordinate=plan.ordinate * (1 + 1e-3 * (i % 7))) for i in range(100_000))
    found = fit_map(curves, WANTED, client=client)
    assert len(found) == 100_000
    for i in range(7):
        assert len(set(found.params["sphere_modulus"][i::7])) == 1
