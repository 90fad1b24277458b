//! The numbers of one contact that a table may hold.

use interp::{Quantities, Quantity};

use crate::power_law::PowerLaw;

/// The exponent of a cone.
const CONE: [f64; 1] = [1.0];

/// The quantities of a sphere and, where they were asked for, the numbers of a cone.
#[derive(Clone, Copy, Debug)]
pub struct Tabulated {
    /// The four quantities.
    pub quantities: Quantities,
    /// The cone, where it is wanted.
    pub cone: Option<PowerLaw>,
}

impl Tabulated {
    /// Returns the exponents to solve for these `quantities` beside those of a sphere.
    pub fn exponents(quantities: &[Quantity]) -> &'static [f64] {
        if quantities.contains(&Quantity::Delta1) {
            &CONE
        } else {
            &[]
        }
    }

    /// Takes a result for [`Self::exponents`].
    pub fn new(quantities: Quantities, power_laws: &[PowerLaw]) -> Self {
        Self {
            quantities,
            cone: power_laws.first().copied(),
        }
    }

    /// Returns the value of a quantity; NaN for [`Quantity::Delta1`] if no cone was solved.
    pub fn get(&self, quantity: Quantity) -> f64 {
        match (quantity, self.cone) {
            (Quantity::Delta1, Some(cone)) => cone.delta,
            _ => self.quantities.get(quantity),
        }
    }
}
