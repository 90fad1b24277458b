//! `tabulate cost effects`

use std::path::PathBuf;

use clap::value_parser;

use super::Rows;
use crate::cli::generate::{Bars, read_scene};
use crate::cost::effects::{Row, markdown, measure};
use crate::table::Scene;

const TOLERANCE: f64 = 1e-4;
const POINTS: u32 = 10_000;

/// The effects of a scene: what each one costs, and what the load would be without it
///
/// Makes the table of a scene without its film, sphere compliance, substrate compliance, film
/// compressibility, adhesion or penetration, and compares the loads with those of the whole scene,
/// by direct solves. Errors are relative to the adhesionless load at the same contact radius.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml", conflicts_with = "data")]
    scene: Option<PathBuf>,
    /// Relative tolerance of the tables, instead of the scene's
    #[arg(long, default_value_t = TOLERANCE, allow_negative_numbers = true, conflicts_with = "data")]
    tolerance: f64,
    /// Number of random points that the loads are compared at
    #[arg(long, default_value_t = POINTS, value_parser = value_parser!(u32).range(1..), conflicts_with = "data")]
    points: u32,
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), Some(arguments.tolerance))?;
    arguments.rows.report(
        arguments.scene.as_deref(),
        || measured(&scene, arguments.points),
        markdown,
    )
}

/// The effects of the default scene.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    measured(&read_scene(None, Some(TOLERANCE))?, POINTS)
}

fn measured(scene: &Scene, points: u32) -> anyhow::Result<Vec<Row>> {
    let bars = Bars::new();
    let rows = measure(scene, points as usize, &bars);
    bars.clear();
    Ok(rows?)
}
