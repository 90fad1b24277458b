//! The reduced JKR plot of a fit.

use contact::JkrPoint;
use interp::Probe;

use crate::{Error, Estimate, Experiment, Fit, Kind, Parameter};

/// A measured point in the reduced JKR plot, in which a contact without a film is a straight line:
/// `F/(sqrt(6 pi) a^{3/2})` against `a^{3/2}/(sqrt(pi) R)`.
///
/// The load offset found, or known, is taken from all ordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JkrPlotPoint {
    /// `a^{3/2}/(sqrt(pi) R)`, m^{1/2}.
    pub abscissa: f64,
    /// The ordinate measured, N m^{-3/2}.
    pub measured: f64,
    /// The ordinate of the fit; `None` for a point that was left out.
    pub fit: Option<f64>,
    /// The ordinate of the fit without the film; `None` where there is none.
    pub without_film: Option<f64>,
}

/// Returns the points of the experiment `number` of a fit in the reduced JKR plot, in the order
/// measured; `None` for a point without a contact. `experiment` is this experiment.
///
/// # Errors
/// [`Error::NoJkrPlot`] unless loads were measured at contact radii, under a probe with a radius of
/// curvature at its tip.
pub fn jkr_plot(
    fit: &Fit,
    experiment: &Experiment,
    number: usize,
) -> Result<Vec<Option<JkrPlotPoint>>, Error> {
    let none = |reason| Error::NoJkrPlot {
        experiment: experiment.measurement.name.clone(),
        reason,
    };
    if experiment.measurement.kind != Kind::LoadRadius {
        return Err(none("it needs loads that were measured at contact radii"));
    }
    let (Probe::Paraboloid { radius }
    | Probe::Sphere { radius }
    | Probe::RoundedCone { radius, .. }) = *experiment.bodies.probe()
    else {
        return Err(none(
            "it needs a probe with a radius of curvature at its tip: a paraboloid, a sphere or a \
             rounded cone",
        ));
    };
    let offset = |estimates: &[Estimate]| {
        let own = |one: &&Estimate| {
            one.parameter == Parameter::LoadOffset && one.experiment.is_none_or(|i| i == number)
        };
        let found = estimates.iter().find(own);
        found.map_or(experiment.load_offset, |found| found.value)
    };
    let with_film = offset(&fit.estimates);
    let without = fit.without_film.as_ref();
    let without = without.map_or(with_film, |without| offset(&without.estimates));
    let points = fit.experiments[number].points.iter().map(|point| {
        let a = point.abscissa;
        let place = |load: f64| JkrPoint::new(a, load, radius);
        let measured = place(point.ordinate - with_film);
        (a > 0.0).then(|| JkrPlotPoint {
            abscissa: measured.abscissa,
            measured: measured.ordinate,
            fit: point.fit.map(|load| place(load - with_film).ordinate),
            without_film: point
                .without_film
                .map(|load| place(load - without).ordinate),
        })
    });
    Ok(points.collect())
}

#[cfg(test)]
mod tests {
    use interp::{Elastic, HalfSpace, Table};

    use super::*;
    use crate::{Bodies, Free, Measurement, Options, Point, fit, simulate};

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
        let found =
            fit(Table::embedded(), &experiments, &free, &Options::default()).expect("fitted");
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
}
