"""Stacks of layers: Rust bit for bit, limits, files, and what is refused."""

from dataclasses import replace
from math import exp, inf

import numpy as np
import pytest

import coated_contact as cc
from conftest import ROOT, refuses

PRIMER = ROOT / "tables" / "stacks" / "primer.toml"
KNOWN = {"sphere_radius": 1e-3, "sphere_modulus": 2e6}


def test_numbers_are_those_of_rust_bit_for_bit(tabulate, printed, stack):
    assert cc.Stack.read(PRIMER) == stack
    expected = printed("solve", "--stack", PRIMER, "--a-over-t=6.5", "--sphere-modulus=2e6")
    found = cc.solve_stack(6.5, stack, 2e6, tolerance=1e-10)
    assert {name: getattr(found, name) for name in expected} == expected
    assert len(expected) == 5
    a, t = [1e-5, 1e-4], stack.thickness
    flags = ("--sphere-radius=1e-3", "--sphere-modulus=2e6", "--work-of-adhesion=0.04")
    ends = (f"--from={a[0]}", f"--to={a[1]}", "--points=20", "--tolerance=1e-9")
    curve = tabulate("curve", "--stack", PRIMER, *ends, *flags)
    radii, load, penetration = (
        np.array([point[name] for point in curve])
        for name in ("contact_radius", "load", "penetration")
    )
    contact = stack.contact(**KNOWN, a_over_t=(a[0] / t, a[1] / t), tolerance=1e-9)
    assert np.array_equal(contact.load(radii, 0.04), load)
    assert np.array_equal(contact.penetration(radii, 0.04), penetration)


def test_a_contact_answers_what_one_of_a_film_answers(stack):
    contact, w = stack.contact(**KNOWN, a_over_t=(0.05, 20)), 0.04
    pulled = contact.pull_off(w)
    expected = contact.load_and_penetration(pulled.contact_radius, w)
    assert (pulled.load, pulled.penetration) == pytest.approx(expected, rel=1e-9)
    equilibria = contact.equilibria(w, control=cc.Spring(stiffness=50.0))
    assert equilibria.unloading(1e-6).contact_radius > pulled.contact_radius
    curve = contact.force_displacement(w, most=1e-6, points=20)
    assert curve.jumps
    assert contact.zone_size(w).tabor > 5
    line = contact.line(w, 65e-6)
    assert line.impose("load", 1e-4).load == pytest.approx(1e-4, rel=1e-9)
    validity = contact.validity(65e-6)
    assert validity.a_over_t == pytest.approx(6.5)
    assert validity.compressibility == stack.compressibility * 6.5**2
    assert stack.compressibility == 0.0  # incompressible
    soft = [replace(stack.layers[0], material=cc.Elastic(young_modulus=5e5, poisson_ratio=0.3))]
    compressible = replace(stack, layers=soft).compressibility
    assert compressible == pytest.approx(3 / 16 * 0.4 / 0.7, rel=1e-14)
    refuses(cc.InputError, "no derivatives", lambda: contact.gradient(65e-6, w))
    with pytest.raises(cc.OutsideTableError):
        contact.load(1e-3 * 0.9, w)


def test_a_punch_on_a_stack(stack):
    """F = S delta."""
    punch = cc.FlatPunch(radius=2e-5)
    contact = stack.contact(probe=punch, sphere_modulus=2e6, a_over_t=(1, 4))
    sphere = stack.contact(**KNOWN, a_over_t=(1, 4))
    assert contact.stiffness(2e-5) == sphere.stiffness(2e-5)
    pulled = contact.pull_off(0.04)
    assert pulled.load == pytest.approx(contact.stiffness(2e-5) * pulled.penetration, rel=1e-12)
    with pytest.raises(cc.OutsideTableError, match="begins at a_over_t = 1"):
        stack.contact(probe=cc.Cone(half_angle=1.2), sphere_modulus=2e6, a_over_t=(1, 4))


def test_a_cone_on_a_stack_of_one_film_is_that_on_the_film():
    """The first is solved directly, the second is looked up."""
    film = cc.Elastic(young_modulus=3.5e6, poisson_ratio=0.4)
    substrate = cc.Elastic(young_modulus=2e9, poisson_ratio=0.3)
    of_probe = {"probe": cc.Cone(half_angle=1.2), "sphere_modulus": inf}
    system = cc.System(film=film, film_thickness=1e-5, substrate=substrate, **of_probe)
    looked_up = cc.Table.embedded().contact(system)
    halves = [cc.Layer(material=film, thickness=5e-6)] * 2
    stack = cc.Stack(base=substrate, layers=halves)
    solved = stack.contact(**of_probe, a_over_t=(1e-3, 10))
    radii = np.geomspace(1e-7, 6e-5, 20)
    of_stack = solved.load_and_penetration(radii, 0.04)
    np.testing.assert_allclose(of_stack, looked_up.load_and_penetration(radii, 0.04), rtol=3e-6)


def test_a_graded_film_has_the_solids_of_the_middles_of_its_layers():
    def material(height):
        return cc.Elastic(young_modulus=1e6 * exp(-3 * height), poisson_ratio=0.3)

    stack = cc.Stack.graded(base=material(0.0), thickness=1.0, count=4, material=material)
    middles = [material(z) for z in (0.125, 0.375, 0.625, 0.875)]
    assert [layer.material for layer in stack.layers] == middles
    assert {layer.thickness for layer in stack.layers} == {0.25}
    assert (stack.base, stack.surface, stack.thickness) == (material(0.0), material(1.0), 1.0)
    with pytest.raises(cc.InputError, match="Young's modulus is inf"):
        replace(stack, surface=cc.Elastic(young_modulus=inf, poisson_ratio=0.3))


def test_solves_broadcast(stack):
    x, moduli = np.array([0.1, 1.0, 6.5])[:, None], np.array([1e6, inf])
    solution = cc.solve_stack(x, stack, moduli)
    assert solution.eeq.shape == (3, 2)
    assert solution.eeq[2, 0] == cc.solve_stack(6.5, stack, 1e6).eeq
    xarray = pytest.importorskip("xarray")
    data = solution.to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert dict(data.sizes) == {"a_over_t": 3, "sphere_modulus": 2}
    with pytest.raises(cc.SolveError) as caught:
        cc.solve_stack([1.0, 1e5], stack, 2e6)
    assert (caught.value.axis, caught.value.value) == ("a_over_t", 1e5)
    assert caught.value.range == (0.0, pytest.approx(750.0))
    assert caught.value.index == (1,)
    found = cc.solve_stack([1.0, 1e5], stack, 2e6, errors="nan")
    assert np.isnan(found.eeq).tolist() == [False, True]


def test_layers_that_cannot_be_are_named(stack):
    soft = cc.Layer(material=cc.Elastic(young_modulus=1e5, poisson_ratio=0.3), thickness=1e-6)
    layers = [soft, replace(soft, thickness=0.0)]
    words = "layer 2 of 2.*thickness is 0"
    error = refuses(cc.InputError, words, lambda: replace(stack, layers=layers))
    assert (error.axis, error.value) == ("layer", 2.0)
    named = [replace(soft, name="primer")] * 2
    words = "two layers have the name 'primer'"
    refuses(cc.InputError, words, lambda: replace(stack, layers=named))
    refuses(TypeError, "layers must be Layer", lambda: replace(stack, layers=[3.0]))
    refuses(
        TypeError, "material must be an Elastic", lambda: cc.Layer(material=1e6, thickness=1e-6)
    )
    with pytest.raises(cc.InputError, match="sphere_modulus"):
        cc.StackSystem(stack=stack, sphere_radius=1e-3, sphere_modulus=0.0)
    with pytest.raises(TypeError, match="stack must be a Stack"):
        cc.StackSystem(stack=3, sphere_radius=1e-3, sphere_modulus=1e6)
    system = cc.StackSystem(stack=stack, sphere_radius=1e-3, sphere_modulus=1e6)
    assert system.sphere_radius == 1e-3
    refuses(TypeError, "a contact needs", lambda: cc.Contact(system=system, table=None))
    refuses(TypeError, "name must be a str", lambda: replace(soft, name=3))


def test_files_are_read_or_named(tmp_path):
    path, text = tmp_path / "stack.toml", PRIMER.read_text()
    path.write_text(text.replace("2e11, poisson_ratio = 0.25", "inf"))
    assert cc.Stack.read(path).base.young_modulus == inf
    path.write_text(text.replace("young_modulus = 5e5", "young_modulus = -5e5", 1))
    error = refuses(
        cc.InputError, '"primer", 1 of 2 .*: Young.s modulus', lambda: cc.Stack.read(path)
    )
    assert str(path) in str(error)
    with pytest.raises(FileNotFoundError):
        cc.Stack.read(tmp_path / "missing.toml")
