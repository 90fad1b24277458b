//! What accuracy costs in time: one solve by `a/t` and tolerance, with the error that was achieved.
//!
//! Prints the table that the README quotes. The achieved error is the largest of the four relative deviations from the solve at
//! the tightest tolerance that converges, over an ordinary and a hard material; the time is that of the ordinary one.

mod measure;

use interp::Material;
use measure::{deviation, human, median_seconds, tightest};
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
