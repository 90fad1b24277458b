//! `tabulate cost solve`

use std::path::PathBuf;

use super::report;
use crate::cost::solve::{markdown, measure};
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
    let rows = measure();
    report(arguments.output.as_deref(), &rows, &markdown(&rows))
}
