//! `tabulate generate`

use std::path::{Path, PathBuf};
use std::sync::Arc;
#[cfg(unix)]
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, anyhow, bail, ensure};
use clap::value_parser;
use interp::Certificate;
use serde_json::{Value, json};

use super::info::row;
use super::json::{self, of_parameters};
#[cfg(unix)]
use super::note;
use super::progress::Bars;
use super::quantity::number;
use super::table_name::hdf5_file;
use super::{info, plan, print};
use crate::table::scene::TOLERANCE;
use crate::table::{Budget, Generated, Options, Scene, default_points, generate, journal_of};
use crate::{Error, output, printable};

/// The four-parameter scene that is made when no other is named.
const DEFAULT_SCENE: &str = include_str!("default.toml");

/// Make the HDF5 table of a scene: choose the nodes, solve them, measure the accuracy
///
/// The nodes are chosen so that the splines between them keep the tolerance. Then the table is
/// compared with direct solves at sampled points between the nodes. The largest error found is
/// stored in the table, as its certificate. An axis with too large an error gets more nodes, and
/// the table is made again. A table can still exceed its tolerance, because the scene states its
/// nodes or the budget is spent: then it is written, and the exit status is 1.
///
/// Finished pieces are kept in TABLE.h5.unfinished until the table is complete: after an
/// interruption, --resume goes on from them, with the same build of this program on the same kind
/// of processor. Without --resume, kept pieces are an error: remove their file to begin anew. A loss of
/// power costs a megabyte of pieces at most. An existing table stays as it is until the new one is
/// complete. In a scene, e1_over_e2 and e0_over_e2 are Young's moduli over the sphere's
/// reduced modulus E2*, see `tabulate --help`.
#[derive(clap::Args)]
#[command(after_help = super::examples!(
    "tabulate generate tables/paper.toml --plan",
    "tabulate generate tables/paper.toml -o paper.h5",
    "tabulate generate tables/incompressible.toml -o films.h5 --tolerance 1e-4 --jobs 2",
    "tabulate generate                                  # the default scene: a million contacts",
))]
pub struct Arguments {
    /// The scene; without one, the default four-parameter box
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// The HDF5 table to write [default: the scene's path with the ending .h5, or default.h5]
    #[arg(short, long, value_name = "TABLE.h5", value_parser = hdf5_file())]
    output: Option<PathBuf>,
    /// Relative tolerance between the nodes, instead of the scene's
    #[arg(long, value_parser = number)]
    tolerance: Option<f64>,
    /// Number of threads [default: one per core]
    #[arg(long, value_parser = value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Go on from the finished pieces of an interrupted run of the scene
    #[arg(long)]
    resume: bool,
    /// Print axes, nodes, solves, and the expected time, memory and size, and make nothing
    #[arg(long)]
    plan: bool,
    /// Stop after this time, with the pieces that are finished
    #[arg(long, value_name = "SECONDS", value_parser = number)]
    budget: Option<f64>,
    /// Number of points of the certificate [default: 2500 for each axis]
    #[arg(long, value_parser = value_parser!(u32).range(1..=super::points::MOST_POINTS))]
    certificate_points: Option<u32>,
    /// Seed of the random points of the certificate
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON object
    ///
    /// The fields are those of `tabulate info --json`, then path, points_solved, points_resumed (of
    /// them, solved before an interruption), seconds_solving, seconds (with the certificate),
    /// peak_memory_bytes (null where the system does not tell it), and refined (nodes and max_error
    /// of each earlier round). With --plan the fields are axes, points, certificate_points,
    /// seconds, memory_bytes and bytes.
    #[arg(long)]
    json: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let scene = read_scene(arguments.scene.as_deref(), arguments.tolerance)?;
    let jobs = usize::from(arguments.jobs.unwrap_or(0));
    let threads = rayon::ThreadPoolBuilder::new().num_threads(jobs).build();
    let threads = threads
        .map_err(|error| anyhow::anyhow!("cannot start the threads: {error}; give fewer --jobs"))?;
    let points = arguments
        .certificate_points
        .map_or_else(|| default_points(scene.axes()), |points| points as usize);
    if arguments.plan {
        return threads.install(|| plan::print(&scene, points, arguments.json));
    }
    let path = match (&arguments.output, &arguments.scene) {
        (Some(path), _) => path.clone(),
        (None, Some(scene)) => scene.with_extension("h5"),
        (None, None) => PathBuf::from("default.h5"),
    };
    let budget = arguments.budget.map(budget).transpose()?;
    let inputs: Vec<&Path> = arguments.scene.as_deref().into_iter().collect();
    output::check(&path, &inputs)?;
    let options = Options {
        certificate_points: points,
        seed: arguments.seed,
        resume: arguments.resume,
        budget: budget.map(Budget::of),
    };

    let start = Instant::now();
    let bars = Arc::new(Bars::new());
    let journal = journal_of(&path)?;
    tell_what_an_interruption_leaves(&bars, &journal)?;
    let generated = threads.install(|| generate(&scene, &path, &options, &*bars));
    bars.clear();
    let generated = generated.map_err(|error| match error {
        error @ Error::Kept { .. } => anyhow!("{error}; --resume goes on from them"),
        error @ Error::Budget { .. } if journal.exists() => anyhow!("{error} with --resume"),
        error @ Error::Write { .. } if bars.kept_points()[0] > 0 && journal.exists() => anyhow!(
            "{:#}; the points solved so far are kept: once the file can be written, the same command with --resume goes on from them",
            anyhow::Error::from(error)
        ),
        error => error.into(),
    })?;
    let (all, bytes) = (start.elapsed(), std::fs::metadata(&path)?.len());
    if arguments.json {
        print_json(&generated, &path, bytes, all)?;
    } else {
        print_text(&generated, &path, bytes, all)?;
    }
    let description = generated.table.description();
    let (error, tolerance) = (description.certificate.max_error, description.tolerance);
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
            printable::path(&path)
        );
    }
    Ok(())
}

/// Lets Ctrl-C, and a request to end as schedulers of jobs send it, end the process at once, with a word on what is
/// kept. The file of the pieces is whole at any moment. The process ends by the signal: after an exit status, a
/// script that Ctrl-C interrupts would go on with its next command. What was started to ignore a signal, as scripts
/// start what runs in the background, goes on.
#[cfg(unix)]
fn tell_what_an_interruption_leaves(bars: &Arc<Bars>, journal: &Path) -> anyhow::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::{iterator::Signals, low_level::emulate_default_handler};

    let ignored = status("SigIgn:").and_then(|text| u64::from_str_radix(&text, 16).ok());
    let is_heard = |signal: &i32| ignored.is_none_or(|ignored| ignored >> (signal - 1) & 1 == 0);
    let (bars, journal) = (bars.clone(), journal.to_owned());
    let mut signals = Signals::new([SIGINT, SIGTERM].iter().filter(|signal| is_heard(signal)))
        .context("cannot listen to Ctrl-C")?;
    let say = move || {
        let signal = signals.forever().next();
        bars.clear();
        let [kept, points] = bars.kept_points();
        if kept > 0 && journal.exists() {
            note(&format!(
                "interrupted with {kept} of {points} points solved; they are kept in {}, and the same command with \
                 --resume goes on from them",
                printable::path(&journal)
            ));
        } else {
            note("interrupted; nothing was finished that could be kept");
        }
        let _ = emulate_default_handler(signal.unwrap_or(SIGINT));
    };
    let started = thread::Builder::new().spawn(say);
    started.context("cannot start the thread that listens to Ctrl-C")?;
    Ok(())
}

/// Leaves the end of the process to the system, which says nothing.
#[cfg(not(unix))]
fn tell_what_an_interruption_leaves(_: &Arc<Bars>, _: &Path) -> anyhow::Result<()> {
    Ok(())
}

fn print_json(generated: &Generated, path: &Path, bytes: u64, all: Duration) -> anyhow::Result<()> {
    let round = |(nodes, certificate): &([usize; 4], Certificate)| {
        let nodes = of_parameters(generated.table.parameters(), *nodes);
        json!({ "nodes": nodes, "max_error": certificate.max_error })
    };
    let mut object = json::table(&generated.table, bytes);
    object["path"] = path.display().to_string().into();
    object["points_solved"] = generated.points.into();
    object["points_resumed"] = generated.resumed.into();
    object["seconds_solving"] = generated.solved.as_secs_f64().into();
    object["seconds"] = all.as_secs_f64().into();
    object["peak_memory_bytes"] = peak_memory().into();
    object["refined"] = generated.refined.iter().map(round).collect::<Value>();
    json::print(&object)
}

fn print_text(generated: &Generated, path: &Path, bytes: u64, all: Duration) -> anyhow::Result<()> {
    let mut text = info::describe(&generated.table);
    for (shape, certificate) in &generated.refined {
        let shape = shape.map(|nodes| nodes.to_string()).join(" x ");
        let left = format_args!(
            "{shape} nodes left an error of {:.1e}",
            certificate.max_error
        );
        text += &row("refined", left);
    }
    let before = match generated.resumed {
        0 => String::new(),
        resumed => format!(" ({resumed} before they were resumed)"),
    };
    let (points, seconds) = (generated.points, generated.solved.as_secs_f64());
    let solved = format_args!(
        "{points} points{before} in {seconds:.1} s, {:.1} s with the certificate",
        all.as_secs_f64()
    );
    text += &row("solved", solved);
    if let Some(bytes) = peak_memory() {
        text += &row(
            "memory",
            format_args!("{:.0} MB at most", bytes as f64 / 1e6),
        );
    }
    let path = printable::path(path);
    text += &row("written", format_args!("{path} ({bytes} bytes)"));
    print(text.as_bytes())
}

/// Reads the scene of a file, or the default one.
pub fn read_scene(path: Option<&Path>, tolerance: Option<f64>) -> anyhow::Result<Scene> {
    if let Some(tolerance) = tolerance {
        let [from, to] = TOLERANCE;
        ensure!(
            (from..=to).contains(&tolerance),
            "--tolerance = {tolerance:?} is outside {from:e} to {to:e}"
        );
    }
    match path {
        Some(path) => Ok(Scene::read(path, tolerance)?),
        None => Scene::parse(DEFAULT_SCENE, tolerance)
            .map_err(anyhow::Error::msg)
            .context("the default scene"),
    }
}

/// Returns the time that `--budget` allows.
pub fn budget(seconds: f64) -> anyhow::Result<Duration> {
    ensure!(
        seconds > 0.0 && seconds <= 1e9,
        "--budget = {seconds:?}: it must be above 0 and at most 1e9 seconds"
    );
    Ok(Duration::from_secs_f64(seconds))
}

/// Returns the largest memory that this process has held; none where the system does not tell it
/// (anywhere but Linux).
fn peak_memory() -> Option<u64> {
    let kilobytes = status("VmHWM:")?;
    Some(1024 * kilobytes.strip_suffix(" kB")?.parse::<u64>().ok()?)
}

/// Returns what Linux tells of this process under a heading.
fn status(heading: &str) -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let mut lines = status.lines();
    let told = lines.find_map(|line| line.strip_prefix(heading))?;
    Some(told.trim().to_owned())
}
