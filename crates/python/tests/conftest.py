"""Systems, contacts, reference data and the program `tabulate`, for all tests."""

import csv
import os
import re
import subprocess
from dataclasses import replace
from inspect import signature
from pathlib import Path

import numpy as np
import pytest

import coated_contact as cc

ROOT = Path(__file__).resolve().parents[3]
DATA = ROOT / "tests" / "data"


def make_system(
    sphere_radius=1e-3,
    sphere_modulus=2e6,
    film_modulus=3.5e6,
    film_poisson_ratio=0.5,
    film_thickness=1e-5,
    substrate_modulus=2e11,
    substrate_poisson_ratio=0.25,
):
    """By default Barthel's elastomer sphere on an elastomer film on silicon."""
    return cc.System(
        sphere_radius=sphere_radius,
        sphere_modulus=sphere_modulus,
        film=cc.Elastic(young_modulus=film_modulus, poisson_ratio=film_poisson_ratio),
        film_thickness=film_thickness,
        substrate=cc.Elastic(
            young_modulus=substrate_modulus, poisson_ratio=substrate_poisson_ratio
        ),
    )


def loads_at(system, radii, **known):
    """A plan of loads at contact radii, with 0.04 J/m^2 of adhesion unless it is given."""
    fields = {"kind": "load-radius", "work_of_adhesion": 0.04} | known
    return cc.Experiment(abscissa=radii, system=system, **fields)


def without_result(curve):
    """A curve with one load at every contact radius, which no contact has."""
    return replace(curve, ordinate=np.full(len(curve.abscissa), 1e-5))


RUBBER_ON_GLASS = {
    "title": "Rubber on glass",
    "tolerance": 1e-2,
    "a_over_t": {"from": 0.1, "to": 10},
    "e1_over_e2": 1.75,
    "nu1": 0.5,
    "e0_over_e2": 1e5,
}


@pytest.fixture(scope="session")
def system():
    return make_system()


@pytest.fixture(scope="session")
def contact(system):
    return cc.Table.embedded().contact(system)


@pytest.fixture
def axes():
    """Axes of matplotlib, without a display."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots()
    yield axes
    pyplot.close(figure)


# One of each shape, some micrometres wide.
PROBES = [
    cc.Paraboloid(radius=1e-5),
    cc.Sphere(radius=1e-5),
    cc.PowerLaw(coefficient=2e9, exponent=3),
    cc.Cone(half_angle=1.2),
    cc.RoundedCone(radius=2e-6, half_angle=1.0),
    cc.FlatPunch(radius=3e-6),
    cc.FlatEndedCone(radius=1e-6, half_angle=1.1),
    cc.Profile(points=[(r * 1e-6, r * r * 5e-8) for r in range(9)]),
]


@pytest.fixture(scope="session")
def stack():
    """An elastomer on a softer primer on silicon: tables/stacks/primer.toml."""
    primer = cc.Elastic(young_modulus=5e5, poisson_ratio=0.5)
    elastomer = cc.Elastic(young_modulus=3.5e6, poisson_ratio=0.5)
    return cc.Stack(
        base=cc.Elastic(young_modulus=2e11, poisson_ratio=0.25),
        layers=[
            cc.Layer(name="primer", material=primer, thickness=2.5e-6),
            cc.Layer(name="elastomer", material=elastomer, thickness=7.5e-6),
        ],
    )


# Names of Rust, flags of the program, and lines of a file that nobody wrote.
FOREIGN = re.compile(r"::|(?<![\w-])--?[a-z]|feature|\bline 0|tabulate (generate|solve)|lines? \d")


def in_python(words):
    """Accept words that a user of Python can follow."""
    assert not FOREIGN.search(words), words


def refuses(kind, words, call):
    """Check that a call raises an error with these words, in those of Python, and return it."""
    __tracebackhide__ = True
    with pytest.raises(kind, match=words) as caught:
        call()
    in_python(str(caught.value))
    return caught.value


def rows(name):
    """The rows of a file of reference values; words stay words."""
    with (DATA / f"{name}.csv").open() as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def system_of(row):
    """The system of a row of systems.csv."""
    return make_system(**{name: float(row[name]) for name in signature(make_system).parameters})


@pytest.fixture(scope="session")
def program():
    """The program `tabulate`."""
    program = os.environ.get("TABULATE")
    if program is None:
        pytest.skip("TABULATE does not name the program: `cargo xtask test` sets it")
    return program


@pytest.fixture(scope="session")
def printed(program):
    """Run the program and return the numbers that it prints as `name = value`."""

    def run(*arguments):
        command = [program, *map(str, arguments)]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        lines = (line.partition("=") for line in text.splitlines())
        named = {name.strip(): value.strip() for name, _, value in lines}
        named.pop("normalised_by", None)
        return {name: float(value) for name, value in named.items()}

    return run


@pytest.fixture(scope="session")
def tabulate(program, tmp_path_factory):
    """Run the program and return the rows of the CSV that it writes."""
    folder = tmp_path_factory.mktemp("tabulate")

    def run(*arguments):
        path = folder / "out.csv"
        command = [program, *map(str, arguments), "-o", str(path)]
        subprocess.run(command, check=True, capture_output=True)
        with path.open() as file:
            return [
                {name: float(value) for name, value in row.items()} for row in csv.DictReader(file)
            ]

    return run
