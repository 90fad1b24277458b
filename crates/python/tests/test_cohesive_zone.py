"""The correction for an attraction of short range: the full solution, JKR, and what is refused."""

import pickle
from math import inf, pi

import numpy as np
import pytest

import coated_contact as cc
from conftest import make_system, refuses

W = 0.05


@pytest.fixture(scope="module")
def contact():
    """A hard sphere of 10 um on a film of 1 um."""
    system = make_system(sphere_radius=1e-5, sphere_modulus=7.5e10, film_thickness=1e-6)
    return cc.Table.embedded().contact(system)


@pytest.fixture(scope="module")
def gel():
    """A rigid sphere of 1 um on a half-space."""
    solid = cc.Elastic(young_modulus=1e7, poisson_ratio=0.5)
    return cc.Contact.half_space(cc.HalfSpace(sphere_radius=1e-6, sphere_modulus=inf, solid=solid))


def test_a_state_is_that_of_jkr_at_the_tip_of_the_crack(contact):
    corrected = contact.cohesive_zone(W, stress=1e8)
    modulus = 1 / (1 / 7.5e10 + 0.75 / 3.5e6)
    assert corrected.zone == pytest.approx(pi * modulus * W / (4 * 1e8**2), rel=1e-12)
    a = np.array([[2e-6, 3e-6, 4e-6]])
    states = corrected.state(a)
    tip = a + 2 / 3 * corrected.zone
    energy = W * (1 + corrected.zone / (6 * tip))
    assert states.load == pytest.approx(contact.load(tip, energy), rel=1e-12)
    assert states.penetration == pytest.approx(contact.penetration(tip, energy), rel=1e-12)
    assert np.array_equal(states.outer_radius, a + corrected.zone)
    assert states.load.shape == (1, 3)
    assert corrected.state(3e-6) == list(states)[1]


CONTROLS = {
    "load": lambda state: state.load,
    "displacement": lambda state: state.penetration,
    cc.Spring(stiffness=10.0): lambda state: state.penetration + state.load / 10.0,
}


@pytest.mark.parametrize("name", ["contact", "gel"])
def test_equilibria_end_at_the_pull_off(name, request):
    contact = request.getfixturevalue(name)
    corrected = contact.cohesive_zone(W, stress=1e8)
    for control, imposed_at in CONTROLS.items():
        pulled = corrected.pull_off(control=control)
        imposed = imposed_at(pulled)
        step = 1e-6 * abs(imposed)
        unstable, stable = corrected.equilibria(imposed + step, control=control)
        assert (unstable.stable, stable.stable) == (False, True)
        assert unstable.state.contact_radius < pulled.contact_radius
        assert pulled.contact_radius < stable.state.contact_radius
        assert corrected.equilibria(imposed - step, control=control) == []
    # Under a high stress the state is that of JKR.
    jkr = contact.pull_off(W)
    short = contact.cohesive_zone(W, stress=1e12).pull_off()
    assert (short.load, short.contact_radius) == pytest.approx(
        (jkr.load, jkr.contact_radius), rel=1e-6
    )


def test_the_error_of_jkr_on_a_half_space(gel):
    """Maugis' equations expanded about JKR: 0.1092/lambda^2, lambda = 2 s (R/(pi w K^2))^(1/3)."""
    attraction = gel.zone_size(W, interaction_range=[1e-9, 2e-9, 1e-7], errors="nan")
    lam = 2 * W / np.array([1e-9, 2e-9]) * (1e-6 / (pi * W * (16e7 / 9) ** 2)) ** (1 / 3)
    error = attraction.pull_off_error()
    assert error[:2] == pytest.approx(0.1092 / lam**2, rel=1e-3)
    assert np.isnan(error[2])
    again = pickle.loads(pickle.dumps(attraction))
    assert np.array_equal(again.pull_off_error(), error, equal_nan=True)
    with pytest.raises(cc.InputError) as caught:
        attraction.pull_off_error(errors="raise")
    assert caught.value.index == (2,)
    strict = gel.zone_size(W, interaction_range=[1e-9, 2e-9, 1e-7])
    assert np.isnan(strict.pull_off_error(errors="nan")).tolist() == [False, False, True]
    with pytest.raises(cc.InputError):
        strict.pull_off_error()


def test_what_is_not_short_is_named(contact, gel):
    with pytest.raises(cc.InputError, match=r"more than 0\.25 times the thickness of") as caught:
        contact.cohesive_zone(W, stress=5e5)
    error = caught.value
    assert (error.axis, error.range) == ("zone", (0.0, 0.25e-6))
    assert error.value > 0.25e-6
    corrected = contact.cohesive_zone(W, stress=2e6)
    least = corrected.zone / cc.ShortZone.LONGEST
    corrected.state(least * 1.001)
    error = refuses(cc.InputError, "contact radius", lambda: corrected.state([2e-6, least * 0.999]))
    assert error.index == (1,)
    assert np.isnan(corrected.state([2e-6, least / 2], errors="nan").load).tolist() == [False, True]
    with pytest.raises(cc.NoContactError):
        corrected.equilibria(1.0)
    refuses(cc.ContactError, "control", lambda: corrected.pull_off(control="weight"))
    refuses(TypeError, "positional", lambda: contact.cohesive_zone(W, 1e8))
