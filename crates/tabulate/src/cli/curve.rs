//! `tabulate curve`

use std::path::PathBuf;

use anyhow::ensure;
use clap::{ValueHint, value_parser};
use interp::{Contact, Mechanics, Probe, System, Validity};

use super::note;
use super::output::Output;
use super::points::{evenly, number};
use super::progress::progress_bar;
use super::system::SystemArguments;
use super::table_name::{self, TableName};
use crate::parallel::try_map;
use crate::report::LARGE_CONTACT;
use crate::solve::{curve as adaptive, solve};

/// Print the force curve of one system as CSV, in SI units
///
/// Each row is an equilibrium at one contact radius: contact_radius (m), load (N, positive in
/// compression), penetration (m), and the coordinates of the reduced JKR plot, jkr_abscissa =
/// a^(3/2) / (sqrt(pi) R) and jkr_ordinate = F / (sqrt(6 pi) a^(3/2)). At a small radius or a
/// negative load an equilibrium may be unstable. Under a probe without a radius of curvature the
/// coordinates of the plot are NaN; a flat punch has one row.
///
/// Without arguments the system is that of Barthel's Tables 1 and 2: an elastomer sphere of 1 mm on
/// an elastomer film of 1 um on silicon.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate curve",
    "tabulate curve --film-thickness 1e-5 --points 20 | cut -d, -f1-3",
    "tabulate curve --sphere-modulus inf --film-modulus 1e9 --film-poisson-ratio 0.4",
    "tabulate curve embedded --work-of-adhesion 0.1 -o curve.csv",
    "tabulate curve --probe rounded-cone --half-angle 70 --sphere-radius 1e-6 --to 5e-6",
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
    let Arguments { from, to, .. } = *arguments;
    let work_of_adhesion = arguments.system.work_of_adhesion;
    let tables = arguments.table.as_ref().and_then(TableName::path);
    let output = Output::new(
        arguments.output.as_deref(),
        [tables, arguments.system.shape.profile.as_deref()],
    )?;
    ensure!(
        from > 0.0 && to > from && to < f64::INFINITY,
        "the contact radii must run from > 0 to more than that: from {from} to {to}"
    );
    let system = arguments.system.system()?;
    let mechanics = Mechanics::new(&system)?;
    let punch = matches!(system.probe, Probe::FlatPunch { .. });
    if !punch {
        // Refuses too large a radius before any work.
        mechanics.edge_singularity(to, work_of_adhesion)?;
    }
    let contact = match &arguments.table {
        Some(name) => Some(name.read()?.contact(&system)?),
        None if matches!(system.probe, Probe::Paraboloid { .. }) => None,
        None => {
            let most = if punch {
                arguments.system.sphere_radius
            } else {
                to
            };
            Some(contact(&system, most, arguments.tolerance)?)
        }
    };
    let rows = if let (true, Some(contact)) = (punch, &contact) {
        // The only contact radius of a punch.
        let a = arguments.system.sphere_radius;
        let (load, penetration) = contact.load_and_penetration(a, work_of_adhesion)?;
        vec![[a, load, penetration, f64::NAN, f64::NAN]]
    } else {
        rows(arguments, &system, &mechanics, contact.as_ref())?
    };
    let paraboloid = matches!(system.probe, Probe::Paraboloid { .. });
    if paraboloid && to > Validity::WARNING_A_OVER_R * arguments.system.sphere_radius {
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

/// Makes the contact of any shape up to contact radius `most` from solves of its material alone.
fn contact(system: &System, most: f64, tolerance: f64) -> anyhow::Result<Contact> {
    /// The `a/t` from which on the shape is integrated over the curve.
    const BEGIN: f64 = 1e-3;
    /// How far the curve reaches beyond the largest contact, because the integrals do.
    const BEYOND: f64 = 1.5;
    let end = (BEYOND * most / system.film_thickness).max(10.0 * BEGIN);
    let curve = adaptive(&system.material()?, [BEGIN, end], tolerance)?;
    Ok(Contact::new(system, curve)?)
}

/// Computes the rows at all contact radii; without a contact, by a solve for each.
fn rows(
    arguments: &Arguments,
    system: &System,
    mechanics: &Mechanics,
    contact: Option<&Contact>,
) -> anyhow::Result<Vec<[f64; 5]>> {
    let Arguments {
        from, to, points, ..
    } = *arguments;
    let work_of_adhesion = arguments.system.work_of_adhesion;
    let material = system.material()?;
    let bar = progress_bar(points as usize, "solving");
    let row = |i: u32| {
        let a = evenly([from, to], i, points);
        let (load, penetration) = match contact {
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
    Ok(rows)
}
