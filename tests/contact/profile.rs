//! Measured shapes of probes.

use acceptance::{Refused, assert_matches, on_half_space, solid};
use interp::{Error, Probe, Profile};

#[test]
fn evenly_spaced_points_of_a_paraboloid_give_the_paraboloid() {
    let points: Vec<[f64; 2]> = (0..20)
        .map(|i| 1e-7 * f64::from(i))
        .map(|r| [r, r * r / 2e-6])
        .collect();
    let profile = Profile::new(&points).expect("convex");
    for &[r, slope] in profile.slopes() {
        assert!((slope - r / 1e-6).abs() < 1e-12, "{r}: {slope}");
    }
    assert_eq!(profile.end(), points[19][0]);
    let without_origin = Profile::new(&points[1..]).expect("convex");
    assert_eq!(without_origin, profile);
}

/// The slope rises from half the shorter distance to the points beside the last one of height 0.
#[test]
fn the_flat_end_of_a_profile_bounds_its_contacts() {
    let end = |points: &[[f64; 2]]| Profile::new(points).expect("convex").flat_end();
    assert_eq!(end(&[[0.0, 0.0], [1.0, 0.5], [2.0, 2.0]]), 0.0);
    let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 1.0]];
    assert_eq!(end(&flat), 1.5);
    assert_eq!(end(&flat[2..]), 1.5);
    let probe = Probe::Profile(Profile::new(&flat).expect("convex"));
    let contact = on_half_space(probe, solid(1.0, 0.3));
    assert_eq!(contact.contact_radius_range()[0], 1.5);
    assert_eq!(contact.load(1.5, 0.0).expect("the smallest contact"), 0.0);
    contact
        .load(1.4, 0.0)
        .refused("at least the radius of the flat end, 1.5 m");
}

/// A cone behind a flat end, however its points are spaced: loads at all contacts but those at the rounded edge.
#[test]
fn a_flat_end_has_the_width_of_its_points() {
    let half_angle = 70_f64.to_radians();
    let shape = |r: f64| [r, (r - 1.0).max(0.0) / half_angle.tan()];
    let cone = Probe::FlatEndedCone {
        radius: 1.0,
        half_angle,
    };
    let exact = on_half_space(cone, solid(1.0, 0.3));
    for radii in [&[0.0, 1.0, 1.01, 3.0][..], &[0.0, 0.99, 1.0, 3.0]] {
        let points: Vec<[f64; 2]> = radii.iter().copied().map(shape).collect();
        let profile = Profile::new(&points).expect("convex");
        assert!((profile.flat_end() - 0.995).abs() < 1e-12);
        let measured = on_half_space(Probe::Profile(profile), solid(1.0, 0.3));
        for a in [1.03, 1.2, 2.0, 2.9] {
            let [load, expected] =
                [&measured, &exact].map(|one| one.load(a, 0.0).expect("it is larger"));
            assert!(
                (load / expected - 1.0).abs() < 2e-3,
                "{a}: {load} {expected}"
            );
        }
    }
}

#[test]
fn errors_name_the_row() {
    let row = |points: &[[f64; 2]]| match Profile::new(points) {
        Err(Error::Profile { row, .. }) => row,
        other => panic!("{other:?}"),
    };
    assert_eq!(row(&[]), 0);
    assert_eq!(row(&[[0.0, 0.0]]), 1);
    assert_eq!(row(&[[0.0, 0.0], [1.0, 1.0], [2.0, 1.5]]), 3);
    assert_eq!(row(&[[0.0, 0.0], [1.0, 1.0], [1.0, 2.5]]), 3);
    assert_eq!(row(&[[1.0, 1.0], [2.0, f64::NAN]]), 2);
    assert_eq!(row(&[[0.0, 0.0], [1.0, -1.0]]), 2);
    assert_eq!(row(&[[0.0, 1.0], [1.0, 1.0]]), 2);
    assert_eq!(row(&[[-1.0, 1.0], [1.0, 2.0]]), 1);
    let many: Vec<[f64; 2]> = (0..201)
        .map(|i| [f64::from(i), f64::from(i).powi(2)])
        .collect();
    assert_eq!(row(&many), 201);
}

/// Points of a cone, and of a sphere that goes over into a cone, in numbers of few digits are taken, and differ from
/// exact ones by no more than the rounding of a chord.
#[test]
fn rounded_numbers_of_straight_flanks_are_taken() {
    let angle = 70_f64.to_radians();
    let cone = |r: f64| r / angle.tan();
    let radius = 0.2;
    let joint = radius * angle.cos();
    let tip = |r: f64| {
        let sphere = |r: f64| radius - (radius * radius - r * r).sqrt();
        if r < joint {
            sphere(r)
        } else {
            sphere(joint) + (r - joint) / angle.tan()
        }
    };
    let shapes: [&dyn Fn(f64) -> f64; 2] = [&cone, &tip];
    for shape in shapes {
        for decimals in [3, 4, 6, 9, 12] {
            let rounded = |value: f64| -> f64 {
                let text = format!("{value:.decimals$}");
                text.parse::<f64>().expect("a number") * 1e-6
            };
            let radii = (0..=40).map(|i| 0.1 * f64::from(i));
            let points: Vec<[f64; 2]> = radii
                .clone()
                .map(|r| [rounded(r), rounded(shape(r))])
                .collect();
            let profile = Profile::new(&points).expect("convex but for rounding");
            for r in radii.filter(|r| (0.6..4.0).contains(r)) {
                let error = profile.slope(r * 1e-6) - 1.0 / angle.tan();
                // Two heights are rounded, at a distance of 0.1.
                let allowed = 1e-9 + 10.0 * 0.1_f64.powi(decimals as i32);
                assert!(error.abs() <= allowed, "{decimals} {r}: {error}");
            }
        }
    }
}

/// Only as much as rounding makes may fail to be convex, and the error names the row where the slope falls.
#[test]
fn what_is_not_convex_is_refused() {
    // A cone of three decimals, whose slopes fall in many rows, with a bump in one.
    let rounded = |r: f64| (364.0 * r).round() * 1e-3;
    let radii = (0..=40).map(|i| 0.1 * f64::from(i));
    let mut cone: Vec<[f64; 2]> = radii.map(|r| [r, rounded(r)]).collect();
    assert!(Profile::new(&cone).is_ok());
    cone[30][1] += 0.03;
    assert_matches!(Profile::new(&cone), Err(Error::Profile { row: 32, .. }));
    // The end of a tip of 7 um is not rewritten.
    let tip = [
        [0.0, 0.0],
        [5e-3, 6e-3],
        [20e-3, 8e-3],
        [60e-3, 12e-3],
        [20.0, 7.0],
    ];
    assert_matches!(Profile::new(&tip), Err(Error::Profile { row: 3, .. }));
    let bump =
        |height: f64| Profile::new(&[[0.0, 0.0], [1.0, 1.0 + height], [2.0, 2.0], [3.0, 3.0]]);
    assert!(bump(2.9e-3).is_ok());
    assert!(matches!(bump(3.1e-3), Err(Error::Profile { row: 3, .. })));
}
