//! Compressed functions that are known in closed form: their values, their slopes and their size.

use low_rank::compress::{Axis, NotReached, compress};
use low_rank::{IntegerTrain, PreparedTrain, coarser};
use piecewise::bspline::Basis;

const COUNT: usize = 12;

/// Two functions of (`y`, `u`, `v`, `w`) in `[0, 1]`.
fn functions([y, u, v, w]: [f64; 4]) -> [f64; 2] {
    [
        (1.0 + y + u * v).ln() * (w - y).cos(),
        (y * u - 2.0 * v * w).exp() / (1.5 + w),
    ]
}

/// The derivatives of the two functions with respect to `u`, `v` and `w`.
fn slopes([y, u, v, w]: [f64; 4]) -> [[f64; 2]; 3] {
    let (sum, angle) = (1.0 + y + u * v, w - y);
    let other = (y * u - 2.0 * v * w).exp() / (1.5 + w);
    [
        [v / sum * angle.cos(), y * other],
        [u / sum * angle.cos(), -2.0 * w * other],
        [
            -sum.ln() * angle.sin(),
            -(2.0 * v + 1.0 / (1.5 + w)) * other,
        ],
    ]
}

fn nodes() -> Vec<f64> {
    (0..COUNT).map(|i| i as f64 / (COUNT - 1) as f64).collect()
}

/// Compresses the functions at the nodes of a part of the box.
fn compressed(part: [usize; 2], error: f64) -> Result<IntegerTrain, NotReached> {
    let axis = |nodes_of_box| Axis {
        coordinates: nodes(),
        nodes: nodes_of_box,
        smooth_degree: 20.0,
    };
    let whole = [0, COUNT - 1];
    let mut values = Vec::new();
    for u in nodes() {
        for v in nodes() {
            for w in nodes() {
                values.extend(nodes().iter().flat_map(|&y| functions([y, u, v, w])));
            }
        }
    }
    compress(
        [axis(part), axis(whole), axis(whole), axis(whole)],
        2,
        &values,
        error,
    )
}

/// The prepared train evaluated: both functions at a place, and their slopes along `u`, `v` and `w`.
struct Evaluated {
    basis: Basis,
    prepared: PreparedTrain,
}

impl Evaluated {
    fn new(train: &IntegerTrain, ends: [[f64; 2]; 4], tolerance: f64) -> Self {
        let basis = Basis::of_table(&nodes());
        let prepared = PreparedTrain::new(train, ends, &nodes(), &basis, tolerance);
        Self { basis, prepared }
    }

    fn at(&self, [y, u, v, w]: [f64; 4]) -> [[f64; 2]; 4] {
        let weights = self.basis.weights(y);
        self.prepared
            .coefficients_and_slopes([u, v, w], [true; 3])
            .map(|coefficients| {
                [0, 1].map(|function| {
                    let of = |k: usize| coefficients[2 * (weights.first + k) + function];
                    (0..weights.count).map(|k| weights.values[k] * of(k)).sum()
                })
            })
    }
}

/// Places spread evenly over the part `[from, to]` of `u`, and over the other axes (an additive
/// recurrence).
fn places([from, to]: [f64; 2]) -> impl Iterator<Item = [f64; 4]> {
    (1..400).map(move |i| {
        let [y, u, v, w] = [0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_2]
            .map(|s| (f64::from(i) * s).fract());
        [y, from + (to - from) * u, v, w]
    })
}

#[test]
fn values_and_slopes_keep_the_error() {
    for (part, error) in [
        ([0, COUNT - 1], 1e-3),
        ([0, COUNT - 1], 1e-7),
        ([3, 9], 1e-6),
    ] {
        let train = compressed(part, error).expect("it reaches the error");
        let from_to = part.map(|node| nodes()[node]);
        let ends = [[0.0, 1.0], from_to, [0.0, 1.0], [0.0, 1.0]];
        let evaluated = Evaluated::new(&train, ends, error);
        let (mut of_value, mut of_slope) = (0.0_f64, 0.0_f64);
        for place in places(from_to) {
            let [found, found_slopes @ ..] = evaluated.at(place);
            for (found, exact) in found.iter().zip(functions(place)) {
                of_value = of_value.max((found - exact).abs());
            }
            let found = found_slopes.as_flattened().iter();
            for (found, exact) in found.zip(slopes(place).as_flattened()) {
                of_slope = of_slope.max((found - exact).abs());
            }
        }
        let bytes = train.coded_integers().len();
        println!("{error:e}: {of_value:.1e}, slopes {of_slope:.1e}, {bytes} bytes");
        // Between the nodes, the splines of 12 nodes add an error of their own.
        assert!(of_value < 1.5 * error + 2e-8, "{error:e}: {of_value:e}");
        assert!(of_slope < 200.0 * error, "{error:e}: {of_slope:e}");
        assert!(bytes < 8 * 2 * COUNT.pow(4) / 64, "{bytes} bytes");
    }
}

#[test]
fn an_error_below_rounding_is_not_reached() {
    let result = compressed([0, COUNT - 1], 1e-18);
    assert!(
        matches!(result, Err(NotReached { error: 1e-18, reached }) if reached > 1e-18),
        "{result:?}"
    );
}

/// Factors that cancel between two neighbouring cores change nothing: what an evaluation leaves out
/// depends on the product only.
#[test]
fn evaluation_depends_on_the_product_of_the_cores_only() {
    let train = compressed([0, COUNT - 1], 1e-5).expect("it reaches the error");
    let ends = [[0.0, 1.0]; 4];
    let before = Evaluated::new(&train, ends, 1e-5);
    for bond in 0..3 {
        for factor in [-7_i8, 7] {
            let mut weights = train.exponents().clone();
            // The step is a factor of all four cores.
            weights[bond]
                .iter_mut()
                .for_each(|weight| *weight += 4 * factor);
            let changed = IntegerTrain::of_code(
                train.functions(),
                train.order(),
                train.smooth_degrees(),
                train.terms(),
                weights,
                train.step() * f64::from(factor).exp2(),
                &train.coded_integers(),
            );
            let after = Evaluated::new(&changed.expect("sound"), ends, 1e-5);
            for place in places([0.0, 1.0]).take(20) {
                let [found, ..] = after.at(place);
                let [expected, ..] = before.at(place);
                for (found, expected) in found.iter().zip(expected) {
                    assert!(
                        (found - expected).abs() < 1e-12,
                        "bond {bond}, {factor}: {found}, not {expected}"
                    );
                }
            }
        }
    }
}

/// The largest error of the values of a train at the nodes of the whole box.
fn error_at_nodes(train: &IntegerTrain) -> f64 {
    let nodes = nodes();
    let values = train.values([[0.0, 1.0]; 4], [&nodes; 4].map(Vec::as_slice));
    let mut values = values.chunks_exact(2);
    let mut largest = 0.0_f64;
    for &u in &nodes {
        for &v in &nodes {
            for &w in &nodes {
                for &y in &nodes {
                    let found = values.next().expect("a value at each node");
                    for (found, exact) in found.iter().zip(functions([y, u, v, w])) {
                        largest = largest.max((found - exact).abs());
                    }
                }
            }
        }
    }
    largest
}

#[test]
fn a_coarser_train_is_smaller_by_an_error_that_grows_with_its_step() {
    let train = compressed([0, COUNT - 1], 1e-8).expect("a train");
    let count = |train: &IntegerTrain| train.cores().iter().map(Vec::len).sum::<usize>();
    assert!(error_at_nodes(&train) < 1e-8);
    assert_eq!(coarser(&train, 1).expect("a train").step(), train.step());
    let (mut before, mut error) = (count(&train), 1e-8);
    for factor in [30, 1000, 30_000] {
        let coarse = coarser(&train, factor).expect("a train");
        assert!(
            count(&coarse) < before,
            "{factor}: {} {before}",
            count(&coarse)
        );
        assert!(error_at_nodes(&coarse) > error, "{factor}: {error:e}");
        (before, error) = (count(&coarse), error_at_nodes(&coarse));
        assert!(error < 3e-8 * factor as f64, "{factor}: {error:e}");
    }
}
