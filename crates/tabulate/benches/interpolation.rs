//! The number of nodes that a table needs with its own interpolation, and with others. Prints the
//! table that the documentation quotes.
//!
//! Everything is measured along single axes of the default box, on the lines of the planner. Each
//! line is solved once, at enough places for a spline of the highest degree to be as accurate as
//! the solve. Trial splines through values of that spline are compared with it.

use interp::Parameter;
use piecewise::bspline::{Basis, LARGEST_DEGREE, TABLE_DEGREE};
use rayon::prelude::*;
use tabulate::table::{EVENNESS, Scene, lines, logarithms, places};

const DEFAULT_SCENE: &str = include_str!("../../../tables/default.toml");

/// The largest relative error of any quantity on any line.
const TOLERANCES: [f64; 3] = [1e-4, 1e-6, 1e-8];

/// Places at which a line is solved.
const DENSE: usize = 257;

/// The largest number of nodes on an axis that is tried.
const MOST: usize = 300;

const CHOSEN: Choice = Choice {
    degree: TABLE_DEGREE,
    evenness: &EVENNESS,
    nu1: Coordinate::Table,
    splined: Splined::LogarithmOfRatio,
};

fn main() {
    let scene = Scene::parse(DEFAULT_SCENE, Some(TOLERANCES[2])).expect("a sound scene");
    let axes = Parameter::ALL.map(|parameter| Axis::solve(&scene, parameter));
    let chosen = TOLERANCES.map(|tolerance| CHOSEN.nodes(&axes, tolerance));

    println!(
        "Nodes on a/t × E1/E2* × nu1 × E0/E2*, and how many times as many points as in the first row:\n"
    );
    println!(
        "| |{}\n|---|---|---|---|",
        TOLERANCES
            .map(|tolerance| format!(" {tolerance:e} |"))
            .concat()
    );
    for (name, choice) in choices() {
        let cell = |(&tolerance, chosen): (&f64, &[usize; 4])| {
            let nodes = choice.nodes(&axes, tolerance);
            let points = |nodes: &[usize; 4]| nodes.iter().product::<usize>() as f64;
            let more = if nodes.contains(&MOST) { "> " } else { "" };
            let ratio = format!("{more}{:.2}", points(&nodes) / points(chosen));
            format!(
                " {} ({ratio}) |",
                nodes.map(|count| count.to_string()).join(" × ")
            )
        };
        println!(
            "| {name} |{}",
            TOLERANCES.iter().zip(&chosen).map(cell).collect::<String>()
        );
    }
    let error = largest(axes.iter().map(Axis::error_of_truth));
    println!(
        "\n{} lines along each axis; the splines are compared with one that is within {error:.0e} of the solve.",
        axes[0].lines.lines.len()
    );
}

/// A way to interpolate.
#[derive(Clone, Copy)]
struct Choice {
    degree: usize,
    /// The values of [`tabulate::table::Placement::Nodes`] that are tried. Each axis has the one
    /// with the fewest nodes.
    evenness: &'static [f64],
    nu1: Coordinate,
    splined: Splined,
}

/// Returns the names and the ways that are tried: the table's own, every degree on every placement,
/// and the table's own with one change.
fn choices() -> Vec<(String, Choice)> {
    const PLACEMENTS: [(&[f64], &str); 3] = [
        (&[0.95], "evenness 0.95"),
        (&[0.0], "Chebyshev points"),
        (&[1.0], "even nodes"),
    ];
    let mut choices = vec![(
        format!("the choice: degree {TABLE_DEGREE}, evenness of each axis planned"),
        CHOSEN,
    )];
    for (evenness, nodes) in PLACEMENTS {
        for degree in [5, TABLE_DEGREE, LARGEST_DEGREE] {
            choices.push((
                format!("degree {degree}, {nodes}"),
                Choice {
                    degree,
                    evenness,
                    ..CHOSEN
                },
            ));
        }
    }
    let Choice { nu1, splined, .. } = CHOSEN;
    for (change, nu1, splined) in [
        ("over nu1 itself", Coordinate::Itself, splined),
        ("over ln(1 - 2 nu1 + 1e-5)", Coordinate::Logarithm, splined),
        ("of ln Q", nu1, Splined::Logarithm),
        ("of Q/es", nu1, Splined::Ratio),
    ] {
        let choice = Choice {
            nu1,
            splined,
            ..CHOSEN
        };
        choices.push((format!("the choice, but {change}"), choice));
    }
    choices
}

impl Choice {
    /// Returns the smallest number of nodes on each axis that keeps the tolerance, [`MOST`] where
    /// this does not.
    fn nodes(&self, axes: &[Axis<'_>; 4], tolerance: f64) -> [usize; 4] {
        let counts: Vec<usize> = (2..MOST).collect();
        axes.each_ref().map(|axis| {
            // The error falls with the number of nodes, apart from small variations.
            let fewest = |&evenness: &f64| {
                counts[0]
                    + counts.partition_point(|&count| axis.error(self, evenness, count) > tolerance)
            };
            self.evenness.iter().map(fewest).fold(MOST, usize::min)
        })
    }
}

/// The coordinate in which the nodes of `nu1` are placed and splined.
#[derive(Clone, Copy)]
enum Coordinate {
    /// [`Parameter::coordinate`].
    Table,
    Itself,
    /// The logarithm of `1 - 2 nu1`, shifted.
    Logarithm,
}

impl Coordinate {
    const SHIFT: f64 = 1e-5;

    fn of(self, nu1: f64) -> f64 {
        match self {
            Self::Table => Parameter::Nu1.coordinate(nu1),
            Self::Itself => nu1,
            Self::Logarithm => -(1.0 - 2.0 * nu1 + Self::SHIFT).ln(),
        }
    }

    fn value(self, coordinate: f64) -> f64 {
        match self {
            Self::Table => Parameter::Nu1.value(coordinate),
            Self::Itself => coordinate,
            Self::Logarithm => 0.5 * (1.0 - (-coordinate).exp() + Self::SHIFT),
        }
    }
}

/// The function of a quantity `Q` that is splined. `s` is [`interp::Quantity::scale`].
#[derive(Clone, Copy)]
enum Splined {
    /// `ln(Q/s)`, as in the table.
    LogarithmOfRatio,
    /// `ln Q`.
    Logarithm,
    /// `Q/s`.
    Ratio,
}

impl Splined {
    fn of(self, logarithm_of_ratio: f64, scale: f64) -> f64 {
        match self {
            Self::LogarithmOfRatio => logarithm_of_ratio,
            Self::Logarithm => logarithm_of_ratio + scale.ln(),
            Self::Ratio => logarithm_of_ratio.exp(),
        }
    }

    /// Returns the relative error of the quantity.
    fn error(self, spline: f64, truth: f64) -> f64 {
        match self {
            Self::LogarithmOfRatio | Self::Logarithm => (spline - truth).abs(),
            Self::Ratio => (spline / truth - 1.0).abs(),
        }
    }
}

/// Several splines on one set of nodes.
struct Splines {
    basis: Basis,
    coefficients: Vec<f64>,
    width: usize,
}

impl Splines {
    /// Makes the splines through one row of values at each node.
    fn through(nodes: &[f64], rows: Vec<Vec<f64>>, degree: usize) -> Self {
        let (basis, width) = (Basis::new(nodes, degree), rows[0].len());
        let mut coefficients = rows.concat();
        basis.interpolate(&mut coefficients, width);
        Self {
            basis,
            coefficients,
            width,
        }
    }

    fn at(&self, place: f64) -> Vec<f64> {
        let weights = self.basis.weights(place);
        let mut row = vec![0.0; self.width];
        let rows = self.coefficients[weights.first * self.width..].chunks_exact(self.width);
        for (weight, coefficients) in weights.values[..weights.count].iter().zip(rows) {
            row.iter_mut()
                .zip(coefficients)
                .for_each(|(value, coefficient)| *value += weight * coefficient);
        }
        row
    }
}

/// Lines through the box of a scene, along one parameter.
struct Lines<'a> {
    scene: &'a Scene,
    along: Parameter,
    lines: Vec<[f64; 4]>,
}

impl Lines<'_> {
    /// Returns the `numbers` of each line at one value of the parameter, in one row.
    fn row(&self, value: f64, numbers: impl Fn([f64; 4]) -> Vec<f64>) -> Vec<f64> {
        let point = |line: &[f64; 4]| {
            let mut point = *line;
            point[self.along as usize] = value;
            numbers(point)
        };
        self.lines.iter().flat_map(point).collect()
    }

    /// Returns `ln(Q/s)` of direct solves.
    fn solved(&self, value: f64) -> Vec<f64> {
        self.row(value, |point| {
            logarithms(self.scene, point).expect("within reach")
        })
    }

    /// Returns `s` for each number of [`Lines::solved`].
    fn scales(&self, value: f64) -> Vec<f64> {
        self.row(value, |[_, e1, nu1, e0]| {
            let es = self
                .scene
                .material([e1, nu1, e0])
                .expect("physical")
                .sphere_film_modulus();
            self.scene
                .quantities
                .iter()
                .map(|quantity| quantity.scale(es))
                .collect()
        })
    }

    fn coordinate(&self, nu1: Coordinate, value: f64) -> f64 {
        if self.along == Parameter::Nu1 {
            nu1.of(value)
        } else {
            self.along.coordinate(value)
        }
    }

    /// Returns the value at a place from 0 to 1 along the lines.
    fn value(&self, nu1: Coordinate, place: f64) -> f64 {
        let ends = self.scene.extents[self.along as usize].ends();
        let [first, last] = ends.map(|end| self.coordinate(nu1, end));
        let coordinate = first + (last - first) * place;
        let value = if self.along == Parameter::Nu1 {
            nu1.value(coordinate)
        } else {
            self.along.value(coordinate)
        };
        value.clamp(ends[0], ends[1])
    }
}

/// The quantities along one axis of the box.
struct Axis<'a> {
    lines: Lines<'a>,
    /// `ln(Q/s)` on every line, over the places in the table's coordinate.
    truth: Splines,
}

impl<'a> Axis<'a> {
    fn solve(scene: &'a Scene, along: Parameter) -> Self {
        let lines = Lines {
            scene,
            along,
            lines: lines(scene, along),
        };
        let nodes = places(DENSE, EVENNESS[0]);
        let rows = nodes
            .par_iter()
            .map(|&place| lines.solved(lines.value(Coordinate::Table, place)))
            .collect();
        Self {
            truth: Splines::through(&nodes, rows, LARGEST_DEGREE),
            lines,
        }
    }

    /// Returns the largest difference of the truth from solves between its nodes.
    fn error_of_truth(&self) -> f64 {
        let error = |place: &f64| {
            let solved = self
                .lines
                .solved(self.lines.value(Coordinate::Table, *place));
            largest(
                self.truth
                    .at(*place)
                    .into_iter()
                    .zip(solved)
                    .map(|(spline, truth)| (spline - truth).abs()),
            )
        };
        largest(
            between(&places(DENSE, EVENNESS[0]))
                .iter()
                .step_by(10)
                .map(error),
        )
    }

    /// Returns the largest relative error of the splines through `count` nodes.
    fn error(&self, choice: &Choice, evenness: f64, count: usize) -> f64 {
        let nodes = places(count, evenness);
        let row = |place: &f64| self.splined(choice, *place);
        let splines = Splines::through(&nodes, nodes.par_iter().map(row).collect(), choice.degree);
        let error = |place: &f64| {
            let pairs = splines
                .at(*place)
                .into_iter()
                .zip(self.splined(choice, *place));
            largest(pairs.map(|(spline, truth)| choice.splined.error(spline, truth)))
        };
        between(&nodes)
            .par_iter()
            .map(error)
            .reduce(|| 0.0, f64::max)
    }

    /// Returns the function that is splined, at a place in the coordinate of the choice.
    fn splined(&self, choice: &Choice, place: f64) -> Vec<f64> {
        let value = self.lines.value(choice.nu1, place);
        let [first, here, last] = [
            self.lines.value(Coordinate::Table, 0.0),
            value,
            self.lines.value(Coordinate::Table, 1.0),
        ]
        .map(|value| self.lines.along.coordinate(value));
        let truth = self
            .truth
            .at(((here - first) / (last - first)).clamp(0.0, 1.0));
        let scales = self.lines.scales(value);
        truth
            .into_iter()
            .zip(scales)
            .map(|(logarithm, scale)| choice.splined.of(logarithm, scale))
            .collect()
    }
}

/// Returns three places in each cell between the nodes.
fn between(nodes: &[f64]) -> Vec<f64> {
    let cell = |pair: &[f64]| [0.25, 0.5, 0.75].map(|share| pair[0] + (pair[1] - pair[0]) * share);
    nodes.windows(2).flat_map(cell).collect()
}

fn largest(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, f64::max)
}
