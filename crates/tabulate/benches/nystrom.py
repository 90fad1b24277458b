"""The equation of `tabulate::solve::solve` by Nystrom's method with numpy and scipy, in the straightforward way:

    g(rho)/es + (x/e1) int_0^1 [k(x(rho-s)) + k(x(rho+s))] g(s) ds = f(rho)
    k(y) = (1/pi) int_0^inf (X(q)-1) cos(qy) dq

on Gauss-Legendre abscissae in s. k is a sum over panels of Gauss-Legendre abscissae in q.

Prints a line with the versions of numpy and scipy. Then each line of the input is a case in JSON: the arguments of `solve` and the
number of repetitions. Its answer is a line of JSON with the four quantities and the seconds of each repetition.
"""

import json
import math
import sys
import time
from functools import lru_cache

import numpy as np
import scipy

NODES_PER_PANEL = 16
SINH_SERIES = [1 / math.factorial(k) for k in range(19, 1, -2)]  # (sinh q - q)/q^3 as a polynomial in q^2, for q <= 1


@lru_cache(maxsize=None)  # a rule serves every contact, so its making is not timed
def gauss(n):
    """Nodes and weights on [0, 1]."""
    nodes, weights = scipy.special.roots_legendre(n)
    return 0.5 + 0.5 * nodes, 0.5 * weights


def excess(q, m, nu1, nu0):
    """X(q) - 1 for the ratio m of the shear moduli of film and substrate, with an absolute error of rounding."""
    g1, g0 = 3 - 4 * nu1, 3 - 4 * nu0
    c0 = m * (1 + g1) * (1 + g0)
    c1 = 2 * m**2 * g0 + m * (g0 - 1) * (g1 - 1) + 2 * g1
    c2 = 4 * m**2 * g0 - 8 * m * nu1 * (1 - 2 * nu0) + 4 * (1 - 2 * nu1)
    c3 = (1 + g1) ** 2
    c4 = (1 + g1) * (m * (g0 - 1) + 2)

    sinh, cosh, square = np.sinh(q), np.cosh(q), q * q
    rest = np.where(q < 1, q * square * np.polyval(SINH_SERIES, square), sinh - q)  # sinh q - q
    sinh_rest = 2 * rest * cosh + 4 * q * np.sinh(q / 2) ** 2  # sinh 2q - 2q
    cosh_rest = 2 * rest * (sinh + q)  # cosh 2q - 1 - 2q^2
    numerator = c0 * (0.5 + sinh * sinh) + c1 / 2 * sinh_rest + c2 * q
    denominator = c3 / 2 + c1 / 2 * cosh_rest + c0 * sinh * cosh + c4 * square
    return (numerator - denominator) / denominator


def solve(a_over_t, e1_over_e2, nu1, e0_over_e2, nu0, nodes, panels, cutoff):
    """The four quantities, from g at `nodes` abscissae and `panels` equal panels that end at q = `cutoff`."""
    e1 = e1_over_e2 / (1 - nu1**2)
    es = 1 / (1 + 1 / e1)
    m = e1_over_e2 / e0_over_e2 * (1 + nu0) / (1 + nu1)

    rule, rule_weights = gauss(NODES_PER_PANEL)
    width = cutoff / panels
    q = width * np.add.outer(np.arange(panels), rule).ravel()
    symbol = np.tile(2 / math.pi * a_over_t / e1 * width * rule_weights, panels) * excess(q, m, nu1, nu0)

    s, weights = gauss(nodes)
    rho = np.append(s, 1.0)  # at the edge, the equation is Nystrom's interpolation formula
    cosines = np.cos(np.outer(a_over_t * rho, q))
    kernel = (cosines * symbol) @ cosines[:-1].T * weights
    f = np.column_stack((np.ones_like(rho), rho**2))

    matrix, edge_row = kernel[:-1], kernel[-1]
    matrix.flat[:: nodes + 1] += 1 / es
    # Not faster by scipy's Cholesky, which would also fail where too few nodes leave the matrix indefinite.
    g = np.linalg.solve(matrix, f[:-1])
    gamma, edge = es * (f[-1] - edge_row @ g)

    eeq, total = weights @ g
    delta0 = edge / gamma
    return {"pi0": 4 * (delta0 * eeq - total), "eeq": eeq, "gamma": gamma, "delta0": delta0}


def seconds(case):
    start = time.perf_counter()
    solve(**case)
    return time.perf_counter() - start


def main():
    print(f"numpy {np.__version__}, scipy {scipy.__version__}", flush=True)
    for line in sys.stdin:
        case = json.loads(line)
        repetitions = case.pop("repetitions")
        quantities = solve(**case)  # also the warm-up
        print(json.dumps({"quantities": quantities, "seconds": [seconds(case) for _ in range(repetitions)]}), flush=True)


main()
