//! One contact: which method, and how accurate the answer is.

use interp::{Material, Quantities};

use crate::Error;
use crate::solve::contour::{LARGEST_A_OVER_T, Path};
use crate::solve::estimate::Estimate;
use crate::solve::symbol::Symbol;
use crate::solve::{galerkin, wiener_hopf};

/// The four quantities at one point, with their estimated error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// `Pi0`, `Eeq`, `Gamma`, `Delta0`, dimensionless.
    pub quantities: Quantities,
    /// Estimated largest relative error of the four: truncation, quadrature and rounding together.
    pub error: f64,
    /// The size of the system solved: Legendre modes, or real unknowns along a contour; 0 for the
    /// closed form.
    pub modes: usize,
    /// How they were found.
    pub method: Method,
}

/// The methods of solution, one for each regime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Film = substrate: Hertz and the flat punch, whatever `a/t`.
    ClosedForm,
    /// Galerkin's method in even Legendre polynomials (`galerkin.rs`): film thicker than the
    /// contact is wide, or not much thinner.
    Galerkin,
    /// The Wiener-Hopf method along the imaginary axis (`wiener_hopf.rs`): thin films, and no zero
    /// of the symbol in the way.
    Axis,
    /// The Wiener-Hopf method along a ray: thin films of all other materials.
    Ray,
}

impl Method {
    /// The name, as `tabulate solve --json` prints it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Galerkin => "Galerkin",
            Self::Axis => "Wiener-Hopf, axis",
            Self::Ray => "Wiener-Hopf, ray",
        }
    }

    /// Solves a contact with this method, as far as it goes.
    fn solve(
        self,
        a_over_t: f64,
        material: &Material,
        symbol: &Symbol,
        tolerance: f64,
    ) -> Estimate {
        match self {
            Self::ClosedForm => homogeneous(material),
            Self::Galerkin => galerkin::solve(a_over_t, material, tolerance),
            Self::Axis => wiener_hopf::solve(a_over_t, symbol, Path::Axis, tolerance),
            Self::Ray => wiener_hopf::solve(a_over_t, symbol, Path::Ray, tolerance),
        }
    }
}

/// The values of `a/t` that [`solve`] takes.
pub const A_OVER_T: [f64; 2] = [1e-6, LARGEST_A_OVER_T];
/// The values of `E1/E2` that [`solve`] takes, besides 0.
pub const E1_OVER_E2: [f64; 2] = [1e-8, 1e8];
/// The values of `E0/E2` that [`solve`] takes, besides infinity.
pub const E0_OVER_E2: [f64; 2] = [1e-6, 1e12];
/// The relative tolerances that [`solve`] takes.
pub const TOLERANCE: [f64; 2] = [1e-13, 1e-2];

/// Solves the contact at `a_over_t` to the relative `tolerance`.
///
/// # Errors
/// [`Error::Domain`] for a parameter outside the domain; [`Error::NotConverged`] where double
/// precision does not allow the tolerance.
pub fn solve(a_over_t: f64, material: &Material, tolerance: f64) -> Result<Solution, Error> {
    check_domain(a_over_t, material)?;
    Error::check("tolerance", tolerance, TOLERANCE)?;
    let symbol = Symbol::new(material);
    let mut reached = f64::INFINITY;
    for method in methods(a_over_t, &symbol, tolerance) {
        let Estimate {
            quantities,
            error,
            modes,
        } = method.solve(a_over_t, material, &symbol, tolerance);
        if error <= tolerance {
            return Ok(Solution {
                quantities,
                error,
                modes,
                method,
            });
        }
        reached = reached.min(error);
    }
    Err(Error::NotConverged {
        a_over_t,
        material: *material,
        tolerance,
        reached,
    })
}

/// The methods that may answer, the cheapest one first.
fn methods(x: f64, symbol: &Symbol, tolerance: f64) -> impl Iterator<Item = Method> {
    let galerkin_first = galerkin::cost(x, tolerance) < wiener_hopf::ray_cost(x, symbol, tolerance);
    let candidates = [
        (Method::ClosedForm, symbol.is_constant()),
        (Method::Axis, prefers_axis(x, symbol, tolerance)),
        (Method::Galerkin, x <= GALERKIN_REACH && galerkin_first),
        (Method::Ray, x >= THIN),
        (Method::Galerkin, x <= GALERKIN_REACH && !galerkin_first),
    ];
    candidates
        .into_iter()
        .filter_map(|(method, applies)| applies.then_some(method))
}

/// Whether the Wiener-Hopf method along the imaginary axis is the fastest.
pub(crate) fn prefers_axis(x: f64, symbol: &Symbol, tolerance: f64) -> bool {
    /// Of the tolerance, so that most of it is left for everything else.
    const SHARE: f64 = 0.05;
    x >= THIN && wiener_hopf::left_out(x, symbol) <= SHARE * tolerance
}

/// From this `a/t` on, the Wiener-Hopf method is as fast as Galerkin's.
const THIN: f64 = 10.0;

/// Beyond this `a/t`, Galerkin's method is neither faster nor more accurate than the ray for any
/// material.
const GALERKIN_REACH: f64 = 300.0;

/// Film = substrate: Hertz and the flat punch, whatever `a/t`.
pub(crate) fn homogeneous(material: &Material) -> Estimate {
    Estimate {
        quantities: Quantities::homogeneous(material.sphere_film_modulus()),
        error: 4.0 * f64::EPSILON,
        modes: 0,
    }
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
