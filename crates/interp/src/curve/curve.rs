//! The curve of one material: the quantities as functions of `a/t`.

use std::sync::Arc;

use piecewise::{FUNCTION_TERMS, Piecewise};

use crate::curve::asymptotics::Expansion;
use crate::curve::nodes::REASONABLE;
use crate::curve::quantity_resampler::{Pieces, QuantityResampler};
use crate::curve::sensitivity::{QuantityGradient, Sensitivities};
use crate::curve::shaped::BelowNodes;
use crate::curve::thick_film::fifth_order;
use crate::material::ROUNDING;
use crate::{Error, Material, Parameter, Quantities, Quantity};

/// The four quantities as functions of `a/t` for one material.
///
/// [`Table::curve`](crate::Table::curve) and [`Curve::through`] make it. Each evaluation is then a polynomial of degree
/// 9 in `a/t` on one of some forty pieces (as many in each octave as are needed: two in the embedded table). The pieces
/// follow the spline through the logarithms at the nodes; they add to the error less than a tenth of the table's
/// tolerance, or 1e-11 if that is more. An evaluation allocates nothing. A clone shares the pieces.
///
/// A table of `gamma` alone makes a curve of all four quantities: the others are integrals of `Gamma` over `a/t`,
/// exactly (see the page `curve/derived.rs` of the source). The relative error of each is about that of `Gamma`, in
/// theory up to 2, 4 and 6 times as large for `Eeq`, `Delta0` and `Pi0`. The table must begin at a small `a/t` (0.01
/// for a tolerance of 1e-8, 0.03 for 1e-6); otherwise the others are an [`Error::BeginsTooLate`].
///
/// A curve of a table continues beyond the `a/t` of its nodes by the first terms of the expansions about the exact
/// limits, as far as their estimated error ([`Curve::error`]) is within the table's tolerance. This needs a table that
/// begins at an `a/t` of 1 at most, or ends at 2 at least and begins at half of its end or less. Farther out, and
/// beyond the nodes of any other curve, an evaluation is an error. The errors are at most 1.06 of the estimates:
/// measured with 300 random boxes that end anywhere and 17,114 contacts, of which `tests/table/beyond.rs` takes 40 boxes.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The quantities over `a/t`, in the order of [`Quantity::ALL`].
    pub(super) functions: Piecewise<FUNCTION_TERMS>,
    pub(super) material: Material,
    /// Whether each quantity is held or derived, in the order of [`Quantity::ALL`].
    pub(super) known: [bool; 4],
    /// The estimated error with which the quantities derived from `Gamma` begin, if any are.
    pub(super) start_error: Option<f64>,
    pub(super) sensitivities: Option<Arc<Sensitivities>>,
    /// `Pi0` and `Delta0` below the nodes, if they are those of another shape than a paraboloid.
    pub(super) below: Option<Arc<dyn BelowNodes>>,
    pub(super) accuracy: Option<Accuracy>,
    pub(super) stack: Option<StackShape>,
    /// The curve of the flat punch, if the contact sticks.
    pub(super) stick: Option<Arc<Curve>>,
}

/// What a contact needs to know of a stack of layers beside its curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StackShape {
    /// The ratio of stiffnesses of
    /// `FilmValidity::compressibility` of the crate `contact` over `(a/t)^2`, with the thickness `t` of
    /// all layers; NaN if they are not all bonded to each other and to the base.
    pub compressibility: f64,
    /// The thickness of the top layer over `t`.
    pub top: f64,
    /// What the springs between layers open together under a pressure of 1 Pa, over `t`, 1/Pa.
    pub opening: f64,
}

/// The accuracy of the table that a curve was made from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Accuracy {
    /// The largest error at the sampled points of the table's certificate.
    pub(super) error: f64,
    /// The largest estimated error that an expansion beyond the nodes may have.
    pub(super) tolerance: f64,
}

impl Curve {
    /// Makes the curve of splines over `ln(a/t)`; `coefficients` holds a group of `quantities` for
    /// each B-spline.
    pub(crate) fn of_splines(
        resampler: &QuantityResampler,
        coefficients: &[f64],
        material: Material,
    ) -> Self {
        let pieces = resampler.values(coefficients, material.sphere_film_modulus());
        Self::of_pieces(resampler, pieces, material)
    }

    /// Makes the curve of its polynomials on the pieces of `resampler`.
    pub(crate) fn of_pieces(
        resampler: &QuantityResampler,
        pieces: Pieces,
        material: Material,
    ) -> Self {
        let Pieces {
            values,
            start_error,
        } = pieces;
        let [first, _] = values.grid().range();
        Self {
            functions: values,
            material,
            known: resampler.held(),
            start_error: start_error.map(|error| error + fifth_order(&material, first)),
            sensitivities: None,
            below: None,
            accuracy: None,
            stack: None,
            stick: None,
        }
    }

    /// Returns a known quantity that may leave `[1e-30, 1e30]` on a piece, with its value in the
    /// middle of that piece.
    pub(crate) fn unreasonable(&self) -> Option<(Quantity, f64)> {
        let leaving = self.functions.leaving(&REASONABLE, self.known);
        leaving.map(|(quantity, value)| (Quantity::ALL[quantity], value))
    }

    /// Adds the derivatives with respect to the material.
    pub(crate) fn with_sensitivities(self, sensitivities: Sensitivities) -> Self {
        Self {
            sensitivities: Some(Arc::new(sensitivities)),
            ..self
        }
    }

    /// Adds the expansions beyond the nodes. `error` is the largest error of the table's certificate, `tolerance` the
    /// tolerance of the table, with which the quantities derived from `Gamma` must begin.
    pub(crate) fn with_expansions(self, error: f64, tolerance: f64) -> Self {
        let derived = self.start_error.is_some_and(|error| error <= tolerance);
        Self {
            known: if derived { [true; 4] } else { self.known },
            accuracy: Some(Accuracy { error, tolerance }),
            ..self
        }
    }

    /// Makes this the curve of a stack of layers, of which [`Curve::material`] holds the solid that the sphere touches
    /// and the base.
    ///
    /// Its compressibility replaces the formula for one film, and the thickness of its top layer limits the zone of an
    /// attraction of finite range and the contact with which integrals over `a/t` begin. Nothing else that a contact
    /// answers needs more than the quantities, the material and the thickness `t` of all layers. The curve has no expansions beyond its nodes, and answers only the quantities
    /// that it holds, because the expansions are those of one film.
    #[must_use]
    pub fn of_stack(self, stack: StackShape) -> Self {
        Self {
            stack: Some(stack),
            start_error: None,
            ..self
        }
    }

    /// Makes this the curve of a contact with full friction.
    ///
    /// Its `Eeq` and `Gamma` are then those of eq. 9 for the history of this contact. Those of a flat punch that
    /// sticks, which give the stiffness at a fixed contact radius, are the `Eeq` and `Gamma` of `punch`. With friction
    /// `Gamma^2 = es d(x Eeq)/dx` and all that follows from it do not hold, so that the contact of another shape does
    /// not follow from the curve.
    #[must_use]
    pub fn with_stick(self, punch: &Self) -> Self {
        Self {
            stick: Some(Arc::new(punch.clone())),
            ..self
        }
    }

    /// Returns the curve of the flat punch with full friction; `None` for a contact without
    /// friction.
    pub fn stick(&self) -> Option<&Self> {
        self.stick.as_deref()
    }

    /// Returns what a contact needs to know of a stack of layers; `None` for one film.
    pub const fn stack(&self) -> Option<StackShape> {
        self.stack
    }

    /// Returns the material. On a curve from a table it is the equivalent on a substrate with the
    /// table's Poisson ratio.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Returns the smallest and the largest `a/t` of the nodes.
    #[inline]
    pub fn range(&self) -> [f64; 2] {
        self.functions.grid().range()
    }

    /// Returns whether [`Curve::quantity`] answers `quantity`: the table holds it, or it follows from `Gamma` within
    /// the tolerance of the table.
    pub fn answers(&self, quantity: Quantity) -> bool {
        self.known[quantity as usize]
    }

    /// Returns the value of `quantity` at `a_over_t`.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] for an `a_over_t` outside the curve, NaN included; [`Error::Extrapolation`] where the
    /// expansion about the limit is not accurate enough; [`Error::MissingQuantity`] if the table does not hold
    /// `quantity`, [`Error::BeginsTooLate`] if it holds `gamma` alone and begins at too large an `a/t`.
    #[inline]
    pub fn quantity(&self, quantity: Quantity, a_over_t: f64) -> Result<f64, Error> {
        self.require(quantity)?;
        match self.inside(a_over_t) {
            Some(x) => Ok(self.functions.value(quantity as usize, x)),
            None => Ok(self.expanded(a_over_t)?.values.get(quantity)),
        }
    }

    /// Writes the value of `quantity` at each `a_over_t` to `values`, in the order given.
    ///
    /// The values are those of [`Curve::quantity`] except for rounding, in two thirds of the time.
    ///
    /// # Errors
    /// As [`Curve::quantity`] at the first point with an error; the values before it are written.
    /// [`Error::InvalidArgument`] if `values` and `a_over_t` differ in length.
    pub fn quantity_at_all(
        &self,
        quantity: Quantity,
        a_over_t: &[f64],
        values: &mut [f64],
    ) -> Result<(), Error> {
        Error::same_length(a_over_t, values)?;
        self.require(quantity)?;
        let outside = |x: f64| self.quantity(quantity, x);
        self.functions
            .value_at_all(quantity as usize, a_over_t, values, outside)
    }

    /// Returns the logarithmic slope `x dQ/dx` of `quantity` at `x = a_over_t`, the derivative of [`Curve::quantity`].
    ///
    /// Its error is some ten times that of the quantity: the errors of a certificate's identities, which contain
    /// slopes, are 5 to 30 times its largest error.
    ///
    /// # Errors
    /// As [`Curve::quantity`]; [`Error::FixedParameter`] on a curve of a single node.
    pub fn slope(&self, quantity: Quantity, a_over_t: f64) -> Result<f64, Error> {
        self.require(quantity)?;
        Ok(self.known_slopes(a_over_t)?.1.get(quantity))
    }

    /// Returns all four quantities at `a_over_t`.
    ///
    /// # Errors
    /// As [`Curve::quantity`].
    #[inline]
    pub fn quantities(&self, a_over_t: f64) -> Result<Quantities, Error> {
        self.require_all()?;
        match self.inside(a_over_t) {
            Some(x) => Ok(Quantities::from_array(self.functions.values(x))),
            None => Ok(self.expanded(a_over_t)?.values),
        }
    }

    /// Returns all four quantities at `a_over_t` and their [slopes](Curve::slope).
    ///
    /// # Errors
    /// As [`Curve::slope`].
    #[inline]
    pub fn quantities_and_slopes(&self, a_over_t: f64) -> Result<(Quantities, Quantities), Error> {
        self.require_all()?;
        self.known_slopes(a_over_t)
    }

    /// Returns `Pi0` and `Delta0` with their [slopes](Curve::slope). The other two are known or not.
    ///
    /// # Errors
    /// As [`Curve::slope`].
    pub fn adhesionless_and_slopes(
        &self,
        a_over_t: f64,
    ) -> Result<(Quantities, Quantities), Error> {
        self.require(Quantity::Pi0)?;
        self.require(Quantity::Delta0)?;
        self.known_slopes(a_over_t)
    }

    /// Returns all four quantities at `a_over_t` with their derivatives with respect to `a_over_t` and to the four
    /// parameters of the material.
    ///
    /// They are the derivatives of the table's splines or polynomials, except for the error of the pieces. With respect
    /// to the Poisson ratio of nearly incompressible films they are differences of lookups instead, because there the
    /// slope is inaccurate. Below the nodes they are those of the expansion for thick films.
    ///
    /// Errors of the derivatives of the embedded table are at most about 60 times its tolerance for the film's Poisson
    /// ratio, 20 times for the substrate's, and 10 times for the others. They are relative to the quantity and per unit of `ln(a/t)`, `ln
    /// e1_over_e2` and `ln e0_over_e2`. The unit of the film's Poisson ratio is `(1 - 2 nu1) + 1/(1 + (a/t)^2)`, the
    /// size of a change that alters the contact; that of the substrate's is 1. Measured by `tests/contact/gradient` at
    /// 2000 random contacts of every contrast: 2.7, 9.5 and 9.5 tolerances, and 57 and 18 for the Poisson ratios.
    ///
    /// # Errors
    /// As [`Curve::quantity`], but [`Error::OutsideTable`] everywhere above the nodes; [`Error::NoGradient`] on a curve
    /// that was made without derivatives.
    #[inline]
    pub fn gradient(&self, a_over_t: f64) -> Result<QuantityGradient, Error> {
        self.require_all()?;
        let Some(sensitivities) = &self.sensitivities else {
            return Err(Error::NoGradient);
        };
        match self.inside(a_over_t) {
            Some(x) => Ok(sensitivities.gradient(&self.functions, x)),
            None if a_over_t < self.range()[0] => {
                let at_first = sensitivities.gradient(&self.functions, self.range()[0]);
                self.gradient_below(a_over_t, &at_first)
            }
            None => Err(self.outside(a_over_t)),
        }
    }

    /// Returns the material with respect to whose parameters the derivatives are.
    ///
    /// # Errors
    /// [`Error::NoGradient`] on a curve that was made without derivatives.
    pub fn differentiated_for(&self) -> Result<&Material, Error> {
        let sensitivities = self.sensitivities.as_ref().ok_or(Error::NoGradient)?;
        Ok(sensitivities.material())
    }

    /// Returns `Pi0` and `Eeq/Gamma`, the factors of the load in eq. 9.
    ///
    /// # Errors
    /// As [`Curve::quantity`].
    #[inline]
    pub fn load_factors(&self, a_over_t: f64) -> Result<(f64, f64), Error> {
        [Quantity::Pi0, Quantity::Eeq, Quantity::Gamma]
            .into_iter()
            .try_for_each(|quantity| self.require(quantity))?;
        let [pi0, eeq, gamma, _] = match self.inside(a_over_t) {
            Some(x) => self.functions.values(x),
            None => self.expanded(a_over_t)?.values.to_array(),
        };
        Ok((pi0, eeq / gamma))
    }

    /// Accepts a quantity of a sphere that the curve knows.
    #[inline]
    fn require(&self, quantity: Quantity) -> Result<(), Error> {
        if self.known[quantity as usize] {
            Ok(())
        } else {
            Err(self.unknown(quantity))
        }
    }

    /// The error of a quantity that is neither held nor derived.
    #[cold]
    fn unknown(&self, quantity: Quantity) -> Error {
        match (self.start_error, &self.accuracy) {
            (Some(estimate), Some(Accuracy { tolerance, .. })) => Error::BeginsTooLate {
                quantity: quantity.name(),
                from: self.range()[0],
                estimate,
                tolerance: *tolerance,
            },
            _ => Error::MissingQuantity(quantity.name()),
        }
    }

    /// Accepts a curve that knows all quantities.
    #[inline]
    pub(super) fn require_all(&self) -> Result<(), Error> {
        Quantity::ALL
            .into_iter()
            .try_for_each(|quantity| self.require(quantity))
    }

    /// Returns `a_over_t` if it is between the nodes; the nearest node if it misses them by the
    /// rounding of a ratio; `None` otherwise.
    #[inline]
    pub(super) fn inside(&self, a_over_t: f64) -> Option<f64> {
        let [from, to] = self.range();
        if a_over_t >= from && a_over_t <= to {
            return Some(a_over_t);
        }
        let near = |end: f64| (a_over_t - end).abs() <= ROUNDING * end;
        if near(from) {
            Some(from)
        } else if near(to) {
            Some(to)
        } else {
            None
        }
    }

    /// Evaluates all quantities and their slopes. A single node tells no slope.
    #[inline]
    fn known_slopes(&self, a_over_t: f64) -> Result<(Quantities, Quantities), Error> {
        let [from, to] = self.range();
        if from == to && self.inside(a_over_t).is_some() {
            return Err(Error::FixedParameter(Parameter::AOverT.name()));
        }
        self.values_and_slopes(a_over_t)
    }

    /// Evaluates all quantities and their slopes, which are NaN on a curve of a single node.
    #[inline]
    pub(super) fn values_and_slopes(
        &self,
        a_over_t: f64,
    ) -> Result<(Quantities, Quantities), Error> {
        let Some(x) = self.inside(a_over_t) else {
            let Expansion { values, slopes, .. } = self.expanded(a_over_t)?;
            return Ok((values, slopes));
        };
        let [values, slopes] = self.functions.values_and_slopes(x);
        Ok((
            Quantities::from_array(values),
            Quantities::from_array(slopes),
        ))
    }

    /// The error of an `a/t` outside the curve.
    pub(super) fn outside(&self, value: f64) -> Error {
        let [from, to] = self.range();
        Error::OutsideTable {
            axis: Parameter::AOverT.name(),
            value,
            from,
            to,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::test_curve::{curve, even, exact};

    #[test]
    fn the_slope_is_the_derivative_of_the_curve() {
        let curve = curve(&even(600));
        let [from, to] = curve.range();
        for i in 0..=1000 {
            let x = (from * (to / from).powf(f64::from(i) / 1000.0)).clamp(from, to);
            let step = 1e-5;
            for quantity in Quantity::ALL {
                let at = |u: f64| {
                    curve
                        .quantity(quantity, (x * u.exp()).clamp(from, to))
                        .expect("in range")
                };
                let expected = match (x > from, x < to) {
                    (true, true) => (at(step) - at(-step)) / (2.0 * step),
                    (false, _) => (4.0 * at(step) - 3.0 * at(0.0) - at(2.0 * step)) / (2.0 * step),
                    (_, false) => {
                        (3.0 * at(0.0) - 4.0 * at(-step) + at(-2.0 * step)) / (2.0 * step)
                    }
                };
                let slope = curve.slope(quantity, x).expect("in range");
                assert!(
                    (slope - expected).abs() <= 1e-8 * at(0.0),
                    "{x}: {slope}, not {expected}"
                );
            }
        }
        let single = Curve::through(&[(2.0, exact(2.0))], curve.material).expect("a node");
        let slope = single.slope(Quantity::Pi0, 2.0);
        assert!(matches!(slope, Err(Error::FixedParameter("a_over_t"))));
    }

    #[test]
    fn many_values_are_those_of_one_after_the_other() {
        let curve = curve(&even(60));
        let points: Vec<f64> = (0..1000)
            .map(|i| 10_f64.powf(-3.0 + 6.0 * (f64::from(i) * 0.618_034 % 1.0)))
            .collect();
        let mut values = vec![0.0; points.len()];
        curve
            .quantity_at_all(Quantity::Gamma, &points, &mut values)
            .expect("in range");
        for (&x, value) in points.iter().zip(&values) {
            assert_eq!(
                *value,
                curve.quantity(Quantity::Gamma, x).expect("in range")
            );
        }
        assert!(matches!(
            curve.quantity_at_all(Quantity::Gamma, &points, &mut values[1..]),
            Err(Error::InvalidArgument { .. })
        ));
        assert!(matches!(
            curve.quantity_at_all(Quantity::Gamma, &[1.0, 2e3], &mut [0.0; 2]),
            Err(Error::OutsideTable { .. })
        ));
    }

    #[test]
    fn it_is_shared_between_threads_and_by_clones() {
        fn shared<T: Send + Sync + Clone>(_: &T) {}
        let curve = curve(&even(60));
        shared(&curve);
        assert!(std::ptr::eq(
            curve.functions.pieces(),
            curve.clone().functions.pieces()
        ));
    }
}
