//! The methods of solution, and which of them solves a contact at the least cost.

use interp::Quantities;

use crate::compliance::surface::SurfaceCompliance;
use crate::compliance::symbol::Symbol;
use crate::estimate::Estimate;
use crate::power_law::PowerLaw;
use crate::wiener_hopf::path::Path;
use crate::{galerkin, wiener_hopf};

/// The methods of solution, one for each regime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Hertz and the flat punch, for film = substrate and every `a/t`.
    ClosedForm,
    /// Galerkin's method in even Legendre polynomials (`galerkin.rs`), for a film that is thicker
    /// than the contact is wide, or not much thinner.
    Galerkin,
    /// The Wiener-Hopf method along the imaginary axis (`wiener_hopf.rs`), for thin films.
    Axis,
    /// The Wiener-Hopf method along a ray, for thin films of which the symbol has a low zero on the
    /// imaginary axis or next to it.
    Ray,
}

/// The `a/t` from which on the Wiener-Hopf method is as fast as Galerkin's.
const THIN: f64 = 10.0;

/// The `a/t` beyond which Galerkin's method is neither faster nor more accurate than the ray for
/// any material but the stiffest films.
const GALERKIN_REACH: f64 = 300.0;

/// The `a/t` up to which Galerkin's method solves the stiffest films on the softest bases. It takes
/// some 50 ms there.
const GALERKIN_REACH_OF_PLATES: f64 = 1000.0;

/// The compliance `S(0)` of long waves, over `S(t/a)`, of a film so stiff that the Wiener-Hopf
/// method loses digits to the motion of the contact as a whole.
const PLATE: f64 = 1e5;

impl Method {
    /// Returns the name, as `tabulate solve --json` prints it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Galerkin => "Galerkin",
            Self::Axis => "Wiener-Hopf, axis",
            Self::Ray => "Wiener-Hopf, ray",
        }
    }

    /// Returns the methods that may reach `tolerance` at `x = a/t`, the cheapest one first.
    pub(crate) fn candidates(
        x: f64,
        symbol: &Symbol,
        tolerance: f64,
    ) -> impl Iterator<Item = Self> {
        let mut costs = [Self::ClosedForm, Self::Axis, Self::Galerkin, Self::Ray]
            .map(|method| (method, method.cost(x, symbol, tolerance)));
        costs.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        let methods = costs.into_iter().filter(|(_, cost)| cost.is_finite());
        let methods = methods.map(|(method, _)| method);
        // Whether the axis can be used may take longer to find out than its cost.
        methods.filter(move |&method| {
            method != Self::Axis || wiener_hopf::axis_reaches(x, symbol, tolerance)
        })
    }

    /// Estimates the time of this method roughly, in microseconds; infinite where it does not serve
    /// `x = a/t`.
    fn cost(self, x: f64, symbol: &Symbol, tolerance: f64) -> f64 {
        let galerkin_reaches = || {
            x <= GALERKIN_REACH
                || x <= GALERKIN_REACH_OF_PLATES && symbol.at(0.0) > PLATE * symbol.at(1.0 / x)
        };
        match self {
            Self::ClosedForm if has_closed_form(symbol, tolerance) => 0.0,
            Self::Galerkin if galerkin_reaches() => galerkin::cost(x, tolerance),
            Self::Axis if x >= THIN => wiener_hopf::axis_cost(x, symbol, tolerance),
            Self::Ray if x >= THIN => wiener_hopf::ray_cost(x, symbol, tolerance),
            _ => f64::INFINITY,
        }
    }

    /// Solves the contact at `x = a/t`, and those of the power laws with the `exponents`, to
    /// `tolerance`, or as accurately as this method can.
    pub(crate) fn solve(
        self,
        x: f64,
        symbol: &Symbol,
        exponents: &[f64],
        tolerance: f64,
    ) -> Estimate {
        match self {
            Self::ClosedForm => closed_form(symbol, exponents),
            Self::Galerkin => galerkin::solve(x, symbol, exponents, tolerance),
            Self::Axis => wiener_hopf::solve(x, symbol, exponents, Path::Axis, tolerance),
            Self::Ray => wiener_hopf::solve(x, symbol, exponents, Path::Ray, tolerance),
        }
    }
}

/// The share of the tolerance that the closed form may use up where it is a limit.
const CLOSED_FORM: f64 = 0.01;

/// Returns whether the closed form is accurate enough.
pub(crate) fn has_closed_form<C: SurfaceCompliance>(symbol: &Symbol<C>, tolerance: f64) -> bool {
    symbol.contrast() == 0.0 || closed_form_error(symbol) <= CLOSED_FORM * tolerance
}

/// Returns the relative error of the closed form: rounding, and the departure of the symbol from 1.
fn closed_form_error<C: SurfaceCompliance>(symbol: &Symbol<C>) -> f64 {
    4.0 * f64::EPSILON + 10.0 * symbol.contrast()
}

/// Returns the quantities of Hertz's contact and the flat punch, and Sneddon's power laws: for film
/// = substrate, and the limit under a sphere that is much softer than both.
pub(crate) fn closed_form<C: SurfaceCompliance>(symbol: &Symbol<C>, exponents: &[f64]) -> Estimate {
    let power_law = |&exponent: &f64| PowerLaw::homogeneous(exponent, symbol.modulus());
    Estimate {
        quantities: Quantities::homogeneous(symbol.modulus()),
        power_laws: exponents.iter().map(power_law).collect(),
        error: closed_form_error(symbol),
        modes: 0,
    }
}

#[cfg(test)]
mod tests {
    use interp::Material;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::estimate::larger;

    /// Solves `count` random contacts with the ray and with `other` between `a/t = 10` and 300, over `E1*/E2*`
    /// from 1e-12 to 1e14, and 0, and `E0*/E1*` from 1e-14 to 1e14, and infinity.
    ///
    /// Returns the number of those whose stated errors are below 1e-6 together, and their largest difference over
    /// the stated errors.
    fn compare(other: Method, exponents: &[f64], count: usize) -> (usize, f64) {
        const TOLERANCE: f64 = 1e-9;
        let mut random = Pcg64Mcg::seed_from_u64(4);
        let (mut compared, mut worst): (usize, f64) = (0, 0.0);
        for _ in 0..count {
            let mut log_uniform =
                |from: f64, to: f64| random.random_range(from.ln()..to.ln()).exp();
            let x = log_uniform(10.0, 300.0);
            let (mut e1, r) = (log_uniform(1e-12, 1e14), log_uniform(1e-14, 1e14));
            let mut e0 = e1 * r;
            match random.random_range(0..6) {
                0 => (e1, e0) = (0.0, r),
                1 => e0 = f64::INFINITY,
                _ => {}
            }
            let mut nu = || [0.5, random.random_range(0.0..0.5)][random.random_range(0..2)];
            let material = Material::new(e1, nu(), e0, nu()).expect("physical");
            let symbol = Symbol::new(&material);
            let [other, ray] =
                [other, Method::Ray].map(|method| method.solve(x, &symbol, exponents, TOLERANCE));
            if other.error + ray.error < 1e-6 {
                compared += 1;
                let share = other.difference(&ray) / (other.error + ray.error);
                worst = larger(worst, share);
            }
        }
        (compared, worst)
    }

    /// The paraboloid over all contrasts; a cone, even and odd powers, and two exponents that are no integers.
    #[test]
    fn methods_agree_within_their_stated_errors() {
        let powers = [[1.0], [3.0], [4.0], [6.0], [0.5], [2.7]];
        let powers = powers.iter().map(|exponents| (&exponents[..], 50, 40));
        for (exponents, count, least) in powers.chain([(&[][..], 300, 270)]) {
            for other in [Method::Galerkin, Method::Axis] {
                let (compared, worst) = compare(other, exponents, count);
                assert!(
                    compared >= least && worst <= 1.0,
                    "{other:?}, {exponents:?}: {compared} of {count}, {worst}"
                );
            }
        }
    }

    /// Stiff plates on soft bases and soft incompressible films on much stiffer bases, whose contours at
    /// the tolerance and one level before happen to agree better than they are accurate. By their
    /// difference alone the true errors are 1.2 to 2.2 times the stated ones.
    #[test]
    fn contours_that_agree_by_chance_state_honest_errors() {
        let contacts = [
            (168.418, [0.0, 0.5, 2.50383e-6, 0.5], 4.5e-9),
            (525.910, [5.60517e-3, 0.5, 4.85334e-10, 0.5], 5.7e-7),
            (921.139, [2.33161e-4, 0.5, 3.68102e-12, 0.5], 9.0e-10),
            (10.4009, [7.944e-6, 0.5, 302.9, 0.361], 5e-7),
            (19.5552, [1.365e-5, 0.5, 5.606, 0.321], 5e-7),
        ];
        for (x, [e1, nu1, e0, nu0], tolerance) in contacts {
            let symbol = Symbol::new(&Material::new(e1, nu1, e0, nu0).expect("physical"));
            let solved = Method::Ray.solve(x, &symbol, &[], tolerance);
            let exact = Method::Axis.solve(x, &symbol, &[], 1e-11);
            let share = solved.difference(&exact) / (solved.error + exact.error);
            println!(
                "a/t = {x}: {share:.2} of the stated error {:.1e}",
                solved.error
            );
            assert!(
                solved.error <= tolerance && exact.error <= 0.02 * solved.error && share <= 1.0,
                "a/t = {x}: {share}, {:.1e}",
                exact.error
            );
        }
    }
}
