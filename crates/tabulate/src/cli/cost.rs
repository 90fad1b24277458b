//! `tabulate cost`

mod effects;
mod lookup;
mod solve;
mod table;

use std::path::Path;

use clap::Subcommand;
use serde::Serialize;

pub use self::effects::of_default as measure_effects;
pub use self::solve::measured as measure_solve;
pub use self::table::of_default as measure_table;
use super::write_text;
use crate::cost::to_csv;

/// Measure what accuracy costs in time and memory
///
/// Prints a summary as Markdown; -o writes all that was measured as CSV, which `tabulate plot` draws. Errors and sizes are the same
/// in every run, times are not.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    of: Of,
}

#[derive(Subcommand)]
enum Of {
    Solve(solve::Arguments),
    Table(table::Arguments),
    Lookup(lookup::Arguments),
    Effects(effects::Arguments),
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    match &arguments.of {
        Of::Solve(arguments) => solve::run(arguments),
        Of::Table(arguments) => table::run(arguments),
        Of::Lookup(arguments) => lookup::run(arguments),
        Of::Effects(arguments) => effects::run(arguments),
    }
}

/// Writes the rows where they are wanted and prints their summary.
fn report<R: Serialize>(output: Option<&Path>, rows: &[R], summary: &str) -> anyhow::Result<()> {
    if output.is_some() {
        write_text(output, &to_csv(rows))?;
    }
    write_text(None, summary.as_bytes())
}
