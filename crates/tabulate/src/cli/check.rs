//! `tabulate check`

use std::path::PathBuf;

use anyhow::ensure;
use clap::value_parser;

use super::{progress_bar, read_table, write_text};
use crate::table::{certify, points_for};

/// Compare a table with direct solves at fresh points
///
/// Exit status 1 if the table does not hold what it says: if the largest error exceeds its
/// tolerance, or its certified error where that is larger; or if the largest or the median error
/// exceeds three times the certified one and a fiftieth of the tolerance, which is more than chance
/// makes of other points. The latter takes 1000 points, here and in the certificate.
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
    let seed = arguments
        .seed
        .unwrap_or(description.certificate.seed.wrapping_add(1));
    let points = arguments
        .points
        .map_or(points_for(&table), |points| points as usize);
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
    let file = arguments.table.display();
    let claimed = description.tolerance.max(certified.max_error);
    // Of few points, neither the largest error nor the median is that of others.
    let comparable = points >= ENOUGH && certified.points >= ENOUGH as u64;
    let by_chance = |certified: f64| {
        if comparable {
            (CHANCE * certified).max(SOLVES * description.tolerance)
        } else {
            f64::INFINITY
        }
    };
    for (what, error, certified) in [
        ("error", measured.max_error, certified.max_error),
        (
            "median error",
            measured.median_error,
            certified.median_error,
        ),
    ] {
        let allowed = claimed.min(by_chance(certified));
        ensure!(
            error <= allowed,
            "{file} does not hold what it says: its {what} is {error:.1e}, more than {allowed:.1e}"
        );
    }
    Ok(())
}

/// How much larger an error may be at other points by chance: among the shipped tables it is up to
/// 1.5 times.
const CHANCE: f64 = 3.0;
/// What the solves that are compared with may be off, in parts of the tolerance; a certified error
/// may be smaller than that.
const SOLVES: f64 = 0.02;
/// Points from which on errors are compared with certified ones.
const ENOUGH: usize = 1000;
