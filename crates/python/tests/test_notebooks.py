"""The notebooks run, without warnings, and draw."""

import os
import runpy

import pytest

from conftest import ROOT

NOTEBOOKS = sorted((ROOT / "crates/python/notebooks").glob("*.py"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("xarray")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    pyplot.close("all")
    runpy.run_path(str(path))
    figures = [pyplot.figure(number) for number in pyplot.get_fignums()]
    assert figures
    for i, figure in enumerate(figures):
        for axes in figure.axes:
            assert axes.has_data()
        folder = os.environ.get("FIGURES", tmp_path)
        figure.savefig(f"{folder}/{path.stem}-{i}.png")
    pyplot.close("all")


def test_there_are_six():
    assert len(NOTEBOOKS) == 6
