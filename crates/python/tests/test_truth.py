"""JKR in closed form, and Rust bit for bit."""

from math import pi

import numpy as np
import pytest

import coated_contact as cc
from conftest import refuses, rows, system_of

SYSTEMS = rows("systems")


@pytest.fixture(scope="module")
def jkr():
    solid = cc.Elastic(young_modulus=1e6, poisson_ratio=0.5)
    return cc.Contact.half_space(cc.HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=solid))


def test_pull_off_of_jkr(jkr):
    w, radius = np.geomspace(1e-4, 1.0, 9), 1e-3
    assert np.allclose(jkr.pull_off(w).load, -1.5 * pi * w * radius, rtol=1e-14, atol=0)
    rigid = jkr.pull_off(w, control="displacement")
    assert np.allclose(rigid.load, -5 / 6 * pi * w * radius, rtol=1e-12, atol=0)
    of_loads = jkr.work_of_adhesion_at_pull_off(-1.5 * pi * w * radius)
    assert np.allclose(of_loads, w, rtol=1e-12, atol=0)
    of_rigid = jkr.work_of_adhesion_at_pull_off(rigid.load[0], control="displacement")
    assert of_rigid == pytest.approx(1e-4, rel=1e-12)
    refuses(cc.InputError, "pull-off load = 1e-6", lambda: jkr.work_of_adhesion_at_pull_off(1e-6))
    # A very stiff spring is a rigid machine, a very soft one a dead weight.
    stiff = jkr.pull_off(0.04, control=cc.Spring(stiffness=1e12))
    assert stiff.load == pytest.approx(jkr.pull_off(0.04, control="displacement").load, rel=1e-6)
    soft = jkr.pull_off(0.04, control=cc.Spring(stiffness=1e-6))
    assert soft.load == pytest.approx(jkr.pull_off(0.04).load, rel=1e-12)
    # a^3 = 9 pi w R^2/(8 E*), with the compliances of sphere and solid.
    modulus = 1 / (1 / 2e6 + 0.75 / 1e6)
    assert jkr.system.compound_modulus == pytest.approx(modulus, rel=1e-14)
    expected = np.cbrt(9 * pi * w * radius**2 / (8 * modulus))
    assert np.allclose(jkr.pull_off(w).contact_radius, expected, rtol=1e-12, atol=0)


def test_equilibria_are_states(jkr):
    equilibria = jkr.equilibria(0.04)
    unstable, stable = equilibria.at(-1e-4)
    assert (unstable.stable, stable.stable) == (False, True)
    assert unstable.state.contact_radius < stable.state.contact_radius
    assert jkr.load(unstable.state.contact_radius, 0.04) == pytest.approx(-1e-4, rel=1e-12)
    assert equilibria.unloading(-1e-4) == stable.state
    assert equilibria.pull_off() == jkr.pull_off(0.04)


def test_force_displacement_of_jkr(jkr):
    curve = jkr.force_displacement(0.04, control="displacement", most=1e-5, points=50)
    assert [len(branch) for branch in (*curve.loading, *curve.unloading)] == [50, 50]
    into, apart = curve.jumps
    assert (into.from_.load, into.from_.penetration) == (0, 0)
    assert apart.from_ == jkr.pull_off(0.04, control="displacement")
    assert apart.to is not None
    assert (apart.to.load, apart.to.penetration) == (0, apart.from_.penetration)
    states = curve.unloading[0]
    assert states.penetration[0] == pytest.approx(1e-5, rel=1e-12)
    assert np.array_equal(states.load, jkr.load(states.contact_radius, 0.04))
    # Under a dead weight the separated sphere does not come to rest.
    assert jkr.force_displacement(0.04, control="load", most=1e-3).jumps[-1].to is None


def test_gradients_have_their_names(contact):
    """Those of the contact radius give the moving stiffness, the others are those of `predict`."""
    a, w = np.array([5e-5, 6.5e-5]), 0.04
    gradient = contact.gradient(a, w)
    by_radius = gradient.by("contact_radius")
    slope = by_radius.load / by_radius.penetration
    assert slope == pytest.approx(contact.moving_stiffness(a, w), rel=1e-8)
    by = ["sphere_modulus", "film_modulus", "film_poisson_ratio", "film_thickness"]
    by.append("work_of_adhesion")
    for kind, which in (("load-radius", "load"), ("penetration-radius", "penetration")):
        lens = cc.Experiment(kind=kind, abscissa=a, system=contact.system, work_of_adhesion=w)
        for name, derivative in cc.predict(lens, by).derivatives.items():
            assert getattr(gradient.by(name), which) == pytest.approx(derivative, rel=1e-9), name


def test_numbers_are_those_of_rust_bit_for_bit(tabulate):
    for row in SYSTEMS[::5]:
        system = system_of(row)
        w, largest = float(row["work_of_adhesion"]), float(row["contact_radius"])
        options = {
            "film-thickness": system.film_thickness,
            "film-modulus": system.film.young_modulus,
            "film-poisson-ratio": system.film.poisson_ratio,
            "substrate-modulus": system.substrate.young_modulus,
            "substrate-poisson-ratio": system.substrate.poisson_ratio,
            "sphere-radius": system.sphere_radius,
            "sphere-modulus": system.sphere_modulus,
            "work-of-adhesion": w,
            "from": 0.1 * largest,
            "to": largest,
            "points": 20,
        }
        arguments = [f"--{name}={value!r}" for name, value in options.items()]
        printed = tabulate("curve", "embedded", *arguments)
        contact = cc.Table.embedded().contact(system)
        a = np.array([point["contact_radius"] for point in printed])
        load, penetration = contact.load_and_penetration(a, w)
        stiffness, moving = contact.stiffness(a), contact.moving_stiffness(a, w)
        assert load.tolist() == [point["load"] for point in printed]
        assert penetration.tolist() == [point["penetration"] for point in printed]
        assert stiffness.tolist() == [point["contact_stiffness"] for point in printed]
        assert moving.tolist() == [point["moving_stiffness"] for point in printed]
