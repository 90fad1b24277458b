//! `tabulate cost table`

use std::path::PathBuf;
use std::time::Duration;

use super::report;
use crate::cli::generate::{Bars, budget, read_scene};
use crate::cost::table::{Measured, Row, markdown, measure};
use crate::output;
use crate::scene::Scene;

/// In seconds.
const BUDGET: f64 = 60.0;

/// A table: tolerance against nodes, solves, time, bytes and certified error, and from how many evaluations on it pays
///
/// Makes the tables of a scene to 1e-2, 1e-3 and so on to 1e-8, packs each to the same tolerance, and stops before the one that
/// would not be ready within the budget.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene, whose own tolerance plays no part; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Time for all tables together
    #[arg(long, value_name = "SECONDS", default_value_t = BUDGET, allow_negative_numbers = true)]
    budget: f64,
    /// Write all rows here, as CSV
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), None)?;
    let budget = budget(arguments.budget)?;
    output::check(arguments.output.as_deref(), arguments.scene.as_deref())?;
    let measured = measured(&scene, budget)?;
    report(arguments.output.as_deref(), &measured.rows, &markdown(&measured))
}

/// The tables of the default scene within the default budget.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    Ok(measured(&read_scene(None, None)?, budget(BUDGET)?)?.rows)
}

fn measured(scene: &Scene, budget: Duration) -> anyhow::Result<Measured> {
    let bars = Bars::new();
    let measured = measure(scene, budget, &bars);
    bars.clear();
    Ok(measured?)
}
