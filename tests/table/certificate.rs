//! The certificate of a table, the largest error at sampled points: its points and its numbers.

use acceptance::{forged, larger, table};
use interp::{Parameter, Quantity, Table};
use tabulate::table::{Sample, certificate, errors_by_quantity, measure, sample};

/// Two axes, `a/t` among them, and all quantities.
const TWO_AXES: &str = "
    title      = 'Two axes'
    tolerance  = 1e-5
    a_over_t   = { from = 0.1, to = 10 }
    e1_over_e2 = { from = 0.3, to = 3 }
    nu1        = 0.5
    e0_over_e2 = 1e4
";
/// Four axes with few nodes, so that the error is large.
const FOUR_AXES: &str = "
    title      = 'Four axes'
    tolerance  = 1e-1
    a_over_t   = { from = 0.1, to = 10, nodes = 9 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 4 }
    nu1        = { from = 0.3, to = 0.5, nodes = 4 }
    e0_over_e2 = { from = 10, to = 100, nodes = 3 }
";

fn measured(table: &Table, points: usize, seed: u64) -> Vec<Sample> {
    measure(table, points, seed, &|_| {}).expect("within reach")
}

#[test]
fn of_known_samples_the_worst_the_median_and_what_999_of_1000_keep_are_right() {
    // In another order than that of their errors.
    let samples: Vec<Sample> = (0..2000)
        .map(|i| (i * 1237) % 2000)
        .map(|i| Sample {
            point: [f64::from(i), 1.0, 2.0, 3.0],
            error: 1e-9 * f64::from(i),
            quantity: if i == 1999 {
                Quantity::Gamma
            } else {
                Quantity::Pi0
            },
            errors: [None, None, Some(1e-9 * f64::from(i)), None],
            identity_errors: [(i < 1500).then_some(f64::from(i)), None, None, Some(1.0)],
        })
        .collect();
    let found = certificate(&samples, 5);
    assert_eq!((found.points, found.seed), (2000, 5));
    // Two of the two thousand errors are larger than the third.
    let errors = [found.max_error, found.median_error, found.p999_error];
    assert_eq!(errors, [1999.0, 1000.0, 1997.0].map(|part| 1e-9 * part));
    let worst = (found.worst_quantity, found.worst_point);
    assert_eq!(worst, (Quantity::Gamma, [1999.0, 1.0, 2.0, 3.0]));
    assert_eq!(found.identity_errors, [Some(1499.0), None, None, Some(1.0)]);
    let of_gamma = (Quantity::Gamma, [1999.0, 1000.0].map(|part| 1e-9 * part));
    assert_eq!(errors_by_quantity(&samples), [of_gamma]);

    // Among a few samples, the 99.9 % error is the largest. NaN is larger than all others.
    let mut few = samples[..10].to_vec();
    let largest = few.iter().map(|sample| sample.error).fold(0.0, larger);
    assert_eq!(certificate(&few, 5).p999_error, largest);
    few[3].error = f64::NAN;
    let found = certificate(&few, 5);
    assert!(found.max_error.is_nan() && found.worst_point == few[3].point);
}

#[test]
fn the_points_are_in_the_box_on_its_edges_and_corners_and_few_are_nodes() {
    let table = table(FOUR_AXES);
    let samples = measured(&table, 1000, 3);
    assert_eq!(samples.len(), 1000);
    // A seed gives the same points again.
    let points = |samples: &[Sample]| samples.iter().map(|one| one.point).collect::<Vec<_>>();
    assert_eq!(points(&samples), points(&measured(&table, 1000, 3)));
    let ends = Parameter::ALL.map(|parameter| acceptance::ends(&table, parameter));
    // The number of points on 0, 1, 2, 3 and 4 faces at once.
    let mut counts = [0; 5];
    for point in points(&samples) {
        let places = || point.into_iter().zip(ends);
        assert!(places().all(|(x, (first, last))| (first..=last).contains(&x)));
        let on_faces = places().filter(|&(x, (first, last))| x == first || x == last);
        counts[on_faces.count()] += 1;
    }
    println!("{counts:?}");
    // Every corner is there once. A tenth of the other points is on edges, and a fifth of the
    // random ones on the surface.
    assert_eq!(counts[4], 16);
    assert!(counts[3] >= 95 && counts[1] + counts[2] >= 100 && counts[0] >= 600);
    let nodes = Parameter::ALL.map(|parameter| table.axis(parameter));
    let is_node = |sample: &&Sample| (0..4).all(|k| nodes[k].contains(&sample.point[k]));
    assert_eq!(samples.iter().filter(is_node).count(), 16);

    // The worst point has the error that is certified.
    let found = certificate(&samples, 3);
    let again = sample(&table, found.worst_point).expect("inside");
    assert_eq!(again.error, found.max_error);
    assert_eq!(again.quantity, found.worst_quantity);
    assert!(found.median_error < found.p999_error && found.p999_error <= found.max_error);
    let outside = sample(&table, [0.5, 1e9, 0.4, 30.0]);
    assert!(outside.is_err());
}

/// The values of one quantity are off by one percent. The errors of the identities are those that
/// follow.
#[test]
fn the_identities_are_broken_by_as_much_as_the_values_are() {
    let sound = table(TWO_AXES);
    let scaled = |scaled: Quantity| {
        let factor = |quantity| if quantity == scaled { 1.01 } else { 1.0 };
        forged(&sound, |of, _, value| factor(of) * value, |_| ()).expect("sound values")
    };
    let broken = |table: &Table| {
        let found = certificate(&measured(table, 200, 4), 4);
        found.identity_errors.map(|error| error.expect("held"))
    };
    let kept = broken(&sound);
    println!("kept to {kept:?}");
    // Measured: 1.7e-5 and 9.1e-6, where the quantities are within 1e-5.
    assert!(kept.iter().all(|error| (1e-12..1e-4).contains(error)));
    // Relative to the sizes of the terms of x Eeq' + Eeq = Gamma^2/es,
    // 3 Pi0 + x Pi0' = 4 Eeq (2 Delta0 + x Delta0'), 2 Delta0 + x Delta0' = 2 es Eeq/Gamma^2 and
    // 3 Pi0 + x Pi0' = 8 es Eeq^2/Gamma^2, which are those of the left sides where slopes are not
    // negative, as in this table.
    let (once, twice) = (1.0 - 1.0 / 1.01, 1.0 - 1.0 / (1.01 * 1.01));
    let squared = 1.01 * 1.01 - 1.0;
    for (quantity, expected) in [
        (Quantity::Gamma, [squared, 0.0, twice, twice]),
        (Quantity::Eeq, [once, 0.01, 0.01, squared]),
        (Quantity::Pi0, [0.0, once, 0.0, once]),
        (Quantity::Delta0, [0.0, 0.01, once, 0.0]),
    ] {
        let found = broken(&scaled(quantity));
        for (found, (expected, kept)) in found.iter().zip(expected.iter().zip(kept)) {
            let miss = (found - expected).abs();
            assert!(miss <= 1.1 * kept, "{quantity:?}: {found}, not {expected}");
        }
    }
}

#[test]
fn an_identity_that_takes_more_than_is_held_is_not_measured() {
    let held = |quantities| format!("quantities = [{quantities}]\n{TWO_AXES}");
    for (scene, expected) in [
        (held("'eeq', 'gamma'"), [true, false, false, false]),
        (held("'eeq', 'gamma', 'delta0'"), [true, false, true, false]),
        (held("'pi0', 'eeq', 'delta0'"), [false, true, false, false]),
        (held("'pi0', 'gamma', 'delta0'"), [false; 4]),
        (TWO_AXES.replace("{ from = 0.1, to = 10 }", "1"), [false; 4]),
    ] {
        let found = table(&scene).description().certificate;
        let measured = found.identity_errors.map(|error| error.is_some());
        assert_eq!(measured, expected, "{scene}");
    }
}
