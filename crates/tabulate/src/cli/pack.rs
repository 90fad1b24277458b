//! `tabulate pack`

use std::borrow::Cow;
use std::path::PathBuf;

use anyhow::Context;
use clap::{ValueHint, value_parser};

use super::json;
use super::output::Output;
use super::progress::Bars;
use super::quantity::number;
use super::table_name::{self, TableName, packed_file};
use super::{info, print};
use crate::printable;
use crate::table::low_rank;

/// Convert a table to the packed form that `interp` loads without HDF5
///
/// Value for value, or with --tolerance in low-rank form, which is some 100 times smaller for four
/// axes. The low-rank form is compared with direct solves at points of its own. The largest error
/// found is stored in it, as its certificate. If it exceeds the tolerance, nothing is written, and
/// the exit status is 1.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate pack tables/paper.h5 -o paper.bin",
    "tabulate pack tables/paper.h5 -o small.bin --tolerance 1e-6",
))]
pub struct Arguments {
    #[arg(value_name = "TABLE.h5", help = table_name::HELP, value_hint = ValueHint::FilePath)]
    table: TableName,
    /// The packed table to write
    #[arg(short, long, value_name = "TABLE.bin", value_parser = packed_file())]
    output: PathBuf,
    /// Use the low-rank form, with this relative tolerance between the nodes and at them
    ///
    /// Generate the table to a third of this tolerance or less, which leaves room for the
    /// truncation. The certificate does not cover derivatives.
    #[arg(long, value_parser = number)]
    tolerance: Option<f64>,
    /// Number of points of the certificate [default: 2500 for each axis]
    #[arg(long, requires = "tolerance", value_parser = value_parser!(u32).range(1..=super::points::MOST_POINTS))]
    points: Option<u32>,
    /// Seed of the random points [default: another than the table's]
    #[arg(long, requires = "tolerance")]
    seed: Option<u64>,
    /// Print one JSON object: the fields of `tabulate info --json`, then path
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let output = Output::new(Some(&arguments.output), &[arguments.table.path()])?;
    let mut table = arguments.table.read()?;
    if let Some(tolerance) = arguments.tolerance {
        let points = arguments.points.map(|points| points as usize);
        let packed = low_rank(&table, tolerance, points, arguments.seed, &Bars::new());
        table = Cow::Owned(packed.with_context(|| arguments.table.to_string())?);
    }
    let bytes = table.to_packed()?;
    output.write(&bytes)?;
    if arguments.json {
        let mut object = json::table(&table, bytes.len() as u64);
        object["path"] = arguments.output.display().to_string().into();
        return json::print(&object);
    }
    if arguments.tolerance.is_some() {
        let (path, bytes) = (printable::path(&arguments.output), bytes.len());
        let written = info::row("written", format_args!("{path}, {bytes} bytes"));
        print((info::describe(&table) + &written).as_bytes())?;
    }
    Ok(())
}
