//! `tabulate cost solve`

use crate::cli::progress::progress_bar;
use cost::clock::Timing;
use cost::solve::{Row, contacts, measure};

/// Measures all rows, with a bar.
pub fn measured(timing: Timing) -> Vec<Row> {
    let bar = progress_bar(contacts().len(), "measuring");
    measure(timing, &|| bar.inc(1))
}
