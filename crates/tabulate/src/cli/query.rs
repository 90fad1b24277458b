//! `tabulate query`

use std::path::PathBuf;

use anyhow::Context;
use interp::Table;

use super::points::{self, Point};
use super::{read_table, write_text};
use crate::output;

/// Look up every point of a CSV file in a table
///
/// Prints the points with the interpolated pi0, eeq, gamma and delta0 and, as error, the table's certified relative error. A point outside
/// the table is an error. The moduli are Young's moduli over the sphere's reduced modulus E2*, see `tabulate --help`.
#[derive(clap::Args)]
pub struct Arguments {
    /// The table, HDF5 or packed
    table: PathBuf,
    /// CSV with the columns a_over_t, e1_over_e2, nu1, e0_over_e2 and perhaps nu0 (default: the table's), in any order
    #[arg(long, value_name = "IN.csv")]
    points: PathBuf,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    output::check(arguments.output.as_deref(), Some(&arguments.points))?;
    let table = read_table(&arguments.table)?;
    let points = points::read(&arguments.points, table.description().nu0)?;
    let error = table.description().certificate.max_error;
    let look_up = |point: &Point| {
        let values = look_up(&table, point).with_context(|| points::place(&arguments.points, point.line))?;
        Ok((values, error))
    };
    let results = points.iter().map(look_up).collect::<anyhow::Result<Vec<_>>>()?;
    write_text(arguments.output.as_deref(), &points::format(&points, &results)?)
}

/// The quantities that the table holds at one point.
fn look_up(table: &Table, point: &Point) -> Result<[Option<f64>; 4], interp::Error> {
    let curve = table.curve(&point.material)?;
    let mut values = [None; 4];
    for quantity in table.quantities() {
        values[quantity as usize] = Some(curve.quantity(quantity, point.a_over_t)?);
    }
    Ok(values)
}
