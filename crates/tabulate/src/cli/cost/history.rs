//! `tabulate cost history`

use super::cost::Rows;
use cost::history::{markdown, measure};

/// Measure contacts in time: error of the load against time, of three laws of relaxation
///
/// Penetrations that grow and fall once take integrals, whose errors are those against a run at a much
/// smaller tolerance. All others take elements, whose errors are the stated ones.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost history --data tables/figures/history.csv",
    "tabulate cost history -o history.csv",
))]
pub struct Arguments {
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    arguments
        .rows
        .report(None, |timing| Ok(measure(timing)?.into()), markdown)
}
