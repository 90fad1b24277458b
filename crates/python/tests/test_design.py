"""The plan that tells most about a parameter."""

from dataclasses import replace

import numpy as np
import pytest

from coated_contact import FitError, Free, HalfSpace, Table, design, forecast
from conftest import loads_at, refuses

FREE = ["film_modulus", "work_of_adhesion"]


def lens(system, largest=1.2e-4, **known):
    return loads_at(system, np.linspace(3e-5, largest, 30), **{"noise": 2e-6} | known)


def test_the_errors_are_those_of_the_forecasts_best_first(system):
    plans = {"small": lens(system, 6e-5), "large": lens(system), "noisy": lens(system, noise=8e-6)}
    found = design(plans, FREE, about="film_modulus")
    expected = {name: forecast(plan, FREE).stderr["film_modulus"] for name, plan in plans.items()}
    assert found.stderr == expected
    assert list(found.stderr) == sorted(expected, key=expected.get) == list(found.forecasts)
    assert found.best == "large"
    assert found.repeats["large"] == 1
    # Errors grow in proportion to the noise, and fall with the root of the repeats.
    assert found.repeats["noisy"] == pytest.approx(16, rel=1e-6)
    twice = design([[plans["large"]] * 2, plans["large"]], FREE, about="film_modulus")
    assert twice.best == "plan 0"
    assert twice.repeats["plan 1"] == pytest.approx(2, rel=1e-6)
    same = design(plans, FREE, about="film_modulus", table=Table.embedded())
    assert same.stderr == found.stderr


def test_another_question_may_have_another_answer(system):
    """Small contacts tell adhesion, large ones the film."""
    plans = {"small": lens(system, 5e-5), "large": lens(system, 1.5e-4)}
    plans["small"] = replace(plans["small"], noise=5e-7)
    answers = {one: design(plans, FREE, about=one).best for one in FREE}
    assert answers == {"film_modulus": "large", "work_of_adhesion": "small"}


def test_what_is_shown(system, axes):
    plans = {"small": lens(system, 6e-5), "large": lens(system)}
    found = design(plans, FREE, about="film_modulus")
    first, best, other = str(found).splitlines()
    assert first == "standard error of film_modulus, and repeats to match the best"
    assert best.split()[0] == "large"
    assert best.endswith("Pa  1")
    assert other.split()[0] == "small"
    assert "<td>large</td>" in found._repr_html_()
    assert found.plot(axes) is axes
    assert [text.get_text().strip() for text in axes.texts] == ["large", "small"]
    assert axes.get_xscale() == "log"


def test_a_plan_that_does_not_tell_it_is_the_last(system, axes):
    """Contacts of one radius do not tell two parameters."""
    flat = replace(lens(system), abscissa=np.full(30, 1e-4))
    found = design({"flat": flat, "lens": lens(system)}, FREE, about="film_modulus")
    assert list(found.stderr) == ["lens", "flat"]
    assert found.stderr["flat"] == found.repeats["flat"] == np.inf
    found.plot(axes)
    assert [text.get_text() for text in axes.texts] == [" lens", " flat: not determined"]
    with pytest.raises(FitError, match="no plan determines film_modulus"):
        design([flat], FREE, about="film_modulus")


def test_wrong_calls_say_what_to_give(system):
    plans = {"lens": lens(system)}
    for none in ({}, []):
        with pytest.raises(FitError, match="there is no plan: give one experiment or more"):
            design(none, FREE, about="film_modulus")
    with pytest.raises(FitError, match="'film-modulus' cannot be used: give one of") as raised:
        design(plans, FREE, about="film-modulus")
    assert '"film_modulus"' in str(raised.value)
    with pytest.raises(FitError, match="'film_thickness' is not free in the plan 'lens'"):
        design(plans, FREE, about="film_thickness")
    refuses(TypeError, "several", lambda: design(plans["lens"], FREE, about="film_modulus"))
    with pytest.raises(TypeError, match="must be an Experiment"):
        design({"lens": [3]}, FREE, about="film_modulus")
    with pytest.raises(TypeError, match="list of parameters"):
        design(plans, "film_modulus", about="film_modulus")
    # The plan is named whose experiment lacks what is free.
    half_space = HalfSpace(sphere_radius=1e-3, sphere_modulus=2e6, solid=system.film)
    plans["bulk"] = lens(half_space)
    with pytest.raises(FitError, match="no thickness") as raised:
        design(plans, [*FREE, "film_thickness"], about="film_modulus")
    assert raised.value.__notes__ == ["plan 'bulk'"]
    with pytest.raises(FitError, match="noise") as raised:
        design({"quiet": lens(system, noise=None)}, FREE, about="film_modulus")
    assert raised.value.__notes__ == ["plan 'quiet'"]


def test_each_experiments_own_parameter_has_its_number(system):
    pair = [lens(system), lens(system, 6e-5)]
    free = ["film_modulus", Free(parameter="load_offset", own=True)]
    found = design([pair], free, about="load_offset[1]")
    assert found.stderr == {"plan 0": forecast(pair, free).stderr["load_offset[1]"]}
    with pytest.raises(FitError, match=r"give one of film_modulus, load_offset\[0\]"):
        design([pair], free, about="load_offset")


def test_what_one_experiment_does_not_tell_is_not_told_of_others(system):
    """Names of parameters and experiments that contain one another are not confused."""
    depths = np.linspace(1e-6, 1e-5, 20)
    one = replace(lens(system, noise=1e-9), kind="load-penetration", abscissa=depths)
    noisy = replace(one, noise=1e-2, name="a film_modulus, work-of-adhesion")
    pair, free = [one, noisy], [*FREE, "contact_point"]
    expected = forecast(pair, free)
    assert expected.undetermined == (f"contact-point of {noisy.name}",)
    for about in (*FREE, "contact_point[0]"):
        assert design([pair], free, about=about).stderr == {"plan 0": expected.stderr[about]}
    with pytest.raises(FitError, match=r"no plan determines contact_point\[1\]: contact-point of"):
        design([pair], free, about="contact_point[1]")
