//! `tabulate curve`

use std::path::PathBuf;

use anyhow::ensure;
use clap::{ValueHint, value_parser};
use interp::{Contact, Mechanics, Validity};

use super::note;
use super::output::Output;
use super::points::{evenly, number};
use super::progress::progress_bar;
use super::pull_off;
use super::stack_file;
use super::system::SystemArguments;
use super::table_name::{self, TableName};
use crate::parallel::try_map;
use crate::report::LARGE_CONTACT;
use crate::solve::{solve, stack_curve};

/// Print the force curve of one system as CSV, in SI units
///
/// Each row is an equilibrium at one contact radius: contact_radius (m), load (N, positive in
/// compression), penetration (m), and the coordinates of the reduced JKR plot, jkr_abscissa =
/// a^(3/2) / (sqrt(pi) R) and jkr_ordinate = F / (sqrt(6 pi) a^(3/2)). At a small radius or a
/// negative load an equilibrium may be unstable.
///
/// With --interaction-range the attraction is not that of JKR, and there is a column outer_radius (m):
/// the radius within which it acts.
///
/// Without arguments the system is that of Barthel's Tables 1 and 2: an elastomer sphere of 1 mm on
/// an elastomer film of 1 um on silicon.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate curve",
    "tabulate curve --film-thickness 1e-5 --points 20 | cut -d, -f1-3",
    "tabulate curve --sphere-modulus inf --film-modulus 1e9 --film-poisson-ratio 0.4",
    "tabulate curve embedded --work-of-adhesion 0.1 -o curve.csv",
    "tabulate curve --stack tables/stacks/primer.toml --from 1e-5 --to 1e-4 --points 20",
))]
pub struct Arguments {
    #[arg(
        help = format!("{}. Without a table, every point is solved directly", table_name::HELP),
        value_hint = ValueHint::FilePath
    )]
    table: Option<TableName>,
    #[arg(
        long,
        value_name = "STACK.toml",
        help = format!("{}. It replaces film and substrate", stack_file::HELP),
        value_hint = ValueHint::FilePath,
        conflicts_with_all = [
            "table", "film_thickness", "film_modulus", "film_poisson_ratio", "substrate_modulus", "substrate_poisson_ratio",
        ],
    )]
    stack: Option<PathBuf>,
    #[command(flatten)]
    system: SystemArguments,
    /// Distance over which the attraction acts, m: a constant stress, the work of adhesion over this
    /// distance, wherever the gap is smaller (Dugdale's law). Without it the distance is 0 (JKR)
    #[arg(
        long,
        value_name = "M",
        conflicts_with = "table",
        allow_negative_numbers = true
    )]
    interaction_range: Option<f64>,
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
    let output = Output::new(
        arguments.output.as_deref(),
        [input, arguments.stack.as_deref()],
    )?;
    ensure!(
        from > 0.0 && to > from && to < f64::INFINITY,
        "the contact radii must run from > 0 to more than that: from {from} to {to}"
    );
    let stack = arguments
        .stack
        .as_ref()
        .map(|path| stack_file::read(path))
        .transpose()?;
    let system = match &stack {
        Some(stack) => {
            let SystemArguments {
                sphere_radius,
                sphere_modulus,
                ..
            } = arguments.system;
            stack.system(sphere_radius, sphere_modulus)
        }
        None => arguments.system.system()?,
    };
    let mechanics = Mechanics::new(&system)?;
    // Refuses too large a radius before any work.
    mechanics.edge_singularity(to, work_of_adhesion)?;
    let material = system.material()?;
    let contact = match (&arguments.table, &stack) {
        (Some(name), _) => Some(name.read()?.contact(&system)?),
        (None, Some(stack)) if arguments.interaction_range.is_none() => {
            let range = [from, to].map(|a| a / system.film_thickness);
            let curve = stack_curve(stack, system.sphere_modulus, range, arguments.tolerance)?;
            Some(Contact::new(&system, curve)?)
        }
        (None, _) => None,
    };

    let cohesive = arguments
        .interaction_range
        .map(|range| pull_off::cohesive(&arguments.system, stack.as_ref(), range))
        .transpose()?;

    let bar = progress_bar(points as usize, "solving");
    let row = |i: u32| {
        let a = evenly([from, to], i, points);
        let mut outer_radius = None;
        let (load, penetration) = match (&cohesive, &contact) {
            (Some(cohesive), _) => {
                let state = cohesive.state(a)?;
                outer_radius = Some(state.outer_radius);
                (state.load, state.penetration)
            }
            (None, Some(contact)) => contact.load_and_penetration(a, work_of_adhesion)?,
            (None, None) => {
                let edge = mechanics.edge_singularity(a, work_of_adhesion)?;
                let solution = solve(a / system.film_thickness, &material, arguments.tolerance)?;
                mechanics.load_and_penetration(a, edge, &solution.quantities)
            }
        };
        bar.inc(1);
        let jkr = mechanics.jkr_point(a, load);
        let row = [a, load, penetration, jkr.abscissa, jkr.ordinate];
        anyhow::Ok(row.into_iter().chain(outer_radius))
    };
    let rows = try_map(0..points, row)?;
    bar.finish_and_clear();
    if to > Validity::WARNING_A_OVER_R * system.sphere_radius {
        note(LARGE_CONTACT);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let columns = [
        "contact_radius",
        "load",
        "penetration",
        "jkr_abscissa",
        "jkr_ordinate",
    ];
    writer.write_record(
        columns
            .into_iter()
            .chain(cohesive.as_ref().map(|_| "outer_radius")),
    )?;
    for row in rows {
        writer.write_record(row.map(number))?;
    }
    output.write(&writer.into_inner()?)
}
