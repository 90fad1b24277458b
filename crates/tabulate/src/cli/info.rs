//! `tabulate info`

use std::fmt::Write;
use std::path::PathBuf;

use interp::Parameter;
use interp::{Certificate, LowRank, Quantity, Table};

use super::{read_table, write_text};

/// Print what a table covers and how accurate it is
#[derive(clap::Args)]
pub struct Arguments {
    /// The table, HDF5 or packed
    table: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let bytes = std::fs::metadata(&arguments.table).map(|data| data.len());
    let table = read_table(&arguments.table)?;
    let text = format!("{}{:15} {} bytes\n", describe(&table)?, "size", bytes?);
    write_text(None, text.as_bytes())
}

/// Everything but the values, a line each.
pub fn describe(table: &Table) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let description = table.description();
    writeln!(text, "{:15} {}", "title", description.title)?;
    for parameter in Parameter::ALL {
        text += &describe_axis(parameter, table.axis(parameter));
    }
    if let Some([a, b, c]) = table.low_rank().map(LowRank::ranks) {
        writeln!(text, "{:15} ranks {a}, {b}, {c}", "low rank")?;
    }
    writeln!(text, "{:15} {}", "nu0", description.nu0)?;
    let held: Vec<&str> = table.quantities().into_iter().map(Quantity::name).collect();
    writeln!(
        text,
        "{:15} {} (normalised by {})",
        "quantities",
        held.join(", "),
        description.normalisation.symbol()
    )?;
    writeln!(text, "{:15} {:e}", "tolerance", description.tolerance)?;
    text += &describe_certificate(&description.certificate)?;
    writeln!(text, "{:15} {}", "created by", description.created_by)?;
    Ok(text)
}

/// The certificate, a line for each thing that it says.
pub fn describe_certificate(certificate: &Certificate) -> Result<String, std::fmt::Error> {
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
    let place = Parameter::ALL
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
    let names = ["Gamma^2 = es (x Eeq)'", "F0' = S delta0'"];
    let broken = names
        .iter()
        .zip(certificate.identity_errors)
        .filter_map(|(name, error)| Some(format!("{name} {:.1e}", error?)));
    let broken: Vec<String> = broken.collect();
    if !broken.is_empty() {
        writeln!(
            text,
            "{:15} {} (relative, largest)",
            "identities",
            broken.join(", ")
        )?;
    }
    Ok(text)
}

/// The range of a parameter, and how many nodes it has.
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
