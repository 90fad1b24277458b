"""Writes compliance_mpmath.csv, the surface compliance X(q) of a coated half-space and its slope q X'(q), by mpmath.

    python3 compliance_mpmath.py > compliance_mpmath.csv

X is evaluated from the textbook (exponential) form, which cancels at small q, with enough digits to make that harmless; q X' is
mpmath's numerical derivative of the same form, not an analytic one. Every input is a double, converted exactly.
"""

import mpmath
from mpmath import mpf

DIGITS = 40
"""Significant digits printed."""

HEAD = f"""\
# Surface compliance X(q) of a film on a substrate and its slope q X'(q), computed by compliance_mpmath.py beside this file
# with mpmath {mpmath.__version__} at 160 digits from the exponential form
#   X = [1 + 4 b q e^-2q - a b e^-4q] / [1 - (a + b + 4 b q^2) e^-2q + a b e^-4q],
#   a = (m g0 - g1)/(1 + m g0), b = (m - 1)/(m + g1), g = 3 - 4 nu, m = G1/G0 = (e1/e0) (1 + nu0)/(1 + nu1).
# The inputs are the doubles nearest to the printed numbers (shortest form that reads back to the same double). x and slope are
# printed with {DIGITS} digits; the slope is a numerical derivative, good to at least 30.
q,e1_over_e2,nu1,e0_over_e2,nu0,x,slope"""

BEFORE_SWITCH, AFTER_SWITCH = 0.999999999, 1.000000001
INF = float("inf")

# e1_over_e2, nu1, e0_over_e2, nu0, wave numbers
CASES = [
    (1.0, 0.5, INF, 0.25, [1e-9, 1e-6, 1e-3, 0.03, 0.3, BEFORE_SWITCH, 1.0, AFTER_SWITCH, 1.7, 4.0, 30.0]),
    (1.0, 0.5 - 1e-12, INF, 0.0, [1e-9, 1e-6, 1e-3, 0.1, 1.0, AFTER_SWITCH]),
    (1.0, 0.4999999, INF, 0.25, [1e-9, 1e-4, 1e-2, 0.7, AFTER_SWITCH]),
    (1.0, 0.49, INF, 0.5, [1e-6, 0.05, 0.4, 1.0, 2.5]),
    (1.0, 0.3, INF, 0.25, [1e-9, 0.2, BEFORE_SWITCH, AFTER_SWITCH, 12.0]),
    (1.0, 0.0, INF, 0.0, [1e-3, 0.6, 1.3]),
    (1.0, -0.5, INF, 0.25, [1e-6, 0.8, AFTER_SWITCH, 6.0]),
    (1.0, 0.5, 1e8, 0.25, [1e-9, 1e-3, 0.02, 0.5, BEFORE_SWITCH, AFTER_SWITCH]),
    (1.75, 0.5, 1e5, 0.25, [1e-9, 1e-2, 0.3, 1.0, 1.000000001, 3.0]),
    (1.0, 0.4999999, 1e3, 0.0, [1e-4, 0.1, 1.1]),
    (1.0, 0.49, 10.0, 0.5, [1e-9, 0.4, 1.0, 8.0]),
    (1.0, 0.3, 2.0, 0.25, [1e-2, BEFORE_SWITCH, AFTER_SWITCH]),
    (1.0, 0.3, 1.0 + 2.0**-40, 0.3, [1e-3, 1.0, AFTER_SWITCH]),
    (1.0, 0.5, 0.1, 0.0, [1e-6, 0.3, BEFORE_SWITCH, AFTER_SWITCH]),
    (1.0, 0.0, 1e-2, 0.5, [1e-3, 0.2, 1.0, 2.0]),
    (1.0, -0.5, 1e-4, 0.25, [1e-9, 1e-4, 0.05, 1.0, AFTER_SWITCH]),
    (1.0, 0.3, 1e-6, 0.25, [1e-9, 1e-6, 1e-2, 0.3, BEFORE_SWITCH, AFTER_SWITCH, 20.0]),
    (1.0, 0.5, 1e-6, 0.5, [1e-7, 1e-2, 1.0, 5.0]),
]


def compliance(q, e1, nu1, e0, nu0):
    ratio = mpf(0) if mpmath.isinf(e0) else e1 / e0
    m = ratio * (1 + nu0) / (1 + nu1)
    g1, g0 = 3 - 4 * nu1, 3 - 4 * nu0
    a = (m * g0 - g1) / (1 + m * g0)
    b = (m - 1) / (m + g1)
    e = mpmath.exp(-2 * q)
    return (1 + 4 * b * q * e - a * b * e**2) / (1 - (a + b + 4 * b * q**2) * e + a * b * e**2)


mpmath.mp.dps = 160
print(HEAD)
for *material, wave_numbers in CASES:
    exact = [mpf(v) for v in material]
    for q in wave_numbers:
        x = compliance(mpf(q), *exact)
        # A central difference in units of q: relative truncation error about 1e-60, of its cancellation 1e-40 or better.
        slope = mpmath.diff(lambda u: compliance(mpf(q) * u, *exact), mpf(1), h=mpf("1e-30"))
        inputs = [repr(v) for v in (q, *material)]
        print(",".join(inputs + [mpmath.nstr(v, DIGITS, min_fixed=1, max_fixed=0) for v in (x, slope)]))
