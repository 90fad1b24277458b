//! Legendre polynomials: the factors of their recurrences, and Gauss's quadrature.

use std::f64::consts::PI;

use interp::once::{Lazy, Once};

/// The numbers of coefficients of an expansion, ascending.
pub(super) const SIZES: [usize; 16] = [
    4, 6, 8, 11, 15, 20, 26, 34, 44, 56, 72, 92, 118, 152, 194, 248,
];
/// The most coefficients.
pub(super) const MOST: usize = SIZES[SIZES.len() - 1];

/// What belongs to the polynomials of even order `n = 2 j`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Even {
    /// `P_(n+1) = odd[0] x P_n - odd[1] P_(n-1)`.
    pub odd: [f64; 2],
    /// `P_(n+2) = even[0] x P_(n+1) - even[1] P_n`.
    pub even: [f64; 2],
    /// `1/(2n + 1)` and `1/(2n + 3)`.
    pub inverse: [f64; 2],
    /// `1/P_n(0)`.
    pub at_0: f64,
    /// With `J_n` the integral of `P_n(cos v)` from an angle `v` to `pi/2`, `J_(n+2) = angle[0] J_n -
    /// angle[1] sin(v) P_(n+1)(cos v)`.
    pub angle: [f64; 2],
}

/// The even orders, to two more than an expansion has.
pub(super) static EVEN: Lazy<Vec<Even>> = Lazy::new(|| {
    let mut at_0 = 1.0;
    let even = |j: usize| {
        let n = 2.0 * j as f64;
        let step = |n: f64| [(2.0 * n + 1.0) / (n + 1.0), n / (n + 1.0)];
        let own = Even {
            odd: step(n),
            even: step(n + 1.0),
            inverse: [1.0 / (2.0 * n + 1.0), 1.0 / (2.0 * n + 3.0)],
            at_0,
            angle: [
                ((n + 1.0) / (n + 2.0)).powi(2),
                (2.0 * n + 3.0) / (n + 2.0).powi(2),
            ],
        };
        at_0 *= -(n + 2.0) / (n + 1.0);
        own
    };
    (0..MOST + 2).map(even).collect()
});

/// The positive half of Gauss's points and weights on the interval from -1 to 1, for as many
/// coefficients as [`SIZES`] has: exact for the products of two expansions.
static RULES: [Once<Vec<[f64; 2]>>; SIZES.len()] = [const { Once::new() }; SIZES.len()];

/// Returns the points and weights for the coefficients of a size by number.
pub(super) fn rule(size: usize) -> &'static [[f64; 2]] {
    RULES[size].get_or_init(|| gauss(SIZES[size]))
}

/// Returns the positive ones of `2 half` points of Gauss and their weights, by Newton's method.
fn gauss(half: usize) -> Vec<[f64; 2]> {
    let count = 2.0 * half as f64;
    let point = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (count + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..6 {
            let (mut before, mut value) = (0.0, 1.0);
            for own in &EVEN[..half] {
                before = own.odd[0] * x * value - own.odd[1] * before;
                value = own.even[0] * x * before - own.even[1] * value;
            }
            slope = count * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..half).map(point).collect()
}
