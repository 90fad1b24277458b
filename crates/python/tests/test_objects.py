"""Frozen, hashable, picklable objects; tables and their files."""

import copy
import dataclasses
import errno
import os
import pickle
from dataclasses import replace

import numpy as np
import pytest

import coated_contact as cc
from coated_contact import __version__
from conftest import PROBES, ROOT, make_system, refuses

PACKED, HDF5 = ROOT / "tables" / "paper.bin", ROOT / "tables" / "paper.h5"


@pytest.fixture(scope="module")
def objects(system, contact, stack):
    solid = cc.Elastic(young_modulus=1e6, poisson_ratio=0.3)
    half_space = cc.HalfSpace(sphere_radius=1e-3, sphere_modulus=np.inf, solid=solid)
    table = cc.Table.read(PACKED)
    return [
        solid,
        system,
        half_space,
        cc.Spring(stiffness=0.5),
        contact,
        cc.Contact.half_space(half_space),
        contact.equilibria(0.04, control=cc.Spring(stiffness=0.5)),
        cc.Table.embedded(),
        table,
        table.contact(make_system()),
        contact.pull_off(0.04),
        *PROBES,
        replace(system, probe=PROBES[1]),
        stack,
        stack.layers[0],
        cc.StackSystem(stack=stack, sphere_radius=1e-4, sphere_modulus=2e6),
        cc.SolvedCurve(a_over_t=(0.1, 2)),
        stack.contact(sphere_radius=1e-4, sphere_modulus=2e6, a_over_t=(0.1, 2)),
        cc.Cohesive(system=system, work_of_adhesion=0.04, interaction_range=1e-8),
        contact.cohesive_zone(0.04, stress=1e8),
        cc.Hysteresis(advancing=0.04, receding=0.1),
        cc.RateDependent(slow=0.04, v0=1e-6, n=0.6),
        cc.Free(parameter="film_modulus", bounds=(1e5, 1e7)),
    ]


def test_objects_are_values(objects):
    for one in objects:
        for other in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one), copy.copy(one)):
            assert other == one
            assert hash(other) == hash(one)
            assert repr(other) == repr(one)
    assert len(set(objects)) == len(objects)


def test_every_object_is_replaced_by_its_own_values(objects):
    for one in filter(dataclasses.is_dataclass, objects):
        assert replace(one) == one
        given = [field.name for field in dataclasses.fields(one) if field.init]
        for name in given:
            assert replace(one, **{name: getattr(one, name)}) == one
        if hasattr(copy, "replace"):
            assert copy.replace(one) == one


def test_the_radius_of_a_system_is_replaced(system, stack):
    solid = cc.Elastic(young_modulus=1e6, poisson_ratio=0.3)
    of = {"sphere_radius": 1e-3, "sphere_modulus": 2e6}
    for one in (system, cc.HalfSpace(solid=solid, **of), cc.StackSystem(stack=stack, **of)):
        smaller = replace(one, sphere_radius=2e-5)
        assert smaller.probe == cc.Paraboloid(radius=2e-5)
        assert replace(smaller, sphere_radius=1e-3) == one
        both = replace(one, sphere_radius=2e-5, sphere_modulus=3e6)
        assert (both.sphere_radius, both.sphere_modulus) == (2e-5, 3e6)
        # The shape stays.
        ball = replace(one, probe=cc.Sphere(radius=1e-3))
        assert replace(ball, sphere_radius=2e-5).probe == cc.Sphere(radius=2e-5)
        with pytest.raises(cc.InputError, match="-1"):
            replace(one, sphere_radius=-1.0)
        with pytest.raises(TypeError, match="the probe is a Cone: replace the probe"):
            replace(replace(one, probe=cc.Cone(half_angle=1.2)), sphere_radius=2e-5)
        with pytest.raises(TypeError, match="both given"):
            replace(one, probe=cc.Sphere(radius=1e-3), sphere_radius=2e-5)
    with pytest.raises(TypeError, match="both given"):
        cc.HalfSpace(probe=cc.Sphere(radius=1e-3), solid=solid, **of)


def test_the_places_of_a_planned_experiment_are_replaced(system):
    plan = cc.Experiment(kind="load-radius", abscissa=np.linspace(4e-5, 9e-5, 10), system=system)
    finer = replace(plan, abscissa=np.linspace(4e-5, 9e-5, 50), noise=1e-6)
    assert finer.ordinate.shape == (50,)
    assert np.isnan(finer.ordinate).all()
    # What was measured is not given up.
    measured = replace(plan, ordinate=np.zeros(10))
    refuses(cc.FitError, "as long", lambda: replace(measured, abscissa=np.linspace(4e-5, 9e-5, 50)))


def test_objects_do_not_change(objects):
    for one in objects:
        # A frozen dataclass with slots raises TypeError for a name that it does not have.
        with pytest.raises((AttributeError, TypeError)):
            one.title = "x"
        for field in dataclasses.fields(one) if dataclasses.is_dataclass(one) else ():
            with pytest.raises(dataclasses.FrozenInstanceError):
                setattr(one, field.name, 1.0)


def test_an_unpickled_contact_gives_the_same_numbers(contact):
    again = pickle.loads(pickle.dumps(contact))
    a = np.linspace(40e-6, 90e-6, 20)
    assert np.array_equal(again.load(a, 0.04), contact.load(a, 0.04))


def test_errors_are_pickled_whole(contact):
    with pytest.raises(cc.ContactError) as caught:
        contact.load([65e-6, 1.0], 0.04)
    error = pickle.loads(pickle.dumps(caught.value))
    assert type(error) is type(caught.value)
    assert str(error) == str(caught.value)
    for name in ("axis", "value", "range", "allowed", "index"):
        assert getattr(error, name) == getattr(caught.value, name)


def test_values_that_cannot_be_are_refused(system):
    with pytest.raises(cc.InputError, match=r"Poisson ratio = 0\.6") as caught:
        cc.Elastic(young_modulus=1e6, poisson_ratio=0.6)
    error = caught.value
    assert (error.axis, error.value, error.allowed) == ("Poisson ratio", 0.6, "in (-1, 0.5]")
    refuses(
        cc.InputError, "film_thickness", lambda: dataclasses.replace(system, film_thickness=0.0)
    )
    refuses(TypeError, "film must be an Elastic", lambda: dataclasses.replace(system, film=1e6))
    with pytest.raises(TypeError, match="young_modulus must be real"):
        cc.Elastic(young_modulus="1e6", poisson_ratio=0.3)
    refuses(TypeError, "one number", lambda: cc.Elastic(young_modulus=[1e6], poisson_ratio=0.3))
    refuses(TypeError, "positional", lambda: cc.Elastic(1e6, 0.3))
    refuses(TypeError, "a contact needs", lambda: cc.Contact(system=system, table=None))


def test_numpy_numbers_become_floats():
    solid = cc.Elastic(young_modulus=np.float32(1e6), poisson_ratio=np.int64(0))
    assert (type(solid.young_modulus), type(solid.poisson_ratio)) == (float, float)
    assert solid == cc.Elastic(young_modulus=1e6, poisson_ratio=0)


def test_controls(contact):
    with pytest.raises(cc.ContactError, match="control = 'weight' cannot be used"):
        contact.pull_off(0.04, control="weight")
    with pytest.raises(TypeError):
        contact.force_displacement(0.04, most=1e-6, points=10.5)


def test_tables_tell_what_they_are():
    table = cc.Table.open(HDF5)
    assert table.held == ("pi0", "eeq", "gamma", "delta0")
    assert list(table.axes) == ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2"]
    assert table.axes["nu1"].tolist() == [0.5]
    assert 0 < table.median_error < table.max_error < table.tolerance
    assert "a_over_t" in table.scene
    assert table.title in repr(table)


def test_files_of_both_forms_hold_one_table():
    packed, hdf5 = cc.Table.read(PACKED), cc.Table.open(HDF5)
    system = make_system(film_thickness=1e-6)
    a = np.linspace(1e-5, 1e-4, 10)
    found = [table.contact(system).load(a, 0.04) for table in (packed, hdf5)]
    assert np.allclose(*found, rtol=1e-7, atol=0)
    assert np.allclose(
        found[0], cc.Table.embedded().contact(system).load(a, 0.04), rtol=1e-5, atol=0
    )
    assert cc.Table.from_packed(packed.to_packed()) == packed
    assert packed != cc.Table.embedded()
    assert packed != "paper"


def test_a_material_outside_a_table_is_named():
    with pytest.raises(cc.OutsideTableError, match="nu1") as caught:
        cc.Table.open(HDF5).contact(make_system(film_poisson_ratio=0.3))
    assert caught.value.__cause__ is None or isinstance(caught.value.__cause__, cc.ContactError)


def test_files_that_cannot_be_read(tmp_path):
    missing = tmp_path / "no such table"
    for read in (cc.Table.read, cc.Table.open):
        with pytest.raises(FileNotFoundError) as caught:
            read(missing)
        assert caught.value.filename == str(missing)
        assert caught.value.strerror == os.strerror(errno.ENOENT)
        with pytest.raises(IsADirectoryError):
            read(tmp_path)
    refuses(cc.TableError, "HDF5", lambda: cc.Table.read(HDF5))
    with pytest.raises(cc.TableError):
        cc.Table.open(PACKED)
    damaged = bytearray(PACKED.read_bytes())
    damaged[-1] ^= 1
    refuses(cc.TableError, "corrupt", lambda: cc.Table.from_packed(bytes(damaged)))
    refuses(cc.TableError, "truncated", lambda: cc.Table.from_packed(bytes(damaged[:-1])))
    with pytest.raises(cc.TableError):
        cc.Table.from_packed(b"")
    refuses(TypeError, "make a table with", lambda: cc.Table(3))


def test_the_version_is_that_of_the_workspace():
    manifest = (ROOT / "Cargo.toml").read_text()
    assert f'version = "{__version__}"' in manifest
