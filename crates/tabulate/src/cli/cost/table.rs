//! `tabulate cost table`

use std::path::PathBuf;
use std::time::Duration;

use anyhow::ensure;

use super::rows::{Rows, complete};
use crate::cli::generate::{budget, read_scene};
use crate::cli::progress::Bars;
use crate::cli::quantity::number;
use crate::measure;
use crate::table::{Budget, Scene};
use cost::Measured;
use cost::clock::Timing;
use cost::table::{Row, TOLERANCES, markdown};

/// The budget in seconds if neither --budget nor --to is given.
const BUDGET: f64 = 60.0;

/// Measure tables: nodes, solves, time, bytes and certified error for each tolerance
///
/// Makes the tables of a scene with the tolerances 1e-2, 1e-3, ..., 1e-8, and packs each with its
/// own tolerance. Stops before the first table that would not be ready within the budget, and names
/// it. The summary also states the break-even: the number of evaluations after which a table has
/// cost as much processor time as direct solves. A certified error is the largest at sampled
/// points.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost table --data tables/figures/table.csv",
    "tabulate cost table --budget 20 -o table.csv",
    "tabulate cost table --to 1e-4",
))]
pub struct Arguments {
    /// The scene, whose own tolerance is not used; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml", conflicts_with = "data")]
    scene: Option<PathBuf>,
    /// The time for all tables together [default: 60, or no limit with --to]
    #[arg(long, value_name = "SECONDS", value_parser = number, conflicts_with = "data")]
    budget: Option<f64>,
    /// Make the tables down to this tolerance, 1e-2 to 1e-8, on a machine of any speed
    #[arg(long, value_name = "TOLERANCE", value_parser = number, conflicts_with = "data")]
    to: Option<f64>,
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), None)?;
    let seconds = match (arguments.budget, arguments.to) {
        (None, None) => Some(BUDGET),
        (seconds, _) => seconds,
    };
    let budget = seconds.map(budget).transpose()?;
    let [loosest, .., tightest] = TOLERANCES;
    let to = arguments.to.unwrap_or(tightest);
    ensure!(
        to >= tightest && to <= loosest,
        "--to = {to:?}: it must be from {loosest:e} to {tightest:e}"
    );
    ensure!(
        scene.stack.is_none(),
        "the scene is of one stack of layers, and the cost is compared with that of solves of one film: give a \
         scene without [stack]"
    );
    arguments.rows.report(
        arguments.scene.as_deref(),
        |timing| measured(&scene, to, budget, timing),
        markdown,
    )
}

/// Measures the tables of the default scene within the default budget, for a figure.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    let [.., tightest] = TOLERANCES;
    let (scene, budget) = (read_scene(None, None)?, budget(BUDGET)?);
    Ok(complete(measured(
        &scene,
        tightest,
        Some(budget),
        Timing::Thorough,
    )?))
}

/// Measures all rows, with bars.
fn measured(
    scene: &Scene,
    tightest: f64,
    budget: Option<Duration>,
    timing: Timing,
) -> anyhow::Result<Measured<Row>> {
    let budget = budget.map(Budget::of);
    let measured = measure::table(scene, tightest, budget, timing, &Bars::new())?;
    Ok(measured)
}
