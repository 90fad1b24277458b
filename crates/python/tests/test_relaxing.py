"""Fits of films that relax: approach, hold and retract in time."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import coated_contact as cc
from conftest import make_system, refuses

GEL = make_system(
    sphere_radius=2e-5, sphere_modulus=math.inf, film_modulus=2e3, substrate_modulus=math.inf
)
TIME = np.linspace(0.0, 2.0, 80)
DEPTH = 6e-7 * (1.0 - 1.2 * np.abs(TIME - 1.0))
LAW = cc.Relaxation.power_law(0.2)
FREE = ["film_modulus", "relaxation_exponent", "contact_point"]


def plan(**known: Any) -> cc.Experiment:
    fields = {"time": TIME, "relaxation": LAW, "noise": 1e-10, **known}
    return cc.Experiment(kind="load-penetration", abscissa=DEPTH, system=GEL, **fields)


def test_modulus_and_law_are_found() -> None:
    made = cc.simulate(plan(), noise=1e-10, seed=1)
    assert np.array_equal(made.time, TIME)
    other = replace(made, relaxation=cc.Relaxation.power_law(0.4))
    found = cc.fit(other, FREE)
    for name, truth in [("film_modulus", 2e3), ("relaxation_exponent", 0.2)]:
        assert found.params[name] == pytest.approx(truth, abs=4 * found.stderr[name])
    times, moduli, changed, unlike, steps = found.experiments[0].relaxation
    assert moduli[1] == pytest.approx(found.params["film_modulus"] * times[1] ** -0.2, rel=0.02)
    assert changed == unlike == 0.0
    assert 0.0 < steps < 1e-4
    assert "Young's modulus" in str(found)
    expected = cc.forecast(plan(), FREE)
    assert found.stderr["film_modulus"] == pytest.approx(expected.stderr["film_modulus"], rel=0.2)


def test_several_terms_have_names() -> None:
    law = cc.Relaxation.prony(0.2, [0.05, 0.6], [0.5, 0.3])
    names = ["relaxed_fraction", "relaxation_time", "relaxation_time.2", "relaxation_weight.2"]
    found = cc.predict(plan(relaxation=law), ["film_modulus", *names])
    loads = found.ordinate
    assert found.derivatives["film_modulus"] * 2e3 == pytest.approx(loads, rel=1e-3, abs=1e-12)
    step = 1e-4
    moved = [
        cc.predict(
            plan(relaxation=cc.Relaxation.prony(0.2, [0.05, 0.6 + s], [0.5, 0.3])), []
        ).ordinate
        for s in (-step, step)
    ]
    slope = (moved[1] - moved[0]) / (2 * step)
    largest = np.abs(slope).max()
    assert found.derivatives["relaxation_time.2"] == pytest.approx(slope, abs=1e-3 * largest)


@pytest.mark.parametrize(
    ("known", "words"),
    [
        ({"time": None}, "no times"),
        ({"time": TIME[::-1]}, "times must rise"),
        ({"work_of_adhesion": 0.01}, "work of adhesion"),
        ({"contact_point": -1e-6}, "begins in contact"),
    ],
)
def test_what_cannot_be_simulated_says_why(known: dict[str, Any], words: str) -> None:
    refuses(
        (cc.FitError, cc.InputError), words, lambda: cc.simulate(plan(**known), noise=0.0, seed=0)
    )


def test_wrong_types_are_refused() -> None:
    refuses(TypeError, "Relaxation", lambda: plan(relaxation=0.2))
    refuses(TypeError, "all_relax", lambda: plan(all_relax=1))
    refuses(cc.FitError, "one number for each point", lambda: plan(time=TIME[1:]))
    with pytest.raises(cc.FitError, match="does not have"):
        cc.fit(cc.simulate(plan(), noise=1e-10, seed=0), ["film_modulus", "relaxation_time"])
    refuses(cc.FitError, "parameter", lambda: cc.fit(plan(), ["relaxation_time.x"]))


def test_bodies_that_do_not_relax() -> None:
    soft = replace(GEL, substrate=cc.Elastic(young_modulus=2e4, poisson_ratio=0.4))
    made = cc.simulate(plan(), noise=1e-10, seed=1)
    refuses(
        (cc.FitError, cc.InputError),
        "all_relax=True",
        lambda: cc.fit(replace(made, system=soft), FREE),
    )
    assert cc.fit(replace(made, system=soft, all_relax=True), FREE).converged
