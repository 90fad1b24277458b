//! From splines of the quantities that are held, over `ln(a/t)`, to polynomials of all four quantities on
//! pieces of `a/t`.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use piecewise::bspline::Basis;
use piecewise::lanes::LANES;
use piecewise::{FUNCTION_TERMS, Piecewise, Polynomials, Resampler, SPLINE_TERMS};

use crate::Quantity;
use crate::curve::derived::{Constants, Derivation};
use crate::curve::thick_film::ThickFilm;

/// What makes the polynomials of the quantities from splines, made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct QuantityResampler {
    /// Resamples the splines of the quantities held.
    pub(crate) splines: Resampler,
    /// What follows from `Gamma`, if it is the only quantity that is held.
    pub(super) derivation: Option<Derivation>,
}

/// The polynomials of the quantities on all pieces of a curve.
#[derive(Clone, Debug)]
pub(crate) struct Pieces {
    pub(crate) values: Piecewise<FUNCTION_TERMS>,
    /// The estimated relative error that the quantities derived from `Gamma` have where their
    /// integrals begin; none if no quantity is derived.
    pub(crate) start_error: Option<f64>,
}

/// The derivatives of the derived quantities with respect to one parameter.
pub(super) struct ParameterDerivatives<'a> {
    /// The derivatives of the coefficients.
    coefficients: &'a [f64],
    /// The constants of their integrals.
    constants: Constants<'a>,
    /// The result on the pieces.
    pieces: Vec<Polynomials<SPLINE_TERMS>>,
}

impl QuantityResampler {
    /// Samples the B-splines of `basis` for the quantities `held`, by number, on `2^bits[i]` pieces in
    /// octave `i` of `range`.
    pub(crate) fn new(basis: &Basis, range: [f64; 2], held: &[usize], bits: &[u32]) -> Self {
        Self::of(Resampler::new(basis, range, held, bits))
    }

    /// Adds what follows from `Gamma`, if it is the only quantity that is held.
    pub(super) fn of(splines: Resampler) -> Self {
        let derivation = holds_gamma_alone(&splines).then(|| Derivation::new(splines.grid()));
        Self {
            splines,
            derivation: derivation.flatten(),
        }
    }

    /// Returns whether each quantity is held.
    pub(crate) fn held(&self) -> [bool; 4] {
        Quantity::ALL.map(|quantity| self.splines.functions().contains(&(quantity as usize)))
    }

    /// Returns the values of the spline of a single quantity where the integrals of the derived
    /// quantities begin.
    fn at_starts(&self, derivation: &Derivation, coefficients: &[f64]) -> [f64; 3] {
        dispatch!(Level::new(), simd => {
            let mut values = [0.0; 3];
            for (value, &start) in values.iter_mut().zip(&derivation.starts) {
                *value = self.splines.spline_at(simd, start, coefficients);
            }
            values
        })
    }

    /// Returns the polynomials of the quantities themselves; `es` is the sphere-film modulus of
    /// their [scales](Quantity::scale).
    pub(crate) fn values(&self, coefficients: &[f64], es: f64) -> Pieces {
        self.values_and_derivatives(coefficients, &[], es).0
    }

    /// Returns the polynomials of the quantities, and those of the derivatives of their logarithms
    /// with respect to some parameters, from the coefficients and their derivatives.
    pub(crate) fn values_and_derivatives(
        &self,
        coefficients: &[f64],
        derivatives: &[&[f64]],
        es: f64,
    ) -> (Pieces, Vec<Piecewise<SPLINE_TERMS>>) {
        let Some(derivation) = &self.derivation else {
            let scales = Quantity::ALL.map(|quantity| quantity.scale(es));
            let begins_nowhere = holds_gamma_alone(&self.splines);
            let pieces = Pieces {
                values: self.splines.exponentials(coefficients, scales),
                start_error: begins_nowhere.then_some(f64::INFINITY),
            };
            let derivatives = derivatives.iter().map(|by| self.splines.splines(by));
            return (pieces, derivatives.collect());
        };
        let starts = self.at_starts(derivation, coefficients);
        let start = ThickFilm::new(starts.map(f64::exp));
        let running = |[eeq, delta0, pi0]: [f64; 3]| {
            Constants::Running(derivation.at_start([eeq * es, delta0, pi0 * es]))
        };
        let mut parameters: Vec<_> = derivatives
            .iter()
            .map(|coefficients| {
                let [first, second, _] = self.at_starts(derivation, coefficients);
                ParameterDerivatives {
                    coefficients,
                    constants: running(start.derivatives([first, second])),
                    pieces: Vec::new(),
                }
            })
            .collect();
        let constants = running(start.values());
        let pieces = Pieces {
            values: self.derived(derivation, coefficients, es, constants, &mut parameters),
            start_error: Some(start.error),
        };
        let derivatives = parameters.into_iter().map(|by| self.on_grid(by.pieces));
        (pieces, derivatives.collect())
    }

    /// Returns polynomials on the pieces of a curve.
    fn on_grid<const N: usize>(&self, pieces: Vec<Polynomials<N>>) -> Piecewise<N> {
        Piecewise::new(self.splines.grid().clone(), pieces)
    }

    /// Returns the polynomials of the quantities that follow from the spline of `Gamma`, see
    /// [`Derivation::integrals`]; writes those of the derivatives of their logarithms, see
    /// [`Derivation::sensitivities`].
    pub(super) fn derived(
        &self,
        derivation: &Derivation,
        coefficients: &[f64],
        es: f64,
        constants: Constants<'_>,
        parameters: &mut [ParameterDerivatives<'_>],
    ) -> Piecewise<FUNCTION_TERMS> {
        let pieces = dispatch!(Level::new(), simd => {
            self.derive(simd, derivation, coefficients, es, constants, parameters)
        });
        self.on_grid(pieces)
    }

    /// [`QuantityResampler::derived`] with vector instructions.
    #[inline(always)]
    fn derive<S: Simd>(
        &self,
        simd: S,
        derivation: &Derivation,
        coefficients: &[f64],
        es: f64,
        mut constants: Constants<'_>,
        parameters: &mut [ParameterDerivatives<'_>],
    ) -> Vec<Polynomials<FUNCTION_TERMS>> {
        let count = self.splines.grid().count();
        // The last piece is repeated until its group is full. The repetitions are cut off at the end.
        let padded = LANES * derivation.groups();
        let mut pieces = vec![[[0.0; 4]; FUNCTION_TERMS]; padded];
        for parameter in &mut *parameters {
            parameter.pieces.resize(padded, [[0.0; 4]; SPLINE_TERMS]);
        }
        for (group, target) in pieces.as_chunks_mut().0.iter_mut().enumerate() {
            let logarithms = self.splines.spline_on_group(simd, group, coefficients);
            let integrals = derivation.integrals(simd, group, &logarithms, es, &mut constants);
            for parameter in &mut *parameters {
                let gamma = self
                    .splines
                    .spline_on_group(simd, group, parameter.coefficients);
                let target = &mut parameter.pieces.as_chunks_mut().0[group];
                let constants = &mut parameter.constants;
                derivation.sensitivities(simd, group, &integrals, &gamma, constants, target);
            }
            derivation.values(simd, group, &logarithms, &integrals, target);
        }
        for parameter in parameters {
            parameter.pieces.truncate(count);
        }
        pieces.truncate(count);
        pieces
    }
}

impl AsRef<Resampler> for QuantityResampler {
    fn as_ref(&self) -> &Resampler {
        &self.splines
    }
}

/// Returns whether the splines are those of `Gamma` alone.
fn holds_gamma_alone(splines: &Resampler) -> bool {
    splines.functions() == [Quantity::Gamma as usize]
}
