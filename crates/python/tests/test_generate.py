"""Tables made from Python: accuracy against direct solves, files, interruption, and progress."""

import os

import numpy as np
import pytest

from coated_contact import InputError, Table, TableError, _core, generate, solve
from conftest import ROOT, refuses

SCENE = {
    "title": 'A rigid "base"',
    "tolerance": 1e-4,
    "a_over_t": {"from": 1e-2, "to": 1e2},
    "e1_over_e2": {"from": 0.1, "to": 10},
    "nu1": 0.5,
    "e0_over_e2": np.inf,
    "quantities": ["eeq", "gamma"],
}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The file of an uninterrupted generation."""
    path = tmp_path_factory.mktemp("whole") / "table.bin"
    generate(SCENE, path, tolerance=1e-7, progress=False)
    return path.read_bytes()


def test_a_table_is_as_accurate_as_its_tolerance():
    table = generate(SCENE, progress=False)
    assert table.title == 'A rigid "base"'
    assert table.held == ("eeq", "gamma")
    assert table.max_error <= table.tolerance == 1e-4
    values, axes = table.values, table.axes
    x, e1 = axes["a_over_t"][:, None], axes["e1_over_e2"]
    exact = solve(x, e1, 0.5, np.inf, tolerance=1e-9)
    for name in table.held:
        assert values[name].shape == (len(x), len(e1), 1, 1)
        assert np.allclose(values[name][:, :, 0, 0], getattr(exact, name), rtol=1e-6, atol=0)


def test_a_scene_is_a_mapping_a_text_or_a_file(tmp_path, whole):
    text = (
        "title = 'A rigid \"base\"'\ntolerance = 1e-4\na_over_t = { from = 1e-2, to = 1e2 }\n"
        "e1_over_e2 = { from = 0.1, to = 10 }\nnu1 = 0.5\ne0_over_e2 = inf\n"
        'quantities = ["eeq", "gamma"]\n'
    )
    file = tmp_path / "scene.toml"
    file.write_text(text)
    expected = Table.from_packed(whole)
    for scene in (text, file):
        table = generate(scene, tolerance=1e-7, progress=False)
        assert table.scene == text
        for name, values in table.values.items():
            assert np.array_equal(values, expected.values[name])


def test_the_file_is_the_table(tmp_path, whole):
    path = tmp_path / "table.bin"
    table = generate(SCENE, path, tolerance=1e-7, progress=False)
    assert Table.read(path) == table
    assert path.read_bytes() == whole
    assert os.listdir(tmp_path) == ["table.bin"]


class StoppedHereError(Exception):
    pass


@pytest.mark.parametrize("stage", ["solving", "checking"])
def test_an_interruption_keeps_what_is_solved(tmp_path, whole, stage):
    """The piece that is being solved when the function raises is kept; later all pieces are."""
    path = tmp_path / "table.bin"

    def stop(at, points, finished):
        if at == stage:
            raise StoppedHereError

    with pytest.raises(StoppedHereError):
        generate(SCENE, path, tolerance=1e-7, progress=stop)
    assert os.listdir(tmp_path) == ["table.bin.unfinished"]
    told = []
    table = generate(
        SCENE, path, tolerance=1e-7, resume=True, progress=lambda *event: told.append(event)
    )
    shape = [len(nodes) for nodes in table.axes.values()]
    solved = shape[1] if stage == "solving" else np.prod(shape)
    assert told[0] == ("solving", np.prod(shape), solved)
    assert told[-1][0] == "checking"
    assert told[-1][1] == told[-1][2]
    assert os.listdir(tmp_path) == ["table.bin"]
    assert path.read_bytes() == whole


def test_other_pieces_are_not_mixed_in(tmp_path):
    path = tmp_path / "table.bin"

    def stop(*_):
        raise StoppedHereError

    with pytest.raises(StoppedHereError):
        generate(SCENE, path, tolerance=1e-7, progress=stop)
    given = {"path": path, "progress": False}
    words = "finished pieces of an interrupted"
    refuses(TableError, words, lambda: generate(SCENE, tolerance=1e-7, **given))
    other = {"tolerance": 1e-6, "resume": True}
    refuses(TableError, "cannot resume", lambda: generate(SCENE, **other, **given))


def test_a_table_that_misses_its_tolerance_says_so(tmp_path):
    scene = {**SCENE, "a_over_t": {"from": 1e-2, "to": 1e2, "nodes": 4}}
    with pytest.warns(UserWarning, match="exceeds the tolerance"):
        table = generate(scene, tmp_path / "table.bin", progress=False)
    assert table.max_error > table.tolerance


def test_scenes_that_cannot_be_used_are_named(tmp_path):
    refuses(TableError, "nu1 = 0.6", lambda: generate({**SCENE, "nu1": 0.6}, progress=False))
    for wrong in ({"certificate_points": 0}, {"seed": -1}):
        with pytest.raises(InputError, match=next(iter(wrong))):
            generate(SCENE, progress=False, **wrong)
    with pytest.raises(FileNotFoundError):
        generate(tmp_path / "missing.toml", progress=False)
    refuses(ValueError, r"pathlib\.Path", lambda: generate("missing.toml", progress=False))
    refuses(TypeError, "a scene is", lambda: generate(3, progress=False))
    with pytest.raises(TypeError, match="a value of the scene"):
        generate({**SCENE, "nu1": None}, progress=False)
    with pytest.raises(FileNotFoundError):
        generate(SCENE, tmp_path / "missing" / "table.bin", progress=False)


@pytest.mark.skipif(not _core.writes_hdf5, reason="built without the feature hdf5")
def test_with_hdf5_the_archive_is_written(tmp_path):
    path = tmp_path / "table.h5"
    made = generate(SCENE, path, progress=False)
    assert path.read_bytes()[:8] == b"\x89HDF\r\n\x1a\n"
    opened = Table.open(path)
    packed = generate(SCENE, tmp_path / "table.bin", progress=False)
    for name, values in packed.values.items():
        assert np.array_equal(opened.values[name], values)
        assert np.array_equal(made.values[name], values)
    assert opened.max_error == packed.max_error


@pytest.mark.skipif(_core.writes_hdf5, reason="built with the feature hdf5")
def test_without_hdf5_the_packed_form_is_named(tmp_path):
    """A wheel is built without the C library of HDF5."""
    path = tmp_path / "table.h5"
    refuses(OSError, r"cannot write HDF5.*\.bin", lambda: generate(SCENE, path, progress=False))
    assert not path.exists()


def test_a_table_opens_in_xarray(tmp_path):
    pytest.importorskip("xarray")
    table = Table.open(ROOT / "tables" / "paper.h5")
    data = table.to_xarray()
    assert dict(data.sizes) == {name: len(nodes) for name, nodes in table.axes.items()}
    assert np.array_equal(data["gamma"], table.values["gamma"])
    assert data.attrs["max_error"] == table.max_error


def test_the_bar_is_for_terminals(capfd):
    pytest.importorskip("tqdm")
    generate(SCENE, progress=True)
    assert capfd.readouterr() == ("", "")
