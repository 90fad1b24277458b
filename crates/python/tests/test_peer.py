"""A bonded layer on a rigid base, against the Green's function of the package ContactMechanics.

That peer has no answer for an incompressible layer (its Green's function divides by 1 - 2 nu), for
a base or a sphere that yields, or for adhesion.
"""

import numpy as np
import pytest

from coated_contact import Elastic, System, Table

mechanics = pytest.importorskip("ContactMechanics")
fft = pytest.importorskip("scipy.fft")


def load_of_peer(radius, penetration, nu, box, pixels):
    """The load on a rigid paraboloid over a layer with E = 1 and the thickness 1.

    The pressure is positive where the gap is 0, and 0 where the gap is positive: conjugate
    gradients on the pixels in contact, which change on the way (Polonsky and Keer, Wear 231, 206,
    1999). No pixel is at the apex: with one there, the error is more than ten times larger.
    """
    layer = mechanics.PeriodicFFTElasticHalfSpace(
        (pixels, pixels), 1.0, (box, box), thickness=1.0, poisson=nu
    )
    # Of a real even function; the transform of scipy halves the last axis, that of the peer the
    # first.
    compliance = np.asarray(layer.greens_function).real.T
    x = (np.arange(pixels) - pixels // 2 + 0.5) * box / pixels
    shape = penetration - (x[:, None] ** 2 + x**2) / (2 * radius)

    def displacement(pressure):
        return fft.irfft2(compliance * fft.rfft2(pressure), s=shape.shape)

    pressure = np.maximum(shape, 0.0)
    pressure *= np.sum(shape * pressure) / np.sum(pressure * displacement(pressure))
    direction, last = np.zeros_like(pressure), np.inf
    for _ in range(200):
        gap = displacement(pressure) - shape
        contact = pressure > 0
        square = np.sum(gap[contact] ** 2)
        direction = np.where(contact, gap + square / last * direction, 0.0)
        change = displacement(direction)
        step = np.sum(gap[contact] * direction[contact])
        step /= np.sum(change[contact] * direction[contact])
        pressure = np.maximum(pressure - step * direction, 0.0)
        overlap = (pressure == 0) & (gap < 0)
        pressure[overlap] -= step * gap[overlap]
        last = np.inf if overlap.any() else square
        if not overlap.any() and square < contact.sum() * (1e-9 * penetration) ** 2:
            return np.sum(pressure) * (box / pixels) ** 2
    raise AssertionError("the peer did not converge")


CASES = [(nu, x) for nu in (0.0, 0.3, 0.45) for x in (0.5, 2.0, 6.0)]


def error_of(nu, a_over_t, pixels):
    """The difference of the two loads, relative to ours."""
    rigid = Elastic(young_modulus=np.inf, poisson_ratio=0.25)
    layer = Elastic(young_modulus=1.0, poisson_ratio=nu)
    system = System(
        sphere_radius=1e3, sphere_modulus=np.inf, film=layer, film_thickness=1.0, substrate=rigid
    )
    load, penetration = Table.embedded().contact(system).load_and_penetration(a_over_t, 0.0)
    box = 2.6 * a_over_t + 12
    return load_of_peer(1e3, penetration, nu, box, pixels) / load - 1


@pytest.mark.parametrize(("nu", "a_over_t"), CASES)
def test_the_load_is_that_of_a_peer(nu, a_over_t):
    assert abs(error_of(nu, a_over_t, 256)) < 4e-5


@pytest.mark.large
@pytest.mark.parametrize(("nu", "a_over_t"), CASES)
def test_more_pixels_come_closer(nu, a_over_t):
    assert abs(error_of(nu, a_over_t, 512)) < 4e-6
