//! `tabulate generate`

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use anyhow::{Context, bail, ensure};
use clap::value_parser;
use indicatif::ProgressBar;
use interp::Parameter;

use super::{info, progress_bar, write_text};
use crate::output;
use crate::table::Plan;
use crate::table::Scene;
use crate::table::default_points;
use crate::table::sweep;
use crate::table::{Budget, Generated, Observer, Options, generate};

/// The four-parameter scene that is made when no other is named.
const DEFAULT_SCENE: &str = include_str!("../../../../tables/default.toml");

/// Make the HDF5 table of a scene: choose the nodes, solve them, measure the accuracy
///
/// The nodes are chosen so that the splines between them keep the tolerance. Then the table is
/// compared with direct solves at other points, and what they say is stored in it; axes that hold
/// too large an error get more nodes, and the table is made again. A table that still exceeds its
/// tolerance, because the scene states its nodes or the budget is spent, is written, and the exit
/// status is 1.
///
/// Finished pieces are kept in TABLE.h5.unfinished until the table is complete, so that a run that
/// was killed goes on with --resume. An existing table is not touched until then. In a scene the
/// moduli are Young's moduli over the sphere's reduced modulus E2*, see `tabulate --help`.
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
    /// Go on from the finished pieces of a run of the same scene that was interrupted
    #[arg(long)]
    resume: bool,
    /// Print axes, nodes, solves, and the time, memory and bytes to expect, and make nothing
    #[arg(long)]
    plan: bool,
    /// Stop after this time, with what is finished
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    budget: Option<f64>,
    /// Number of points of the certificate [default: 2500 for each axis]
    #[arg(long, value_parser = value_parser!(u32).range(1..))]
    certificate_points: Option<u32>,
    /// Seed of the random ones
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), arguments.tolerance)?;
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(usize::from(arguments.jobs.unwrap_or(0)))
        .build()
        .context("cannot start threads")?;
    let points = arguments
        .certificate_points
        .map_or_else(|| default_points(scene.axes()), |points| points as usize);
    if arguments.plan {
        return threads.install(|| print_plan(&scene, points));
    }
    let path = match (&arguments.output, &arguments.scene) {
        (Some(path), _) => path.clone(),
        (None, Some(scene)) => scene.with_extension("h5"),
        (None, None) => PathBuf::from("default.h5"),
    };
    let budget = arguments.budget.map(budget).transpose()?;
    output::check(Some(&path), arguments.scene.as_deref())?;
    let options = Options {
        certificate_points: points,
        seed: arguments.seed,
        resume: arguments.resume,
        budget: budget.map(Budget::of),
    };

    let start = Instant::now();
    let bars = Bars::new();
    let generated = threads.install(|| generate(&scene, &path, &options, &bars));
    bars.clear();
    let Generated {
        table,
        refined,
        points,
        resumed,
        solved,
    } = generated?;
    let mut text = info::describe(&table)?;
    for (shape, certificate) in refined {
        let shape = shape.map(|nodes| nodes.to_string()).join(" x ");
        text += &format!(
            "{:15} {shape} nodes left an error of {:.1e}\n",
            "refined", certificate.max_error
        );
    }
    let before = if resumed > 0 {
        format!(" ({resumed} before they were resumed)")
    } else {
        String::new()
    };
    let (solved, all) = (solved.as_secs_f64(), start.elapsed().as_secs_f64());
    text += &format!(
        "{:15} {points} points{before} in {solved:.1} s, {all:.1} s with the certificate\n",
        "solved"
    );
    if let Some(bytes) = peak_memory() {
        text += &format!("{:15} {:.0} MB at most\n", "memory", bytes as f64 / 1e6);
    }
    text += &format!(
        "{:15} {} ({} bytes)\n",
        "written",
        path.display(),
        std::fs::metadata(&path)?.len()
    );
    write_text(None, text.as_bytes())?;
    let (error, tolerance) = (
        table.description().certificate.max_error,
        table.description().tolerance,
    );
    // Not an ordered comparison the other way round: NaN must not pass.
    let held = error <= tolerance;
    if !held {
        let remedy = if arguments.budget.is_some() {
            "it a larger budget, or its axes more nodes"
        } else {
            "its axes more nodes"
        };
        bail!(
            "{} is written, but its measured error {error:.1e} exceeds the tolerance {tolerance:e}: give {remedy}",
            path.display()
        );
    }
    Ok(())
}

/// The scene of a file, or the default one.
pub fn read_scene(path: Option<&Path>, tolerance: Option<f64>) -> anyhow::Result<Scene> {
    match path {
        Some(path) => Ok(Scene::read(path, tolerance)?),
        None => Scene::parse(DEFAULT_SCENE, tolerance)
            .map_err(anyhow::Error::msg)
            .context("the default scene"),
    }
}

/// The time that `--budget` allows.
pub fn budget(seconds: f64) -> anyhow::Result<Duration> {
    ensure!(
        seconds > 0.0 && seconds <= 1e9,
        "--budget = {seconds:?}: it must be above 0 and at most 1e9 seconds"
    );
    Ok(Duration::from_secs_f64(seconds))
}

/// The most memory that this process has held, where the system says (Linux).
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kilobytes = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?
        .trim()
        .strip_suffix(" kB")?;
    Some(1024 * kilobytes.parse::<u64>().ok()?)
}

/// Prints what the table of a scene will take.
fn print_plan(scene: &Scene, certificate_points: usize) -> anyhow::Result<()> {
    let plan = Plan::new(scene)?;
    let mut text = String::new();
    for (parameter, nodes) in Parameter::ALL.into_iter().zip(plan.axes()) {
        text += &info::describe_axis(parameter, &nodes);
    }
    let seconds = seconds_per_point(scene, &plan)?;
    let certificate = (seconds + SECONDS_PER_CURVE / rayon::current_num_threads() as f64)
        * certificate_points as f64;
    let bytes = (8 * plan.points() * scene.quantities.len()) as f64;
    text += &format!("{:15} {}\n", "nodes", plan.points());
    text += &format!(
        "{:15} {} and {certificate_points} for the certificate\n",
        "solves",
        plan.points()
    );
    text += &format!(
        "{:15} about {:.1} s\n",
        "time",
        seconds * plan.points() as f64 + certificate
    );
    text += &format!(
        "{:15} about {:.0} MB\n",
        "memory",
        (1.2 * bytes + PROGRAM) / 1e6
    );
    let size = COMPRESSED * bytes;
    let size = if size < 1e6 {
        format!("{:.0} kB", size / 1e3)
    } else {
        format!("{:.1} MB", size / 1e6)
    };
    text += &format!("{:15} about {size}\n", "size");
    write_text(None, text.as_bytes())
}

/// What deflate leaves of the values.
const COMPRESSED: f64 = 0.65;
/// Memory besides that of the table, which is its values and a fifth of them: within a quarter of
/// what is measured (`benches/scale.rs`).
const PROGRAM: f64 = 20e6;
/// Making the curve of a material, on one thread.
const SECONDS_PER_CURVE: f64 = 3e-4;

/// The time for a point of the sweep on all threads, measured on a few nodes of each axis.
fn seconds_per_point(scene: &Scene, plan: &Plan) -> anyhow::Result<f64> {
    const FEW: usize = 8;
    let axes = plan.axes().map(|nodes| {
        nodes
            .iter()
            .copied()
            .step_by(nodes.len().div_ceil(FEW))
            .collect::<Vec<f64>>()
    });
    let points: usize = axes.iter().map(Vec::len).product();
    // Once before, for what is made at the first use.
    sweep(scene, &axes, &|_| ())?;
    let start = Instant::now();
    sweep(scene, &axes, &|_| ())?;
    Ok(start.elapsed().as_secs_f64() / points as f64)
}

/// A bar for each stage.
pub struct Bars(Mutex<ProgressBar>);

impl Bars {
    pub fn new() -> Self {
        Self(Mutex::new(ProgressBar::hidden()))
    }

    fn bar(&self) -> std::sync::MutexGuard<'_, ProgressBar> {
        self.0
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    pub fn clear(&self) {
        self.bar().finish_and_clear();
    }
}

impl Observer for Bars {
    fn begin(&self, what: &'static str, points: usize, finished: usize) {
        self.clear();
        let bar = progress_bar(points, what);
        bar.inc(finished as u64);
        *self.bar() = bar;
    }

    fn advance(&self, points: usize) {
        self.bar().inc(points as u64);
    }

    fn note(&self, text: &str) {
        eprintln!("tabulate: {text}");
    }
}
