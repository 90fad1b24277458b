//! Galerkin's method in even Legendre polynomials, with the results in energy form.
//!
//! With `x = a/t` and `g` in units of half the normalising modulus, the contact is
//!
//! ```text
//! g(rho)/es + (x/e1) int_0^1 [k(x(rho-s)) + k(x(rho+s))] g(s) ds = f(rho),    k(y) = 1/pi int_0^inf (X(q)-1) cos(qy) dq
//! f = 1 -> g1:  Eeq = int g1,  Gamma = g1(1)        f = rho^2 -> g2:  Delta0 = g2(1)/Gamma,  Pi0 = 4 int (Delta0 g1 - g2)
//! ```
//!
//! (Barthel, eq. 3, with the sphere's compliance as the diagonal term). In the orthonormal basis
//! `phi_n = sqrt(4n+1) P_2n`, whose cosine transforms are `EvenBessel`, the kernel becomes
//! `A = I/es + M/e1` with `M_mn = (2/pi) int_0^inf (X-1) J_m J_n dz`, `z = q x`, and the right-hand
//! sides have one and two entries.
//!
//! The edge values come from the exact identity `Gamma^2 = es d(x Eeq)/dx` and from its bilinear
//! form, not from sums at the edge. If `C_mn = (2/pi) int q X' J_m J_n dz`, they are
//!
//! ```text
//! Gamma^2     = es (Eeq     + g1.C.g1 / e1)
//! Gamma g2(1) = es (3 g2[0] + g1.C.g2 / e1)
//! ```
//!
//! Both are stationary in the error of `g`, as `Eeq` is, and so converge twice as fast as `g`
//! itself.
//!
//! `M` and `C` do not depend on the sphere: one pair serves every `E1/E2*` at fixed `a/t`, `nu1`,
//! `nu0` and `E0/E1`, or on one stack of layers (`operator.rs`). The Bessel values do not depend
//! on the material (`abscissae.rs`).

use crate::compliance::surface::SurfaceCompliance;
use crate::compliance::symbol::Symbol;
use crate::estimate::Estimate;
use crate::galerkin::abscissae::Abscissae;
use crate::galerkin::operator::Operator;
use crate::galerkin::quadrature::{PanelWeights, Panels};

/// Solves one contact at `x = a/t`, and those of the power laws with the `exponents`. Adds modes
/// and panels until the estimated error is at most `tolerance`, or until only rounding is left of
/// it.
pub fn solve<C: SurfaceCompliance>(
    x: f64,
    symbol: &Symbol<C>,
    exponents: &[f64],
    tolerance: f64,
) -> Estimate {
    /// The truncation error over the tolerance for which modes are added.
    const AIM: f64 = 0.1;
    /// The compliance `S(t/a)` below which a contact needs more modes than most, as of a soft film
    /// between stiff bodies.
    const SOFT: f64 = 0.1;
    let compliance = symbol.compliance();
    let is_soft = symbol.value(1.0 / x) < SOFT;
    // The truncation error is mostly smaller where the share of the film is small. The tolerance is
    // divided by the root of the share only: divided by the whole share it would often give too few
    // modes, and a second attempt.
    let first = if is_soft { AIM } else { 1.0 } * tolerance / symbol.film().sqrt();
    let (mut count, ample) = (modes(x, first), modes(x, FINEST));
    if !exponents.is_empty() {
        // From three modes, two of them beside the first, the fall of those left out is not known,
        // which is slow for a cone.
        count = count.max(4);
    }
    let mut panels = Panels::new(x, [compliance], PanelWeights::BesselProducts, tolerance);
    let (mut truncation_tolerance, mut quadrature_tolerance) = (first, tolerance);
    loop {
        let abscissae = Abscissae::new(x, count, panels.clone());
        let bessel = abscissae.bessel_values();
        let operator = Operator::for_one_sphere(compliance, &abscissae, &bessel);
        let Some(solved) = operator.solve(symbol, exponents) else {
            // Too few modes, or too much rounding.
            if count >= ample {
                return Estimate::FAILED;
            }
            count = ample;
            continue;
        };
        let error = solved.error();
        // Refines the larger source of the error, or one without which it would be small enough,
        // unless that is rounding.
        let large = (0.5 * error).min(error - tolerance);
        if error > tolerance && solved.truncation >= large && count < MOST_MODES {
            truncation_tolerance *= AIM * tolerance / solved.truncation;
            // A profile with a kink converges slowly.
            let least = if exponents.is_empty() {
                2
            } else {
                2 + count / 4
            };
            count = modes(x, truncation_tolerance).clamp(count + least, 2 * count + least);
        } else if error > tolerance && solved.quadrature >= large && quadrature_tolerance > FINEST {
            quadrature_tolerance *= 0.01;
            panels = Panels::new(
                x,
                [compliance],
                PanelWeights::BesselProducts,
                quadrature_tolerance,
            );
        } else {
            return Estimate {
                quantities: solved.quantities,
                power_laws: solved.power_laws,
                error,
                modes: count,
            };
        }
    }
}

/// Returns abscissae for the operators of all `compliances` at `x = a/t`, which serve nearly every
/// sphere to `tolerance`. A few modes more than most spheres need cost less than one contact solved alone.
pub fn shared_abscissae<'a, C: SurfaceCompliance + 'a>(
    x: f64,
    compliances: impl IntoIterator<Item = &'a C>,
    tolerance: f64,
) -> Abscissae {
    let panels = Panels::new(x, compliances, PanelWeights::BesselProducts, tolerance);
    Abscissae::new(x, modes(x, 0.1 * tolerance), panels)
}

/// Estimates the time for one contact roughly, in microseconds, to choose between methods: a fit to
/// measured times.
pub fn cost(x: f64, tolerance: f64) -> f64 {
    let digits = -tolerance.ln() * x;
    5.0 + 0.035 * digits + 2.5e-5 * digits * digits
}

/// The smallest tolerance of truncation and quadrature that is of use: below it, rounding is the
/// larger error.
const FINEST: f64 = 1e-15;

/// A number of modes that no contact within reach needs, even at the tightest tolerance.
const MOST_MODES: usize = 1500;

/// Returns the number of modes that the worst material needs at `x = a/t`.
///
/// The edge layer has width `1/x`, which Legendre modes resolve with a number that grows like
/// `sqrt(x)`. The coefficients were measured over the whole domain of materials.
pub fn modes(x: f64, tolerance: f64) -> usize {
    let digits = -tolerance.log10();
    (2.4 + 0.35 * (digits - 6.0) + (2.6 + 0.42 * (digits - 6.0)) * x.sqrt())
        .ceil()
        .max(3.0) as usize
}
