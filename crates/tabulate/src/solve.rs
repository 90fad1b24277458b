//! One contact: which method, how many modes, and how accurate the answer is.

use interp::{Material, Quantities};

use crate::Error;
use crate::compliance::Compliance;
use crate::galerkin::{Abscissae, Operator};
use crate::quadrature::Panels;

/// The four quantities at one point, with their estimated error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// `Pi0`, `Eeq`, `Gamma`, `Delta0`, dimensionless.
    pub quantities: Quantities,
    /// Estimated largest relative error of the four: truncation, quadrature and rounding together.
    pub error: f64,
    /// Legendre modes used; 0 where a closed form is exact.
    pub modes: usize,
}

/// The values of `a/t` that [`solve`] takes.
pub const A_OVER_T: [f64; 2] = [1e-6, 1e4];
/// The values of `E1/E2` that [`solve`] takes, besides 0.
pub const E1_OVER_E2: [f64; 2] = [1e-8, 1e8];
/// The values of `E0/E2` that [`solve`] takes, besides infinity.
pub const E0_OVER_E2: [f64; 2] = [1e-6, 1e12];
/// The relative tolerances that [`solve`] takes.
pub const TOLERANCE: [f64; 2] = [1e-13, 1e-2];

/// Solves the contact at `a_over_t` to the relative `tolerance`.
///
/// Film = substrate is answered in closed form, everything else by Galerkin's method (`galerkin.rs`).
///
/// # Errors
/// [`Error::Domain`] for a parameter outside the domain; [`Error::NotConverged`] where double precision does not allow the tolerance.
pub fn solve(a_over_t: f64, material: &Material, tolerance: f64) -> Result<Solution, Error> {
    check_domain(a_over_t, material)?;
    Error::check("tolerance", tolerance, TOLERANCE)?;
    let compliance = Compliance::new(material);
    if compliance.is_homogeneous() {
        return Ok(homogeneous(material));
    }
    let (mut modes, ample) = (modes(a_over_t, tolerance), modes(a_over_t, TOLERANCE[0]));
    let mut panels = Panels::new(a_over_t, compliance.smallest_scale(), tolerance);
    let mut quadrature_tolerance = tolerance;
    let not_converged = |reached: f64| Error::NotConverged { a_over_t, material: *material, tolerance, reached };
    loop {
        let abscissae = Abscissae::new(a_over_t, modes, panels.clone());
        let operator = Operator::assemble(&compliance, &abscissae, abscissae.blocks());
        let Some(solved) = operator.solve(material) else {
            // Too few modes, or too much rounding.
            if modes >= ample {
                return Err(not_converged(f64::INFINITY));
            }
            modes = ample;
            continue;
        };
        let error = solved.error();
        if error <= tolerance {
            return Ok(Solution { quantities: solved.quantities, error, modes });
        }
        // More of what the error comes from, unless that is rounding.
        if solved.truncation >= 0.5 * error && modes < MOST_MODES {
            modes += 2 + modes / 4;
        } else if solved.quadrature >= 0.5 * error && quadrature_tolerance > FINEST_QUADRATURE {
            quadrature_tolerance *= 0.01;
            panels = Panels::new(a_over_t, compliance.smallest_scale(), quadrature_tolerance);
        } else {
            return Err(not_converged(error));
        }
    }
}

/// Rounding hides what still finer panels would gain.
const FINEST_QUADRATURE: f64 = 1e-15;

/// More modes than any point of the domain needs at the tightest tolerance.
const MOST_MODES: usize = 1500;

/// Film = substrate: Hertz and the flat punch, whatever `a/t`.
pub(crate) fn homogeneous(material: &Material) -> Solution {
    let quantities = Quantities::homogeneous(material.sphere_film_modulus());
    Solution { quantities, error: 4.0 * f64::EPSILON, modes: 0 }
}

/// The modes that the worst material needs at `x = a/t`: the edge layer has width `1/x`, which Legendre modes resolve with a number
/// that grows like `sqrt(x)`. The coefficients were measured over the whole domain of materials.
pub(crate) fn modes(x: f64, tolerance: f64) -> usize {
    let digits = -tolerance.log10();
    (2.4 + 0.35 * (digits - 6.0) + (2.6 + 0.42 * (digits - 6.0)) * x.sqrt()).ceil().max(3.0) as usize
}

/// Accepts the points that the solve is made for.
fn check_domain(a_over_t: f64, material: &Material) -> Result<(), Error> {
    Error::check("a_over_t", a_over_t, A_OVER_T)?;
    if material.e1_over_e2() != 0.0 {
        Error::check("e1_over_e2", material.e1_over_e2(), E1_OVER_E2)?;
    }
    if material.e0_over_e2() != f64::INFINITY {
        Error::check("e0_over_e2", material.e0_over_e2(), E0_OVER_E2)?;
    }
    Ok(())
}
