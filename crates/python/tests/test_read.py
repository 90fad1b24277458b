"""Measurements from files of text: what is read, what the head tells, and what is refused."""

import os

import numpy as np
import pytest

from coated_contact import Elastic, Experiment, FitError, HalfSpace, fit, read_experiment
from conftest import refuses

GEL = HalfSpace(
    sphere_radius=1e-5,
    sphere_modulus=np.inf,
    solid=Elastic(young_modulus=5e3, poisson_ratio=0.5),
)

JPK = """# springConstant: 0.05
# sensitivity: 5.0E-8
# segment: extend
# columns: height vDeflection
# units: m V
3e-6 0
2e-6 1
1e-6 2

# segment: pause
# columns: height vDeflection time
# units: m V s
1e-6 2 0

# segment: retract
# columns: vDeflection height
# units: V m
1.5 1.5e-6
"""


@pytest.fixture
def write(tmp_path):
    """Write a text and return its path."""

    def written(text, name="curve.txt"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return written


def read(path, *args, **options):
    return read_experiment(path, *args, system=GEL, **options)


def test_an_export_becomes_an_experiment_with_what_its_head_tells(write):
    path = write(JPK)
    found = read(path, "force-height", work_of_adhesion=1e-4, noise=1e-11)
    assert isinstance(found, Experiment)
    assert (found.kind, found.name, found.system) == ("force-height", str(path), GEL)
    np.testing.assert_allclose(found.abscissa, [3e-6, 2e-6, 1e-6, 1.5e-6], rtol=1e-15)
    np.testing.assert_allclose(found.ordinate, [0, 2.5e-9, 5e-9, 3.75e-9], rtol=1e-15)
    assert found.retract.tolist() == [False, False, False, True]
    assert (found.stiffness, found.work_of_adhesion, found.noise) == (0.05, 1e-4, 1e-11)
    for words in ('stiffness 0.05 N/m from line 1, "springConstant"', "1 rows of a pause left out"):
        assert words in found.reading
    given = read(str(path), stiffness=0.1, sensitivity=1e-8)
    assert given.stiffness == 0.1
    np.testing.assert_allclose(given.ordinate, [0, 1e-9, 2e-9, 1.5e-9], rtol=1e-15)
    assert "as given" in given.reading
    assert read(os.fsencode(path)).name == str(path)


def test_columns_segments_and_directions_can_be_given(write):
    path = write("Tiefe (nm);Kraft (mN)\n1;0\n2;1\n3;-4\n1;0,5\n")
    columns = {"penetration": "Tiefe (nm)", "load": "-Kraft (mN)"}
    found = read(path, columns=columns)
    assert found.kind == "load-penetration"
    assert found.retract is None
    np.testing.assert_allclose(found.ordinate, [0, -1e-3, 4e-3, -0.5e-3], rtol=1e-15)
    split = read(path, columns={"penetration": "1", "load": "-2"}, segments="split")
    assert split.retract.tolist() == [False, False, False, True]
    only = read(path, columns=columns, segments="split", only="retract")
    assert only.abscissa.tolist() == [1e-9]
    bare = write("-7,9\t1,5\t1,4\n-7,8\t1,6\t1,5\n", "bare.txt")
    both = {"height": "1 [nm]", "load": ["2 extend [nN]", "3 retract [nN]"]}
    with pytest.warns(UserWarning, match=r'opposite sense; if so, give columns=\{"height": "-'):
        found = read(bare, columns=both, stiffness=1.0)
    assert found.retract.tolist() == [False, False, True, True]


def test_several_curves_and_directions_that_may_be_wrong_are_told(write):
    def rows(heights, segment):
        return "".join(f"{height},{20 - height},{segment}\n" for height in heights)

    down = range(20, 0, -1)
    head = "height,force,segment\n"
    path = write(head + 2 * (rows(down, "1_extend") + rows(down[::-1], "2_retract")))
    with pytest.warns(UserWarning, match='"height" turns back 2 times'):
        read(path, stiffness=1.0)
    path = write(head + rows([*down, *down[::-1]], "retract"))
    with pytest.warns(UserWarning, match=r'read as retract.*give segments="split"'):
        read(path, stiffness=1.0)


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        ("Depth [nm],Kraft [mN]\n1,2\n2,3\n", {}, ["Kraft", 'columns={"load": "Kraft [mN]"}']),
        (
            "Depth [nm],Kraft [mN]\n1,2\n2,3\n",
            {"kind": "load-radius"},
            ["load-radius lacks contact_radius (a length) and load", '"load": "Kraft [mN]"'],
        ),
        (
            "Depth [nm],Load [mN],Piezo [nm]\n1,2,3\n2,3,4\n",
            {},
            ['give the kind, one of "load-penetration", "force-height"'],
        ),
        ("z [nm],defl [nm]\n1,2\n2,1\n", {}, ["give stiffness=, N/m"]),
        ("z [nm],defl [V]\n1,2\n2,1\n", {"stiffness": 1.0}, ["sensitivity=, m/V"]),
        ("height,force,phase\n1,2,sideways\n2,3,sideways\n", {}, ['segments="split"', "sideways"]),
        ("penetration,load\n1,2\n2,3\n", {"columns": {"load": "P"}}, ['no column is "P"']),
        ("penetration,load\n1,2\n2,3\n", {"columns": {"lode": "P"}}, ["lode", "contact_radius"]),
        ("penetration,load\n1,2\n2,3\n", {"columns": {"load": "-"}}, ["empty"]),
        ("penetration,P\n1,2\n2,3\n", {"columns": {"load": "P [UNIT]"}}, ["in its place", "[mN]"]),
        ("Gap [nm],Load [mN]\n1,2\n2,3\n", {}, ['{"separation": "Gap [nm]"}, stiffness=']),
        ("penetration,load\n1,2\n2,3\n", {"kind": "load"}, ["'load'", "load-penetration"]),
        ("height_m,force_N\n1,2\n2,3\n", {"stiffness": 1, "sensitivity": 1e-8}, ["volts"]),
        ("penetration,load\n1,2\n2,3\n", {"segments": "up"}, ["'up'", "split"]),
        ("penetration,load\n1,2\n2,3\n", {"only": "up"}, ["'up'", "retract"]),
    ],
)
def test_what_cannot_be_read_says_what_to_give_in_the_words_of_python(write, text, options, words):
    with pytest.raises(FitError) as raised:
        read(write(text), **options)
    message = str(raised.value)
    for word in words:
        assert word in message
    assert "--" not in message


def test_a_file_that_is_not_there_is_an_os_error(tmp_path):
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "none.txt")
    refuses(TypeError, "must be a str", lambda: read(tmp_path / "none.txt", columns={"load": [2]}))


def test_forces_of_a_deflection_are_as_uncertain_as_the_spring(write):
    """The penetration does not depend on the stiffness, and Hertz's modulus follows the force."""
    stiffness, reduced = 0.05, 5e3 / 0.75
    depth = np.linspace(0, 1e-6, 40)
    deflection = 4 / 3 * reduced * np.sqrt(1e-5) * depth**1.5 / stiffness
    heights = 2e-6 - depth - deflection
    rows = "".join(
        f"{x!r},{y!r}\n" for x, y in zip(heights.tolist(), deflection.tolist(), strict=True)
    )
    path = write(f"# spring constant [N/m]: {stiffness}\nheight [m],deflection [m]\n{rows}")
    found = read(path, "force-height", noise=1e-11)
    assert found.from_deflection
    free = ["film_modulus", "contact_point"]
    result = fit(found, free, known={"stiffness": 0.1 * stiffness})
    modulus = result.params["film_modulus"]
    assert modulus == pytest.approx(5e3, rel=1e-6)
    assert result.stderr["film_modulus"] == pytest.approx(0.1 * modulus, rel=1e-2)
    refuses(
        FitError, "stiffness cannot be found.*deflection", lambda: fit(found, [*free, "stiffness"])
    )
