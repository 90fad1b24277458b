"""Fits: JKR against linear least squares, a coated contact, maps, and what is refused."""

import pickle
from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest

import coated_contact as cc
from conftest import refuses, without_result

RADIUS, MODULUS, W = 1e-3, 2e6, 0.04
WANTED = ["sphere_modulus", "work_of_adhesion"]


def jkr_load(a):
    """F = 4 E* a^3 / (3 R) - sqrt(8 pi w E* a^3)."""
    return 4 * MODULUS * a**3 / (3 * RADIUS) - np.sqrt(8 * pi * W * MODULUS * a**3)


def lens(seed, noise=2e-6, **known):
    """A JKR test on a rigid half-space."""
    rigid = cc.Elastic(young_modulus=np.inf, poisson_ratio=0.3)
    # The moduli are those of a wrong guess.
    system = cc.HalfSpace(sphere_radius=RADIUS, sphere_modulus=5e6, solid=rigid)
    a = np.linspace(50e-6, 110e-6, 40)
    load = jkr_load(a) + noise * np.random.default_rng(seed).standard_normal(len(a))
    return cc.Experiment(
        kind="load-radius", abscissa=a, ordinate=load, system=system, work_of_adhesion=0.1, **known
    )


def linear_least_squares(a, load):
    """F is linear in E* and sqrt(w E*). Returns E* and w with their covariance."""
    columns = np.stack([4 * a**3 / (3 * RADIUS), -np.sqrt(8 * pi * a**3)], axis=1)
    (modulus, root), sum_of_squares, *_ = np.linalg.lstsq(columns, load)
    variance = sum_of_squares[0] / (len(a) - 2)
    w = root**2 / modulus
    jacobian = np.array([[1.0, 0.0], [-w / modulus, 2 * root / modulus]])
    covariance = variance * np.linalg.inv(columns.T @ columns)
    return [modulus, w], jacobian @ covariance @ jacobian.T


def test_jkr_is_linear_least_squares():
    one = lens(seed=1)
    found = cc.fit(one, WANTED)
    values, covariance = linear_least_squares(one.abscissa, one.ordinate)
    assert found.converged
    assert list(found.params) == list(found.stderr) == WANTED
    assert list(found.params.values()) == pytest.approx(values, rel=1e-7)
    assert found.covariance == pytest.approx(covariance, rel=1e-5)
    assert found.stderr["work_of_adhesion"] == pytest.approx(sqrt(covariance[1, 1]), rel=1e-5)
    (points,) = found.experiments
    assert points.noise_is_estimated
    assert found.degrees_of_freedom == 38
    residuals = one.ordinate - points.fit
    assert np.array_equal(points.residual, residuals)
    assert points.noise == pytest.approx(sqrt(np.sum(residuals**2) / 38), rel=1e-6)
    assert np.array_equal(points.contact_radius, one.abscissa)
    assert set(points.branch) == {"advancing"}


def test_many_experiments_with_offsets_of_their_own_are_linear_least_squares():
    count, noise = 12, 2e-6
    offsets = 1e-5 * np.cos(np.arange(count))
    several = [lens(seed=seed, noise=noise) for seed in range(count)]
    several = [
        replace(one, ordinate=one.ordinate + offset, noise=noise)
        for one, offset in zip(several, offsets, strict=True)
    ]
    found = cc.fit(several, [*WANTED, "load_offset"])
    a, load = (
        np.concatenate([getattr(one, name) for one in several]) for name in ("abscissa", "ordinate")
    )
    shared = [4 * a**3 / (3 * RADIUS), -np.sqrt(8 * pi * a**3)]
    own = np.repeat(np.eye(count), 40, axis=0)
    columns = np.column_stack([*shared, own])
    (modulus, root, *others), *_ = np.linalg.lstsq(columns, load)
    assert list(found.params.values()) == pytest.approx(
        [modulus, root**2 / modulus, *others], rel=1e-6
    )
    errors = noise * np.sqrt(np.diag(np.linalg.inv(columns.T @ columns)))
    stderr = np.array(list(found.stderr.values()))
    assert stderr[0] == pytest.approx(errors[0], rel=1e-11)
    assert stderr[2:] == pytest.approx(errors[2:], rel=1e-11)
    residuals = load - columns @ [modulus, root, *others]
    assert found.chi_squared == pytest.approx(np.sum((residuals / noise) ** 2), rel=1e-13)


def test_experiments_share_a_parameter():
    both = [lens(seed=1, name="first"), lens(seed=2, name="second")]
    free = [cc.Free(parameter="sphere_modulus"), cc.Free(parameter="work_of_adhesion", own=True)]
    found = cc.fit(both, free)
    assert found.names == ("sphere_modulus", "work_of_adhesion[0]", "work_of_adhesion[1]")
    assert [points.name for points in found.experiments] == ["first", "second"]
    alone = [cc.fit(one, WANTED).params["sphere_modulus"] for one in both]
    assert min(alone) < found.params["sphere_modulus"] < max(alone)


def test_wishes_are_heard():
    one = lens(seed=3)
    bounded = cc.Free(parameter="sphere_modulus", start=2.5e6, bounds=(2.2e6, 3e6))
    found = cc.fit(one, [bounded, "work_of_adhesion"])
    assert found.params["sphere_modulus"] == pytest.approx(2.2e6, rel=1e-3)
    texts = {warning.kind: warning.text for warning in found.warnings}
    assert texts["at-bound"].startswith("sphere_modulus = ")
    known = cc.Free(parameter="sphere_modulus", prior=(3e6, 1.0))
    found = cc.fit(one, [known, "work_of_adhesion"])
    assert found.params["sphere_modulus"] == pytest.approx(3e6, rel=1e-4)
    # One point far off moves least squares, and hardly Huber's loss.
    loads = one.ordinate.copy()
    loads[20] += 1e-3
    spoilt = replace(one, ordinate=loads)
    errors = [
        abs(cc.fit(spoilt, WANTED, loss=loss).params["work_of_adhesion"] / W - 1)
        for loss in ("squares", "huber", "soft-l1")
    ]
    assert errors[1] < 0.2 * errors[0]
    assert errors[2] < 0.2 * errors[0]


def test_a_map_is_many_fits():
    curves = [lens(seed=seed, noise=1e-6 * (1 + seed % 5)) for seed in range(150)]
    found = cc.fit_map(curves, WANTED)
    assert len(found) == 150
    for i in (0, 1, 63, 64, 149):
        one = cc.fit(curves[i], WANTED)
        assert {name: values[i] for name, values in found.params.items()} == one.params
        assert {name: values[i] for name, values in found.stderr.items()} == one.stderr
        assert np.array_equal(found.covariance[i], one.covariance)
        assert found.chi_squared[i] == one.chi_squared
        assert found.warnings[i] == one.warnings
    assert found.converged.all()
    # The true values lie within two standard errors in some 95 of 100 fits.
    within = np.abs(found.params["sphere_modulus"] - MODULUS) < 2 * found.stderr["sphere_modulus"]
    assert 0.88 < within.mean() < 0.995


def test_a_curve_without_a_result():
    curves = [lens(seed=seed) for seed in range(3)]
    curves[1] = without_result(curves[1])
    with pytest.raises(cc.ContactError) as caught:
        cc.fit_map(curves, WANTED)
    assert caught.value.index == (1,)
    found = cc.fit_map(curves, WANTED, errors="nan")
    assert list(found.failures) == [1]
    assert type(found.failures[1]) is type(caught.value)
    assert np.isnan(found.params["sphere_modulus"]).tolist() == [False, True, False]
    assert np.isnan(found.covariance).all(axis=(1, 2)).tolist() == [False, True, False]
    assert found.converged.tolist() == [True, False, True]
    assert cc.fit_map([], WANTED).params["sphere_modulus"].shape == (0,)
    again = pickle.loads(pickle.dumps(found))
    assert isinstance(again, cc.FitMap)
    assert np.array_equal(again.covariance, found.covariance, equal_nan=True)


def test_what_cannot_be_used_is_named():
    one = lens(seed=1)
    a, load = one.abscissa.copy(), one.ordinate.copy()
    load[3] = np.nan
    bad = cc.Experiment(
        kind="load-radius", abscissa=a, ordinate=load, system=one.system, name="lens"
    )
    error = refuses(cc.FitError, "lens, point 3: load", lambda: cc.fit(bad, WANTED))
    assert error.axis == "load"
    refuses(cc.FitError, "at least one", lambda: cc.fit(one, []))
    refuses(cc.FitError, "parameter = 'colour' cannot be used", lambda: cc.fit(one, ["colour"]))
    refuses(cc.FitError, "loss = 'cubes'", lambda: cc.fit(one, WANTED, loss="cubes"))
    with pytest.raises(cc.FitError, match="kind = 'load'"):
        cc.Experiment(kind="load", abscissa=a, ordinate=load, system=one.system)
    with pytest.raises(cc.FitError, match="as long"):
        cc.Experiment(kind="load-radius", abscissa=a, ordinate=load[1:], system=one.system)
    with pytest.raises(TypeError, match="retract must be True or False"):
        cc.Experiment(kind="load-radius", abscissa=a, ordinate=load, retract=a, system=one.system)
    with pytest.raises(TypeError, match="ordinate must be real"):
        cc.Experiment(kind="load-radius", abscissa=a, ordinate=["x"] * 40, system=one.system)
    refuses(TypeError, "a list of parameters", lambda: cc.fit(one, "film_modulus"))
    refuses(TypeError, "must be an Experiment", lambda: cc.fit([3], WANTED))


def test_an_experiment_does_not_change():
    a = np.linspace(50e-6, 110e-6, 40)
    one = cc.Experiment(
        kind="load-radius", abscissa=a, ordinate=jkr_load(a), system=lens(seed=1).system
    )
    a[0] = 1.0
    assert one.abscissa[0] == 50e-6
    with pytest.raises(ValueError, match="read-only"):
        one.abscissa[0] = 1.0
    with pytest.raises(AttributeError):
        one.noise = 1.0


def test_numbers_that_no_experiment_has_are_refused_unless_they_are_allowed():
    one = lens(seed=1)
    large = replace(one, system=replace(one.system, probe=cc.Paraboloid(radius=2.0)))
    with pytest.raises(cc.FitError, match=r"radius of the sphere = 2 m is above 0.1 m") as caught:
        cc.fit(large, WANTED)
    assert caught.value.value == 2.0
    assert 'allow=("magnitudes",)' in str(caught.value)
    assert "--" not in str(caught.value)
    assert cc.fit(large, WANTED, allow=["magnitudes"]).converged
    # Loads in mN: a work of adhesion that no two solids have.
    loads = replace(one, ordinate=1e3 * one.ordinate)
    with pytest.raises(cc.FitError, match=r"mN were probably taken for N|mN or uN taken for N"):
        cc.fit(loads, WANTED)
    curves = cc.fit_map([one, loads], WANTED, errors="nan")
    assert list(curves.failures) == [1]
    assert np.isnan(curves.params["sphere_modulus"][1])
    refuses(cc.FitError, "magnitudes", lambda: cc.fit(one, WANTED, allow=["everything"]))


def test_young_s_modulus_of_the_sphere_follows_from_the_reduced_one():
    found = cc.fit(lens(1), WANTED)
    (young,) = found.young_modulus_of_sphere(0.5)
    assert young.parameter == "sphere_young_modulus"
    assert young.value == 0.75 * found.params["sphere_modulus"]
    assert young.standard_error == 0.75 * found.stderr["sphere_modulus"]
    refuses(cc.FitError, r"poisson_ratio = 0\.6", lambda: found.young_modulus_of_sphere(0.6))
    with pytest.raises(cc.FitError, match='free "sphere_modulus"'):
        cc.fit(lens(1), ["work_of_adhesion"]).young_modulus_of_sphere(0.5)


def test_experiments_of_one_name_are_told_apart():
    several = [lens(seed=1), replace(lens(seed=2), name="other"), lens(seed=3)]
    found = cc.fit(several, WANTED)
    names = ["experiment 0", "other", "experiment 2"]
    assert [one.name for one in found.experiments] == names
    below = replace(several[2], abscissa=-several[2].abscissa)
    wrong = [replace(one, noise=2e-6) for one in (*several[:2], below)]
    for call in (cc.fit, cc.log_likelihood):
        refuses(cc.FitError, "experiment 2, point 0", lambda call=call: call(wrong, WANTED))
    plan = [*wrong[:2], several[2]]
    refuses(cc.FitError, "noise of experiment 2", lambda: cc.forecast(plan, WANTED))


def test_an_error_of_a_calibration_is_one_of_the_values_found():
    found = cc.fit(lens(seed=1), WANTED, known={"contact_radius": 0.01})
    row = next(one for one in found.fixed_values if one.quantity == "contact_radius")
    modulus = "sphere_modulus"
    assert row.value == 1.0
    assert -0.045 < row.changes[modulus] / found.params[modulus] < -0.03
    assert found.stderr[modulus] > abs(row.changes[modulus])


def test_fixed_values_are_left_out_or_refused():
    assert cc.fit(lens(seed=1), WANTED, fixed_values=False).fixed_values == ()
    refuses(
        cc.FitError, "not free", lambda: cc.fit(lens(seed=1), WANTED, known={"sphere_modulus": 1e4})
    )
    refuses(
        cc.FitError, "sphere_radius", lambda: cc.fit(lens(seed=1), WANTED, known={"sphere": 1e4})
    )
    # Loads at radii do not know where the contact begins, and maps have no intervals.
    point, words = {"contact_point": 1e-7}, "known contact_point .* has an effect"
    refuses(cc.FitError, words, lambda: cc.fit(lens(seed=1), WANTED, known=point))
    levels = {"profile_level": 0.95}
    refuses(TypeError, "profile_level", lambda: cc.fit_map([lens(seed=1)], WANTED, **levels))


def test_fixed_values_that_differ_are_all_told():
    one = lens(seed=1)
    wide = replace(one.system, sphere_radius=2 * RADIUS)
    load = one.ordinate - 2 * MODULUS * one.abscissa**3 / (3 * RADIUS)
    found = cc.fit([one, replace(one, system=wide, ordinate=load)], WANTED)
    (radius,) = (fixed for fixed in found.fixed_values if fixed.quantity == "sphere_radius")
    assert radius.values == (RADIUS, 2 * RADIUS)
    assert radius.value == RADIUS
    assert cc.fit(one, WANTED).fixed_values[0].values == ()


def test_a_forecast_of_no_adhesion_is_refused_where_it_is_free():
    plan = replace(lens(1), ordinate=None, work_of_adhesion=0.0, noise=1e-6)
    with pytest.raises(
        cc.FitError, match=r"work_of_adhesion of .* must be positive where it is free"
    ):
        cc.forecast(plan, WANTED)
    expected = cc.forecast(replace(plan, work_of_adhesion=0.04), WANTED)
    assert np.isfinite(expected.stderr["work_of_adhesion"])


def test_what_is_no_noise_of_the_abscissae_is_refused():
    with pytest.raises(
        cc.FitError, match="abscissa_noise must be one number or one for each point"
    ):
        lens(seed=1, abscissa_noise=[1e-7, 1e-7])
    refuses(
        cc.FitError, "contact radius", lambda: cc.fit(lens(seed=1, abscissa_noise=-1e-7), WANTED)
    )
    # One number for each point is the same as one for all.
    both = replace(lens(seed=1, abscissa_noise=3e-7), noise=2e-6)
    each = replace(both, noise=np.full(40, 2e-6), abscissa_noise=np.full(40, 3e-7))
    assert cc.fit(each, WANTED).params == cc.fit(both, WANTED).params
    # A simulation adds it: 40 numbers, whose root mean square is known to 11 %.
    off = (cc.simulate(both, noise=0.0, seed=1).abscissa - both.abscissa) / 3e-7
    assert np.sqrt(np.mean(off**2)) == pytest.approx(1, abs=0.45)
