"""Fits on stacks of layers: one film cut into layers, the command line, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

import coated_contact as cc
from conftest import ROOT, loads_at, make_system, refuses

PRIMER = ROOT / "tables" / "stacks" / "primer.toml"
A = [float(a) for a in np.linspace(4e-5, 1.3e-4, 25)]


def lens(stack, **known):
    system = cc.StackSystem(stack=stack, sphere_radius=1e-3, sphere_modulus=2e6)
    return loads_at(system, A, **{"noise": 2e-6} | known)


def test_a_table_of_the_stack_is_looked_up(stack):
    scene = {
        "title": "The stack",
        "tolerance": 1e-6,
        "a_over_t": {"from": 0.05, "to": 20},
        "e1_over_e2": {"from": 0.1, "to": 10},
        "stack": stack,
    }
    table = cc.generate(scene, progress=False)
    plan = lens(stack)
    solved, found = (cc.simulate(plan, noise=0, seed=1, table=one) for one in (None, table))
    error = np.max(np.abs(found.ordinate - solved.ordinate)) / np.max(np.abs(solved.ordinate))
    assert 0 < error < 1e-6, "equal numbers would be those of the same method"
    curve = cc.simulate(plan, noise=2e-6, seed=1)
    free = ["sphere_modulus", "work_of_adhesion"]
    by_solves, by_lookups = (cc.fit(curve, free, table=one) for one in (None, table))
    for name in free:
        difference = by_lookups.params[name] - by_solves.params[name]
        assert abs(difference) < 1e-4 * by_solves.stderr[name]
    with pytest.raises(cc.ContactError, match="do without the table"):
        cc.fit(curve, ["primer.modulus"], table=table)


def test_derivatives_by_a_layer_are_those_by_the_film():
    """One layer is the film; its name has a hyphen, and that of the parameter a point."""
    film = make_system(film_modulus=5e5, film_poisson_ratio=0.45)
    layer = cc.Layer(name="the-film", material=film.film, thickness=film.film_thickness)
    plan = lens(cc.Stack(base=film.substrate, layers=[layer]))
    found = cc.predict(plan, ["the-film.thickness", "the-film.modulus"]).derivatives
    expected = cc.predict(
        replace(plan, system=film), ["film_thickness", "film_modulus"]
    ).derivatives
    for one, other in zip(found.values(), expected.values(), strict=True):
        assert one == pytest.approx(other, abs=1e-4 * np.abs(other).max())


def test_what_cannot_be_used_is_named(stack):
    plan = lens(stack)
    words = r"no such layer; its layers have primer\.modulus"
    refuses(cc.FitError, words, lambda: cc.predict(plan, ["oxide.modulus"]))
    with pytest.raises(cc.FitError, match="surface of its own"):
        lens(replace(stack, surface=stack.layers[0].material))
    layers = [replace(layer, name=f"{layer.name}, soft") for layer in stack.layers]
    refuses(
        cc.FitError, "cannot name a layer", lambda: cc.predict(lens(replace(stack, layers=layers)))
    )
    refuses(TypeError, "a StackSystem", lambda: replace(plan, system=stack))
    # The radii reach beyond 1000 times the thickness of the top layer.
    thin = replace(stack.layers[1], thickness=1e-8)
    data = replace(lens(stack), ordinate=np.linspace(-1e-4, 1e-3, len(A)))
    system = replace(data.system, stack=replace(stack, layers=[stack.layers[0], thin]))
    with pytest.raises(cc.FitError, match="where the fit starts") as caught:
        cc.fit(replace(data, system=system), ["primer.modulus"])
    assert type(caught.value.__cause__).__name__ == "SolveError"
    assert caught.value.__cause__.value > caught.value.__cause__.range[1]
    # Where a larger contrast is refused, differences are to the other side.
    stiff = replace(
        stack.layers[1], material=cc.Elastic(young_modulus=5e5 * 0.9999e9, poisson_ratio=0.3)
    )
    edge = replace(stack, layers=[stack.layers[0], stiff])
    (slopes,) = cc.predict(lens(edge), ["elastomer.modulus"]).derivatives.values()
    assert np.isfinite(slopes).all()
