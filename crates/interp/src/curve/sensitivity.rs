//! The derivatives of the quantities with respect to the parameters of the material.

use piecewise::{Piecewise, Position, SPLINE_TERMS};

use crate::material::equivalence::Jacobian;
use crate::material::one_minus_square;
use crate::{Error, Material, Normalisation, Parameter, Quantities, Quantity};

/// The derivatives of a curve with respect to the parameters of its material, on every piece.
#[derive(Clone, Debug)]
pub(crate) struct Sensitivities {
    /// The derivatives of the logarithms with respect to `ln e1_over_e2`, `nu1` and `ln e0_over_e2`
    /// of the table.
    by_table: [Piecewise<SPLINE_TERMS>; 3],
    /// Whether each of them is known. The derivative with respect to a parameter that the table
    /// fixes to a finite value is unknown.
    known: [bool; 3],
    /// The derivatives of the table's parameters with respect to those of the material asked for,
    /// which may be on another substrate.
    jacobian: Jacobian,
    /// The derivatives of `ln es` with respect to `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and
    /// `nu0`.
    scale: [f64; 4],
    /// The material asked for.
    material: Material,
}

impl Sensitivities {
    /// Takes the derivatives on the pieces, whether each is known, the material asked for, and the
    /// derivatives of its equivalent with respect to it.
    pub(crate) fn new(
        by_table: [Piecewise<SPLINE_TERMS>; 3],
        known: [bool; 3],
        material: Material,
        jacobian: Jacobian,
    ) -> Self {
        let film = match material.normalisation() {
            Normalisation::Sphere => material.sphere_film_modulus() / material.film_modulus(),
            Normalisation::Film => 0.0,
        };
        let scale = [
            film,
            film * 2.0 * material.nu1() / one_minus_square(material.nu1()),
            0.0,
            0.0,
        ];
        Self {
            by_table,
            known,
            jacobian,
            scale,
            material,
        }
    }

    /// Returns the material asked for.
    pub const fn material(&self) -> &Material {
        &self.material
    }

    /// Returns the derivatives, with respect to a parameter of the material asked for by number, of
    /// the logarithms of `Pi0`, `Eeq` and `Gamma` over `es`, and of the last one also the derivative
    /// with respect to the position on its piece; `None` if the table fixes what they need.
    pub(crate) fn over_es(&self, position: Position, parameter: usize) -> Option<[f64; 4]> {
        let mut sums = [0.0; 4];
        for (i, by_table) in self.by_table.iter().enumerate() {
            let factor = self.jacobian[i][parameter];
            if factor == 0.0 {
                continue;
            }
            if !self.known[i] {
                return None;
            }
            let [pi0, eeq, gamma, _] = by_table.values_at(position);
            let slope = by_table.derivatives_at(position)[Quantity::Gamma as usize];
            for (sum, by) in sums.iter_mut().zip([pi0, eeq, gamma, slope]) {
                *sum += factor * by;
            }
        }
        Some(sums)
    }

    /// Returns the derivatives of the logarithms.
    pub(crate) const fn by_table(&self) -> &[Piecewise<SPLINE_TERMS>; 3] {
        &self.by_table
    }

    /// Returns the derivatives of a curve of the material under another shape.
    pub(crate) fn of_shape(&self, by_table: [Piecewise<SPLINE_TERMS>; 3]) -> Self {
        Self {
            by_table,
            ..self.clone()
        }
    }

    /// Returns the gradient at a position, whose quantities and slopes are given.
    pub(crate) fn gradient(
        &self,
        position: Position,
        values: Quantities,
        slopes: Quantities,
    ) -> QuantityGradient {
        // Those of `es`, which is no factor of `Delta0`.
        let mut relative = self.scale.map(|scale| [scale, scale, scale, 0.0]);
        for (by_table, factors) in self.by_table.iter().zip(&self.jacobian) {
            let by_table = by_table.values_at(position);
            for (relative, factor) in relative.iter_mut().zip(factors) {
                for (sum, derivative) in relative.iter_mut().zip(by_table) {
                    *sum += factor * derivative;
                }
            }
        }
        let unknown =
            |parameter: usize| (0..3).any(|i| !self.known[i] && self.jacobian[i][parameter] != 0.0);
        QuantityGradient {
            values,
            slopes,
            relative,
            known: std::array::from_fn(|parameter| !unknown(parameter)),
            scale: self.scale,
            material: self.material,
        }
    }
}

/// The four quantities at one `a/t`, with their derivatives.
#[derive(Clone, Copy, Debug)]
pub struct QuantityGradient {
    values: Quantities,
    slopes: Quantities,
    /// The derivatives of the logarithms of the quantities with respect to `ln e1_over_e2`, `nu1`,
    /// `ln e0_over_e2` and `nu0`.
    relative: [[f64; 4]; 4],
    /// Whether each of them is known.
    known: [bool; 4],
    /// The derivatives of `ln es` with respect to these parameters.
    scale: [f64; 4],
    /// The material asked for.
    material: Material,
}

impl QuantityGradient {
    /// Returns the gradient of the expansion for thick films at an `a/t` that is `ratio` times as
    /// large, where the quantities and their slopes are `values` and `slopes`.
    ///
    /// There the departures of `Pi0`, `Delta0`, `1/Eeq` and `1/Gamma` from their limits are `ratio`
    /// times as large. Under another shape than a paraboloid, `delta0` is by what factors the
    /// departure of `Delta0`, and its limit, are as large.
    pub(crate) fn continued_to_thicker_films(
        self,
        ratio: f64,
        values: Quantities,
        slopes: Quantities,
        delta0: Option<[f64; 2]>,
    ) -> Self {
        let change = |quantity: Quantity| values.get(quantity) / self.values.get(quantity);
        let shares = Quantity::ALL.map(|quantity| match (quantity, delta0) {
            (Quantity::Delta0, Some([share, half_space])) => share / change(quantity) * half_space,
            (Quantity::Pi0 | Quantity::Delta0, _) => ratio / change(quantity),
            _ => ratio * change(quantity),
        });
        let mut relative = self.relative;
        for (relative, scale) in relative.iter_mut().zip(self.scale) {
            for quantity in Quantity::ALL {
                let of_limit = if quantity == Quantity::Delta0 {
                    0.0
                } else {
                    scale
                };
                let own = &mut relative[quantity as usize];
                *own = of_limit + shares[quantity as usize] * (*own - of_limit);
            }
        }
        Self {
            values,
            slopes,
            relative,
            ..self
        }
    }

    /// Returns the quantities.
    #[inline]
    pub const fn values(&self) -> Quantities {
        self.values
    }

    /// Returns the logarithmic slopes of the quantities, `x dQ/dx` with `x = a/t`.
    #[inline]
    pub const fn slopes(&self) -> Quantities {
        self.slopes
    }

    /// Returns the derivatives with respect to `e1_over_e2`, `nu1` or `e0_over_e2` of the material
    /// asked for, with all other parameters fixed.
    ///
    /// They are 0 with respect to an infinite `e0_over_e2`. The derivatives with respect to
    /// `a_over_t` are the [slopes](QuantityGradient::slopes) divided by `a_over_t`.
    ///
    /// # Errors
    /// [`Error::FixedParameter`] if the scene of the table fixes a parameter that they need; for a
    /// parameter that is none of these three; and for an `e1_over_e2` of 0, where the normalisation
    /// changes.
    pub fn by(&self, parameter: Parameter) -> Result<Quantities, Error> {
        let unknown = Error::FixedParameter(parameter.name());
        let (index, modulus) = match parameter {
            Parameter::AOverT
            | Parameter::E1sOverEinfs
            | Parameter::E0sOverE2s
            | Parameter::E0OverE1 => {
                return Err(unknown);
            }
            Parameter::E1OverE2 if self.material.e1_over_e2() == 0.0 => return Err(unknown),
            Parameter::E1OverE2 => (0, self.material.e1_over_e2()),
            Parameter::Nu1 => (1, 1.0),
            Parameter::E0OverE2 => (2, self.material.e0_over_e2()),
        };
        let relative = self.relative(index).ok_or(unknown)?;
        Ok(self.absolute(relative.map(|derivative| derivative / modulus)))
    }

    /// Returns the derivatives with respect to the Poisson ratio of the substrate, by the
    /// [equivalent](Material::with_substrate_poisson_ratio) of the material.
    ///
    /// # Errors
    /// [`Error::FixedParameter`] if the scene of the table fixes a parameter that they need.
    pub fn by_nu0(&self) -> Result<Quantities, Error> {
        Ok(self.absolute(self.relative(3).ok_or(Error::FixedParameter("nu0"))?))
    }

    /// Returns the derivatives of the logarithms of the quantities, if they are known, with respect
    /// to a parameter by number: `ln e1_over_e2`, `nu1`, `ln e0_over_e2`, `nu0`.
    #[inline]
    pub fn relative(&self, parameter: usize) -> Option<[f64; 4]> {
        self.known[parameter].then_some(self.relative[parameter])
    }

    /// Returns the derivative of `ln es` with respect to a parameter, numbered as in
    /// [`Self::relative`].
    #[inline]
    pub const fn scale(&self, parameter: usize) -> f64 {
        self.scale[parameter]
    }

    /// Returns the material with respect to whose parameters these derivatives are.
    #[inline]
    pub const fn material(&self) -> &Material {
        &self.material
    }

    /// Turns derivatives of logarithms into derivatives.
    fn absolute(&self, relative: [f64; 4]) -> Quantities {
        let values = self.values.to_array();
        Quantities::from_array(std::array::from_fn(|quantity| {
            values[quantity] * relative[quantity]
        }))
    }
}
