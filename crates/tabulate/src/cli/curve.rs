//! `tabulate curve`

use std::path::PathBuf;

use anyhow::ensure;
use clap::{ValueHint, value_parser};
use interp::{Mechanics, Validity};

use super::note;
use super::output::Output;
use super::points::{evenly, number};
use super::progress::progress_bar;
use super::system::SystemArguments;
use super::table_name::{self, TableName};
use crate::parallel::try_map;
use crate::report::LARGE_CONTACT;
use crate::solve::solve;

/// Print the force curve of one system as CSV, in SI units
///
/// Each row is an equilibrium at one contact radius: contact_radius (m), load (N, positive in
/// compression), penetration (m), and the coordinates of the reduced JKR plot, jkr_abscissa =
/// a^(3/2) / (sqrt(pi) R) and jkr_ordinate = F / (sqrt(6 pi) a^(3/2)). At a small radius or a
/// negative load an equilibrium may be unstable.
///
/// Without arguments the system is that of Barthel's Tables 1 and 2: an elastomer sphere of 1 mm on
/// an elastomer film of 1 um on silicon.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate curve",
    "tabulate curve --film-thickness 1e-5 --points 20 | cut -d, -f1-3",
    "tabulate curve --sphere-modulus inf --film-modulus 1e9 --film-poisson-ratio 0.4",
    "tabulate curve embedded --work-of-adhesion 0.1 -o curve.csv",
))]
pub struct Arguments {
    #[arg(
        help = format!("{}. Without a table, every point is solved directly", table_name::HELP),
        value_hint = ValueHint::FilePath
    )]
    table: Option<TableName>,
    #[command(flatten)]
    system: SystemArguments,
    /// Smallest contact radius, m
    #[arg(long, default_value = "1e-6", allow_negative_numbers = true)]
    from: f64,
    /// Largest contact radius, m. It must be below the sphere's radius R. The model takes it to be
    /// small beside R: above 0.3 R there is a warning
    #[arg(long, default_value = "1.5e-4", allow_negative_numbers = true)]
    to: f64,
    /// Number of contact radii, equally spaced
    #[arg(long, default_value_t = 150, value_parser = value_parser!(u32).range(2..=super::MOST_POINTS))]
    points: u32,
    /// Relative tolerance of direct solves
    #[arg(
        long,
        default_value = "1e-8",
        conflicts_with = "table",
        allow_negative_numbers = true
    )]
    tolerance: f64,
    /// Write the CSV here instead of to standard output
    #[arg(short, long, value_name = "OUT.csv")]
    output: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let Arguments {
        from,
        to,
        points,
        system: SystemArguments {
            work_of_adhesion, ..
        },
        ..
    } = *arguments;
    let input = arguments.table.as_ref().and_then(TableName::path);
    let output = Output::new(arguments.output.as_deref(), [input])?;
    ensure!(
        from > 0.0 && to > from && to < f64::INFINITY,
        "the contact radii must run from > 0 to more than that: from {from} to {to}"
    );
    let system = arguments.system.system()?;
    let mechanics = Mechanics::new(&system)?;
    // Refuses too large a radius before any work.
    mechanics.edge_singularity(to, work_of_adhesion)?;
    let material = system.material()?;
    let contact = arguments
        .table
        .as_ref()
        .map(|name| anyhow::Ok(name.read()?.contact(&system)?))
        .transpose()?;

    let bar = progress_bar(points as usize, "solving");
    let row = |i: u32| {
        let a = evenly([from, to], i, points);
        let (load, penetration) = match &contact {
            Some(contact) => contact.load_and_penetration(a, work_of_adhesion)?,
            None => {
                let edge = mechanics.edge_singularity(a, work_of_adhesion)?;
                let solution = solve(a / system.film_thickness, &material, arguments.tolerance)?;
                mechanics.load_and_penetration(a, edge, &solution.quantities)
            }
        };
        bar.inc(1);
        let jkr = mechanics.jkr_point(a, load);
        anyhow::Ok([a, load, penetration, jkr.abscissa, jkr.ordinate])
    };
    let rows = try_map(0..points, row)?;
    bar.finish_and_clear();
    if to > Validity::WARNING_A_OVER_R * arguments.system.sphere_radius {
        note(LARGE_CONTACT);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "contact_radius",
        "load",
        "penetration",
        "jkr_abscissa",
        "jkr_ordinate",
    ])?;
    for row in rows {
        writer.write_record(row.map(number))?;
    }
    output.write(&writer.into_inner()?)
}
