"""Contacts with full friction: published limits, pull-offs of three histories, and refusals."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest

import coated_contact as cc
from conftest import refuses

CURVE = cc.SolvedCurve(a_over_t=(1e-3, 20.0), friction="stick")


@pytest.fixture(scope="module")
def gel():
    """A rigid sphere on an incompressible film on a rigid base, with E1* = 1 Pa."""
    return cc.System(
        sphere_radius=1.0,
        sphere_modulus=inf,
        film=cc.Elastic(young_modulus=0.75, poisson_ratio=0.5),
        film_thickness=1e-3,
        substrate=cc.Elastic(young_modulus=inf, poisson_ratio=0.25),
    )


def test_the_two_edges_of_a_punch_are_those_of_another_program():
    punch = cc.solve_stick_punch(1.0, 0.0, 0.5, inf, tolerance=1e-10)
    assert punch.eeq_s == pytest.approx(3.929038326620684725, rel=1e-10)
    assert punch.gamma_s == pytest.approx(2.901639280012122975, rel=1e-10)
    assert punch.gamma_t == pytest.approx(0.853450270007150246, rel=1e-10)
    assert np.isnan(cc.solve_stick_punch(1.0, 0.0, 0.3, inf).gamma_s)


@pytest.mark.parametrize(
    ("advancing", "expected"), [(1.0, [-1.8946, -1.8938]), (0.0, [-1.8464, -2.0597])]
)
def test_pull_offs_are_those_of_another_program(gel, advancing, expected):
    contact = replace(CURVE, advancing=advancing).contact(gel)
    found = [contact.pull_off(w).load / (pi * w) for w in (1e-9, 1e-8)]
    assert found == pytest.approx(expected, abs=1e-4)


def test_validity_tells_the_size_of_friction(gel):
    """Stiffness with friction over that without, by another program: 1.086 and 1.366."""
    contact = cc.SolvedCurve(a_over_t=(1e-3, 20.0)).contact(gel)
    size = contact.validity([1e-4, 1e-3, 2e-3]).friction()
    assert size == pytest.approx([0.0, 0.086, 0.366], abs=6e-4)
    assert size[1:] == pytest.approx(
        cc.solve_stick_punch([1.0, 2.0], 0.0, 0.5, inf).eeq_s
        / cc.solve([1.0, 2.0], 0.0, 0.5, inf).eeq
        - 1,
        rel=1e-5,
    )
    assert CURVE.contact(gel).validity(2e-3).friction() == pytest.approx(size[2])
    too_wide = contact.validity([1e-3, 0.9])
    refuses(cc.SolveError, "a_over_t = 900", lambda: too_wide.friction())
    assert np.isnan(too_wide.friction(errors="nan")).tolist() == [False, True]
    glass = cc.HalfSpace(sphere_radius=1.0, sphere_modulus=inf, solid=gel.film)
    assert cc.Contact.half_space(glass).validity(1e-3).friction() is None


def test_what_is_not_solved_is_refused(gel):
    with pytest.raises(cc.InputError, match=r"artanh\(beta\)/beta = 1\.0"):
        CURVE.contact(replace(gel, film=cc.Elastic(young_modulus=1.0, poisson_ratio=0.49)))
    refuses(
        cc.InputError,
        "paraboloid",
        lambda: CURVE.contact(replace(gel, probe=cc.Sphere(radius=1.0))),
    )
    with pytest.raises(cc.InputError, match="finite range"):
        CURVE.contact(gel).cohesive_zone(1e-9, stress=1e3).pull_off()
    refuses(cc.ContactError, r"1\.5", lambda: replace(CURVE, advancing=1.5).contact(gel))
    refuses(ValueError, "stick", lambda: replace(CURVE, friction="some"))
    assert cc.Paraboloid(radius=1.0) == gel.probe
