//! The JSON objects that `--json` prints. The names of their fields are fixed; the help of each
//! command lists them.

use interp::{Certificate, LowRank, Parameter, Quantity, Table};
use serde::{Serialize, Serializer};

use super::write_text;

/// Prints one object on one line.
pub fn print(object: &impl Serialize) -> anyhow::Result<()> {
    write_text(None, (serde_json::to_string(object)? + "\n").as_bytes())
}

/// A number: the text `inf` if it is infinite, null if it is NaN.
#[derive(Clone, Copy)]
pub struct Number(pub f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            f64::INFINITY => serializer.serialize_str("inf"),
            // NaN becomes null.
            value => serializer.serialize_f64(value),
        }
    }
}

/// One value for each of the four parameters.
#[derive(Serialize)]
pub struct OfParameters<T> {
    a_over_t: T,
    e1_over_e2: T,
    nu1: T,
    e0_over_e2: T,
}

impl<T> From<[T; 4]> for OfParameters<T> {
    /// In the order of [`Parameter::ALL`].
    fn from([a_over_t, e1_over_e2, nu1, e0_over_e2]: [T; 4]) -> Self {
        Self {
            a_over_t,
            e1_over_e2,
            nu1,
            e0_over_e2,
        }
    }
}

/// The range of a parameter.
#[derive(Serialize)]
pub struct Axis {
    from: Number,
    to: Number,
    /// The number of nodes, 1 for a fixed parameter.
    nodes: usize,
    /// The coordinate in which the axis is splined, or `fixed`.
    scale: &'static str,
}

/// Returns the range of each parameter; `nodes` gives its nodes.
pub fn axes<'a>(nodes: impl Fn(Parameter) -> &'a [f64]) -> OfParameters<Axis> {
    Parameter::ALL
        .map(|parameter| {
            let nodes = nodes(parameter);
            Axis {
                from: Number(nodes[0]),
                to: Number(nodes[nodes.len() - 1]),
                nodes: nodes.len(),
                scale: match nodes.len() {
                    1 => "fixed",
                    _ => parameter.scale(),
                },
            }
        })
        .into()
}

/// The certificate of a table, or the errors that a check has measured.
#[derive(Serialize)]
pub struct Errors {
    max_error: f64,
    p999_error: f64,
    median_error: f64,
    points: u64,
    seed: u64,
    worst_quantity: &'static str,
    worst_point: OfParameters<Number>,
    identity_errors: IdentityErrors,
}

/// The largest relative errors of the four identities, null where a quantity is missing.
#[derive(Serialize)]
struct IdentityErrors {
    /// `Gamma^2 = es (x Eeq)'`
    energy_release_rate: Option<f64>,
    /// `F0' = S delta0'`
    stiffness: Option<f64>,
    /// `delta0' = (2/R) S/S'`
    penetration: Option<f64>,
    /// `F0' = (2/R) S^2/S'`
    load: Option<f64>,
}

impl From<&Certificate> for Errors {
    fn from(certificate: &Certificate) -> Self {
        let [energy_release_rate, stiffness, penetration, load] = certificate.identity_errors;
        Self {
            max_error: certificate.max_error,
            p999_error: certificate.p999_error,
            median_error: certificate.median_error,
            points: certificate.points,
            seed: certificate.seed,
            worst_quantity: certificate.worst_quantity.name(),
            worst_point: certificate.worst_point.map(Number).into(),
            identity_errors: IdentityErrors {
                energy_release_rate,
                stiffness,
                penetration,
                load,
            },
        }
    }
}

/// A table without its values.
#[derive(Serialize)]
pub struct TableObject<'a> {
    title: &'a str,
    scene: &'a str,
    created_by: &'a str,
    axes: OfParameters<Axis>,
    nu0: f64,
    quantities: Vec<&'static str>,
    normalised_by: &'static str,
    tolerance: f64,
    /// The ranks of the low-rank form, if the table has it.
    ranks: Option<[usize; 3]>,
    certificate: Errors,
    /// The size of the file.
    bytes: u64,
}

impl<'a> TableObject<'a> {
    /// Returns the object of a `table` whose file has this many `bytes`.
    pub fn new(table: &'a Table, bytes: u64) -> Self {
        let description = table.description();
        Self {
            title: &description.title,
            scene: &description.scene,
            created_by: &description.created_by,
            axes: axes(|parameter| table.axis(parameter)),
            nu0: description.nu0,
            quantities: table.quantities().into_iter().map(Quantity::name).collect(),
            normalised_by: description.normalisation.symbol(),
            tolerance: description.tolerance,
            ranks: table.low_rank().map(LowRank::ranks),
            certificate: (&description.certificate).into(),
            bytes,
        }
    }
}

/// A table and the file that it was written to.
#[derive(Serialize)]
pub struct Written<'a> {
    #[serde(flatten)]
    pub table: TableObject<'a>,
    pub path: String,
}
