//! What every method returns.

use interp::Quantities;

/// The four quantities with their estimated error, whether that is small enough or not.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// `Pi0`, `Eeq`, `Gamma`, `Delta0`.
    pub quantities: Quantities,
    /// Estimated largest relative error of the four; infinite where a method has failed.
    pub error: f64,
    /// Legendre modes, or real unknowns along a contour.
    pub modes: usize,
}

impl Answer {
    /// No answer at all.
    pub const FAILED: Self = Self {
        quantities: Quantities { pi0: f64::NAN, eeq: f64::NAN, gamma: f64::NAN, delta0: f64::NAN },
        error: f64::INFINITY,
        modes: 0,
    };
}
