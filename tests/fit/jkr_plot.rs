//! The reduced JKR plot of a fit.

use fit::report::jkr_plot;
use fit::{Bodies, Experiment, Free, Kind, Measurement, Options, Parameter, Point, fit, simulate};
use interp::{Elastic, HalfSpace, Probe, Table};

fn experiment(kind: Kind, probe: Probe) -> Experiment {
    let point = |i: u64| Point {
        line: i + 1,
        abscissa: 4e-5 + 2e-6 * i as f64,
        ordinate: 0.0,
        direction: None,
    };
    let measurement = Measurement {
        name: "lens".into(),
        kind,
        points: (0..30).map(point).collect(),
    };
    let bodies = Bodies::HalfSpace(HalfSpace {
        probe,
        sphere_modulus: f64::INFINITY,
        solid: Elastic::new(1.5e6, 0.5).expect("a solid"),
    });
    Experiment {
        work_of_adhesion: 0.04,
        load_offset: 3e-5,
        ..Experiment::new(measurement, bodies)
    }
}

/// Eq. 1 of the paper: `y = 4 E*/(3 sqrt 6) x - sqrt(4 w E*/3)` with `E* = 2 MPa`.
#[test]
fn a_half_space_is_the_straight_line_of_jkr_whatever_the_offset() {
    let planned = experiment(Kind::LoadRadius, Probe::Paraboloid { radius: 1e-3 });
    let measurement = simulate(Table::embedded(), &planned, 0.0, 0).expect("simulated");
    let measured = Experiment {
        measurement,
        noise: Some(1e-9),
        load_offset: 0.0,
        ..planned
    };
    let free = [
        Parameter::FilmModulus,
        Parameter::WorkOfAdhesion,
        Parameter::LoadOffset,
    ]
    .map(Free::new);
    let experiments = [measured];
    let found = fit(Table::embedded(), &experiments, &free, &Options::default()).expect("fitted");
    let points = jkr_plot(&found, &experiments[0], 0).expect("a JKR plot");
    let (modulus, w) = (2e6_f64, 0.04);
    for point in points {
        let point = point.expect("a contact");
        let line = 4.0 * modulus / (3.0 * 6.0_f64.sqrt()) * point.abscissa
            - (4.0 * w * modulus / 3.0).sqrt();
        for ordinate in [point.measured, point.fit.expect("used")] {
            assert!((ordinate - line).abs() < 1e-4 * line.abs().max(100.0));
        }
    }
}

#[test]
fn other_measurements_and_probes_are_refused_with_the_reason() {
    let paraboloid = Probe::Paraboloid { radius: 1e-3 };
    let cone = Probe::Cone { half_angle: 1.5 };
    let one = fit(
        Table::embedded(),
        &[Experiment {
            measurement: simulate(
                Table::embedded(),
                &experiment(Kind::LoadRadius, paraboloid.clone()),
                1e-6,
                0,
            )
            .expect("simulated"),
            ..experiment(Kind::LoadRadius, paraboloid.clone())
        }],
        &[Free::new(Parameter::FilmModulus)],
        &Options::default(),
    )
    .expect("fitted");
    for (kind, probe, word) in [
        (Kind::PenetrationRadius, paraboloid, "contact radii"),
        (Kind::LoadRadius, cone, "radius of curvature"),
    ] {
        let refused = jkr_plot(&one, &experiment(kind, probe), 0).expect_err("refused");
        assert!(refused.to_string().contains(word), "{refused}");
    }
}
