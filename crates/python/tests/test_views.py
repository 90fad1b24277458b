"""Results as tables of pandas and xarray, and as drawings."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

import coated_contact as cc
from coated_contact._fit_plot import Curve
from conftest import PROBES, loads_at, make_system, refuses, without_result
from test_fit import WANTED, lens
from test_indentation import system as oxide


@pytest.fixture(scope="module")
def curve(contact):
    return contact.force_displacement(0.04, most=1e-6, points=20)


def test_a_force_curve_is_a_table(curve):
    pytest.importorskip("pandas")
    table = curve.to_pandas()
    assert len(table) == 20 * (len(curve.loading) + len(curve.unloading))
    first = table[(table.direction == "unloading") & (table.branch == 0)]
    assert np.array_equal(first.load, curve.unloading[0].load)
    pytest.importorskip("xarray")
    data = curve.to_xarray()
    assert np.array_equal(data["load"], table.load)
    assert data["penetration"].attrs["units"] == "m"


def test_every_branch_of_a_force_curve_has_its_rows():
    pytest.importorskip("pandas")
    one, two, three = (cc.States(*np.full((3, 2), value)) for value in (1.0, 2.0, 3.0))
    table = cc.ForceDisplacement(loading=(one, two), unloading=(three,), jumps=()).to_pandas()
    assert table.load.tolist() == [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]
    assert table.branch.tolist() == [0, 0, 1, 1, 0, 0]


@pytest.fixture(scope="module")
def many(contact):
    """Results that are columns of one shape, and what is drawn of them."""
    timed = contact.line(cc.RateDependent(slow=0.04, v0=1e-6, n=0.6), 65e-6)
    system = replace(contact.system, probe=cc.Paraboloid(radius=1e-5))
    cohesive = cc.Cohesive(system=system, work_of_adhesion=0.04, interaction_range=1e-8)
    return [
        (contact.pull_off(np.linspace(0.01, 0.1, 20)), "penetration"),
        (contact.cohesive_zone(0.04, stress=1e8).state([[5e-5, 6e-5, 7e-5]]), "penetration"),
        (cohesive.branch((1e-6, 2e-6), 3), "penetration"),
        (timed.ramp("load", 1e-3, duration=1.0, tolerance=1e-3), "time"),
    ]


def test_columns_are_tables(many):
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    for found, _ in many:
        table, data = found.to_pandas(), found.to_xarray()
        for name in table.columns:
            assert np.array_equal(table[name], getattr(found, name).ravel())
            assert np.array_equal(data[name], getattr(found, name))
        assert data["load"].attrs["units"] == "N"
        shown = found._repr_html_()
        assert "<th>load (N)</th>" in shown
        assert f"<td>{found.load.ravel()[0]:.6g}</td>" in shown
    assert "8 more" in many[0][0]._repr_html_()
    assert many[3][0].to_xarray()["load"].dims == ("time",)


def test_columns_are_drawn(many, axes):
    for found, abscissa in many:
        axes.clear()
        assert found.plot(axes) is axes
        (line,) = axes.get_lines()
        assert np.array_equal(line.get_xdata(), getattr(found, abscissa).ravel())
        assert np.array_equal(line.get_ydata(), found.load.ravel())
        assert axes.get_xlabel().startswith(abscissa)


def test_a_solution_is_a_table_and_drawn(axes):
    pytest.importorskip("pandas")
    x, nu1 = np.geomspace(0.1, 10, 5)[:, None], np.array([0.3, 0.5])
    solution = cc.solve(x, 1.75, nu1, 1e5)
    table = solution.to_pandas()
    assert np.array_equal(table.eeq, solution.eeq.ravel())
    assert table.nu1.tolist() == [0.3, 0.5] * 5
    solution.plot(axes)
    lines = axes.get_lines()
    assert [line.get_label() for line in lines] == ["pi0", "eeq", "gamma", "delta0"]
    assert np.array_equal(lines[1].get_ydata(), solution.eeq.ravel())
    assert axes.get_xlabel() == "a_over_t"
    assert f"<td>{solution.eeq[0, 0]:.6g}</td>" in solution._repr_html_()
    refuses(ValueError, "single numbers", lambda: cc.solve(1.0, 1.75, 0.5, 1e5).plot(axes))


def test_fits_are_tables():
    pytest.importorskip("pandas")
    one = lens(seed=1)
    found = cc.fit(one, WANTED)
    table = found.experiments[0].to_pandas()
    assert np.array_equal(table.residual, one.ordinate - table.fit)
    predicted = cc.predict(one, WANTED)
    table = predicted.to_pandas()
    assert np.array_equal(table.by_sphere_modulus, predicted.derivatives["sphere_modulus"])
    pytest.importorskip("xarray")
    several = cc.fit_map([lens(seed=seed) for seed in range(3)], WANTED)
    table, data = several.to_pandas(), several.to_xarray()
    assert table.index.name == "curve"
    for columns in (table, data):
        errors = columns["work_of_adhesion_stderr"]
        assert np.array_equal(errors, several.stderr["work_of_adhesion"])
    assert data["sphere_modulus"].attrs["units"] == "Pa"
    shown = cc.forecast(replace(one, noise=1e-6), WANTED)._repr_html_()
    assert "expected error" in shown
    assert "work_of_adhesion" in shown


def test_notebooks_show_a_force_curve(curve):
    shown = curve._repr_html_()
    assert shown.count("<tr>") == 1 + len(curve.loading) + len(curve.unloading)
    assert f"<td>{curve.unloading[0].load[-1]:.6g}</td>" in shown


def test_a_force_curve_is_drawn(curve, axes):
    assert curve.plot(axes) is axes
    lines = axes.get_lines()
    assert len(lines) == len(curve.loading) + len(curve.unloading) + len(curve.jumps)
    assert np.array_equal(lines[0].get_ydata(), curve.loading[0].load)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("penetration (m)", "load (N)")
    assert legend(axes) == ["loading", "unloading"]


def test_a_fit_is_drawn(axes):
    found = cc.fit(lens(seed=1), WANTED)
    assert found.plot(axes) is axes
    points, line = axes.get_lines()
    assert np.array_equal(points.get_ydata(), found.experiments[0].ordinate)
    assert np.array_equal(line.get_ydata(), found.experiments[0].fit)
    assert points.get_color() != line.get_color()
    assert legend(axes) == ["data", "fit"]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("contact radius (m)", "load (N)")
    # The numbers have the prefixes, and are right on any scale and beside other drawings.
    assert axes.xaxis.get_major_formatter()(60e-6) == "60 µ"
    assert axes.yaxis.get_major_formatter()(-1.5e-4) == "\N{MINUS SIGN}150 µ"


@pytest.mark.parametrize(
    ("kind", "abscissa", "label"),
    [
        ("stiffness-radius", np.linspace(4e-8, 9e-7, 20), "contact radius (m)"),
        ("stiffness-load", np.linspace(1e-5, 1e-3, 20), "load (N)"),
        ("stiffness-depth", np.linspace(4e-8, 2.5e-7, 20), "depth (m)"),
    ],
)
def test_a_fit_of_contact_stiffness_is_drawn(axes, kind, abscissa, label):
    tip = cc.Indentation(hardness=1e10)
    plan = cc.Experiment(kind=kind, abscissa=abscissa, system=oxide(), indentation=tip)
    found = cc.fit(cc.simulate(plan, noise=0.01, seed=1), ["film_modulus"])
    found.plot(axes)
    assert (axes.get_xlabel(), axes.get_ylabel()) == (label, "contact stiffness (N/m)")
    assert legend(axes) == ["data", "fit", "fit without the film"]


def legend(axes):
    """The words of the legend."""
    return [text.get_text() for text in axes.get_legend().get_texts()]


@pytest.fixture(scope="module")
def there_and_back():
    """A force curve on a film: approach and retract, with a jump and a baseline."""
    x = np.linspace(-1e-7, 4e-7, 60)
    plan = cc.Experiment(
        kind="load-penetration",
        abscissa=np.concatenate([x, x[::-1]]),
        retract=np.arange(120) >= 60,
        system=make_system(film_modulus=1e5),
        work_of_adhesion=0.01,
        work_of_adhesion_receding=0.03,
    )
    measured = cc.simulate(plan, noise=1e-7, seed=1)
    wanted = ["film_modulus", "work_of_adhesion", "work_of_adhesion_receding"]
    return cc.fit(measured, wanted)


def test_approach_and_retract_are_told_apart(there_and_back, axes):
    there_and_back.plot(axes)
    named = {line.get_label(): line for line in axes.get_lines()}
    words = {"data, approach", "data, retract", "fit, approach", "fit, retract"}
    assert words <= set(named)
    assert words <= set(legend(axes))
    assert len(legend(axes)) == len(set(legend(axes)))
    data = [named[f"data, {direction}"] for direction in ("approach", "retract")]
    assert data[0].get_color() != data[1].get_color()
    assert data[0].get_markerfacecolor() != data[1].get_markerfacecolor()
    fits = [named[f"fit, {direction}"] for direction in ("approach", "retract")]
    assert fits[0].get_linestyle() != fits[1].get_linestyle()
    assert fits[0].get_color() not in {line.get_color() for line in data}
    (points,) = there_and_back.experiments
    drawn = sum(len(line.get_xdata()) for line in axes.get_lines() if line.get_marker() != "None")
    assert drawn == len(points.abscissa)
    assert axes.get_xlabel() == "penetration (m)"


def test_points_of_a_hold_are_joined_in_their_order_in_time():
    x, y, all_of_them = np.array([3.0, 2.0, 2.0, 1.0]), np.arange(4.0), np.full(4, True)
    curve = Curve(x, y, y, y, np.array(["receding"] * 4), all_of_them, all_of_them)
    ((places, values, _),) = curve.lines(y)
    assert (places.tolist(), values.tolist()) == ([1.0, 2.0, 2.0, 3.0], [3.0, 2.0, 1.0, 0.0])


def test_a_jkr_plot_is_drawn(axes):
    """Without a film it is the straight line 4 E*/(3 sqrt 6) x - sqrt(4 w E*/3)."""
    one = lens(seed=1)
    found = cc.fit(replace(one, ordinate=one.ordinate + 1e-5), [*WANTED, "load_offset"])
    found.plot(axes, kind="jkr")
    points, line = axes.get_lines()
    modulus, w, offset = found.params.values()
    assert np.allclose(points.get_xdata(), one.abscissa**1.5 / (np.sqrt(np.pi) * 1e-3), rtol=1e-12)
    power = np.sqrt(6 * np.pi) * one.abscissa**1.5
    assert np.allclose(points.get_ydata(), (one.ordinate + 1e-5 - offset) / power, rtol=1e-9)
    straight = 4 * modulus / (3 * np.sqrt(6)) * line.get_xdata() - np.sqrt(4 * w * modulus / 3)
    assert np.allclose(line.get_ydata(), straight, atol=1e-6 * np.abs(straight).max(), rtol=0)
    assert "m$^{1/2}$" in axes.get_xlabel()
    assert "N m$^{-3/2}$" in axes.get_ylabel()
    assert legend(axes) == ["data", "fit"]


def test_what_cannot_be_drawn_is_refused(there_and_back, axes):
    with pytest.raises(cc.FitError, match=r"no JKR plot: it needs loads .* contact radii"):
        there_and_back.plot(axes, kind="jkr")
    refuses(ValueError, 'give "data" or "jkr"', lambda: there_and_back.plot(axes, kind="line"))
    load = loads_at(make_system(), np.linspace(5e-5, 1e-4, 20))
    depth = replace(load, kind="penetration-radius")
    both = [cc.simulate(depth, noise=1e-9, seed=1), cc.simulate(load, noise=1e-6, seed=1)]
    found = cc.fit(both, WANTED)
    refuses(ValueError, "experiment=0", lambda: found.plot(axes))
    found.plot(axes, experiment=0)
    assert axes.get_ylabel() == "penetration (m)"


def test_several_experiments_are_told_apart(axes):
    found = cc.fit([lens(seed=seed, name=f"curve {seed}") for seed in range(3)], WANTED)
    found.plot(axes)
    assert legend(axes) == ["curve 0", "curve 1", "curve 2", "fit"]
    colours = [line.get_color() for line in axes.get_lines()]
    assert len(set(colours)) == 4


def test_notebooks_show_a_contact_to_scale(contact):
    svg, bodies = contact._repr_html_().split("</svg>")
    drawn = ElementTree.fromstring(svg + "</svg>")
    # The film is drawn over the substrate.
    film = float(drawn.findall("rect")[1].get("height"))
    x, y = outline(drawn)
    # Where the sphere rises by the thickness of the film, in pixels, its radius is 100 times that.
    height = np.interp(160 + np.sqrt(2 * 100 * film * film), x, 90 - y)
    assert height == pytest.approx(film, rel=0.02)
    assert "t = 1e-05 m" in bodies
    half_space = cc.Contact.half_space(contact.system.without_film())
    assert "t =" not in half_space._repr_html_()


def outline(drawn):
    """The pixels of the surface of the probe, without the corners above the drawing."""
    pairs = drawn.find("polygon").get("points").split()[:-2]
    return np.array([[float(number) for number in pair.split(",")] for pair in pairs]).T


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.name)
def test_every_probe_is_drawn_to_scale(probe):
    system = replace(make_system(film_thickness=2e-7), probe=probe)
    contact = cc.Table.embedded().contact(system)
    svg, bodies = contact._repr_html_().split("</svg>")
    drawn = ElementTree.fromstring(svg + "</svg>")
    scale = float(drawn.findall("rect")[1].get("height")) / 2e-7
    x, y = outline(drawn)
    expected = probe.height((x - 160) / scale) * scale
    # Beside the edge of a punch the last digit of a pixel decides.
    seen = (y > 0) & np.isfinite(expected)
    expected = expected[seen]
    # Half of the last digit of a pixel, and what it changes at the slope of the shape.
    slope = np.abs(np.gradient(expected, x[seen]))
    assert np.all(np.abs((90 - y[seen]) - expected) <= 0.06 * (1 + slope))
    assert seen.sum() > 20
    assert probe.name in bodies


def test_layers_are_drawn_in_their_order(stack):
    found = stack.contact(sphere_radius=1e-4, sphere_modulus=2e6, a_over_t=(0.1, 2))._repr_html_()
    svg, bodies = found.split("</svg>")
    heights = [float(r.get("height")) for r in ElementTree.fromstring(svg + "</svg>").iter("rect")]
    # After the base, the top layer of 7.5 um is drawn first, then the lower one of 2.5 um.
    assert heights[1] / heights[2] == pytest.approx(3.0)
    assert bodies.index("elastomer") < bodies.index("primer") < bodies.index("base")


def test_many_layers_are_listed_in_short():
    def material(height):
        return cc.Elastic(young_modulus=1e6 + 1e11 * height, poisson_ratio=0.4)

    stack = cc.Stack.graded(base=material(0.0), thickness=1e-5, count=40, material=material)
    shown = stack.contact(sphere_radius=1e-4, sphere_modulus=2e6, a_over_t=(0.1, 1))._repr_html_()
    # The probe and the base, nine layers, and the others in one line.
    assert shown.count("<tr>") == 1 + 12
    assert "31 more layers" in shown


def test_notebooks_show_fits_as_text():
    one = lens(seed=1, name="<script>")
    bounded = cc.Free(parameter="sphere_modulus", bounds=(2.2e6, 3e6), start=2.5e6)
    found = cc.fit(one, [bounded, "work_of_adhesion"])
    shown = found._repr_html_()
    assert f"{found.params['work_of_adhesion']:.6g}" in shown
    assert found.warnings
    for warning in found.warnings:
        assert warning.kind in shown
    assert "<script>" not in shown


@pytest.fixture(scope="module")
def small_map():
    curves = [lens(seed=seed) for seed in range(6)]
    curves[4] = without_result(curves[4])
    return cc.fit_map(curves, WANTED, errors="nan")


def test_a_map_is_drawn(small_map, axes):
    assert small_map.plot(ax=axes) is axes
    line = axes.containers[0].lines[0]
    assert np.array_equal(line.get_ydata(), small_map.params["sphere_modulus"], equal_nan=True)
    assert axes.get_ylabel() == "sphere_modulus (Pa)"


def test_a_map_is_drawn_as_an_image(small_map, axes):
    small_map.plot("work_of_adhesion", shape=(2, 3), ax=axes)
    (image,) = axes.get_images()
    expected = small_map.params["work_of_adhesion"].reshape(2, 3)
    assert np.array_equal(image.get_array().filled(np.nan), expected, equal_nan=True)
    assert image.get_array().mask.tolist() == [[False] * 3, [False, True, False]]
    # The first row is below, as in maps of instruments.
    assert image.origin == "lower"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("column", "row")
    refuses(ValueError, "of 4 curves, not 6", lambda: small_map.plot(shape=(2, 2), ax=axes))
    refuses(ValueError, "'colour' was not fitted", lambda: small_map.plot("colour", ax=axes))


def test_notebooks_show_maps_as_text(small_map):
    shown = small_map._repr_html_()
    median = np.nanmedian(small_map.params["work_of_adhesion"])
    assert f"<td>{median:.4g}</td>" in shown
    assert "of 6 curves" in shown
    errors = small_map.stderr["work_of_adhesion"].copy()
    known, errors[:3] = np.median(errors[[3, 5]]), np.inf
    unknown = replace(small_map, stderr=small_map.stderr | {"work_of_adhesion": errors})
    assert f"<td>{known:.2g}</td>" in unknown._repr_html_()
    assert "<td>no result</td><td>1</td>" in shown
    assert "nan" in cc.fit_map([], WANTED)._repr_html_()
