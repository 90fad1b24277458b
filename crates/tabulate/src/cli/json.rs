//! The JSON objects that `--json` prints. The names of their fields are fixed; the help of each
//! command lists them.

use std::path::Path;

use interp::{Certificate, Parameter, Quantity, SubstratePoissonRatio, Table};
use serde::{Serialize, Serializer};

use crate::printable;

/// Prints one object on one line.
pub fn print(object: &impl Serialize) -> anyhow::Result<()> {
    super::print((printable::json(&serde_json::to_string(object)?) + "\n").as_bytes())
}

/// A number: the text `inf` or `-inf` if it is infinite, null if it is NaN.
#[derive(Clone, Copy)]
pub struct Number(pub f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            f64::INFINITY => serializer.serialize_str("inf"),
            f64::NEG_INFINITY => serializer.serialize_str("-inf"),
            // NaN becomes null.
            value => serializer.serialize_f64(value),
        }
    }
}

/// An object of fields of one kind, in their order.
pub struct Fields<T, const N: usize>(pub [(&'static str, T); N]);

impl<T: Serialize, const N: usize> Serialize for Fields<T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// One value for each of the four parameters of a table.
pub type OfParameters<T> = Fields<T, 4>;

impl<T: Copy> OfParameters<T> {
    /// Joins the parameters of a table with their values.
    pub fn new(parameters: [Parameter; 4], values: [T; 4]) -> Self {
        Self([0, 1, 2, 3].map(|i| (parameters[i].name(), values[i])))
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
pub fn axes<'a>(
    parameters: [Parameter; 4],
    nodes: impl Fn(Parameter) -> &'a [f64],
) -> OfParameters<Axis> {
    Fields(parameters.map(|parameter| {
        let nodes = nodes(parameter);
        let axis = Axis {
            from: Number(nodes[0]),
            to: Number(nodes[nodes.len() - 1]),
            nodes: nodes.len(),
            scale: match nodes.len() {
                1 => "fixed",
                _ => parameter.scale(),
            },
        };
        (parameter.name(), axis)
    }))
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
    /// Null where a quantity is missing.
    identity_errors: Fields<Option<f64>, 4>,
}

/// The names of the identities `Gamma^2 = es (x Eeq)'`, `F0' = S delta0'`, `delta0' = (2/R) S/S'` and
/// `F0' = (2/R) S^2/S'`.
const IDENTITIES: [&str; 4] = ["energy_release_rate", "stiffness", "penetration", "load"];

impl Errors {
    /// Returns the object of the certificate of a table with these parameters.
    pub fn new(certificate: &Certificate, parameters: [Parameter; 4]) -> Self {
        Self {
            max_error: certificate.max_error,
            p999_error: certificate.p999_error,
            median_error: certificate.median_error,
            points: certificate.points,
            seed: certificate.seed,
            worst_quantity: certificate.worst_quantity.name(),
            worst_point: OfParameters::new(parameters, certificate.worst_point.map(Number)),
            identity_errors: Fields(
                [0, 1, 2, 3].map(|i| (IDENTITIES[i], certificate.identity_errors[i])),
            ),
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
    /// A number, or the text `paired`.
    nu0: serde_json::Value,
    quantities: Vec<&'static str>,
    /// The quantities that lookups answer.
    answers: Vec<&'static str>,
    normalised_by: &'static str,
    tolerance: f64,
    /// The ranks of each tile of the low-rank form, if the table has it.
    ranks: Option<Vec<[usize; 3]>>,
    certificate: Errors,
    /// The size of the file.
    bytes: u64,
    /// The file that it was written to.
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<String>,
}

impl<'a> TableObject<'a> {
    /// Returns the object of a `table` whose file has this many `bytes`.
    pub fn new(table: &'a Table, bytes: u64) -> Self {
        let description = table.description();
        Self {
            title: &description.title,
            scene: &description.scene,
            created_by: &description.created_by,
            axes: axes(table.parameters(), |parameter| table.axis(parameter)),
            nu0: match description.nu0 {
                SubstratePoissonRatio::Fixed(nu0) => nu0.into(),
                SubstratePoissonRatio::Paired => SubstratePoissonRatio::PAIRED.into(),
            },
            quantities: table.quantities().into_iter().map(Quantity::name).collect(),
            answers: table.answers().into_iter().map(Quantity::name).collect(),
            normalised_by: table.unit(),
            tolerance: description.tolerance,
            ranks: table.ranks(),
            certificate: Errors::new(&description.certificate, table.parameters()),
            bytes,
            path: None,
        }
    }

    /// Adds the file that the table was written to.
    pub fn written(self, path: &Path) -> Self {
        Self {
            path: Some(path.display().to_string()),
            ..self
        }
    }
}
