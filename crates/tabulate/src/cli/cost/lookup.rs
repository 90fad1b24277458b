//! `tabulate cost lookup`

use std::path::{Path, PathBuf};

use anyhow::Context;
use interp::Table;

use super::Rows;
use crate::cli::{progress_bar, read_table};
use crate::cost::lookup::{POINTS, Row, markdown, measure, solves};

/// One lookup: nanoseconds against error for every form of it, beside direct solves and the closed
/// forms in use
///
/// Errors are those of the load at random points of the table's box: at a given contact radius,
/// without adhesion and with adhesion that takes half of that load away; of the series for thin
/// layers at a given penetration, where they apply.
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
    arguments.rows.report(table, || measured(table), markdown)
}

/// All rows of a table, or of the one that is built in, with a bar.
pub fn measured(table: Option<&Path>) -> anyhow::Result<Vec<Row>> {
    let read = table.map(read_table).transpose()?;
    let bar = progress_bar(solves(POINTS), "measuring");
    let rows = measure(
        read.as_ref().unwrap_or_else(|| Table::embedded()),
        POINTS,
        &|count| bar.inc(count as u64),
    );
    let rows = rows.with_context(|| {
        table.map_or("the built-in table".into(), |path| {
            path.display().to_string()
        })
    })?;
    bar.finish_and_clear();
    Ok(rows)
}
