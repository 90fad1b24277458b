//! The curve beyond its nodes: the expansions about the exact limits, and how accurate they are.

use crate::curve::asymptotics::{Edge, Expansion};
use crate::curve::curve::Accuracy;
use crate::curve::sensitivity::QuantityGradient;
use crate::material::ROUNDING;
use crate::{Curve, Error};

impl Curve {
    /// Returns an estimate of the largest relative error of the quantities at `a_over_t`.
    ///
    /// Between the nodes it is the largest error of the table's certificate, beyond them the
    /// estimated error of the expansion about the limit.
    ///
    /// # Errors
    /// As [`Curve::quantity`]; [`Error::OutsideTable`] everywhere on a curve whose error is
    /// unknown: one that is not from a table, or from a table without a certificate.
    pub fn error(&self, a_over_t: f64) -> Result<f64, Error> {
        let known = self.accuracy.filter(|accuracy| accuracy.error.is_finite());
        let accuracy = known.ok_or_else(|| self.outside(a_over_t))?;
        if self.inside(a_over_t).is_some() {
            return Ok(accuracy.error);
        }
        // No quantity is more exact than its rounding.
        Ok(self.expanded(a_over_t)?.error.max(f64::EPSILON))
    }

    /// Returns whether the curve continues to `a/t` of 0: whether the expansion below the nodes is
    /// accurate enough next to them, where it is least accurate.
    pub fn goes_on_to_zero(&self) -> bool {
        self.expanded(self.range()[0] * (1.0 - 2.0 * ROUNDING))
            .is_ok()
    }

    /// Evaluates the expansion beyond the nodes, if it is accurate enough.
    #[cold]
    pub(super) fn expanded(&self, x: f64) -> Result<Expansion, Error> {
        let [from, to] = self.range();
        let known = self.accuracy.filter(|accuracy| accuracy.error.is_finite());
        let is_expandable = x > 0.0 && x < f64::INFINITY && self.stack.is_none();
        let (Some(Accuracy { error, tolerance }), true) = (known, is_expandable) else {
            return Err(self.outside(x));
        };
        let edge = |a_over_t: f64| -> Result<Edge, Error> {
            let (quantities, slopes) = self.values_and_slopes(a_over_t)?;
            Ok(Edge {
                a_over_t,
                quantities,
                slopes,
                known: if self.below.is_some() {
                    [false, true, true, false]
                } else {
                    self.known
                },
                error,
            })
        };
        let expansion = if x < from {
            let expansion = edge(from)?.continue_to_thicker_films(&self.material, x);
            expansion.map(|expansion| self.with_shape(x, expansion))
        } else if self.below.is_some() {
            None
        } else if 0.5 * to >= from {
            let (at_half, _) = self.values_and_slopes(0.5 * to)?;
            edge(to)?.continue_to_thinner_films(&at_half, &self.material, x)
        } else {
            None
        };
        let expansion = expansion.ok_or_else(|| self.outside(x))?;
        // Not `>`, which is false for NaN.
        if expansion.error <= tolerance {
            return Ok(expansion);
        }
        let (edge, estimate) = (if x < from { from } else { to }, expansion.error);
        Err(Error::Extrapolation {
            value: x,
            edge,
            estimate,
            tolerance,
        })
    }

    /// Returns the gradient below the nodes, from that at the first node.
    pub(super) fn gradient_below(
        &self,
        a_over_t: f64,
        at_first: &QuantityGradient,
    ) -> Result<QuantityGradient, Error> {
        let Expansion { values, slopes, .. } = self.expanded(a_over_t)?;
        let first = self.range()[0];
        let below = self.below.as_ref();
        let delta0 = below.map(|below| below.changes_of_delta0(a_over_t));
        Ok((*at_first).continued_to_thicker_films(a_over_t / first, values, slopes, delta0))
    }
}
