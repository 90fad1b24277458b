//! Even-order spherical Bessel functions, scaled as Legendre transforms.
//!
//! `J_n(z) = int_0^1 phi_n(rho) cos(z rho) d rho = (-1)^n sqrt(4n+1) j_2n(z)` for the even Legendre basis
//! `phi_n = sqrt(4n+1) P_2n`, orthonormal on `[0, 1]`. Eliminating the odd orders from the three-term recurrence gives
//!
//! ```text
//! j_{v+2} = [(2v+1)(2v+3)/z^2 - 1 - (2v+3)/(2v-1)] j_v - (2v+3)/(2v-1) j_{v-2},      v = 2n
//! ```
//!
//! which is run upwards where all orders are below `z` and downwards (Miller) elsewhere, then scaled to the closed forms of `j_0` and
//! `j_2`.

/// The largest argument of a group is at most this many times the smallest, or all of the group are above all orders.
pub const SPREAD: f64 = 4.0;

/// Arguments handled at once; the recurrences of a group are independent and fill the processor's vectors.
pub const LANES: usize = 8;

type Group = [f64; LANES];

/// Evaluates `J_0 .. J_{modes-1}`.
#[derive(Clone, Debug)]
pub struct EvenBessel {
    modes: usize,
    /// `(2v+1)(2v+3)` and `(2v+3)/(2v-1)` for `v = 2n`.
    steps: Vec<(f64, f64)>,
    /// `(-1)^n sqrt(4n+1)`.
    scale: Vec<f64>,
}

impl EvenBessel {
    /// For `modes >= 1` orders.
    pub fn new(modes: usize) -> Self {
        // Arguments of a group that is not all above the orders reach this far at most, see `start`.
        let highest = start(2.0 * SPREAD * modes as f64, modes);
        let step = |n| {
            let v = 4.0 * n as f64;
            ((v + 1.0) * (v + 3.0), (v + 3.0) / (v - 1.0))
        };
        let scale = |n| {
            let root = ((4 * n + 1) as f64).sqrt();
            if n % 2 == 0 { root } else { -root }
        };
        Self { modes, steps: (0..highest).map(step).collect(), scale: (0..modes).map(scale).collect() }
    }

    /// Fills `column(n)[at..at + LANES]` with `J_n(z)`; `values` holds `modes` columns of `stride` values each.
    ///
    /// `z` must be positive and ascending. The error is a few rounding units of `max_n |J_n|`, times `1 + z`
    /// for the phase of a large argument.
    pub fn fill(&self, z: &Group, values: &mut [f64], stride: usize, at: usize) {
        let sines: Group = z.map(f64::sin);
        let cosines: Group = z.map(f64::cos);
        let inverse_square: Group = z.map(|z| 1.0 / (z * z));
        let j0: Group = std::array::from_fn(|l| sines[l] / z[l]);
        // Loses all digits for small arguments, where it is not used.
        let j2: Group = std::array::from_fn(|l| (3.0 * inverse_square[l] - 1.0) * j0[l] - 3.0 * cosines[l] * inverse_square[l]);
        let mut store = |n: usize, group: &Group, factor: &Group| {
            let scale = self.scale[n];
            let column = &mut values[n * stride + at..][..LANES];
            for l in 0..LANES {
                column[l] = scale * factor[l] * group[l];
            }
        };

        if z[0] >= 2.0 * self.modes as f64 {
            const ONE: Group = [1.0; LANES];
            store(0, &j0, &ONE);
            let (mut before, mut now) = (j0, j2);
            for n in 1..self.modes {
                store(n, &now, &ONE);
                let (alpha, gamma) = self.steps[n];
                let next = std::array::from_fn(|l| (alpha * inverse_square[l] - (1.0 + gamma)) * now[l] - gamma * before[l]);
                (before, now) = (now, next);
            }
            return;
        }

        let top = start(z[LANES - 1], self.modes);
        let mut orders = vec![[0.0; LANES]; self.modes.max(top) + 1];
        orders[top - 1] = [1e-250; LANES];
        for n in (1..top).rev() {
            let (alpha, gamma) = self.steps[n];
            let inverse = 1.0 / gamma;
            let (now, after) = (orders[n], orders[n + 1]);
            orders[n - 1] = std::array::from_fn(|l| ((alpha * inverse_square[l] - (1.0 + gamma)) * now[l] - after[l]) * inverse);
        }
        let factor: Group = std::array::from_fn(|l| {
            let (u, v) = (orders[0][l], orders[1][l]);
            if z[l] < 2.0 {
                return j0[l] / u;
            }
            // Projected on (j_0, j_2), which never vanish together.
            let largest = u.abs().max(v.abs());
            let (u, v) = (u / largest, v / largest);
            (j0[l] * u + j2[l] * v) / (u * u + v * v) / largest
        });
        for n in 0..self.modes {
            store(n, &orders[n], &factor);
        }
    }
}

/// The number of orders that the downward recurrence needs for arguments up to `z`.
///
/// Beyond the turning point `v = z`, `j_v` falls like `exp(-2/3 xi^{3/2})` with `xi = (v - z)/(z/2)^{1/3}`. Orders with `xi > 15`
/// are below 1e-17 and taken as zero; a start at `xi = 9`, a little above the last wanted order, leaves no trace in the wanted ones.
fn start(z: f64, modes: usize) -> usize {
    if z < 1e-3 {
        return 3;
    }
    let airy = (0.5 * z).cbrt();
    let negligible = 0.5 * (z + 15.0 * airy + 12.0);
    let converged = 0.5 * (z + 9.0 * airy + 6.0);
    let above_modes = modes as f64 + 4.0 + 2.0 * (modes as f64).cbrt();
    converged.max(negligible.min(above_modes)).ceil() as usize
}
