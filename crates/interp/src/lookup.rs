//! Interpolation along the material axes: from a table's spline coefficients to the curve of one material.

use crate::low_rank::{LowRank, add_row, add_rows, combine};
use crate::schema::Parameter;
use crate::spline::{Basis, TABLE_DEGREE};
use crate::table::Table;
use crate::{Curve, Error, Material};

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
}

impl Coefficients {
    pub(crate) fn new(table: &Table) -> Self {
        if let Some(form) = table.low_rank() {
            return Self::low_rank(form, bases(table));
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
        Self { functions, rows, starts, width, a_over_t: None }
    }

    /// The logarithms of splines at all nodes with one `e1_over_e2`, see [`Table::logarithms`].
    pub(crate) fn at_nodes(&self, table: &Table, e1: usize) -> Vec<f64> {
        let place = |parameter: Parameter, node: usize| parameter.coordinate(table.axis(parameter)[node]);
        let [_, _, n_nu, n_e0] = table.shape();
        let materials = (0..n_nu).flat_map(|nu| (0..n_e0).map(move |e0| (nu, e0)));
        let rows = materials.map(|(nu, e0)| {
            self.contract([place(Parameter::E1OverE2, e1), place(Parameter::Nu1, nu), place(Parameter::E0OverE2, e0)])
        });
        rows.flatten().collect()
    }

    fn low_rank(form: &LowRank, bases: [Basis; 3]) -> Self {
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
        Self { functions, rows, starts, width, a_over_t: Some(a_over_t) }
    }

    pub(crate) fn curve(&self, table: &Table, material: &Material) -> Result<Curve, Error> {
        let (table_unit, unit) = (table.description().normalisation, material.normalisation());
        if table_unit != unit {
            return Err(Error::Normalisation { table: table_unit.symbol(), query: unit.symbol() });
        }
        let table_nu0 = table.description().nu0;
        let place = || {
            let material = material.with_substrate_poisson_ratio(table_nu0)?;
            let e1 = table.locate(Parameter::E1OverE2, material.e1_over_e2())?;
            let nu = table.locate(Parameter::Nu1, material.nu1())?;
            let e0 = table.locate(Parameter::E0OverE2, material.e0_over_e2())?;
            Ok((material, [e1, nu, e0]))
        };
        let (nu1, nu0) = (material.nu1(), material.nu0());
        let (material, place) = place().map_err(|error| match error {
            error if nu0 == table_nu0 => error,
            error => Error::Equivalent { nu1, nu0, table_nu0, source: Box::new(error) },
        })?;
        let (nodes, held) = (table.axis(Parameter::AOverT), table.quantities());
        let sum = self.contract(place);
        let logarithms = match &self.a_over_t {
            None => sum,
            Some(functions) => {
                let mut logarithms = vec![0.0; held.len() * nodes.len()];
                let groups = logarithms.chunks_exact_mut(held.len());
                for (group, weights) in groups.zip(functions.chunks_exact(functions.len() / nodes.len())) {
                    add_rows(group, 1.0, weights, &sum);
                }
                logarithms
            }
        };
        Curve::of_table(nodes, &logarithms, &held, table.description().tolerance, material)
    }

    /// Sums the rows around one material, given by its coordinates.
    fn contract(&self, material: [f64; 3]) -> Vec<f64> {
        let [(first_e1, e1), (first_nu, nu), (first_e0, e0)] = std::array::from_fn(|axis| self.functions[axis].at(material[axis]));
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

/// The B-splines of `e1_over_e2`, `nu1` and `e0_over_e2`.
fn bases(table: &Table) -> [Basis; 3] {
    [Parameter::E1OverE2, Parameter::Nu1, Parameter::E0OverE2].map(|parameter| {
        let nodes: Vec<f64> = table.axis(parameter).iter().map(|&value| parameter.coordinate(value)).collect();
        Basis::new(&nodes, TABLE_DEGREE)
    })
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
    fn at(&self, coordinate: f64) -> (usize, Vec<f64>) {
        let weights = self.basis.weights(coordinate);
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
