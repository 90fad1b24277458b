//! The lookup of the curve of one material: the preparation, once for a table, and the sums for
//! each material.

use crate::Table;
use crate::curve::quantity_resampler::QuantityResampler;
use crate::curve::sensitivity::Sensitivities;
use crate::material::equivalence::{Equivalence, Invariants};
use crate::table::axes::Axes;
use crate::table::demand::PARTS;
use crate::table::incompressible::{improve_slopes, need_better_slopes};
use crate::table::tensor_spline::TensorSpline;
use crate::{
    Curve, Description, Error, Material, Parameter, Quantity, StackShape, SubstratePoissonRatio,
};

/// A table prepared for lookup.
#[derive(Clone, Debug)]
pub(crate) struct Lookup {
    spline: TensorSpline,
    resampler: QuantityResampler,
}

impl Lookup {
    /// The largest error that the pieces may add to the curves of the materials for which they are
    /// made, relative to the table's tolerance. Curves of other materials may have a slightly
    /// larger error; with the embedded table it is 0.06 tolerances (`tests/table/lookup.rs`).
    const SHARE: f64 = 0.1;
    /// The smallest error of the pieces that is asked for, whatever the table's tolerance.
    const LEAST_ERROR: f64 = 1e-11;

    /// Prepares the lookup in `spline`, which holds `quantities` to a relative `tolerance`, with the
    /// `pieces` of curves, if they are known.
    pub(crate) fn new(
        axes: &Axes,
        quantities: Vec<Quantity>,
        tolerance: f64,
        spline: TensorSpline,
        pieces: Option<&[u32]>,
    ) -> Self {
        let resampler = match pieces {
            Some(pieces) => {
                let range = axes.ends(Parameter::AOverT);
                let held: Vec<usize> = quantities.iter().map(|&held| held as usize).collect();
                QuantityResampler::new(&spline.a_over_t_basis, range, &held, pieces)
            }
            None => Self::fitting(axes, &quantities, tolerance, &spline),
        };
        Self { spline, resampler }
    }

    /// Returns the binary logarithm of the number of pieces in each octave of `a/t`.
    pub(crate) fn pieces_of_octaves(&self) -> &[u32] {
        self.resampler.splines.bits()
    }

    /// Chooses the pieces by the curves of materials all over the table.
    fn fitting(
        axes: &Axes,
        quantities: &[Quantity],
        tolerance: f64,
        spline: &TensorSpline,
    ) -> QuantityResampler {
        let range = axes.ends(Parameter::AOverT);
        let [e1, nu1, e0] = axes.of_material().map(|parameter| {
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
        QuantityResampler::fitting(
            &spline.a_over_t_basis,
            range,
            quantities,
            materials.len(),
            curve,
            error,
        )
    }

    /// Makes the curve of `material`.
    pub(crate) fn curve(
        &self,
        axes: &Axes,
        description: &Description,
        material: &Material,
    ) -> Result<Curve, Error> {
        let (equivalent, coordinates) = find_equivalent(description, material, |nu0| {
            let equivalent = nu0.equivalent(material)?;
            Ok((equivalent, axes.locate(&equivalent)?))
        })?;
        let coefficients = self.spline.coefficients(coordinates);
        let curve = Curve::of_splines(&self.resampler, &coefficients, equivalent);
        accept(curve, description)
    }

    /// Makes the curve of the table's stack of layers under a sphere.
    pub(crate) fn stack_curve(
        &self,
        axes: &Axes,
        description: &Description,
        e1_over_e2: f64,
        stack: StackShape,
    ) -> Result<Curve, Error> {
        let nu0 = description.nu0.under(axes.ends(Parameter::Nu1)[0]);
        let (material, coordinates) = axes.locate_sphere(e1_over_e2, nu0)?;
        let coefficients = self.spline.coefficients(coordinates);
        let curve = Curve::of_splines(&self.resampler, &coefficients, material);
        accept(curve.of_stack(stack), description)
    }

    /// Makes the curve of `material` with those of its derivatives with respect to
    /// `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and `nu0` that are `wanted`.
    pub(crate) fn curve_with_derivatives(
        &self,
        axes: &Axes,
        description: &Description,
        material: &Material,
        wanted: [bool; 4],
    ) -> Result<Curve, Error> {
        let (equivalence, coordinates) = find_equivalent(description, material, |nu0| {
            let equivalence = Equivalence::new(material, nu0)?;
            let coordinates = axes.locate(&equivalence.equivalent)?;
            Ok((equivalence, coordinates))
        })?;
        let equivalent = equivalence.equivalent;
        let parameters = axes.of_material();
        let jacobian = equivalence.jacobian(parameters);
        // Those that need no parameter that the table fixes to a finite value.
        let known = std::array::from_fn(|by| {
            let is_needed = |axis: &usize| jacobian[*axis][by] != 0.0;
            let mut needed = (0..3).filter(is_needed);
            wanted[by] && needed.all(|axis| !axes.fixes(parameters[axis]))
        });
        let invariants = Invariants::of(&equivalent);
        // From the derivatives with respect to the coordinates to those with respect to `nu1` and
        // to the logarithms of the moduli.
        let speeds = parameters.map(|parameter| match parameter {
            Parameter::Nu1 => parameter.speed(coordinates[1]),
            Parameter::E0sOverE2s => parameter.logarithmic_speed(invariants.e0s_over_e2s()),
            _ => parameter.logarithmic_speed(invariants.e1s_over_einfs()),
        });
        // Where a coordinate ends, nothing depends on the modulus.
        let factors: [[f64; 4]; 3] = std::array::from_fn(|axis| {
            let is_needed = |by: usize| known[by] && speeds[axis] != 0.0;
            std::array::from_fn(|by| {
                if is_needed(by) {
                    jacobian[axis][by]
                } else {
                    0.0
                }
            })
        });
        let needed = factors.map(|row| row != [0.0; 4]);
        let [values, mut slopes @ ..] = self.spline.coefficients_and_slopes(coordinates, needed);
        for (slopes, speed) in slopes.iter_mut().zip(speeds) {
            slopes.iter_mut().for_each(|slope| *slope *= speed);
        }
        if need_better_slopes(coordinates[1], factors[1]) {
            improve_slopes(
                &self.spline,
                coordinates,
                axes.nodes(Parameter::AOverT),
                axes.ends(Parameter::Nu1)[0],
                invariants.stiffer_substrate(),
                &mut slopes[1],
            );
        }
        let (slopes, factors): (Vec<&[f64]>, Vec<[f64; 4]>) = (0..3)
            .filter(|&axis| needed[axis])
            .map(|axis| (&slopes[axis][..], factors[axis]))
            .unzip();
        let es = equivalent.sphere_film_modulus();
        let (pieces, derivatives) = self.resampler.values_and_derivatives(&values, &slopes, es);
        let sensitivities = Sensitivities::new(derivatives, factors, known, *material);
        let curve = Curve::of_pieces(&self.resampler, pieces, equivalent);
        Ok(accept(curve, description)?.with_sensitivities(sensitivities))
    }
}

/// Adds the expansions beyond the nodes to a curve of the table, and accepts its values between
/// them.
fn accept(curve: Curve, description: &Description) -> Result<Curve, Error> {
    let ratio = curve.material().sphere_film_modulus();
    let allowed = "at least 1e-25: check the moduli of film and sphere, and their units";
    Error::unless(ratio >= Table::SOFTEST, "1/(1 + E2*/E1*)", ratio, allowed)?;
    let curve = curve.with_expansions(description.certificate.max_error, description.tolerance);
    if let Some((quantity, value)) = curve.unreasonable() {
        return Err(Error::Malformed(format!(
            "{} reaches {value:?} between the nodes, outside [1e-30, 1e30]",
            quantity.name()
        )));
    }
    Ok(curve)
}

/// The axes of reduced moduli.
const REDUCED_MODULI: [&str; 2] = [Parameter::E1sOverEinfs.name(), Parameter::E0sOverE2s.name()];

/// Returns the result of `find`, which looks for the equivalent of `material` in the table.
///
/// # Errors
/// [`Error::Normalisation`]; the error of `find`, in [`Error::Equivalent`] if the substrates of the
/// table have another Poisson ratio than the material's, and the error is about the equivalent's
/// own values.
fn find_equivalent<T>(
    description: &Description,
    material: &Material,
    find: impl FnOnce(SubstratePoissonRatio) -> Result<T, Error>,
) -> Result<T, Error> {
    let (nu1, nu0, table_nu0) = (material.nu1(), material.nu0(), description.nu0);
    find(table_nu0).map_err(|error| match error {
        error @ Error::Normalisation { .. } => error,
        error if table_nu0 == SubstratePoissonRatio::Fixed(nu0) => error,
        // An equivalent has the reduced moduli of the material.
        Error::OutsideTable { axis, .. } if REDUCED_MODULI.contains(&axis) => error,
        error => Error::Equivalent {
            nu1,
            nu0,
            table_nu0,
            cause: Box::new(error),
        },
    })
}
