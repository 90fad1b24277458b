"""The likelihood: its value and gradient, and its adapters."""

import pickle
import subprocess
import sys

import numpy as np
import pytest

import coated_contact as cc
from conftest import loads_at, refuses

GLASS = cc.Elastic(young_modulus=64e9, poisson_ratio=0.2)
GEL = cc.System(
    sphere_radius=5e-6,
    sphere_modulus=GLASS.reduced_modulus,
    film=cc.Elastic(young_modulus=3e4, poisson_ratio=0.45),
    film_thickness=2e-6,
    substrate=GLASS,
)


def lens(system, count=40):
    plan = loads_at(system, np.linspace(3e-5, 1.2e-4, count), noise=2e-6)
    return cc.simulate(plan, noise=2e-6, seed=1)


def cantilever(count=150):
    """A cycle of forces against heights, with adhesion and a baseline."""
    down = np.linspace(1e-6, -1e-6, count)
    plan = cc.Experiment(
        kind="force-height",
        abscissa=np.concatenate([down, down[::-1]]),
        retract=np.repeat([False, True], count),
        system=GEL,
        work_of_adhesion=1e-3,
        contact_point=1e-7,
        stiffness=0.5,
        noise=1e-10,
    )
    return cc.simulate(plan, noise=1e-10, seed=2)


def on_a_stack():
    layers = [
        cc.Layer(
            name="primer", material=cc.Elastic(young_modulus=5e5, poisson_ratio=0.5), thickness=2e-6
        )
    ]
    stack = cc.Stack(base=cc.Elastic(young_modulus=2e11, poisson_ratio=0.25), layers=layers)
    system = cc.StackSystem(stack=stack, sphere_radius=1e-3, sphere_modulus=2e6)
    plan = loads_at(system, np.linspace(3e-5, 6e-5, 5), noise=2e-6)
    return cc.simulate(plan, noise=2e-6, seed=1)


def stiffnesses():
    silicon = cc.Elastic(young_modulus=1.7e11, poisson_ratio=0.28)
    oxide = cc.System(
        sphere_radius=1e-5,
        sphere_modulus=1.147e12,
        film=cc.Elastic(young_modulus=7.2e10, poisson_ratio=0.17),
        film_thickness=5e-7,
        substrate=silicon,
    )
    plan = cc.Experiment(
        kind="stiffness-depth",
        abscissa=np.linspace(4e-8, 2.5e-7, 10),
        system=oxide,
        indentation=cc.Indentation(beta=1.034, hardness=1e10),
        noise=0.01,
    )
    return cc.simulate(plan, noise=0.01, seed=1)


def cases(system):
    """Experiments with free parameters, values near the truth, and the error of the gradient."""
    film = ["film_modulus", "film_thickness", "work_of_adhesion", "load_offset"]
    prior = cc.Free(parameter="film_modulus", prior=(3e6, 2e5))
    curve = ["film_modulus", "work_of_adhesion", "contact_point", "baseline", "stiffness"]
    return {
        "lens": (lens(system), film, [3.6e6, 1.1e-5, 0.041, 1e-7], 1e-6),
        "lens, prior": (lens(system), [prior, "load_offset"], [3.6e6, 1e-7], 1e-6),
        "curve": (cantilever(), curve, [3.1e4, 1.05e-3, 1.01e-7, 1e-11, 0.51], 1e-5),
        "two": (
            [cantilever(), cantilever(80)],
            ["film_modulus", "contact_point"],
            [3.1e4, 1.01e-7, 0.99e-7],
            1e-5,
        ),
        "stack": (on_a_stack(), ["primer.modulus", "work_of_adhesion"], [5.1e5, 0.041], 1e-3),
        "stiffness": (stiffnesses(), ["film_modulus", "frame_compliance"], [7.1e10, 1e-7], 1e-4),
    }


@pytest.mark.parametrize("name", ["lens", "lens, prior", "curve", "two", "stack", "stiffness"])
def test_the_gradient_is_that_of_differences(system, name):
    given, free, values, tolerance = cases(system)[name]
    likelihood = cc.log_likelihood(given, free)
    assert len(likelihood.names) == len(values)
    value, gradient = likelihood.value_and_gradient(values)
    # Lookups with and without derivatives differ by rounding.
    assert value == pytest.approx(likelihood(values), rel=1e-9)
    for i, own in enumerate(values):
        # The error of a difference of four points is of the fourth order.
        step = 1e-4 * own
        moved = [
            np.where(np.arange(len(values)) == i, own + n * step, values) for n in (1, -1, 2, -2)
        ]
        at = likelihood(moved)
        difference = (8 * (at[0] - at[1]) - (at[2] - at[3])) / (12 * step)
        scale = max(abs(difference), abs(value / own) * 1e-3)
        assert abs(gradient[i] - difference) < tolerance * scale, (likelihood.names[i], difference)


def test_the_value_is_the_sum_over_the_points_that_count(system):
    given = cantilever()
    free = ["film_modulus", "contact_point"]
    on = cc.branches(given, free)
    found = cc.predict(given, branches=on)
    used = np.array([one != "left-out" for one in on])
    residuals = (found.ordinate - given.ordinate)[used] / 1e-10
    expected = -0.5 * np.sum(residuals**2) - used.sum() * np.log(np.sqrt(2 * np.pi) * 1e-10)
    values = [GEL.film.young_modulus, given.contact_point]
    assert cc.log_likelihood(given, free)(values) == pytest.approx(expected, rel=1e-12)
    # A prior is one more normal density.
    prior = [cc.Free(parameter="film_modulus", prior=(2e4, 5e3)), "contact_point"]
    density = -0.5 * 2.0**2 - np.log(np.sqrt(2 * np.pi) * 5e3)
    assert cc.log_likelihood(given, prior)(values) == pytest.approx(expected + density, rel=1e-12)
    # Fewer points count on the branches of a fit.
    fitted = cc.fit(given, free)
    of_fit = cc.log_likelihood(given, free, branches=[fitted.experiments[0].branch])
    best = list(fitted.params.values())
    constant = sum(not np.isnan(one) for one in fitted.experiments[0].fit)
    expected = -0.5 * fitted.chi_squared - constant * np.log(np.sqrt(2 * np.pi) * 1e-10)
    assert of_fit(best) == pytest.approx(expected, rel=1e-9)
    # At the minimum of the fit the gradient is 0, in units of the standard errors.
    errors = np.array(list(fitted.stderr.values()))
    assert np.all(np.abs(of_fit.gradient(best) * errors) < 1e-3)


def test_arrays_and_copies(system):
    likelihood = cc.log_likelihood(lens(system), ["film_modulus", "work_of_adhesion"])
    values = np.array([[3.4e6, 0.04], [3.5e6, 0.041], [3.6e6, 0.039]])
    one_by_one = [likelihood(row) for row in values]
    assert likelihood(values).tolist() == one_by_one
    assert likelihood(values.reshape(3, 1, 2)).shape == (3, 1)
    assert likelihood.value_and_gradient(values)[1].shape == (3, 2)
    assert isinstance(likelihood(values[0]), float)
    assert likelihood(np.empty((0, 2))).shape == (0,)
    again = pickle.loads(pickle.dumps(likelihood))
    assert again(values).tolist() == one_by_one
    assert "LogLikelihood(experiments=" in repr(likelihood)


@pytest.mark.parametrize(
    "values",
    [[-1.0, 0.04], [0.0, 0.04], [3.5e6, -0.04], [np.nan, 0.04], [np.inf, 0.04], [1e30, 0.04]],
)
def test_without_a_contact_the_likelihood_is_zero(system, values):
    likelihood = cc.log_likelihood(lens(system), ["film_modulus", "work_of_adhesion"])
    value, gradient = likelihood.value_and_gradient(values)
    assert value == likelihood(values) == -np.inf
    assert np.all(np.isnan(gradient))


def test_bounds_end_the_likelihood(system):
    free = [cc.Free(parameter="film_modulus", bounds=(3e6, 4e6)), "film_poisson_ratio"]
    likelihood = cc.log_likelihood(lens(system), free)
    assert np.isfinite(likelihood([3e6, 0.5]))
    assert (
        likelihood([2.99e6, 0.5]) == likelihood([3e6, 0.51]) == likelihood([3e6, -0.1]) == -np.inf
    )


def test_what_cannot_be_used_is_refused(system):
    given = lens(system)
    free = ["film_modulus", "work_of_adhesion"]
    with pytest.raises(cc.FitError, match="the noise of experiment"):
        cc.log_likelihood(
            cc.Experiment(kind="load-radius", abscissa=[1e-5], ordinate=[0], system=system), free
        )
    likelihood = cc.log_likelihood(given, free)
    for wrong in ([3e6], [3e6, 0.04, 0.0], 3e6, np.ones((2, 3))):
        with pytest.raises(
            cc.FitError, match="one value for each of film_modulus, work_of_adhesion"
        ):
            likelihood(wrong)
    refuses(TypeError, "real numbers", lambda: likelihood(["a", "b"]))
    pandas = pytest.importorskip("pandas")
    named = pandas.Series({"film_modulus": 3.6e6, "work_of_adhesion": 0.04})
    assert likelihood(named) == likelihood(named.to_frame().T)[0] == likelihood([3.6e6, 0.04])
    for wrong in (named[::-1], named[::-1].to_frame().T):
        refuses(cc.FitError, "bring the values into this order", lambda w=wrong: likelihood(w))
    with pytest.raises(cc.FitError, match="number of branches of experiment = 3"):
        cc.log_likelihood(given, free, branches=[["advancing"] * 3])
    with pytest.raises(cc.FitError, match="number of experiments with branches = 2"):
        cc.log_likelihood(given, free, branches=[["advancing"] * 40] * 2)
    refuses(cc.FitError, "'up'", lambda: cc.log_likelihood(given, free, branches=[["up"] * 40]))
    with pytest.raises(TypeError, match="list of names for each"):
        cc.log_likelihood(given, free, branches="advancing")
    refuses(
        cc.FitError, "no height of a cantilever", lambda: cc.log_likelihood(given, ["stiffness"])
    )
    refuses(cc.FitError, "there is no free parameter", lambda: cc.log_likelihood(given, []))


def test_emcee_takes_it_as_it_is(system):
    emcee = pytest.importorskip("emcee")
    likelihood = cc.log_likelihood(lens(system), ["film_modulus", "work_of_adhesion"])
    sampler = emcee.EnsembleSampler(8, 2, likelihood, vectorize=True)
    start = np.array([3.5e6, 0.04]) * np.random.default_rng(1).uniform(0.99, 1.01, (8, 2))
    sampler.run_mcmc(start, 3)
    assert np.array_equal(sampler.get_log_prob(flat=True), likelihood(sampler.get_chain(flat=True)))


ADAPTERS = """
import numpy as np
from coated_contact import Elastic, Experiment, HalfSpace, log_likelihood

glass = Elastic(young_modulus=64e9, poisson_ratio=0.2)
system = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=glass)
lens = Experiment(kind="load-radius", abscissa=[5e-5, 8e-5, 1e-4], noise=1e-6, system=system,
                  ordinate=[-1.69e-4, 4.17e-4, 1.249e-3])
likelihood = log_likelihood(lens, ["sphere_modulus", "work_of_adhesion"])
at = np.array([2.01e6, 0.0402])
value, gradient = likelihood.value_and_gradient(at)
"""

JAX = """
import jax
f = likelihood.jax()
try:
    f(at.astype(np.float32))
except TypeError as error:
    assert "jax_enable_x64" in str(error)
else:
    raise AssertionError
jax.config.update("jax_enable_x64", True)
assert float(f(at)) == float(jax.jit(f)(at)) == value
for found in (jax.grad(f)(at), jax.jit(jax.grad(f))(at)):
    np.testing.assert_allclose(found, gradient, rtol=1e-14)
tangent = np.array([1e4, 1e-3])
found, derivative = jax.jvp(f, (at,), (tangent,))
np.testing.assert_allclose(derivative, gradient @ tangent, rtol=1e-13)
rows = np.stack([at, 1.01 * at, -at])
np.testing.assert_array_equal(jax.vmap(f)(rows), likelihood(rows))
np.testing.assert_array_equal(f(rows), likelihood(rows))
np.testing.assert_allclose(
    jax.vmap(jax.grad(f))(rows), likelihood.gradient(rows), rtol=1e-14
)
scaled = jax.grad(lambda x: f(at * (1 + x)))(np.zeros(2))
np.testing.assert_allclose(scaled, gradient * at, rtol=1e-14)
"""

TORCH = """
import torch
f = likelihood.torch()
x = torch.tensor(at, requires_grad=True)
found = f(x)
assert found.item() == value
(2 * found).backward()
np.testing.assert_allclose(x.grad.numpy(), 2 * gradient, rtol=1e-14)
rows = torch.tensor(np.stack([at, 1.01 * at]), requires_grad=True)
f(rows).sum().backward()
np.testing.assert_allclose(rows.grad.numpy(), likelihood.gradient(rows.detach()), rtol=1e-14)
unit = torch.tensor([1.0, 1.0], dtype=torch.float64, requires_grad=True)
scale = torch.tensor(at)
assert torch.autograd.gradcheck(lambda z: f(z * scale), (unit,), rtol=1e-4, eps=1e-6)
try:
    f(x.float())
except TypeError as error:
    assert "double" in str(error)
else:
    raise AssertionError
try:
    torch.autograd.functional.hessian(f, x.detach())
except NotImplementedError as error:
    assert "first derivatives only" in str(error)
else:
    raise AssertionError
"""

PYMC = """
import pymc
op = likelihood.pytensor()
with pymc.Model() as model:
    z = pymc.Normal("z", 0, 10, shape=2)
    pymc.Potential("contact", op(at * (1 + 0.01 * z)))
point = {"z": np.zeros(2)}
prior, contact = model.compile_logp(sum=False)(point)
np.testing.assert_allclose(contact, value, rtol=1e-13)
np.testing.assert_allclose(model.compile_dlogp()(point), 0.01 * at * gradient, rtol=1e-12)
"""


@pytest.mark.parametrize(("package", "script"), [("jax", JAX), ("torch", TORCH), ("pymc", PYMC)])
def test_adapters(package, script):
    """In a process of their own, which has their threads and their settings."""
    found = subprocess.run(
        [sys.executable, "-c", f"import {package}"], capture_output=True, text=True
    )
    if found.returncode != 0:
        pytest.skip(f"{package} is not installed")
    run = subprocess.run([sys.executable, "-c", ADAPTERS + script], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_nothing_is_imported_unless_it_is_used():
    script = (
        "import sys, coated_contact;"
        "assert not {'jax', 'torch', 'pytensor', 'pymc', 'afmformats'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", script], check=True)
