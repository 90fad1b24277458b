//! Doubts about the detector: readings at the end of its range, and readings in coarse steps.

use fit::{Experiment, Fit, Kind, Parameter, WarningKind};

use crate::imagined::{Course, Imagined, assert_no_doubts, fit_with, text};

/// Returns a force curve on a gel with adhesion, its work of adhesion free.
fn probe() -> Imagined {
    use Parameter::{Baseline, ContactPoint, FilmModulus, WorkOfAdhesion};
    let free = [FilmModulus, WorkOfAdhesion, ContactPoint, Baseline];
    Imagined::probe(Course::Cycle, 1e-4, &free)
}

/// Returns the fit of an experiment whose readings a detector has changed.
fn through(experiment: &Experiment, imagined: &Imagined, detector: impl Fn(f64) -> f64) -> Fit {
    let mut experiment = experiment.clone();
    for point in &mut experiment.measurement.points {
        point.ordinate = detector(point.ordinate);
    }
    fit_with(&experiment, &imagined.free, |options| {
        options.allow_left_out = true;
    })
    .expect("sound")
}

/// Returns the smallest and the largest reading of an experiment.
fn ends(experiment: &Experiment) -> [f64; 2] {
    let readings = experiment.measurement.points.iter().map(|one| one.ordinate);
    readings.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, m], y| {
        [l.min(y), m.max(y)]
    })
}

#[test]
fn readings_at_the_end_of_the_range_are_doubted() {
    let probe = probe();
    let exact = probe.exact();
    for seed in 0..20 {
        let experiment = probe.measured(&exact, seed);
        let [least, most] = ends(&experiment);
        let at_the_bottom = through(&experiment, &probe, |y| y.max(0.85 * least));
        let at_the_top = through(&experiment, &probe, |y| y.min(0.8 * most));
        for (found, which) in [(at_the_bottom, "smallest"), (at_the_top, "largest")] {
            let said = text(&found, WarningKind::Saturated);
            assert!(
                said.contains(&format!("exactly the {which} force")),
                "{said}"
            );
            assert!(said.contains("leave these points out, in lines"), "{said}");
        }
    }
}

#[test]
fn coarse_steps_are_doubted() {
    let probe = probe();
    let exact = probe.exact();
    for seed in 0..20 {
        let experiment = probe.measured(&exact, seed);
        let step = 5.0 * probe.noise;
        let found = through(&experiment, &probe, |y| step * (y / step).round());
        let said = text(&found, WarningKind::CoarseSteps);
        assert!(
            said.contains("values of the force, in steps of 7.500e-10 N"),
            "{said}"
        );
        assert!(
            !found.warns_of(WarningKind::Saturated),
            "{:?}",
            found.warnings
        );
        // Rounding makes neighbours alike, which is no other reason for doubts.
        let kinds = [WarningKind::StructuredResiduals, WarningKind::PoorFit];
        let alike = kinds.map(|kind| text(&found, kind).contains("neighbour"));
        assert_eq!(alike, [false, false], "{:?}", found.warnings);
    }
}

/// Steps that are not large beside the noise, few digits, and loads that are set are no reason.
#[test]
fn sound_readings_of_few_values_are_not_doubted() {
    let probe = probe();
    let exact = probe.exact();
    let digits = |y: f64| format!("{y:.3e}").parse().expect("a number");
    let strain = [WarningKind::LargeStrain, WarningKind::Friction];
    for seed in 0..50 {
        let experiment = probe.measured(&exact, seed);
        for steps in [0.5, 1.0] {
            let step = steps * probe.noise;
            let found = through(&experiment, &probe, |y| step * (y / step).round());
            assert_no_doubts(&found, &strain);
        }
        assert_no_doubts(&through(&experiment, &probe, digits), &strain);
    }
    // Each load is set three times, and the radius has the noise.
    let free = [Parameter::SphereModulus, Parameter::WorkOfAdhesion];
    let mut lens = Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, &free);
    lens.points[0] = 12;
    let exact = lens.exact();
    for seed in 0..50 {
        let mut experiment = lens.measured(&exact, seed);
        experiment.noise = Some(1e-9);
        experiment.abscissa_noise = 2e-7;
        let mut random = acceptance::Contacts::new(seed);
        let points = exact.points.iter().flat_map(|point| [*point; 3]);
        experiment.measurement.points = points.collect();
        for (i, point) in experiment.measurement.points.iter_mut().enumerate() {
            point.abscissa += experiment.abscissa_noise * random.normal();
            point.line = i as u64 + 2;
        }
        let found = fit_with(&experiment, &lens.free, |_| ()).expect("sound");
        assert_no_doubts(&found, &[]);
    }
}
