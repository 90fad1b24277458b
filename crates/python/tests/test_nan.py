"""Objects that were made with errors="nan": none of their methods raises for a point with NaN."""

from inspect import getmembers, signature

import numpy as np
import pytest

from coated_contact import Cohesive, Table, fit_map, solve
from conftest import make_system, without_result
from test_fit import WANTED, lens


@pytest.fixture(scope="module")
def made(contact):
    """One object of each class that is made with errors="nan", with a point that has no value."""
    cohesive = Cohesive(system=make_system(), work_of_adhesion=0.04, interaction_range=1e-6)
    return [
        contact.zone_size([0.04, -1.0], interaction_range=[1e-9, 1e-9], errors="nan"),
        contact.zone_size(0.04, interaction_range=[1e-9, 1.0], errors="nan"),
        contact.validity([5e-5, 1.0], errors="nan"),
        contact.gradient([5e-5, 1.0], 0.04, errors="nan"),
        contact.gradient([5e-5, 6e-5], [0.04, 0.0], errors="nan"),
        contact.equilibria(0.04).unloading([0.0, -1.0], errors="nan"),
        contact.equilibria(0.04).loading([0.0, -1.0], errors="nan"),
        contact.cohesive_zone(0.04, stress=1e8).state([5e-5, 1.0], errors="nan"),
        cohesive.state([3e-5, 1.0], errors="nan"),
        cohesive.without_contact([1e-6, 1.0], errors="nan"),
        solve([1.0, -1.0], 1.75, 0.5, 1e5, errors="nan"),
        Table.embedded().quantities([1.0, -1.0], 1.75, 0.5, 1e5, errors="nan"),
        fit_map([lens(seed=1), without_result(lens(seed=1))], WANTED, errors="nan"),
    ]


ARGUMENTS = {"by": ("work_of_adhesion",), "is_short_beside": (1e-6,)}


def test_no_method_raises(made):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    called = set()
    for one in made:
        for name, value in getmembers(one):
            if name.startswith("_") or not callable(value):
                continue
            needed = [p for p in signature(value).parameters.values() if p.default is p.empty]
            assert len(needed) <= len(ARGUMENTS.get(name, ())), f"{type(one).__name__}.{name}"
            value(*ARGUMENTS.get(name, ()))
            called.add(name)
        assert repr(one)
        assert str(one)
        pyplot.close("all")
    assert {"pull_off_error", "by", "is_short_beside", "to_pandas", "to_xarray", "plot"} <= called


def test_friction_is_nan_where_there_is_no_contact(contact):
    """A flat punch of the radius of the sphere could be solved."""
    radius = contact.system.sphere_radius
    found = contact.validity([5e-5, radius], errors="nan")
    assert np.isnan(found.friction()).tolist() == [False, True]
    assert (found.in_range[1], found.is_large_contact[1]) == (False, False)
    assert np.isnan(contact.validity(radius, errors="nan").friction())
