//! `tabulate cost solve`

use std::path::PathBuf;

use super::super::progress_bar;
use super::report;
use crate::cost::solve::{Row, contacts, markdown, measure};
use crate::output;

/// One solve: error against time, beside a plain dense Nystrom solve
#[derive(clap::Args)]
pub struct Arguments {
    /// Write all rows here, as CSV
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    output::check(arguments.output.as_deref(), None)?;
    let rows = measured();
    report(arguments.output.as_deref(), &rows, &markdown(&rows))
}

/// All rows, with a bar.
pub fn measured() -> Vec<Row> {
    let bar = progress_bar(contacts().len(), "measuring");
    let rows = measure(&|| bar.inc(1));
    bar.finish_and_clear();
    rows
}
