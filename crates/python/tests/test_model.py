"""Predictions, synthetic data, forecasts: JKR, linear least squares, Rust bit for bit."""

import csv
import json
import os
import subprocess
from dataclasses import replace
from math import pi

import numpy as np
import pytest

import coated_contact as cc
from conftest import loads_at, make_system, refuses
from test_fit import MODULUS, WANTED, W, jkr_load

RIGID = cc.HalfSpace(
    sphere_radius=1e-3,
    sphere_modulus=MODULUS,
    solid=cc.Elastic(young_modulus=np.inf, poisson_ratio=0.3),
)
RADII = np.linspace(50e-6, 110e-6, 40)


def planned(**known):
    return loads_at(RIGID, RADII, **known)


def retract(points=60, **known):
    """A colloidal probe on a film, pulled off."""
    heights = np.linspace(-0.5e-6, 8e-6, points)
    return cc.Experiment(
        kind="force-height",
        abscissa=heights,
        retract=np.full(points, True),
        system=make_system(film_modulus=5e5, film_poisson_ratio=0.45),
        work_of_adhesion=W,
        stiffness=200.0,
        **known,
    )


def test_predictions_are_jkr():
    found = cc.predict(planned(), ["sphere_modulus", "work_of_adhesion", "load_offset"])
    assert np.allclose(found.ordinate, jkr_load(RADII), rtol=1e-12, atol=1e-18)
    by_modulus = 4 * RADII**3 / 3e-3 - np.sqrt(2 * pi * W * RADII**3 / MODULUS)
    assert np.allclose(found.derivatives["sphere_modulus"], by_modulus, rtol=1e-11, atol=1e-22)
    by_work = -np.sqrt(2 * pi * MODULUS * RADII**3 / W)
    assert np.allclose(found.derivatives["work_of_adhesion"], by_work, rtol=1e-12)
    assert np.array_equal(found.derivatives["load_offset"], np.ones(40))
    assert set(found.branch) == {"advancing"}


def test_branches_come_from_the_data():
    made = cc.simulate(retract(contact_point=4e-6), noise=1e-8, seed=4)
    from_data = cc.branches(made, ["work_of_adhesion", "contact_point", "baseline"])
    of_model = cc.predict(made).branch
    assert from_data.count("receding") > 20
    differ = [i for i in range(60) if from_data[i] != of_model[i]]
    assert all(from_data[i] == "left-out" for i in differ)
    assert len(differ) < 4
    found = cc.predict(made, branches=from_data)
    assert np.array_equal(np.isnan(found.ordinate), [b == "left-out" for b in from_data])


def test_most_points_left_out_are_an_error_unless_allowed():
    """A work of adhesion that is taken for far smaller than it is."""
    made = cc.simulate(retract(points=100, contact_point=4e-6), noise=1e-7, seed=1)
    weak, free = replace(made, work_of_adhesion=1e-3), ["contact_point"]
    words = "points in contact are left out, more than a third"
    refuses(cc.FitError, words, lambda: cc.fit(weak, free))
    found = cc.fit(weak, free, allow=["left-out"])
    (points,) = found.experiments
    assert points.left_out["beyond-end"] > 20
    assert sum(points.left_out.values()) == points.branch.count("left-out")
    assert "left-out" in {warning.kind for warning in found.warnings}
    assert list(cc.fit_map([weak], free, errors="nan").failures) == [0]
    refuses(cc.FitError, "allow.*left-out", lambda: cc.fit(weak, free, allow=["leftout"]))


def test_what_would_not_be_determined_is_named():
    """Beside a thick film only the compound modulus of sphere and film counts."""
    one = loads_at(make_system(film_thickness=1e-2), [5e-5, 6e-5, 7e-5], noise=1e-6)
    found = cc.forecast(one, ["sphere_modulus", "film_modulus"])
    assert found.undetermined
    assert "film-modulus" in found.undetermined[0]
    prior = cc.Free(parameter="film_modulus", prior=(3.5e6, 1e5))
    assert cc.forecast(one, ["sphere_modulus", prior]).stderr["film_modulus"] == pytest.approx(
        1e5, rel=1e-3
    )


def test_what_cannot_be_used_is_named():
    refuses(cc.FitError, "finite", lambda: cc.fit(planned(), WANTED))
    refuses(
        cc.FitError, "number of branches = 1", lambda: cc.predict(planned(), branches=["advancing"])
    )
    refuses(
        cc.FitError, "branch = 'up' cannot be used", lambda: cc.predict(planned(), branches=["up"])
    )
    refuses(cc.FitError, "parameter = 'colour'", lambda: cc.predict(planned(), ["colour"]))
    refuses(TypeError, "must be a list", lambda: cc.predict(planned(), "sphere_modulus"))
    refuses(TypeError, "must be an Experiment", lambda: cc.predict(3))
    refuses(cc.InputError, "seed = -1", lambda: cc.simulate(planned(), noise=1.0, seed=-1))
    refuses(cc.FitError, "finite", lambda: cc.branches(planned()))


def test_numbers_are_those_of_rust_bit_for_bit(tabulate, tmp_path):
    program = os.environ["TABULATE"]
    radii = [4e-5, 6.25e-5, 8.5e-5, 0.0001075, 0.00013]
    plan = loads_at(make_system(film_thickness=1e-6), radii, noise=5e-6)
    plan_options = {"kind": "load-radius", "from": 4e-5, "to": 1.3e-4, "points": 5, "noise": 5e-6}
    command = ["simulate", *(f"--{name}={value}" for name, value in plan_options.items())]
    run = subprocess.run(
        [program, *command, "--seed", "3"], check=True, capture_output=True, text=True
    )
    lines = [line for line in run.stdout.splitlines() if not line.startswith("#")]
    printed = list(csv.DictReader(lines))
    assert [float(row["contact_radius"]) for row in printed] == plan.abscissa.tolist()
    made = cc.simulate(plan, noise=5e-6, seed=3)
    assert not np.array_equal(cc.simulate(plan, noise=5e-6, seed=4).ordinate, made.ordinate)
    assert made.ordinate.tolist() == [float(row["load"]) for row in printed]
    run = subprocess.run(
        [program, *command, "--expect", "--json"], check=True, capture_output=True, text=True
    )
    expected = json.loads(run.stdout)
    found = cc.forecast(plan, WANTED)
    rows = {one.quantity: one.changes["sphere_modulus"] for one in found.fixed_values}
    assert -0.045 < rows["contact_radius"] / plan.system.sphere_modulus < -0.03
    stderr = {name: one["stderr"] for name, one in expected["parameters"].items()}
    assert isinstance(found, cc.Forecast)
    assert (found.stderr, found.correlation.tolist()) == (stderr, expected["correlation"])
    assert found.warnings == ()


def test_a_plan_outside_the_model_is_told_as_its_fit_is() -> None:
    plan = loads_at(
        make_system(film_modulus=2e5, film_thickness=1e-4), np.linspace(4e-5, 4e-4, 20), noise=5e-6
    )
    expected = cc.forecast(plan, WANTED)
    kinds = [warning.kind for warning in expected.warnings]
    assert kinds == ["calibration", "calibration", "large-contact", "large-strain"]
    assert "a/R reaches 0.40" in expected._repr_html_()
