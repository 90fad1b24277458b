//! The JSON objects that `--json` prints. The names of their fields are fixed; the help of each
//! command lists them.

use interp::{Certificate, Parameter, Quantity, SubstratePoissonRatio, Table};
use serde_json::{Value, json};

use crate::printable;

/// Prints one object on one line.
pub fn print(object: &Value) -> anyhow::Result<()> {
    super::print((printable::json(&object.to_string()) + "\n").as_bytes())
}

/// Returns a number: the text `inf` or `-inf` if it is infinite, null if it is NaN.
pub fn number(value: f64) -> Value {
    match value {
        f64::INFINITY => "inf".into(),
        f64::NEG_INFINITY => "-inf".into(),
        // NaN becomes null.
        value => value.into(),
    }
}

/// Returns an object with one value for each of the four parameters of a table.
pub fn of_parameters<T: Into<Value>>(parameters: [Parameter; 4], values: [T; 4]) -> Value {
    let names = parameters.into_iter().map(Parameter::name);
    names.zip(values).collect()
}

/// Returns the range of each parameter; `nodes` gives its nodes, of which a fixed one has one.
pub fn axes<'a>(parameters: [Parameter; 4], nodes: impl Fn(Parameter) -> &'a [f64]) -> Value {
    let axis = |parameter: Parameter| {
        let nodes = nodes(parameter);
        json!({
            "from": number(nodes[0]),
            "to": number(nodes[nodes.len() - 1]),
            "nodes": nodes.len(),
            // The coordinate in which the axis is splined.
            "scale": if nodes.len() == 1 { "fixed" } else { parameter.scale() },
        })
    };
    of_parameters(parameters, parameters.map(axis))
}

/// Returns the certificate of a table with these parameters, or the errors that a check has measured.
pub fn errors(certificate: &Certificate, parameters: [Parameter; 4]) -> Value {
    // `Gamma^2 = es (x Eeq)'`, `F0' = S delta0'`, `delta0' = (2/R) S/S'` and `F0' = (2/R) S^2/S'`. Null where a
    // quantity is missing.
    let identities = ["energy_release_rate", "stiffness", "penetration", "load"];
    let identities: Value = identities
        .into_iter()
        .zip(certificate.identity_errors)
        .collect();
    json!({
        "max_error": certificate.max_error,
        "p999_error": certificate.p999_error,
        "median_error": certificate.median_error,
        "points": certificate.points,
        "seed": certificate.seed,
        "worst_quantity": certificate.worst_quantity.name(),
        "worst_point": of_parameters(parameters, certificate.worst_point.map(number)),
        "identity_errors": identities,
    })
}

/// Returns a `table` without its values, whose file has this many `bytes`.
pub fn table(table: &Table, bytes: u64) -> Value {
    let names = |quantities: Vec<Quantity>| -> Vec<&str> {
        quantities.into_iter().map(Quantity::name).collect()
    };
    let description = table.description();
    let nu0: Value = match description.nu0 {
        SubstratePoissonRatio::Fixed(nu0) => nu0.into(),
        SubstratePoissonRatio::Paired => SubstratePoissonRatio::PAIRED.into(),
    };
    json!({
        "title": description.title,
        "scene": description.scene,
        "created_by": description.created_by,
        "axes": axes(table.parameters(), |parameter| table.axis(parameter)),
        "nu0": nu0,
        "quantities": names(table.quantities()),
        "answers": names(table.answers()),
        "normalised_by": table.unit(),
        "tolerance": description.tolerance,
        // Of each tile of the low-rank form, if the table has it.
        "ranks": table.ranks(),
        "certificate": errors(&description.certificate, table.parameters()),
        "bytes": bytes,
    })
}
