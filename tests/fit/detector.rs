//! Doubts about the detector: readings at the end of its range, and readings in coarse steps.

use acceptance::Contacts;
use fit::{Direction, Experiment, Fit, Free, Parameter, Point, WarningKind};

use crate::contact_stiffness::{at_radii, noisy, oxide};
use crate::imagined::{
    Course, FORCE_CURVE, Imagined, assert_no_doubts, assert_silent, assert_warns, fitted,
    fitted_of_few, free_of, lens, text,
};

/// Returns a force curve on a gel with adhesion, its work of adhesion free.
fn probe() -> Imagined {
    Imagined::probe(Course::Cycle, 1e-4, &FORCE_CURVE)
}

/// Returns the fit of an experiment whose readings a detector has changed.
fn through(experiment: &Experiment, free: &[Free], detector: impl Fn(f64) -> f64) -> Fit {
    let mut experiment = experiment.clone();
    for point in &mut experiment.measurement.points {
        point.ordinate = detector(point.ordinate);
    }
    fitted_of_few(&experiment, free)
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
    for (_, experiment) in probe.data(0..20) {
        let [least, most] = ends(&experiment);
        let at_the_bottom = through(&experiment, &probe.free, |y| y.max(0.85 * least));
        let at_the_top = through(&experiment, &probe.free, |y| y.min(0.8 * most));
        for (found, which) in [(at_the_bottom, "smallest"), (at_the_top, "largest")] {
            let words = format!("exactly the {which} force; leave these points out, in lines");
            assert_warns(&found, WarningKind::Saturated, &words);
        }
    }
}

#[test]
fn coarse_steps_are_doubted() {
    let probe = probe();
    for (_, experiment) in probe.data(0..20) {
        let step = 5.0 * probe.noise;
        let found = through(&experiment, &probe.free, |y| step * (y / step).round());
        let words = "values of the force, in steps of 7.500e-10 N";
        assert_warns(&found, WarningKind::CoarseSteps, words);
        assert_silent(&found, WarningKind::Saturated);
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
            let found = through(&experiment, &probe.free, |y| step * (y / step).round());
            assert_no_doubts(&found, &strain);
        }
        assert_no_doubts(&through(&experiment, &probe.free, digits), &strain);
    }
    // Each load is set once on loading and once on unloading.
    let mut weights = lens();
    weights.points[0] = 10;
    let exact = weights.exact();
    for seed in 0..50 {
        let mut experiment = weights.measured(&exact, seed);
        experiment.noise = None;
        let mut random = Contacts::new(seed);
        let both = exact
            .points
            .iter()
            .chain(exact.points.iter().rev())
            .enumerate();
        let both = both.map(|(i, point)| Point {
            line: i as u64 + 2,
            abscissa: point.abscissa + 3e-7 * random.normal(),
            direction: Some(Direction::ALL[i / 10]),
            ..*point
        });
        experiment.measurement.points = both.collect();
        let found = fitted(&experiment, &weights.free);
        assert_silent(&found, WarningKind::CoarseSteps);
    }
    // Each load is set three times, the last may be held for longer, and the radius has the noise.
    let mut lens = lens();
    lens.points[0] = 12;
    let exact = lens.exact();
    for (seed, held) in (0..50).flat_map(|seed| [(seed, 3), (seed, 20)]) {
        let mut experiment = lens.measured(&exact, seed);
        experiment.noise = Some(1e-9);
        experiment.abscissa_noise = 2e-7;
        let mut random = Contacts::new(seed);
        let last = exact.points.len() - 1;
        let points = exact.points.iter().enumerate();
        let points = points
            .flat_map(|(i, point)| std::iter::repeat_n(*point, if i == last { held } else { 3 }));
        experiment.measurement.points = points.collect();
        for (i, point) in experiment.measurement.points.iter_mut().enumerate() {
            point.abscissa += experiment.abscissa_noise * random.normal();
            point.line = i as u64 + 2;
        }
        assert_no_doubts(&fitted(&experiment, &lens.free), &[]);
    }
}

/// The noise of a contact stiffness is relative to it, and its steps are not.
#[test]
fn readings_of_a_contact_stiffness_are_doubted_in_its_unit() {
    let free = free_of(&[Parameter::FilmModulus]);
    let exact = at_radii(&oxide(), [5e-8, 1.5e-6], 100);
    let [_, most] = ends(&exact);
    for seed in 0..20 {
        let mut experiment = noisy(&exact, 1e-2, seed);
        for noise in [None, Some(1e-2)] {
            experiment.noise = noise;
            let sound = through(&experiment, &free, |y| y);
            assert_no_doubts(&sound, &[WarningKind::Friction]);
            let at_the_top = through(&experiment, &free, |y| y.min(0.8 * most));
            let words = "exactly the largest contact stiffness;  N/m, where the fit changes by ";
            assert_warns(&at_the_top, WarningKind::Saturated, words);
            // Steps of 0.01 N/m are fine beside 1 %, though 0.01 is the noise.
            let fine = through(&experiment, &free, |y| 0.01 * (y / 0.01).round());
            assert_no_doubts(&fine, &[WarningKind::Friction]);
        }
        let experiment = noisy(&exact, 2e-3, seed);
        let step = 0.04 * most;
        let coarse = through(&experiment, &free, |y| step * (y / step).round().max(1.0));
        let words = " N/m, beside which the noise is small";
        assert_warns(&coarse, WarningKind::CoarseSteps, words);
    }
}
