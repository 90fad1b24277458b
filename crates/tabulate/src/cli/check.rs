//! `tabulate check`

use std::path::PathBuf;

use anyhow::ensure;
use clap::value_parser;

use super::{progress_bar, read_table, write_text};
use crate::certify::{certify, points_for};

/// Compare a table with direct solves at fresh points
///
/// Exit status 1 if the table does not hold what it says: if the largest error exceeds the tolerance, unless the certified one does already; if it
/// exceeds three times the certified one, which is more than chance makes of other points; or if, with 300 points or more, the median error does so
/// with the certified median. Errors below a fiftieth of the tolerance may be those of the solves, and count as none.
#[derive(clap::Args)]
pub struct Arguments {
    /// The table, HDF5 or packed
    table: PathBuf,
    /// Number of points [default: 2500 for each axis]
    #[arg(long, value_parser = value_parser!(u32).range(1..))]
    points: Option<u32>,
    /// Seed of the random ones [default: another than the certificate's]
    #[arg(long)]
    seed: Option<u64>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let table = read_table(&arguments.table)?;
    let description = table.description();
    let seed = arguments.seed.unwrap_or(description.certificate.seed.wrapping_add(1));
    let points = arguments.points.map_or(points_for(&table), |points| points as usize);
    let bar = progress_bar(points, "checking");
    let measured = certify(&table, points, seed, &|count| bar.inc(count as u64))?;
    bar.finish_and_clear();
    let certified = &description.certificate;
    let text = format!(
        "measured  max {:.1e}, median {:.1e} ({} points, seed {seed})\ncertified max {:.1e}, median {:.1e}; tolerance {:e}\n",
        measured.max_error,
        measured.median_error,
        measured.points,
        certified.max_error,
        certified.median_error,
        description.tolerance
    );
    write_text(None, text.as_bytes())?;
    let tolerance = if certified.max_error > description.tolerance { f64::INFINITY } else { description.tolerance };
    let by_chance = |certified: f64| (CHANCE * certified).max(SOLVES * description.tolerance).min(tolerance);
    let file = arguments.table.display();
    let (error, allowed) = (measured.max_error, by_chance(certified.max_error));
    ensure!(error <= allowed, "{file} does not hold what it says: its error is {error:.1e}, more than {allowed:.1e}");
    let (error, allowed) = (measured.median_error, by_chance(certified.median_error));
    ensure!(
        error <= allowed || points < ENOUGH,
        "{file} does not hold what it says: its median error is {error:.1e}, more than {allowed:.1e}"
    );
    Ok(())
}

/// How much larger an error may be at other points by chance: among the shipped tables it is up to 1.5 times.
const CHANCE: f64 = 3.0;
/// What the solves that are compared with may be off, in parts of the tolerance; a certified error may be smaller than that.
const SOLVES: f64 = 0.02;
/// Points from which on a median means something.
const ENOUGH: usize = 300;
