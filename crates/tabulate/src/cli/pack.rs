//! `tabulate pack`

use std::path::PathBuf;

use anyhow::Context;
use clap::value_parser;

use super::generate::Bars;
use super::{info, read_table, write_text};
use crate::output;
use crate::table::low_rank;
use crate::table::points_for;

/// Convert an HDF5 table to the packed form that `interp` loads without HDF5
///
/// Value for value, or with `--tolerance` in low-rank form, some 100 times smaller for four axes:
/// it is compared with direct solves at points of its own, and holds what is measured as its
/// certificate. If it cannot keep the tolerance nothing is written and the exit status is 1.
#[derive(clap::Args)]
pub struct Arguments {
    /// The HDF5 table
    #[arg(value_name = "TABLE.h5")]
    table: PathBuf,
    /// The packed table to write
    #[arg(short, long, value_name = "TABLE.bin")]
    output: PathBuf,
    /// Low-rank form with this relative tolerance, between the nodes as well as at them
    ///
    /// Derivatives with respect to nu1 of incompressible films are kept about as well as the table
    /// has them, and to 75 tolerances where it was generated to a fifth of this tolerance.
    #[arg(long, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Number of points of the certificate [default: 2500 for each axis]
    #[arg(long, requires = "tolerance", value_parser = value_parser!(u32).range(1..))]
    points: Option<u32>,
    /// Seed of the random ones [default: another than the table's]
    #[arg(long, requires = "tolerance")]
    seed: Option<u64>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    output::check(Some(&arguments.output), Some(&arguments.table))?;
    let mut table = read_table(&arguments.table)?;
    if let Some(tolerance) = arguments.tolerance {
        let points = arguments
            .points
            .map_or(points_for(&table), |points| points as usize);
        let seed = arguments
            .seed
            .unwrap_or(table.description().certificate.seed.wrapping_add(1));
        let bars = Bars::new();
        let packed = low_rank(&table, tolerance, points, seed, &bars);
        bars.clear();
        table = packed.with_context(|| arguments.table.display().to_string())?;
    }
    let bytes = table.to_packed()?;
    output::atomically(&arguments.output, |unfinished| {
        std::fs::write(unfinished, &bytes)
    })?;
    if arguments.tolerance.is_some() {
        let written = format!(
            "{:15} {}, {} bytes\n",
            "written",
            arguments.output.display(),
            bytes.len()
        );
        write_text(None, (info::describe(&table)? + &written).as_bytes())?;
    }
    Ok(())
}
