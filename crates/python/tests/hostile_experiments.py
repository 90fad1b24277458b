"""Measurements, predictions and fits from any floats, for `test_hostile.py`."""

import sys
import tempfile
import warnings
from dataclasses import replace

import numpy as np
import pytest

import coated_contact as cc
from conftest import make_system

BODIES = [1e-3, 2e6, 3.5e6, 0.45, 1e-5, 2e11, 0.25]


def contact_of(numbers):
    return cc.Table.embedded().contact(make_system(*numbers))


def stack_of(numbers):
    film, nu1, thickness, other, base, nu0 = numbers
    layers = [
        cc.Layer(material=cc.Elastic(young_modulus=young, poisson_ratio=nu1), thickness=thickness)
        for young in (other, film)
    ]
    return cc.Stack(base=cc.Elastic(young_modulus=base, poisson_ratio=nu0), layers=layers)


LAYERS = [3.5e6, 0.45, 5e-6, 5e5, 2e11, 0.25]


def read(stiffness, sensitivity):
    """Deflections in volts at three heights."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.write("height [m],deflection [V]\n" + "1e-6,1\n2e-6,2\n3e-6,4\n")
        file.flush()
        glass = cc.Elastic(young_modulus=64e9, poisson_ratio=0.2)
        system = cc.HalfSpace(sphere_radius=1e-5, sphere_modulus=np.inf, solid=glass)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # A negative sensitivity turns the sense of the force.
            found = cc.read_experiment(
                file.name, system=system, stiffness=stiffness, sensitivity=sensitivity
            )
    return [*found.abscissa, *found.ordinate]


def experiment_of(numbers, kind="load-radius", **known):
    """A lens with five points, or a cantilever."""
    first, last, w, offset, contact_point, baseline, slope, stiffness, noise = numbers
    return cc.Experiment(
        kind=kind,
        abscissa=[first, 6e-5, 7e-5, 8e-5, last],
        system=contact_of(BODIES).system,
        work_of_adhesion=w,
        load_offset=offset,
        contact_point=contact_point,
        baseline=baseline,
        baseline_slope=slope,
        stiffness=stiffness,
        noise=noise,
        **known,
    )


LENS = [5e-5, 1e-4, 0.04, 0.0, 0.0, 0.0, 0.0, 1.0, 1e-6]


def cantilever(*numbers):
    found = cc.predict(experiment_of(numbers, "force-height"), ["film_modulus", "stiffness"])
    return [*found.ordinate, *found.contact_radius, *found.derivatives["film_modulus"]]


def relaxing(*numbers):
    """A film that relaxes under an approach, a hold and a retract."""
    exponent, reference, point, duration, depth = numbers
    one = cc.Experiment(
        kind="load-penetration",
        abscissa=[depth * part for part in (-0.1, 0.3, 1.0, 1.0, 0.4, -0.2)],
        time=[duration * part for part in (0.0, 0.1, 0.3, 0.5, 0.7, 1.0)],
        system=contact_of(BODIES).system,
        contact_point=point,
        relaxation=cc.Relaxation.power_law(exponent, reference),
    )
    found = cc.predict(one, ["film_modulus", "relaxation_exponent", "contact_point"])
    return [*found.ordinate, *found.contact_radius, *found.derivatives["relaxation_exponent"]]


def measured(loads, w=0.04):
    return replace(experiment_of(LENS), ordinate=loads, work_of_adhesion=w)


def fitted(*numbers):
    *loads, w, start, low, high, mean, width = numbers
    free = cc.Free(parameter="film_modulus", start=start, bounds=(low, high), prior=(mean, width))
    found = cc.fit(measured(loads, w), [free, "work_of_adhesion"])
    return list(found.params.values())


def likely(*numbers):
    """The likelihood, not its logarithm, which is infinite where that is 0."""
    *loads, noise, low, high, mean, width, modulus, w = numbers
    free = cc.Free(parameter="film_modulus", bounds=(low, high), prior=(mean, width))
    given = replace(measured(loads), noise=noise)
    likelihood = cc.log_likelihood(given, [free, "work_of_adhesion"])
    value, gradient = likelihood.value_and_gradient([modulus, w])
    return [np.exp(min(value, 0.0)), *(gradient if np.isfinite(value) else [])]


class Afm:
    """What `read_afm` uses of afmformats, with one curve of three points."""

    supported_extensions = (".csv",)
    columns = columns_innate = ("force", "height (measured)", "segment")
    modality = "force-distance"

    @property
    def formats(self):
        return self

    def load_data(self, path, meta_override):
        curve = Afm()
        curve.metadata = meta_override
        return [curve]

    def __getitem__(self, column):
        return {
            "force": np.array([0.0, 1e-9, 4e-9]) * self.metadata["sensitivity"] / 5e-8,
            "height (measured)": np.array([3e-6, 2e-6, 1e-6]),
            "segment": np.zeros(3, dtype=np.uint8),
        }[column]


def from_afm(stiffness, sensitivity, surface, zero):
    with tempfile.NamedTemporaryFile(suffix=".csv") as file, pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "afmformats", Afm())
        (found,) = cc.read_afm(
            file.name,
            system=contact_of(BODIES).system,
            stiffness=stiffness,
            sensitivity=sensitivity,
            height_image=[surface],
            zero_level=zero,
        )
    return [*found.abscissa, *found.ordinate, found.system.film_thickness]


LOADS = [-1.8e-4, -1.1e-4, 4e-5, 3e-4, 7e-4]


def counted(*loads):
    return float(len(cc.branches(measured(loads), ["work_of_adhesion"])))


def mapped(*loads):
    found = cc.fit_map([measured(loads)], ["film_modulus", "work_of_adhesion"], errors="nan")
    if found.failures:
        raise found.failures[0]
    return [float(values[0]) for values in found.params.values()]


def on_layers(*numbers):
    """The prediction on a stack, with its differences."""
    film, nu1, thickness, other, base, nu0, w, offset = numbers
    stack = stack_of([film, nu1, thickness, other, base, nu0])
    layers = [replace(one, name=name) for one, name in zip(stack.layers, "ab", strict=True)]
    system = cc.StackSystem(
        stack=replace(stack, layers=layers), sphere_radius=1e-3, sphere_modulus=2e6
    )
    one = replace(experiment_of(LENS), system=system, work_of_adhesion=w, load_offset=offset)
    found = cc.predict(one, ["b.modulus"])
    return [*found.ordinate, *found.derivatives["b.modulus"]]


# The functions by their names, as in `test_hostile.py`.
EXPERIMENTS = {
    "read_experiment": ([0.1, 1e-7], read),
    "predict": (LENS, lambda *n: cc.predict(experiment_of(n), ["film_modulus"]).ordinate),
    "predict in time": ([0.2, 1.0, 0.0, 2.0, 1e-6], relaxing),
    "predict against heights": ([4e-5, 9e-5, *LENS[2:]], cantilever),
    "simulate": (
        [*LENS, 1e-6],
        lambda *n: cc.simulate(experiment_of(n[:9]), noise=n[9], seed=1).ordinate,
    ),
    "forecast": (
        LENS,
        lambda *n: cc.forecast(experiment_of(n), ["film_modulus"]).estimates[0].value,
    ),
    "design": (
        LENS,
        lambda *n: list(
            cc.design([experiment_of(n)], ["film_modulus"], about="film_modulus").stderr.values()
        ),
    ),
    "log_likelihood": ([*LOADS, 1e-6, 1e5, 1e8, 3e6, 1e6, 3.5e6, 0.04], likely),
    "read_afm": ([0.05, 5e-8, 1e-5, 1e-6], from_afm),
    "branches": (LOADS, counted),
    "fit": ([*LOADS, 0.04, 3e6, 1e5, 1e8, 3e6, 1e6], fitted),
    "predict on layers": ([*LAYERS, 0.04, 0.0], on_layers),
    "fit_map": (LOADS, mapped),
}
