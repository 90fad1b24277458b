//! `tabulate info`

use std::fmt::Write;

use clap::ValueHint;
use interp::Parameter;
use interp::{Certificate, Quantity, Table};

use super::json::{self, TableObject};
use super::print;
use super::table_name::{self, TableName};
use crate::printable;

/// Print the range, the certificate and the size of a table
///
/// The certificate is the largest error at sampled points between the nodes, relative to direct
/// solves. The error that 99.9 % of the points do not exceed, the median error, and the place of
/// the largest error are part of it.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate info embedded",
    "tabulate info tables/paper.h5",
    "tabulate info tables/paper.bin --json",
))]
pub struct Arguments {
    #[arg(help = table_name::HELP, value_hint = ValueHint::FilePath)]
    table: TableName,
    /// Print one JSON object
    ///
    /// The fields are title, scene (the TOML text), created_by, axes (from, to, nodes and scale of
    /// each parameter; a fixed one has 1 node), nu0, quantities, normalised_by, tolerance, ranks
    /// (of the low-rank form, else null), certificate (max_error, p999_error, median_error, points,
    /// seed, worst_quantity, worst_point, identity_errors) and bytes (the size of the file). An
    /// infinite number is the text "inf".
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let table = arguments.table.read()?;
    let bytes = arguments.table.bytes(&table)?;
    if arguments.json {
        return json::print(&TableObject::new(&table, bytes));
    }
    let text = format!("{}{:15} {bytes} bytes\n", describe(&table)?, "size");
    print(text.as_bytes())
}

/// Describes everything but the values, one line each.
pub fn describe(table: &Table) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let description = table.description();
    writeln!(
        text,
        "{:15} {}",
        "title",
        printable::line(&description.title)
    )?;
    for parameter in table.parameters() {
        text += &describe_axis(parameter, table.axis(parameter));
    }
    for [a, b, c] in table.ranks().into_iter().flatten() {
        writeln!(text, "{:15} ranks {a}, {b}, {c}", "low rank")?;
    }
    writeln!(text, "{:15} {}", "nu0", description.nu0)?;
    let held: Vec<&str> = table.quantities().into_iter().map(Quantity::name).collect();
    writeln!(
        text,
        "{:15} {} (normalised by {})",
        "quantities",
        held.join(", "),
        table.unit()
    )?;
    writeln!(text, "{:15} {:e}", "tolerance", description.tolerance)?;
    text += &describe_certificate(&description.certificate, table.parameters())?;
    writeln!(
        text,
        "{:15} {}",
        "created by",
        printable::line(&description.created_by)
    )?;
    Ok(text)
}

/// Describes a certificate: its errors, the worst point, and the identities where they are known.
fn describe_certificate(
    certificate: &Certificate,
    parameters: [Parameter; 4],
) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    writeln!(
        text,
        "{:15} max {:.1e}, 99.9 % {:.1e}, median {:.1e} (relative, {} direct solves, seed {})",
        "certified error",
        certificate.max_error,
        certificate.p999_error,
        certificate.median_error,
        certificate.points,
        certificate.seed
    )?;
    let place = parameters
        .iter()
        .zip(certificate.worst_point)
        .map(|(p, value)| format!("{} = {value}", p.name()));
    let place: Vec<String> = place.collect();
    writeln!(
        text,
        "{:15} {} at {}",
        "worst",
        certificate.worst_quantity.name(),
        place.join(", ")
    )?;
    let names = [
        "Gamma^2 = es (x Eeq)'",
        "F0' = S delta0'",
        "delta0' = (2/R) S/S'",
        "F0' = (2/R) S^2/S'",
    ];
    let known = names
        .iter()
        .zip(certificate.identity_errors)
        .filter_map(|(name, error)| Some(format!("{name} {:.1e}", error?)));
    let known: Vec<String> = known.collect();
    if !known.is_empty() {
        writeln!(
            text,
            "{:15} {} (relative, largest)",
            "identities",
            known.join(", ")
        )?;
    }
    Ok(text)
}

/// Describes the range of a parameter and its number of nodes.
pub fn describe_axis(parameter: Parameter, nodes: &[f64]) -> String {
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    match nodes.len() {
        1 => format!("{:15} {first}\n", parameter.name()),
        n => format!(
            "{:15} {first} to {last}, {n} nodes ({})\n",
            parameter.name(),
            parameter.scale()
        ),
    }
}
