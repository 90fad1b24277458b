//! `tabulate generate`

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, bail};
use clap::value_parser;
use interp::{Description, Material, Table};

use super::{info, progress_bar, write_text};
use crate::certify::certify;
use crate::scene::Scene;
use crate::sweep::sweep;
use crate::{archive, output};

/// The four-parameter scene that is made when no other is named.
const DEFAULT_SCENE: &str = include_str!("../../../../tables/default.toml");

/// Solve every node of a scene and write the HDF5 table
///
/// Afterwards the table is compared with direct solves at random points between its nodes; the largest and the median error are
/// stored in it. If the largest exceeds the tolerance the table is kept and the exit status is 1.
/// In a scene the moduli are Young's moduli over the sphere's reduced modulus E2*, see `tabulate --help`.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// The table to write [default: the scene's path with the ending .h5, or default.h5]
    #[arg(short, long, value_name = "TABLE.h5")]
    output: Option<PathBuf>,
    /// Relative tolerance between the nodes, instead of the scene's
    #[arg(long, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Number of threads [default: one per core]
    #[arg(long, value_parser = value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Number of random points of the certificate
    #[arg(long, default_value_t = 4000, value_parser = value_parser!(u32).range(1..))]
    certificate_points: u32,
    /// Seed of the random points
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = match &arguments.scene {
        Some(path) => Scene::read(path, arguments.tolerance)?,
        None => Scene::parse(DEFAULT_SCENE, arguments.tolerance).map_err(anyhow::Error::msg).context("the default scene")?,
    };
    let path = match (&arguments.output, &arguments.scene) {
        (Some(path), _) => path.clone(),
        (None, Some(scene)) => scene.with_extension("h5"),
        (None, None) => PathBuf::from("default.h5"),
    };
    // Better now than after the work.
    output::check(Some(&path), arguments.scene.as_deref())?;
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(arguments.jobs.unwrap_or(0)))
        .build()
        .context("cannot start threads")?;

    let start = Instant::now();
    let (points, certificate_points) = (scene.points(), arguments.certificate_points as usize);
    let bar = progress_bar(points, "solving");
    let values = threads.install(|| sweep(&scene, &|count| bar.inc(count as u64)))?;
    bar.finish_and_clear();
    let solved = start.elapsed();

    let [_, e1, nu1, e0] = scene.axes.each_ref().map(|axis| axis[0]);
    let description = Description {
        title: scene.title,
        scene: scene.text,
        nu0: scene.nu0,
        normalisation: Material::new(e1, nu1, e0, scene.nu0)?.normalisation(),
        tolerance: scene.tolerance,
        created_by: format!("tabulate {}", env!("CARGO_PKG_VERSION")),
        certificate: interp::Certificate {
            max_error: f64::NAN,
            median_error: f64::NAN,
            points: 0,
            seed: arguments.seed,
            details: None,
        },
    };
    let mut table = Table::new(description, scene.axes, values)?;
    let bar = progress_bar(certificate_points, "checking");
    let certificate = threads.install(|| certify(&table, certificate_points, arguments.seed, &|count| bar.inc(count as u64)))?;
    bar.finish_and_clear();
    table.set_certificate(certificate);
    archive::write(&table, &path)?;

    let summary = format!(
        "{}{:15} {points} points in {:.1} s, {:.1} s with the certificate\n{:15} {}\n",
        info::describe(&table)?,
        "solved",
        solved.as_secs_f64(),
        start.elapsed().as_secs_f64(),
        "written",
        path.display()
    );
    write_text(None, summary.as_bytes())?;
    let error = certificate.max_error;
    // Not an ordered comparison the other way round: NaN must not pass.
    let held = error <= table.description().tolerance;
    if !held {
        bail!(
            "{} is written, but its measured error {error:.1e} exceeds the tolerance {:e}: give its axes more nodes",
            path.display(),
            table.description().tolerance
        );
    }
    Ok(())
}
