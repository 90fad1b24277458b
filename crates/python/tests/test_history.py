"""Contacts in time where the bodies relax."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import coated_contact as cc
from conftest import refuses

SOLID = cc.Elastic(young_modulus=0.75, poisson_ratio=0.5)  # E* = 1
SYSTEM = cc.HalfSpace(sphere_radius=1.0, sphere_modulus=math.inf, solid=SOLID)
CONTACT = cc.Contact.half_space(SYSTEM)
LAW = cc.Relaxation.prony(0.3, 0.6)
PROGRAM = ([0.0, 1.0, 2.0], [0.0, 1e-2, 0.0])


def test_laws_have_their_closed_forms() -> None:
    t = np.array([0.0, 0.1, 3.0])
    assert LAW.modulus(t) == pytest.approx(0.3 + 0.7 * np.exp(-t / 0.6), rel=1e-14)
    assert LAW.creep(t) == pytest.approx(1 / 0.3 - (1 / 0.3 - 1) * np.exp(-0.5 * t), rel=1e-12)
    power = cc.Relaxation.power_law(0.3, time=2.0)
    assert power.modulus(5.0) == pytest.approx(2.5**-0.3, rel=1e-14)
    storage, loss = power.complex(np.array([1.0, 7.0]))
    assert loss / storage == pytest.approx(math.tan(0.15 * math.pi), rel=1e-13)
    half = cc.Relaxation.fractional_zener(0.0, 0.5, 1.0)
    assert half.modulus(1.0) == pytest.approx(math.e * math.erfc(1.0), rel=1e-11)
    late = cc.Relaxation.modified_power_law(0.1, 0.5, 2.0)
    assert late.modulus(6.0) == pytest.approx(0.1 + 0.9 * 0.5, rel=1e-14)


def test_times_are_answered_in_the_order_they_are_asked_in() -> None:
    out = CONTACT.history(
        PROGRAM[0], cc.Relaxation.power_law(0.2), penetration=PROGRAM[1], at=[2.0, 1.0, 1.5]
    )
    assert list(out.phase) == ["separated", "advancing", "receding"]
    assert out.time.tolist() == [2.0, 1.0, 1.5]
    assert out.load[0] == 0.0 == out.contact_radius[0]
    assert out.contact_radius[1] == pytest.approx(0.1, rel=1e-8)
    assert out.error <= 1e-8
    assert list(out.to_pandas()["phase"]) == list(out.phase)
    assert list(out.to_xarray()["phase"].values) == list(out.phase)
    assert out.to_xarray()["load"].attrs["units"] == "N"


def test_load_and_height() -> None:
    crept = CONTACT.history([0, 0.5], LAW, load=[0, 1e-4], at=[0.5, 5.0])
    assert crept.load == pytest.approx([1e-4, 1e-4])
    assert crept.penetration[1] > crept.penetration[0]
    fixed = CONTACT.history(PROGRAM[0], LAW, penetration=PROGRAM[1], at=[0.5, 1.2])
    stiff = CONTACT.history(PROGRAM[0], LAW, height=PROGRAM[1], stiffness=1e7, at=[0.5, 1.2])
    assert stiff.load == pytest.approx(fixed.load, rel=1e-4)


def test_adhesion_of_the_receding_line() -> None:
    times = np.linspace(0, 2, 41)
    out = CONTACT.history(PROGRAM[0], LAW, penetration=PROGRAM[1], at=times, receding=1e-5)
    assert out.load.min() < 0
    assert (out.load[times <= 1] >= 0).all()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"penetration": None}, "one of penetration, load and height"),
        ({"stiffness": 1.0}, "stiffness and height"),
        ({"penetration": [0, 1e-2]}, "one length"),
        ({"penetration": [1e-3, 1e-2, 0]}, "begins in contact"),
        ({"time": [0, 1, 1]}, "rise"),
        ({"at": [-1.0]}, "begins at"),
        ({"at": [[0.5], [1.5]]}, r"a row of times, and has the shape \(2, 1\)"),
        ({"tolerance": 1e-20}, "1e-10"),
        ({"receding": -1e-5}, "receding = -1e-05 cannot be used: it must be 0, or"),
    ],
)
def test_mistakes(change: dict[str, object], words: str) -> None:
    arguments = {"time": PROGRAM[0], "penetration": PROGRAM[1], **change}
    refuses(cc.InputError, words, lambda: CONTACT.history(relaxation=LAW, **arguments))


@pytest.mark.parametrize("wrong", [-1.0, math.nan])
@pytest.mark.parametrize("name", ["modulus", "creep", "complex"])
def test_an_error_of_a_law_has_the_place(name: str, wrong: float) -> None:
    values, words = getattr(LAW, name), "time|omega"
    error = refuses(cc.InputError, words, lambda: values([[1.0, 2.0], [wrong, 3.0]]))
    assert error.index == (1, 0)
    assert refuses(cc.InputError, words, lambda: values(wrong)).index is None


def test_laws_of_no_solid() -> None:
    refuses(cc.InputError, "sum", lambda: cc.Relaxation.prony(0.3, [1.0, 2.0], [0.3, 0.3]))
    refuses(cc.InputError, "weights", lambda: cc.Relaxation.prony(0.3, [1.0, 2.0]))
    power = cc.Relaxation.power_law(0.2)
    refuses(cc.InputError, "relaxed = 0.3 has no effect", lambda: replace(power, relaxed=0.3))
    refuses(cc.InputError, "exponent = 0.5 has no effect", lambda: replace(LAW, exponent=0.5))
    refuses(cc.InputError, "1 weights for 2 times", lambda: replace(LAW, times=(1.0, 2.0)))
    refuses(cc.InputError, "one time and no weights", lambda: replace(power, weights=(0.3,)))
    refuses(cc.InputError, "law = 'sls' cannot be used", lambda: replace(LAW, law="sls"))
    with pytest.raises(TypeError, match="Relaxation"):
        CONTACT.history(*PROGRAM[:1], "sls", penetration=PROGRAM[1])  # type: ignore[arg-type]
