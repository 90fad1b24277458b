//! The choice of the pieces of a curve, with the quantities that follow from `Gamma`.

use piecewise::bspline::Basis;
use piecewise::{Exponentials, FUNCTION_TERMS, Fitting, Grid, Piecewise, Resampler, Target};

use crate::Quantity;
use crate::curve::derived::{Constants, Derivation};
use crate::curve::quantity_resampler::{Pieces, QuantityResampler};

impl QuantityResampler {
    /// The binary logarithm of the number of pieces in an octave with which derived quantities are
    /// compared.
    const REFERENCE: u32 = 4;

    /// Finds the longest pieces on which `count` curves follow their splines, and the quantities
    /// derived from them, to a relative `error`, see [`Fitting::longest`].
    ///
    /// `curve(i)` returns the coefficients of curve `i`: a group of the quantities `held` for each
    /// B-spline.
    pub(crate) fn fitting<C: AsRef<[f64]>>(
        basis: &Basis,
        range: [f64; 2],
        held: &[Quantity],
        count: usize,
        curve: impl Fn(usize) -> C,
        error: f64,
    ) -> Self {
        let held: Vec<usize> = held.iter().map(|&quantity| quantity as usize).collect();
        let fitting = Fitting {
            range,
            curves: count,
            error,
        };
        if held != [Quantity::Gamma as usize] || !Derivation::begins(range) {
            return Self::of(Resampler::fitting(basis, &held, &fitting, curve));
        }
        let resampler = |bits: &[u32]| Self::new(basis, range, &held, bits);
        let fine = resampler(&vec![Self::REFERENCE; Grid::most_octaves(range)]);
        let target = |i: usize| {
            let coefficients = curve(i);
            let Pieces {
                values,
                start_error,
            } = fine.values(coefficients.as_ref(), 1.0);
            FromGamma {
                // An error of the size of the quantities, or NaN, belongs to no thick film. Then
                // nothing is derived, and integrals that begin there need not be accurate.
                derived: start_error.filter(|error| *error < 1.0).map(|_| values),
                gamma: Exponentials {
                    basis,
                    functions: &held,
                    coefficients,
                },
            }
        };
        fitting.longest(fine.splines.grid().count(), resampler, target)
    }
}

/// A curve that polynomials on pieces are to follow, of all quantities from `Gamma`.
struct FromGamma<'a, C> {
    gamma: Exponentials<'a, C>,
    /// The derived quantities on short pieces; none if nothing is derived.
    derived: Option<Piecewise<FUNCTION_TERMS>>,
}

impl<C: AsRef<[f64]>> Target<QuantityResampler> for FromGamma<'_, C> {
    /// Returns the polynomials. The integrals of derived quantities begin anew on each piece, because
    /// the errors of a piece are to be its own.
    fn polynomials(&self, resampler: &QuantityResampler) -> Piecewise<FUNCTION_TERMS> {
        let coefficients = self.gamma.coefficients.as_ref();
        let (Some(fine), Some(derivation)) = (&self.derived, &resampler.derivation) else {
            return resampler.values(coefficients, 1.0).values;
        };
        let grid = resampler.splines.grid();
        let beginnings = grid.pieces().map(|(_, [from, _])| {
            let x = (from / grid.factor()).max(grid.range()[0]);
            let [pi0, eeq, _, delta0] = fine.values(x);
            Derivation::at(x * grid.factor(), [eeq, delta0, pi0])
        });
        let beginnings: Vec<[f64; 3]> = beginnings.collect();
        let constants = Constants::Given(&beginnings);
        resampler.derived(derivation, coefficients, 1.0, constants, &mut [])
    }

    /// Returns the quantities at `x`, over their scales.
    fn values(&self, x: f64) -> impl Iterator<Item = (usize, f64)> {
        let derived = self.derived.as_ref().map(|derived| derived.values(x));
        let derived = derived.into_iter().flat_map(|values| {
            [Quantity::Pi0, Quantity::Eeq, Quantity::Delta0]
                .map(|quantity| (quantity as usize, values[quantity as usize]))
        });
        self.gamma.values(x).chain(derived)
    }

    fn is_tested_at_ends(&self) -> bool {
        self.derived.is_some()
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// Curves of noise on sixty decades need the shortest pieces. To compare all of them, with the
    /// quantities that follow from them, would take seconds.
    #[test]
    fn noise_takes_no_more_than_is_allowed() {
        const COUNT: usize = 125;
        let range = [1e-30, 1e30];
        let nodes: Vec<f64> = (0..4000)
            .map(|i| (range[0] * 10_f64.powf(60.0 * f64::from(i) / 3999.0)).ln())
            .collect();
        let basis = Basis::of_table(&nodes);
        let calls = Cell::new(0);
        let curve = |i: usize| -> Vec<f64> {
            calls.set(calls.get() + 1);
            let noise = |k: usize| 0.1 * (k as f64 * (1.0 + i as f64)).sin();
            (0..nodes.len()).map(noise).collect()
        };
        let held = [Quantity::Gamma];
        let resampler = QuantityResampler::fitting(&basis, range, &held, COUNT, curve, 1e-12);
        let pieces = resampler.splines.grid().count();
        println!("{} curves, {pieces} pieces", calls.get());
        assert!(pieces > 12_000);
        assert!(calls.get() * pieces <= 500_000);
    }
}
