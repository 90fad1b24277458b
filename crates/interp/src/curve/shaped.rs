//! The curve under other probes than a paraboloid: load and penetration of shapes of even powers,
//! and what the integrals over `a/t` of every shape need.

use std::sync::Arc;

use crate::curve::asymptotics::Expansion;
use crate::curve::even_powers::{EvenShape, Source};
use crate::curve::thick_film::{LARGEST, fifth_order};
use crate::{Curve, Error, Quantity};

impl Curve {
    /// Returns the curve whose `Pi0` and `Delta0` are those of a paraboloid with the load and the
    /// penetration of another shape, with derivatives if this curve has them.
    ///
    /// # Errors
    /// [`Error::MissingQuantity`] unless the curve knows all quantities; [`Error::BeginsTooLate`]
    /// if it begins at so large an `a/t` that the contact is not that of a thick film there.
    pub fn of_even_shape(&self, shape: EvenShape) -> Result<Self, Error> {
        self.accept_integrals("the contact of this probe")?;
        let source = self.source();
        let (functions, even) = source.of_shape(shape);
        let (sensitivities, even) = match &self.sensitivities {
            None => (None, even),
            Some(own) => {
                let own = own.of_other(|by| source.by_parameter(shape, &functions, by));
                (
                    Some(Arc::new(own)),
                    source.with_derivatives(&functions, even),
                )
            }
        };
        Ok(Self {
            functions,
            sensitivities,
            even: Some(Arc::new(even)),
            ..self.clone()
        })
    }

    /// Accepts a curve on which integrals over `a/t` can begin at the first node. `name` is what
    /// they give. On a stack of layers the expansion before the first node is not known.
    ///
    /// # Errors
    /// [`Error::StackProbe`] on a stack of layers; [`Error::MissingQuantity`] and
    /// [`Error::BeginsTooLate`] as [`Curve::of_even_shape`].
    pub fn accept_integrals(&self, name: &'static str) -> Result<(), Error> {
        /// The accuracy that is asked of a curve that does not state its own.
        const TOLERANCE: f64 = 1e-6;
        self.require_all()?;
        if self.stack.is_some() {
            return Err(Error::StackProbe);
        }
        let (from, tolerance) = (
            self.range()[0],
            self.accuracy
                .map_or(TOLERANCE, |accuracy| accuracy.tolerance),
        );
        let estimate = if from <= LARGEST {
            fifth_order(&self.material, from)
        } else {
            f64::INFINITY
        };
        if estimate <= tolerance {
            return Ok(());
        }
        Err(Error::BeginsTooLate {
            quantity: name,
            from,
            estimate,
            tolerance,
        })
    }

    /// Returns the tolerance of the table that the curve was made from, if it is known.
    pub fn tolerance(&self) -> Option<f64> {
        self.accuracy.map(|accuracy| accuracy.tolerance)
    }

    /// Returns `Gamma` and its derivative with respect to `a_over_t`, which must be between the nodes,
    /// on a curve that knows `Gamma`.
    #[inline]
    pub fn gamma_and_rate(&self, a_over_t: f64) -> [f64; 2] {
        self.functions
            .value_and_rate(Quantity::Gamma as usize, a_over_t)
    }

    /// Returns the derivatives, with respect to a parameter by number as in
    /// `QuantityGradient::relative`, of the logarithms of `Pi0`, `Eeq` and `Gamma` over `es`
    /// between the nodes, and of the last one also the derivative with respect to `a_over_t`.
    ///
    /// # Errors
    /// [`Error::NoGradient`], [`Error::FixedParameter`], and [`Error::OutsideTable`] between no nodes.
    pub fn over_es_by(&self, parameter: usize, a_over_t: f64) -> Result<[f64; 4], Error> {
        let sensitivities = self.sensitivities.as_ref().ok_or(Error::NoGradient)?;
        let x = self
            .inside(a_over_t)
            .ok_or_else(|| self.outside(a_over_t))?;
        let grid = self.functions.grid();
        let by = sensitivities.over_es(grid.locate(x), parameter);
        let [pi0, eeq, gamma, slope] = by.ok_or(Error::FixedParameter("the material"))?;
        Ok([pi0, eeq, gamma, slope * grid.logarithmic_speed(x) / x])
    }

    /// Returns the derivatives of the logarithms of load and penetration without adhesion with
    /// respect to that of all lengths of the shape, on a curve of [`Self::of_even_shape`].
    ///
    /// # Errors
    /// [`Error::NoGradient`] on another curve, or on one without derivatives.
    pub fn by_size(&self, a_over_t: f64) -> Result<[f64; 2], Error> {
        let even = self.even.as_ref().ok_or(Error::NoGradient)?;
        even.by_size(a_over_t, self.inside(a_over_t))
    }

    /// Returns the pieces, from which those of other shapes follow.
    pub(super) fn source(&self) -> Source<'_> {
        Source {
            functions: &self.functions,
            es: self.material.sphere_film_modulus(),
        }
    }

    /// Returns whether `Pi0` and `Delta0` are those of another shape than a paraboloid.
    pub(super) fn is_of_other_shape(&self) -> bool {
        self.even.is_some()
    }

    /// Returns an expansion below the nodes with `Pi0` and `Delta0` of the shape.
    pub(super) fn with_shape(&self, x: f64, expansion: Expansion) -> Expansion {
        let Some(even) = &self.even else {
            return expansion;
        };
        let (values, slopes) = even.below(x, expansion.values, expansion.slopes);
        Expansion {
            values,
            slopes,
            ..expansion
        }
    }
}
