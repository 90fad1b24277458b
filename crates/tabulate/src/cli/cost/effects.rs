//! `tabulate cost effects`

use std::path::PathBuf;

use clap::value_parser;

use super::report;
use crate::cli::generate::{Bars, read_scene};
use crate::cost::effects::{markdown, measure};
use crate::output;

/// The effects of a scene: what each one costs, and what the load would be without it
///
/// Makes the table of a scene without its film, sphere compliance, substrate compliance, film compressibility, adhesion or
/// penetration, and compares the loads with those of the whole scene, by direct solves. Errors are relative to the adhesionless load
/// at the same contact radius.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// Relative tolerance of the tables, instead of the scene's
    #[arg(long, default_value = "1e-4", allow_negative_numbers = true)]
    tolerance: f64,
    /// Number of random points that the loads are compared at
    #[arg(long, default_value_t = 10_000, value_parser = value_parser!(u32).range(1..))]
    points: u32,
    /// Write all rows here, as CSV
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), Some(arguments.tolerance))?;
    output::check(arguments.output.as_deref(), arguments.scene.as_deref())?;
    let bars = Bars::new();
    let rows = measure(&scene, arguments.points as usize, &bars);
    bars.clear();
    let rows = rows?;
    report(arguments.output.as_deref(), &rows, &markdown(&rows))
}
