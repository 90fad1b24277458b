//! What the contact of any shape needs of a material: `Gamma` and `Eeq` at all `x = a/t` from 0.

use interp::{Curve, Error, Quantity};

/// The largest third-order part of the thick film at the first point of the solution, over the
/// tolerance.
const THIRD_ORDER: f64 = 0.01;
/// The largest first-order part there. The polynomials follow it.
const FIRST_ORDER: f64 = 1.0;
/// The largest first point, over the first node.
const LARGEST_FIRST: f64 = 4.0;
/// The tolerance of a curve that does not state its own.
const FINE: f64 = 1e-9;

/// The material of a contact, or one that differs from it a little.
#[derive(Clone, Debug)]
pub(super) struct Medium {
    curve: Curve,
    es: f64,
    /// The relative tolerance of the results.
    pub tolerance: f64,
    /// A parameter by number, as in `QuantityGradient::relative`, and its change.
    change: Option<(usize, f64)>,
    /// The first node, and the numbers `alpha` and `u` of the thick film there, see the page
    /// `curve/thick_film.rs` of the source.
    first: f64,
    alpha: f64,
    u: f64,
}

/// `Gamma/es`, its logarithmic derivative `dln(Gamma)/dx`, and `Eeq/es`.
#[derive(Clone, Copy, Debug)]
pub(super) struct At {
    pub gamma: f64,
    pub growth: f64,
    pub eeq: f64,
}

impl Medium {
    /// Takes the curve of a material, with a change of one parameter if one is given.
    pub(super) fn new(curve: &Curve, change: Option<(usize, f64)>) -> Result<Self, Error> {
        let first = curve.range()[0];
        let mut medium = Self {
            curve: curve.clone(),
            es: curve.material().sphere_film_modulus(),
            tolerance: curve.tolerance().unwrap_or(FINE),
            change,
            first,
            alpha: 0.0,
            u: 0.0,
        };
        let at = curve.quantities(first)?;
        let by = medium.by_parameter(first)?;
        let pi0 = at.pi0 / medium.es * (1.0 + by[0]);
        medium.u = 0.375 * pi0 - 1.0;
        medium.alpha = medium.es / (at.eeq * (1.0 + by[1])) - 1.0 - medium.u;
        Ok(medium)
    }

    /// Returns the relative changes of `Pi0`, `Eeq` and `Gamma` over `es`, and the derivative of the
    /// last one.
    fn by_parameter(&self, x: f64) -> Result<[f64; 4], Error> {
        let Some((parameter, step)) = self.change else {
            return Ok([0.0; 4]);
        };
        let by = self.curve.over_es_by(parameter, x)?;
        Ok(by.map(|by| step * by))
    }

    /// Returns the largest `x` of the nodes.
    pub(super) fn last(&self) -> f64 {
        self.curve.range()[1]
    }

    /// Returns the `x` below which the film is thick to rounding.
    pub(super) fn thick(&self) -> f64 {
        let third = (THIRD_ORDER * self.tolerance / self.u.abs()).cbrt();
        self.first
            * (FIRST_ORDER / self.alpha.abs())
                .min(third)
                .min(LARGEST_FIRST)
    }

    /// Returns `es/Eeq - 1` of a thick film at `x`.
    pub(super) fn departure(&self, x: f64) -> f64 {
        let ratio = x / self.first;
        ratio * self.alpha + ratio.powi(3) * self.u
    }

    /// Returns `Gamma/es` and its logarithmic derivative at `x`.
    #[inline]
    pub(super) fn gamma_and_growth(&self, x: f64) -> Result<[f64; 2], Error> {
        if x < self.first || self.change.is_some() {
            let At { gamma, growth, .. } = self.at(x)?;
            return Ok([gamma, growth]);
        }
        let [gamma, rate] = self.curve.gamma_and_rate(x);
        Ok([gamma / self.es, rate / gamma])
    }

    /// Evaluates at `x`.
    pub(super) fn at(&self, x: f64) -> Result<At, Error> {
        if x < self.first {
            let ratio = x / self.first;
            let (alpha, u) = (ratio * self.alpha, ratio.powi(3) * self.u);
            // `es/Gamma = (1 + alpha + u) (1 + u)`.
            let stiffness = 1.0 + alpha + u;
            let growth = if x > 0.0 {
                ((alpha + 3.0 * u) / stiffness + 3.0 * u / (1.0 + u)) / x
            } else {
                self.alpha / self.first
            };
            return Ok(At {
                gamma: 1.0 / (stiffness * (1.0 + u)),
                growth: -growth,
                eeq: 1.0 / stiffness,
            });
        }
        let (values, slopes) = self.curve.quantities_and_slopes(x)?;
        let [_, eeq, gamma, growth] = self.by_parameter(x)?;
        Ok(At {
            gamma: values.gamma / self.es * (1.0 + gamma),
            growth: slopes.get(Quantity::Gamma) / values.gamma / x + growth / (1.0 + gamma),
            eeq: values.eeq / self.es * (1.0 + eeq),
        })
    }
}
