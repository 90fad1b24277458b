//! `tabulate cost solve`

use super::Rows;
use crate::cli::progress_bar;
use crate::cost::clock::Timing;
use crate::cost::solve::{Row, contacts, markdown, measure};

/// One solve: error and time, beside a plain dense solver by Nystrom's method
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    arguments
        .rows
        .report(None, |timing| Ok(measured(timing).into()), markdown)
}

/// Measures all rows for a figure.
pub fn of_default() -> Vec<Row> {
    measured(Timing::Thorough)
}

/// Measures all rows, with a bar.
fn measured(timing: Timing) -> Vec<Row> {
    let bar = progress_bar(contacts().len(), "measuring");
    let rows = measure(timing, &|| bar.inc(1));
    bar.finish_and_clear();
    rows
}
