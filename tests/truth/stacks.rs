//! Stacks of layers against independent values: the surface compliance, and contacts.

use acceptance::{Data, larger, random_stack, relative_error};
use tabulate::solve::{LayeredCompliance, SurfaceCompliance};
use tabulate::{solve_stack, stack_curve};

/// Largest error of `X - 1` relative to `max(X, 1)`.
const EXCESS: f64 = 5e-15;

/// Values by the exponential of 4 x 4 matrices, in ball arithmetic.
#[test]
fn the_compliance_agrees_with_transfer_matrices() {
    let mut worst = 0.0;
    for case in Data::read("stacks_x").cases() {
        let stack = case.stack();
        let compliance = LayeredCompliance::new(&stack);
        let top = stack.layers().last().expect("a layer").thickness;
        let sample = compliance.sample(case.get("kt") * top / stack.thickness());
        let error = (sample.excess - case.get("X_minus_1")).abs() / case.get("X").max(1.0);
        worst = larger(worst, error);
    }
    println!("largest error of X - 1: {worst:.1e}");
    assert!(worst <= EXCESS);
}

/// Up to 40 layers, moduli over nine decades, thicknesses over four, wave numbers from 1e-8 to 64.
/// Measured with the first 20,000 stacks of the program beside the data.
#[test]
fn the_compliance_of_random_stacks_agrees_with_mpmath() {
    let [mut excess_error, mut slope_error, mut count] = [0.0, 0.0, 0.0];
    for (seed, case) in Data::read("stacks_mpmath").cases().enumerate() {
        let (stack, q) = random_stack(seed as u64);
        let sample = LayeredCompliance::new(&stack).sample(q);
        let scale = case.get("x").max(1.0);
        let error = (sample.excess - case.get("excess")).abs() / scale;
        let of_slope = (sample.slope - case.get("slope")).abs() / scale;
        if error > EXCESS || of_slope > 1e-13 {
            println!(
                "{seed} {q:e} {} {error:.1e} {of_slope:.1e}",
                stack.layers().len()
            );
        }
        excess_error = larger(excess_error, error);
        slope_error = larger(slope_error, of_slope);
        count += 1.0;
    }
    println!(
        "{count} stacks: largest error of X - 1 {excess_error:.1e}, of the slope {slope_error:.1e}"
    );
    assert!(excess_error <= EXCESS);
    assert!(slope_error <= 1e-13);
}

#[test]
fn contacts_agree() {
    for (tolerance, allowed) in [(1e-12, 1e-11), (1e-8, 1e-8)] {
        let mut worst = 0.0;
        for case in Data::read("stacks_contacts").cases() {
            let solution = solve_stack(case.get("a_over_t"), &case.stack(), 1.0, tolerance)
                .unwrap_or_else(|e| panic!("{}: {e}", case.text("name")));
            let error = relative_error(&solution.quantities, &case.quantities());
            println!(
                "{} at {}: {error:.1e}, stated {:.1e}, {} modes",
                case.text("name"),
                case.get("a_over_t"),
                solution.error,
                solution.modes
            );
            assert!(error <= solution.error);
            worst = larger(worst, error);
        }
        println!("largest error at {tolerance:e}: {worst:.1e}");
        assert!(worst <= allowed);
    }
}

#[test]
fn curves_agree() {
    for case in Data::read("stacks_contacts").cases() {
        let x = case.get("a_over_t");
        let start = std::time::Instant::now();
        let curve = stack_curve(&case.stack(), 1.0, [0.5 * x, 2.0 * x], 1e-8)
            .unwrap_or_else(|e| panic!("{}: {e}", case.text("name")));
        let quantities = curve.quantities(x).expect("inside");
        println!(
            "{} {x} {:?} {:.1e}",
            case.text("name"),
            start.elapsed(),
            relative_error(&quantities, &case.quantities())
        );
    }
}
