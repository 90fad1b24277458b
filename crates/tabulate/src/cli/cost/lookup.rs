//! `tabulate cost lookup`

use anyhow::{Context, ensure};
use clap::ValueHint;
use interp::Parameter;

use super::rows::{Rows, complete};
use crate::cli::default_table;
use crate::cli::progress::progress_bar;
use crate::cli::table_name::{self, TableName};
use crate::table::random_points;
use cost::Measured;
use cost::clock::Timing;
use cost::lookup::{POINTS, Row, SEED, markdown, measure, solves};

/// Measure one lookup: error against nanoseconds, beside direct solves and closed forms
///
/// Errors are those of the load at random points of the table's box: at a given contact radius,
/// without adhesion and with adhesion that halves the load. Errors of the series for thin layers
/// are those at a given penetration, where the series apply.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost lookup --data tables/figures/lookup.csv",
    "tabulate cost lookup tables/paper.h5 -o lookup.csv",
))]
pub struct Arguments {
    #[arg(
        conflicts_with = "data",
        help = format!(
            "{}. It must hold all four quantities over e1_over_e2 and e0_over_e2, which the embedded \
             table does not {}",
            table_name::HELP,
            default_table::HELP
        ),
        value_hint = ValueHint::FilePath
    )]
    table: Option<TableName>,
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let table = arguments.table.as_ref();
    let path = table.and_then(TableName::path);
    arguments
        .rows
        .report(path, |timing| measured(table, timing), markdown)
}

/// Measures all rows of the default scene's table for a figure.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    Ok(complete(measured(None, Timing::Thorough)?))
}

/// Measures all rows of a table, with a bar.
fn measured(name: Option<&TableName>, timing: Timing) -> anyhow::Result<Measured<Row>> {
    let table = default_table::read_or_make(name)?;
    let name = name.map_or("the default scene".to_owned(), TableName::to_string);
    ensure!(
        table.parameters() == Parameter::ALL,
        "{name}: the other forms interpolate on the nodes of the table in a/t, E1/E2*, nu1 and E0/E2*, and \
         this table has other axes; give one with these, or none for that of the default scene"
    );
    let bar = progress_bar(solves(POINTS), "measuring");
    let points = random_points(&table, POINTS, SEED);
    measure(&table, &points, timing, &|count| bar.inc(count as u64)).context(name)
}
