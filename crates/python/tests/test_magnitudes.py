"""Numbers that no contact experiment has are warned of at the line that gave them."""

import pickle
import warnings
from dataclasses import replace
from math import inf

import numpy as np
import pytest

import coated_contact as cc
from conftest import loads_at, make_system

GEL = cc.Elastic(young_modulus=1e4, poisson_ratio=0.45)
STEEL = cc.Elastic(young_modulus=2e14, poisson_ratio=0.3)
LAYER = cc.Layer(material=GEL, thickness=30.0)
CONTACT = cc.Table.embedded().contact(make_system())
CUBIC = cc.PowerLaw(coefficient=0.01, exponent=3.0)

CASES = {
    "um for m": (
        lambda: replace(make_system(), sphere_radius=10.0, film_thickness=20.0),
        [
            "the radius of the sphere = 10 m is above 0.1 m: 10 mm, 10 um",
            "the film thickness = 20 m",
        ],
    ),
    "kPa for Pa": (
        lambda: cc.HalfSpace(sphere_radius=1e-5, sphere_modulus=inf, solid=STEEL),
        ["the half-space's modulus = 2e14 Pa is above the moduli of all solids"],
    ),
    "a layer in um": (
        lambda: cc.StackSystem(
            sphere_radius=1e-5, sphere_modulus=inf, stack=cc.Stack(base=GEL, layers=[LAYER])
        ),
        ["the thickness of a layer = 30 m is above"],
    ),
    "a coefficient in um": (
        lambda: cc.HalfSpace(probe=CUBIC, sphere_modulus=inf, solid=GEL),
        ["flatter than any probe"],
    ),
    "mJ/m^2 for J/m^2": (
        lambda: CONTACT.load([5e-5, 6e-5], [0.04, 40]),
        ["= 40 J/m^2 is above 20"],
    ),
    "mJ/m^2 of a pull-off": (lambda: CONTACT.pull_off(40.0), ["= 40 J/m^2 is above 20"]),
    "mJ/m^2 of equilibria": (lambda: CONTACT.equilibria(40.0), ["= 40 J/m^2 is above 20"]),
    "mJ/m^2 of a line": (lambda: cc.Hysteresis(advancing=30.0, receding=40.0), ["= 40 J/m^2"]),
    "mJ/m^2 with a range": (
        lambda: cc.Cohesive(system=CONTACT.system, work_of_adhesion=40.0, interaction_range=1e-9),
        ["= 40 J/m^2 is above 20"],
    ),
    "mJ/m^2 with a stress": (
        lambda: CONTACT.cohesive_zone(40.0, stress=1e13),
        ["= 40 J/m^2 is above 20"],
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_number_in_another_unit_is_warned_of(case):
    call, expected = CASES[case]
    with pytest.warns(cc.MagnitudeWarning) as caught:
        call()
    texts = [str(one.message) for one in caught]
    assert len(texts) == len(expected)
    assert all(words in text for words, text in zip(expected, texts, strict=True)), texts
    assert all("SI units" in text for text in texts)
    assert {one.filename for one in caught} == {__file__}


def test_what_experiments_have_is_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for radius in np.geomspace(1e-9, 0.1, 9):
            make_system(sphere_radius=radius, film_thickness=radius)
        CONTACT.load(5e-5, [0.0, 0.04, 12.0])
        CONTACT.load([], [])


def test_trials_of_another_program_and_copies_are_not_warned_of():
    pytest.importorskip("lmfit")
    from coated_contact.lmfit import with_values

    experiment = loads_at(make_system(), np.linspace(4e-5, 1.2e-4, 30), noise=2e-6)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        trial = with_values(experiment, {"sphere_modulus": 1e14, "film_thickness": 10.0})
        assert pickle.loads(pickle.dumps(trial)).system == trial.system
    with pytest.warns(cc.MagnitudeWarning):
        replace(trial.system, film_thickness=20.0)
