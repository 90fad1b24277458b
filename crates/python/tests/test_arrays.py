"""Broadcasting, types, and what a point with an error gives."""

import threading
from dataclasses import replace

import numpy as np
import pytest

import coated_contact as cc
from conftest import loads_at, refuses

W = 0.04


def test_scalars_give_scalars(contact):
    for a in (65e-6, np.float64(65e-6), np.array(65e-6)):
        assert type(contact.load(a, W)) is float
        assert type(contact.stiffness(a)) is float
        assert type(contact.gradient(a, W).by("film_modulus").load) is float
    assert isinstance(contact.pull_off(W), cc.State)
    assert isinstance(contact.pull_off([W]), cc.States)


def test_arrays_broadcast(contact):
    a, w = np.linspace(40e-6, 90e-6, 5)[:, None], np.array([0.0, 0.02, 0.04])
    load, penetration = contact.load_and_penetration(a, w)
    assert load.shape == penetration.shape == (5, 3)
    for i in range(5):
        for j in range(3):
            expected = contact.load_and_penetration(a[i, 0], w[j])
            assert (load[i, j], penetration[i, j]) == expected
    assert np.array_equal(contact.load(a, w), load)
    assert np.array_equal(contact.penetration(a, w), penetration)
    assert contact.load(np.empty((0, 3)), 0.04).shape == (0, 3)
    assert contact.load([[65e-6]], 0.04).shape == (1, 1)
    refuses(ValueError, "broadcast", lambda: contact.load(np.ones(2), np.ones(3)))


def test_layouts_and_types_do_not_matter(contact):
    a = np.linspace(40e-6, 90e-6, 8)
    expected = contact.load(a, W)
    assert np.array_equal(contact.load(list(a), W), expected)
    assert np.array_equal(contact.load(a[::-1], W)[::-1], expected)
    assert np.array_equal(contact.load(np.asfortranarray(a.reshape(2, 4)), W).ravel(), expected)
    assert np.array_equal(contact.load(a.astype(">f8"), W), expected)
    single = a.astype(np.float32)
    assert np.array_equal(contact.load(single, W), contact.load(single.astype(float), W))
    assert np.array_equal(contact.load(a, 0), contact.load(a, 0.0))


def behind_a_header(values):
    """The numbers as they are read from a file that begins with 13 bytes: not aligned."""
    return np.frombuffer(bytes(13) + np.asarray(values, dtype="<f8").tobytes(), "<f8", offset=13)


def test_numbers_need_not_be_aligned(contact, system):
    a = np.linspace(40e-6, 90e-6, 5)
    record = np.zeros(5, dtype=[("flag", "u1"), ("a", "<f8")])
    record["a"] = a
    for given in (behind_a_header(a), record["a"]):
        assert not given.flags.aligned
        assert np.array_equal(contact.load(given, W), contact.load(a, W))
        assert contact.load(given[:1], W) == contact.load(a[:1], W)
    assert cc.Cone(half_angle=behind_a_header([1.0])[0]) == cc.Cone(half_angle=1.0)
    points = np.stack([a, a * a], axis=1)
    assert cc.Profile(points=behind_a_header(points).reshape(5, 2)) == cc.Profile(points=points)
    small = replace(system, sphere_radius=1e-6)
    cohesive = cc.Cohesive(system=small, work_of_adhesion=W, interaction_range=1e-8)
    r = np.linspace(0.0, 1e-7, 5)
    expected = cohesive.pressure(1e-7, r)
    assert np.array_equal(cohesive.pressure(1e-7, behind_a_header(r)), expected)
    lens = cc.simulate(loads_at(system, a, noise=1e-6), noise=1e-6, seed=1)
    likelihood = cc.log_likelihood(lens, ["film_modulus", "work_of_adhesion"])
    at = np.array([3e6, 0.04])
    for given in (behind_a_header(at), np.repeat(at, 2)[::2]):
        assert likelihood(given) == likelihood(at)
        assert np.array_equal(likelihood.gradient(given), likelihood.gradient(at))


@pytest.mark.parametrize(
    "value",
    ["65e-6", None, 1j, True, [None], ["x"], np.array([1 + 1j]), np.ma.array([1.0], mask=[True])],
)
def test_other_types_are_refused_by_name(contact, value):
    refuses(TypeError, "contact_radius", lambda: contact.load(value, W))


def test_an_error_names_the_first_point(contact):
    a = np.array([[65e-6, 65e-6], [65e-6, 2e-3]])
    error = refuses(cc.InputError, "below the sphere's radius", lambda: contact.load(a, W))
    assert (error.axis, error.value, error.range) == ("contact radius", 2e-3, (0.0, 1e-3))
    assert error.index == (1, 1)
    assert any("(1, 1)" in note for note in error.__notes__)
    found = contact.load(a, W, errors="nan")
    assert np.array_equal(np.isnan(found), [[False, False], [False, True]])
    assert found[0, 0] == contact.load(65e-6, W)
    assert np.isnan(contact.load(2e-3, W, errors="nan"))
    refuses(ValueError, "errors = 'ignore'", lambda: contact.load(a, W, errors="ignore"))
    with pytest.raises(cc.InputError) as caught:
        contact.load(2e-3, W)
    assert caught.value.index is None


def test_a_point_beyond_the_first_block_is_found(contact):
    """The native part works in blocks of 65,536 points."""
    a = np.full(200_000, 65e-6)
    a[150_001] = -1.0
    with pytest.raises(cc.ContactError) as caught:
        contact.load(a, W)
    assert caught.value.index == (150_001,)
    found = contact.load(a, W, errors="nan")
    assert np.flatnonzero(np.isnan(found)).tolist() == [150_001]
    assert np.all(np.delete(found, 150_001) == contact.load(65e-6, W))


def test_states_broadcast(contact):
    equilibria = contact.equilibria(W, control="displacement")
    least = equilibria.pull_off().penetration
    imposed = np.linspace(least * 1.5, 1e-6, 7)
    states = equilibria.unloading(imposed, errors="nan")
    assert np.isnan(states.load).tolist() == (imposed < least).tolist()
    for state, penetration in zip(states, imposed, strict=True):
        assert penetration < least or state == equilibria.unloading(penetration)
    with pytest.raises(cc.ContactError) as caught:
        equilibria.unloading(imposed)
    assert caught.value.index == (0,)
    assert caught.value.range == (least, np.inf)


def test_unknown_derivatives_are_errors(contact):
    gradient = contact.gradient([65e-6, 65e-6], [W, 0.0])
    error = refuses(cc.InputError, "work of adhesion", lambda: gradient.by("work_of_adhesion"))
    assert error.axis == "work of adhesion"
    gradient = contact.gradient([65e-6, 65e-6], [W, 0.0], errors="nan")
    assert np.isnan(gradient.by("work_of_adhesion").load).tolist() == [False, True]
    with pytest.raises(KeyError):
        gradient.by("colour")


def test_threads_share_a_contact(contact):
    a = np.linspace(40e-6, 90e-6, 100_000)
    expected, found = contact.load(a, W), {}

    def evaluate(thread):
        found[thread] = contact.load(a, W)

    threads = [threading.Thread(target=evaluate, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(found[i], expected) for i in range(4))


class Millimetres(np.ndarray):
    """Numbers with a unit, as packages of units have them."""

    units = "mm"


def test_labels_pair_numbers_as_their_places_do(contact, system):
    """numpy would pair arrays of xarray and pandas by their labels."""
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    a, w = np.array([5e-5, 6e-5, 7e-5]), np.array([0.01, 0.02, 0.03])
    of = {"a": xarray.DataArray(a, dims="a"), "w": xarray.DataArray(w, dims="w")}
    words = "other labels, .* paired by their place: bring both into one order"
    refuses(ValueError, words, lambda: contact.load(of["a"], of["w"]))
    expected = contact.load(a, w)
    assert np.array_equal(contact.load(of["a"], of["w"].rename(w="a")), expected)
    table = xarray.DataArray(np.tile(w, (2, 1)), dims=("specimen", "a"))
    assert contact.load(of["a"], table).shape == (2, 3)
    first, other = (pandas.Series(one, index=[0, 1, 2]) for one in (a, w))
    assert np.array_equal(contact.load(first, other), expected)
    refuses(ValueError, words, lambda: contact.load(first, other.sort_index(ascending=False)))
    shuffled = {"abscissa": first, "ordinate": other.iloc[[1, 0, 2]]}
    known = {"kind": "load-radius", "system": system, "work_of_adhesion": 0.04}
    refuses(ValueError, words, lambda: cc.Experiment(**known, **shuffled))
    # A Series is paired with the columns of a DataFrame, as numpy does.
    frame = pandas.DataFrame({"s1": a, "s2": a})
    turned = pandas.DataFrame({"s2": w, "s1": w})
    assert contact.load(frame, turned[["s1", "s2"]]).shape == (3, 2)
    refuses(ValueError, words, lambda: contact.load(frame, turned))
    row = pandas.Series([0.01, 0.02], index=["s1", "s2"])
    assert np.array_equal(contact.load(frame, row)[:, 1], contact.load(a, 0.02))
    law, time = cc.Relaxation.power_law(0.2), pandas.Series([0, 1, 2], index=[0, 2, 1])
    program = pandas.Series([0, 1e-7, 0])
    refuses(ValueError, words, lambda: contact.history(time, law, penetration=program))
    plan = {"kind": "stiffness-depth", "abscissa": first, "ordinate": first, "system": system}
    assert (
        cc.Experiment(**plan, indentation=cc.Indentation(loads=first)).indentation.loads[0] == a[0]
    )
    other_loads = cc.Indentation(loads=first[::-1])
    refuses(ValueError, words, lambda: cc.Experiment(**plan, indentation=other_loads))


def test_units_of_numbers_are_si_or_refused(contact, system):
    xarray = pytest.importorskip("xarray")

    def modulus(value, **unit):
        given = xarray.DataArray(value, attrs=unit)
        return cc.Elastic(young_modulus=given, poisson_ratio=0.5).young_modulus

    words = "young_modulus has the unit 'MPa' of its own: give its value in SI units"
    refuses(TypeError, words, lambda: modulus(3.5, units="MPa"))
    refuses(TypeError, "'MPa'", lambda: modulus(3.5, unit="MPa"))
    for unit in ("Pa", "pascal", "N m-2", "N/m^2", "N/m²", b"Pa"):
        assert modulus(3.5e6, units=unit) == 3.5e6
    pascals = xarray.DataArray([5e-5], attrs={"units": "Pa"})
    words = "contact_radius has the unit 'Pa', but is in m"
    refuses(TypeError, words, lambda: contact.load(pascals, 0.04))
    loads = xarray.DataArray([1e-6, 2e-6], attrs={"units": "N"})
    swapped = {"kind": "load-penetration", "abscissa": loads, "ordinate": loads, "system": system}
    refuses(TypeError, "abscissa has the unit 'N', but is in m", lambda: cc.Experiment(**swapped))
    held = xarray.DataArray(np.array([0.05]).view(Millimetres))
    refuses(TypeError, "unit of its own", lambda: contact.load(held, 0.04))
