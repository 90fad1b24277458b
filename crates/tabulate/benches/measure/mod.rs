//! How the benches measure errors and times.

use std::hint::black_box;
use std::time::Instant;

use interp::{Material, Quantities};
use tabulate::solve::solve;

/// The most accurate answer that there is.
pub fn tightest(x: f64, material: &Material) -> Quantities {
    let tolerances = [1e-13, 1e-12, 1e-11, 1e-10, 1e-9];
    let answer = tolerances.iter().find_map(|&tolerance| solve(x, material, tolerance).ok());
    answer.expect("these materials converge to 1e-9").quantities
}

/// The largest of the four relative deviations; what is less than half a unit of rounding counts as that.
pub fn deviation(a: &Quantities, b: &Quantities) -> f64 {
    a.to_array().iter().zip(b.to_array()).map(|(a, b)| (a / b - 1.0).abs()).fold(0.5 * f64::EPSILON, f64::max)
}

/// The median time of one solve.
pub fn median_seconds(x: f64, material: &Material, tolerance: f64) -> f64 {
    let times = (0..if x > 300.0 { 5 } else { 101 }).map(|_| {
        let start = Instant::now();
        let _ = black_box(solve(black_box(x), black_box(material), tolerance));
        start.elapsed().as_secs_f64()
    });
    median(times.collect())
}

/// The middle one of at least one time.
pub fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// A time with its unit.
pub fn human(seconds: f64) -> String {
    if seconds < 1e-3 { format!("{:.0} µs", seconds * 1e6) } else { format!("{:.1} ms", seconds * 1e3) }
}
