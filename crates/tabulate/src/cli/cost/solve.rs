//! `tabulate cost solve`

use super::cost::Rows;
use crate::cli::progress::progress_bar;
use cost::clock::Timing;
use cost::solve::{Row, contacts, markdown, measure};

/// Measure one solve: error against time, beside a plain dense Nystrom solve
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost solve --data tables/figures/solve.csv",
    "tabulate cost solve -o solve.csv",
))]
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
