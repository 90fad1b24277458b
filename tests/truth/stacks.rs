//! Stacks of layers, bonded, sliding or joined by springs, against independent values: the surface
//! compliance and its slope, contacts, and curves.

use acceptance::{Case, Data, larger, random_stack, relative_error};
use solve::stack::Stack;
use solve::{LayeredCompliance, SurfaceCompliance, solve_stack, stack_curve};

/// Largest error of `X - 1` relative to `max(X, 1)`. Measured: 2.1e-15 over the first 2000 random
/// stacks, 2.6e-15 over the first 20,000, 9.0e-16 at the other values.
const EXCESS: f64 = 5e-15;
/// Largest relative error of `X`. Measured: 4.0e-15, for 200 layers; 2.7e-15 over
/// the first 20,000 random stacks.
const X: f64 = 5e-15;
/// Largest error of the slope relative to `max(X, 1)`. Measured: 6.0e-15 over the first 20,000.
const SLOPE: f64 = 1e-14;

/// A kind of stacks: the word that its files in `data/` begin with, and the stack of a row.
type Stacks = (&'static str, fn(&Case<'_>) -> Stack);

/// Layers that are bonded, and layers of which some slide or are joined by springs.
const STACKS: [Stacks; 2] = [
    ("stacks", |case| case.stack()),
    ("interfaces", |case| case.stack_with_interfaces()),
];

/// Values by other programs. Those of bonded layers are of 4 x 4 transfer matrices in ball
/// arithmetic, the others of Love's stress function with one linear system for all layers, which
/// agree to 4.4e-16 of `X` and 6.6e-16 of `max(X, 1)`.
#[test]
fn the_compliance_agrees_with_other_programs() {
    for (kind, stack_of) in STACKS {
        let [mut excess_error, mut x_error] = [0.0; 2];
        for case in Data::read(&format!("{kind}_x")).cases() {
            let stack = stack_of(&case);
            let compliance = LayeredCompliance::new(&stack);
            let top = stack.layers().last().expect("a layer").thickness;
            let (q, x) = (case.get("kt") * top / stack.thickness(), case.get("X"));
            let error = (compliance.sample(q).excess - case.get("X_minus_1")).abs() / x.max(1.0);
            excess_error = larger(excess_error, error);
            x_error = larger(x_error, (compliance.x(q) / x - 1.0).abs());
        }
        println!("largest errors of {kind}: X - 1 {excess_error:.1e}, X {x_error:.1e}");
        assert!(excess_error <= EXCESS);
        assert!(x_error <= X);
    }
}

/// One to 40 layers, moduli over nine decades, thicknesses over four, wave numbers from 1e-8 to 64.
/// `data/stacks_mpmath.py` states the method of the values.
#[test]
fn the_compliance_of_random_stacks_agrees_with_mpmath() {
    let [mut excess_error, mut x_error, mut slope_error] = [0.0; 3];
    let mut count = 0;
    for (seed, case) in Data::read("stacks_mpmath").cases().enumerate() {
        let (stack, q) = random_stack(seed as u64);
        let compliance = LayeredCompliance::new(&stack);
        let (sample, x) = (compliance.sample(q), case.get("x"));
        let scale = x.max(1.0);
        let errors = [
            (sample.excess - case.get("excess")).abs() / scale,
            (compliance.x(q) / x - 1.0).abs(),
            (sample.slope - case.get("slope")).abs() / scale,
        ];
        excess_error = larger(excess_error, errors[0]);
        x_error = larger(x_error, errors[1]);
        slope_error = larger(slope_error, errors[2]);
        count += 1;
    }
    println!("{count} {excess_error:.1e} {x_error:.1e} {slope_error:.1e}");
    assert!(count >= 2000);
    assert!(excess_error <= EXCESS);
    assert!(x_error <= X);
    assert!(slope_error <= SLOPE);
}

/// Measured: 7.3e-15 at the tolerance 1e-12, 3.4e-11 at 1e-8; with interfaces 2.4e-14 and 2.6e-11.
#[test]
fn contacts_agree_and_the_stated_error_bounds_the_true_one() {
    for ((kind, stack_of), (tolerance, allowed)) in STACKS
        .into_iter()
        .flat_map(|stacks| [(1e-12, 1e-13), (1e-8, 1e-9)].map(|allowed| (stacks, allowed)))
    {
        let mut worst = 0.0;
        for case in Data::read(&format!("{kind}_contacts")).cases() {
            let name = case.text("name");
            let solution = solve_stack(case.get("a_over_t"), &stack_of(&case), 1.0, tolerance)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            let error = relative_error(&solution.quantities, &case.quantities());
            assert!(solution.error <= tolerance, "{name}");
            assert!(error <= solution.error, "{name}: {error:e}");
            worst = larger(worst, error);
        }
        println!("largest error of {kind} at {tolerance:e}: {worst:.1e}");
        assert!(worst <= allowed);
    }
}

/// Measured: 1.0e-13, and 5.4e-14 with interfaces.
#[test]
fn curves_agree() {
    const TOLERANCE: f64 = 1e-10;
    for (kind, stack_of) in STACKS {
        let mut worst = 0.0;
        for case in Data::read(&format!("{kind}_contacts")).cases() {
            let x = case.get("a_over_t");
            let curve = stack_curve(&stack_of(&case), 1.0, [0.5 * x, 1.7 * x], TOLERANCE)
                .unwrap_or_else(|e| panic!("{}: {e}", case.text("name")));
            let quantities = curve.quantities(x).expect("between the ends");
            worst = larger(worst, relative_error(&quantities, &case.quantities()));
        }
        println!("largest error of curves of {kind} at {TOLERANCE:e}: {worst:.1e}");
        assert!(worst <= TOLERANCE);
    }
}
