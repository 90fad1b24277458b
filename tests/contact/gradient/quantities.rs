//! The quantities as functions of a/t, the moduli and the Poisson ratios.

use acceptance::{Contacts, derivatives, direct, larger, material};
use interp::{MaterialParameter, Quantities, Quantity, QuantityGradient, Table};

use super::SHARES;

/// Draws points of a box of moduli, with ordinary, nearly incompressible and incompressible films,
/// away from the ends of the box, and some points of thicker films.
fn points() -> Vec<(f64, [f64; 4])> {
    let mut contacts = Contacts::new(301);
    let mut points = Vec::new();
    for i in 0..80 {
        let nu1 = match i % 4 {
            0 => 0.5,
            1 => 0.5 - contacts.log_uniform(1e-7, 1e-2),
            _ => contacts.uniform(0.01, 0.49),
        };
        // On the table's own substrate, and on others that keep the equivalent inside.
        let nu0 = if i % 3 == 0 {
            contacts.uniform(0.26, 0.49)
        } else {
            0.25
        };
        let x = if i < 60 {
            contacts.log_uniform(1.1e-3, 900.0)
        } else {
            contacts.log_uniform(1e-6, 9e-4)
        };
        let (e1, e0) = (
            contacts.log_uniform(2e-3, 5e2),
            contacts.log_uniform(2.0, 5e5),
        );
        if Table::embedded()
            .curve(&material([e1, nu1, e0, nu0]))
            .is_ok()
        {
            points.push((x, [e1, nu1, e0, nu0]));
        }
    }
    assert!(points.len() > 60, "{} points", points.len());
    points
}

/// Draws points with incompressible or nearly incompressible films at the soft end of the box and
/// next to it, where the quantities change most with `nu1`.
fn softest() -> Vec<(f64, [f64; 4])> {
    let mut contacts = Contacts::new(302);
    let point = |i: u32| {
        let nu1 = if i.is_multiple_of(2) {
            0.5
        } else {
            0.5 - contacts.log_uniform(1e-7, 9e-4)
        };
        let e1 = if i % 4 < 2 {
            1e-3
        } else {
            contacts.log_uniform(1e-3, 3e-3)
        };
        (
            contacts.log_uniform(0.1, 100.0),
            [e1, nu1, contacts.log_uniform(2.0, 5e5), 0.25],
        )
    };
    (0..200).map(point).collect()
}

/// Draws points on the faces of the box, where one or two moduli are at its ends.
fn faces() -> Vec<(f64, [f64; 4])> {
    let mut contacts = Contacts::new(303);
    let point = |i: usize| {
        let nu1 = [
            0.5,
            0.5 - contacts.log_uniform(1e-7, 1e-2),
            contacts.uniform(0.01, 0.49),
        ][i % 3];
        let (soft, any) = (
            contacts.log_uniform(1e-3, 1e3),
            contacts.log_uniform(1.0, 1e6),
        );
        let moduli = [
            [1e-3, 1.0],
            [1e-3, 1e6],
            [1e-3, any],
            [1e3, 1.0],
            [1e3, 1e6],
            [1e3, any],
            [soft, 1.0],
            [soft, 1e6],
        ];
        let [e1, e0] = moduli[i / 3 % moduli.len()];
        (contacts.log_uniform(1.1e-3, 900.0), [e1, nu1, e0, 0.25])
    };
    (0..120).map(point).collect()
}

/// Draws points of everything that the embedded table answers: every ratio of moduli from 1e-9 to
/// 1e9, nearly rigid spheres and substrates, and any pair of Poisson ratios. Returns those of `count` that it answers.
fn everywhere(count: usize) -> Vec<(f64, [f64; 4])> {
    let mut contacts = Contacts::new(304);
    let point = |i: usize| {
        let mut nu = || match contacts.uniform(0.0, 3.0) as u32 {
            0 => 0.5,
            1 => 0.5 - contacts.log_uniform(1e-7, 1e-2),
            _ => contacts.uniform(0.01, 0.49),
        };
        let [nu1, nu0] = [nu(), nu()];
        let [e1, e0] = [0, 1].map(|_| contacts.log_uniform(1e-9, 1e9));
        // A sphere far stiffer than film and substrate, a substrate far stiffer than sphere and
        // film, or neither.
        let [e1, e0] = match i % 4 {
            0 => [e1 * 1e-12, e0 * 1e-12],
            1 => [e1, e0 * 1e12],
            _ => [e1, e0],
        };
        (contacts.log_uniform(1.1e-3, 900.0), [e1, nu1, e0, nu0])
    };
    let answered =
        |&(_, parameters): &(f64, [f64; 4])| Table::embedded().curve(&material(parameters)).is_ok();
    let points: Vec<_> = (0..count).map(point).filter(answered).collect();
    assert!(3 * points.len() > 2 * count, "{} points", points.len());
    points
}

fn assert_derivatives(points: &[(f64, [f64; 4])]) {
    let worst = worst_misses(points);
    println!("in tolerances, with respect to a/t, E1, nu1, E0, nu0: {worst:.1?}");
    let mut pairs = worst.iter().zip(SHARES);
    assert!(pairs.all(|(&worst, share)| worst <= share), "{worst:.1?}");
}

#[test]
fn derivatives_are_those_of_direct_solves() {
    // Measured: 1.3, 3.5, 43, 0.6, 1.5; 2.8, 0.7, 50, 0.2, 0.2; 1.9, 1.2, 51, 3.1, 2.3; 2.3, 1.2, 36, 1.1, 8.3.
    for points in [points(), softest(), faces(), everywhere(120)] {
        assert_derivatives(&points);
    }
}

#[test]
#[ignore = "takes 20 s, for the numbers of COST.md"]
fn derivatives_at_two_thousand_contacts_are_those_of_direct_solves() {
    // Measured: 2.7, 9.5, 57, 9.5, 18.
    assert_derivatives(&everywhere(2400));
}

/// Returns the largest errors at `points`, in tolerances, in the order of [`SHARES`]: of curves with all
/// derivatives, and of curves with one.
fn worst_misses(points: &[(f64, [f64; 4])]) -> [f64; 5] {
    let table = Table::embedded();
    let tolerance = table.description().tolerance;
    let mut worst = [0.0; 5];
    for &(x, parameters) in points {
        let own = material(parameters);
        let curve = table.curve_with_gradient(&own).expect("inside");
        let gradient = curve.gradient(x).expect("inside");
        let [e1, nu1, e0, nu0] = parameters;
        // The quantities change on this range of the film's Poisson ratio.
        let scale = (1.0 - 2.0 * nu1) + 1.0 / (1.0 + x * x);
        let log = |x: f64, parameters: [f64; 4]| direct(x, parameters).to_array().map(f64::ln);
        let step = 0.005 * scale.min(0.5);
        // In the order of `SHARES`.
        let truths = [
            derivatives(0.01, false, |h| log(x * h.exp(), parameters)),
            derivatives(0.01, false, |h| log(x, [e1 * h.exp(), nu1, e0, nu0])),
            derivatives(step, nu1 + 2.0 * step > 0.5, |h| {
                log(x, [e1, nu1 + h, e0, nu0])
            }),
            derivatives(0.01, false, |h| log(x, [e1, nu1, e0 * h.exp(), nu0])),
            derivatives(0.005, nu0 > 0.48, |h| log(x, [e1, nu1, e0, nu0 + h])),
        ];
        let alone: [QuantityGradient; 4] = std::array::from_fn(|number| {
            let wanted = [MaterialParameter::ALL[number]];
            let curve = table.curve_with_derivatives(&own, &wanted).expect("inside");
            curve.gradient(x).expect("inside")
        });
        let found = [[gradient; 4], alone].map(|[of_e1, of_nu1, of_e0, of_nu0]| {
            let by = |gradient: QuantityGradient, parameter| {
                gradient.by(parameter).expect("an axis").to_array()
            };
            [
                of_e1.slopes().to_array(),
                by(of_e1, MaterialParameter::E1OverE2).map(|rate| rate * e1),
                by(of_nu1, MaterialParameter::Nu1),
                by(of_e0, MaterialParameter::E0OverE2).map(|rate| rate * e0),
                by(of_nu0, MaterialParameter::Nu0),
            ]
        });
        let units = [1.0, 1.0, scale, 1.0, 1.0];
        let values = gradient.values().to_array();
        for (i, worst) in worst.iter_mut().enumerate() {
            for (k, value) in values.iter().enumerate() {
                for found in &found {
                    let miss = (found[i][k] / value - truths[i][k]).abs() * units[i] / tolerance;
                    *worst = larger(*worst, miss);
                }
            }
        }
    }
    worst
}

/// Compares the derivatives with differences of lookups, which are splines in the logarithms of the
/// moduli and in `c(nu1)`.
#[test]
fn derivatives_of_the_quantities_are_those_of_the_interpolant() {
    let table = Table::embedded();
    let mut worst = 0.0;
    for (x, parameters) in points() {
        let gradient = table
            .curve_with_gradient(&material(parameters))
            .and_then(|curve| curve.gradient(x))
            .expect("inside");
        let [e1, nu1, e0, nu0] = parameters;
        // At nu1 = 0.5 the table ends, and near it the differences would have to be as small as
        // rounding.
        let near = nu1 > 0.48;
        let log = |x: f64, parameters: [f64; 4]| {
            let curve = table.curve(&material(parameters)).expect("inside");
            Quantity::ALL.map(|quantity| curve.quantity(quantity, x).expect("inside").ln())
        };
        let values = gradient.values().to_array();
        let mut compare = |found: Quantities, unit: f64, expected: [f64; 4]| {
            for ((found, value), expected) in found.to_array().iter().zip(values).zip(expected) {
                let difference = found * unit / value - expected;
                worst = larger(worst, difference.abs() / (1.0 + expected.abs()));
            }
        };
        let by = |parameter| gradient.by(parameter).expect("an axis");
        compare(
            gradient.slopes(),
            1.0,
            derivatives(1e-3, false, |h| log(x * h.exp(), parameters)),
        );
        compare(
            by(MaterialParameter::E1OverE2),
            e1,
            derivatives(1e-3, false, |h| log(x, [e1 * h.exp(), nu1, e0, nu0])),
        );
        compare(
            by(MaterialParameter::E0OverE2),
            e0,
            derivatives(1e-3, false, |h| log(x, [e1, nu1, e0 * h.exp(), nu0])),
        );
        if !near {
            compare(
                by(MaterialParameter::Nu1),
                1.0,
                derivatives(1e-4, false, |h| log(x, [e1, nu1 + h, e0, nu0])),
            );
            compare(
                by(MaterialParameter::Nu0),
                1.0,
                derivatives(1e-4, false, |h| log(x, [e1, nu1, e0, nu0 + h])),
            );
        }
    }
    let worst = worst / table.description().tolerance;
    println!("largest difference {worst:.2} tolerances");
    // Measured: 0.19, most of it the rounding of the differences: a lookup holds those of its
    // numbers in single precision whose rounding is small compared with the tolerance.
    assert!(worst <= 1.0);
}
