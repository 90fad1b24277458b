//! `tabulate cost solve`

use super::super::progress_bar;
use super::Rows;
use crate::cost::solve::{Row, contacts, markdown, measure};

/// One solve: error against time, beside a plain dense Nystrom solve
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    arguments.rows.report(None, || Ok(measured()), markdown)
}

/// All rows, with a bar.
pub fn measured() -> Vec<Row> {
    let bar = progress_bar(contacts().len(), "measuring");
    let rows = measure(&|| bar.inc(1));
    bar.finish_and_clear();
    rows
}
