//! The solve on both sides of each change of its method.

use acceptance::{larger, material, relative_error};
use interp::Material;
use solve::{Method, Solution, solve};

/// Materials that switch from Galerkin's to both other methods, for all reasons: cost, reach and
/// rounding.
const MATERIALS: [[f64; 4]; 13] = [
    // The paper's, and an ordinary film on a softer base.
    [1.75, 0.5, 1e5, 0.25],
    [3.0, 0.3, 1.0, 0.3],
    // Soft films, incompressible and nearly so on rigid bases.
    [1e-3, 0.3, 10.0, 0.25],
    [1e-6, 0.5, f64::INFINITY, 0.25],
    [1e-4, 0.4999, f64::INFINITY, 0.25],
    // Stiff films.
    [1e4, 0.3, 1.0, 0.25],
    [1e4, 0.3, 1e-3, 0.25],
    // Rigid spheres, two of them on films on rigid bases.
    [0.0, 0.3, 10.0, 0.25],
    [0.0, 0.3, f64::INFINITY, 0.25],
    [0.0, 0.5, f64::INFINITY, 0.25],
    // Nearly equal bodies, an auxetic film and an auxetic base.
    [1.0, 0.3, 1.001, 0.3],
    [1.0, -0.9, 1e2, 0.25],
    [1.0, 0.3, 1e-2, -0.9],
];

fn answer(x: f64, material: &Material, tolerance: f64) -> Solution {
    solve(x, material, tolerance).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the pairs of neighbouring `a/t` between which the method changes, one pair for each
/// switch that a scan from 0.01 to 10,000 meets.
fn switches(material: &Material, tolerance: f64) -> Vec<[f64; 2]> {
    const STEPS: u32 = 400;
    let method = |x: f64| answer(x, material, tolerance).method;
    let at = |i: u32| 10.0_f64.powf(-2.0 + 6.0 * f64::from(i) / f64::from(STEPS));
    let scanned: Vec<(f64, Method)> = (0..=STEPS).map(|i| (at(i), method(at(i)))).collect();
    let changes = scanned
        .windows(2)
        .filter(|pair| pair[0].1 != pair[1].1)
        .map(|pair| [pair[0].0, pair[1].0]);
    let close_in = |[mut left, mut right]: [f64; 2]| {
        let before = method(left);
        while right > left.next_up() {
            let middle = left + 0.5 * (right - left);
            if method(middle) == before {
                left = middle
            } else {
                right = middle
            }
        }
        [left, right]
    };
    changes.map(close_in).collect()
}

/// Compares either side of a switch with the solve to the tightest tolerance that is reached, often
/// by the method of the other side. Measured: 52 comparisons, 26 of them with another method, at
/// most 0.14 of the stated errors apart.
#[test]
fn both_sides_of_a_switch_keep_the_tolerance() {
    let (mut worst, mut count, mut others, mut pairs) = (0.0, 0, 0, Vec::new());
    for own in MATERIALS.map(material) {
        let between_rigid = own.e1_over_e2() == 0.0 && own.e0_over_e2() == f64::INFINITY;
        let tight = if between_rigid { 1e-8 } else { 1e-10 };
        for tolerance in [1e-6, tight] {
            for sides in switches(&own, tolerance) {
                let answers = sides.map(|x| answer(x, &own, tolerance));
                pairs.push(answers.map(|answer| answer.method));
                for (x, given) in sides.into_iter().zip(answers) {
                    let tightest = (-26..0)
                        .find_map(|halves| {
                            solve(x, &own, 10_f64.powf(0.5 * f64::from(halves))).ok()
                        })
                        .expect("one of the tolerances is reached");
                    let share = relative_error(&given.quantities, &tightest.quantities)
                        / (given.error + tightest.error);
                    assert!(share <= 1.0, "{own:?} at {x}: {given:?}, {tightest:?}");
                    (worst, count) = (larger(worst, share), count + 1);
                    others += usize::from(given.method != tightest.method);
                }
            }
        }
    }
    println!("{count} {others} {worst:.2}");
    assert!(others >= 5);
    for method in [Method::Axis, Method::Ray] {
        assert!(
            pairs.contains(&[Method::Galerkin, method]),
            "no switch to {method:?}"
        );
    }
}

/// Compares the closed form with the methods that solve nearly equal materials. Measured: 1.7e-14.
#[test]
fn nearly_equal_materials_agree_with_the_closed_form_at_every_a_over_t() {
    const AGREE: f64 = 1e-13;
    let (mut worst, mut others) = (0.0, 0);
    for (e, nu) in [(1.0_f64, 0.3_f64), (1e-3, 0.5), (1e3, 0.0), (30.0, -0.5)] {
        for i in 0..=120 {
            let x = 10.0_f64.powf(-6.0 + 0.1 * f64::from(i)).clamp(1e-6, 1e6);
            let equal = answer(x, &material([e, nu, e, nu]), 1e-12);
            assert_eq!(equal.method, Method::ClosedForm);
            for (film, nu1) in [
                (e.next_up(), nu),
                (e * (1.0 - 1e-15), nu),
                (e, nu.next_down()),
                (e, nu - 1e-15),
            ] {
                let near = answer(x, &material([film, nu1, e, nu]), 1e-12);
                others += usize::from(near.method != Method::ClosedForm);
                worst = larger(worst, relative_error(&near.quantities, &equal.quantities));
            }
        }
    }
    println!("{others} {worst:.1e}");
    assert!(others > 1500);
    assert!(worst <= AGREE);
}
