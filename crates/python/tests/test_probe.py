"""Probes of every shape: closed forms, independent values, Rust bit for bit, and every function."""

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest

import coated_contact as cc
from conftest import PROBES, make_system, refuses

W = 0.04
MODULUS = 4e6
by_name = pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.name)


def on_half_space(probe):
    """A rigid probe on a half-space with E* = 4 MPa."""
    solid = cc.Elastic(young_modulus=3e6, poisson_ratio=0.5)
    return cc.Contact.half_space(cc.HalfSpace(probe=probe, sphere_modulus=inf, solid=solid))


def on_film(probe):
    return cc.Table.embedded().contact(replace(make_system(film_thickness=2e-6), probe=probe))


UNEVEN = cc.Profile(points=[(1e-6, 2e-8), (3e-6, 1e-7), (3.5e-6, 3e-7), (9e-6, 4e-6)])


@pytest.mark.parametrize("probe", [*PROBES, UNEVEN], ids=lambda probe: probe.name)
def test_heights_are_those_of_the_contact(probe):
    """Without adhesion delta0 = int_0^a f'(r) a / sqrt(a^2 - r^2) dr on a half-space."""
    assert type(probe.height(2e-6)) is float
    assert np.array_equal(probe.height([[2e-6], [-2e-6]]), np.full((2, 1), probe.height(2e-6)))
    if isinstance(probe, cc.FlatPunch):
        assert probe.height([2e-6, 1e-5]).tolist() == [0.0, inf]
        return
    a = 4e-6
    # With r = a sin(theta) the integral is that of f'(a sin theta) a, whose bends need many points.
    theta = np.linspace(0, pi / 2, 20_001)
    middles = 0.5 * (theta[1:] + theta[:-1])
    rise = np.diff(probe.height(a * np.sin(theta)))
    delta = np.sum(rise / np.cos(middles))
    assert on_half_space(probe).load_and_penetration(a, 0.0)[1] == pytest.approx(delta, rel=1e-3)


@pytest.mark.parametrize("first", [0, 1])
def test_a_profile_of_a_paraboloid_has_its_heights(first):
    """Between the points, near the axis, and beyond the last bend."""
    paraboloid = cc.Paraboloid(radius=1e-3)
    points = np.arange(first, 11) * 1e-5
    profile = cc.Profile(points=np.stack([points, paraboloid.height(points)], axis=1))
    r = np.array([0.0, 1e-7, 4e-6, 5e-6, 2.5e-5, 9.4e-5, 9.6e-5, 1e-4])
    assert profile.height(r) == pytest.approx(paraboloid.height(r), rel=1e-14, abs=0)
    assert profile.height([1.0001e-4, inf]).tolist() == [inf, inf]


def test_sphere_radius_is_the_paraboloid():
    system = make_system()
    assert system.probe == cc.Paraboloid(radius=1e-3)
    assert system == replace(system, probe=cc.Paraboloid(radius=1e-3))
    assert system.sphere_radius == 1e-3
    assert replace(system, probe=cc.Sphere(radius=2e-3)).sphere_radius == 2e-3
    assert replace(system, probe=cc.Cone(half_angle=1.0)).sphere_radius is None
    assert replace(system, probe=cc.Cone(half_angle=1.0)).without_film().probe == cc.Cone(
        half_angle=1.0
    )
    assert replace(system, sphere_radius=2e-3).probe == cc.Paraboloid(radius=2e-3)
    known = {"sphere_modulus": 2e6, "solid": system.film}
    refuses(TypeError, "not nothing; sphere_radius=R is short", lambda: cc.HalfSpace(**known))
    refuses(TypeError, "must be a Probe, such as", lambda: cc.HalfSpace(probe=1e-3, **known))
    refuses(TypeError, "radius must be real", lambda: cc.Sphere(radius="1e-3"))


def test_shapes_that_cannot_be_are_refused():
    refuses(cc.InputError, "sphere_radius = -1", lambda: cc.Sphere(radius=-1.0))
    refuses(cc.InputError, "between 0 and pi/2 rad", lambda: cc.Cone(half_angle=70.0))
    refuses(TypeError, "two columns", lambda: cc.Profile(points=[1.0, 2.0]))
    with pytest.raises(TypeError):
        cc.Probe()


def test_points_that_are_no_convex_shape_are_named():
    points = [(0, 0), (1e-6, 1e-6), (2e-6, 1.5e-6)]
    error = refuses(cc.InputError, r"row 3 .* convex", lambda: cc.Profile(points=points))
    assert error.value == 3.0


def test_questions_about_the_wrong_shape_are_errors():
    punch, cone = (on_film(PROBES[i]) for i in (5, 3))
    error = refuses(cc.InputError, "under a flat punch", lambda: punch.load([3e-6, 2e-6], W))
    assert (error.axis, error.value, error.index) == ("contact radius", 2e-6, (1,))
    assert "3e-6 m" in error.allowed
    refuses(cc.InputError, "contact line", lambda: punch.line(W, 3e-6))
    refuses(cc.InputError, "Tabor's parameter makes no sense for a cone", lambda: cone.zone_size(W))
    refuses(cc.InputError, "sphere radius", lambda: cone.gradient(2e-6, W).by("sphere_radius"))


def test_what_the_exact_shape_neglects_is_named():
    film = cc.Elastic(young_modulus=3.5e6, poisson_ratio=0.2)
    system = replace(make_system(), film=film, probe=cc.Sphere(radius=1e-5))
    many = cc.Table.embedded().contact(system).validity([2e-6, 1.0], errors="nan")
    assert many.neglected["sideways"].tolist() == [True, False]
    # Es*/E2*, with 1/Es* = 1/E1* + 1/E2*.
    share = 1 / (1 + 2e6 / film.reduced_modulus)
    assert many.probe_share[0] == pytest.approx(share, rel=1e-12)
    expected = 0.75 / pi * (1 - 0.4) / (1 - 0.2) * 0.2 * (1 - share)
    assert many.sideways[0] == pytest.approx(expected, rel=1e-12)
    half_space = on_half_space(cc.Sphere(radius=1e-5)).validity(2e-6)
    assert half_space.strain is None
    assert set(half_space.neglected.values()) == {False}


@pytest.mark.parametrize(
    ("name", "probe", "flags"),
    [
        ("cone", cc.Cone(half_angle=np.radians(60)), "--half-angle=60"),
        ("sphere", PROBES[1], "--sphere-radius=1e-5"),
        (
            "rounded-cone",
            cc.RoundedCone(radius=2e-6, half_angle=np.radians(45)),
            "--sphere-radius=2e-6 --half-angle=45",
        ),
        ("power-law", PROBES[2], "--coefficient=2e9 --exponent=3"),
        (
            "flat-ended-cone",
            cc.FlatEndedCone(radius=1e-6, half_angle=np.radians(63)),
            "--sphere-radius=1e-6 --half-angle=63",
        ),
    ],
)
def test_numbers_are_those_of_rust_bit_for_bit(tabulate, name, probe, flags):
    flags += " --film-thickness=2e-6 --from=1e-6 --to=4e-6 --points=10"
    printed = tabulate("curve", "embedded", "--probe", name, *flags.split())
    a, load, penetration = (
        np.array([point[column] for point in printed])
        for column in ("contact_radius", "load", "penetration")
    )
    found = on_film(probe).load_and_penetration(a, 0.04)
    assert np.array_equal(found[0], load)
    assert np.array_equal(found[1], penetration)
