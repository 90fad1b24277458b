"""Every function takes any float: it returns finite numbers or raises a ContactError."""

import inspect
from dataclasses import replace

import numpy as np
import pytest

import coated_contact
import coated_contact as cc
from hostile_experiments import BODIES, EXPERIMENTS, LAYERS, contact_of, stack_of

ENDS = [0.0, 5e-324, 1e-310, 2.3e-308, 1e-154, 1e-30, 2.2e-16, 0.25, 0.5, 1.0, 1e30, 1e154, 1.8e308]
HOSTILE = [sign * value for value in [*ENDS, np.inf] for sign in (1, -1)] + [np.nan]


def half_space_of(numbers):
    radius, sphere, solid, nu = numbers
    solid = cc.Elastic(young_modulus=solid, poisson_ratio=nu)
    system = cc.HalfSpace(sphere_radius=radius, sphere_modulus=sphere, solid=solid)
    return cc.Contact.half_space(system)


def cohesive_of(numbers):
    system = contact_of(numbers[:7]).system
    return cc.Cohesive(system=system, work_of_adhesion=numbers[7], interaction_range=numbers[8])


def numbers_of(state):
    """The numbers of a state."""
    return [getattr(state, name) for name in state.__slots__]


def all_of(states):
    """The numbers of states."""
    return [number for state in states for number in numbers_of(state)]


def stated(equilibria):
    """The numbers of equilibria."""
    return all_of(one.state for one in equilibria)


def ranged(contact, w, z0):
    return contact.zone_size(w, interaction_range=z0)


def attracted(contact, w, stress):
    return contact.cohesive_zone(w, stress=stress)


def gradient(contact, a, w):
    found = contact.gradient(a, w)
    return [found.load, found.penetration, found.by("film_modulus").load]


def curve(equilibria, most):
    found = equilibria.force_displacement(most=most, points=3)
    return [number for branch in found.unloading for number in all_of(branch)]


def validity(contact, a):
    found = contact.validity(a)
    return [found.a_over_r, found.shape, found.sideways, found.a_over_t, found.strain]


def line_of(numbers):
    advancing, receding, radius = numbers
    law = cc.Hysteresis(advancing=advancing, receding=receding)
    return half_space_of([1e-3, 2e6, 3.5e6, 0.45]).line(law, radius)


def moved(line, value):
    state = line.impose("load", value)
    return [] if state is None else numbers_of(state)


def ramped(*numbers):
    slow, v0, n, value, duration = numbers
    line = half_space_of([1e-3, 2e6, 3.5e6, 0.45]).line(
        cc.RateDependent(slow=slow, v0=v0, n=n), 65e-6
    )
    found = line.ramp("load", value, duration=duration, tolerance=1e-2)
    return [*found.load, *found.energy_release_rate]


def followed(contact, exponent, duration, depth, relaxed, time, at):
    """A penetration up and down under one law, and a load that grows under another."""
    power = cc.Relaxation.power_law(exponent, time)
    program = [0.0, duration, 2.0 * duration]
    found = contact.history(program, power, penetration=[0.0, depth, 0.0], at=[at], tolerance=1e-2)
    zener = cc.Relaxation.prony(relaxed, time)
    grown = contact.history(program[:2], zener, load=[0.0, depth], at=[at], tolerance=1e-2)
    return [*found.load, *found.contact_radius, *grown.penetration]


def graded(*numbers):
    thickness, soft, stiff, a_over_t = numbers

    def material(height):
        part = height / thickness if thickness else 0.0
        return cc.Elastic(young_modulus=soft + (stiff - soft) * part, poisson_ratio=0.3)

    base = cc.Elastic(young_modulus=2e11, poisson_ratio=0.3)
    stack = cc.Stack.graded(base=base, thickness=thickness, count=3, material=material)
    return cc.solve_stack(a_over_t, stack, 2e6, 1e-4).gamma


def scene(*numbers):
    low, high, soft, stiff, nu1, base = numbers
    table = cc.generate(
        {
            "title": "x",
            "tolerance": 1e-2,
            "a_over_t": {"from": low, "to": high, "nodes": 3},
            "e1_over_e2": {"from": soft, "to": stiff, "nodes": 3},
            "nu1": nu1,
            "e0_over_e2": base,
        },
        progress=False,
        certificate_points=1,
    )
    return [*table.values["gamma"].ravel(), table.max_error]


def on_table(table, numbers):
    modulus, radius, a, w = numbers
    system = cc.StackSystem(stack=table.stack, sphere_radius=radius, sphere_modulus=modulus)
    return table.contact(system).load(a, w)


def on_film(valid, function):
    """Valid numbers, and a function of the contact of such bodies and further numbers."""
    return [*BODIES, *valid], lambda *n: function(contact_of(n[:7]), *n[7:])


def cohesive(valid, function):
    """Valid numbers, and a function of an attraction between fixed bodies and further numbers."""
    return [0.04, 1e-8, *valid], lambda *n: function(cohesive_of([*BODIES, *n[:2]]), *n[2:])


def under(make, *valid, a=2e-6):
    """Valid numbers and the function of a contact under a probe."""

    def function(*numbers):
        *shape, a, w = numbers
        system = replace(contact_of(BODIES).system, probe=make(*shape))
        return cc.Table.embedded().contact(system).load_and_penetration(a, w)

    return [*valid, a, 0.04], function


# The functions by their names, with a word where one has several entries: valid numbers, and the
# function of them.
FUNCTIONS = {
    "Contact.load": on_film([65e-6, 0.04], cc.Contact.load),
    "Contact.penetration": ([65e-6, 0.04], lambda *n: contact_of(BODIES).penetration(*n)),
    "Contact.load_and_penetration": on_film([65e-6, 0.04], cc.Contact.load_and_penetration),
    "Contact.stiffness": on_film([65e-6], cc.Contact.stiffness),
    "Contact.moving_stiffness": on_film([65e-6, 0.04], cc.Contact.moving_stiffness),
    "Contact.gradient": on_film([65e-6, 0.04], gradient),
    "Contact.pull_off": on_film([0.04], lambda c, w: numbers_of(c.pull_off(w))),
    "Contact.pull_off by a spring": on_film(
        [0.04, 5.0], lambda c, w, k: numbers_of(c.pull_off(w, control=cc.Spring(stiffness=k)))
    ),
    "Contact.work_of_adhesion_at_pull_off": on_film(
        [-1e-6], cc.Contact.work_of_adhesion_at_pull_off
    ),
    "Contact.energy_release_rate at loads": on_film(
        [65e-6, -1e-6], lambda c, a, f: c.energy_release_rate(a, load=f)
    ),
    "Contact.energy_release_rate at penetrations": on_film(
        [65e-6, 1e-6], lambda c, a, d: c.energy_release_rate(a, penetration=d)
    ),
    "Contact.equilibria": on_film([0.04, 1e-4], lambda c, w, f: stated(c.equilibria(w).at(f))),
    "Contact.force_displacement": on_film(
        [0.04, 1e-6, 5.0],
        lambda c, w, most, k: curve(c.equilibria(w, control=cc.Spring(stiffness=k)), most),
    ),
    "Contact.half_space": (
        [1e-3, 2e6, 3.5e6, 0.45, 65e-6, 0.04],
        lambda *n: half_space_of(n[:4]).load_and_penetration(n[4], n[5]),
    ),
    "Contact.line": ([0.03, 0.05, 65e-6], lambda *n: numbers_of(line_of(n).state)),
    "Contact.validity": on_film([65e-6], validity),
    "Contact.zone_size": on_film([0.04, 3e-10], lambda *n: ranged(*n).tabor),
    "Contact.cohesive_zone": on_film([0.04, 1e8], lambda *n: attracted(*n).zone),
    "ZoneSize.pull_off_error": on_film([0.04, 3e-10], lambda *n: ranged(*n).pull_off_error()),
    "Equilibria.at": on_film(
        [0.04, 1e-6], lambda c, w, d: stated(c.equilibria(w, control="displacement").at(d))
    ),
    "Equilibria.loading": on_film(
        [0.04, 1e-4], lambda c, w, f: numbers_of(c.equilibria(w).loading(f))
    ),
    "Equilibria.unloading": on_film(
        [0.04, 1e-4], lambda c, w, f: numbers_of(c.equilibria(w).unloading(f))
    ),
    "Equilibria.pull_off": on_film(
        [0.04], lambda c, w: numbers_of(c.equilibria(w, control="displacement").pull_off())
    ),
    "Equilibria.force_displacement": on_film(
        [0.04, 1e-4], lambda c, w, most: curve(c.equilibria(w), most)
    ),
    "ShortZone.state": on_film(
        [0.04, 1e8, 65e-6], lambda c, w, s, a: numbers_of(attracted(c, w, s).state(a))
    ),
    "ShortZone.pull_off": on_film(
        [0.04, 1e8, 5.0],
        lambda c, w, s, k: numbers_of(attracted(c, w, s).pull_off(control=cc.Spring(stiffness=k))),
    ),
    "ShortZone.equilibria": on_film(
        [0.04, 1e8, 1e-4], lambda c, w, s, f: stated(attracted(c, w, s).equilibria(f))
    ),
    "Contact.history": on_film([0.2, 1.0, 1e-7, 0.3, 0.7, 1e-4], followed),
    "ContactLine.impose": ([0.03, 0.05, 65e-6, 1e-3], lambda *n: moved(line_of(n[:3]), n[3])),
    "ContactLine.ramp": ([0.04, 1e-6, 0.6, 5e-4, 1.0], ramped),
    "RateDependent.energy_release_rate": (
        [0.03, 0.05, 1e-6, 0.6, 1e-6],
        lambda *n: cc.RateDependent(
            slow=cc.Hysteresis(advancing=n[0], receding=n[1]), v0=n[2], n=n[3]
        ).energy_release_rate(n[4]),
    ),
    "Cohesive.state": (
        [*BODIES, 0.04, 1e-8, 65e-6],
        lambda *n: numbers_of(cohesive_of(n[:9]).state(n[9])),
    ),
    "Cohesive.without_contact": (
        [*BODIES, 0.04, 1e-6, 1e-6],
        lambda *n: numbers_of(cohesive_of(n[:9]).without_contact(n[9])),
    ),
    "Cohesive.branch": cohesive([5e-5, 7e-5], lambda c, *ends: all_of(c.branch(ends, 2))),
    "Cohesive.pull_off": cohesive(
        [5.0], lambda c, k: numbers_of(c.pull_off(control=cc.Spring(stiffness=k)))
    ),
    "Cohesive.pressure": cohesive([65e-6, 1e-6], cc.Cohesive.pressure),
    "Cohesive.gap": cohesive([65e-6, 65.1e-6], cc.Cohesive.gap),
    "solve": (
        [1.5, 1.75, 0.45, 1e5, 0.25, 1e-6],
        lambda *n: [cc.solve(*n).gamma, cc.solve(*n).error],
    ),
    "solve_stack": (
        [*LAYERS, 1.5, 2e6],
        lambda *n: cc.solve_stack(n[6], stack_of(n[:6]), n[7], 1e-6).eeq,
    ),
    "solve_stick_punch": (
        [1.0, 1.75, 0.5, 1e5, 0.25, 0.5, 1e-6],
        lambda *n: [cc.solve_stick_punch(*n).eeq_s, cc.solve_stick_punch(*n).gamma_eff],
    ),
    "stick_stiffening": on_film(
        [2e-5, 0.5, 1e-4],
        lambda c, a, nu2, t: cc.stick_stiffening(
            c.system, a, sphere_poisson_ratio=nu2, tolerance=t
        ),
    ),
    "SolvedCurve.contact": on_film(
        [0.5, 2.0, 1e-4],
        lambda c, low, high, tolerance: (
            cc.SolvedCurve(a_over_t=(low, high), tolerance=tolerance)
            .contact(c.system)
            .contact_radius_range
        ),
    ),
    "Stack.contact": (
        [*LAYERS, 1e-5, 0.04],
        lambda *n: (
            stack_of(n[:6])
            .contact(sphere_radius=1e-3, sphere_modulus=2e6, a_over_t=(0.5, 2), tolerance=1e-4)
            .load(n[6], n[7])
        ),
    ),
    "Stack.graded": ([1e-5, 1e6, 2e7, 1.5], graded),
    "Elastic": (
        [3.5e6, 0.45],
        lambda *n: cc.Elastic(young_modulus=n[0], poisson_ratio=n[1]).poisson_ratio,
    ),
    "Sphere": under(lambda r: cc.Sphere(radius=r), 1e-5),
    "PowerLaw": under(lambda c, n: cc.PowerLaw(coefficient=c, exponent=n), 2e9, 3.0),
    "Cone": under(lambda angle: cc.Cone(half_angle=angle), 1.2),
    "RoundedCone": under(lambda r, b: cc.RoundedCone(radius=r, half_angle=b), 2e-6, 1.0),
    "FlatPunch": under(lambda r: cc.FlatPunch(radius=r), 3e-6, a=3e-6),
    "FlatEndedCone": under(lambda r, b: cc.FlatEndedCone(radius=r, half_angle=b), 1e-6, 1.1),
    "Profile": under(
        lambda r, z, s, y: cc.Profile(points=[(0.0, 0.0), (r, z), (s, y)]), 2e-6, 1e-7, 4e-6, 4e-7
    ),
    "generate": ([0.5, 2.0, 1.0, 3.0, 0.45, 1e5], scene),
} | EXPERIMENTS

# Where one evaluation takes more than a millisecond, fewer random numbers are tried.
SLOW = ("Cohesive", "fit", "generate", "predict on", "Stack", "ContactLine.ramp", "Power", "Round")
SLOW += ("Cone", "FlatEnded")


def any_numbers(valid, random, count):
    """One number replaced by each hostile one, and random numbers in all places."""
    for i in range(len(valid)):
        for value in HOSTILE:
            yield [*valid[:i], value, *valid[i + 1 :]]
    for _ in range(count):
        chosen = random.random(len(valid)) < 0.3
        magnitude = 10.0 ** random.uniform(-9, 9, len(valid))
        bits = random.integers(0, 2**64, len(valid), dtype=np.uint64).view(np.float64)
        wild = np.where(random.random(len(valid)) < 0.5, bits, magnitude)
        yield [float(w) if c else v for w, c, v in zip(wild, chosen, valid, strict=True)]


def finite_or_refused(valid, function, count):
    """Check that numbers give finite results or a ContactError, and that more than 10 do each."""
    assert np.all(np.isfinite(function(*valid)))
    answered = refused = 0
    for numbers in any_numbers(valid, np.random.default_rng(1), count):
        try:
            result = function(*numbers)
        except cc.ContactError:
            refused += 1
        else:
            answered += 1
            assert np.all(np.isfinite(result)), numbers
    assert answered > 10
    assert refused > 10


@pytest.mark.parametrize("name", FUNCTIONS)
def test_any_numbers_give_finite_results_or_an_error(name):
    finite_or_refused(*FUNCTIONS[name], 30 if name.startswith(SLOW) else 300)


def test_a_table_of_a_stack(stack):
    ranges = {"a_over_t": {"from": 0.5, "to": 2}, "e1_over_e2": {"from": 1, "to": 3}}
    table = cc.generate({"title": "x", "tolerance": 1e-2, **ranges, "stack": stack}, progress=False)
    valid = [2e6, 1e-3, 1e-5, 0.04]
    finite_or_refused(valid, lambda *n: on_table(table, n), 300)


# What takes no float, or no native part answers.
OTHERS = {
    "Contact": (),
    "Equilibria": (),
    "ShortZone": (),
    "Cohesive": (),
    "ContactLine": (),
    "RateDependent": (),
    "ZoneSize": ("is_short_beside",),
    "Stack": ("read",),
    "SolvedCurve": (),
}


def test_every_function_is_tested():
    """The public functions, and the public methods of the classes that answer questions."""
    tested = {name.split(" ")[0] for name in FUNCTIONS}
    public = [name for name in coated_contact.__all__ if name[0].islower()]
    for name in public:
        assert name in tested, name
    for name, others in OTHERS.items():
        methods = inspect.getmembers(getattr(coated_contact, name), callable)
        for method, _ in methods:
            if not method.startswith("_") and method not in others:
                assert f"{name}.{method}" in tested, f"{name}.{method}"
    shapes = {one.__name__ for one in coated_contact.Probe.__subclasses__()}
    assert shapes - {"Paraboloid"} <= tested
