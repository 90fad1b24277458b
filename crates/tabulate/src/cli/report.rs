//! `tabulate report`

use std::path::PathBuf;

use anyhow::Context;

use super::{progress_bar, read_table, write_text};
use crate::output;
use crate::report::{figures, report, steps};

/// Write a self-contained HTML page about a table, with force curves to play with
///
/// What the table covers, its certificate, a map of its errors, and the force curve of any system
/// in it, with sliders, computed in the page. One file, which fetches nothing.
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
    let table = read_table(&arguments.table)?;
    let bar = progress_bar(steps(&table), "drawing");
    let page = figures(&table, &|count| bar.inc(count as u64))
        .and_then(|figures| report(&table, &figures));
    bar.finish_and_clear();
    write_text(
        Some(&arguments.output),
        page.with_context(|| arguments.table.display().to_string())?
            .as_bytes(),
    )
}
