//! `tabulate query`

use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use anyhow::ensure;
use clap::ValueHint;
use interp::{MaterialParameter, Parameter, Quantity, SubstratePoissonRatio, Table};

use super::note;
use super::output::Output;
use super::points::{Answer, COLUMNS, Given, Point, Points};
use super::table_name::{self, TableName};
use crate::table::{DEFAULT_NU0, stack_of};
use crate::{Error, printable};
use solve::stack::Stack;

/// Look up every point of a CSV file in a table
///
/// Prints the points with the interpolated pi0, eeq, gamma and delta0. A table of gamma alone, as
/// the embedded one, answers all four. The column error is the certified relative error of the
/// table: the largest of all quantities that it answers, at sampled points. A field is empty where
/// the table answers no such quantity, and a note says why. At an a/t outside the
/// table, the values and the error are those of the expansion about the limit of a thin or a thick
/// film, where that keeps the tolerance of the table. Any other point outside the table is an
/// error. Points are answered in batches: at an error, those before the batch are printed already,
/// and a file is not written. The moduli are Young's moduli over the sphere's reduced modulus E2*, see
/// `tabulate --help`.
///
/// A table of one stack of layers has no answers beyond its a/t. Its points have the columns
/// a_over_t, with the thickness of all layers, and e1_over_e2, of the top layer, alone.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate query embedded --points tables/points.csv",
    "tabulate query tables/paper.h5 --points tables/points.csv --gradient -o values.csv",
))]
pub struct Arguments {
    #[arg(help = table_name::HELP, value_hint = ValueHint::FilePath)]
    table: TableName,
    /// CSV with the columns a_over_t, e1_over_e2, nu1, e0_over_e2 and optionally nu0 (default: the
    /// table's, or 0.25 if the table is made for every nu0), in any order
    #[arg(long, value_name = "IN.csv")]
    points: PathBuf,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
    /// Print the derivatives too: d_pi0_d_a_over_t, d_pi0_d_e1_over_e2, ..., d_delta0_d_nu0
    ///
    /// A field is empty where the scene of the table fixes the parameter to a finite value, and 0 with
    /// respect to a rigid substrate. There are no derivatives
    /// above the a/t of the table, and none from a table that does not answer all four quantities.
    #[arg(long)]
    gradient: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let output = Output::of_text(
        arguments.output.as_deref(),
        &[Some(&arguments.points), arguments.table.path()],
    )?;
    let table = arguments.table.read_for_contacts()?;
    let nu0 = match table.description().nu0 {
        SubstratePoissonRatio::Fixed(nu0) => nu0,
        SubstratePoissonRatio::Paired => DEFAULT_NU0,
    };
    let stack = stack_of(&table)?.map(|named| named.stack);
    ensure!(
        stack.is_none() || !arguments.gradient,
        "{} is of one stack of layers, which has no derivatives: leave out --gradient",
        arguments.table
    );
    let given = match &stack {
        None => Given::Films { nu0 },
        Some(_) => Given::Stack {
            nu1: table.axis(Parameter::Nu1)[0],
            e0_over_e1: table.axis(Parameter::E0OverE1)[0],
            nu0,
        },
    };
    let points = Points::open(&arguments.points, given)?;
    let derivatives = Quantity::ALL
        .iter()
        .flat_map(|quantity| COLUMNS.map(|column| format!("d_{}_d_{column}", quantity.name())))
        .filter(|_| arguments.gradient);
    let further: Vec<String> = derivatives.collect();
    let refused: Mutex<Option<(u64, interp::Error)>> = Mutex::new(None);
    points.answer("looking up", &output, &further, |point| {
        let (answer, refusal) = look_up(&table, stack.as_ref(), point, arguments.gradient)?;
        if let Some(refusal) = refusal {
            let mut first = refused.lock().unwrap_or_else(PoisonError::into_inner);
            if first.as_ref().is_none_or(|(line, _)| point.line < *line) {
                *first = Some((point.line, refusal));
            }
        }
        Ok(answer)
    })?;
    if let Some((line, refusal)) = refused.into_inner().unwrap_or_else(PoisonError::into_inner) {
        let path = printable::path(&arguments.points);
        note(&format!("{path}, line {line}: fields are empty: {refusal}"));
    }
    Ok(())
}

/// Looks up the quantities that `table` answers at one point. Returns why it answers no other, too.
fn look_up(
    table: &Table,
    stack: Option<&Stack>,
    point: &Point,
    gradient: bool,
) -> Result<(Answer, Option<interp::Error>), Error> {
    let x = point.a_over_t;
    let curve = match stack {
        Some(stack) => table.stack_curve(point.material.e1_over_e2(), stack.shape())?,
        None if gradient => table.curve_with_gradient(&point.material)?,
        None => table.curve(&point.material)?,
    };
    let (mut values, mut refusal) = ([None; 4], None);
    for (quantity, value) in Quantity::ALL.into_iter().zip(&mut values) {
        match curve.quantity(quantity, x) {
            Err(error) if !curve.answers(quantity) => refusal = refusal.or(Some(error)),
            found => *value = Some(found?),
        }
    }
    let mut answer = Answer {
        values,
        error: curve.error(x)?,
        further: Vec::new(),
    };
    if gradient {
        let gradient = curve.gradient(x)?;
        let by = MaterialParameter::ALL.map(|parameter| gradient.by(parameter).ok());
        let derivatives = |quantity| {
            let [e1, nu1, e0, nu0] = by.map(|derivatives| Some(derivatives?.get(quantity)));
            let slope = gradient.slopes().get(quantity);
            let by_a_over_t = (!slope.is_nan()).then_some(slope / x);
            [by_a_over_t, e1, nu1, e0, nu0]
        };
        answer
            .further
            .extend(Quantity::ALL.into_iter().flat_map(derivatives));
    }
    Ok((answer, refusal))
}
