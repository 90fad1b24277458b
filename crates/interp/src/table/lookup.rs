//! From a material to its curve: all that a table prepares once, and what it does for each
//! material.

use crate::curve::piecewise::Resampler;
use crate::curve::sensitivity::Sensitivities;
use crate::material::equivalence::Equivalence;
use crate::table::axes::{Axes, MATERIAL};
use crate::table::tensor_spline::TensorSpline;
use crate::{Curve, Description, Error, Material, Parameter, Quantity};

/// All that a table prepares for its curves.
#[derive(Clone, Debug)]
pub(crate) struct Lookup {
    spline: TensorSpline,
    resampler: Resampler,
    range: [f64; 2],
    quantities: Vec<Quantity>,
}

impl Lookup {
    /// What the pieces of a curve may add to its error, in parts of the table's tolerance, and at
    /// least, for the materials that they are made for. Others may have a little more: those of the
    /// embedded table have 0.06 (`tests/lookup.rs`).
    const SHARE: f64 = 0.1;
    const FINEST: f64 = 1e-11;
    /// Into how many parts these materials divide each axis. With two, others of the embedded table
    /// had 0.28 tolerances.
    const PARTS: usize = 4;

    /// Prepares the lookup in a spline of these quantities, which is to keep `tolerance`.
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
            let place = |i: usize| from + (to - from) * i as f64 / Self::PARTS as f64;
            if from == to {
                vec![from]
            } else {
                (0..=Self::PARTS).map(place).collect()
            }
        });
        let materials = e1
            .iter()
            .flat_map(|&e1| nu1.iter().map(move |&nu1| [e1, nu1]));
        let materials: Vec<_> = materials
            .flat_map(|[e1, nu1]| e0.iter().map(move |&e0| [e1, nu1, e0]))
            .collect();
        let curve = |i: usize| spline.at(materials[i]);
        let error = (Self::SHARE * tolerance).max(Self::FINEST);
        let resampler = Resampler::fitting(
            &spline.along,
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

    pub(crate) fn curve(
        &self,
        axes: &Axes,
        description: &Description,
        material: &Material,
    ) -> Result<Curve, Error> {
        let (equivalent, place) = in_the_table(description, material, || {
            let equivalent = material.with_substrate_poisson_ratio(description.nu0)?;
            Ok((equivalent, axes.locate(&equivalent)?))
        })?;
        let coefficients = self.spline.at(place);
        self.of_splines(description, &coefficients, equivalent)
    }

    pub(crate) fn curve_with_gradient(
        &self,
        axes: &Axes,
        description: &Description,
        material: &Material,
    ) -> Result<Curve, Error> {
        let (equivalence, place) = in_the_table(description, material, || {
            let equivalence = Equivalence::new(material, description.nu0)?;
            Ok((equivalence, axes.locate(&equivalence.equivalent)?))
        })?;
        // Where the derivative with respect to `c` falls like `s^2`, that of `c` with respect to
        // `nu1` grows like `1/s^2`: their product at this `s` is that at 0, but for rounding.
        let [e1, nu1, e0] = place;
        let before_the_end = nu1.min(Parameter::Nu1.coordinate(0.5) - 5e-7);
        let [values, by_e1, mut by_nu1, by_e0] =
            self.spline.with_slopes(place, [e1, before_the_end, e0]);
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
                "{} reaches {value:?} between the nodes",
                quantity.name()
            )));
        }
        Ok(curve.with_expansions(description.certificate.max_error, description.tolerance))
    }
}

/// What is found for a material in a table made for another substrate's Poisson ratio or the same,
/// with an error that says so.
fn in_the_table<T>(
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
            source: Box::new(error),
        },
    })
}
