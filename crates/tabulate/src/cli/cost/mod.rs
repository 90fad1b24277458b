//! `tabulate cost`

mod effects;
mod lookup;
mod solve;
mod table;

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Subcommand;
use serde::Serialize;
use serde::de::DeserializeOwned;

pub use self::effects::of_default as measure_effects;
pub use self::lookup::measured as measure_lookup;
pub use self::solve::measured as measure_solve;
pub use self::table::of_default as measure_table;
use super::write_text;
use crate::cost::{compare, read_csv, to_csv};
use crate::output;

/// Measure the cost of accuracy in time and memory
///
/// Prints a summary as Markdown. With -o, writes all rows as CSV, from which `tabulate plot` draws.
/// Errors and sizes do not change from run to run; times do.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate cost table --data tables/figures/table.csv",
    "tabulate cost solve -o solve.csv",
))]
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

/// The files from which rows are read and to which they are written.
#[derive(clap::Args)]
struct Rows {
    /// Write all rows to this file, as CSV
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
    /// Summarise the rows of this file, which -o has written, instead of measuring
    #[arg(long, value_name = "COST.csv", conflicts_with_all = ["output", "compare"])]
    data: Option<PathBuf>,
    /// Fail where the rows differ from those of this file, which -o has written: errors and sizes
    /// by more than rounding, times by more than a factor of ten
    #[arg(long, value_name = "COST.csv")]
    compare: Option<PathBuf>,
}

impl Rows {
    /// Gets the rows, writes and compares them if asked to, and prints their summary. `input` is a
    /// file that the output must not replace.
    fn report<R: Serialize + DeserializeOwned>(
        &self,
        input: Option<&Path>,
        measure: impl FnOnce() -> anyhow::Result<Vec<R>>,
        markdown: fn(&[R]) -> String,
    ) -> anyhow::Result<()> {
        output::check(self.output.as_deref(), input)?;
        let before = self
            .compare
            .as_ref()
            .map(|path| anyhow::Ok((path, read_csv(path)?)))
            .transpose()?;
        let rows = self
            .data
            .as_ref()
            .map_or_else(measure, |path| Ok(read_csv(path)?))?;
        if self.output.is_some() {
            write_text(self.output.as_deref(), &to_csv(&rows))?;
        }
        write_text(None, markdown(&rows).as_bytes())?;
        match before {
            Some((path, before)) => {
                compare(&before, &rows).with_context(|| path.display().to_string())
            }
            None => Ok(()),
        }
    }
}
