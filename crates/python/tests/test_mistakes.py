"""What a user gives by mistake, and would not notice in the numbers."""

from dataclasses import asdict, replace
from math import inf

import numpy as np
import pytest

import coated_contact as cc
from conftest import loads_at, make_system, refuses

LENS = loads_at(make_system(), np.linspace(4e-5, 1.2e-4, 30), noise=2e-6)
WANTED = ["film_modulus", "work_of_adhesion"]
TEN_METRES = replace(LENS, system=make_system(film_thickness=10.0))


class Quantity:
    """A number with a unit, as packages of units have them."""

    def __init__(self, value, unit):
        self._value, self._unit = value, unit

    @property
    def units(self):
        return self._unit

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self._value, dtype=float)


CASES = {
    "a unit": (TypeError, "SI", lambda: replace(make_system(), film_thickness=Quantity(10, "um"))),
    "metres": (cc.FitError, "10 m is above", lambda: cc.simulate(TEN_METRES, noise=2e-6, seed=1)),
    "a plan in metres": (cc.FitError, "10 m is above", lambda: cc.forecast(TEN_METRES, WANTED)),
    "no friction": (cc.InputError, "stick", lambda: replace(LENS, advancing=0.3)),
    "two works with friction": (
        cc.FitError,
        "work_of_adhesion_receding has no effect.*advancing",
        lambda: replace(LENS, friction="stick", work_of_adhesion_receding=0.1),
    ),
    "no friction, solved": (
        cc.InputError,
        "stick",
        lambda: cc.SolvedCurve(a_over_t=(0.1, 20), sphere_poisson_ratio=0.3),
    ),
    "ends in no order": (
        cc.InputError,
        "below the second",
        lambda: cc.SolvedCurve(a_over_t=(2, 0.01)),
    ),
    "a line that costs less": (
        cc.InputError,
        "1e-05 is below the advancing one = 5e-05",
        lambda: cc.Hysteresis(advancing=5e-5, receding=1e-5),
    ),
    "a scene with another key": (
        cc.TableError,
        "the scene: unknown field `accuracy`",
        lambda: cc.generate({"title": "x", "accuracy": 1e-3}, progress=False),
    ),
    "a range with another key": (
        cc.TableError,
        'the scene: "nu1": unknown field `too`',
        lambda: cc.generate({"title": "x", "nu1": {"from": 0.1, "too": 2}}, progress=False),
    ),
    "a masked direction": (
        TypeError,
        "masked",
        lambda: replace(LENS, retract=np.ma.array([True] * 30, mask=[False] * 29 + [True])),
    ),
    "a word for yes": (TypeError, "reference", lambda: cc.Indentation(reference="no")),
    "a word for own": (TypeError, "own", lambda: cc.Free(parameter="load_offset", own="no")),
    "a number for a name": (TypeError, "name must be a str", lambda: replace(LENS, name=7)),
    "the path of a table": (TypeError, "read", lambda: cc.fit(LENS, WANTED, table="paper.bin")),
    "no table": (TypeError, "False", lambda: cc.forecast(LENS, WANTED, table=False)),
    "starts in a mapping": (TypeError, "Free", lambda: cc.fit(LENS, {"film_modulus": 1e6})),
    "a mapping of derivatives": (
        TypeError,
        "by must",
        lambda: cc.predict(LENS, {"film_modulus": 1}),
    ),
    "one word": (TypeError, "list of words", lambda: cc.fit(LENS, WANTED, allow="magnitudes")),
    "a rigid sphere": (cc.InputError, "inf", lambda: replace(make_system(), sphere_modulus=1e40)),
}


@pytest.mark.parametrize("case", CASES)
def test_a_mistake_is_refused(case):
    error, words, call = CASES[case]
    refuses(error, words, call)


def test_a_large_magnitude_may_be_meant():
    assert cc.forecast(TEN_METRES, WANTED, allow=["magnitudes"]).stderr["film_modulus"] > 0
    plans = {"one": TEN_METRES, "other": TEN_METRES}
    assert cc.design(plans, WANTED, about="film_modulus", allow=["magnitudes"]).stderr["one"] > 0


def test_the_rigid_bodies_of_a_history_are_its_own():
    soft = cc.Elastic(young_modulus=1e6, poisson_ratio=0.25)
    gel = replace(make_system(film_modulus=1e4), sphere_radius=1e-5, substrate=soft)
    rigid = cc.Elastic(young_modulus=inf, poisson_ratio=0.25)

    def history(beside):
        contact = cc.Table.embedded().contact(gel)
        law = cc.Relaxation.power_law(0.2)
        return contact.history([0, 1, 2], law, penetration=[0, 1e-7, 0], rigid=beside)

    def between_rigid(system):
        return cc.Table.embedded().contact(replace(system, sphere_modulus=inf, substrate=rigid))

    assert history(between_rigid(gel)).unlike_bodies > 1e-4
    for other in [
        cc.Table.embedded().contact(gel),
        between_rigid(replace(gel, film_thickness=1e-3)),
        between_rigid(replace(gel, probe=cc.Cone(half_angle=1.0))),
    ]:
        refuses(cc.InputError, "same film, thickness and probe", lambda other=other: history(other))
    refuses(TypeError, "rigid must be the Contact", lambda: history(True))
    refuses(TypeError, "rigid must be the Contact", lambda: history(gel))


def test_a_stack_relaxes_all_by_one_law():
    layers = [cc.Layer(material=make_system().film, thickness=1e-5)] * 2
    stack = cc.Stack(base=cc.Elastic(young_modulus=inf, poisson_ratio=0.3), layers=layers)
    contact = stack.contact(sphere_radius=1e-5, sphere_modulus=inf, a_over_t=(1e-3, 1))
    law, program = cc.Relaxation.power_law(0.2), {"penetration": [0, 1e-7, 0]}
    assert contact.history([0, 1, 2], law, **program).unlike_bodies == 0.0
    together = "relax all by one law"
    refuses(
        cc.InputError, together, lambda: contact.history([0, 1, 2], law, **program, rigid=contact)
    )


def test_results_keep_no_array_of_the_caller():
    x = np.array([0.1, 1.0])
    solution = cc.solve(x, 1.75, 0.5, 1e5)
    contact = cc.Table.embedded().contact(make_system())
    ranges = np.array([1e-10, 1e-9])
    size = contact.zone_size(0.04, interaction_range=ranges)
    radii = np.array([5e-5, 6e-5])
    validity = contact.validity(radii)
    before = size.pull_off_error(), validity.friction()
    for array in (x, ranges, radii):
        array *= 3
    assert solution.to_pandas()["a_over_t"].tolist() == [0.1, 1.0]
    assert (size.pull_off_error() == before[0]).all()
    assert (validity.friction() == before[1]).all()


def test_a_fit_ends_within_its_bounds():
    measured = cc.simulate(LENS, noise=2e-6, seed=1)
    for least in np.geomspace(4e6, 1e8, 40):
        bounds = (least, 2 * least)
        free = [cc.Free(parameter="film_modulus", bounds=bounds), "work_of_adhesion"]
        found = cc.fit(measured, free, fixed_values=False, allow=["left-out"])
        assert bounds[0] <= found.params["film_modulus"] <= bounds[1]


def test_commas_that_may_part_thousands_are_told(tmp_path):
    def reading(rows):
        file = tmp_path / "lens.csv"
        file.write_text("Contact radius (um)\tLoad (uN)\n" + rows)
        return cc.read_experiment(file, system=make_system()).reading

    with pytest.warns(UserWarning, match="if the commas part thousands"):
        reading("41,250\t-190\n52,300\t-150\n63,410\t-80\n")
    assert "commas are decimal" in reading("41,25\t-190\n52,30\t-150\n63,41\t-80\n")


def test_a_bool_of_numpy_is_one():
    assert replace(LENS, all_relax=np.True_, from_deflection=np.False_).all_relax is True
    assert cc.Free(parameter="load_offset", own=np.True_).own is True


def test_objects_are_written_as_dictionaries():
    assert asdict(make_system())["probe"] == {"radius": 1e-3}
    assert asdict(LENS)["system"]["film_thickness"] == 1e-5


@pytest.mark.parametrize("work_of_adhesion", [0.0, 1e-5])
def test_heights_of_the_opposite_sense_are_named(work_of_adhesion):
    """Positions of the piezo grow towards the sample, and heights fall."""
    gel = make_system(sphere_radius=5e-6, sphere_modulus=inf, film_modulus=2e3, film_thickness=5e-6)
    heights = np.linspace(1e-6, -4e-7, 300)
    plan = cc.Experiment(
        kind="force-height",
        abscissa=np.r_[heights, heights[::-1]],
        retract=np.repeat([False, True], 300),
        system=gel,
        stiffness=0.05,
        work_of_adhesion=work_of_adhesion,
    )
    free = ["film_modulus", "contact_point", "baseline"]
    free += ["work_of_adhesion"] if work_of_adhesion else []
    measured = cc.simulate(plan, noise=2e-11, seed=1)

    def doubts(experiment):
        try:
            return [warning.text for warning in cc.fit(experiment, free).warnings]
        except cc.FitError as error:
            return [str(error)]

    assert not any("opposite sense" in text for text in doubts(measured))
    turned = replace(measured, abscissa=-measured.abscissa)
    assert any("the abscissa may count in the opposite sense" in text for text in doubts(turned))
