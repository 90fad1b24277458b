"""Layers that slide or are joined by springs: an independent value, files, refusals."""

import pickle
from dataclasses import replace
from math import inf, isnan

import pytest

import coated_contact as cc
from conftest import refuses, rows

RUBBER = cc.Elastic(young_modulus=3.5e6, poisson_ratio=0.5)
SILICON = cc.Elastic(young_modulus=2e11, poisson_ratio=0.25)


def film(interface, **changes):
    """A film of rubber on silicon, named for fits."""
    layer = cc.Layer(material=RUBBER, thickness=1e-5, name="film", interface=interface)
    return cc.Stack(base=SILICON, layers=[replace(layer, **changes)])


def test_a_solve_agrees_with_independent_values():
    row = next(row for row in rows("interfaces_contacts") if row["name"] == "springs_rigid")
    assert (row["layers"], row["interfaces"]) == ("0.2:0.4:1.0", "0.05:0.5")
    springs = cc.Springs(tangential_stiffness=0.05, normal_stiffness=0.5)
    soft = cc.Elastic(young_modulus=0.2, poisson_ratio=0.4)
    stack = cc.Stack(
        base=cc.Elastic(young_modulus=inf, poisson_ratio=0.25),
        layers=[cc.Layer(material=soft, thickness=1.0, interface=springs)],
    )
    solution = cc.solve_stack(float(row["a_over_t"]), stack, 1.0, 1e-12)
    for name in ("pi0", "eeq", "gamma", "delta0"):
        assert getattr(solution, name) == pytest.approx(float(row[name]), rel=1e-12)


def test_the_ends_of_the_springs_are_bonded_and_sliding():
    springs = cc.Springs(tangential_stiffness=0.0)
    assert springs.normal_stiffness == inf
    for ends, word in [(springs, "sliding"), (cc.Springs(tangential_stiffness=inf), "bonded")]:
        assert film(ends) == film(word)
        of_ends, of_word = (cc.solve_stack(3.0, film(one), 2e6) for one in (ends, word))
        assert (of_ends.pi0, of_ends.gamma) == (of_word.pi0, of_word.gamma)
    assert film("bonded") == film("bonded") != film("sliding")
    stiff = cc.solve_stack(3.0, film("bonded"), 2e6).eeq
    assert cc.solve_stack(3.0, film("sliding"), 2e6).eeq < 0.99 * stiff
    assert isnan(film("sliding").compressibility)
    again = pickle.loads(pickle.dumps(film(springs)))
    assert again == film(springs)


def test_files_and_tables_hold_the_interface(tmp_path):
    path = tmp_path / "film.toml"
    text = (
        "base = { young_modulus = 2e11, poisson_ratio = 0.25 }\n[[layers]]\nname = 'film'\n"
        "young_modulus = 3.5e6\npoisson_ratio = 0.5\nthickness = 1e-5\ninterface = "
    )
    both = "{ tangential_stiffness = 2e11, normal_stiffness = 3e12 }"
    springs = cc.Springs(tangential_stiffness=2e11, normal_stiffness=3e12)
    for written, expected in [('"sliding"', "sliding"), ('"bonded"', "bonded"), (both, springs)]:
        path.write_text(text + written)
        assert cc.Stack.read(path) == film(expected)
    scene = {
        "title": "A film on springs",
        "tolerance": 1e-3,
        "a_over_t": {"from": 0.1, "to": 10},
        "e1_over_e2": 1.75,
        "stack": film(springs),
    }
    table = cc.generate(scene)
    assert table.stack == film(springs)
    known = {"sphere_radius": 1e-3, "sphere_modulus": 2e6}
    found = table.contact(cc.StackSystem(stack=film(springs), **known)).load(5e-5, 0.04)
    solved = film(springs).contact(**known, a_over_t=(0.1, 10)).load(5e-5, 0.04)
    assert found == pytest.approx(solved, rel=1e-2)


def test_what_is_no_interface_is_refused():
    refuses(cc.InputError, "slippery.*bonded.*sliding", lambda: film("slippery"))
    wrong = cc.Springs(tangential_stiffness=1.0, normal_stiffness=-2.0)
    refuses(cc.InputError, r"normal.*-2\.0", lambda: film(wrong))
