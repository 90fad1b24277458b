//! Time and memory of `tabulate generate` against the size of the table and the number of threads.
//! Runs the program itself on the default scene, prints the table that the documentation quotes,
//! and draws `tables/scale.svg`. Linux only: on other systems the program cannot measure its
//! memory.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use figures::axis::{Axis, power_of_ten};
use figures::chart::{BLUE, Colour, Figure, GREY, Marker, Panel, Point, Side, VERMILION};
use figures::picture::Format;
use interp::{Quantity, Table};
use serde_json::Value;

const TOLERANCES: [f64; 6] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
/// Numbers of threads.
const JOBS: [usize; 2] = [1, 2];
/// The time within which runs are begun. The fastest of them counts.
const PATIENCE: Duration = Duration::from_secs(4);
const PICTURE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tables/scale.svg");

fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    println!(
        "| tolerance | nodes | points | 1 thread | 2 threads | speed-up | peak memory | values | ratio | .h5 | certified error |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    let mut sizes = Vec::new();
    for tolerance in TOLERANCES {
        let size = Size::measure(tolerance, &folder.path().join("table.h5"))?;
        size.print();
        sizes.push(size);
    }
    draw(&sizes)?;
    println!(
        "\nThe picture is {}.",
        Path::new(PICTURE).canonicalize()?.display()
    );
    Ok(())
}

/// The measurements of one table.
struct Size {
    tolerance: f64,
    nodes: String,
    points: f64,
    /// A run for each of [`JOBS`].
    runs: [Run; 2],
    /// The table's values in memory, in MB.
    values: f64,
    /// The file, in MB.
    file: f64,
    error: f64,
}

/// The numbers of one run of the program.
#[derive(Clone, Copy)]
struct Run {
    points: f64,
    /// The time, certificate included.
    seconds: f64,
    megabytes: f64,
}

impl Size {
    fn measure(tolerance: f64, path: &Path) -> Result<Self, Box<dyn Error>> {
        let mut runs = [None; 2];
        for (fastest, jobs) in runs.iter_mut().zip(JOBS) {
            let begin = Instant::now();
            while begin.elapsed() < PATIENCE {
                let run = Run::new(tolerance, jobs, path)?;
                *fastest = fastest
                    .filter(|fastest: &Run| fastest.seconds < run.seconds)
                    .or(Some(run));
            }
        }
        let runs = runs.map(|run| run.expect("one run begins at once"));
        let table = Table::open(path)?;
        let quantities = Quantity::ALL
            .into_iter()
            .filter_map(|quantity| table.values(quantity));
        Ok(Self {
            tolerance,
            nodes: table.shape().map(|nodes| nodes.to_string()).join(" × "),
            points: runs[0].points,
            runs,
            values: 1e-6 * quantities.map(size_of_val).sum::<usize>() as f64,
            file: 1e-6 * path.metadata()?.len() as f64,
            error: table.description().certificate.max_error,
        })
    }

    fn print(&self) {
        let Self {
            tolerance,
            nodes,
            points,
            runs: [one, two],
            values,
            file,
            error,
        } = self;
        println!(
            "| {tolerance:e} | {nodes} | {points} | {:.1} s | {:.1} s | {:.2} | {:.0} MB | {values:.1} MB | {:.1} | {file:.1} MB | {error:.1e} |",
            one.seconds,
            two.seconds,
            one.seconds / two.seconds,
            two.megabytes,
            two.megabytes / values
        );
    }
}

impl Run {
    fn new(tolerance: f64, jobs: usize, path: &Path) -> Result<Self, Box<dyn Error>> {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tabulate"));
        command
            .args([
                "generate",
                "--json",
                "--tolerance",
                &tolerance.to_string(),
                "--jobs",
                &jobs.to_string(),
                "-o",
            ])
            .arg(path);
        let output = command.stderr(Stdio::inherit()).output()?;
        if !output.status.success() {
            return Err(format!("{command:?} failed ({})", output.status).into());
        }
        let object: Value = serde_json::from_slice(&output.stdout)?;
        let number = |field: &str| {
            object[field]
                .as_f64()
                .ok_or_else(|| format!("{command:?} prints no number {field}: {object}"))
        };
        Ok(Self {
            points: number("points_solved")?,
            seconds: number("seconds")?,
            megabytes: 1e-6 * number("peak_memory_bytes")?,
        })
    }
}

/// The colours of the numbers of threads.
const COLOURS: [Colour; 2] = [BLUE, VERMILION];
const NAMES: [&str; 2] = ["1 thread", "2 threads"];

fn draw(sizes: &[Size]) -> Result<(), Box<dyn Error>> {
    let points = |of: &dyn Fn(&Size) -> f64| -> Vec<Point> {
        sizes.iter().map(|size| [size.points, of(size)]).collect()
    };
    let (last, middle) = (sizes.len() - 1, (sizes.len() - 1) / 2);
    let values = points(&|size| 2.0 * size.values);
    let panel = |title, of: fn(&Run) -> f64, others: &[Point]| {
        let [from, to] = [TOLERANCES[0], TOLERANCES[last]]
            .map(|tolerance| power_of_ten(tolerance.log10().round() as i32));
        let x = Axis::decades(
            format!("points solved, tolerances {from} to {to}"),
            sizes.iter().map(|size| size.points),
        );
        let measured = sizes.iter().flat_map(|size| size.runs.each_ref().map(of));
        let mut panel = Panel::new(
            title,
            x,
            Axis::decades("", measured.chain(others.iter().map(|point| point[1]))),
        );
        for (job, (colour, name)) in COLOURS.into_iter().zip(NAMES).enumerate() {
            let line = points(&|size| of(&size.runs[job]));
            panel
                .line(line.clone(), colour)
                .markers(line.clone(), colour, Marker::Full)
                .label(line[last], name, colour, Side::Right);
        }
        panel
    };
    let time = panel("Time, certificate included (s)", |run| run.seconds, &[]);
    let mut memory = panel("Peak memory (MB)", |run| run.megabytes, &values);
    memory.line(values.clone(), GREY).label(
        values[middle],
        "2 × the table's values",
        GREY,
        Side::BelowRight,
    );
    Ok(fs::write(
        PICTURE,
        Figure::new(400, [time, memory])
            .picture()?
            .encode(Format::Svg)?,
    )?)
}
