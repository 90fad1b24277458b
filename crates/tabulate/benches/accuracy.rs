//! What accuracy costs in time: one solve by `a/t` and tolerance, with the error that was achieved.
//!
//! Prints the table that the README quotes. The achieved error is the largest of the four relative deviations from the solve at
//! the tightest tolerance that converges, over an ordinary and a hard material; the time is that of the ordinary one.

use std::hint::black_box;
use std::time::Instant;

use interp::{Material, Quantities};
use tabulate::solve::solve;

const A_OVER_T: [f64; 6] = [0.01, 1.0, 10.0, 30.0, 100.0, 1000.0];
const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

fn main() {
    let paper = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let soft = Material::new(1e-2, 0.4999, f64::INFINITY, 0.25).expect("physical");
    println!("| a/t |{}", TOLERANCES.map(|tolerance| format!(" {tolerance:e} |")).concat());
    println!("|---|{}", "---|".repeat(TOLERANCES.len()));
    for x in A_OVER_T {
        let truths = [paper, soft].map(|material| tightest(x, &material));
        let cell = |tolerance: f64| {
            let worst = [paper, soft].into_iter().zip(&truths).map(|(material, truth)| match solve(x, &material, tolerance) {
                Ok(solution) => deviation(&solution.quantities, truth),
                Err(_) => f64::NAN,
            });
            let worst = worst.fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) });
            format!(" {} ({worst:.0e}) |", human(median_seconds(x, &paper, tolerance)))
        };
        println!("| {x} |{}", TOLERANCES.map(cell).concat());
    }
}

/// The most accurate answer that there is.
fn tightest(x: f64, material: &Material) -> Quantities {
    let tolerances = [1e-13, 1e-12, 1e-11, 1e-10];
    let answer = tolerances.iter().find_map(|&tolerance| solve(x, material, tolerance).ok());
    answer.expect("these materials converge to 1e-10").quantities
}

fn deviation(a: &Quantities, b: &Quantities) -> f64 {
    a.to_array().iter().zip(b.to_array()).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

fn median_seconds(x: f64, material: &Material, tolerance: f64) -> f64 {
    let mut times: Vec<f64> = (0..if x > 300.0 { 5 } else { 101 })
        .map(|_| {
            let start = Instant::now();
            let _ = black_box(solve(black_box(x), black_box(material), tolerance));
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn human(seconds: f64) -> String {
    if seconds < 1e-3 { format!("{:.0} µs", seconds * 1e6) } else { format!("{:.1} ms", seconds * 1e3) }
}
