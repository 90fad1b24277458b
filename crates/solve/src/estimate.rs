//! The result of every method of solution, and the distance between two results.

use interp::Quantities;

use crate::power_law::PowerLaw;

/// The quantities of one contact with their estimated error, whether that is small enough or not.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// `Pi0`, `Eeq`, `Gamma`, `Delta0`.
    pub quantities: Quantities,
    /// The contacts of the power laws asked for, in their order.
    pub power_laws: Vec<PowerLaw>,
    /// Estimated largest relative error of all of them; infinite where a method has failed.
    pub error: f64,
    /// Legendre modes, or real unknowns along a contour.
    pub modes: usize,
}

impl Estimate {
    /// The result of a method that has failed: NaN, with an infinite error.
    pub const FAILED: Self = Self {
        quantities: Quantities {
            pi0: f64::NAN,
            eeq: f64::NAN,
            gamma: f64::NAN,
            delta0: f64::NAN,
        },
        power_laws: Vec::new(),
        error: f64::INFINITY,
        modes: 0,
    };

    /// Returns all numbers of the contact: those of the quantities, then those of the power laws.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let power_laws = self.power_laws.iter();
        self.quantities
            .to_array()
            .into_iter()
            .chain(power_laws.flat_map(|power_law| [power_law.pi, power_law.delta]))
    }

    /// Replaces each number by the result of `change` for it.
    pub fn change(&mut self, mut change: impl FnMut(f64) -> f64) {
        self.quantities = Quantities::from_array(self.quantities.to_array().map(&mut change));
        for power_law in &mut self.power_laws {
            power_law.pi = change(power_law.pi);
            power_law.delta = change(power_law.delta);
        }
    }

    /// Returns the largest relative difference from `other`; infinite if one is not a number.
    pub fn difference(&self, other: &Self) -> f64 {
        largest_difference(self.numbers().zip(other.numbers()))
    }
}

/// Returns the largest of the four relative differences; infinite if one is not a number.
pub fn difference(a: &Quantities, b: &Quantities) -> f64 {
    largest_difference(a.to_array().into_iter().zip(b.to_array()))
}

fn largest_difference(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let largest = pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, larger);
    if largest.is_nan() {
        f64::INFINITY
    } else {
        largest
    }
}

/// Returns the larger of two numbers, NaN if either is NaN.
///
/// `f64::max` drops NaN; an error that is NaN must not pass for a small one.
pub const fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}
