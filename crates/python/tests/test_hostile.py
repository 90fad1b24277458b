"""Every function takes any float: it returns finite numbers or raises a ContactError."""

from dataclasses import replace

import numpy as np
import pytest

from coated_contact import (
    Cohesive,
    Cone,
    Contact,
    ContactError,
    Elastic,
    HalfSpace,
    Layer,
    Spring,
    Stack,
    System,
    Table,
    solve_stack,
)

ENDS = [0.0, 5e-324, 1e-310, 2.3e-308, 1e-154, 1e-30, 2.2e-16, 0.25, 0.5, 1.0, 1e30, 1e154, 1.8e308]
HOSTILE = [sign * value for value in [*ENDS, np.inf] for sign in (1, -1)] + [np.nan]

BODIES = [1e-3, 2e6, 3.5e6, 0.45, 1e-5, 2e11, 0.25]


def contact_of(numbers):
    radius, sphere, film, nu1, thickness, substrate, nu0 = numbers
    system = System(
        sphere_radius=radius,
        sphere_modulus=sphere,
        film=Elastic(young_modulus=film, poisson_ratio=nu1),
        film_thickness=thickness,
        substrate=Elastic(young_modulus=substrate, poisson_ratio=nu0),
    )
    return Table.embedded().contact(system)


def half_space_of(numbers):
    radius, sphere, solid, nu = numbers
    solid = Elastic(young_modulus=solid, poisson_ratio=nu)
    system = HalfSpace(sphere_radius=radius, sphere_modulus=sphere, solid=solid)
    return Contact.half_space(system)


def cone_of(numbers):
    half_angle, *others = numbers
    system = replace(contact_of([1e-3, *others]).system, probe=Cone(half_angle=half_angle))
    return Table.embedded().contact(system)


def stack_of(numbers):
    film, nu1, thickness, other, base, nu0 = numbers
    layers = [
        Layer(material=Elastic(young_modulus=young, poisson_ratio=nu1), thickness=thickness)
        for young in (other, film)
    ]
    return Stack(base=Elastic(young_modulus=base, poisson_ratio=nu0), layers=layers)


def cohesive_of(numbers):
    system = contact_of(numbers[:7]).system
    return Cohesive(system=system, work_of_adhesion=numbers[7], interaction_range=numbers[8])


def numbers_of(state):
    return [state.contact_radius, state.load, state.penetration]


def gradient(contact, a, w):
    found = contact.gradient(a, w)
    return [found.load, found.penetration, found.by("film_modulus").load]


def curve(contact, w, most, k):
    found = contact.force_displacement(w, control=Spring(stiffness=k), most=most, points=3)
    return [numbers_of(state) for branch in found.unloading for state in branch]


def equilibria(contact, w, imposed):
    return [numbers_of(one.state) for one in contact.equilibria(w).at(imposed)]


# A name, valid numbers, and the function of them.
FUNCTIONS = {
    "load": ([*BODIES, 65e-6, 0.04], lambda *n: contact_of(n[:7]).load(n[7], n[8])),
    "load_and_penetration": (
        [*BODIES, 65e-6, 0.04],
        lambda *n: contact_of(n[:7]).load_and_penetration(n[7], n[8]),
    ),
    "stiffness": ([*BODIES, 65e-6], lambda *n: contact_of(n[:7]).stiffness(n[7])),
    "gradient": ([*BODIES, 65e-6, 0.04], lambda *n: gradient(contact_of(n[:7]), n[7], n[8])),
    "pull_off": ([*BODIES, 0.04], lambda *n: numbers_of(contact_of(n[:7]).pull_off(n[7]))),
    "spring": (
        [*BODIES, 0.04, 5.0],
        lambda *n: numbers_of(contact_of(n[:7]).pull_off(n[7], control=Spring(stiffness=n[8]))),
    ),
    "equilibria": ([*BODIES, 0.04, 1e-4], lambda *n: equilibria(contact_of(n[:7]), n[7], n[8])),
    "loading": (
        [*BODIES, 0.04, 1e-4],
        lambda *n: numbers_of(contact_of(n[:7]).equilibria(n[7]).loading(n[8])),
    ),
    "unloading": (
        [*BODIES, 0.04, 1e-4],
        lambda *n: numbers_of(contact_of(n[:7]).equilibria(n[7]).unloading(n[8])),
    ),
    "force_displacement": (
        [*BODIES, 0.04, 1e-6, 5.0],
        lambda *n: curve(contact_of(n[:7]), n[7], n[8], n[9]),
    ),
    "half_space": (
        [1e-3, 2e6, 3.5e6, 0.45, 65e-6, 0.04],
        lambda *n: half_space_of(n[:4]).load_and_penetration(n[4], n[5]),
    ),
    "cone": (
        [1.2, *BODIES[1:], 5e-6, 0.04],
        lambda *n: cone_of(n[:7]).load_and_penetration(n[7], n[8]),
    ),
    "stack": (
        [3.5e6, 0.45, 5e-6, 5e5, 2e11, 0.25, 1.5, 2e6],
        lambda *n: solve_stack(n[6], stack_of(n[:6]), n[7], 1e-6).eeq,
    ),
    "contact_of_stack": (
        [3.5e6, 0.45, 5e-6, 5e5, 2e11, 0.25, 1e-5, 0.04],
        lambda *n: (
            stack_of(n[:6])
            .contact(sphere_radius=1e-3, sphere_modulus=2e6, a_over_t=(0.5, 2), tolerance=1e-4)
            .load(n[6], n[7])
        ),
    ),
    "cohesive": (
        [*BODIES, 0.04, 1e-8, 65e-6],
        lambda *n: cohesive_of(n[:9]).state(n[9]).load,
    ),
    "reduced_modulus": (
        [3.5e6, 0.45],
        lambda *n: Elastic(young_modulus=n[0], poisson_ratio=n[1]).poisson_ratio,
    ),
}


def any_numbers(valid, random):
    """One number replaced by each hostile one, and random numbers in all places."""
    for i in range(len(valid)):
        for value in HOSTILE:
            yield [*valid[:i], value, *valid[i + 1 :]]
    for _ in range(300):
        chosen = random.random(len(valid)) < 0.3
        magnitude = 10.0 ** random.uniform(-9, 9, len(valid))
        bits = random.integers(0, 2**64, len(valid), dtype=np.uint64).view(np.float64)
        wild = np.where(random.random(len(valid)) < 0.5, bits, magnitude)
        yield [float(w) if c else v for w, c, v in zip(wild, chosen, valid, strict=True)]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_any_numbers_give_finite_results_or_an_error(name):
    valid, function = FUNCTIONS[name]
    assert np.all(np.isfinite(function(*valid)))
    answered = refused = 0
    for numbers in any_numbers(valid, np.random.default_rng(1)):
        try:
            result = function(*numbers)
        except ContactError:
            refused += 1
        else:
            answered += 1
            assert np.all(np.isfinite(result)), numbers
    assert answered > 20
    assert refused > 20
