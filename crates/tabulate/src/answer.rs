//! What every method is asked for and returns, and how far two answers are apart.

use interp::{Quantities, Quantity};

/// What a solve is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// All four quantities. The adhesionless pair `Pi0`, `Delta0` takes as much: it is made of the other two.
    All,
    /// `Eeq` alone; the error is that of `Eeq`, and the other quantities of the answer mean nothing.
    Stiffness,
}

impl Wanted {
    /// What the given quantities take: less than all only if they are `Eeq` and nothing else.
    pub fn of(quantities: impl IntoIterator<Item = Quantity>) -> Self {
        if quantities.into_iter().eq([Quantity::Eeq]) { Self::Stiffness } else { Self::All }
    }

    /// The largest of the wanted quantities' errors, given all four.
    pub fn largest(self, errors: Quantities) -> f64 {
        match self {
            Self::All => errors.to_array().into_iter().fold(0.0, f64::max),
            Self::Stiffness => errors.eeq,
        }
    }
}

/// The four quantities with their estimated error, whether that is small enough or not.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// `Pi0`, `Eeq`, `Gamma`, `Delta0`.
    pub quantities: Quantities,
    /// Estimated largest relative error of what was wanted; infinite where a method has failed.
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

/// The largest of the four relative differences; infinite if one is not a number.
pub fn difference(a: &Quantities, b: &Quantities) -> f64 {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, |largest, d| if d.is_nan() { f64::INFINITY } else { largest.max(d) })
}
