//! The JSON objects that `--json` prints. The names of their fields are fixed; the help of each
//! command lists them.

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

/// One value for each of the four parameters of a table: an object with their names.
pub struct OfParameters<T>([(Parameter, T); 4]);

impl<T: Copy> OfParameters<T> {
    /// Joins the parameters of a table with their values.
    pub fn new(parameters: [Parameter; 4], values: [T; 4]) -> Self {
        Self([0, 1, 2, 3].map(|i| (parameters[i], values[i])))
    }
}

impl<T: Serialize> Serialize for OfParameters<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let fields = self.0.iter();
        serializer.collect_map(fields.map(|(parameter, value)| (parameter.name(), value)))
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
    OfParameters(parameters.map(|parameter| {
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
        (parameter, axis)
    }))
}

/// The Poisson ratio of a table's substrates: a number, or the text `paired`.
struct Nu0(SubstratePoissonRatio);

impl Serialize for Nu0 {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            SubstratePoissonRatio::Fixed(nu0) => serializer.serialize_f64(nu0),
            SubstratePoissonRatio::Paired => {
                serializer.serialize_str(SubstratePoissonRatio::PAIRED)
            }
        }
    }
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

impl Errors {
    /// Returns the object of the certificate of a table with these parameters.
    pub fn new(certificate: &Certificate, parameters: [Parameter; 4]) -> Self {
        let [energy_release_rate, stiffness, penetration, load] = certificate.identity_errors;
        Self {
            max_error: certificate.max_error,
            p999_error: certificate.p999_error,
            median_error: certificate.median_error,
            points: certificate.points,
            seed: certificate.seed,
            worst_quantity: certificate.worst_quantity.name(),
            worst_point: OfParameters::new(parameters, certificate.worst_point.map(Number)),
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
    nu0: Nu0,
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
            nu0: Nu0(description.nu0),
            quantities: table.quantities().into_iter().map(Quantity::name).collect(),
            answers: table.answers().into_iter().map(Quantity::name).collect(),
            normalised_by: table.unit(),
            tolerance: description.tolerance,
            ranks: table.ranks(),
            certificate: Errors::new(&description.certificate, table.parameters()),
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
