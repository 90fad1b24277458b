//! `tabulate cost effects`

use std::path::PathBuf;

use anyhow::ensure;
use clap::value_parser;
use interp::Parameter;

use super::rows::Rows;
use crate::cli::generate::read_scene;
use crate::cli::progress::Bars;
use crate::cli::quantity::number;
use crate::measure;
use crate::table::Scene;
use cost::clock::Timing;
use cost::effects::{Row, markdown};

const TOLERANCE: f64 = 1e-4;
const POINTS: u32 = 2_000;

/// Measure effects: the cost of each, and the error of the load without it
///
/// Makes the table of a scene without its film, sphere compliance, substrate compliance, film
/// compressibility, adhesion or penetration. Compares the loads with those of the whole scene, by
/// direct solves. The shape of the sphere needs no other table: its row has the error of the
/// paraboloid at a = 0.3 R, and the time of a new material as a ratio. So does the row of the
/// interface: the error of a bonded film where it slides, and the time of one that slides. The rows of the finite range and of friction are the errors of a
/// pull-off load and of a flat punch without them. The row of the relaxation has the error of
/// an elastic load on approach and retract. Errors are relative to the adhesionless load at the same contact radius. A time
/// is printed as not measurable where it is the difference of two times and not above their noise.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate cost effects --data tables/figures/effects.csv",
    "tabulate cost effects tables/incompressible.toml --tolerance 1e-3 --points 1000",
))]
pub struct Arguments {
    /// The scene; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml", conflicts_with = "data")]
    scene: Option<PathBuf>,
    /// Relative tolerance of the tables, instead of the scene's
    #[arg(long, default_value_t = TOLERANCE, value_parser = number, conflicts_with = "data")]
    tolerance: f64,
    /// Number of random points at which loads are compared
    #[arg(long, default_value_t = POINTS, value_parser = value_parser!(u32).range(1..=crate::cli::points::MOST_POINTS), conflicts_with = "data")]
    points: u32,
    #[command(flatten)]
    rows: Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), Some(arguments.tolerance))?;
    ensure!(
        scene.parameters == Parameter::ALL,
        "the effects are those of one film whose moduli are given by e1_over_e2 and e0_over_e2: give a scene with these \
         axes, and without [stack]"
    );
    arguments.rows.report(
        arguments.scene.as_deref(),
        |timing| Ok(measured(&scene, arguments.points, timing)?.into()),
        markdown,
    )
}

/// Measures the effects of the default scene for a figure.
pub fn of_default() -> anyhow::Result<Vec<Row>> {
    measured(
        &read_scene(None, Some(TOLERANCE))?,
        POINTS,
        Timing::Thorough,
    )
}

/// Measures all rows, with bars.
fn measured(scene: &Scene, points: u32, timing: Timing) -> anyhow::Result<Vec<Row>> {
    let points = points as usize;
    Ok(measure::effects(scene, points, timing, &Bars::new())?)
}
