//! `tabulate report`

use std::path::PathBuf;

use anyhow::Context;
use clap::ValueHint;

use super::output::Output;
use super::progress::progress_bar;
use super::sized_probe::SizedProbeArguments;
use super::table_name::{self, TableName};
use crate::report::{figures, report, steps};

/// Write an HTML page about a table, with force curves that follow sliders
///
/// The page shows the range of the table, its certificate, a map of its errors (of a table over
/// e1_over_e2), and the force curve of any system in the table. The page computes the curve, accurately
/// enough for a picture, and shows numbers with four digits. It is one file and needs no network.
///
/// The page opens with --probe, one of paraboloid, sphere and flat-punch; it computes no other.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate report tables/paper.h5 -o paper.html",
    "tabulate report embedded -o report.html",
    "tabulate report embedded --probe flat-punch --sphere-radius 1e-5 -o punch.html",
))]
pub struct Arguments {
    #[arg(help = table_name::HELP, value_hint = ValueHint::FilePath)]
    table: TableName,
    #[command(flatten)]
    probe: SizedProbeArguments,
    /// The page to write
    #[arg(short, long, value_name = "REPORT.html")]
    output: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let output = Output::of_text(
        Some(&arguments.output),
        &[
            arguments.table.path(),
            arguments.probe.shape.profile.as_deref(),
        ],
    )?;
    let probe = arguments.probe.probe()?;
    let table = arguments.table.read()?;
    let bar = progress_bar(steps(&table), "drawing");
    let page = figures(&table, &|count| bar.inc(count as u64))
        .and_then(|figures| report(&table, &figures, &probe));
    bar.finish_and_clear();
    output.write(
        page.with_context(|| arguments.table.to_string())?
            .as_bytes(),
    )
}
