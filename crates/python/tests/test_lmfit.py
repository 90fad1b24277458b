"""The model of lmfit: the numbers of `fit`, with fewer evaluations by exact derivatives."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from coated_contact import Experiment, FitError, Indentation, Springs, StackSystem, fit, simulate
from conftest import loads_at, make_system, refuses
from test_fit import WANTED, lens
from test_indentation import system as coated
from test_model import retract
from test_relaxing import plan

lmfit = pytest.importorskip("lmfit")


@pytest.fixture(scope="module")
def model_class():
    from coated_contact.lmfit import Model

    return Model


@pytest.mark.parametrize("method", ["leastsq", "least_squares"])
def test_a_lens_is_fitted_like_by_fit(model_class, method):
    one = lens(seed=1)
    expected = fit(one, WANTED)
    model = model_class(one, WANTED)
    start = {"sphere_modulus": 1e6, "work_of_adhesion": 0.05}
    found = model.fit(one.ordinate, x=one.abscissa, weights=1 / 2e-6, method=method, **start)
    assert found.success
    for name in WANTED:
        assert found.best_values[name] == pytest.approx(expected.params[name], rel=1e-5)
        assert found.params[name].stderr == pytest.approx(expected.stderr[name], rel=1e-3)
    points = expected.experiments[0]
    assert np.allclose(found.best_fit, points.fit, rtol=0, atol=1e-3 * points.noise)


def test_a_start_at_a_bound_is_refused(model_class):
    one = replace(lens(seed=1), work_of_adhesion=0.0)
    data = {"data": one.ordinate, "x": one.abscissa, "weights": 1 / 2e-6}
    model = model_class(one, WANTED)
    words = "work_of_adhesion starts at its bound 0"
    refuses(ValueError, words, lambda: model.fit(**data))
    refuses(ValueError, words, lambda: model.fit(params=model.make_params(), **data))
    refuses(ValueError, words, lambda: model.fit(work_of_adhesion=0.0, **data))
    parameter = lmfit.Parameter("work_of_adhesion", value=1.0, max=1.0)
    refuses(ValueError, "its bound 1", lambda: model.fit(work_of_adhesion=parameter, **data))
    expected = fit(one, WANTED)
    ways = [{"work_of_adhesion": 1e-3}, {"method": "least_squares"}]
    for found in [model.fit(**data, **way) for way in ways]:
        for name in WANTED:
            assert found.best_values[name] == pytest.approx(expected.params[name], rel=1e-4)
    model.set_param_hint("work_of_adhesion", vary=False)
    assert model.fit(**data).best_values["work_of_adhesion"] == 0.0


def test_the_start_does_not_decide(model_class):
    truth = retract(points=200, contact_point=4e-6)
    made = simulate(truth, noise=1e-7, seed=2)
    free = ["film_modulus", "work_of_adhesion", "contact_point"]
    expected = fit(made, free)
    for start in (3.9e-6, 4.1e-6):
        found = model_class(made, free).fit(
            made.ordinate,
            x=made.abscissa,
            weights=1e7,
            method="least_squares",
            contact_point=start,
        )
        for name in free:
            error = abs(found.best_values[name] - expected.params[name])
            assert error < 0.1 * expected.stderr[name], name


def test_data_of_another_curve_need_a_model_of_their_own(model_class):
    free = ["film_modulus", "work_of_adhesion", "contact_point"]
    one, other = [
        simulate(retract(points=200, contact_point=at), noise=1e-7, seed=2) for at in (4e-6, 3.8e-6)
    ]
    assert np.array_equal(one.abscissa, other.abscissa)
    model = model_class(one, free)
    data = {"x": one.abscissa, "weights": 1e7}
    refuses(ValueError, "make a model of an experiment", lambda: model.fit(other.ordinate, **data))
    again = simulate(retract(points=200, contact_point=4e-6), noise=1e-7, seed=3)
    assert model.fit(again.ordinate, **data).success


def test_approach_and_retract_are_not_forgotten_at_other_abscissae(model_class):
    heights = np.concatenate([np.linspace(4e-6, -0.5e-6, 100), np.linspace(-0.5e-6, 8e-6, 100)])
    back = np.arange(200) >= 100
    cycle = replace(
        retract(contact_point=4e-6, work_of_adhesion_receding=0.06), abscissa=heights, retract=back
    )
    made = simulate(cycle, noise=1e-7, seed=1)
    model = model_class(made, ["film_modulus", "contact_point"])
    assert model.fit(made.ordinate, x=made.abscissa, weights=1e7).success
    part = {"data": made.ordinate[back], "x": made.abscissa[back], "weights": 1e7}
    refuses(FitError, "make a model of one direction", lambda: model.fit(**part))


def test_points_in_a_jump_do_not_count_in_a_composite_model(model_class):
    made = simulate(retract(points=200, contact_point=4e-6), noise=1e-7, seed=2)
    ordinate = made.ordinate.copy()
    last = np.argmax(np.diff(ordinate))
    ordinate[last + 1 : last + 5] = ordinate[last] * np.array([0.8, 0.6, 0.4, 0.2])
    made = replace(made, ordinate=ordinate)
    free = ["film_modulus", "work_of_adhesion", "contact_point"]
    alone = model_class(made, free)
    left_out = np.isnan(alone.eval(x=made.abscissa))
    assert 3 <= left_out.sum() <= 6
    weights = np.full(made.ordinate.shape, 1e7)
    data = {"data": made.ordinate, "x": made.abscissa, "weights": weights}
    composite = model_class(made, free, nan_policy="omit") + lmfit.models.ConstantModel()
    params = composite.make_params(c={"value": 0.0, "vary": False})
    found, expected = composite.fit(params=params, **data), alone.fit(**data)
    assert np.array_equal(np.isnan(expected.best_fit), left_out)
    # They are no degrees of freedom either.
    fitted = fit(replace(made, noise=1e-7), free)
    assert expected.nfree == fitted.degrees_of_freedom
    for name in free:
        assert expected.params[name].stderr == pytest.approx(fitted.stderr[name], rel=0.2), name
    for name in free:
        error = abs(found.best_values[name] - expected.best_values[name])
        assert error < 0.05 * expected.params[name].stderr, name
    raises = model_class(made, free) + lmfit.models.ConstantModel()
    refuses(ValueError, "NaN values", lambda: raises.fit(params=params, **data))


def test_the_exact_derivatives_are_used(model_class):
    one = lens(seed=1)
    start = {"sphere_modulus": 1e6, "work_of_adhesion": 0.05}
    exact = model_class(one, WANTED).fit(one.ordinate, x=one.abscissa, **start)
    differences = model_class(one, WANTED).fit(
        one.ordinate, x=one.abscissa, **start, fit_kws={"Dfun": None}
    )
    assert exact.nfev < 0.6 * differences.nfev
    assert exact.chisqr <= differences.chisqr


def test_a_model_and_its_results_can_be_pickled(model_class):
    one = lens(seed=1)
    model = model_class(one, WANTED)
    data = {"data": one.ordinate, "x": one.abscissa}
    found = pickle.loads(pickle.dumps(model)).fit(**data)
    again = pickle.loads(pickle.dumps(found))
    assert again.best_values == model.fit(**data).best_values
    assert np.array_equal(again.eval(x=one.abscissa), found.best_fit)


def test_the_fit_is_drawn_on_a_finer_grid(model_class):
    one = lens(seed=1)
    model = model_class(one, WANTED)
    found = model.fit(one.ordinate, x=one.abscissa)
    finer = np.linspace(one.abscissa[0], one.abscissa[-1], 2 * len(one.abscissa) - 1)
    assert np.allclose(found.eval(x=finer)[::2], found.best_fit, rtol=1e-12, atol=1e-15)
    assert found.eval_uncertainty(x=finer).shape == finer.shape


def test_what_is_known_of_each_point_is_not_known_of_others(model_class):
    one = lens(seed=1)
    points = np.shape(one.abscissa)
    each = replace(one, noise=np.full(points, 2e-6), time=np.arange(*points, dtype=float))
    each = replace(each, abscissa_noise=np.full(points, 1e-9))
    found = model_class(each, WANTED).eval(x=one.abscissa[::2])
    assert np.array_equal(found, model_class(one, WANTED).eval(x=one.abscissa[::2]))
    depths = np.linspace(4e-8, 2.5e-7, 5)
    tip = Indentation(hardness=1e10)
    csm = Experiment(kind="stiffness-depth", abscissa=depths, system=coated(), indentation=tip)
    for made, needed in [
        (simulate(plan(), noise=1e-10, seed=1), "times"),
        (simulate(csm, noise=0.01, seed=1), "loads"),
    ]:
        model = model_class(made, ["film_modulus"])
        assert model.eval(x=made.abscissa).shape == made.abscissa.shape
        other = made.abscissa[:3]
        refuses(FitError, f"the {needed} at other", lambda model=model, x=other: model.eval(x=x))


def test_a_prefix_and_parameters_of_ones_own(model_class):
    one = lens(seed=1)
    data = {"data": one.ordinate, "x": one.abscissa, "weights": 1 / 2e-6}
    expected = model_class(one, WANTED).fit(**data)
    params = model_class(one, WANTED, prefix="p_").make_params()
    params.add("sphere_modulus", value=1.0)
    found = model_class(one, WANTED, prefix="p_").fit(params=params, **data)
    assert found.nfev < 10
    for name in WANTED:
        assert found.best_values[f"p_{name}"] == pytest.approx(expected.best_values[name])
    assert found.params["sphere_modulus"].value == 1.0


def test_expressions_and_fixed_parameters(model_class):
    system = make_system(film_modulus=5e5, film_poisson_ratio=0.45)
    made = simulate(loads_at(system, np.linspace(50e-6, 110e-6, 40)), noise=1e-6, seed=3)
    model = model_class(made, ["film_modulus", "work_of_adhesion"])
    params = model.make_params(film_modulus=4e5)
    params["sphere_modulus"].set(expr="4 * film_modulus")
    found = model.fit(made.ordinate, params, x=made.abscissa)
    assert found.best_values["sphere_modulus"] == 4 * found.best_values["film_modulus"]
    assert found.best_values["film_modulus"] == pytest.approx(5e5, rel=0.05)
    assert [name for name, one in params.items() if one.vary and not one.expr] == [
        "film_modulus",
        "work_of_adhesion",
    ]


@pytest.mark.parametrize("given", ["hint", "keyword", "params"])
@pytest.mark.parametrize("method", ["leastsq", "least_squares"])
def test_every_way_to_give_an_expression_gives_one_fit(model_class, given, method):
    one = lens(seed=1)
    model = model_class(one, WANTED)
    data = {"data": one.ordinate, "x": one.abscissa, "weights": 1 / 2e-6, "method": method}
    expression = "2e-8 * sphere_modulus"
    params = model.make_params()
    params["work_of_adhesion"].set(expr=expression)
    # Without the Jacobian.
    expected = lmfit.Model.fit(model, params=params, **data)
    found = {
        "hint": lambda: hinted(model, expression).fit(**data),
        "keyword": lambda: model.fit(work_of_adhesion=lmfit.Parameter("", expr=expression), **data),
        "params": lambda: model.fit(params=params, **data),
    }[given]()
    assert found.chisqr == expected.chisqr
    assert found.params["sphere_modulus"].stderr == expected.params["sphere_modulus"].stderr
    free = model_class(one, WANTED).fit(**data)
    refuses(ValueError, "call fit of the model", lambda: free.fit(params=params))


def hinted(model, expression):
    model.set_param_hint("work_of_adhesion", expr=expression)
    return model


@pytest.mark.parametrize(
    ("parameter", "start", "errors"),
    [
        ("primer.modulus", {"primer_modulus": 6e5}, (1e-3, 1e-2)),
        ("elastomer.interface_stiffness", {}, (1e-2, 0.1)),
    ],
)
def test_layers_of_a_stack_are_fitted_like_by_fit(model_class, stack, parameter, start, errors):
    base, film = stack.layers
    if "interface" in parameter:
        film = replace(film, interface=Springs(tangential_stiffness=3e10))
    on_layers = replace(stack, layers=(base, film))
    system = StackSystem(stack=on_layers, sphere_radius=1e-3, sphere_modulus=2e6)
    made = simulate(loads_at(system, np.linspace(4e-5, 1.3e-4, 25)), noise=2e-6, seed=1)
    free = [parameter, "work_of_adhesion"]
    expected = fit(made, free)
    model = model_class(made, free)
    assert "elastomer_thickness" in model.param_names
    # The layers are not one film, and a bonded layer has no springs.
    assert not {"film_modulus", "primer_interface_stiffness"} & set(model.param_names)
    found = model.fit(made.ordinate, x=made.abscissa, weights=1 / 2e-6, **start)
    name = parameter.replace(".", "_")
    assert found.best_values[name] == pytest.approx(expected.params[parameter], rel=errors[0])
    assert found.params[name].stderr == pytest.approx(expected.stderr[parameter], rel=errors[1])


def test_unknown_parameters_are_named(model_class):
    refuses(ValueError, "film_thickness", lambda: model_class(lens(seed=1), ["film_thickness"]))
