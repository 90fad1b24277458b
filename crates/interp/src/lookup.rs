//! Interpolation along the material axes: from a table's spline coefficients to the curve of one material.

use std::array;

use crate::low_rank::{LowRank, add_row, add_rows, combine};
use crate::material::Equivalence;
use crate::pieces::Resampler;
use crate::schema::Parameter;
use crate::sensitivity::Sensitivities;
use crate::spline::{Basis, Weights};
use crate::table::Table;
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
    /// What the pieces of a curve may add to its error, in parts of the table's tolerance, and at least.
    const SHARE: f64 = 0.1;
    const FINEST: f64 = 1e-11;

    pub(crate) fn new(table: &Table, coefficients: Coefficients) -> Self {
        let held = table.quantities();
        let range = ends(table, Parameter::AOverT);
        // The curves at the corners of the box, and in the middles between them.
        let [e1, nu1, e0] = MATERIAL.map(|parameter| {
            let [from, to] = ends(table, parameter).map(|value| parameter.coordinate(value));
            if from == to { vec![from] } else { vec![from, from.midpoint(to), to] }
        });
        let materials = e1.iter().flat_map(|&e1| nu1.iter().map(move |&nu1| [e1, nu1]));
        let materials = materials.flat_map(|[e1, nu1]| e0.iter().map(move |&e0| [e1, nu1, e0]));
        let curves: Vec<Vec<f64>> = materials.map(|place| coefficients.at(&coefficients.weights(place))).collect();
        let error = (Self::SHARE * table.description().tolerance).max(Self::FINEST);
        let resampler = Resampler::fitting(&coefficients.along, range, &held, &curves, error);
        Self { coefficients, resampler, range, held }
    }

    pub(crate) fn curve(&self, table: &Table, material: &Material) -> Result<Curve, Error> {
        let (equivalent, place) = in_the_table(table, material, || {
            let equivalent = material.with_substrate_poisson_ratio(table.description().nu0)?;
            Ok((equivalent, place(table, &equivalent)?))
        })?;
        let coefficients = self.coefficients.at(&self.coefficients.weights(place));
        self.of_splines(table, &coefficients, equivalent)
    }

    pub(crate) fn curve_with_gradient(&self, table: &Table, material: &Material) -> Result<Curve, Error> {
        let (equivalence, place) = in_the_table(table, material, || {
            let equivalence = Equivalence::new(material, table.description().nu0)?;
            Ok((equivalence, place(table, &equivalence.equivalent)?))
        })?;
        let mut weights = self.coefficients.weights(place);
        let nu1 = &mut weights[1];
        // Where the derivative with respect to `c` falls like `s^2`, that of `c` with respect to `nu1` grows like `1/s^2`: their product at this `s` is that at 0,
        // but for rounding.
        let before_the_end = place[1].min(Parameter::Nu1.coordinate(0.5) - 5e-7);
        let near = self.coefficients.functions[1].basis.weights(before_the_end);
        if near.first == nu1.first {
            nu1.slopes = near.slopes;
        } else {
            *nu1 = near;
        }
        let speed = Parameter::Nu1.speed(before_the_end);
        nu1.slopes.iter_mut().for_each(|slope| *slope *= speed);
        let [values, slopes @ ..] = self.coefficients.with_slopes(&weights);
        let known = MATERIAL.map(|parameter| {
            let [from, to] = ends(table, parameter);
            from < to || from == 0.0 && parameter == Parameter::E1OverE2 || from == f64::INFINITY
        });
        let pieces = slopes.map(|slopes| self.resampler.derivatives(&slopes, &self.held));
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

/// The tensor B-spline of a table along its material axes.
///
/// What is splined is `ln(Pi0/es)`, `ln(Eeq/es)`, `ln(Gamma/es)` and `ln Delta0` over `ln(E1/E2)`, `c(nu1)` and `ln(E0/E2)`.
#[derive(Clone, Debug)]
pub(crate) struct Coefficients {
    /// Of `e1_over_e2`, `nu1` and `e0_over_e2`.
    functions: [Functions; 3],
    /// One row for each combination of these functions, `e1_over_e2` slowest: the logarithms of the quantities held for each `a_over_t`, or for
    /// each function of a low-rank table. Zeros at the end of a row are left out.
    rows: Vec<f64>,
    /// Where each row begins, and where the last one ends.
    starts: Vec<usize>,
    /// The length of a whole row.
    width: usize,
    /// The functions of `a_over_t` at its nodes in a low-rank table, a row for each node.
    a_over_t: Option<Vec<f64>>,
    /// The splines along `a_over_t`.
    along: Basis,
    held: usize,
}

impl Coefficients {
    pub(crate) fn new(table: &Table) -> Self {
        if let Some(form) = table.low_rank() {
            return Self::low_rank(form, bases(table), along(table));
        }
        let [_, n_e1, ..] = table.shape();
        let mut logarithms = Vec::with_capacity(table.shape().iter().product::<usize>() * table.quantities().len());
        (0..n_e1).for_each(|e1| logarithms.extend(table.logarithms(e1)));
        Self::splined(table, logarithms)
    }

    /// From the logarithms at the nodes of a table, material-major, so that a curve sums whole rows. They become the coefficients in place.
    pub(crate) fn splined(table: &Table, mut rows: Vec<f64>) -> Self {
        let bases = bases(table);
        let [n_a, n_e1, n_nu, n_e0] = table.shape();
        let width = table.quantities().len() * n_a;
        bases[0].interpolate(&mut rows, n_nu * n_e0 * width);
        for slab in rows.chunks_exact_mut(n_nu * n_e0 * width) {
            bases[1].interpolate(slab, n_e0 * width);
            slab.chunks_exact_mut(n_e0 * width).for_each(|slab| bases[2].interpolate(slab, width));
        }
        let starts = (0..=n_e1 * n_nu * n_e0).map(|row| row * width).collect();
        let functions = bases.map(|basis| Functions { count: basis.len(), basis, factor: None });
        Self { functions, rows, starts, width, a_over_t: None, along: along(table), held: table.quantities().len() }
    }

    /// The logarithms of splines at all nodes with one `e1_over_e2`, see [`Table::logarithms`].
    pub(crate) fn at_nodes(&self, table: &Table, e1: usize) -> Vec<f64> {
        let place = |parameter: Parameter, node: usize| parameter.coordinate(table.axis(parameter)[node]);
        let [_, _, n_nu, n_e0] = table.shape();
        let materials = (0..n_nu).flat_map(|nu| (0..n_e0).map(move |e0| (nu, e0)));
        let rows = materials.map(|(nu, e0)| {
            let place = [place(Parameter::E1OverE2, e1), place(Parameter::Nu1, nu), place(Parameter::E0OverE2, e0)];
            self.contract(&self.weights(place))
        });
        rows.flatten().collect()
    }

    fn low_rank(form: &LowRank, bases: [Basis; 3], along: Basis) -> Self {
        let width = form.ranks[0] * form.quantities.len();
        let (mut rows, mut starts) = (Vec::with_capacity(form.core.len()), vec![0]);
        for row in form.core.chunks_exact(width) {
            let used = row.iter().rposition(|&entry| entry != 0.0).map_or(0, |last| last + 1);
            rows.extend(&row[..used]);
            starts.push(rows.len());
        }
        let mut axis = 0;
        let functions = bases.map(|basis| {
            axis += 1;
            let (mut factor, count) = (form.factors[axis].clone(), form.ranks[axis]);
            basis.interpolate(&mut factor, count);
            Functions { basis, count, factor: Some(factor) }
        });
        let a_over_t = form.factors[0].iter().map(|value| form.step * value).collect();
        Self { functions, rows, starts, width, a_over_t: Some(a_over_t), along, held: form.quantities.len() }
    }

    /// The splines of the material axes at a place.
    pub(crate) fn weights(&self, place: [f64; 3]) -> [Weights; 3] {
        array::from_fn(|axis| self.functions[axis].basis.weights(place[axis]))
    }

    /// The coefficients of the splines over `ln(a/t)` of one material: of the quantities held, one spline after the other.
    pub(crate) fn at(&self, weights: &[Weights; 3]) -> Vec<f64> {
        let sum = self.contract(weights);
        let mut logarithms = match &self.a_over_t {
            None => sum,
            Some(functions) => {
                let mut logarithms = vec![0.0; self.held * self.along.len()];
                let groups = logarithms.chunks_exact_mut(self.held);
                for (group, weights) in groups.zip(functions.chunks_exact(functions.len() / self.along.len())) {
                    add_rows(group, 1.0, weights, &sum);
                }
                logarithms
            }
        };
        self.along.interpolate(&mut logarithms, self.held);
        logarithms
    }

    /// The same, followed by their derivatives with respect to the three coordinates.
    pub(crate) fn with_slopes(&self, weights: &[Weights; 3]) -> [Vec<f64>; 4] {
        let by = |axis: usize| {
            let mut weights = *weights;
            weights[axis].values = weights[axis].slopes;
            self.at(&weights)
        };
        [self.at(weights), by(0), by(1), by(2)]
    }

    /// Sums the rows around one material.
    fn contract(&self, weights: &[Weights; 3]) -> Vec<f64> {
        let [(first_e1, e1), (first_nu, nu), (first_e0, e0)] = array::from_fn(|axis| self.functions[axis].at(&weights[axis]));
        let [_, n_nu, n_e0] = self.functions.each_ref().map(|functions| functions.count);
        let mut sum = vec![0.0; self.width];
        for (i, e1) in e1.iter().enumerate() {
            for (j, nu) in nu.iter().enumerate() {
                let row = ((first_e1 + i) * n_nu + first_nu + j) * n_e0 + first_e0;
                for (e0, ends) in e0.iter().zip(self.starts[row..].windows(2)) {
                    add_row(&mut sum, e1 * nu * e0, &self.rows[ends[0]..ends[1]]);
                }
            }
        }
        sum
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

/// The functions of one material parameter whose coefficients the rows are: its B-splines, or those combinations of them that a low-rank
/// table has.
#[derive(Clone, Debug)]
struct Functions {
    basis: Basis,
    count: usize,
    /// A row of `count` coefficients for each B-spline.
    factor: Option<Vec<f64>>,
}

impl Functions {
    /// The values at a coordinate, from the first function on that need not vanish.
    fn at(&self, weights: &Weights) -> (usize, Vec<f64>) {
        let values = &weights.values[..weights.count];
        match &self.factor {
            None => (weights.first, values.to_vec()),
            Some(factor) => (0, combine(values, &factor[weights.first * self.count..][..weights.count * self.count])),
        }
    }
}

/// `es` at a node of `e1_over_e2` and one of `nu1`.
pub(crate) fn film_limit(table: &Table, e1: usize, nu: usize) -> f64 {
    let (e1, nu1) = (table.axis(Parameter::E1OverE2)[e1], table.axis(Parameter::Nu1)[nu]);
    let e0 = table.axis(Parameter::E0OverE2)[0];
    let material = Material::new(e1, nu1, e0, table.description().nu0).expect("a table's axes are checked when it is made");
    material.sphere_film_modulus()
}
