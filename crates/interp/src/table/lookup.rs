//! The lookup of the curve of one material: the preparation, once for a table, and the sums for
//! each material.

use crate::curve::resampler::Resampler;
use crate::curve::sensitivity::Sensitivities;
use crate::material::equivalence::Equivalence;
use crate::table::axes::{Axes, MATERIAL};
use crate::table::tensor_spline::TensorSpline;
use crate::{Curve, Description, Error, Material, Parameter, Quantity};

/// The number of parts into which the materials with which the pieces are tested divide each axis.
/// Two parts gave an error of 0.28 tolerances for other materials of the embedded table.
pub(crate) const PARTS: usize = 4;

/// A table prepared for lookup.
#[derive(Clone, Debug)]
pub(crate) struct Lookup {
    spline: TensorSpline,
    resampler: Resampler,
    range: [f64; 2],
    quantities: Vec<Quantity>,
}

impl Lookup {
    /// The largest error that the pieces may add to the curves of the materials for which they are
    /// made, relative to the table's tolerance. Curves of other materials may have a slightly
    /// larger error; with the embedded table it is 0.06 tolerances (`tests/table/lookup.rs`).
    const SHARE: f64 = 0.1;
    /// The smallest error of the pieces that is asked for, whatever the table's tolerance.
    const LEAST_ERROR: f64 = 1e-11;
    /// Prepares the lookup in `spline`, which holds `quantities` to a relative `tolerance`.
    pub(crate) fn new(
        axes: &Axes,
        quantities: Vec<Quantity>,
        tolerance: f64,
        spline: TensorSpline,
    ) -> Self {
        let range = axes.ends(Parameter::AOverT);
        let [e1, nu1, e0] = MATERIAL.map(|parameter| {
            let [from, to] = axes
                .ends(parameter)
                .map(|value| parameter.coordinate(value));
            let node = |i: usize| from + (to - from) * i as f64 / PARTS as f64;
            if from == to {
                vec![from]
            } else {
                (0..=PARTS).map(node).collect()
            }
        });
        let materials = e1
            .iter()
            .flat_map(|&e1| nu1.iter().map(move |&nu1| [e1, nu1]));
        let materials: Vec<_> = materials
            .flat_map(|[e1, nu1]| e0.iter().map(move |&e0| [e1, nu1, e0]))
            .collect();
        let curve = |i: usize| spline.coefficients(materials[i]);
        let error = (Self::SHARE * tolerance).max(Self::LEAST_ERROR);
        let resampler = Resampler::fitting(
            &spline.a_over_t_basis,
            range,
            &quantities,
            materials.len(),
            curve,
            error,
        );
        Self {
            spline,
            resampler,
            range,
            quantities,
        }
    }

    /// Makes the curve of `material`.
    pub(crate) fn curve(
        &self,
        axes: &Axes,
        description: &Description,
        material: &Material,
    ) -> Result<Curve, Error> {
        let (equivalent, coordinates) = find_equivalent(description, material, || {
            let equivalent = material.with_substrate_poisson_ratio(description.nu0)?;
            Ok((equivalent, axes.locate(&equivalent)?))
        })?;
        let coefficients = self.spline.coefficients(coordinates);
        self.of_splines(description, &coefficients, equivalent)
    }

    /// Makes the curve of `material` with its derivatives with respect to it.
    pub(crate) fn curve_with_gradient(
        &self,
        axes: &Axes,
        description: &Description,
        material: &Material,
    ) -> Result<Curve, Error> {
        let (equivalence, coordinates) = find_equivalent(description, material, || {
            let equivalence = Equivalence::new(material, description.nu0)?;
            Ok((equivalence, axes.locate(&equivalence.equivalent)?))
        })?;
        // Towards `s = 1 - 2c` of 0 the derivative with respect to `c` falls like `s^2`, and that
        // of `c` with respect to `nu1` grows like `1/s^2`. Their product is evaluated at a small
        // `s`, where it equals that at 0 except for rounding.
        let [e1, nu1, e0] = coordinates;
        let before_the_end = nu1.min(Parameter::Nu1.coordinate(0.5) - 5e-7);
        let [values, by_e1, mut by_nu1, by_e0] = self
            .spline
            .coefficients_and_slopes(coordinates, [e1, before_the_end, e0]);
        let speed = Parameter::Nu1.speed(before_the_end);
        by_nu1.iter_mut().for_each(|slope| *slope *= speed);
        let known = MATERIAL.map(|parameter| {
            let [from, to] = axes.ends(parameter);
            from < to || from == 0.0 && parameter == Parameter::E1OverE2 || from == f64::INFINITY
        });
        let pieces = [by_e1, by_nu1, by_e0]
            .map(|slopes| self.resampler.derivatives(&slopes, &self.quantities));
        let sensitivities = Sensitivities::new(pieces, known, *material, equivalence.jacobian);
        Ok(self
            .of_splines(description, &values, equivalence.equivalent)?
            .with_sensitivities(sensitivities))
    }

    /// Makes the curve of the equivalent material from the coefficients over `ln(a/t)`.
    fn of_splines(
        &self,
        description: &Description,
        coefficients: &[f64],
        equivalent: Material,
    ) -> Result<Curve, Error> {
        let curve = Curve::of_splines(
            &self.resampler,
            self.range,
            coefficients,
            &self.quantities,
            equivalent,
        );
        if let Some((quantity, value)) = curve.unreasonable() {
            return Err(Error::Malformed(format!(
                "{} reaches {value:?} between the nodes, outside [1e-30, 1e30]",
                quantity.name()
            )));
        }
        Ok(curve.with_expansions(description.certificate.max_error, description.tolerance))
    }
}

/// Returns the result of `find`, which looks for the equivalent of `material` in the table.
///
/// # Errors
/// [`Error::Normalisation`]; the error of `find`, in [`Error::Equivalent`] if the table is made for
/// another Poisson ratio of the substrate than the material's.
fn find_equivalent<T>(
    description: &Description,
    material: &Material,
    find: impl Fn() -> Result<T, Error>,
) -> Result<T, Error> {
    let (table_unit, unit) = (description.normalisation, material.normalisation());
    if table_unit != unit {
        return Err(Error::Normalisation {
            table: table_unit.symbol(),
            query: unit.symbol(),
        });
    }
    let (nu1, nu0, table_nu0) = (material.nu1(), material.nu0(), description.nu0);
    find().map_err(|error| match error {
        error if nu0 == table_nu0 => error,
        error => Error::Equivalent {
            nu1,
            nu0,
            table_nu0,
            cause: Box::new(error),
        },
    })
}
