//! `tabulate pack`

use std::path::PathBuf;

use anyhow::{Context, bail, ensure};
use clap::value_parser;
use interp::schema::Parameter;
use interp::{Description, Table};

use super::{info, progress_bar, read_table, write_text};
use crate::certify::{certify, points_for};
use crate::scene::TOLERANCE;
use crate::{output, train};

/// Convert an HDF5 table to the packed form that `interp` loads without HDF5
///
/// Value for value, or with `--tolerance` in low-rank form, some 100 times smaller for four axes: it is compared with direct solves
/// at points of its own, and holds what is measured as its certificate. If it cannot keep the tolerance nothing is written and the
/// exit status is 1.
#[derive(clap::Args)]
pub struct Arguments {
    /// The HDF5 table
    #[arg(value_name = "TABLE.h5")]
    table: PathBuf,
    /// The packed table to write
    #[arg(short, long, value_name = "TABLE.bin")]
    output: PathBuf,
    /// Low-rank form with this relative tolerance, between the nodes as well as at them
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
        table = low_rank(&table, tolerance, arguments).with_context(|| arguments.table.display().to_string())?;
    }
    let bytes = table.to_packed()?;
    output::atomically(&arguments.output, |unfinished| std::fs::write(unfinished, &bytes))?;
    if arguments.tolerance.is_some() {
        let written = format!("{:15} {}, {} bytes\n", "written", arguments.output.display(), bytes.len());
        write_text(None, (info::describe(&table)? + &written).as_bytes())?;
    }
    Ok(())
}

/// How much of the room below the tolerance truncation may take at the nodes: the splines through its errors there are larger
/// between them. Measured: 1.35 times as large.
const SHARE: f64 = 0.6;
/// How often the truncation error is halved before the tolerance is given up.
const HALVINGS: u32 = 3;

/// The low-rank form of a table that keeps the tolerance, with the certificate that says so.
fn low_rank(table: &Table, tolerance: f64, arguments: &Arguments) -> anyhow::Result<Table> {
    let [least, most] = TOLERANCE;
    ensure!((least..=most).contains(&tolerance), "tolerance = {tolerance:?} is outside {least:e} to {most:e}");
    let description = Description { tolerance, ..table.description().clone() };
    let own = description.certificate;
    ensure!(
        own.max_error < tolerance,
        "its certified error {:.1e} leaves no room below the tolerance {tolerance:e}: make it with a smaller tolerance",
        own.max_error
    );
    let points = arguments.points.map_or(points_for(table), |points| points as usize);
    let seed = arguments.seed.unwrap_or(own.seed.wrapping_add(1));
    let (mut truncation, mut measured) = (SHARE * (tolerance - own.max_error), f64::NAN);
    for _ in 0..=HALVINGS {
        let axes = Parameter::ALL.map(|parameter| table.axis(parameter).to_vec());
        let mut packed = Table::from_low_rank(description.clone(), axes, train::compress(table, truncation)?)?;
        let bar = progress_bar(points, "checking");
        packed.set_certificate(certify(&packed, points, seed, &|count| bar.inc(count as u64))?);
        bar.finish_and_clear();
        measured = packed.description().certificate.max_error;
        if measured <= tolerance {
            return Ok(packed);
        }
        truncation *= 0.5;
    }
    bail!(
        "its low-rank form has a measured error of {measured:.1e}, more than the tolerance {tolerance:e}, though truncation adds no more than {:.1e} \
         at its nodes; its own certified error is {:.1e}: make it with a smaller tolerance",
        2.0 * truncation,
        own.max_error
    )
}
