//! What other probes than a paraboloid need of a curve: its polynomials, where integrals over `a/t` may
//! begin, and a curve with `Pi0` and `Delta0` of the probe.

use std::fmt;
use std::sync::Arc;

use piecewise::{FUNCTION_TERMS, Piecewise, SPLINE_TERMS};

use crate::curve::asymptotics::Expansion;
use crate::curve::thick_film::{LARGEST, fifth_order};
use crate::{Curve, Error, MaterialParameter, Quantities};

/// `Pi0` and `Delta0` of another shape than a paraboloid below the nodes of a curve, on thick films.
pub trait BelowNodes: fmt::Debug + Send + Sync {
    /// Returns `Pi0` and `Delta0` at an `a_over_t` up to the first node, and their logarithmic slopes.
    fn pi0_and_delta0(&self, a_over_t: f64) -> [[f64; 2]; 2];

    /// Returns by what factors two numbers at an `a_over_t` up to the first node are as large as at the
    /// first node: the departure of `Delta0` from its value on a half-space, relative to that, and this
    /// value.
    fn changes_of_delta0(&self, a_over_t: f64) -> [f64; 2];
}

impl Curve {
    /// Returns the polynomials of the quantities over `a/t` between the nodes, in the order of
    /// [`Quantity::ALL`](crate::Quantity::ALL). Of a quantity that the curve does not answer they mean nothing.
    #[inline]
    pub const fn functions(&self) -> &Piecewise<FUNCTION_TERMS> {
        &self.functions
    }

    /// Returns the polynomials of the derivatives of the logarithms of the quantities over `es` (of
    /// `Delta0` itself) with respect to the parameters of the table that the derivatives of the curve
    /// need; none on a curve without derivatives.
    pub fn derivatives(&self) -> Option<&[Piecewise<SPLINE_TERMS>]> {
        Some(self.sensitivities.as_ref()?.by_table())
    }

    /// Returns the curve with `Pi0` and `Delta0` of another shape: those of a paraboloid with its load
    /// and its penetration. `functions`, `derivatives` and `below` take the places of
    /// [`Curve::functions`], of [`Curve::derivatives`] and of the expansion below the nodes; `Eeq` and
    /// `Gamma` in them must be those of this curve.
    ///
    /// # Panics
    /// If polynomials are on another grid than those of this curve.
    #[must_use]
    pub fn of_shape(
        &self,
        functions: Piecewise<FUNCTION_TERMS>,
        derivatives: Option<Vec<Piecewise<SPLINE_TERMS>>>,
        below: Arc<dyn BelowNodes>,
    ) -> Self {
        let of_derivatives = derivatives.iter().flatten().map(Piecewise::grid);
        for grid in of_derivatives.chain([functions.grid()]) {
            assert!(Arc::ptr_eq(grid, self.functions.grid()), "another grid");
        }
        let own = self.sensitivities.as_ref().zip(derivatives);
        Self {
            functions,
            sensitivities: own.map(|(own, by_table)| Arc::new(own.of_shape(by_table))),
            below: Some(below),
            ..self.clone()
        }
    }

    /// Accepts a curve on which integrals over `a/t` can begin at the first node. `name` is what
    /// they give. On a stack of layers, the thick film is the top layer.
    ///
    /// # Errors
    /// [`Error::MissingQuantity`] unless the curve knows all quantities; [`Error::BeginsTooLate`] if it begins at so
    /// large an `a/t` that the contact is not that of a thick film there.
    pub fn accept_integrals(&self, name: &'static str) -> Result<(), Error> {
        /// The accuracy that is asked of a curve that does not state its own.
        const TOLERANCE: f64 = 1e-6;
        self.require_all()?;
        let from = self.range()[0];
        let tolerance = self.tolerance().unwrap_or(TOLERANCE);
        let over_top = from / self.stack.map_or(1.0, |stack| stack.top);
        let estimate = if over_top <= LARGEST {
            fifth_order(&self.material, over_top)
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

    /// Returns the derivatives, with respect to a parameter as in
    /// `QuantityGradient::relative`, of the logarithms of `Pi0`, `Eeq` and `Gamma` over `es`
    /// between the nodes, and of the last one also the derivative with respect to `a_over_t`.
    ///
    /// # Errors
    /// [`Error::NoGradient`], [`Error::FixedParameter`], and [`Error::OutsideTable`] between no nodes.
    pub fn over_es_by(
        &self,
        parameter: MaterialParameter,
        a_over_t: f64,
    ) -> Result<[f64; 4], Error> {
        let sensitivities = self.sensitivities.as_ref().ok_or(Error::NoGradient)?;
        let x = self
            .inside(a_over_t)
            .ok_or_else(|| self.outside(a_over_t))?;
        let by = sensitivities.over_es(x, parameter);
        let [pi0, eeq, gamma, slope] = by.ok_or(Error::FixedParameter("the material"))?;
        Ok([pi0, eeq, gamma, slope / x])
    }

    /// Returns an expansion below the nodes with `Pi0` and `Delta0` of the shape.
    pub(super) fn with_shape(&self, x: f64, expansion: Expansion) -> Expansion {
        let Some(below) = &self.below else {
            return expansion;
        };
        let [values, slopes] = below.pi0_and_delta0(x);
        let replaced = |own: Quantities, [pi0, delta0]: [f64; 2]| Quantities { pi0, delta0, ..own };
        Expansion {
            values: replaced(expansion.values, values),
            slopes: replaced(expansion.slopes, slopes),
            ..expansion
        }
    }
}
