//! Interpolation along the material axes: from a table's spline coefficients to the curve of one material.

use std::array;

use crate::material::Equivalence;
use crate::pieces::Resampler;
use crate::rows::add_rows;
use crate::schema::Parameter;
use crate::sensitivity::Sensitivities;
use crate::spline::{Basis, LARGEST_DEGREE, Weights};
use crate::table::Table;
use crate::train::Train;
use crate::{Curve, Error, Material, Quantity};

/// The parameters of a material.
const MATERIAL: [Parameter; 3] = [Parameter::E1OverE2, Parameter::Nu1, Parameter::E0OverE2];

/// All that a table prepares for its curves.
#[derive(Clone, Debug)]
pub(crate) struct Lookup {
    pub(crate) coefficients: Coefficients,
    resampler: Resampler,
    range: [f64; 2],
    held: Vec<Quantity>,
}

impl Lookup {
    /// What the pieces of a curve may add to its error, in parts of the table's tolerance, and at least, for the materials that they
    /// are made for. Others may have a little more: those of the embedded table
    /// have 0.06 (`tests/lookup.rs`).
    const SHARE: f64 = 0.1;
    const FINEST: f64 = 1e-11;
    /// Into how many parts these materials divide each axis. With two, others of the embedded table had 0.28 tolerances.
    const PARTS: usize = 4;

    pub(crate) fn new(table: &Table, coefficients: Coefficients) -> Self {
        let held = table.quantities();
        let range = ends(table, Parameter::AOverT);
        let [e1, nu1, e0] = MATERIAL.map(|parameter| {
            let [from, to] = ends(table, parameter).map(|value| parameter.coordinate(value));
            let place = |i: usize| from + (to - from) * i as f64 / Self::PARTS as f64;
            if from == to { vec![from] } else { (0..=Self::PARTS).map(place).collect() }
        });
        let materials = e1.iter().flat_map(|&e1| nu1.iter().map(move |&nu1| [e1, nu1]));
        let materials: Vec<_> = materials.flat_map(|[e1, nu1]| e0.iter().map(move |&e0| [e1, nu1, e0])).collect();
        let curve = |i: usize| coefficients.at(materials[i]);
        let error = (Self::SHARE * table.description().tolerance).max(Self::FINEST);
        let resampler = Resampler::fitting(&coefficients.along, range, &held, materials.len(), curve, error);
        Self { coefficients, resampler, range, held }
    }

    pub(crate) fn curve(&self, table: &Table, material: &Material) -> Result<Curve, Error> {
        let (equivalent, place) = in_the_table(table, material, || {
            let equivalent = material.with_substrate_poisson_ratio(table.description().nu0)?;
            Ok((equivalent, place(table, &equivalent)?))
        })?;
        let coefficients = self.coefficients.at(place);
        self.of_splines(table, &coefficients, equivalent)
    }

    pub(crate) fn curve_with_gradient(&self, table: &Table, material: &Material) -> Result<Curve, Error> {
        let (equivalence, place) = in_the_table(table, material, || {
            let equivalence = Equivalence::new(material, table.description().nu0)?;
            Ok((equivalence, place(table, &equivalence.equivalent)?))
        })?;
        // Where the derivative with respect to `c` falls like `s^2`, that of `c` with respect to `nu1` grows like `1/s^2`: their
        // product at this `s` is that at 0, but for rounding.
        let [e1, nu1, e0] = place;
        let before_the_end = nu1.min(Parameter::Nu1.coordinate(0.5) - 5e-7);
        let [values, by_e1, mut by_nu1, by_e0] = self.coefficients.with_slopes(place, [e1, before_the_end, e0]);
        let speed = Parameter::Nu1.speed(before_the_end);
        by_nu1.iter_mut().for_each(|slope| *slope *= speed);
        let known = MATERIAL.map(|parameter| {
            let [from, to] = ends(table, parameter);
            from < to || from == 0.0 && parameter == Parameter::E1OverE2 || from == f64::INFINITY
        });
        let pieces = [by_e1, by_nu1, by_e0].map(|slopes| self.resampler.derivatives(&slopes, &self.held));
        let sensitivities = Sensitivities::new(pieces, known, *material, equivalence.jacobian);
        Ok(self.of_splines(table, &values, equivalence.equivalent)?.with_sensitivities(sensitivities))
    }

    fn of_splines(&self, table: &Table, coefficients: &[f64], equivalent: Material) -> Result<Curve, Error> {
        let description = table.description();
        let curve = Curve::of_splines(&self.resampler, self.range, coefficients, &self.held, equivalent);
        if let Some((quantity, value)) = curve.unreasonable() {
            return Err(Error::Malformed(format!("{} reaches {value:?} between the nodes", quantity.name())));
        }
        Ok(curve.with_expansions(description.certificate.max_error, description.tolerance))
    }
}

/// The first and the last node of an axis.
fn ends(table: &Table, parameter: Parameter) -> [f64; 2] {
    let axis = table.axis(parameter);
    [axis[0], axis[axis.len() - 1]]
}

/// What is found for a material in a table made for another substrate's Poisson ratio or the same, with an error that says so.
fn in_the_table<T>(table: &Table, material: &Material, find: impl Fn() -> Result<T, Error>) -> Result<T, Error> {
    let (table_unit, unit) = (table.description().normalisation, material.normalisation());
    if table_unit != unit {
        return Err(Error::Normalisation { table: table_unit.symbol(), query: unit.symbol() });
    }
    let (nu1, nu0, table_nu0) = (material.nu1(), material.nu0(), table.description().nu0);
    find().map_err(|error| match error {
        error if nu0 == table_nu0 => error,
        error => Error::Equivalent { nu1, nu0, table_nu0, source: Box::new(error) },
    })
}

/// The coordinates of a material on the axes of a table.
fn place(table: &Table, material: &Material) -> Result<[f64; 3], Error> {
    let e1 = table.locate(Parameter::E1OverE2, material.e1_over_e2())?;
    let nu1 = table.locate(Parameter::Nu1, material.nu1())?;
    let e0 = table.locate(Parameter::E0OverE2, material.e0_over_e2())?;
    Ok([e1, nu1, e0])
}

/// The tensor B-spline of a table.
///
/// What is splined is `ln(Pi0/es)`, `ln(Eeq/es)`, `ln(Gamma/es)` and `ln Delta0` over `ln(a/t)`, `ln(E1/E2)`, `c(nu1)` and
/// `ln(E0/E2)`.
#[derive(Clone, Debug)]
pub(crate) struct Coefficients {
    /// Of `e1_over_e2`, `nu1` and `e0_over_e2`.
    pub(crate) bases: [Basis; 3],
    /// The splines along `a_over_t`.
    pub(crate) along: Basis,
    form: Form,
}

#[derive(Clone, Debug)]
enum Form {
    /// One row for each combination of the splines of the material axes, `e1_over_e2` slowest: a group of the quantities held for
    /// each spline of `a_over_t`.
    Dense(Vec<f64>),
    Train(Box<Train>),
}

impl Coefficients {
    pub(crate) fn new(table: &Table) -> Self {
        if let Some(form) = table.low_rank() {
            let (bases, along) = (bases(table), along(table));
            let train = Train::new(form, bases.each_ref(), &along, table.description().tolerance);
            let form = Form::Train(Box::new(train));
            return Self { bases, along, form };
        }
        let [_, n_e1, ..] = table.shape();
        let mut logarithms = Vec::with_capacity(table.shape().iter().product::<usize>() * table.quantities().len());
        (0..n_e1).for_each(|e1| logarithms.extend(table.logarithms(e1)));
        Self::splined(table, logarithms)
    }

    /// From the logarithms at the nodes of a table, material-major, so that a curve sums whole rows. They become the coefficients
    /// in place.
    pub(crate) fn splined(table: &Table, mut rows: Vec<f64>) -> Self {
        let (bases, along) = (bases(table), along(table));
        let [n_a, _, n_nu, n_e0] = table.shape();
        let held = table.quantities().len();
        let width = held * n_a;
        bases[0].interpolate(&mut rows, n_nu * n_e0 * width);
        for slab in rows.chunks_exact_mut(n_nu * n_e0 * width) {
            bases[1].interpolate(slab, n_e0 * width);
            slab.chunks_exact_mut(n_e0 * width).for_each(|slab| bases[2].interpolate(slab, width));
        }
        rows.chunks_exact_mut(width).for_each(|row| along.interpolate(row, held));
        Self { bases, along, form: Form::Dense(rows) }
    }

    /// The logarithms of splines at all nodes with one `e1_over_e2`, see [`Table::logarithms`].
    pub(crate) fn at_nodes(&self, table: &Table, e1: usize) -> Vec<f64> {
        let place = |parameter: Parameter, node: usize| parameter.coordinate(table.axis(parameter)[node]);
        let [n_a, _, n_nu, n_e0] = table.shape();
        let radii: Vec<Weights> = (0..n_a).map(|a| self.along.weights(place(Parameter::AOverT, a))).collect();
        let mut logarithms = Vec::with_capacity(n_nu * n_e0 * n_a * table.quantities().len());
        for (nu, e0) in (0..n_nu).flat_map(|nu| (0..n_e0).map(move |e0| (nu, e0))) {
            let place = [place(Parameter::E1OverE2, e1), place(Parameter::Nu1, nu), place(Parameter::E0OverE2, e0)];
            let coefficients = self.at(place);
            let held = coefficients.len() / n_a;
            for radius in &radii {
                let start = logarithms.len();
                logarithms.resize(start + held, 0.0);
                add_rows(&mut logarithms[start..], &radius.values[..radius.count], &coefficients[radius.first * held..], held);
            }
        }
        logarithms
    }

    /// The splines of the material axes at a place.
    fn weights(&self, place: [f64; 3]) -> [Weights; 3] {
        array::from_fn(|axis| self.bases[axis].weights(place[axis]))
    }

    /// The coefficients of the splines over `ln(a/t)` of one material: a group of the quantities held for each.
    pub(crate) fn at(&self, place: [f64; 3]) -> Vec<f64> {
        match &self.form {
            Form::Train(train) => train.at(place),
            Form::Dense(rows) => {
                let [sum] = self.sums(rows, &self.weights(place), [[false; 3]]);
                sum
            }
        }
    }

    /// The same, followed by their derivatives with respect to the three coordinates, each of them where it says, which is at the
    /// place or so near that it makes no difference to the values.
    fn with_slopes(&self, place: [f64; 3], slopes_at: [f64; 3]) -> [Vec<f64>; 4] {
        match &self.form {
            Form::Train(train) => train.with_slopes(place, slopes_at),
            Form::Dense(rows) => {
                let mut weights = self.weights(place);
                for (weights, near) in weights.iter_mut().zip(self.weights(slopes_at)) {
                    *weights = if near.first == weights.first { Weights { slopes: near.slopes, ..*weights } } else { near };
                }
                let by = |axis: usize| array::from_fn(|i| i == axis);
                self.sums(rows, &weights, [[false; 3], by(0), by(1), by(2)])
            }
        }
    }

    /// Weighted sums of the rows around one material, each with the slopes of some axes in place of the values. A row is read once
    /// for all.
    fn sums<const N: usize>(&self, rows: &[f64], weights: &[Weights; 3], slopes: [[bool; 3]; N]) -> [Vec<f64>; N] {
        let [n_e1, n_nu, n_e0] = self.bases.each_ref().map(Basis::len);
        let width = rows.len() / (n_e1 * n_nu * n_e0);
        let [e1, nu, e0] = weights;
        let mut sums = array::from_fn(|_| vec![0.0; width]);
        for (i, j) in (0..e1.count).flat_map(|i| (0..nu.count).map(move |j| (i, j))) {
            let rows = &rows[(((e1.first + i) * n_nu + nu.first + j) * n_e0 + e0.first) * width..];
            for (sum, slopes) in sums.iter_mut().zip(slopes) {
                let [of_e1, of_nu, of_e0] =
                    array::from_fn(|axis| if slopes[axis] { &weights[axis].slopes } else { &weights[axis].values });
                let row_weights: [f64; LARGEST_DEGREE + 1] = array::from_fn(|k| of_e1[i] * of_nu[j] * of_e0[k]);
                add_rows(sum, &row_weights[..e0.count], rows, width);
            }
        }
        sums
    }
}

/// The B-splines of `a_over_t`.
fn along(table: &Table) -> Basis {
    basis(table, Parameter::AOverT)
}

fn basis(table: &Table, parameter: Parameter) -> Basis {
    let nodes: Vec<f64> = table.axis(parameter).iter().map(|&value| parameter.coordinate(value)).collect();
    Basis::of_table(&nodes, parameter.is_flat_at(ends(table, parameter)[1]))
}

/// The B-splines of `e1_over_e2`, `nu1` and `e0_over_e2`.
fn bases(table: &Table) -> [Basis; 3] {
    MATERIAL.map(|parameter| basis(table, parameter))
}

/// `es` at a node of `e1_over_e2` and one of `nu1`.
pub(crate) fn film_limit(table: &Table, e1: usize, nu: usize) -> f64 {
    let (e1, nu1) = (table.axis(Parameter::E1OverE2)[e1], table.axis(Parameter::Nu1)[nu]);
    let e0 = table.axis(Parameter::E0OverE2)[0];
    let material = Material::new(e1, nu1, e0, table.description().nu0).expect("a table's axes are checked when it is made");
    material.sphere_film_modulus()
}
