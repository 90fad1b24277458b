//! The contact under a cone and other odd powers of the radius, from a curve that holds `Delta1`.

use super::transform::kappa;
use interp::LoadAndPenetration;
use interp::over_pi0;
use interp::{Curve, Error, OddPowerCurve, Probe, Quantities};

/// A probe `f = c r^n` on a film.
#[derive(Clone, Debug)]
pub(crate) struct OddPower {
    /// `c kappa_n`, the factor of the penetration `c kappa_n a^n Delta_n`.
    factor: f64,
    curve: OddPowerCurve,
}

impl OddPower {
    /// Makes the contact of a cone, or of a power law with the exponent 1, 3 or 5, on a film whose
    /// curve holds `Delta1`; `None` for any other probe or curve.
    pub(super) fn new(probe: &Probe, curve: &Curve) -> Result<Option<Self>, Error> {
        let (coefficient, exponent) = match *probe {
            Probe::Cone { half_angle } => (half_angle.tan().recip(), 1),
            Probe::PowerLaw {
                coefficient,
                exponent,
            } => match exponent {
                1.0 => (coefficient, 1),
                3.0 => (coefficient, 3),
                5.0 => (coefficient, 5),
                _ => return Ok(None),
            },
            _ => return Ok(None),
        };
        if !curve.holds_cone() {
            return Ok(None);
        }
        Ok(Some(Self {
            factor: coefficient * kappa(f64::from(exponent)),
            curve: curve.odd_power(exponent)?,
        }))
    }

    /// Returns the curve with `Pi_n` and `Delta_n` in the places of `Pi0` and `Delta0`.
    pub(super) const fn curve(&self) -> &Curve {
        self.curve.curve()
    }

    /// Returns the exponent `n`.
    pub(crate) fn exponent(&self) -> f64 {
        f64::from(self.curve.exponent())
    }

    /// Returns load and penetration without adhesion at contact radius `a` (m), from the quantities
    /// of [`Self::curve`], at a `modulus` that normalises them (Pa).
    pub(crate) fn pair(&self, a: f64, modulus: f64, values: &Quantities) -> LoadAndPenetration {
        let exponent = self.curve.exponent();
        let penetration = self.factor * a.powi(exponent as i32);
        LoadAndPenetration {
            load: penetration * a * 0.5 * modulus * values.pi0 / over_pi0(exponent),
            penetration: penetration * values.delta0,
        }
    }

    /// Returns the derivatives of load and penetration with respect to `ln a`, from their values
    /// `of` and the quantities of [`Self::curve`] with their slopes.
    pub(super) fn by_radius(
        &self,
        of: LoadAndPenetration,
        values: &Quantities,
        slopes: &Quantities,
    ) -> LoadAndPenetration {
        let n = self.exponent();
        LoadAndPenetration {
            load: of.load * (n + 1.0 + slopes.pi0 / values.pi0),
            penetration: of.penetration * (n + slopes.delta0 / values.delta0),
        }
    }
}
