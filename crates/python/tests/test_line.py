"""Contact lines: adhesion hysteresis and rates, against JKR; validity in closed form."""

import pickle
from math import pi

import numpy as np
import pytest

from coated_contact import (
    Contact,
    ContactError,
    Elastic,
    HalfSpace,
    Hysteresis,
    InputError,
    RateDependent,
    Spring,
)

RADIUS, MODULUS = 1e-3, 2e6
RIGID = Elastic(young_modulus=np.inf, poisson_ratio=0.3)


@pytest.fixture(scope="module")
def jkr():
    return Contact.half_space(HalfSpace(sphere_radius=RADIUS, sphere_modulus=MODULUS, solid=RIGID))


def energy_release_rate(state):
    """G = (4 E* a^3/(3 R) - F)^2 / (8 pi E* a^3)."""
    a = state.contact_radius
    hertz = 4 * MODULUS * a**3 / (3 * RADIUS)
    return (hertz - state.load) ** 2 / (8 * pi * MODULUS * a**3)


@pytest.mark.parametrize("control", ["load", "displacement", Spring(stiffness=100.0)])
def test_a_line_of_one_energy_is_the_contact(jkr, control):
    line, equilibria = jkr.line(0.04, 60e-6), jkr.equilibria(0.04, control=control)
    value = 5e-4 if control == "load" else 5e-6
    state = line.impose(control, value)
    expected = equilibria.unloading(value)
    assert state.contact_radius == pytest.approx(expected.contact_radius, rel=1e-12)
    least = jkr.pull_off(0.04, control=control)
    end = {"load": least.load, "displacement": least.penetration}
    end = end[control] if isinstance(control, str) else least.penetration + least.load / 100.0
    assert line.impose(control, end + 1e-6 * abs(end)) is not None
    assert line.impose(control, end - 1e-6 * abs(end)) is None
    assert line.state is None
    assert line.impose(control, value) is None  # it does not form again


def test_hysteresis_pins_the_line(jkr):
    law = Hysteresis(advancing=0.03, receding=0.05)
    line = jkr.line(law, 50e-6)
    assert energy_release_rate(line.state) == pytest.approx(0.03, rel=1e-12)
    loaded = line.impose("load", 1e-3)
    assert energy_release_rate(loaded) == pytest.approx(0.03, rel=1e-9)
    pinned = line.impose("load", 0.8e-3)
    assert pinned.contact_radius == loaded.contact_radius
    assert 0.03 < energy_release_rate(pinned) < 0.05
    receding = line.impose("load", 0.0)
    assert energy_release_rate(receding) == pytest.approx(0.05, rel=1e-9)
    assert receding.contact_radius < loaded.contact_radius


def test_a_moving_line_obeys_its_law(jkr):
    """The speed of the radius, by differences, is that at which the law has the G of the state."""
    law = RateDependent(slow=0.04, v0=1e-6, n=0.6)
    line = jkr.line(law, 60e-6)
    loading = line.ramp("load", 1e-3, duration=10.0, tolerance=1e-8)
    assert loading.load[-1] == pytest.approx(1e-3, rel=1e-9)
    assert loading.time[-1] == 10.0
    assert line.state is not None
    unloading = line.ramp("load", -1e-3, duration=20.0, tolerance=1e-8)
    assert line.state is None
    # States of a jump may have one time.
    time, rises = np.unique(unloading.time, return_index=True)
    assert len(time) > 0.5 * len(unloading.time)
    assert np.all(np.diff(unloading.time) >= 0)
    speed = -np.gradient(unloading.contact_radius[rises], time)
    # Not the last states, between which the speed grows by orders of magnitude.
    energy = unloading.energy_release_rate[rises]
    middle = np.flatnonzero((speed > 1e-7) & (energy < 1))
    assert len(middle) > 50
    expected = [law.energy_release_rate(v) for v in speed[middle]]
    assert energy[middle] == pytest.approx(expected, rel=2e-2)
    states = zip(unloading.contact_radius, unloading.load, strict=True)
    hertz = [
        (4 * MODULUS * a**3 / (3 * RADIUS) - f) ** 2 / (8 * pi * MODULUS * a**3) for a, f in states
    ]
    assert unloading.energy_release_rate == pytest.approx(hertz, rel=1e-9)
    # Faster than 1.5 pi w R.
    assert unloading.load[-1] < -1.5 * pi * 0.04 * RADIUS


def test_a_line_is_pickled_with_its_state(jkr):
    line = jkr.line(Hysteresis(advancing=0.03, receding=0.05), 50e-6)
    line.impose("load", 1e-3)
    again = pickle.loads(pickle.dumps(line))
    assert again.state == line.state
    assert again.impose("load", 0.0) == line.impose("load", 0.0)


def test_lines_on_a_film(contact):
    line = contact.line(0.04, 65e-6)
    state = line.impose("load", 3e-4)
    assert state.load == pytest.approx(3e-4, rel=1e-12)
    assert contact.load(state.contact_radius, 0.04) == pytest.approx(3e-4, rel=1e-9)


def test_what_a_line_cannot_do(jkr):
    with pytest.raises(InputError, match="receding energy"):
        Hysteresis(advancing=0.05, receding=0.03)
    with pytest.raises(InputError, match="exponent n"):
        RateDependent(slow=0.04, v0=1e-6, n=0.0)
    line = jkr.line(0.04, 50e-6)
    before = line.state
    with pytest.raises(InputError, match="speed of the crack-tip law"):
        line.ramp("load", 1e-3, duration=1.0)
    with pytest.raises(InputError, match="duration"):
        jkr.line(RateDependent(slow=0.04, v0=1e-6, n=0.6), 5e-5).ramp("load", 0.0, duration=0.0)
    with pytest.raises(ContactError):
        line.impose("load", np.nan)
    assert line.state == before
    with pytest.raises(InputError):
        jkr.line(0.04, 1.0)
    with pytest.raises(TypeError, match="law"):
        jkr.line("0.04", 5e-5)


def test_validity_in_closed_form(contact, jkr):
    a = np.array([1e-6, 65e-6, 2e-4])
    validity = contact.validity(a)
    assert np.allclose(validity.a_over_r, a / 1e-3, rtol=1e-15)
    assert np.allclose(validity.a_over_t, a / 1e-5, rtol=1e-15)
    assert validity.compressibility.tolist() == [0.0, 0.0, 0.0]  # nu1 = 0.5
    assert validity.is_confined.tolist() == [False, True, True]
    assert validity.is_large_contact.tolist() == [False, False, True]
    assert validity.in_range.all()
    assert contact.validity(1e-9).in_range is False
    on_half_space = jkr.validity(65e-6)
    assert (on_half_space.a_over_t, on_half_space.is_confined) == (None, None)
    assert on_half_space.a_over_r == pytest.approx(0.065)
    with pytest.raises(InputError):
        contact.validity(1.0)
    assert np.isnan(contact.validity([1.0], errors="nan").a_over_r).all()


def test_compressibility(contact):
    from conftest import make_system

    soft = contact.table.contact(make_system(film_poisson_ratio=0.49))
    expected = 3 / 16 * 0.02 / 0.51 * 6.5**2
    assert soft.validity(65e-6).compressibility == pytest.approx(expected, rel=1e-12)


def test_the_range_of_the_attraction(jkr):
    """Tabor (R w^2/(E*^2 z0^3))^(1/3); zone (pi/4) E* z0^2/w."""
    w, z0 = 0.04, 1e-9
    found = jkr.zone_size(w, interaction_range=z0)
    assert found.tabor == pytest.approx(
        (RADIUS * w**2 / (MODULUS**2 * z0**3)) ** (1 / 3), rel=1e-12
    )
    assert found.cohesive_zone == pytest.approx(pi / 4 * MODULUS * z0**2 / w, rel=1e-12)
    assert found.is_jkr
    assert found.is_short_beside(1e-6)
    assert jkr.zone_size([w, 1e-9], interaction_range=1e-6).is_jkr.tolist() == [False, False]
    with pytest.raises(InputError, match="work of adhesion"):
        jkr.zone_size(0.0)
