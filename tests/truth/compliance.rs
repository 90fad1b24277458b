//! The compliance function `X(q)` against mpmath, on both sides of the switch of its two forms at
//! `q = 1`.

use acceptance::{Data, larger};
use solve::{Compliance, SurfaceCompliance};

/// Largest relative error of `x`. Measured: 2.0 rounding units.
const X: f64 = 6.0 * f64::EPSILON;
/// Largest error of `excess` relative to `max(X, 1)`. Measured: 2.2 rounding units.
const EXCESS: f64 = 6.0 * f64::EPSILON;
/// Largest error of `slope` relative to `max(X, 1)`. Measured: 13 rounding units, for a film 1e4
/// times stiffer than its substrate.
const SLOPE: f64 = 40.0 * f64::EPSILON;

#[test]
fn x_its_excess_and_its_slope_agree_with_mpmath() {
    let [mut x_error, mut excess_error, mut slope_error] = [0.0; 3];
    for case in Data::read("compliance_mpmath").cases() {
        let (q, x, slope) = (case.get("q"), case.get("x"), case.get("slope"));
        let compliance = Compliance::new(&case.material());
        let sample = compliance.sample(q);
        let scale = x.max(1.0);
        x_error = larger(x_error, (compliance.x(q) / x - 1.0).abs());
        excess_error = larger(excess_error, (sample.excess - (x - 1.0)).abs() / scale);
        slope_error = larger(slope_error, (sample.slope - slope).abs() / scale);
    }
    let [x, excess, slope] = [x_error, excess_error, slope_error].map(|error| error / f64::EPSILON);
    println!("largest errors in rounding units: x {x:.1}, excess {excess:.1}, slope {slope:.1}");
    assert!(x_error <= X);
    assert!(excess_error <= EXCESS);
    assert!(slope_error <= SLOPE);
}
