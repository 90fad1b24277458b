"""Contact lines: adhesion hysteresis and rates, against JKR; validity in closed form."""

import pickle
from dataclasses import replace
from math import pi

import numpy as np
import pytest

import coated_contact as cc
from conftest import make_system, refuses

RADIUS, MODULUS = 1e-3, 2e6
RIGID = cc.Elastic(young_modulus=np.inf, poisson_ratio=0.3)


@pytest.fixture(scope="module")
def jkr():
    return cc.Contact.half_space(
        cc.HalfSpace(sphere_radius=RADIUS, sphere_modulus=MODULUS, solid=RIGID)
    )


def energy_release_rate(state):
    """G = (4 E* a^3/(3 R) - F)^2 / (8 pi E* a^3)."""
    a = state.contact_radius
    hertz = 4 * MODULUS * a**3 / (3 * RADIUS)
    return (hertz - state.load) ** 2 / (8 * pi * MODULUS * a**3)


@pytest.mark.parametrize("control", ["load", "displacement", cc.Spring(stiffness=100.0)])
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


def test_measured_contacts_tell_their_energy_release_rate(jkr):
    a, load = np.array([3e-5, 6e-5, 9e-5]), np.array([-2e-4, 0.0, 3e-4])
    hertz = 4 * MODULUS * a**3 / (3 * RADIUS)
    expected = np.sign(hertz - load) * (hertz - load) ** 2 / (8 * pi * MODULUS * a**3)
    assert jkr.energy_release_rate(a, load=load) == pytest.approx(expected, rel=1e-12)
    contact = cc.Table.embedded().contact(make_system())
    for w in (1e-3, 0.04):
        loads, depths = contact.load_and_penetration(a, w)
        for known in ({"load": loads}, {"penetration": depths}):
            assert contact.energy_release_rate(a, **known) == pytest.approx(w, rel=1e-9)
    assert np.isnan(jkr.energy_release_rate([-1.0, 3e-5], load=0.0, errors="nan"))[0]
    refuses(TypeError, "load or penetration", lambda: jkr.energy_release_rate(a))
    both = {"load": 0.0, "penetration": 0.0}
    refuses(TypeError, "load or penetration", lambda: jkr.energy_release_rate(a, **both))


def test_hysteresis_pins_the_line(jkr):
    law = cc.Hysteresis(advancing=0.03, receding=0.05)
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


def test_a_line_is_pickled_with_its_state(jkr):
    line = jkr.line(cc.Hysteresis(advancing=0.03, receding=0.05), 50e-6)
    line.impose("load", 1e-3)
    again = pickle.loads(pickle.dumps(line))
    assert again.state == line.state
    assert again.impose("load", 0.0) == line.impose("load", 0.0)


def test_what_a_line_cannot_do(jkr):
    refuses(cc.InputError, "receding energy", lambda: cc.Hysteresis(advancing=0.05, receding=0.03))
    refuses(cc.InputError, "exponent n", lambda: cc.RateDependent(slow=0.04, v0=1e-6, n=0.0))
    line = jkr.line(0.04, 50e-6)
    before = line.state
    refuses(
        cc.InputError, "speed of the crack-tip law", lambda: line.ramp("load", 1e-3, duration=1.0)
    )
    with pytest.raises(cc.ContactError):
        line.impose("load", np.nan)
    assert line.state == before
    with pytest.raises(cc.InputError):
        jkr.line(0.04, 1.0)
    refuses(TypeError, "law", lambda: jkr.line("0.04", 5e-5))


def test_the_law_of_a_line_is_found_from_radii_in_time():
    system = make_system(film_thickness=3e-5)
    law = cc.RateDependent(slow=0.04, v0=1e-6, n=0.6)
    contact = cc.Table.embedded().contact(system)
    line = contact.line(law, 65e-6)
    read, begin = [], 0.0
    for load, duration, count in ((4e-3, 100.0, 40), (-2e-3, 150.0, 60)):
        states = line.ramp("load", load, duration=duration, tolerance=1e-8)
        if load > 0.0:  # the other ramp detaches
            assert (states.time[-1], states.load[-1]) == (duration, pytest.approx(load, rel=1e-9))
        own = contact.energy_release_rate(states.contact_radius, load=states.load)
        assert states.energy_release_rate == pytest.approx(own, rel=1e-9)
        times = np.linspace(0.0, states.time[-1], count + 2)[1:-1]
        values = [np.interp(times, states.time, y) for y in (states.contact_radius, states.load)]
        read.append([begin + times, *values, np.full(count, load < 0)])
        begin += states.time[-1]
    time, radius, load, retract = (np.concatenate(part) for part in zip(*read, strict=True))
    measured = cc.Experiment(
        kind="load-radius",
        abscissa=radius,
        ordinate=load,
        retract=retract.astype(bool),
        time=time,
        system=system,
        work_of_adhesion=0.04,
    )
    free = ["sphere_modulus", "work_of_adhesion", "doubling_speed", "speed_exponent"]
    found = cc.fit(measured, free)
    values = [found.params[name] for name in free]
    assert values == pytest.approx([system.sphere_modulus, 0.04, law.v0, law.n], rel=0.01)
    points = found.experiments[0]
    assert points.left_out == {"unknown-speed": 12}
    fast = np.abs(points.line_speed) > 1e-8
    expected = [law.energy_release_rate(speed) for speed in points.line_speed[fast]]
    assert points.energy_release_rate[fast] == pytest.approx(expected, rel=0.05)
    assert np.isnan(points.line_speed).sum() == 12
    assert points.line_speed[3] < 0.0 < points.line_speed[-4]
    untimed = replace(measured, time=None)
    refuses(cc.FitError, "no times.*Experiment.time", lambda: cc.fit(untimed, free))
    half = replace(measured, doubling_speed=1e-6)
    refuses(cc.FitError, "speed_exponent.*is not given", lambda: cc.fit(half, free[:2]))
    planned = replace(measured, noise=1e-6)
    refuses(cc.FitError, "doubling_speed.*at the planned value", lambda: cc.forecast(planned, free))


def test_validity_in_closed_form(contact, jkr):
    a = np.array([1e-6, 65e-6, 2e-4])
    soft = contact.table.contact(make_system(film_poisson_ratio=0.49)).validity(a)
    expected = 3 / 16 * 0.02 / 0.51 * (a / 1e-5) ** 2
    assert soft.compressibility == pytest.approx(expected, rel=1e-12)
    assert soft.is_confined.tolist() == [False, True, False]
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
    expected = 0.1 * pi / 6 * MODULUS * 65e-6
    assert on_half_space.surface_tension == pytest.approx(expected, rel=1e-9)
    with pytest.raises(cc.InputError):
        contact.validity(1.0)
    assert np.isnan(contact.validity([1.0], errors="nan").a_over_r).all()


def test_the_range_of_the_attraction(jkr):
    """Tabor (R w^2/(E*^2 z0^3))^(1/3); zone (pi/4) E* z0^2/w."""
    w, z0 = 0.04, 1e-9
    found = jkr.zone_size(w, interaction_range=z0)
    assert found.tabor == pytest.approx(
        (RADIUS * w**2 / (MODULUS**2 * z0**3)) ** (1 / 3), rel=1e-12
    )
    assert found.cohesive_zone == pytest.approx(pi / 4 * MODULUS * z0**2 / w, rel=1e-12)
    assert found.is_jkr
    assert found.is_short_beside(10.001 * found.cohesive_zone)
    assert not found.is_short_beside(9.999 * found.cohesive_zone)
    assert jkr.zone_size([w, 1e-9], interaction_range=1e-6).is_jkr.tolist() == [False, False]
    refuses(cc.InputError, "work of adhesion", lambda: jkr.zone_size(0.0))
