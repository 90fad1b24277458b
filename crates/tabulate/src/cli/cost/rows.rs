//! The files of the rows that are measured, and their summary.

use std::path::{Path, PathBuf};

use anyhow::Context;
use cost::clock::Timing;
use cost::{Measured, Measurement, compare, to_csv};

use crate::cli::output::Output;
use crate::cli::{note, print};
use crate::measure::read_csv;
use crate::printable;

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
        let before = self
            .compare
            .as_ref()
            .map(|path| anyhow::Ok((path, read_csv::<R>(path)?)))
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
