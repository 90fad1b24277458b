//! Layers that slide or are joined by springs: the slope of the surface compliance, and stated errors of
//! random contacts. `stacks.rs` compares them with independent values.

use acceptance::{
    Contacts, Data, larger, layer, relative_error, slopes, solid, springs, with_interfaces,
};
use solve::stack::{Interface, Stack};
use solve::{LayeredCompliance, SurfaceCompliance, solve_stack};

/// Measured: 1.1e-11 of the larger of 1, `X` and the slope.
#[test]
fn the_slope_is_the_derivative_of_the_compliance() {
    let mut worst = 0.0;
    for case in Data::read("interfaces_x").cases() {
        let compliance = LayeredCompliance::new(&case.stack_with_interfaces());
        for q in (0..40).map(|i| 10_f64.powf(-6.0 + 0.18 * f64::from(i))) {
            let [difference] = slopes(5e-3, |log| [compliance.x(q * log.exp())]);
            let slope = compliance.sample(q).slope;
            let unit = compliance.x(q).max(1.0).max(slope.abs());
            worst = larger(worst, (difference - slope).abs() / unit);
        }
    }
    println!("largest difference from the slope: {worst:.1e}");
    assert!(worst <= 1e-10);
}

/// Draws a stack of one to four layers, most of which slide or have springs, of extreme moduli,
/// thicknesses, Poisson ratios and stiffnesses.
fn random_stack(draw: &mut Contacts) -> Stack {
    let poisson = |draw: &mut Contacts| {
        const SPECIAL: [f64; 6] = [0.5, 0.499_999, 0.3, 0.0, -0.5, -0.9];
        SPECIAL[draw.uniform(0.0, 6.0) as usize]
    };
    let base = if draw.uniform(0.0, 1.0) < 0.35 {
        solid(f64::INFINITY, 0.25)
    } else {
        solid(draw.log_uniform(1e-3, 1e3), poisson(draw))
    };
    let count = 1 + draw.uniform(0.0, 4.0) as usize;
    let layers: Vec<_> = (0..count)
        .map(|_| {
            let (young, thickness) = (draw.log_uniform(1e-3, 1e3), draw.log_uniform(0.03, 1.0));
            let interface = match draw.uniform(0.0, 1.0) {
                ..0.2 => Interface::Bonded,
                ..0.5 => Interface::Sliding,
                ..0.7 => springs(young * draw.log_uniform(1e-12, 1e4), f64::INFINITY),
                ..0.8 => springs(f64::INFINITY, young * draw.log_uniform(1e-4, 1e4)),
                _ => springs(
                    young * draw.log_uniform(1e-12, 1e4),
                    young * draw.log_uniform(1e-4, 1e4),
                ),
            };
            (layer(young, poisson(draw), thickness), interface)
        })
        .collect();
    with_interfaces(base, &layers)
}

/// The stated errors at three tolerances against a solve to the tightest one that is reached. `stacks.rs` compares contacts
/// with other programs.
#[test]
fn stated_errors_bound_the_true_ones_of_random_contacts() {
    let mut draw = Contacts::new(34);
    let (mut compared, mut worst) = (0, 0.0);
    for i in 0..120 {
        let stack = random_stack(&mut draw);
        let top = stack.layers().last().expect("a layer").thickness;
        let sphere = [1.0, f64::INFINITY, 1e-3][i % 3];
        let a_over_t = draw.log_uniform(1e-3, 6.0) * top / stack.thickness();
        let solved = |tolerance| solve_stack(a_over_t, &stack, sphere, tolerance);
        let truth = [1e-13, 1e-12, 1e-11]
            .into_iter()
            .find_map(|tolerance| solved(tolerance).ok())
            .unwrap_or_else(|| panic!("{i}: {stack:?}"));
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let solution = solved(tolerance).unwrap_or_else(|e| panic!("{i}: {e}\n{stack:?}"));
            let error = relative_error(&solution.quantities, &truth.quantities);
            let stated = solution.error + truth.error;
            assert!(
                error <= stated,
                "{i}: {error:.1e}, stated {stated:.1e}, a/t = {a_over_t}\n{stack:?}"
            );
            worst = larger(worst, error / stated);
            compared += 1;
        }
    }
    println!("{compared} contacts, at most {worst:.2} of the stated errors");
}
