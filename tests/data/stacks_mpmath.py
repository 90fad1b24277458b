"""Writes stacks_mpmath.csv, the surface compliance X(q) of random stacks of layers and its slope q X'(q), by mpmath.

    python3 stacks_mpmath.py [COUNT] > stacks_mpmath.csv

Stack i is drawn by `Stack` from a linear congruential generator; tests/truth/stacks.rs draws the same stacks. All numbers drawn are
doubles, and the thickness of the top layer is a power of 2, so that q = k h_top is exact.

X comes from the surface compliance of what lies below each height, as a 2 x 2 matrix, carried upwards with the exponential of the
4 x 4 matrix of the layer's differential equation, with enough digits to make every cancellation harmless. The program under test
carries minors instead. The slope is mpmath's difference quotient.
"""

import sys

import mpmath
from mpmath import mpf

HEAD = f"""\
# Surface compliance X(q) of random stacks of layers, q = k h_top, relative to the top layer, and its slope q X'(q), computed by
# stacks_mpmath.py beside this file with mpmath {mpmath.__version__}. Row i belongs to the stack drawn with seed i.
x,excess,slope"""

POISSON_RATIOS = [0.5, 0.499999, 0.5, 0.25, 0.0, -0.5, -0.9, 0.4999999999]


class Generator:
    """Knuth's 64-bit linear congruential generator; the upper 32 bits of its states are used."""

    def __init__(self, seed):
        self.state = seed
        for _ in range(4):
            self.integer(1)

    def integer(self, below):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 32) % below

    def power(self, first, count):
        """(1 + u) 2^k with u in steps of 2^-16 and k from `first`, `count` values."""
        mantissa = 1.0 + self.integer(2**16) / 2.0**16
        return mantissa * 2.0 ** (first + self.integer(count))

    def poisson_ratio(self):
        if self.integer(2) == 0:
            return POISSON_RATIOS[self.integer(len(POISSON_RATIOS))]
        return 0.5 - 1.4 * (self.integer(2**16) / 2.0**16)


class Stack:
    def __init__(self, seed):
        draw = Generator(seed)
        count = [1, 2, 3, 4, 5, 8, 13, 40][draw.integer(8)]
        spread = [1, 4, 12, 28][draw.integer(4)]
        self.base = None if draw.integer(4) == 0 else (draw.power(0, spread), draw.poisson_ratio())
        self.layers = [
            (draw.power(0, spread), draw.poisson_ratio(), draw.power(-13, 13)) for _ in range(count)
        ]
        young, nu, _ = self.layers[-1]
        self.layers[-1] = (young, nu, 2.0 ** (draw.integer(13) - 13))
        self.q = draw.power(-27, 33)


def shear(young, nu):
    return mpf(young) / (2 * (1 + mpf(nu)))


def matrix(nu):
    """The matrix M of (U, W, S, P)' = M (U, W, S, P), stresses in units of k G."""
    nu = mpf(nu)
    b, l, e = (1 - 2 * nu) / (2 * (1 - nu)), nu / (1 - nu), 2 / (1 - nu)
    return mpmath.matrix([[0, 1, 1, 0], [-l, 0, 0, b], [e, 0, 0, l], [0, 0, -1, 0]])


def of_half_space(nu):
    """The solutions that vanish far below: (M^2 - 1)^2 = 0, so that the columns of (M + 1)^2 grow upwards."""
    square = (matrix(nu) + mpmath.eye(4)) ** 2
    return compliance(square[:, 0:2])


def compliance(fields):
    """C in (U, W) = C (S, P) of two solutions."""
    return fields[0:2, :] * fields[2:4, :] ** -1


def across(c, nu, q):
    m = matrix(nu)
    sinh, cosh = mpmath.sinh(q), mpmath.cosh(q)
    fields = mpmath.matrix(4, 2)
    fields[0:2, :] = c
    fields[2, 0] = fields[3, 1] = 1
    total = mpmath.matrix(4, 2)
    for factor in [
        cosh - q / 2 * sinh,
        (3 * sinh - q * cosh) / 2,
        q / 2 * sinh,
        (q * cosh - sinh) / 2,
    ]:
        total += factor * fields
        fields = m * fields
    return compliance(total)


def x(stack, q):
    """X at q = k h_top."""
    k = q / mpf(stack.layers[-1][2])
    if stack.base is None:
        c, unit = mpmath.zeros(2), mpf(1)
    else:
        c, unit = of_half_space(stack.base[1]), shear(*stack.base)
    for young, nu, thickness in stack.layers:
        c, unit = c * (shear(young, nu) / unit), shear(young, nu)
        # e^-240 = 1e-104: what lies below does not count.
        c = across(c, nu, k * thickness) if k * thickness < 120 else of_half_space(nu)
    young, nu, _ = stack.layers[-1]
    return c[1, 1] / (1 - mpf(nu))


mpmath.mp.dps = 280
count = int(sys.argv[1]) if len(sys.argv) > 1 else 2000
print(HEAD)
for seed in range(count):
    stack = Stack(seed)
    q = mpf(stack.q)
    value, step = x(stack, q), mpf(10) ** -60
    slope = (x(stack, q * (1 + step)) - x(stack, q * (1 - step))) / (2 * step)
    print(",".join(mpmath.nstr(number, 20, strip_zeros=False) for number in (value, value - 1, slope)))
