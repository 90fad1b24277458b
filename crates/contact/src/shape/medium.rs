//! What the contact of any shape needs of a material: `Gamma` and `Eeq` at all `x = a/t` from 0.

use crate::Error;
use interp::{Curve, MaterialParameter, Quantity};

/// The largest third-order part of the thick film at the first point of the solution, over the
/// tolerance.
const THIRD_ORDER: f64 = 0.01;
/// The largest first-order part there. The polynomials follow it.
const FIRST_ORDER: f64 = 1.0;
/// The largest first point, over the first node.
const LARGEST_FIRST: f64 = 4.0;
/// The tolerance of a curve that does not state its own.
const FINE: f64 = 1e-9;

/// The material of a contact.
#[derive(Clone, Debug)]
pub(super) struct Medium {
    curve: Curve,
    es: f64,
    /// The relative tolerance of the results.
    pub tolerance: f64,
    /// The thickness of the film, or of the top layer, in units of that of all layers.
    pub top: f64,
    /// The first node, and the numbers of the thick film there.
    first: f64,
    thick: Thick,
}

/// The numbers `alpha` and `u` of a thick film, see the page `interp/src/curve/thick_film.rs` of the source, or
/// their derivatives with respect to a parameter.
#[derive(Clone, Copy, Debug)]
struct Thick {
    alpha: f64,
    u: f64,
}

impl Thick {
    /// Returns the numbers at an `x` that is `ratio` times as large.
    fn at(self, ratio: f64) -> Self {
        Self {
            alpha: ratio * self.alpha,
            u: ratio.powi(3) * self.u,
        }
    }
}

/// `Gamma/es`, its logarithmic derivative `dln(Gamma)/dx`, and `Eeq/es`.
#[derive(Clone, Copy, Debug)]
pub(super) struct At {
    pub gamma: f64,
    pub growth: f64,
    pub eeq: f64,
}

/// A parameter of the material, as in `QuantityGradient::relative`, with respect to which
/// the derivatives of a medium are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    parameter: MaterialParameter,
    thick: Thick,
}

/// The derivatives of `ln Gamma`, `dln(Gamma)/dx` and `ln(Eeq/es)` with respect to a parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Changed {
    pub ln_gamma: f64,
    pub growth: f64,
    pub ln_eeq: f64,
}

impl Medium {
    /// Takes the curve of a material.
    pub(super) fn new(curve: &Curve) -> Result<Self, Error> {
        let first = curve.range()[0];
        let es = curve.material().sphere_film_modulus();
        let at = curve.quantities(first)?;
        let u = 0.375 * at.pi0 / es - 1.0;
        Ok(Self {
            es,
            tolerance: curve.tolerance().unwrap_or(FINE),
            top: curve.stack().map_or(1.0, |stack| stack.top),
            first,
            thick: Thick {
                alpha: es / at.eeq - 1.0 - u,
                u,
            },
            curve: curve.clone(),
        })
    }

    /// Returns what the derivatives with respect to a parameter of the material need. `curve` is that
    /// of this medium, with derivatives.
    pub(super) fn change(
        &self,
        curve: &Curve,
        parameter: MaterialParameter,
    ) -> Result<Change, Error> {
        let [pi0, eeq, ..] = curve.over_es_by(parameter, self.first)?;
        let Thick { alpha, u } = self.thick;
        let by_u = (1.0 + u) * pi0;
        Ok(Change {
            parameter,
            thick: Thick {
                alpha: -(1.0 + alpha + u) * eeq - by_u,
                u: by_u,
            },
        })
    }

    /// Returns the derivatives at `x` with respect to a parameter.
    pub(super) fn changed(&self, change: Change, x: f64) -> Result<Changed, Error> {
        if x >= self.first {
            let [_, eeq, ln_gamma, growth] = self.curve.over_es_by(change.parameter, x)?;
            return Ok(Changed {
                ln_gamma,
                growth,
                ln_eeq: eeq,
            });
        }
        let ratio = x / self.first;
        let (Thick { alpha, u }, by) = (self.thick.at(ratio), change.thick.at(ratio));
        let (stiffness, rigid) = (1.0 + alpha + u, 1.0 + u);
        let softer = (by.alpha + by.u) / stiffness;
        let growth = if x > 0.0 {
            ((by.alpha + 3.0 * by.u - (alpha + 3.0 * u) * softer) / stiffness
                + 3.0 * by.u / (rigid * rigid))
                / x
        } else {
            change.thick.alpha / self.first
        };
        Ok(Changed {
            ln_gamma: -softer - by.u / rigid,
            growth: -growth,
            ln_eeq: -softer,
        })
    }

    /// Returns the largest `x` of the nodes.
    pub(super) fn last(&self) -> f64 {
        self.curve.range()[1]
    }

    /// Returns the `x` below which the film is thick to rounding.
    pub(super) fn thick(&self) -> f64 {
        let third = (THIRD_ORDER * self.tolerance / self.thick.u.abs()).cbrt();
        self.first
            * (FIRST_ORDER / self.thick.alpha.abs())
                .min(third)
                .min(LARGEST_FIRST)
    }

    /// Returns `es/Eeq - 1` of a thick film at `x`, or its derivative with respect to a parameter.
    pub(super) fn departure(&self, by: Option<Change>, x: f64) -> f64 {
        let thick = by.map_or(self.thick, |change| change.thick);
        let Thick { alpha, u } = thick.at(x / self.first);
        alpha + u
    }

    /// Returns `Gamma/es` and its logarithmic derivative at `x`.
    #[inline]
    pub(super) fn gamma_and_growth(&self, x: f64) -> Result<[f64; 2], Error> {
        if x < self.first {
            let At { gamma, growth, .. } = self.at(x)?;
            return Ok([gamma, growth]);
        }
        let [gamma, rate] = self
            .curve
            .functions()
            .value_and_rate(Quantity::Gamma as usize, x);
        Ok([gamma / self.es, rate / gamma])
    }

    /// Evaluates at `x`.
    pub(super) fn at(&self, x: f64) -> Result<At, Error> {
        if x < self.first {
            let Thick { alpha, u } = self.thick.at(x / self.first);
            // `es/Gamma = (1 + alpha + u) (1 + u)`.
            let stiffness = 1.0 + alpha + u;
            let growth = if x > 0.0 {
                ((alpha + 3.0 * u) / stiffness + 3.0 * u / (1.0 + u)) / x
            } else {
                self.thick.alpha / self.first
            };
            return Ok(At {
                gamma: 1.0 / (stiffness * (1.0 + u)),
                growth: -growth,
                eeq: 1.0 / stiffness,
            });
        }
        let (values, slopes) = self.curve.quantities_and_slopes(x)?;
        Ok(At {
            gamma: values.gamma / self.es,
            growth: slopes.get(Quantity::Gamma) / values.gamma / x,
            eeq: values.eeq / self.es,
        })
    }
}
