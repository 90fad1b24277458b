//! `tabulate unpack`

use std::path::PathBuf;

use clap::ValueHint;

use super::output::Output;
use super::table_name::{self, TableName, hdf5_file};
use crate::table;

/// Convert a packed table to HDF5
///
/// Value for value; of a table in low-rank form, the values at its nodes.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate unpack tables/paper.bin -o paper.h5",
    "tabulate unpack embedded -o universal.h5",
))]
pub struct Arguments {
    #[arg(value_name = "TABLE.bin", help = table_name::HELP, value_hint = ValueHint::FilePath)]
    table: TableName,
    /// The HDF5 table to write
    #[arg(short, long, value_name = "TABLE.h5", value_parser = hdf5_file())]
    output: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    Output::new(Some(&arguments.output), &[arguments.table.path()])?;
    let table = arguments.table.read()?;
    Ok(table::write(&table, &arguments.output)?)
}
