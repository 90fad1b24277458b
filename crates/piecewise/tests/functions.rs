//! Functions that are known in closed form, on pieces: their values, their slopes and their bounds.

use piecewise::bspline::Basis;
use piecewise::{FUNCTION_TERMS, Fitting, Grid, Piecewise, Resampler};

const RANGE: [f64; 2] = [1e-3, 1e3];
/// The largest error that is asked of the pieces.
const ERROR: f64 = 1e-10;
/// The factors of the four functions.
const SCALES: [f64; 4] = [1.0, 2.0, 1e-9, 1e9];

/// Four functions over their scales, with bends in different octaves.
fn functions(x: f64) -> [f64; 4] {
    [
        1.0 + x * x,
        (-1.0 / (1.0 + x)).exp(),
        x.sqrt() / (0.1 + x),
        2.0 + x.ln().sin(),
    ]
}

/// Their slopes `x df/dx`.
fn slopes(x: f64) -> [f64; 4] {
    let [_, second, third, _] = functions(x);
    [
        2.0 * x * x,
        second * x / (1.0 + x).powi(2),
        third * (0.5 - x / (0.1 + x)),
        x.ln().cos(),
    ]
}

/// The logarithms of `count` nodes.
fn nodes(count: usize) -> Vec<f64> {
    let node = |i: usize| i as f64 / (count - 1) as f64;
    let [from, to] = RANGE.map(f64::ln);
    (0..count).map(|i| from + (to - from) * node(i)).collect()
}

/// The coefficients of splines through the logarithms of these functions.
fn coefficients(basis: &Basis, nodes: &[f64], chosen: &[usize]) -> Vec<f64> {
    let at = |u: &f64| functions(u.exp());
    let values = nodes.iter().map(at);
    let logarithms = values.flat_map(|values| chosen.iter().map(move |&i| values[i].ln()));
    let mut coefficients: Vec<f64> = logarithms.collect();
    basis.interpolate(&mut coefficients, chosen.len());
    coefficients
}

/// Pieces on which polynomials follow these functions.
fn fitted(chosen: &[usize]) -> (Resampler, Vec<f64>) {
    let nodes = nodes(400);
    let basis = Basis::new(&nodes, 9);
    let coefficients = coefficients(&basis, &nodes, chosen);
    let fitting = Fitting {
        range: RANGE,
        curves: 1,
        error: ERROR,
    };
    (
        Resampler::fitting(&basis, chosen, &fitting, |_| &coefficients),
        coefficients,
    )
}

/// Points all over the range, with its ends.
fn points() -> impl Iterator<Item = f64> {
    let [from, to] = RANGE;
    (0..=2000).map(move |i| (from * (to / from).powf(f64::from(i) / 2000.0)).clamp(from, to))
}

#[test]
fn polynomials_are_as_accurate_as_was_asked() {
    let (resampler, coefficients) = fitted(&[0, 1, 2, 3]);
    let found = resampler.exponentials(&coefficients, SCALES);
    let logarithms = resampler.splines(&coefficients);
    let octaves = Grid::most_octaves(RANGE);
    println!("{} pieces in {octaves} octaves", resampler.grid().count());
    assert!(Fitting::may_choose(RANGE, resampler.bits()));
    // Measured: 92.
    assert!(resampler.grid().count() <= 100);
    let (mut worst, mut worst_slope) = (0.0_f64, 0.0_f64);
    for x in points() {
        let (exact, exact_slopes) = (functions(x), slopes(x));
        let [values, slopes] = found.values_and_slopes(x);
        let splines = logarithms.values(x);
        for i in 0..4 {
            assert_eq!(found.value(i, x), values[i]);
            worst = worst.max((values[i] / (SCALES[i] * exact[i]) - 1.0).abs());
            worst = worst.max((splines[i] - exact[i].ln()).abs());
            let slope = slopes[i] / SCALES[i] - exact_slopes[i];
            worst_slope = worst_slope.max((slope / exact[i]).abs());
            let [value, rate] = found.value_and_rate(i, x);
            assert!((value / values[i] - 1.0).abs() < 1e-14);
            assert!((x * rate - slopes[i]).abs() < 1e-12 * values[i]);
        }
    }
    println!("errors: {worst:.1e}, of slopes {worst_slope:.1e}");
    // Between the places that are compared, errors are somewhat larger.
    assert!(worst < 2.0 * ERROR, "{worst:e}");
    assert!(worst_slope < 100.0 * ERROR, "{worst_slope:e}");
}

/// A resampler of some of four functions gives what one of all gives, and 1 in place of others.
#[test]
fn functions_that_are_not_given_are_the_exponentials_of_0() {
    let (of_all, _) = fitted(&[0, 1, 2, 3]);
    let nodes = nodes(400);
    let basis = Basis::new(&nodes, 9);
    let own = Resampler::new(&basis, RANGE, &[3, 1], of_all.bits());
    let found = own.exponentials(&coefficients(&basis, &nodes, &[3, 1]), SCALES);
    for x in points() {
        let (values, exact) = (found.values(x), functions(x));
        assert_eq!([values[0], values[2]], [SCALES[0], SCALES[2]]);
        for i in [1, 3] {
            assert!((values[i] / (SCALES[i] * exact[i]) - 1.0).abs() < 2.0 * ERROR);
        }
    }
}

#[test]
fn many_values_are_those_of_one_after_the_other() {
    let (resampler, coefficients) = fitted(&[0, 1, 2, 3]);
    let found = resampler.exponentials(&coefficients, SCALES);
    let x: Vec<f64> = points().chain([2e3, f64::NAN]).collect();
    let mut values = vec![0.0; x.len()];
    let outside = |x: f64| {
        if x.is_nan() {
            Err("not a number")
        } else {
            Ok(-1.0)
        }
    };
    let result = found.value_at_all(2, &x, &mut values, outside);
    assert_eq!(result, Err("not a number"));
    let inside = x.len() - 2;
    for (&x, value) in x[..inside].iter().zip(&values) {
        assert!((value / found.value(2, x) - 1.0).abs() < 1e-14);
    }
    assert_eq!(values[inside..], [-1.0, 0.0]);
}

#[test]
fn functions_that_leave_a_range_are_found() {
    let (resampler, coefficients) = fitted(&[0, 1, 2, 3]);
    let found: Piecewise<FUNCTION_TERMS> = resampler.exponentials(&coefficients, [1.0; 4]);
    let all = [true; 4];
    assert_eq!(found.leaving(&(1e-3..=1e7), all), None);
    // The first function is 1e6 at the end, the third one 0.03 there.
    let Some((0, value)) = found.leaving(&(1e-3..=1e5), all) else {
        panic!("the first function exceeds 1e5");
    };
    assert!(value > 1e4);
    assert_eq!(
        found.leaving(&(1e-3..=1e5), [false, true, true, true]),
        None
    );
    assert!(matches!(found.leaving(&(0.05..=1e7), all), Some((2, _))));
}
