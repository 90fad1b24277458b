"""Files of AFMs: the curves that afmformats and nanite ship, what they give, and why not.

None of them is a film of known thickness: they test reading and refusing, not physics. The data
are fetched with the source distributions of both (afmformats: MIT, nanite: GPL-3), and not kept.
"""

import os
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import coated_contact as cc
from coated_contact._afm import _Place, _surface
from conftest import refuses

GEL = cc.HalfSpace(
    sphere_radius=1e-4,
    sphere_modulus=np.inf,
    solid=cc.Elastic(young_modulus=1e3, poisson_ratio=0.5),
)
COATED = cc.System(
    sphere_radius=1e-4,
    sphere_modulus=1e11,
    film=cc.Elastic(young_modulus=1e3, poisson_ratio=0.5),
    film_thickness=5e-5,
    substrate=cc.Elastic(young_modulus=64e9, poisson_ratio=0.2),
)
FREE = ["film_modulus", "contact_point", "baseline"]

# What must be given beside the file.
NOTHING, STIFFNESS, BOTH = (), ("stiffness",), ("stiffness", "sensitivity")
GIVEN = {"stiffness": 0.05, "sensitivity": 5e-8}

AFMFORMATS, NANITE = "AFMFORMATS", "NANITE"
# Why a curve has no modulus: no contact or no force, an approach of one point, no gel under a tip.
NO_MODULUS = "JKR finds no positive modulus"
ONE_HEIGHT = "at every point, which determines nothing"
UNITS = "is below the moduli of all solids"
# File, what must be given, curves, curves with a modulus, and why others have none. A file that is
# given without a folder has the prefix of most.
PREFIX = "tests/data/fmt-"
FILES_OF = {
    AFMFORMATS: [
        ("docs/data/force-save-example.jpk-force", NOTHING, 1, 1, None),
        ("afm-workshop-fd_mapping_16_2018-08-01_13.07.zip", BOTH, 16, 16, None),
        ("afm-workshop-fd_single_2018-08-01_13.06.09.csv", BOTH, 1, 1, None),
        ("afm-workshop-fd_single_2020-02-14_13.41.25.csv", STIFFNESS, 1, 0, NO_MODULUS),
        ("afm-workshop-fd_single_2021-01-15.csv", BOTH, 1, 0, UNITS),
        ("afm-workshop-fd_single_2021-10-22_14.16.csv", STIFFNESS, 1, 1, None),
        ("chiaro-txt_AEBP1_Indentation_002.zip", NOTHING, 1, 1, None),
        ("hdf5-fd_version_0.13.3.h5", NOTHING, 1, 1, None),
        ("igor-fd_SiN_FD_plot.ibw", NOTHING, 1, 1, None),
        ("igor-fd_U3_3_p10004.ibw", NOTHING, 1, 1, None),
        ("jpk-cc_pr14-brain-2021.06.30.jpk-force", NOTHING, 1, 1, None),
        ("jpk-cc_pr14-polymergel-2021.06.30.jpk-force", NOTHING, 1, 1, None),
        ("jpk-cl_calibration_force-save-2015.02.04-11.25.21.294.jpk-force", BOTH, 1, 1, None),
        ("jpk-fd_2020.02.07-16.29.05.036.jpk-qi-data", NOTHING, 4, 4, None),
        ("jpk-fd_flipsign_2015.05.22-15.31.49.352.jpk-force", NOTHING, 1, 1, None),
        ("jpk-fd_map-data-reference-points.jpk-force-map", NOTHING, 3, 3, None),
        ("jpk-fd_map0d_extracted.jpk-force-map", NOTHING, 1, 1, None),
        ("jpk-fd_map2x2_extracted.jpk-force-map", NOTHING, 4, 4, None),
        ("jpk-fd_qi-data-2021.04.13.jpk-qi-series", NOTHING, 1, 1, None),
        ("jpk-fd_single-modified_2023.jpk-force", STIFFNESS, 1, 0, NO_MODULUS),
        ("jpk-fd_spot3-0192.jpk-force", NOTHING, 1, 1, None),
        ("jpk-sr_cell1-0008.jpk-force", NOTHING, 1, 1, None),
        ("ntmdt-txt-fd_2015_01_17_gel4-0,1_mQ_adh_6B_Curve_DFL_Height_51.txt", BOTH, 1, 0, UNITS),
        ("tab-fd_version_0.13.3.tab", NOTHING, 1, 1, None),
    ],
    NANITE: [
        ("examples/data/zebrafish-head-section-gray-matter.jpk-force", NOTHING, 1, 1, None),
        ("jpk-fd_map1d_2016-11-07.jpk-force-map", NOTHING, 8, 8, None),
        ("jpk-fd_map_bad_2013-05-27_1.jpk-force-map", NOTHING, 1, 0, NO_MODULUS),
        ("jpk-fd_map_bad_2013-05-27_2.jpk-force-map", NOTHING, 1, 0, NO_MODULUS),
        ("jpk-fd_single_bad_2017-01-16_1.jpk-force", NOTHING, 1, 0, NO_MODULUS),
        ("jpk-fd_single_bad_2017-01-16_2.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_bad_2017-01-16_3.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_bad_2017-01-16_4.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_bad_2017-01-16_5.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_bad_GWAT_2017-10-17.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_bad_bead10_2017-04-27.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_bad_bead46_2017-04-20.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_bad_bead7_2017-04-27.jpk-force", NOTHING, 1, 0, ONE_HEIGHT),
        ("jpk-fd_single_tilted-baseline-drift-mitotic_2021-01-29.jpk-force", NOTHING, 1, 1, None),
        ("jpk-fd_single_tilted-baseline-shift-adyp_2023-06-26.jpk-force", NOTHING, 1, 1, None),
    ],
}
FILES = [
    (source, name if "/" in name else PREFIX + name, *row)
    for source, rows in FILES_OF.items()
    for name, *row in rows
]
MAP = "tests/data/fmt-jpk-fd_map2x2_extracted.jpk-force-map"


def file_of(source, name, folder):
    """The path of a file in the source distribution of a package; of an archive its content."""
    pytest.importorskip("afmformats")
    root = os.environ.get(f"{source}_SOURCE")
    if root is None:
        pytest.skip(f"{source}_SOURCE does not name the source: `cargo xtask test` sets it")
    path = Path(root) / name
    if "chiaro" in name:
        # One text in an archive; archives that afmformats reads itself are maps of AFM workshop.
        with zipfile.ZipFile(path) as archive:
            (inside,) = archive.namelist()
            path = Path(archive.extract(inside, folder))
    return path


def test_a_file_of_forces_says_so_and_refuses_a_sensitivity(tmp_path):
    name = PREFIX + "afm-workshop-fd_single_2021-10-22_14.16.csv"
    file = file_of("AFMFORMATS", name, tmp_path)
    (one,) = cc.read_afm(file, system=GEL, stiffness=0.05)
    assert one.reading.endswith("N/m, with which the instrument made the forces")
    wrong = {"stiffness": 0.05, "sensitivity": 5e-8}
    words = "forces in newtons, which no sensitivity changes"
    refuses(cc.FitError, words, lambda: cc.read_afm(file, system=GEL, **wrong))
    volts = PREFIX + "afm-workshop-fd_single_2018-08-01_13.06.09.csv"
    (one,) = cc.read_afm(file_of("AFMFORMATS", volts, tmp_path), system=GEL, **GIVEN)
    assert one.reading.endswith("stiffness 0.05 N/m")


def test_every_file_is_in_the_list():
    """Some files are in both packages, under one name or two."""
    roots = {source: os.environ.get(f"{source}_SOURCE") for source in FILES_OF}
    if None in roots.values():
        pytest.skip("the sources are not named: `cargo xtask test` sets them")
    listed = {Path(roots[source], name).read_bytes() for source, name, *_ in FILES}
    patterns = ("tests/data/fmt-*", "examples/data/*.jpk-*", "docs/data/*.jpk-*")
    found = {path for root in roots.values() for one in patterns for path in Path(root).glob(one)}
    for path in found:
        assert path.read_bytes() in listed, path


@pytest.mark.parametrize(
    ("source", "name", "wanted", "curves", "fitted", "reason"),
    FILES,
    ids=[f"{source}-{Path(name).name}" for source, name, *_ in FILES],
)
def test_files(source, name, wanted, curves, fitted, reason, tmp_path):
    path = file_of(source, name, tmp_path)
    if wanted:
        with pytest.raises(cc.FitError, match=f"give .*{wanted[0]}=, N/m|give .*=, m/V"):
            cc.read_afm(path, system=GEL)
    found = cc.read_afm(path, system=GEL, only="approach", **{one: GIVEN[one] for one in wanted})
    assert isinstance(found, cc.ForceMap)
    assert len(found) == curves
    assert found.refused == {}
    for one, time in zip(found, found.times, strict=True):
        assert one.kind == "force-height"
        assert np.isfinite(one.abscissa).all()
        assert np.isfinite(one.ordinate).all()
        assert not one.retract.any()
        assert one.stiffness > 0
        assert time is None or (time.shape == one.abscissa.shape and np.all(np.diff(time) >= 0))
    results = cc.fit_map(found, FREE, errors="nan")
    assert int(np.isfinite(results.params["film_modulus"]).sum()) == fitted
    for error in results.failures.values():
        assert isinstance(error, cc.ContactError)
        assert reason in str(error)
    if fitted == curves:
        assert reason is None


@pytest.fixture
def force_map(tmp_path):
    return file_of("AFMFORMATS", MAP, tmp_path)


def test_a_curve_has_what_the_file_tells(force_map):
    afmformats = pytest.importorskip("afmformats")
    found = cc.read_afm(force_map, system=GEL, work_of_adhesion=1e-4, noise=1e-11)
    original = afmformats.load_data(force_map)
    assert repr(found) == "<ForceMap of 4 curves on 10 x 10 pixels, 0 refused>"
    for one, time, curve in zip(found, found.times, original, strict=True):
        np.testing.assert_array_equal(curve["height (measured)"], one.abscissa)
        np.testing.assert_array_equal(curve["force"], one.ordinate)
        np.testing.assert_array_equal(curve["time"], time)
        assert one.retract.tolist() == (curve["segment"] == 1).tolist()
        assert one.stiffness == curve.metadata["spring constant"]
        assert (one.work_of_adhesion, one.noise, one.system) == (1e-4, 1e-11, GEL)
        assert "JPK Instruments" in one.reading
    places = [(m["position x"], m["position y"]) for m in (curve.metadata for curve in original)]
    np.testing.assert_array_equal(found.position, places)
    assert found.shape == (10, 10)
    # Positions are as far apart as the pixels.
    for i in (1, 2, 3):
        distance = np.hypot(*(found.position[i] - found.position[0]))
        apart = (found.pixel[i] - found.pixel[0]) * found.pixel_size
        assert distance == pytest.approx(np.hypot(*apart), rel=0.02)
    assert found[1].name.endswith("curve 1")
    softer = cc.read_afm(force_map, system=GEL, stiffness=0.01)
    scale = 0.01 / found[0].stiffness
    np.testing.assert_allclose(softer[0].ordinate, scale * found[0].ordinate, rtol=1e-9)


def test_curves_of_an_hdf5_file_are_in_the_order_of_the_measurement(force_map, tmp_path):
    """Their groups are in the order of the names: 0, 1, 10, 11, 2."""
    h5py = pytest.importorskip("h5py")
    measured = sys.modules["afmformats"].load_data(force_map)
    path = tmp_path / "map.h5"
    with h5py.File(path, "w") as file:
        for i in range(12):
            curve = measured[i % 4]
            curve.metadata["enum"] = i
            curve.export_data(file, fmt="hdf5", metadata=True)
    thickness = 1e-6 * np.arange(1, 13)
    found = cc.read_afm(path, system=COATED, film_thickness=thickness)
    assert [one.system.film_thickness for one in found] == thickness.tolist()
    for i, one in enumerate(found):
        np.testing.assert_array_equal(one.ordinate, np.asarray(measured[i % 4]["force"]))
        assert one.name.endswith(f"curve {i}")


def test_directions_and_pauses(tmp_path):
    """A stress relaxation has a pause before the approach, and another one after it."""
    name = "tests/data/fmt-jpk-sr_cell1-0008.jpk-force"
    path = file_of("AFMFORMATS", name, tmp_path)
    found = cc.read_afm(path, system=GEL)
    assert [int((~found[0].retract).sum()), int(found[0].retract.sum())] == [2048, 1951]
    assert found.times[0][[0, -1]].tolist() == pytest.approx([1.0, 32.952], abs=1e-3)
    (held,) = cc.read_afm(path, system=GEL, relaxation=cc.Relaxation.power_law(0.2))
    assert len(held.abscissa) > 2048 + 1951
    assert np.all(np.diff(held.time) > 0)
    (approach,) = cc.read_afm(path, system=GEL, relaxation=held.relaxation, only="approach")
    assert len(approach.abscissa) == len(held.abscissa) - 1951
    # The segments of an Igor file are not told: it is split at the smallest height.
    path = file_of("AFMFORMATS", "tests/data/fmt-igor-fd_U3_3_p10004.ibw", tmp_path)
    (one,) = cc.read_afm(path, system=GEL)
    assert one.abscissa[one.retract].min() >= one.abscissa.min()
    assert np.argmin(one.abscissa) == (~one.retract).sum() - 1
    (only,) = cc.read_afm(path, system=GEL, only="retract")
    assert len(only.abscissa) == one.retract.sum()


def test_a_position_of_the_tip_tells_the_height(tmp_path):
    """What Chiaro calls "indentation" is no height of the base, whose tip is at height + F / k."""
    name = "tests/data/fmt-chiaro-txt_AEBP1_Indentation_002.zip"
    path = file_of("AFMFORMATS", name, tmp_path)
    (one,) = cc.read_afm(path, system=GEL)
    (curve,) = sys.modules["afmformats"].load_data(path)
    tip = one.abscissa + one.ordinate / one.stiffness
    np.testing.assert_allclose(curve["tip position"], tip, rtol=1e-12)


def test_the_thickness_of_each_pixel(force_map):
    thickness = np.full((10, 10), 1e-5)
    found = cc.read_afm(force_map, system=COATED)
    places = found.pixel
    thickness[tuple(places.T)] = [1e-5, 2e-5, 3e-5, -1e-6]
    read = cc.read_afm(force_map, system=COATED, film_thickness=thickness)
    assert [one.system.film_thickness for one in read] == [1e-5, 2e-5, 3e-5]
    assert list(read.refused) == [3]
    assert "curve 3: the film is -1e-06 m thick there" in read.refused[3]
    image = read.image([one.system.film_thickness for one in read])
    assert np.nansum(image) == pytest.approx(6e-5)
    assert image[tuple(places[1])] == 2e-5
    # The surface over the zero level, one for each curve.
    surface = np.array([1.1e-5, 1.2e-5, 1.3e-5, 1.4e-5])
    read = cc.read_afm(force_map, system=COATED, height_image=surface, zero_level=1e-6)
    thicknesses = [one.system.film_thickness for one in read]
    np.testing.assert_allclose(thicknesses, surface - 1e-6, rtol=1e-12)


def test_the_surface_from_the_approach(force_map):
    """The contact points of the fits are within the noise of the surface that curves show."""
    zero = 4e-5
    found = cc.read_afm(force_map, system=COATED, zero_level=zero)
    assert len(found) + len(found.refused) == 4
    fitted = cc.fit_map(cc.read_afm(force_map, system=GEL, only="approach"), FREE, errors="nan")
    for one, contact in zip(found, fitted.params["contact_point"], strict=True):
        assert abs(zero + one.system.film_thickness - contact) < 2e-6


def test_maps_and_pictures(force_map, axes):
    found = cc.read_afm(force_map, system=GEL, only="approach")
    results = cc.fit_map(found, FREE, errors="nan")
    moduli = results.params["film_modulus"]
    image = found.image(moduli)
    assert image.shape == (10, 10)
    assert np.isfinite(image).sum() == 4
    assert image[tuple(found.pixel[2])] == moduli[2]
    xarray = pytest.importorskip("xarray")
    maps = found.to_xarray(results)
    assert isinstance(maps, xarray.Dataset)
    np.testing.assert_array_equal(maps["film_modulus"], image)
    assert maps["film_modulus"].attrs["units"] == "Pa"
    errors = found.image(results.stderr["film_modulus"])
    np.testing.assert_array_equal(maps["film_modulus_stderr"], errors)
    high = replace(found, pixel_size=(2e-6, 1e-6)).to_xarray(results)
    assert [high["y"].values[0], high["x"].values[0]] == [1e-6, 5e-7]
    assert maps["x"].values[:2].tolist() == pytest.approx([3e-5, 9e-5])
    assert set(maps.data_vars) == {*FREE, *(f"{one}_stderr" for one in FREE), "chi_squared"}
    assert found.plot(moduli, "film modulus", "Pa", ax=axes) is axes
    assert axes.figure.axes[1].get_ylabel() == "film modulus (Pa)"
    np.testing.assert_array_equal(axes.get_images()[0].get_array().filled(np.nan), image)
    (bar,) = axes.artists
    assert bar.txt_label.get_text() == "200 µm"
    axes.figure.canvas.draw()
    refuses(cc.FitError, r"shape \(2,\): give \(4,\)", lambda: found.image([1.0, 2.0]))
    # A curve that is not of the map, and two of one pixel.
    pixel = found.pixel.copy()
    pixel[0] = -1
    others = moduli[1:]
    assert np.nansum(replace(found, pixel=pixel).image(moduli)) == pytest.approx(sum(others))
    pixel[0] = pixel[2]
    twice = replace(found, pixel=pixel)
    refuses(
        cc.FitError, "curves 0 and 2 are of one pixel, .*: give NaN", lambda: twice.image(moduli)
    )
    assert np.isfinite(twice.image([np.nan, *others])).sum() == 3


def test_a_pixel_has_the_height_of_a_row_and_the_width_of_a_column():
    sides = {"x": (0, 4, 4e-6), "y": (1, 2, 6e-6)}
    metadata = {
        f"grid {one} {axis}": value
        for axis, values in sides.items()
        for one, value in zip(("index", "shape", "size"), values, strict=True)
    }
    place = _Place(metadata)
    assert (place.pixel, place.shape, place.pixel_size) == ((1, 0), (2, 4), (3e-6, 1e-6))


def test_the_tip_is_above_the_base_by_the_deflection():
    """The last force within 5 standard deviations (1.4826 each) of 0 is 6, over 10 N/m."""
    force = np.array([1.0, -1.0] * 10 + [6.0] + [20.0] * 79)
    fields = {
        "abscissa": np.arange(100.0, 0.0, -1.0),
        "ordinate": force,
        "retract": np.full(100, False),
        "stiffness": 10.0,
    }
    assert _surface(fields) == 80.0 + 6.0 / 10.0


def test_wrong_calls_say_what_to_give(force_map, tmp_path):
    single = file_of("AFMFORMATS", "docs/data/force-save-example.jpk-force", tmp_path)
    refuses(cc.FitError, "holds no map", lambda: cc.read_afm(single, system=GEL).image([1.0]))
    with pytest.raises(FileNotFoundError):
        cc.read_afm(tmp_path / "none.jpk-force", system=GEL)
    text = tmp_path / "curve.png"
    text.write_text("1 2 3")
    with pytest.raises(
        cc.FitError, match=r"afmformats reads .*\.jpk-force, .*not '\.png'; read_exp"
    ):
        cc.read_afm(text, system=GEL)
    broken = tmp_path / "broken.jpk-force"
    broken.write_bytes(force_map.read_bytes()[:5000])
    with pytest.raises(
        cc.FitError, match=r"cannot be read: .*export it as text for read_experiment"
    ):
        cc.read_afm(broken, system=GEL)
    igor = file_of("AFMFORMATS", "tests/data/fmt-igor-fd_SiN_FD_plot.ibw", tmp_path)
    with pytest.raises(cc.FitError, match="has a stiffness and a sensitivity of its own"):
        cc.read_afm(igor, system=GEL, stiffness=1.0)
    for name in ("stiffness", "sensitivity"):
        for value in (0.0, -1.0, np.nan, np.inf):
            with pytest.raises(cc.FitError, match="must be positive"):
                cc.read_afm(single, system=GEL, **{name: value})
    refuses(cc.FitError, "'up'", lambda: cc.read_afm(single, system=GEL, only="up"))
    with pytest.raises(cc.FitError, match="a HalfSpace has no film whose thickness changes"):
        cc.read_afm(single, system=GEL, film_thickness=[1e-5])
    with pytest.raises(cc.FitError, match="height_image needs zero_level"):
        cc.read_afm(single, system=COATED, height_image=[1e-5])
    with pytest.raises(cc.FitError, match="film_thickness stands beside"):
        cc.read_afm(single, system=COATED, film_thickness=[1e-5], zero_level=0.0)
    with pytest.raises(
        cc.FitError, match=r"shape \(2, 2\): give \(4,\), one for each curve or \(10,"
    ):
        cc.read_afm(force_map, system=COATED, film_thickness=np.ones((2, 2)))
    with pytest.raises(cc.FitError, match=r"film is .* thick there"):
        cc.read_afm(single, system=COATED, film_thickness=[np.nan])


def test_without_afmformats_the_error_says_how_to_install_it(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "afmformats", None)
    with pytest.raises(ModuleNotFoundError, match="pip install afmformats"):
        cc.read_afm(tmp_path / "x.jpk-force", system=GEL)
