"""Messages are in the words of this package: no names of Rust, no flags of the program."""

import re
from dataclasses import replace

import numpy as np
import pytest

import coated_contact as cc
from conftest import ROOT, RUBBER_ON_GLASS, in_python, make_system, refuses
from test_fit import WANTED, lens

PACKED, HDF5 = ROOT / "tables" / "paper.bin", ROOT / "tables" / "paper.h5"


def rigid(system):
    return replace(system, sphere_modulus=np.inf)


def of_substrate(poisson_ratio):
    """A system on a substrate of another Poisson ratio than that of the table."""
    glass = cc.Elastic(young_modulus=2e11, poisson_ratio=poisson_ratio)
    return replace(make_system(), substrate=glass)


def bare(**probe):
    solid = cc.Elastic(young_modulus=1e6, poisson_ratio=0.5)
    return cc.Contact.half_space(cc.HalfSpace(sphere_modulus=2e6, solid=solid, **probe))


def on(stack, **probe):
    return stack.contact(sphere_modulus=2e6, a_over_t=(0.1, 2), **probe)


def at_end(seed):
    """A lens with a load that is no number."""
    one = lens(seed=seed)
    load = one.ordinate.copy()
    load[3] = np.inf
    return replace(one, ordinate=load)


CASES = {
    "an HDF5 table": (lambda _: cc.Table.read(HDF5), "`Table.open`"),
    "a packed table": (lambda _: cc.Table.open(PACKED), "`Table.read`"),
    "no table": (lambda _: cc.Table.read(ROOT / "README.md"), "packed table"),
    "bytes of HDF5": (lambda _: cc.Table.from_packed(HDF5.read_bytes()), "`Table.open`"),
    "a cone on a stack": (
        lambda stack: on(stack, probe=cc.Cone(half_angle=1.2)),
        "begin it at a smaller a_over_t, and extend it to four times that",
    ),
    "a material outside": (
        lambda _: cc.Table.read(PACKED).contact(make_system(film_modulus=1e12)),
        "`generate`",
    ),
    "an a/t outside": (
        lambda _: cc.SolvedCurve(a_over_t=(0.1, 2)).contact(make_system()).load(9e-5, 0.04),
        "`solve`",
    ),
    "an a/t far beyond": (
        lambda _: cc.Table.embedded().quantities(1e5, 1e6, 0.3, 1e-3),
        "`generate`",
    ),
    "no equivalent": (lambda _: cc.Table.read(PACKED).contact(of_substrate(0.1)), "`generate`"),
    "a rigid sphere": (
        lambda _: cc.Table.read(PACKED).contact(rigid(make_system())),
        "`Table.embedded`",
    ),
    "a stack in a table of films": (
        lambda stack: cc.Table.embedded().contact(
            cc.StackSystem(stack=stack, sphere_radius=1e-4, sphere_modulus=2e6)
        ),
        "`generate`",
    ),
    "the line of a flat punch": (
        lambda _: bare(probe=cc.FlatPunch(radius=1e-6)).line(0.04, 1e-6),
        "`Contact.pull_off`",
    ),
    "a motion without a speed": (
        lambda _: bare(sphere_radius=1e-3).line(0.04, 6e-5).ramp("load", 1e-3, duration=1.0),
        "`ContactLine.impose`",
    ),
    "a zone that is long": (
        lambda _: bare(sphere_radius=1e-6).cohesive_zone(0.04, stress=1e3),
        "`Cohesive`",
    ),
    "a stack without layers": (
        lambda stack: cc.Stack(base=stack.base, layers=[]),
        "`HalfSpace`",
    ),
    "a point that is no number": (lambda _: cc.fit(at_end(1), WANTED), "experiment, point 3: load"),
    "a curve of a map": (lambda _: cc.fit_map([lens(seed=1), at_end(2)], WANTED), "point 3"),
    "a layer of a film": (
        lambda _: cc.fit(replace(lens(seed=1), system=make_system()), ["primer.modulus"]),
        "no stack of layers",
    ),
    "a tolerance out of reach": (
        lambda _: cc.solve(1.0, 1.75, 0.5, 1e5, tolerance=1e-20),
        "tolerance",
    ),
    "a scene without a range": (
        lambda _: cc.generate(
            RUBBER_ON_GLASS | {"a_over_t": {"from": 10, "to": 1}}, progress=False
        ),
        "a_over_t",
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_every_message_is_in_the_words_of_python(case, stack):
    provoke, word = CASES[case]
    error = refuses((cc.ContactError, OSError), re.escape(word), lambda: provoke(stack))
    in_python(getattr(error, "allowed", None) or "")


def test_points_far_off_are_called_by_their_numbers():
    one = lens(seed=1, noise=2e-6)
    load = one.ordinate.copy()
    load[[4, 20]] += 3e-5
    found = cc.fit(replace(one, ordinate=load, noise=2e-6), WANTED, loss="huber")
    (words,) = [warning.text for warning in found.warnings if warning.kind == "outliers"]
    assert "in points 4, 20" in words
    for text in (words, found.report):
        in_python(text)


def test_the_words_of_a_user_stay(tmp_path):
    """A name is shown as it was given, whatever it looks like."""
    name = "a::b --c"
    with pytest.raises(cc.ContactError, match=re.escape(name)):
        cc.fit(replace(at_end(1), name=name), WANTED)
    with pytest.raises(OSError, match=re.escape(name)):
        cc.Table.read(tmp_path / name)
