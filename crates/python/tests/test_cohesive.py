"""An attraction of finite range: independent values, limits, and Rust bit for bit."""

from dataclasses import replace
from functools import partial
from math import pi

import numpy as np
import pytest

import coated_contact as cc
from conftest import ROOT, make_system, refuses

THICKNESS, MODULUS = 1e-6, 1e6


@pytest.fixture(scope="module")
def cohesive():
    system = make_system(sphere_radius=1e-5, sphere_modulus=7.5e10, film_thickness=1e-6)
    return cc.Cohesive(system=system, work_of_adhesion=0.05, interaction_range=1e-8)


def test_states_broadcast_and_are_those_of_a_branch(cohesive):
    branch = cohesive.branch((1e-6, 4e-6), 5)
    assert len(branch) == 5
    assert branch.contact_radius == pytest.approx(np.geomspace(1e-6, 4e-6, 5), rel=1e-12)
    found = cohesive.state(branch.contact_radius)
    for name in ("contact_radius", "outer_radius", "load", "penetration"):
        assert getattr(found, name) == pytest.approx(getattr(branch, name), rel=1e-12)
    one = cohesive.state(branch.contact_radius[2])
    assert list(found)[2] == one
    assert one.outer_radius > one.contact_radius
    assert cohesive.state(branch.contact_radius.reshape(5, 1)).load.shape == (5, 1)


def test_pressure_and_gap(cohesive):
    a = 3e-6
    state = cohesive.state(a)
    sigma = 0.05 / 1e-8
    r = np.linspace(0, a, 2001)
    pressure = cohesive.pressure(a, r)
    assert pressure[-1] == pytest.approx(-sigma, rel=1e-6)
    # The load is the integral of the pressure inside and of the traction in the annulus.
    inside = np.sum(pi * np.diff(r**2) * 0.5 * (pressure[1:] + pressure[:-1]))
    outside = -sigma * pi * (state.outer_radius**2 - a**2)
    assert inside + outside == pytest.approx(state.load, rel=1e-3, abs=1e-3 * abs(outside))
    assert type(cohesive.pressure(a, 0.0)) is float
    gap = cohesive.gap(a, np.array([[a, state.outer_radius]]))
    assert gap.shape == (1, 2)
    assert gap[0] == pytest.approx([0.0, 1e-8], abs=1e-13)
    # The order of the radii does not matter, and none have none.
    radii = np.linspace(a, 1.9 * state.outer_radius, 7)
    for field, places in ((cohesive.pressure, radii / radii[-1] * a), (cohesive.gap, radii)):
        assert field(a, places[::-1]).tolist() == field(a, places)[::-1].tolist()
        assert field(a, []).shape == (0,)


def test_the_attraction_acts_before_the_contact(cohesive):
    far = replace(cohesive, interaction_range=1e-6)
    state = far.without_contact(1e-6)
    assert (state.contact_radius, state.outer_radius) == (0.0, pytest.approx(1e-6))
    assert state.load == pytest.approx(-pi * 1e-12 * 0.05 / 1e-6, rel=1e-12)
    states = far.without_contact([1e-7, 1e-6, 1.0], errors="nan")
    assert np.isnan(states.load).tolist() == [False, False, True]


@pytest.mark.parametrize("control", ["load", "displacement"])
def test_numbers_are_those_of_rust_bit_for_bit(printed, stack, control):
    primer = ROOT / "tables" / "stacks" / "primer.toml"
    flags = ("--sphere-radius=1e-4", "--sphere-modulus=2e6", "--work-of-adhesion=0.04")
    flags = (*flags, f"--control={control}")
    expected = printed("pull-off", "--stack", primer, "--interaction-range=1e-8", *flags)
    system = cc.StackSystem(stack=stack, sphere_radius=1e-4, sphere_modulus=2e6)
    cohesive = cc.Cohesive(system=system, work_of_adhesion=0.04, interaction_range=1e-8)
    found = cohesive.pull_off(control=control)
    for name, value in expected.items():
        assert getattr(found, name) == value
    assert len(expected) == 4


def test_a_contact_that_opens_inside_is_refused():
    """On a thin incompressible film a strong attraction holds the edge down and not the middle."""
    film = cc.Elastic(young_modulus=1.2e4, poisson_ratio=0.5)
    base = cc.Elastic(young_modulus=9.4e5, poisson_ratio=0.3)
    system = cc.System(
        sphere_radius=1.2e-6,
        sphere_modulus=np.inf,
        film=film,
        film_thickness=1.2e-8,
        substrate=base,
    )
    cohesive = cc.Cohesive(system=system, work_of_adhesion=0.15, interaction_range=1.5e-7)
    error = refuses(cc.NoContactError, "would open there", lambda: cohesive.state([[5.3e-7]]))
    assert (error.axis, error.index) == ("contact radius", (0, 0))
    assert error.value == pytest.approx(5.3e-7)


def test_what_is_not_solved_is_named(cohesive):
    error = refuses(
        cc.SolveError, "work of adhesion", lambda: replace(cohesive, work_of_adhesion=0.0)
    )
    assert error.value == 0.0
    cone = replace(cohesive.system, probe=cc.Cone(half_angle=1.2))
    refuses(
        cc.InputError, "paraboloid only, not for a cone", lambda: replace(cohesive, system=cone)
    )
    refuses(TypeError, "a System or a StackSystem", lambda: replace(cohesive, system=3))
    error = refuses(cc.SolveError, "contact radius", lambda: cohesive.state([1e-6, -1.0]))
    assert error.index == (1,)
    for field in (cohesive.pressure, cohesive.gap):
        error = refuses(cc.SolveError, "radius = 1.0 ", partial(field, 1e-6, [[1e-6, 1.0]]))
        assert error.index == (0, 1)
        # The contact radius is one number.
        error = refuses(cc.SolveError, "contact radius = 1.0 ", partial(field, 1.0, [1e-6, 1.0]))
        assert error.index is None
    refuses(cc.ContactError, "from 2 to 1000000", lambda: cohesive.branch((1e-6, 2e-6), 1))
