//! Moments of the edge functions: what a profile `rho^n` needs of `a(z)` and `b(z)/z`.
//!
//! The inverse of the contact's operator has the double transform of
//! `wiener_hopf.rs`. At `z = 0` it says that the right-hand side
//! `cos(k rho)` has the edge value `es a(k)` and the integral `es a0 b(k)/k`. The moment `M_n` of an
//! even function of `k` is the linear functional that turns `cos(k rho)` into `rho^n`:
//!
//! ```text
//! n = 2j:   M_n f = (-1)^j (2j)! f_j,       f(k) = f_0 + f_1 k^2 + ...
//! others:   M_n f = -(2/pi) sin(pi n/2) Gammafunction(n+1) * finite part of int_0^inf f(k) k^{-n-1} dk
//!
//! g_n(1) = es M_n[a]        mu_n = es a0 M_n[b/z]
//! ```
//!
//! so that `Delta_n = M_n[a]/a0` and `Pi_n = 4 es (M_n[a] b1 - a0 M_n[b/z])`, with `b1 = M_0[b/z]`.
//! Up to the [`CORNER`] the polynomial `sum p_i k^{2i}` through the readouts gives the finite part
//! `sum p_i c^{2i-n}/(2i-n)`; beyond, a sum over the nodes of the
//! [turned line](crate::wiener_hopf::turned_line) does.

use std::f64::consts::{FRAC_2_PI, PI};

use num_complex::Complex64;

use crate::wiener_hopf::contour::{Contour, READOUTS, Readouts};
use crate::wiener_hopf::turned_line::CORNER;

/// The functional `M_n` as sums of values.
pub struct Moment {
    /// The weights of the values at the readouts.
    pub readouts: [f64; READOUTS],
    /// The weights of the values on the turned line, for `a`, and for `b/z`; none if `n` is even.
    pub line: Option<[Vec<Complex64>; 2]>,
}

impl Moment {
    /// Returns `M_n` on `contour`.
    pub fn new(exponent: f64, contour: &Contour) -> Self {
        let half = 0.5 * exponent;
        if half == half.trunc() && half < READOUTS as f64 {
            return Self::even(half as usize, &contour.readouts);
        }
        let factor = -FRAC_2_PI * (0.5 * PI * exponent).sin() * libm::tgamma(exponent + 1.0);
        let mut readouts = [0.0; READOUTS];
        for (i, row) in contour.readouts.coefficients.iter().enumerate() {
            let power = 2.0 * i as f64 - exponent;
            let weight = factor * CORNER.powf(power) / power;
            readouts
                .iter_mut()
                .zip(row)
                .for_each(|(sum, coefficient)| *sum += weight * coefficient);
        }
        let nodes = &contour.turned_line().nodes;
        let line = [1.0, 2.0].map(|power| {
            let weight = |z: &Complex64| factor * z.powf(-exponent - power);
            nodes.iter().map(weight).collect()
        });
        Self {
            readouts,
            line: Some(line),
        }
    }

    /// Returns `M_2j`.
    pub fn even(j: usize, readouts: &Readouts) -> Self {
        let sign = if j.is_multiple_of(2) { 1.0 } else { -1.0 };
        let factor = (1..=2 * j).fold(sign, |product, k| product * k as f64);
        Self {
            readouts: readouts.coefficients[j].map(|weight| factor * weight),
            line: None,
        }
    }
}
