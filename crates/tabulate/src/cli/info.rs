//! `tabulate info`

use std::fmt::Display;

use clap::ValueHint;
use interp::{Certificate, Parameter, Quantity, SubstratePoissonRatio, Table};

use super::json;
use super::print;
use super::table_name::{self, TableName};
use crate::printable;
use crate::stack::NamedStack;
use crate::table::stack_of;
use solve::stack::Interface;

/// Print the range, the certificate and the size of a table
///
/// The certificate is the largest error at sampled points between the nodes, relative to direct
/// solves. The error that 99.9 % of the points do not exceed, the median error, and the place of
/// the largest error are part of it. The last lines explain the rows.
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
    /// each parameter; a fixed one has 1 node), nu0, quantities (those held), answers (the quantities
    /// that lookups answer: a table of gamma alone answers all four), normalised_by, tolerance, ranks
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
        return json::print(&json::table(&table, bytes));
    }
    let size = row("size", format_args!("{bytes} bytes"));
    print((describe(&table) + &size + &explain(&table)).as_bytes())
}

/// Returns the line of a row.
pub fn row(name: &str, content: impl Display) -> String {
    format!("{name:15} {content}\n")
}

/// Describes everything but the values, one line each.
pub fn describe(table: &Table) -> String {
    let description = table.description();
    let mut text = row("title", printable::line(&description.title));
    for parameter in table.parameters() {
        text += &describe_axis(parameter, table.axis(parameter));
    }
    for [a, b, c] in table.ranks().into_iter().flatten() {
        text += &row("low rank", format_args!("ranks {a}, {b}, {c}"));
    }
    text += &row("nu0", description.nu0);
    if let Ok(Some(named)) = stack_of(table) {
        text += &describe_layers(&named);
    }
    let names = |quantities: &[Quantity]| {
        let names: Vec<&str> = quantities.iter().map(|quantity| quantity.name()).collect();
        names.join(", ")
    };
    let held = table.quantities();
    let mut derived = table.answers();
    derived.retain(|quantity| !held.contains(quantity));
    let derived = match names(&derived) {
        none if none.is_empty() => none,
        names => format!("; {names} follow from gamma"),
    };
    let (held, unit) = (names(&held), table.unit());
    text += &row(
        "quantities",
        format_args!("{held}{derived} (normalised by {unit})"),
    );
    text += &row("tolerance", format_args!("{:e}", description.tolerance));
    text += &describe_certificate(&description.certificate, table.parameters());
    text + &row("created by", printable::line(&description.created_by))
}

/// Describes the layers of a stack from the top down, one line each.
fn describe_layers(named: &NamedStack) -> String {
    let mut text = String::new();
    for (layer, name) in named.stack.layers().iter().zip(&named.names).rev() {
        let interface = match layer.interface.plain() {
            Interface::Bonded => "bonded".to_owned(),
            Interface::Sliding => "slides".to_owned(),
            Interface::Springs { tangential, normal } => {
                format!("springs of {tangential:?} Pa/m sideways and {normal:?} Pa/m normal")
            }
        };
        let name = name
            .as_deref()
            .map(|name| format!("{}: ", printable::line(name)));
        text += &row(
            "layer",
            format_args!(
                "{}{:?} m, E = {:?} Pa, nu = {:?}, {interface} below",
                name.unwrap_or_default(),
                layer.thickness,
                layer.solid.young(),
                layer.solid.poisson(),
            ),
        );
    }
    text
}

/// Explains the rows of [`describe`], one line each.
fn explain(table: &Table) -> String {
    let mut text = "\nThe rows mean:\n".to_owned();
    let mut row = |name: &str, meaning: &str| text += &row(name, meaning);
    for parameter in table.parameters() {
        row(parameter.name(), parameter.long_name());
    }
    if table.ranks().is_some() {
        row(
            "low rank",
            "the values are compressed to tensor trains: the ranks of each, one for each tile of the range",
        );
    }
    if table.is_of_stack() {
        row(
            "layer",
            "a layer of the stack, from the top down: thickness, Young's modulus, Poisson ratio, and what joins it to the body below",
        );
    }
    row(
        "nu0",
        match table.description().nu0 {
            _ if table.is_of_stack() => "Poisson ratio of the base of the stack",
            SubstratePoissonRatio::Fixed(_) => {
                "Poisson ratio of the substrate; other substrates are replaced by their exact equivalents"
            }
            SubstratePoissonRatio::Paired => {
                "Poisson ratio of the substrate; paired: every pair of nu1 and nu0 from 0 to 0.5 has an exact equivalent in the table"
            }
        },
    );
    for quantity in table.answers() {
        row(
            quantity.name(),
            &format!("{}: {}", quantity.long_name(), quantity.equation()),
        );
    }
    row(
        "tolerance",
        "the relative error for which the nodes were chosen, or to which the values were compressed",
    );
    row(
        "certified error",
        "the relative errors found at points between the nodes, of all quantities that the table answers",
    );
    row(
        "worst",
        "the quantity and the point with the largest of them",
    );
    if table
        .description()
        .certificate
        .identity_errors
        .iter()
        .any(Option::is_some)
    {
        row(
            "identities",
            "the errors in exact relations between the quantities and their slopes; x = a_over_t, S: stiffness, F0: adhesionless load, a prime: d/dx or d/da",
        );
    }
    text
}

/// Describes a certificate: its errors, the worst point, and the identities where they are known.
fn describe_certificate(certificate: &Certificate, parameters: [Parameter; 4]) -> String {
    let mut text = row(
        "certified error",
        format_args!(
            "max {:.1e}, 99.9 % {:.1e}, median {:.1e} (relative, {} direct solves, seed {})",
            certificate.max_error,
            certificate.p999_error,
            certificate.median_error,
            certificate.points,
            certificate.seed
        ),
    );
    let place = parameters
        .iter()
        .zip(certificate.worst_point)
        .map(|(p, value)| format!("{} = {value}", p.name()));
    let place = place.collect::<Vec<String>>().join(", ");
    let quantity = certificate.worst_quantity.name();
    text += &row("worst", format_args!("{quantity} at {place}"));
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
    let known = known.collect::<Vec<String>>().join(", ");
    if !known.is_empty() {
        text += &row("identities", format_args!("{known} (relative, largest)"));
    }
    text
}

/// Describes the range of a parameter and its number of nodes.
pub fn describe_axis(parameter: Parameter, nodes: &[f64]) -> String {
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    let (name, scale) = (parameter.name(), parameter.scale());
    match nodes.len() {
        1 => row(name, first),
        n => row(name, format_args!("{first} to {last}, {n} nodes ({scale})")),
    }
}
