//! The command line: one module per subcommand.

mod check;
mod cost;
mod curve;
mod generate;
mod info;
mod pack;
mod plot;
mod points;
mod query;
mod report;
mod solve;
mod unpack;

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::ExitCode;

use anyhow::Context;
use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use interp::Table;

use crate::output;

/// Adhesive contact of a sphere (2) on a film (1) bonded to a substrate (0): solve it, tabulate it,
/// look it up.
///
/// a/t is contact radius over film thickness. E1/E2 and E0/E2 are Young's moduli of film and
/// substrate over the sphere's REDUCED modulus E2* = E2/(1 - nu2^2). E0/E2 = inf is a rigid
/// substrate. E1/E2 = 0 is a rigid sphere: then results are normalised by the film's reduced
/// modulus E1* instead of E2*, and E0/E2 is read as E0/E1.
#[derive(Parser)]
#[command(
    name = "tabulate",
    bin_name = "tabulate",
    version,
    max_term_width = 120
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Generate(generate::Arguments),
    Solve(solve::Arguments),
    Query(query::Arguments),
    Report(report::Arguments),
    Curve(curve::Arguments),
    Info(info::Arguments),
    Check(check::Arguments),
    Cost(cost::Arguments),
    Pack(pack::Arguments),
    Unpack(unpack::Arguments),
    Plot(plot::Arguments),
}

/// Runs the program on the process's arguments. Exit status 0, 1 (the work failed) or 2 (usage).
pub fn run() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Query(arguments) => query::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Curve(arguments) => curve::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Cost(arguments) => cost::run(&arguments),
        Command::Pack(arguments) => pack::run(&arguments),
        Command::Unpack(arguments) => unpack::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads our output may stop reading when it has enough.
        Err(error)
            if error
                .downcast_ref::<io::Error>()
                .is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe) =>
        {
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("tabulate: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Reads a table, HDF5 or packed, whichever its first bytes say.
fn read_table(path: &Path) -> anyhow::Result<Table> {
    let context = || path.display().to_string();
    let mut start = Vec::new();
    File::open(path)
        .and_then(|file| file.take(8).read_to_end(&mut start))
        .with_context(context)?;
    let table = if interp::is_packed(&start) {
        Table::read(path)
    } else {
        Table::open(path)
    };
    table.with_context(context)
}

/// Writes text to a file, complete or not at all, or to standard output.
fn write_text(path: Option<&Path>, text: &[u8]) -> anyhow::Result<()> {
    match path {
        Some(path) => Ok(output::atomically(path, |unfinished| {
            std::fs::write(unfinished, text)
        })?),
        None => {
            let mut out = io::stdout().lock();
            out.write_all(text)?;
            Ok(out.flush()?)
        }
    }
}

/// A bar on a terminal, nothing elsewhere.
fn progress_bar(length: usize, what: &str) -> ProgressBar {
    let style = ProgressStyle::with_template(
        "{msg:9} {wide_bar} {human_pos}/{human_len} {elapsed_precise} eta {eta_precise}",
    )
    .expect("the template is valid");
    ProgressBar::new(length as u64)
        .with_style(style)
        .with_message(what.to_owned())
}
