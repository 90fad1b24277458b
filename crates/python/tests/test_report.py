"""What results print of themselves."""

import json
import re
import subprocess
from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest

import coated_contact as cc
from conftest import make_system, without_result
from test_fit import WANTED, lens

FILM = make_system(film_thickness=3e-5)
A = np.linspace(42e-6, 130e-6, 40)


@pytest.fixture(scope="module")
def measured():
    load = cc.Table.embedded().contact(FILM).load(A, 0.04)
    load += 3e-5 + 2e-6 * np.random.default_rng(1).standard_normal(len(A))
    return cc.Experiment(
        kind="load-radius", abscissa=A, ordinate=load, system=FILM, name="lens.csv"
    )


OPTIONS = {
    "--intervals=0.95": {"profile_level": 0.95},
    "--known=film-thickness=3e-5+-1e-6": {"known": {"film_thickness": 1e-6}},
    "--robust=huber": {"loss": "huber"},
}


@pytest.mark.parametrize("flag", OPTIONS)
def test_a_fit_has_the_report_and_the_numbers_of_the_program(program, tmp_path, measured, flag):
    """All but the first line, which names the columns of a file, and the default noise."""
    given = replace(measured, noise=2e-6, abscissa_noise=3e-8)
    found = cc.fit(given, [*WANTED, "load_offset"], **OPTIONS[flag])
    path = tmp_path / "lens.csv"
    rows = zip(measured.abscissa.tolist(), measured.ordinate.tolist(), strict=True)
    path.write_text("contact_radius,load\n" + "".join(f"{a!r},{load!r}\n" for a, load in rows))
    bodies = {
        "sphere-radius": 1e-3,
        "film-modulus": 3.5e6,
        "film-poisson-ratio": 0.5,
        "film-thickness": 3e-5,
        "substrate-modulus": 2e11,
        "substrate-poisson-ratio": 0.25,
    }
    flags = [word for name, value in bodies.items() for word in (f"--{name}", repr(value))]
    command = [program, "fit", "lens.csv", *flags, "--noise=2e-6", "--abscissa-noise=3e-8"]
    command += ["--free", "sphere-modulus,work-of-adhesion,load-offset", flag]

    def run(*options):
        call = [*command, *options]
        done = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, check=True)
        return done.stdout

    own, of_program = str(found).splitlines(), run().splitlines()
    assert own[0] == "lens.csv: 40 points, load-radius"
    assert of_program[0].startswith(own[0])
    assert own[1:] == of_program[1:]
    assert str(found) == found.report
    assert "MPa" in found.report
    assert "correlation" in found.report
    # The numbers, bit for bit.
    expected = json.loads(run("--json"))
    named = expected["parameters"]
    assert found.params == {name: one["value"] for name, one in named.items()}
    assert found.stderr == {name: one["stderr"] for name, one in named.items()}
    profiles = [one.profile and list(one.profile) for one in found.estimates]
    assert profiles == [one.get("interval") for one in named.values()]
    assert found.correlation.tolist() == expected["correlation"]
    assert found.reduced_chi_squared == expected["reduced_chi_squared"]
    bare, without = found.without_film, expected["without_film"]
    assert bare.params == {name: one["value"] for name, one in without["parameters"].items()}
    of_modulus = (bare.modulus, bare.relative_error, bare.standard_errors, bare.film_matters)
    assert bare.chi_squared == without["chi_squared"]
    assert of_modulus == tuple(without["modulus"].values())
    for one, other in zip(found.fixed_values, expected["fixed_values"], strict=True):
        changes = [one.changes[name] for name in named]
        numbers = (one.quantity, one.value, "", one.step, changes, one.standard_error)
        assert numbers == tuple((other | {"unit": ""}).values())


def test_a_map_prints_a_summary():
    curves = [lens(seed=seed) for seed in range(30)]
    curves[4] = without_result(curves[4])
    found = cc.fit_map(curves, WANTED, errors="nan")
    lines = str(found).splitlines()
    assert len(lines) < 10
    assert lines[0] == "30 curves, 29 converged"
    median = np.nanmedian(found.params["work_of_adhesion"])
    assert f"median {median:.4g} " in lines[2]
    assert lines[2].endswith("J/m^2")
    assert lines[-1] == "no result: 1 curves"
    assert "nan" in str(cc.fit_map([], WANTED))


@pytest.fixture(scope="module")
def results(measured):
    contact = cc.Table.embedded().contact(FILM)
    several = [lens(seed=seed, load_offset=1e-6 * seed) for seed in range(30)]
    timed = contact.line(cc.RateDependent(slow=0.04, v0=1e-6, n=0.6), 65e-6)
    return [
        measured,
        cc.fit(measured, WANTED),
        cc.fit(measured, WANTED).experiments[0],
        cc.fit(several, [*WANTED, "load_offset"]),
        cc.fit_map(several, WANTED),
        cc.forecast(replace(measured, noise=1e-6, work_of_adhesion=0.04), WANTED),
        cc.predict(measured, WANTED),
        contact.pull_off(np.linspace(0.01, 0.1, 20)),
        contact.force_displacement(0.04, most=1e-6, points=20),
        contact.gradient(A, 0.04),
        contact.gradient(A, 0.04).by("film_modulus"),
        contact.validity(A),
        contact.zone_size(np.linspace(0.01, 0.1, 20)),
        timed.ramp("load", 1e-3, duration=1.0, tolerance=1e-3),
        cc.solve([[1.0, 2.0]], 1.75, 0.5, 1e5),
        cc.Paraboloid(radius=1e-3),
    ]


def test_every_result_shows_itself_on_one_line(results):
    for one in results:
        shown = repr(one)
        assert "\n" not in shown
        assert len(shown) < 600, shown
        assert type(one).__name__ in shown


def test_short_lines_hold_the_numbers(results):
    shown = repr(results[1])
    value = results[1].params["work_of_adhesion"]
    assert f"work_of_adhesion={value:.6g} +- " in shown
    assert "converged=True" in shown
    assert "... 32 in all" in repr(results[3])
    assert repr(results[4]) == (
        "<FitMap of 30 curves, 0 without a result: sphere_modulus, work_of_adhesion>"
    )
    assert "<40 values>" in repr(results[0])
    assert "<1 x 2 values>" in repr(results[14])
    assert "area=(24.56,), " in repr(cc.Indentation())
    assert repr(cc.Paraboloid(radius=1e-3)) == "Paraboloid(radius=0.001)"


def test_no_field_of_a_result_is_lost(results):
    for one in results:
        if is_dataclass(one) and type(one).__repr__.__qualname__.startswith("OneLine"):
            for field in fields(one):
                # What is None unless given is shown where it was given.
                lacks = field.default is None and getattr(one, field.name) is None
                shown = field.repr and not lacks
                assert bool(re.search(rf"\b{field.name}=", repr(one))) == shown
