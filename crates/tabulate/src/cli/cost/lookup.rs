//! `tabulate cost lookup`

use std::path::{Path, PathBuf};

use anyhow::Context;
use interp::Table;

use super::{Rows, complete};
use crate::cli::{progress_bar, read_table};
use crate::cost::Measured;
use crate::cost::clock::Timing;
use crate::cost::lookup::{POINTS, Row, markdown, measure, solves};

/// One lookup: error and time of every form of it, beside direct solves and the closed forms in use
///
/// Errors are those of the load at random points of the table's box, at a given contact radius:
/// without adhesion, and with adhesion that halves the load. Those of the series for thin layers
/// are at a given penetration, within the range of the series.
#[derive(clap::Args)]
pub struct Arguments {
    /// A table with all four quantities, HDF5 or packed [default: the one that is built in]
    #[arg(conflicts_with = "data")]
    table: Option<PathBuf>,
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let table = arguments.table.as_deref();
    arguments
        .rows
        .report(table, |timing| measured(table, timing), markdown)
}

/// Measures the table that is built in, for a figure.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    Ok(complete(measured(None, Timing::Thorough)?))
}

/// Measures all rows of a table, or of the one that is built in, with a bar.
fn measured(table: Option<&Path>, timing: Timing) -> anyhow::Result<Measured<Row>> {
    let read = table.map(read_table).transpose()?;
    let bar = progress_bar(solves(POINTS), "measuring");
    let measured = measure(
        read.as_ref().unwrap_or_else(|| Table::embedded()),
        POINTS,
        timing,
        &|count| bar.inc(count as u64),
    );
    let measured = measured.with_context(|| {
        table.map_or("the built-in table".into(), |path| {
            path.display().to_string()
        })
    })?;
    bar.finish_and_clear();
    Ok(measured)
}
