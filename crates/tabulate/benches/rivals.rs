//! The lookup, in the embedded table and in one of the default box, beside interpolation in all four
//! parameters at once on the nodes of the latter, and beside the direct solve, in one run on one
//! thread.
//!
//! Prints a table of times and errors. Times are of contacts of a new material each time. Errors
//! are those at random points off the nodes: the largest of the four relative deviations from the
//! solve at the tightest tolerance that converges. All methods interpolate the logarithms that
//! `interp` splines, in the coordinates of `interp`; scipy is given these coordinates, and takes part
//! in `cargo xtask compare` if 10 GB of memory are free.
//!
//! With `--small` the box has few nodes and every number of repetitions is small: that tests the
//! comparison, and its numbers mean nothing.

mod python;

use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use cost::clock::{self, human, median};
use cost::deviation::{deviation, tightest};
use cost::lookup::Point;
use interp::{Description, Material, Parameter, Quantities, Quantity, Table};
use interpn::multibspline::rectilinear as b_spline;
use interpn::{MultiBsplineRectilinear, MulticubicRectilinear};
use python::Python;
use serde::Deserialize;
use serde_json::json;
use solve::solve;
use tabulate::table::{Plan, Scene, compress, random_points, sweep};

/// What sets how long the comparison takes.
struct Sizes {
    /// The tolerances of the nodes, of the low-rank form and of the table.
    tolerances: [f64; 3],
    /// Random points off the nodes, for errors and for the times of single points.
    points: usize,
    /// Random materials, for the times of curves.
    curves: usize,
    /// The number of rounds. The methods take turns, so that a machine that slows down affects all.
    rounds: usize,
    /// The number of points at which the direct solve is timed. Each solve is repeated.
    solved: usize,
}

const FULL: Sizes = Sizes {
    tolerances: [2e-7, 5e-7, 1e-6],
    points: 1000,
    curves: 100,
    rounds: 9,
    solved: 20,
};
const SMALL: Sizes = Sizes {
    tolerances: [1e-2, 1e-2, 1e-1],
    points: 20,
    curves: 4,
    rounds: 1,
    solved: 2,
};
/// The seconds spent on timing a solve.
const BUDGET: f64 = 0.01;

fn main() {
    let sizes = if python::is_small() { SMALL } else { FULL };
    let table = &default_box(sizes.tolerances);
    let grid = Grid::new(table);
    let mut points = random_points(table, sizes.points + sizes.curves, 1);
    let curves: Vec<[Point; 60]> = points
        .split_off(sizes.points)
        .into_iter()
        .map(|(_, material)| curve_of(material))
        .collect();
    let truth: Vec<Quantities> = points
        .iter()
        .map(|(x, material)| {
            tightest(*x, material)
                .expect("every point of the box converges")
                .quantities
        })
        .collect();

    let axes = grid.axes.each_ref().map(Vec::as_slice);
    let cubic = grid
        .logarithms
        .each_ref()
        .map(|values| MulticubicRectilinear::new(&axes, values, false).expect("a grid"));
    let coefficients = grid.logarithms.each_ref().map(|values| {
        let (mut coefficients, mut scratch) =
            (vec![0.0; values.len()], vec![0.0; 2 * values.len()]);
        b_spline::coefficients(&axes, values, &mut coefficients, &mut scratch).expect("a grid");
        coefficients
    });
    let spline = coefficients
        .each_ref()
        .map(|values| MultiBsplineRectilinear::new(&axes, values, false).expect("a grid"));

    let (embedded, own) = (Own(Table::embedded()), Own(table));
    let cubic = Rival(|quantity: usize, place| cubic[quantity].interp_one(place).expect("inside"));
    let spline =
        Rival(|quantity: usize, place| spline[quantity].interp_one(place).expect("inside"));
    let methods: [(&str, &dyn Method); 4] = [
        ("the embedded table (interp)", &embedded),
        ("a table with these nodes (interp)", &own),
        ("tri-cubic in 4-D (interpn)", &cubic),
        ("cubic B-spline in 4-D (interpn)", &spline),
    ];

    let mut rows: Vec<Row> = methods
        .iter()
        .map(|(name, method)| Row::new(name, points.iter().map(|p| method.four(p)), &truth))
        .collect();
    let mut times = vec![[const { Vec::new() }; 3]; methods.len()];
    for _ in 0..sizes.rounds {
        for ((_, method), times) in methods.iter().zip(&mut times) {
            times[0].push(mean_seconds(&points, |point| method.one(point)));
            times[1].push(mean_seconds(&points, |point| method.four(point)));
            times[2].push(mean_seconds(&curves, |curve| method.curve(curve)));
        }
    }
    for (row, times) in rows.iter_mut().zip(times) {
        row.seconds = times.map(|times| Some(median(times)));
    }

    println!(
        "Nodes: {:?}; interpn 0.11, scipy and the direct solve on one thread\n",
        table.shape()
    );
    if !cfg!(feature = "fast-interpn") {
        println!(
            "interpn: without its fast code for four variables, so its times mean nothing; `cargo xtask compare` \
             compiles it\n"
        );
    }
    match Python::start("rivals.py") {
        Some(python) => rows.extend(scipy(python, &grid, &points, &curves, &truth)),
        None => println!(
            "scipy: skipped, as it needs python3 with numpy and scipy; `cargo xtask compare` fetches them\n"
        ),
    }
    for tolerance in [1e-7, 1e-10] {
        let solved = points.iter().map(|(x, material)| {
            solve(*x, material, tolerance)
                .expect("the truth converged")
                .quantities
        });
        let mut row = Row::new(&format!("direct solve to {tolerance:e}"), solved, &truth);
        let time =
            |(x, material): &Point| clock::seconds(BUDGET, || solve(*x, material, tolerance));
        let seconds = |points: &[Point]| points.iter().map(time).sum::<f64>();
        row.seconds[1] = Some(seconds(&points[..sizes.solved]) / sizes.solved as f64);
        row.seconds[2] = Some(
            curves[..sizes.solved]
                .iter()
                .map(|curve| seconds(curve))
                .sum::<f64>()
                / sizes.solved as f64,
        );
        rows.push(row);
    }

    println!(
        "| of a new material each time | one quantity, one point | four, one point | four, 60 points | ratio | largest error | median |"
    );
    println!("|---|---|---|---|---|---|---|");
    let unit = rows[0].seconds[2];
    rows.iter().for_each(|row| row.print(unit));

    let curve = table.curve(&points[0].1).expect("inside");
    let further = mean_seconds(&points, |point| {
        curve.quantities(point.0).expect("inside").pi0
    });
    println!(
        "\nAll four quantities at a further point of the same material (interp): {:.1} ns",
        further * 1e9
    );
}

/// Returns 60 points of a material from a/t = 1e-3 to 1e3.
fn curve_of(material: Material) -> [Point; 60] {
    std::array::from_fn(|i| {
        (
            (10_f64.powf(-3.0 + 6.0 * i as f64 / 59.0)).clamp(1e-3, 1e3),
            material,
        )
    })
}

/// The order of the dimensions of the other libraries. `a/t` is the last, so that neighbours along
/// it are neighbours in memory, which is fast for curves.
const ORDER: [Parameter; 4] = [
    Parameter::E1OverE2,
    Parameter::Nu1,
    Parameter::E0OverE2,
    Parameter::AOverT,
];

/// Makes the low-rank table of the default box.
fn default_box([nodes, form, tolerance]: [f64; 3]) -> Table {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tables/default.toml");
    let scene = Scene::read(Path::new(scene), Some(nodes)).expect("a sound scene");
    let axes = Plan::new(&scene).expect("within reach").axes(&scene);
    let values = sweep(&scene, &axes, &|_| {}).expect("within reach");
    let description = Description {
        tolerance,
        ..scene.description()
    };
    let dense = Table::new(description.clone(), axes, values).expect("a whole table");
    let tiles = compress(&dense, form).expect("above rounding");
    let quantities = dense.quantities();
    Table::from_low_rank(description, dense.axes(), quantities, tiles)
        .expect("the form of this table")
}

/// The nodes in the coordinates in which splines are smooth, and the logarithms at the nodes.
struct Grid {
    axes: [Vec<f64>; 4],
    /// The logarithms of each quantity, row-major.
    logarithms: [Vec<f64>; 4],
}

impl Grid {
    fn new(table: &Table) -> Self {
        let axes = ORDER.map(|parameter| {
            table
                .axis(parameter)
                .iter()
                .map(|&node| parameter.coordinate(node))
                .collect()
        });
        let all: Vec<f64> = (0..table.axis(Parameter::E1OverE2).len())
            .flat_map(|e1| table.logarithms(e1))
            .collect();
        let logarithms = Quantity::ALL.map(|quantity| {
            all.chunks_exact(4)
                .map(|four| four[quantity as usize])
                .collect()
        });
        Self { axes, logarithms }
    }
}

/// A method to look quantities up.
trait Method {
    /// Returns `Gamma` at one point.
    fn one(&self, point: &Point) -> f64;

    /// Returns all four quantities at one point.
    fn four(&self, point: &Point) -> Quantities;

    /// Returns the sum of all four quantities at points of one material. The sum depends on all of
    /// them, so the compiler cannot leave one out.
    fn curve(&self, points: &[Point; 60]) -> f64;
}

/// Lookup on the table's own curve.
struct Own<'a>(&'a Table);

impl Method for Own<'_> {
    fn one(&self, (x, material): &Point) -> f64 {
        self.0
            .curve(material)
            .and_then(|curve| curve.quantity(Quantity::Gamma, *x))
            .expect("inside")
    }

    fn four(&self, (x, material): &Point) -> Quantities {
        self.0
            .curve(material)
            .and_then(|curve| curve.quantities(*x))
            .expect("inside")
    }

    fn curve(&self, points: &[Point; 60]) -> f64 {
        let curve = self.0.curve(&points[0].1).expect("inside");
        points
            .iter()
            .map(|(x, _)| sum(&curve.quantities(*x).expect("inside")))
            .sum()
    }
}

/// Returns the coordinates of a material, which are those of the [`Grid`], and its `es`.
fn place(material: &Material) -> [f64; 4] {
    [
        Parameter::E1OverE2.coordinate(material.e1_over_e2()),
        Parameter::Nu1.coordinate(material.nu1()),
        Parameter::E0OverE2.coordinate(material.e0_over_e2()),
        material.sphere_film_modulus(),
    ]
}

/// Another library's interpolation of one of the logarithms in four dimensions.
struct Rival<F: Fn(usize, [f64; 4]) -> f64>(F);

impl<F: Fn(usize, [f64; 4]) -> f64> Rival<F> {
    fn value(&self, quantity: Quantity, material: &[f64; 4], x: f64) -> f64 {
        let &[e1, nu1, e0, es] = material;
        let place = [e1, nu1, e0, Parameter::AOverT.coordinate(x)];
        quantity.scale(es) * (self.0)(quantity as usize, place).exp()
    }

    fn quantities(&self, material: &[f64; 4], x: f64) -> Quantities {
        Quantities::from_array(Quantity::ALL.map(|quantity| self.value(quantity, material, x)))
    }
}

impl<F: Fn(usize, [f64; 4]) -> f64> Method for Rival<F> {
    fn one(&self, (x, material): &Point) -> f64 {
        self.value(Quantity::Gamma, &place(material), *x)
    }

    fn four(&self, (x, material): &Point) -> Quantities {
        self.quantities(&place(material), *x)
    }

    fn curve(&self, points: &[Point; 60]) -> f64 {
        let material = place(&points[0].1);
        points
            .iter()
            .map(|(x, _)| sum(&self.quantities(&material, *x)))
            .sum()
    }
}

fn sum(quantities: &Quantities) -> f64 {
    quantities.to_array().iter().sum()
}

/// Returns the mean time of `work` on one of `cases`.
fn mean_seconds<T, R>(cases: &[T], work: impl Fn(&T) -> R) -> f64 {
    let start = Instant::now();
    for case in cases {
        black_box(work(black_box(case)));
    }
    start.elapsed().as_secs_f64() / cases.len() as f64
}

/// A row of the table that is printed.
struct Row {
    name: String,
    /// The times of one quantity, of all four, and of all four at 60 points.
    seconds: [Option<f64>; 3],
    largest: f64,
    median: f64,
}

impl Row {
    fn new(name: &str, found: impl Iterator<Item = Quantities>, truth: &[Quantities]) -> Self {
        let errors: Vec<f64> = found
            .zip(truth)
            .map(|(found, truth)| deviation(&found, truth))
            .collect();
        let largest = errors.iter().copied().fold(0.0, f64::max);
        Self {
            name: name.to_owned(),
            seconds: [None; 3],
            largest,
            median: median(errors),
        }
    }

    fn print(&self, unit: Option<f64>) {
        let cells = self.seconds.map(|seconds| {
            seconds.map_or_else(
                || " |".to_owned(),
                |seconds| format!(" {} |", human(seconds)),
            )
        });
        let ratio = self.seconds[2]
            .zip(unit)
            .map_or(f64::NAN, |(seconds, unit)| seconds / unit);
        println!(
            "| {} |{} {ratio:.1} | {:.0e} | {:.0e} |",
            self.name,
            cells.concat(),
            self.largest,
            self.median
        );
    }
}

/// The answer of `rivals.py` to a batch of points.
#[derive(Deserialize)]
struct Batch {
    quantities: Vec<[f64; 4]>,
    seconds: f64,
}

/// Returns the row of scipy; none if there is not enough memory.
fn scipy(
    mut python: Python,
    grid: &Grid,
    points: &[Point],
    curves: &[[Point; 60]],
    truth: &[Quantities],
) -> Option<Row> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("logarithms");
    let node = |i: usize| {
        grid.logarithms
            .each_ref()
            .map(|values| values[i].to_le_bytes())
            .concat()
    };
    fs::write(
        &file,
        (0..grid.logarithms[0].len())
            .flat_map(node)
            .collect::<Vec<u8>>(),
    )
    .expect("room for the values");
    let built: Option<f64> = python.ask(&json!({ "axes": grid.axes, "file": file }));
    let Some(took) = built else {
        println!("scipy: skipped, as there is not enough memory\n");
        return None;
    };
    println!(
        "{}: {took:.0} s to solve for the coefficients of its spline\n",
        python.versions
    );
    let row = |(x, material): &Point| {
        let [e1, nu1, e0, es] = place(material);
        [e1, nu1, e0, Parameter::AOverT.coordinate(*x), es]
    };
    let mut batches = |batches: Vec<Vec<[f64; 5]>>| -> Vec<Batch> { python.ask(&json!(batches)) };
    let singles = batches(points.iter().map(|point| vec![row(point)]).collect());
    let sixties = batches(
        curves
            .iter()
            .map(|curve| curve.iter().map(row).collect())
            .collect(),
    );
    python.stop();
    let found = singles
        .iter()
        .map(|batch| Quantities::from_array(batch.quantities[0]));
    let mut scipy = Row::new("RegularGridInterpolator, cubic (scipy)", found, truth);
    let seconds =
        |batches: &[Batch]| Some(median(batches.iter().map(|batch| batch.seconds).collect()));
    scipy.seconds = [None, seconds(&singles), seconds(&sixties)];
    Some(scipy)
}
