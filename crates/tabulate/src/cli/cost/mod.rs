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

/// Measure what accuracy costs in time and memory
///
/// Prints a summary as Markdown; -o writes all that was measured as CSV, which `tabulate plot`
/// draws. Errors and sizes are the same in every run, times are not.
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

/// Where rows come from and go to.
#[derive(clap::Args)]
struct Rows {
    /// Write all rows here, as CSV
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
    /// Sum up the rows that -o wrote here before, instead of measuring
    #[arg(long, value_name = "COST.csv", conflicts_with_all = ["output", "compare"])]
    data: Option<PathBuf>,
    /// Fail where the rows differ from those that -o wrote here before: errors and sizes but for
    /// rounding, times by a factor of ten
    #[arg(long, value_name = "COST.csv")]
    compare: Option<PathBuf>,
}

impl Rows {
    /// Gets the rows, writes and compares them if asked to, and prints their summary. `input` is a
    /// file that must not be overwritten.
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
