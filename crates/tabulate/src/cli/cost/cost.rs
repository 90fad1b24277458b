//! `tabulate cost`

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Subcommand;
use cost::clock::Timing;
use cost::{Measured, Measurement, compare, history, to_csv};

use super::{effects, lookup, solve, table};
use crate::cli::output::Output;
use crate::cli::{note, print};
use crate::measure::{read, read_csv};
use crate::printable;

/// Measure the cost of accuracy in time and memory
///
/// Prints a summary as Markdown. Writes all rows as CSV if -o is given: `tabulate plot` draws them.
/// Errors and sizes do not change from run to run; times do.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost table --data tables/figures/table.csv",
    "tabulate cost solve -o solve.csv",
))]
pub struct Arguments {
    #[command(subcommand)]
    of: Of,
}

#[derive(Subcommand)]
enum Of {
    /// Measure one solve: error against time, beside a plain dense Nystrom solve
    #[command(after_help = crate::cli::examples!(
        "tabulate cost solve --data tables/figures/solve.csv",
        "tabulate cost solve -o solve.csv",
    ))]
    Solve(Rows),
    Table(table::Arguments),
    Lookup(lookup::Arguments),
    Effects(effects::Arguments),
    /// Measure contacts in time: error of the load against time, of three laws of relaxation
    ///
    /// Penetrations that grow and fall once take integrals, whose errors are those against a run at a much
    /// smaller tolerance. All others take elements, whose errors are the stated ones.
    #[command(after_help = crate::cli::examples!(
        "tabulate cost history --data tables/figures/history.csv",
        "tabulate cost history -o history.csv",
    ))]
    History(Rows),
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    match &arguments.of {
        Of::Solve(rows) => rows.report(
            None,
            |timing| Ok(solve::measured(timing).into()),
            ::cost::solve::markdown,
        ),
        Of::Table(arguments) => table::run(arguments),
        Of::Lookup(arguments) => lookup::run(arguments),
        Of::Effects(arguments) => effects::run(arguments),
        Of::History(rows) => rows.report(
            None,
            |timing| Ok(history::measure(timing)?.into()),
            history::markdown,
        ),
    }
}

/// The files from which rows are read and to which they are written.
#[derive(clap::Args)]
pub(super) struct Rows {
    /// Write all rows to this file, as CSV
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
    /// Summarise the rows of this file, which -o has written, instead of measuring
    #[arg(long, value_name = "COST.csv", conflicts_with_all = ["output", "compare"])]
    data: Option<PathBuf>,
    /// Fail where the rows differ from those of this file, which -o has written
    ///
    /// Counts must be equal, errors equal but for rounding. Times are not compared, and without -o
    /// they are measured briefly.
    #[arg(long, value_name = "COST.csv")]
    compare: Option<PathBuf>,
}

impl Rows {
    /// Gets the rows, writes and compares them if that is asked for, and prints their summary. What
    /// is left out is named in the summary and on standard error. `input` is a file that the output
    /// must not replace.
    pub(super) fn report<R: Measurement>(
        &self,
        input: Option<&Path>,
        measure: impl FnOnce(Timing) -> anyhow::Result<Measured<R>>,
        markdown: fn(&[R]) -> String,
    ) -> anyhow::Result<()> {
        let output = Output::of_text(
            self.output.as_deref(),
            &[input, self.data.as_deref(), self.compare.as_deref()],
        )?;
        // A time of 0 was not measured, and is in no range.
        let before = self
            .compare
            .as_ref()
            .map(|path| anyhow::Ok((path, read::<R>(path, &[])?)))
            .transpose()?;
        let Measured { rows, left_out } = match &self.data {
            Some(path) => read_csv(path)?.into(),
            None => measure(self.timing())?,
        };
        if self.output.is_some() {
            output.write(&to_csv(&rows))?;
        }
        let mut summary = markdown(&rows);
        for sentence in &left_out {
            summary += &format!("{sentence}\n");
        }
        print(printable::lines(&summary).as_bytes())?;
        report_left_out(&left_out);
        let Some((path, before)) = before else {
            return Ok(());
        };
        compare(&before, &rows).with_context(|| printable::path(path))?;
        let fewer = before.len() - rows.len();
        if fewer > 0 {
            note(&format!(
                "{}: the last {fewer} of its {} rows are not compared",
                printable::path(path),
                before.len()
            ));
        }
        Ok(())
    }

    /// Rows that are only compared need no exact times.
    const fn timing(&self) -> Timing {
        if self.compare.is_some() && self.output.is_none() {
            Timing::Brief
        } else {
            Timing::Thorough
        }
    }
}

/// Prints the sentences about missing rows to standard error.
fn report_left_out(left_out: &[String]) {
    left_out.iter().for_each(|sentence| note(sentence));
}

/// Returns the rows of a measurement for a figure, and reports the missing ones.
pub(super) fn complete<R>(measured: Measured<R>) -> Vec<R> {
    report_left_out(&measured.left_out);
    measured.rows
}
