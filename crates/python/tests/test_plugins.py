"""The models for nanite: a measured curve, against JKR in closed form and against `fit`."""

import os
import re
import subprocess
import sys
from math import pi
from pathlib import Path

import numpy as np
import pytest

from coated_contact import Experiment, branches, fit, plugins, predict, simulate

RADIUS, THICK = 18.64e-6, 1e-2


def test_the_files_do_not_import_nanite():
    """nanite is under the GPL; the package is not."""
    for path in (plugins.APPROACH, plugins.RETRACT, Path(plugins.__file__)):
        assert not re.search(r"^\s*(import|from)\s+nanite", path.read_text(), re.MULTILINE)
    command = [sys.executable, "-m", "coated_contact.plugins"]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert printed.split() == [str(plugins.APPROACH), str(plugins.RETRACT)]


def test_a_model_is_the_prediction():
    pytest.importorskip("lmfit")
    plugin = plugins.Plugin(retract=True)
    values = plugin.get_parameter_defaults().valuesdict() | {"contact_point": 1e-7}
    tip = np.linspace(-2e-6, 2e-6, 50)
    force = plugin.model_func(tip, **values)
    one = Experiment(
        kind="load-penetration",
        abscissa=1e-7 - tip,
        retract=np.full(50, True),
        system=plugins.system(values),
        work_of_adhesion=1e-4,
    )
    assert np.allclose(force, predict(one).ordinate, rtol=1e-9, atol=1e-18)
    assert force.min() < 0 < force.max()
    assert force[-1] == 0.0


@pytest.fixture
def curve():
    nanite = pytest.importorskip("nanite")
    source = os.environ.get("NANITE_SOURCE")
    if source is None:
        pytest.skip("NANITE_SOURCE does not name the source of nanite: xtask fetches it from PyPI")
    path = Path(source) / "examples/data/zebrafish-head-section-gray-matter.jpk-force"
    loaded = nanite.load_group(path)[0]
    loaded.apply_preprocessing(
        ["compute_tip_position", "correct_force_offset", "correct_tip_offset"]
    )
    return loaded


def fitted(curve, path, segment, **values):
    """The parameters that nanite finds on one segment, and its points."""
    from nanite.model import load_model_from_file

    model = load_model_from_file(path, register=True)
    curve.fit_properties["model_key"] = model.model_key
    curve.fit_properties["segment"] = segment
    params = curve.get_initial_fit_parameters()
    for key, value in {"R": RADIUS, "thickness": THICK, "E": 200.0, **values}.items():
        params[key].value = value
    curve.fit_model(params_initial=params, weight_cp=0, segment=segment, model_key=model.model_key)
    chosen = curve["segment"] == segment
    points = np.array(curve["tip position"][chosen]), np.array(curve["force"][chosen])
    return curve.fit_properties["params_fitted"], points


def test_an_approach_is_fitted_like_by_fit(curve):
    found, (tip, force) = fitted(curve, plugins.APPROACH, 0)
    one = Experiment(
        kind="load-penetration",
        abscissa=-tip,
        ordinate=force,
        retract=np.full(tip.shape, False),
        system=plugins.system(found.valuesdict()),
    )
    expected = fit(one, ["film_modulus", "contact_point", "baseline"])
    assert found["E"].value == pytest.approx(expected.params["film_modulus"], rel=1e-4)
    assert found["E"].stderr == pytest.approx(expected.stderr["film_modulus"], rel=1e-2)
    assert -found["contact_point"].value == pytest.approx(
        expected.params["contact_point"], rel=1e-3
    )


def jkr_force(penetration, modulus, w):
    """F(delta) of JKR on the stable branch of imposed penetration, by interpolation in a.

    Beyond the end, at a radius a, it goes on straight, with the slope from a to 1.1 a: the rule of
    the package, so that the optimum is the same.
    """
    a = np.geomspace(1e-8, RADIUS, 20_000)
    root = np.sqrt(2 * pi * w * a / modulus)
    delta = a**2 / RADIUS - root
    force = 4 * modulus * a**3 / (3 * RADIUS) - np.sqrt(8 * pi * w * modulus * a**3)
    end = delta.argmin()
    near = np.searchsorted(a, 1.1 * a[end])
    slope = (force[near] - force[end]) / (delta[near] - delta[end])
    within = np.interp(penetration, delta[end:], force[end:])
    return within + slope * np.minimum(penetration - delta[end], 0.0)


def test_a_retract_is_that_of_jkr(curve):
    """On a thick film; the points in contact are those up to the smallest force."""
    optimize = pytest.importorskip("scipy.optimize")
    start = {"work_of_adhesion": 8e-6}
    found, (tip, force) = fitted(curve, plugins.RETRACT, 1, **start)
    values = found.valuesdict()
    measured = Experiment(
        kind="load-penetration",
        abscissa=-tip,
        ordinate=force,
        retract=np.full(tip.shape, True),
        system=plugins.system(values),
        work_of_adhesion=1e-5,
    )
    words = np.array(branches(measured, ["work_of_adhesion", "contact_point", "baseline"]))
    touching = (words == "receding") & (tip <= tip[force.argmin()])
    free = words == "baseline"
    assert touching.sum() > 100
    assert free.sum() > 1000

    def residual(x):
        young, w, contact_point, baseline = x[0] * 100, x[1] ** 2 * 1e-5, x[2] * 1e-6, x[3] * 1e-10
        modulus = 1 / (1 / (young / 0.75) + 1 / 66.7e9)
        model = jkr_force(contact_point - tip[touching], modulus, w) + baseline
        return 1e10 * np.concatenate([force[touching] - model, force[free] - baseline])

    best = optimize.least_squares(residual, [2.0, 0.9, -1.0, 0.0], x_scale="jac")
    assert best.success
    assert values["E"] == pytest.approx(100 * best.x[0], rel=2e-2)
    assert values["work_of_adhesion"] == pytest.approx(1e-5 * best.x[1] ** 2, rel=2e-2)
    assert values["contact_point"] == pytest.approx(1e-6 * best.x[2], rel=2e-2)
    assert values["baseline"] == pytest.approx(1e-10 * best.x[3], rel=2e-2)


def test_a_retract_is_found_from_the_starts_of_the_parameters():
    lmfit = pytest.importorskip("lmfit")
    plugin = plugins.Plugin(retract=True)
    params = plugin.get_parameter_defaults()
    truth = {"E": 2000.0, "work_of_adhesion": 1e-4, "contact_point": 3e-8, "baseline": 2e-11}
    planned = Experiment(
        kind="load-penetration",
        abscissa=np.linspace(2e-6, -2e-6, 1000),
        retract=np.full(1000, True),
        system=plugins.system({**params.valuesdict(), **truth}),
        work_of_adhesion=truth["work_of_adhesion"],
        contact_point=-truth["contact_point"],
        baseline=truth["baseline"],
    )
    made = simulate(planned, noise=2e-11, seed=1)
    params["work_of_adhesion"].value = 1.02e-4
    found = lmfit.minimize(plugin.residual, params, args=(-made.abscissa, made.ordinate))
    for name, value in truth.items():
        assert found.params[name].stderr > 0
        assert abs(found.params[name].value - value) < 5 * found.params[name].stderr, name


def test_an_attraction_that_reaches_too_far_is_a_warning():
    """Tabor's parameter of a stiff film: (R w^2 / (E*^2 z0^3))^(1/3)."""
    pytest.importorskip("lmfit")
    plugin = plugins.Plugin(retract=True)
    params = plugin.get_parameter_defaults()
    params["E"].value, params["work_of_adhesion"].value = 1e10, 0.05

    class Data(dict):
        fit_properties = {"params_fitted": params}  # noqa: RUF012

    force = np.concatenate([np.linspace(1e-9, -2e-9, 50), np.zeros(50)])
    data = Data(force=force, segment=np.ones(100))
    with pytest.warns(UserWarning, match="Tabor's parameter is"):
        found = plugin.compute_ancillaries(data)
    modulus = 1 / (0.75 / 1e10 + 1 / 66.7e9)
    expected = (1e-5 * 0.05**2 / (modulus**2 * 2.7e-29)) ** (1 / 3)
    assert expected < 5
    assert found["tabor"] == pytest.approx(expected, rel=1e-6)
    assert found["work_of_adhesion"] == pytest.approx(2e-9 / (1.5 * pi * 1e-5))
