//! Measures of error, and comparison bit by bit.

use interp::{Material, Quantities, Quantity, Table};

use crate::solved;

/// The tolerance of the direct solves that tables are compared with.
pub const TRUTH: f64 = 1e-11;

/// Returns the larger of two errors, or NaN if either is NaN.
///
/// `f64::max` drops a NaN. A test that folds errors with it would then pass although one of them is
/// not a number.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

/// Returns the relative deviation of `found` from `expected`.
pub fn relative(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// Returns the relative deviation of each of the four quantities from `truth`.
pub fn relative_errors(quantities: &Quantities, truth: &Quantities) -> [f64; 4] {
    let (values, truths) = (quantities.to_array(), truth.to_array());
    std::array::from_fn(|i| (values[i] / truths[i] - 1.0).abs())
}

/// Returns the largest relative deviation of the four quantities from `truth`.
pub fn relative_error(quantities: &Quantities, truth: &Quantities) -> f64 {
    relative_errors(quantities, truth)
        .into_iter()
        .fold(0.0, larger)
}

/// Returns the largest relative error of the quantities that `table` holds, at `x = a/t` and
/// `material`, against a solve to [`TRUTH`].
pub fn error_at(table: &Table, x: f64, material: &Material) -> f64 {
    let truth = solved(x, material, TRUTH);
    let curve = table.curve(material).expect("a material inside the box");
    let error = |quantity| {
        let value = curve
            .quantity(quantity, x)
            .expect("a held quantity inside the box");
        (value / truth.get(quantity) - 1.0).abs()
    };
    table.quantities().into_iter().map(error).fold(0.0, larger)
}

/// Returns the bits of numbers. Unlike values, bits of NaN are equal to themselves.
pub fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Returns the bits of all numbers of a table: those of its axes, then those of each quantity,
/// `None` where the table does not hold it.
pub fn all_bits(table: &Table) -> Vec<Option<Vec<u64>>> {
    let axes = table.axes().map(|(_, nodes)| Some(bits(&nodes)));
    axes.into_iter()
        .chain(Quantity::ALL.map(|quantity| table.values(quantity).map(bits)))
        .collect()
}

/// Asserts that a number is another one, up to an error relative to it.
#[track_caller]
pub fn assert_close(found: f64, expected: f64, error: f64) {
    let is_close = (found / expected - 1.0).abs() < error;
    assert!(is_close, "{found:e}, not {expected:e} to {error:e}");
}

/// Asserts that a number is another one, up to an absolute error.
#[track_caller]
pub fn assert_near(found: f64, expected: f64, error: f64) {
    let is_near = (found - expected).abs() < error;
    assert!(is_near, "{found:e}, not {expected:e} within {error:e}");
}
