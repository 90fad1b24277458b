//! `tabulate cost table`

use std::path::PathBuf;
use std::time::Duration;

use super::Rows;
use crate::cli::generate::{Bars, budget, read_scene};
use crate::cost::table::{Row, markdown, measure};
use crate::table::Scene;

/// In seconds.
const BUDGET: f64 = 60.0;

/// A table: tolerance against nodes, solves, time, bytes and certified error, and from how many
/// evaluations on it pays
///
/// Makes the tables of a scene to 1e-2, 1e-3 and so on to 1e-8, packs each to the same tolerance,
/// and stops before the one that would not be ready within the budget.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene, whose own tolerance plays no part; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml", conflicts_with = "data")]
    scene: Option<PathBuf>,
    /// Time for all tables together
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

/// The tables of the default scene within the default budget.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    measured(&read_scene(None, None)?, budget(BUDGET)?)
}

/// All rows, with bars; says what is left out.
fn measured(scene: &Scene, budget: Duration) -> anyhow::Result<Vec<Row>> {
    let bars = Bars::new();
    let measured = measure(scene, budget, &bars);
    bars.clear();
    let measured = measured?;
    if let Some((tolerance, why)) = measured.left_out {
        eprintln!("from {tolerance:e} on left out: {why}");
    }
    Ok(measured.rows)
}
