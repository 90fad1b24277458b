//! Time and memory of `tabulate generate` against the size of the table and the number of threads: the program itself, on the
//! default scene. Prints the table that the README quotes, and draws `tables/scale.svg`. Linux only: elsewhere the program does not
//! know its memory.

use std::error::Error;
use std::ops::Range;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use interp::{Quantity, Table};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

const TOLERANCES: [f64; 6] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
/// Numbers of threads.
const JOBS: [usize; 2] = [1, 2];
/// Of the runs that begin within this time the fastest counts.
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
    println!("\nThe picture is {}.", Path::new(PICTURE).canonicalize()?.display());
    Ok(())
}

/// What one table takes.
struct Size {
    tolerance: f64,
    nodes: String,
    points: f64,
    /// Of each of [`JOBS`].
    runs: [Run; 2],
    /// The table's values in memory, in MB.
    values: f64,
    /// The file, in MB.
    file: f64,
    error: f64,
}

/// What the program says of itself.
#[derive(Clone, Copy)]
struct Run {
    points: f64,
    /// Certificate included.
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
                *fastest = fastest.filter(|fastest: &Run| fastest.seconds < run.seconds).or(Some(run));
            }
        }
        let runs = runs.map(|run| run.expect("one run begins at once"));
        let table = Table::open(path)?;
        let quantities = Quantity::ALL.into_iter().filter_map(|quantity| table.values(quantity));
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
        let Self { tolerance, nodes, points, runs: [one, two], values, file, error } = self;
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
        command.args(["generate", "--tolerance", &tolerance.to_string(), "--jobs", &jobs.to_string(), "-o"]).arg(path);
        let output = command.stderr(Stdio::inherit()).output()?;
        if !output.status.success() {
            return Err(format!("{command:?} failed ({})", output.status).into());
        }
        let text = String::from_utf8(output.stdout)?;
        let before =
            |unit| number_before(&text, unit).ok_or_else(|| format!("{command:?} does not say its number of{unit}:\n{text}"));
        Ok(Self { points: before(" points in")?, seconds: before(" s with the certificate")?, megabytes: before(" MB at most")? })
    }
}

/// The number that stands before a phrase.
fn number_before(text: &str, phrase: &str) -> Option<f64> {
    text.split_once(phrase)?.0.rsplit(' ').next()?.parse().ok()
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Two that the colour-blind tell apart, too.
const COLOURS: [RGBColor; 2] = [RGBColor(0, 114, 178), RGBColor(213, 94, 0)];
const GREY: RGBColor = RGBColor(90, 90, 90);
const FONT: (&str, i32) = ("sans-serif", 18);

/// A line of a panel. Its name stands to the right of one of its points.
struct Curve {
    points: Vec<(f64, f64)>,
    colour: RGBColor,
    /// Points are marked.
    measured: bool,
    name: &'static str,
    named_point: usize,
    /// In pixels, downwards.
    name_offset: i32,
}

fn draw(sizes: &[Size]) -> Result<(), Box<dyn Error>> {
    let picture = SVGBackend::new(PICTURE, (840, 400)).into_drawing_area();
    picture.fill(&WHITE)?;
    let (left, right) = picture.split_horizontally(420);
    let last = sizes.len() - 1;
    let of_jobs = |job: usize, of: fn(&Run) -> f64, name_offset: i32| Curve {
        points: sizes.iter().map(|size| (size.points, of(&size.runs[job]))).collect(),
        colour: COLOURS[job],
        measured: true,
        name: ["1 thread", "2 threads"][job],
        named_point: last,
        name_offset,
    };
    let seconds = |run: &Run| run.seconds;
    panel(&left, "Time, certificate included (s)", &[of_jobs(0, seconds, -8), of_jobs(1, seconds, 8)])?;
    let megabytes = |run: &Run| run.megabytes;
    let values = Curve {
        points: sizes.iter().map(|size| (size.points, 2.0 * size.values)).collect(),
        colour: GREY,
        measured: false,
        name: "2 × the table's values",
        named_point: last / 2,
        name_offset: 9,
    };
    panel(&right, "Peak memory (MB)", &[of_jobs(0, megabytes, 6), of_jobs(1, megabytes, -10), values])?;
    Ok(picture.present()?)
}

fn panel(area: &Area<'_>, title: &str, curves: &[Curve]) -> Result<(), Box<dyn Error>> {
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let (x, y) = (decades(points().map(|point| point.0)), decades(points().map(|point| point.1)));
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .caption(title, ("sans-serif", 20))
        .x_label_area_size(48)
        .y_label_area_size(46)
        .build_cartesian_2d(x.log_scale(), y.log_scale())?;
    chart
        .configure_mesh()
        .max_light_lines(0)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_labels(4)
        .y_labels(4)
        .x_label_formatter(&|x| power_of_ten(*x))
        .y_label_formatter(&f64::to_string)
        .label_style(FONT)
        .x_desc(format!("points solved, tolerances {:e} to {:e}", TOLERANCES[0], TOLERANCES[TOLERANCES.len() - 1]))
        .draw()?;
    for curve in curves {
        let (points, style) = (curve.points.iter().copied(), curve.colour.stroke_width(2));
        chart.draw_series(LineSeries::new(points.clone(), style))?;
        if curve.measured {
            chart.draw_series(points.map(|point| Circle::new(point, 4, curve.colour.filled())))?;
        }
        let style = TextStyle::from(FONT).color(&curve.colour).pos(Pos::new(HPos::Left, VPos::Center));
        let name = EmptyElement::at(curve.points[curve.named_point]) + Text::new(curve.name, (9, curve.name_offset), style);
        chart.draw_series([name])?;
    }
    Ok(())
}

/// From a power of ten to another, around all of some numbers.
fn decades(numbers: impl Iterator<Item = f64>) -> Range<f64> {
    let (low, high) = numbers.fold((f64::INFINITY, 0.0_f64), |(low, high), number| (low.min(number), high.max(number)));
    10_f64.powf(low.log10().floor())..10_f64.powf(high.log10().ceil())
}

fn power_of_ten(number: f64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    format!("10{}", DIGITS[number.log10().round() as usize])
}
