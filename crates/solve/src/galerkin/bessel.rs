//! Even-order spherical Bessel functions, scaled as Legendre transforms.
//!
//! `J_n(z) = int_0^1 phi_n(rho) cos(z rho) d rho = (-1)^n sqrt(4n+1) j_2n(z)` for the even Legendre
//! basis `phi_n = sqrt(4n+1) P_2n`, orthonormal on `[0, 1]`. Eliminating the odd orders from the
//! three-term recurrence gives
//!
//! ```text
//! j_{v+2} = [(2v+1)(2v+3)/z^2 - 1 - (2v+3)/(2v-1)] j_v - (2v+3)/(2v-1) j_{v-2},      v = 2n
//! ```
//!
//! which is run upwards where all orders are below `z` and downwards (Miller) elsewhere, then
//! scaled by the expansion of `cos(z rho)` at `rho = 0`, `sum_n (4n+1) |P_2n(0)| j_2n(z) = 1`. No
//! sines and cosines are needed.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};
use interp::once::Lazy;

use crate::galerkin::sine::sine_and_versine;

/// The number of arguments handled at once. The recurrences of a group are independent and fill the
/// processor's vector registers.
pub const LANES: usize = 8;

type Group = [f64; LANES];

/// The largest `z` whose first power in `j_2n` is exact to rounding.
const SMALL: f64 = 1e-8;

/// Evaluates `J_0 .. J_{modes-1}`.
#[derive(Clone, Debug)]
pub struct EvenBessel {
    modes: usize,
    /// `(-1)^n sqrt(4n+1)`.
    scale: Vec<f64>,
}

impl EvenBessel {
    /// Prepares `modes >= 1` orders.
    pub fn new(modes: usize) -> Self {
        let scale = |n| {
            let root = ((4 * n + 1) as f64).sqrt();
            if n % 2 == 0 { root } else { -root }
        };
        Self {
            modes,
            scale: (0..modes).map(scale).collect(),
        }
    }

    /// Fills `column(n)[at..at + LANES]` with `J_n(z)`; `values` holds `modes` columns of `stride`
    /// values each.
    ///
    /// `z` must be positive and ascending, and span at most 64; groups from two neighbouring panels
    /// hardly do. The absolute error is a few rounding units of `max_n |J_n(z)|`.
    pub fn fill(&self, z: &Group, values: &mut [f64], stride: usize, at: usize) {
        debug_assert!(z[0] > 0.0 && z[LANES - 1] <= z[0] + 64.0, "{z:?}");
        dispatch!(Level::new(), simd => self.fill_with(simd, z, values, stride, at));
    }

    /// [`EvenBessel::fill`] with vector instructions. Products and sums are not fused, so that all
    /// processors give the same values.
    #[inline(always)]
    fn fill_with<S: Simd>(&self, simd: S, z: &Group, values: &mut [f64], stride: usize, at: usize) {
        let splat = |value: f64| f64x8::splat(simd, value);
        let one = splat(1.0);
        let mut columns = Columns {
            values,
            stride,
            at,
            scale: &self.scale,
        };
        let arguments = f64x8::simd_from(simd, *z);
        let square = arguments * arguments;
        if z[LANES - 1] <= SMALL {
            // J_n = (-1)^n sqrt(4n+1) z^2n/(4n+1)!!, where 1/z^2 might overflow.
            let mut power = one;
            for n in 0..self.modes {
                columns.store(n, power, one);
                power *= square / ((4 * n + 3) * (4 * n + 5)) as f64;
            }
            return;
        }
        let steps = steps();
        let inverse_square = one / square;

        if z[0] >= 2.0 * self.modes as f64 {
            let (mut sines, mut cosines) = (arguments, arguments);
            for l in 0..LANES {
                let [sine, versine] = sine_and_versine(z[l]);
                (sines[l], cosines[l]) = (sine, 1.0 - versine);
            }
            let j0 = sines / arguments;
            let j2 = (inverse_square * 3.0 - 1.0) * j0 - cosines * 3.0 * inverse_square;
            columns.store(0, j0, one);
            let (mut before, mut now) = (j0, j2);
            for (n, step) in steps.iter().enumerate().take(self.modes).skip(1) {
                columns.store(n, now, one);
                let Step { alpha, gamma, .. } = *step;
                let next = (inverse_square * alpha - (1.0 + gamma)) * now - before * gamma;
                (before, now) = (now, next);
            }
            return;
        }

        let top = start(z[LANES - 1]);
        let mut sums = splat(0.0);
        // Nothing overflows from here: within the span of a group, lanes with `z > 2` grow by less
        // than 1e170, the others by less than 1e200.
        let (mut after, mut now) = (splat(0.0), splat(1e-100));
        for n in top..self.modes {
            columns.put(n, after);
        }
        columns.put(top - 1, now);
        for n in (1..top).rev() {
            let Step {
                down: [a, b, c],
                at_zero,
                ..
            } = steps[n];
            sums += now * at_zero;
            let next = (inverse_square * a - b) * now - after * c;
            columns.put(n - 1, next);
            (after, now) = (now, next);
        }
        let factor = one / (sums + now);
        for n in 0..self.modes {
            columns.store(n, columns.get(simd, n), factor);
        }
    }
}

/// Where the values of a group of arguments belong.
struct Columns<'a> {
    values: &'a mut [f64],
    stride: usize,
    at: usize,
    scale: &'a [f64],
}

impl Columns<'_> {
    /// Stores `J_n`, which is `(-1)^n sqrt(4n+1)` times `factor` times `group`.
    // A closure would be compiled without the vector instructions of its function.
    #[inline(always)]
    fn store<S: Simd>(&mut self, n: usize, group: f64x8<S>, factor: f64x8<S>) {
        self.put(n, factor * self.scale[n] * group);
    }

    /// Stores a group as it is, if its order is one of those asked for.
    #[inline(always)]
    fn put<S: Simd>(&mut self, n: usize, group: f64x8<S>) {
        if n < self.scale.len() {
            group.store_slice(&mut self.values[n * self.stride + self.at..][..LANES]);
        }
    }

    /// Returns what was stored.
    #[inline(always)]
    fn get<S: Simd>(&self, simd: S, n: usize) -> f64x8<S> {
        f64x8::from_slice(simd, &self.values[n * self.stride + self.at..][..LANES])
    }
}

/// The coefficients of the recurrences at `v = 2n`.
#[derive(Clone, Copy, Debug)]
struct Step {
    /// `(2v+1)(2v+3)`.
    alpha: f64,
    /// `(2v+3)/(2v-1)`.
    gamma: f64,
    /// `alpha/gamma`, `(1 + gamma)/gamma` and `1/gamma`, for the downward recurrence.
    down: [f64; 3],
    /// `(4n+1) |P_2n(0)|`.
    at_zero: f64,
}

/// A number of steps that no solve needs.
const STEPS: usize = 2048;

/// Returns the coefficients of all steps, computed once.
fn steps() -> &'static [Step] {
    static TABLE: Lazy<Vec<Step>> = Lazy::new(|| {
        let mut legendre = 1.0;
        let step = |n: usize| {
            let v = 2.0 * n as f64;
            if n > 0 {
                legendre *= (v - 1.0) / v;
            }
            let (alpha, gamma) = (
                (2.0 * v + 1.0) * (2.0 * v + 3.0),
                (2.0 * v + 3.0) / (2.0 * v - 1.0),
            );
            let down = [alpha / gamma, (1.0 + gamma) / gamma, 1.0 / gamma];
            Step {
                alpha,
                gamma,
                down,
                at_zero: (2.0 * v + 1.0) * legendre,
            }
        };
        (0..STEPS).map(step).collect()
    });
    &TABLE
}

/// Returns the number of orders that the downward recurrence needs for arguments up to `z`.
///
/// Beyond the turning point `v = z`, `j_v` falls like `exp(-2/3 xi^{3/2})` with
/// `xi = (v - z)/(z/2)^{1/3}`: orders with `xi > 15` are below 1e-17.
fn start(z: f64) -> usize {
    if z < 1e-3 {
        return 3;
    }
    // A root of single precision is accurate enough for a number of orders, and takes less time.
    let root = f64::from((0.5 * z as f32).cbrt());
    (0.5 * (z + 15.0 * root + 6.0)).ceil() as usize
}
