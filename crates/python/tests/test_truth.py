"""Independent values: direct solves by another program, JKR in closed form, Rust bit for bit."""

from math import pi, sqrt

import numpy as np
import pytest

from coated_contact import Contact, Elastic, HalfSpace, Spring, System, Table
from conftest import rows, system_of

SYSTEMS = rows("systems")


def test_every_system_of_the_catalogue_is_answered():
    """Errors are relative to the sizes of the two terms of eq. 9, which may cancel."""
    assert len(SYSTEMS) > 90
    for row in SYSTEMS:
        contact = Table.embedded().contact(system_of(row))
        a, w = float(row["contact_radius"]), float(row["work_of_adhesion"])
        found = dict(zip(("load", "penetration"), contact.load_and_penetration(a, w), strict=True))
        for name, value in found.items():
            error = abs(value - float(row[name])) / float(row[f"{name}_scale"])
            assert error <= 1e-6, (row, name)


def test_the_reference_is_answered_by_the_embedded_table():
    """Values in double-double arithmetic; stiffness and zero-adhesion load are eqs. 4 and 5."""
    modulus, radius, thickness = 2e6, 1.0, 1e-6
    checked = 0
    for row in rows("barthel_reference"):
        x, e1, nu1, e0, nu0, pi0, eeq, delta0 = (
            float(row[name])
            for name in (
                *("a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "nu0"),
                *("pi0", "eeq", "delta0"),
            )
        )
        if e1 == 0:
            continue
        system = System(
            sphere_radius=radius,
            sphere_modulus=modulus,
            film=Elastic(young_modulus=e1 * modulus, poisson_ratio=nu1),
            film_thickness=thickness,
            substrate=Elastic(young_modulus=e0 * modulus, poisson_ratio=nu0),
        )
        contact, a = Table.embedded().contact(system), x * thickness
        expected = (a**3 * modulus * pi0 / (2 * radius), a**2 * delta0 / radius)
        assert contact.load_and_penetration(a, 0.0) == pytest.approx(expected, rel=1e-6)
        assert contact.stiffness(a) == pytest.approx(2 * a * modulus * eeq, rel=1e-6)
        checked += 1
    assert checked > 30


@pytest.fixture(scope="module")
def jkr():
    solid = Elastic(young_modulus=1e6, poisson_ratio=0.5)
    return Contact.half_space(HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=solid))


def test_a_half_space_is_jkr(jkr):
    """F = 4 E* a^3 / (3 R) - sqrt(8 pi w E* a^3), delta = a^2/R - sqrt(2 pi w a / E*)."""
    radius, w, a = 1e-3, 0.04, np.geomspace(1e-6, 1e-4, 50)
    modulus = jkr.system.compound_modulus
    terms = 4 * modulus * a**3 / (3 * radius), np.sqrt(8 * pi * w * modulus * a**3)
    assert np.all(np.abs(jkr.load(a, w) - (terms[0] - terms[1])) <= 1e-14 * sum(terms))
    terms = a**2 / radius, np.sqrt(2 * pi * w * a / modulus)
    assert np.all(np.abs(jkr.penetration(a, w) - (terms[0] - terms[1])) <= 1e-14 * sum(terms))
    assert np.allclose(jkr.stiffness(a), 2 * a * modulus, rtol=1e-14, atol=0)
    gradient = jkr.gradient(a, w)
    assert np.array_equal(gradient.load, jkr.load(a, w))
    slope = gradient.by("contact_radius").load
    terms = 4 * modulus * a**2 / radius, 1.5 * np.sqrt(8 * pi * w * modulus * a)
    assert np.all(np.abs(slope - (terms[0] - terms[1])) <= 1e-13 * sum(terms))


def test_pull_off_of_jkr(jkr):
    w, radius = np.geomspace(1e-4, 1.0, 9), 1e-3
    assert np.allclose(jkr.pull_off(w).load, -1.5 * pi * w * radius, rtol=1e-14, atol=0)
    rigid = jkr.pull_off(w, control="displacement")
    assert np.allclose(rigid.load, -5 / 6 * pi * w * radius, rtol=1e-12, atol=0)
    # A very stiff spring is a rigid machine, a very soft one a dead weight.
    stiff = jkr.pull_off(0.04, control=Spring(stiffness=1e12))
    assert stiff.load == pytest.approx(jkr.pull_off(0.04, control="displacement").load, rel=1e-6)
    soft = jkr.pull_off(0.04, control=Spring(stiffness=1e-6))
    assert soft.load == pytest.approx(jkr.pull_off(0.04).load, rel=1e-12)


def test_equilibria_of_jkr(jkr):
    """a^3 = 3 R / (4 E*) (F + 3 pi w R +- sqrt(6 pi w R F + (3 pi w R)^2))."""
    radius, w, load = 1e-3, 0.04, -1e-4
    modulus, unit = jkr.system.compound_modulus, 3 * pi * w * radius
    root = sqrt(2 * unit * load + unit**2)
    expected = [
        (0.75 * radius / modulus * (load + unit + sign * root)) ** (1 / 3) for sign in (-1, 1)
    ]
    found = jkr.equilibria(w).at(load)
    assert [equilibrium.stable for equilibrium in found] == [False, True]
    radii = [equilibrium.state.contact_radius for equilibrium in found]
    assert radii == pytest.approx(expected, rel=1e-13)
    assert jkr.equilibria(w).unloading(load) == found[1].state
    assert jkr.equilibria(w).pull_off() == jkr.pull_off(w)


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


def test_gradients_are_those_of_differences(contact):
    """Central differences in the contact radius, the work of adhesion and the film's modulus."""
    a, w, step = 65e-6, 0.04, 1e-5
    gradient = contact.gradient(a, w)

    def difference(function, at):
        return (function(at * (1 + step)) - function(at * (1 - step))) / (2 * at * step)

    def load_of_modulus(modulus):
        from conftest import make_system

        return Table.embedded().contact(make_system(film_modulus=modulus)).load(a, w)

    cases = {
        "contact_radius": (lambda a: contact.load(a, w), a),
        "work_of_adhesion": (lambda w: contact.load(a, w), w),
        "film_modulus": (load_of_modulus, 3.5e6),
    }
    for name, (function, at) in cases.items():
        expected = difference(function, at)
        assert gradient.by(name).load == pytest.approx(expected, rel=1e-6), name


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
        a, load, penetration = (
            np.array([point[name] for point in printed])
            for name in ("contact_radius", "load", "penetration")
        )
        found = Table.embedded().contact(system).load_and_penetration(a, w)
        assert np.array_equal(found[0], load)
        assert np.array_equal(found[1], penetration)
