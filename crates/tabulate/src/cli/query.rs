//! `tabulate query`

use std::path::PathBuf;

use anyhow::Context;
use interp::Parameter;
use interp::{Quantity, Table};

use super::points::{self, Answer, Point};
use super::{read_table, write_text};
use crate::output;

/// Look up every point of a CSV file in a table
///
/// Prints the points with the interpolated pi0, eeq, gamma and delta0 and, as error, the table's
/// certified relative error; beyond its a/t that of the expansion about the limit, where it keeps
/// the table's tolerance. A point elsewhere outside the table is an error. The moduli are Young's
/// moduli over the sphere's reduced modulus E2*, see `tabulate --help`.
#[derive(clap::Args)]
pub struct Arguments {
    /// The table, HDF5 or packed
    table: PathBuf,
    /// CSV with the columns a_over_t, e1_over_e2, nu1, e0_over_e2 and perhaps nu0 (default: the
    /// table's), in any order
    #[arg(long, value_name = "IN.csv")]
    points: PathBuf,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
    /// Print the derivatives too: d_pi0_d_a_over_t, d_pi0_d_e1_over_e2, ..., d_delta0_d_nu0
    ///
    /// An empty field stands for a derivative that the table does not know, because its scene fixes
    /// a parameter. There are none above its a/t, and none in a table without all four quantities.
    #[arg(long)]
    gradient: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    output::check(arguments.output.as_deref(), Some(&arguments.points))?;
    let table = read_table(&arguments.table)?;
    let points = points::read(&arguments.points, table.description().nu0)?;
    let look_up = |point: &Point| {
        look_up(&table, point, arguments.gradient)
            .with_context(|| points::place(&arguments.points, point.line))
    };
    let answers = points
        .iter()
        .map(look_up)
        .collect::<anyhow::Result<Vec<_>>>()?;
    write_text(
        arguments.output.as_deref(),
        &points::format(&points, &answers)?,
    )
}

/// The quantities that the table holds at one point.
fn look_up(table: &Table, point: &Point, gradient: bool) -> Result<Answer, interp::Error> {
    let x = point.a_over_t;
    let curve = if gradient {
        table.curve_with_gradient(&point.material)
    } else {
        table.curve(&point.material)
    }?;
    let mut values = [None; 4];
    for quantity in table.quantities() {
        values[quantity as usize] = Some(curve.quantity(quantity, x)?);
    }
    let mut answer = Answer {
        values,
        error: curve.error(x)?,
        gradient: None,
    };
    if gradient {
        let gradient = curve.gradient(x)?;
        let by = [Parameter::E1OverE2, Parameter::Nu1, Parameter::E0OverE2]
            .map(|parameter| gradient.by(parameter).ok());
        let by = [by[0], by[1], by[2], gradient.by_nu0().ok()];
        answer.gradient = Some(Quantity::ALL.map(|quantity| {
            let [e1, nu1, e0, nu0] = by.map(|derivatives| Some(derivatives?.get(quantity)));
            [Some(gradient.slopes().get(quantity) / x), e1, nu1, e0, nu0]
        }));
    }
    Ok(answer)
}
