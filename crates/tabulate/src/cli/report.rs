//! `tabulate report`

use std::path::PathBuf;

use anyhow::Context;

use super::{read_table, write_text};
use crate::output;
use crate::report::report;

/// Write a self-contained HTML page about a table, with force curves to play with
///
/// What the table covers, its certificate, and the force curve of any system in it, with sliders, computed in the page. One file,
/// which fetches nothing.
#[derive(clap::Args)]
pub struct Arguments {
    /// The table, HDF5 or packed
    table: PathBuf,
    /// The page to write
    #[arg(short, long, value_name = "REPORT.html")]
    output: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    output::check(Some(&arguments.output), Some(&arguments.table))?;
    let page = report(&read_table(&arguments.table)?).with_context(|| arguments.table.display().to_string())?;
    write_text(Some(&arguments.output), page.as_bytes())
}
