"""Tables of one stack of layers: direct solves, one film cut into layers, files, and refusals."""

import pickle
import subprocess
from dataclasses import replace

import numpy as np
import pytest

import coated_contact as cc
from conftest import ROOT, make_system, refuses

RANGES = {"a_over_t": {"from": 0.05, "to": 20}, "e1_over_e2": {"from": 0.1, "to": 10}}


def scene(stack, tolerance=1e-5):
    return {"title": "A stack", "tolerance": tolerance, **RANGES, "stack": stack}


@pytest.fixture(scope="module")
def table(stack):
    return cc.generate(scene(stack), progress=False)


def on(stack, sphere_modulus=2e6):
    return cc.StackSystem(stack=stack, sphere_radius=1e-3, sphere_modulus=sphere_modulus)


def test_a_table_has_its_stack(table, stack):
    assert table.stack == stack
    assert [layer.name for layer in table.stack.layers] == ["primer", "elastomer"]
    assert cc.Table.embedded().stack is None
    assert list(table.axes) == ["a_over_t", "e1_over_e2", "nu1", "e0_over_e1"]
    again = pickle.loads(pickle.dumps(table))
    assert (again, again.stack) == (table, stack)
    nameless = [replace(layer, name=None) for layer in stack.layers]
    table.contact(on(replace(stack, layers=nameless)))


def test_a_contact_answers_what_a_solved_one_does(table, stack):
    contact = table.contact(on(stack))
    solved = stack.contact(sphere_radius=1e-3, sphere_modulus=2e6, a_over_t=(0.05, 20))
    assert contact.validity(65e-6).compressibility == stack.compressibility * 6.5**2
    found, expected = (
        contact.cohesive_zone(0.04, stress=1e8),
        solved.cohesive_zone(0.04, stress=1e8),
    )
    assert found.zone == expected.zone
    assert found.pull_off().load == pytest.approx(expected.pull_off().load, rel=1e-4)
    assert pickle.loads(pickle.dumps(contact)) == contact
    assert "primer" in contact._repr_html_()
    punch = table.contact(
        cc.StackSystem(stack=stack, probe=cc.FlatPunch(radius=2e-5), sphere_modulus=2e6)
    )
    assert punch.stiffness(2e-5) == contact.stiffness(2e-5)
    refuses(cc.InputError, "no derivatives", lambda: contact.gradient(65e-6, 0.04))


def test_files_of_both_forms_hold_one_table(tmp_path, program, stack):
    scene_file, hdf5 = tmp_path / "scene.toml", tmp_path / "stack.h5"
    text = (ROOT / "tables" / "stacks" / "primer-scene.toml").read_text()
    scene_file.write_text(text.replace("1e-7", "1e-4"))
    command = [program, "generate", scene_file, "-o", hdf5]
    subprocess.run(command, check=True, capture_output=True)
    opened = cc.Table.open(hdf5)
    assert opened.stack == stack
    packed = tmp_path / "stack.bin"
    made = cc.generate(scene_file, packed, progress=False)
    assert cc.Table.read(packed) == made
    a = np.geomspace(1e-6, 5e-4, 20)
    numbers = [one.contact(on(stack)).load(a, 0.04) for one in (opened, made)]
    assert np.allclose(*numbers, rtol=1e-13, atol=0)


def test_other_bodies_are_refused(table, stack):
    refuses(cc.OutsideTableError, "of one stack of layers", lambda: table.contact(make_system()))
    other = replace(stack, layers=stack.layers[:1])
    refuses(cc.OutsideTableError, "of another stack", lambda: table.contact(on(other)))


def test_scenes_that_cannot_be_used_are_named(stack):
    wrong = {**scene(stack), "nu1": 0.3}
    refuses(cc.TableError, "nu1 does not go with", lambda: cc.generate(wrong, progress=False))
    rigid = cc.Elastic(young_modulus=float("inf"), poisson_ratio=0.3)
    on_rigid = scene(replace(stack, base=rigid), 1e-2)
    assert cc.generate(on_rigid, progress=False).stack.base.young_modulus == float("inf")
    surface = replace(stack, surface=stack.layers[0].material)
    refuses(
        cc.InputError, "surface of its own", lambda: cc.generate(scene(surface), progress=False)
    )
