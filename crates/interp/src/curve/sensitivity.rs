//! The derivatives of the quantities with respect to the parameters of the material.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};
use piecewise::{FUNCTION_TERMS, Piecewise, SPLINE_TERMS};

use crate::material::one_minus_square;
use crate::{Error, Material, MaterialParameter, Normalisation, Quantities, Quantity};

/// The derivatives of a curve with respect to the parameters of its material, on every piece.
#[derive(Clone, Debug)]
pub(crate) struct Sensitivities {
    /// The derivatives of the logarithms with respect to parameters of the table: its `nu1` and the
    /// logarithms of its ratios of moduli, as far as they are needed.
    by_table: Vec<Piecewise<SPLINE_TERMS>>,
    /// The derivatives of each of these parameters with respect to those of the material asked for,
    /// which may be on another substrate.
    factors: Vec<[f64; 4]>,
    /// Whether each derivative with respect to the material asked for is known.
    known: [bool; 4],
    /// The derivatives of `ln es` with respect to `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and
    /// `nu0`.
    scale: [f64; 4],
    /// The material asked for.
    material: Material,
}

impl Sensitivities {
    /// Takes the derivatives on the pieces with respect to parameters of the table, those of these parameters with
    /// respect to the material asked for, and which of the latter are then known.
    pub(crate) fn new(
        by_table: Vec<Piecewise<SPLINE_TERMS>>,
        factors: Vec<[f64; 4]>,
        known: [bool; 4],
        material: Material,
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
            factors,
            known,
            scale,
            material,
        }
    }

    /// Returns the material asked for.
    pub const fn material(&self) -> &Material {
        &self.material
    }

    /// Returns the derivatives, with respect to a parameter of the material asked for as in
    /// `QuantityGradient::relative`, of the logarithms of `Pi0`, `Eeq` and `Gamma` over `es` at `x`, and of the last
    /// one also the logarithmic slope; `None` if they are not known.
    pub(crate) fn over_es(&self, x: f64, parameter: MaterialParameter) -> Option<[f64; 4]> {
        let parameter = parameter as usize;
        let mut sums = [0.0; 4];
        for (by_table, factors) in self.by_table.iter().zip(&self.factors) {
            if factors[parameter] != 0.0 {
                let [[pi0, eeq, gamma, _], [_, _, slope, _]] = by_table.values_and_slopes(x);
                for (sum, by) in sums.iter_mut().zip([pi0, eeq, gamma, slope]) {
                    *sum += factors[parameter] * by;
                }
            }
        }
        self.known[parameter].then_some(sums)
    }

    /// Returns the derivatives of the logarithms.
    pub(crate) fn by_table(&self) -> &[Piecewise<SPLINE_TERMS>] {
        &self.by_table
    }

    /// Returns the derivatives of a curve of the material under another shape.
    pub(crate) fn of_shape(&self, by_table: Vec<Piecewise<SPLINE_TERMS>>) -> Self {
        Self {
            by_table,
            ..self.clone()
        }
    }

    /// Returns the gradient of quantities that are `functions` of `x`.
    #[inline]
    pub(crate) fn gradient(
        &self,
        functions: &Piecewise<FUNCTION_TERMS>,
        x: f64,
    ) -> QuantityGradient {
        let grid = functions.grid();
        let (position, speed) = (grid.locate(x), grid.logarithmic_speed(x));
        dispatch!(Level::new(), simd => {
            let [values, derivatives] = functions.values_and_derivatives(simd, position);
            let mut relative = [f64x4::splat(simd, 0.0); 4];
            for (sum, &scale) in relative.iter_mut().zip(&self.scale) {
                // Those of `es`, which is no factor of `Delta0`.
                *sum = f64x4::simd_from(simd, [scale, scale, scale, 0.0]);
            }
            for (by_table, factors) in self.by_table.iter().zip(&self.factors) {
                let by_table = by_table.values_side_by_side(simd, position);
                for (sum, &factor) in relative.iter_mut().zip(factors) {
                    *sum = by_table.mul_add(f64x4::splat(simd, factor), *sum);
                }
            }
            let mut rows = [[0.0; 4]; 4];
            for (row, sum) in rows.iter_mut().zip(relative) {
                sum.store_slice(row);
            }
            QuantityGradient {
                values: Quantities::from_array(*values.as_array()),
                slopes: Quantities::from_array(*(derivatives * speed).as_array()),
                relative: rows,
                known: self.known,
                scale: self.scale,
                material: self.material,
            }
        })
    }
}

/// The four quantities at one `a/t`, with their derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Returns the gradient of the expansion for thick films at an `a/t` that is `ratio` times as large, where the
    /// quantities and their slopes are `values` and `slopes`.
    ///
    /// There the departures of `Pi0`, `Delta0`, `1/Eeq` and `1/Gamma` from their limits are `ratio` times as large.
    /// Under another shape than a paraboloid, `delta0` is by what factors the departure of `Delta0`, and its limit, are
    /// as large.
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

    /// Returns the logarithmic slopes of the quantities, `x dQ/dx` with `x = a/t`; NaN on a curve of a single node.
    #[inline]
    pub const fn slopes(&self) -> Quantities {
        self.slopes
    }

    /// Returns the derivatives with respect to a parameter of the material asked for, with all other parameters fixed;
    /// with respect to `nu0` by the [equivalent](Material::with_substrate_poisson_ratio) of the material.
    ///
    /// They are 0 with respect to an infinite `e0_over_e2`. The derivatives with respect to `a_over_t` are the
    /// [slopes](QuantityGradient::slopes) divided by `a_over_t`. In the embedded table those with respect to `nu0` are
    /// wrong by up to 2e-5 of the quantity (2000 random contacts beside direct solves).
    ///
    /// # Errors
    /// [`Error::FixedParameter`] if the scene of the table fixes a parameter that they need, or the curve was made
    /// without them; and for an `e1_over_e2` of 0, where the normalisation changes.
    pub fn by(&self, parameter: MaterialParameter) -> Result<Quantities, Error> {
        let modulus = match parameter {
            MaterialParameter::E1OverE2 => self.material.e1_over_e2(),
            MaterialParameter::E0OverE2 => self.material.e0_over_e2(),
            MaterialParameter::Nu1 | MaterialParameter::Nu0 => 1.0,
        };
        let known = self.relative(parameter).filter(|_| modulus != 0.0);
        let relative = known.ok_or(Error::FixedParameter(parameter.name()))?;
        let values = self.values.to_array();
        let by = |quantity: usize| values[quantity] * (relative[quantity] / modulus);
        Ok(Quantities::from_array(std::array::from_fn(by)))
    }

    /// Returns the derivatives of the logarithms of the quantities, if they are known, with respect to
    /// `ln e1_over_e2`, `nu1`, `ln e0_over_e2` or `nu0`.
    #[inline]
    pub fn relative(&self, parameter: MaterialParameter) -> Option<[f64; 4]> {
        self.known[parameter as usize].then_some(self.relative[parameter as usize])
    }

    /// Returns the derivative of `ln es` with respect to a parameter as in [`Self::relative`].
    #[inline]
    pub const fn scale(&self, parameter: MaterialParameter) -> f64 {
        self.scale[parameter as usize]
    }
}
