//! `tabulate check`

use std::collections::BTreeMap;
use std::fmt::Write;

use anyhow::ensure;
use clap::{ValueHint, value_parser};
use serde_json::json;

use super::json;
use super::print;
use super::progress::progress_bar;
use super::table_name::{self, TableName};
use crate::table::{certificate, errors_by_quantity, measure, points_for};

/// Compare a table with direct solves at new points
///
/// The certificate of a table is the largest error at the points at which it was measured before.
/// The exit status is 1 if the table is worse than its certificate. The largest error must not
/// exceed the tolerance, or the certified error where that is larger. The largest and the median
/// error must not exceed three times the certified one, or a fiftieth of the tolerance where that
/// is larger: by chance, other points do not differ more. This second condition needs 1000 points
/// or more, here and in the certificate.
///
/// The errors of each quantity that the table answers are printed, too. A table of gamma alone
/// answers all four.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate check tables/paper.h5",
    "tabulate check embedded --points 1000 --seed 7",
    "tabulate check tables/paper.bin --points 1000 --json",
))]
pub struct Arguments {
    #[arg(help = table_name::HELP, value_hint = ValueHint::FilePath)]
    table: TableName,
    /// Number of points [default: 2500 for each axis]
    #[arg(long, value_parser = value_parser!(u32).range(1..=super::points::MOST_POINTS))]
    points: Option<u32>,
    /// Seed of the random points [default: another than the certificate's]
    #[arg(long)]
    seed: Option<u64>,
    /// Print one JSON object
    ///
    /// The fields are measured and certified (each with the fields of the certificate, see
    /// `tabulate info --help`), quantities (max_error and median_error of each that the table
    /// answers), tolerance, and holds: whether the exit status is 0.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let table = arguments.table.read()?;
    let description = table.description();
    let seed = arguments
        .seed
        .unwrap_or(description.certificate.seed.wrapping_add(1));
    let points = arguments
        .points
        .map_or(points_for(&table), |points| points as usize);
    let bar = progress_bar(points, "checking");
    let samples = measure(&table, points, seed, &|count| bar.inc(count as u64))?;
    bar.finish_and_clear();
    let measured = certificate(&samples, seed);
    let by_quantity = errors_by_quantity(&samples).into_iter();
    let certified = &description.certificate;
    let claimed = description.tolerance.max(certified.max_error);
    // With few points, neither the largest error nor the median is comparable to that of others.
    let comparable = points >= ENOUGH && certified.points >= ENOUGH as u64;
    let by_chance = |certified: f64| {
        if comparable {
            (CHANCE * certified).max(SOLVES * description.tolerance)
        } else {
            f64::INFINITY
        }
    };
    let errors = [
        ("error", measured.max_error, certified.max_error),
        (
            "median error",
            measured.median_error,
            certified.median_error,
        ),
    ]
    .map(|(name, error, certified)| (name, error, claimed.min(by_chance(certified))));
    // Not an ordered comparison the other way round: NaN must not pass.
    let holds = |error: f64, allowed: f64| error <= allowed;
    if arguments.json {
        let object = |[max, median]: [f64; 2]| json!({ "max_error": max, "median_error": median });
        let quantities: BTreeMap<_, _> = by_quantity
            .map(|(quantity, errors)| (quantity.name(), object(errors)))
            .collect();
        let mut errors = errors.iter();
        json::print(&json!({
            "measured": json::errors(&measured, table.parameters()),
            "certified": json::errors(certified, table.parameters()),
            "quantities": quantities,
            "tolerance": description.tolerance,
            "holds": errors.all(|(_, error, allowed)| holds(*error, *allowed)),
        }))?;
    } else {
        let mut text = format!(
            "measured  max {:.1e}, median {:.1e} ({} points, seed {seed})\ncertified max {:.1e}, median {:.1e}; tolerance {:e}\n",
            measured.max_error,
            measured.median_error,
            measured.points,
            certified.max_error,
            certified.median_error,
            description.tolerance
        );
        for (quantity, [max, median]) in by_quantity {
            writeln!(
                text,
                "{:9} max {max:.1e}, median {median:.1e}",
                quantity.name()
            )?;
        }
        print(text.as_bytes())?;
    }
    let more = (certified.points.saturating_mul(MORE))
        .clamp(ENOUGH as u64, super::points::MOST_POINTS.unsigned_abs());
    for (name, error, allowed) in errors {
        ensure!(
            holds(error, allowed),
            "{} is less accurate than it states: its {name} is {error:.3e}, more than {allowed:.3e}; make it anew with \
             `tabulate generate SCENE.toml --certificate-points {more}`, or a packed one with `tabulate pack TABLE.h5 -o TABLE.bin \
             --points {more}`: at more points, larger errors are found",
            arguments.table
        );
    }
    Ok(())
}

/// How much larger an error may be at other points by chance. The shipped tables reach 1.5.
const CHANCE: f64 = 3.0;
/// How many more points a new certificate shall have.
const MORE: u64 = 10;
/// The error of the direct solves in parts of the tolerance: a certified error may be smaller than
/// that.
const SOLVES: f64 = 0.02;
/// The number of points from which on errors are compared with certified ones.
const ENOUGH: usize = 1000;
