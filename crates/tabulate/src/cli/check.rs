//! `tabulate check`

use std::path::PathBuf;

use anyhow::ensure;
use clap::value_parser;

use super::{progress_bar, read_table, write_text};
use crate::certify::{certify, points_for};

/// Compare a table with direct solves at fresh random points
///
/// Exit status 1 if the largest error exceeds what the table says of itself: its tolerance, or its certified error where that is larger.
#[derive(clap::Args)]
pub struct Arguments {
    /// The table, HDF5 or packed
    table: PathBuf,
    /// Number of random points [default: 2500 for each axis]
    #[arg(long, value_parser = value_parser!(u32).range(1..))]
    points: Option<u32>,
    /// Seed of the random points [default: another than the certificate's]
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
    let text = format!(
        "measured  max {:.1e}, median {:.1e} ({} points, seed {seed})\ncertified max {:.1e}, median {:.1e}; tolerance {:e}\n",
        measured.max_error,
        measured.median_error,
        measured.points,
        description.certificate.max_error,
        description.certificate.median_error,
        description.tolerance
    );
    write_text(None, text.as_bytes())?;
    let allowed = description.tolerance.max(description.certificate.max_error);
    ensure!(
        measured.max_error <= allowed,
        "{} does not hold what it says: its error is {:.1e}, more than {allowed:.1e}",
        arguments.table.display(),
        measured.max_error
    );
    Ok(())
}
