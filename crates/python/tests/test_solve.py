"""Direct solves: Rust bit for bit, arrays, and xarray."""

import signal

import numpy as np
import pytest

import coated_contact as cc
from conftest import make_system, refuses, rows

COHESIVE = cc.Cohesive(
    system=make_system(sphere_radius=1e-5), work_of_adhesion=0.05, interaction_range=1e-8
)

QUANTITIES = ("pi0", "eeq", "gamma", "delta0")
PARAMETERS = ("a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "nu0")


def columns(name, names):
    table = rows(name)
    return [np.array([float(row[name]) for row in table]) for name in names]


def test_numbers_are_those_of_rust_bit_for_bit(tabulate, tmp_path):
    parameters = columns("barthel_reference", PARAMETERS)
    points = tmp_path / "points.csv"
    lines = [",".join(PARAMETERS)]
    lines += [",".join(repr(float(number)) for number in row) for row in zip(*parameters)]  # noqa: B905
    points.write_text("\n".join(lines) + "\n")
    printed = tabulate("solve", "--points", points, "--tolerance", "1e-8")
    solution = cc.solve(*parameters, tolerance=1e-8)
    for name in (*QUANTITIES, "error"):
        expected = np.array([row[name] for row in printed])
        assert np.array_equal(getattr(solution, name), expected), name


def test_parameters_broadcast():
    x, nu1 = np.array([0.1, 1.0, 10.0])[:, None], np.array([0.3, 0.5])
    solution = cc.solve(x, 1.75, nu1, 1e5)
    for i in range(3):
        for j in range(2):
            one = cc.solve(x[i, 0], 1.75, nu1[j], 1e5)
            assert type(one.pi0) is float
            for name in (*QUANTITIES, "error"):
                assert getattr(solution, name)[i, j] == getattr(one, name)


def test_errors():
    error = refuses(cc.SolveError, "a_over_t", lambda: cc.solve([1.0, 1e7, 1e8], 1.75, 0.5, 1e5))
    assert (error.axis, error.value, error.range, error.index) == (
        "a_over_t",
        1e7,
        (1e-6, 1e6),
        (1,),
    )
    with pytest.raises(cc.SolveError) as caught:
        cc.solve(1e5, 1e20, 0.3, 1e-10, tolerance=1e-13)
    assert caught.value.range[0] > 1e-13
    refuses(TypeError, "nu1 must be real numbers", lambda: cc.solve(1.0, 1.75, "0.5", 1e5))
    refuses(TypeError, "stack must be a Stack, not int", lambda: cc.solve_stack(1.0, 3, 2e6))


@pytest.mark.parametrize(
    "solves",
    [
        lambda: cc.solve(np.geomspace(1.0, 100.0, 1_000_000), 1.75, 0.5, 1e5, tolerance=1e-12),
        lambda: COHESIVE.branch((1e-6, 4e-6), count=1_000_000),
    ],
    ids=["solve", "branch"],
)
def test_a_signal_ends_a_long_solve(solves):
    """A million solves take a minute; the signal comes after 50 ms of it."""

    class InterruptedHereError(Exception):
        pass

    def interrupt(*_):
        raise InterruptedHereError

    before = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(InterruptedHereError):
            solves()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_xarray_names_its_dimensions():
    pytest.importorskip("xarray")
    x, nu1 = np.array([0.1, 1.0, 10.0]), np.array([0.3, 0.5])
    data = cc.solve(x[:, None], 1.75, nu1, 1e5).to_xarray()
    assert dict(data.sizes) == {"a_over_t": 3, "nu1": 2}
    assert np.array_equal(data["a_over_t"], x)
    assert data["e0_over_e2"].item() == 1e5
    assert data.sel(a_over_t=1.0, nu1=0.5)["eeq"].item() == cc.solve(1.0, 1.75, 0.5, 1e5).eeq
    assert data["eeq"].attrs["units"] == "1"
    # Two parameters along one dimension give it no name, and are both coordinates of it.
    data = cc.solve(x, [1.0, 2.0, 3.0], 0.5, 1e5).to_xarray()
    assert dict(data.sizes) == {"dim_0": 3}
    assert data["e1_over_e2"].dims == data["a_over_t"].dims == ("dim_0",)
    # A parameter along two dimensions is a coordinate of both.
    data = cc.solve(np.outer(x, [1.0, 2.0]), 1.75, nu1, 1e5).to_xarray()
    assert data["a_over_t"].dims == ("dim_0", "nu1")
    assert cc.solve(1.0, 1.75, 0.5, 1e5).to_xarray()["eeq"].shape == ()
    assert cc.solve([[1.0]], 1.75, 0.5, 1e5).to_xarray()["eeq"].dims == ("dim_0", "dim_1")
    assert dict(cc.solve([], 1.75, 0.5, 1e5).to_xarray().sizes) == {"a_over_t": 0}
    data = cc.solve(np.empty((0, 1)), 1.75, nu1, 1e5).to_xarray()
    assert dict(data.sizes) == {"a_over_t": 0, "nu1": 2}
