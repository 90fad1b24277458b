"""Writes complex_stiffness.csv, the contact stiffness of a viscoelastic film on an elastic substrate at one frequency, by numpy.

    python3 complex_stiffness.py > complex_stiffness.csv

The film has the complex Young's modulus |E1| exp(i phi) and a real Poisson ratio. The integral equation of the contact,
g(r)/es + (x/e1) int_0^1 [k(x(r - s)) + k(x(r + s))] g(s) ds = 1 with k(y) = (1/pi) int_0^inf (X(q) - 1) cos(qy) dq, is solved by
Nystrom's method with complex X, e1 and es; Eeq = int_0^1 g. It shares no code and no method with the solver of the program.
"""

import numpy as np

HEAD = """\
# Contact stiffness S/(2 a E2*) of a film with the complex modulus |E1| exp(i phi) on an elastic substrate, absolute value and
# argument (rad), computed by complex_stiffness.py beside this file by Nystrom's method with numpy in double precision. The numbers
# of abscissae halved change no value by more than 1e-9. e1_over_e2 is |E1|/E2*.
a_over_t,e1_over_e2,nu1,e0_over_e2,nu0,loss_tangent,eeq,phase"""


def hyperbolic(q):
    """Return sinh(2q), sinh(2q) - 2q, cosh(2q) and cosh(2q) - 1 - 2q^2, all divided by cosh(2q)."""
    y = 2 * q
    small = y < 1.5
    term_s, term_c = y**3 / 6, y**4 / 24
    sum_s, sum_c = np.zeros_like(y), np.zeros_like(y)
    for n in range(2, 24):
        sum_s, sum_c = sum_s + term_s, sum_c + term_c
        term_s = term_s * y * y / (2 * n * (2 * n + 1))
        term_c = term_c * y * y / ((2 * n + 1) * (2 * n + 2))
    scale = 2 * np.exp(-y) / (1 + np.exp(-2 * y))
    sinh = np.tanh(y)
    lacking_s = np.where(small, sum_s * scale, sinh - y * scale)
    lacking_c = np.where(small, sum_c * scale, 1 - (1 + y * y / 2) * scale)
    return sinh, lacking_s, lacking_c, scale


def compliance_less_1(q, m, nu1, nu0):
    """Return X(q) - 1 of film and substrate with the ratio m = G1/G0."""
    g1, g0 = 3 - 4 * nu1, 3 - 4 * nu0
    c0 = m * (1 + g1) * (1 + g0)
    c1 = 2 * m * m * g0 + m * (g0 - 1) * (g1 - 1) + 2 * g1
    c2 = 4 * m * m * g0 - 8 * m * nu1 * (1 - 2 * nu0) + 4 * (1 - 2 * nu1)
    c3 = (1 + g1) ** 2
    c4 = (1 + g1) * (m * (g0 - 1) + 2)
    sinh, lacking_s, lacking_c, scale = hyperbolic(q)
    numerator = c0 / 2 + c1 / 2 * lacking_s + c2 * q * scale
    denominator = c3 / 2 * scale + c1 / 2 * lacking_c + c0 / 2 * sinh + c4 * q * q * scale
    return numerator / denominator - 1


def stiffness(x, e1, nu1, e0, nu0, phi, refine=1):
    """Return the complex Eeq; e1 and e0 are Young's moduli over E2*."""
    young = e1 * np.exp(1j * phi)
    m = (young / e0) * (1 + nu0) / (1 + nu1)
    reduced = young / (1 - nu1**2)
    es = 1 / (1 + 1 / reduced)
    ends = np.concatenate([[0.0], np.geomspace(1e-7, 0.5, 40), np.arange(1.0, 24.0, 0.5)])
    nodes, weights = np.polynomial.legendre.leggauss(24 * refine)
    half = np.diff(ends)[:, None] / 2
    q = ((ends[:-1] + ends[1:])[:, None] / 2 + half * nodes).ravel()
    wq = (half * weights).ravel()
    r, wr = np.polynomial.legendre.leggauss(64 * refine)
    r, wr = (r + 1) / 2, wr / 2
    even = np.cos(np.outer(x * r, q))
    # cos(q(a - b)) + cos(q(a + b)) = 2 cos(qa) cos(qb)
    kernel = 2 / np.pi * (even * (wq * compliance_less_1(q, m, nu1, nu0))) @ even.T
    matrix = np.eye(len(r)) / es + x / reduced * kernel * wr
    return wr @ np.linalg.solve(matrix, np.ones(len(r), dtype=complex))


FILMS = [
    # |E1|/E2*, nu1, E0/|E1|, nu0
    (0.01, nu1, ratio, 0.25)
    for nu1 in (0.5, 0.45, 0.3)
    for ratio in (1e5, 100.0, 3.0)
] + [(1.0, 0.3, 0.5, 0.3), (1.0, 0.4, 0.1, 0.45), (0.06, 0.17, 2.4, 0.28)]

if __name__ == "__main__":
    print(HEAD)
    worst = 0.0
    for e1, nu1, ratio, nu0 in FILMS:
        for x in (0.3, 1.0, 3.0, 10.0):
            for near in (1.0, 1.05, 1.1):
                for tangent in (0.3, 1.0):
                    arguments = x * near, e1, nu1, e1 * ratio, nu0
                    found = stiffness(*arguments, np.arctan(tangent), refine=2)
                    coarse = stiffness(*arguments, np.arctan(tangent))
                    worst = max(worst, abs(found / coarse - 1))
                    numbers = *map(float, arguments), tangent, float(abs(found)), float(np.angle(found))
                    print(",".join(map(repr, numbers)))
    import sys

    print(f"largest change with half of the abscissae: {worst:.1e}", file=sys.stderr)
