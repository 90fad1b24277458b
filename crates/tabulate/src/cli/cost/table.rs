//! `tabulate cost table`

use std::path::PathBuf;
use std::time::Duration;

use super::Rows;
use crate::cli::generate::{budget, read_scene};
use crate::cli::note;
use crate::cli::progress::Bars;
use crate::cost::table::{Row, markdown, measure};
use crate::table::Scene;

/// The default budget in seconds.
const BUDGET: f64 = 60.0;

/// Measure tables: nodes, solves, time, bytes and certified error for each tolerance
///
/// Makes the tables of a scene with the tolerances 1e-2, 1e-3, ..., 1e-8, and packs each with its
/// own tolerance. Stops before the first table that would not be ready within the budget. The
/// summary also states the number of evaluations from which on a table is faster than direct
/// solves. A certified error is the largest at sampled points.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost table --data tables/figures/table.csv",
    "tabulate cost table --budget 20 -o table.csv",
))]
pub struct Arguments {
    /// The scene, whose own tolerance is not used; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml", conflicts_with = "data")]
    scene: Option<PathBuf>,
    /// The time for all tables together
    #[arg(long, value_name = "SECONDS", default_value_t = BUDGET, allow_negative_numbers = true, conflicts_with = "data")]
    budget: f64,
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), None)?;
    let budget = budget(arguments.budget)?;
    arguments.rows.report(
        arguments.scene.as_deref(),
        || measured(&scene, budget),
        markdown,
    )
}

/// Measures the tables of the default scene within the default budget.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    measured(&read_scene(None, None)?, budget(BUDGET)?)
}

/// Measures all rows, with bars, and prints a note on the tables that are left out.
fn measured(scene: &Scene, budget: Duration) -> anyhow::Result<Vec<Row>> {
    let bars = Bars::new();
    let measured = measure(scene, budget, &bars);
    bars.clear();
    let measured = measured?;
    if let Some((tolerance, why)) = measured.left_out {
        note(&format!("from {tolerance:e} on left out: {why}"));
    }
    Ok(measured.rows)
}
