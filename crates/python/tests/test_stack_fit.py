"""Fits on stacks of layers: one film cut into layers, the command line, and what is refused."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

from coated_contact import (
    ContactError,
    Elastic,
    FitError,
    FlatPunch,
    Layer,
    Stack,
    StackSystem,
    fit,
    fit_map,
    generate,
    predict,
    simulate,
)
from conftest import ROOT, loads_at, make_system, refuses

PRIMER = ROOT / "tables" / "stacks" / "primer.toml"
A = [float(a) for a in np.linspace(4e-5, 1.3e-4, 25)]


def lens(stack, **known):
    system = StackSystem(stack=stack, sphere_radius=1e-3, sphere_modulus=2e6)
    return loads_at(system, A, **{"noise": 2e-6} | known)


def test_a_layer_is_found_within_its_errors(stack):
    curves = [simulate(lens(stack), noise=2e-6, seed=seed) for seed in range(4)]
    wrong = replace(stack.layers[0], material=Elastic(young_modulus=1.5e6, poisson_ratio=0.5))
    guess = StackSystem(
        stack=replace(stack, layers=[wrong, stack.layers[1]]),
        sphere_radius=1e-3,
        sphere_modulus=2e6,
    )
    found = fit_map(
        [replace(curve, system=guess) for curve in curves], ["primer.modulus", "work_of_adhesion"]
    )
    assert found.converged.all()
    for name, truth in {"primer.modulus": 5e5, "work_of_adhesion": 0.04}.items():
        assert np.all(np.abs(found.params[name] - truth) < 4 * found.stderr[name])
        assert np.all(found.stderr[name] < 0.2 * truth)


def test_a_table_of_the_stack_is_looked_up(stack):
    scene = {
        "title": "The stack",
        "tolerance": 1e-6,
        "a_over_t": {"from": 0.05, "to": 20},
        "e1_over_e2": {"from": 0.1, "to": 10},
        "stack": stack,
    }
    table = generate(scene, progress=False)
    plan = lens(stack)
    solved, found = (simulate(plan, noise=0, seed=1, table=one) for one in (None, table))
    error = np.max(np.abs(found.ordinate - solved.ordinate)) / np.max(np.abs(solved.ordinate))
    assert 0 < error < 1e-6, "equal numbers would be those of the same method"
    curve = simulate(plan, noise=2e-6, seed=1)
    free = ["sphere_modulus", "work_of_adhesion"]
    by_solves, by_lookups = (fit(curve, free, table=one) for one in (None, table))
    for name in free:
        difference = by_lookups.params[name] - by_solves.params[name]
        assert abs(difference) < 1e-4 * by_solves.stderr[name]
    with pytest.raises(ContactError, match="do without the table"):
        fit(curve, ["primer.modulus"], table=table)


def test_derivatives_by_a_layer_are_those_by_the_film():
    """One layer is the film; its name has a hyphen, and that of the parameter a point."""
    film = make_system(film_modulus=5e5, film_poisson_ratio=0.45)
    layer = Layer(name="the-film", material=film.film, thickness=film.film_thickness)
    plan = lens(Stack(base=film.substrate, layers=[layer]))
    found = predict(plan, ["the-film.thickness", "the-film.modulus"]).derivatives
    expected = predict(replace(plan, system=film), ["film_thickness", "film_modulus"]).derivatives
    for one, other in zip(found.values(), expected.values(), strict=True):
        assert one == pytest.approx(other, abs=1e-4 * np.abs(other).max())


def test_a_punch_on_a_stack_is_predicted(stack):
    punch = StackSystem(stack=stack, sphere_modulus=inf, probe=FlatPunch(radius=1e-6))
    plan = replace(lens(stack), system=punch, kind="load-penetration", abscissa=[1e-8, 1e-7])
    found = predict(plan, ["elastomer.modulus"])
    stiffness = stack.contact(probe=punch.probe, sphere_modulus=inf, a_over_t=(0.05, 1)).stiffness(
        1e-6
    )
    assert found.ordinate == pytest.approx(stiffness * plan.abscissa, rel=1e-6)
    assert (found.derivatives["elastomer.modulus"] > 0).all()


def test_what_cannot_be_used_is_named(stack):
    plan = lens(stack)
    words = r"no such layer; its layers have primer\.modulus"
    refuses(FitError, words, lambda: predict(plan, ["oxide.modulus"]))
    with pytest.raises(FitError, match="surface of its own"):
        lens(replace(stack, surface=stack.layers[0].material))
    layers = [replace(layer, name=f"{layer.name}, soft") for layer in stack.layers]
    refuses(FitError, "cannot name a layer", lambda: predict(lens(replace(stack, layers=layers))))
    refuses(TypeError, "a StackSystem", lambda: replace(plan, system=stack))
    # The radii reach beyond 1000 times the thickness of the top layer.
    thin = replace(stack.layers[1], thickness=1e-8)
    data = replace(lens(stack), ordinate=np.linspace(-1e-4, 1e-3, len(A)))
    system = replace(data.system, stack=replace(stack, layers=[stack.layers[0], thin]))
    with pytest.raises(FitError, match="where the fit starts") as caught:
        fit(replace(data, system=system), ["primer.modulus"])
    assert type(caught.value.__cause__).__name__ == "SolveError"
    assert caught.value.__cause__.value > caught.value.__cause__.range[1]
    # Where a larger contrast is refused, differences are to the other side.
    stiff = replace(
        stack.layers[1], material=Elastic(young_modulus=5e5 * 0.9999e9, poisson_ratio=0.3)
    )
    edge = replace(stack, layers=[stack.layers[0], stiff])
    (slopes,) = predict(lens(edge), ["elastomer.modulus"]).derivatives.values()
    assert np.isfinite(slopes).all()
