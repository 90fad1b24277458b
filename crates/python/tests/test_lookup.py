"""Quantities looked up in a table: against direct solves, published values and other tables."""

import numpy as np
import pytest

import coated_contact as cc
from conftest import ROOT, RUBBER_ON_GLASS, refuses

NAMES = ("pi0", "eeq", "gamma", "delta0")


def agree(found, exact, rel):
    for name in NAMES:
        assert np.allclose(getattr(found, name), getattr(exact, name), rtol=rel, atol=0), name


def test_a_table_of_gamma_alone_answers_all_four():
    table = cc.Table.embedded()
    assert table.held == ("gamma",)
    x = np.geomspace(1e-3, 1e3, 13)[:, None, None]
    nu1, e1 = np.array([0.0, 0.3, 0.5])[:, None], np.array([0.0, 1e-2, 1.75])
    found = table.quantities(x, e1, nu1, 1e5)
    assert found.pi0.shape == (13, 3, 3)
    agree(found, cc.solve(x, e1, nu1, 1e5), 2e-6)
    agree(table.quantities(x, e1, nu1, 2.0, 0.4), cc.solve(x, e1, nu1, 2.0, 0.4), 2e-6)
    assert np.all(found.error <= table.max_error)


def test_a_single_point_is_numbers():
    found = cc.Table.embedded().quantities(1.0, 1.75, 0.5, np.inf)
    assert all(type(getattr(found, name)) is float for name in NAMES)


def test_the_default_substrate_is_that_of_the_table():
    table = cc.Table.embedded()
    one, other = (table.quantities(1.0, 1.75, 0.4, 1e-1, *nu0) for nu0 in ((), (0.25,)))
    assert one.eeq == other.eeq != table.quantities(1.0, 1.75, 0.4, 1e-1, 0.4).eeq


def test_what_a_table_does_not_hold_is_refused():
    table = cc.Table.read(ROOT / "tables" / "paper.bin")
    with pytest.raises(cc.OutsideTableError) as caught:
        table.quantities([1.0, 2.0], [1.75, 1e9], 0.5, 1e5)
    assert (caught.value.axis, caught.value.index) == ("e1_over_e2", (1,))
    found = table.quantities([1.0, 2.0], [1.75, 1e9], 0.5, 1e5, errors="nan")
    assert np.isnan(found.eeq).tolist() == [False, True]
    assert "nan" in found._repr_html_()
    scene = RUBBER_ON_GLASS | {"quantities": ["eeq", "gamma"]}
    stiffness_alone = cc.generate(scene, progress=False)
    refuses(cc.OutsideTableError, "pi0", lambda: stiffness_alone.quantities(1.0, 1.75, 0.5, 1e5))


def test_a_table_of_a_stack_is_refused(stack):
    table = cc.generate(
        {
            "title": "Layers",
            "tolerance": 1e-2,
            "a_over_t": {"from": 0.1, "to": 10},
            "e1_over_e2": {"from": 1, "to": 3},
            "stack": stack,
        },
        progress=False,
    )
    refuses(cc.OutsideTableError, "StackSystem", lambda: table.quantities(1.0, 1.75, 0.5, 1e5))
