//! The reduced JKR plot of a fit.

use acceptance::{Refused, half_space_of, solid};
use fit::report::jkr_plot;
use fit::{Bodies, Experiment, Free, Kind, Parameter, simulate};
use interp::{Probe, Table};

use crate::imagined::{fit_all, measurement_at};

fn experiment(kind: Kind, probe: Probe) -> Experiment {
    let radii = (0..30).map(|i| 4e-5 + 2e-6 * f64::from(i));
    let bodies = Bodies::half_space(half_space_of(probe, f64::INFINITY, solid(1.5e6, 0.5)));
    Experiment {
        work_of_adhesion: 0.04,
        load_offset: 3e-5,
        ..Experiment::new(measurement_at(kind, radii), bodies)
    }
}

/// Eq. 1 of the paper: `y = 4 E*/(3 sqrt 6) x - sqrt(4 w E*/3)` with `E* = 2 MPa`.
#[test]
fn a_half_space_is_the_straight_line_of_jkr_whatever_the_offset() {
    let planned = experiment(Kind::LoadRadius, Probe::Paraboloid { radius: 1e-3 });
    let measured = Experiment {
        noise: Some(1e-9),
        load_offset: 0.0,
        ..simulate(Table::embedded(), &planned, 0.0, 0).expect("simulated")
    };
    let free = [
        Parameter::FilmModulus,
        Parameter::WorkOfAdhesion,
        Parameter::LoadOffset,
    ]
    .map(Free::new);
    let experiments = [measured];
    let found = fit_all(&experiments, &free).expect("fitted");
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
    let lens = experiment(Kind::LoadRadius, paraboloid.clone());
    let lens = simulate(Table::embedded(), &lens, 1e-6, 0).expect("simulated");
    let one = fit_all(&[lens], &[Free::new(Parameter::FilmModulus)]).expect("fitted");
    for (kind, probe, word) in [
        (Kind::PenetrationRadius, paraboloid, "contact radii"),
        (Kind::LoadRadius, cone, "radius of curvature"),
    ] {
        jkr_plot(&one, &experiment(kind, probe), 0).refused(word);
    }
}
