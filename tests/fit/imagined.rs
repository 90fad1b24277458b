//! Imagined experiments. Their data are made by direct solves, along contact radii: neither the
//! table nor a search for equilibria takes part.

use std::ops::Range;
use std::path::Path;
use std::slice;

use acceptance::{
    Contacts, Words, assert_names, half_space_of, paper_system, rigid_sphere, solved_contact,
    system_of,
};
use contact::Contact;
use fit::data::Format;
use fit::{
    Bodies, Direction, Error, Experiment, Fit, Free, Kind, Loss, Measurement, Numbering, Options,
    Parameter, Point, Warning, WarningKind,
};
use interp::{Elastic, Probe, System, Table};
use solve::stack::Layer;

/// The parameters of a JKR test.
pub const LENS: [Parameter; 2] = [Parameter::SphereModulus, Parameter::WorkOfAdhesion];

/// The parameters of a force curve with adhesion.
pub const FORCE_CURVE: [Parameter; 4] = [
    Parameter::FilmModulus,
    Parameter::WorkOfAdhesion,
    Parameter::ContactPoint,
    Parameter::Baseline,
];

/// How an imagined experiment brings sphere and sample together.
#[derive(Clone, Copy, Debug)]
pub enum Course {
    /// Contacts of the radii given, without a direction.
    Radii,
    /// Approach from no contact to the largest radius.
    Approach,
    /// Retract from the largest radius to no contact.
    Retract,
    /// Both, with the contact pinned between them if the works of adhesion differ.
    Cycle,
}

/// An imagined experiment.
#[derive(Clone)]
pub struct Imagined {
    /// The true values, with an empty measurement.
    pub truth: Experiment,
    pub course: Course,
    /// Contact radii, first and last, m. Above that of pull-off the first one is the last measured
    /// before the jump.
    pub radii: [f64; 2],
    /// The number of points in contact, and on the baseline, of each direction.
    pub points: [usize; 2],
    /// The standard deviation of an ordinate.
    pub noise: f64,
    /// Whether the fit is told the noise.
    pub noise_is_known: bool,
    /// Whether every twentieth point is 20 standard deviations off, upwards or downwards.
    pub outliers: bool,
    pub free: Vec<Free>,
    pub loss: Loss,
}

/// Makes an empty measurement.
pub fn measurement(kind: Kind, points: Vec<Point>) -> Measurement {
    Measurement {
        name: "imagined.csv".into(),
        kind,
        numbering: Numbering::Lines,
        points,
    }
}

/// Makes a measurement of abscissae and ordinates.
pub fn measurement_of(kind: Kind, points: impl IntoIterator<Item = [f64; 2]>) -> Measurement {
    let point = |(line, [abscissa, ordinate]): (u64, [f64; 2])| Point {
        line,
        abscissa,
        ordinate,
        direction: None,
    };
    measurement(kind, (1..).zip(points).map(point).collect())
}

/// Makes a measurement whose ordinates are to be predicted.
pub fn measurement_at(kind: Kind, abscissae: impl IntoIterator<Item = f64>) -> Measurement {
    measurement_of(kind, abscissae.into_iter().map(|abscissa| [abscissa, 0.0]))
}

/// Returns the warnings of a fit but those of the `expected` kinds. Where the film is well determined,
/// a fit says that it takes the film as bonded and its contact as frictionless, which is the truth of
/// imagined data: tests name these kinds.
pub fn doubts<'a>(found: &'a Fit, expected: &[WarningKind]) -> Vec<&'a Warning> {
    let warnings = found.warnings.iter();
    warnings
        .filter(|one| !expected.contains(&one.kind))
        .collect()
}

/// What is said of sound data on soft bodies: that a film is taken as bonded, which surface tension would matter, and that a
/// solvent may flow.
pub const OF_SOFT_FILMS: [WarningKind; 3] = [
    WarningKind::AssumesBonding,
    WarningKind::SurfaceTension,
    WarningKind::OneSize,
];

/// Asserts that a fit has no warnings but those of the `expected` kinds and of [`OF_SOFT_FILMS`].
#[track_caller]
pub fn assert_no_doubts(found: &Fit, expected: &[WarningKind]) {
    let expected = [expected, &OF_SOFT_FILMS].concat();
    let doubts = doubts(found, &expected);
    assert!(doubts.is_empty(), "{doubts:?}");
}

/// Asserts that a fit has a warning of a kind.
#[track_caller]
pub fn assert_warned(found: &Fit, kind: WarningKind) {
    assert!(found.warns_of(kind), "no {kind:?} in {:?}", found.warnings);
}

/// Asserts that a fit has a warning of a kind, and that its text names all `words`.
#[track_caller]
pub fn assert_warns(found: &Fit, kind: WarningKind, words: &(impl Words + ?Sized)) {
    assert_warned(found, kind);
    assert_names(&text(found, kind), words);
}

/// Asserts that a fit has no warning of a kind.
#[track_caller]
pub fn assert_silent(found: &Fit, kind: WarningKind) {
    assert!(!found.warns_of(kind), "{:?}", found.warnings);
}

/// Reads an experiment from a file of the crate of fits.
pub fn of_file(path: &str, bodies: Bodies) -> Experiment {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../crates/fit");
    let path = Path::new(folder).join(path);
    let reading = fit::data::read(&path, &Format::default()).expect("sound data");
    Experiment::new(reading.measurement, bodies)
}

/// Returns the texts of the warnings of a kind, parted by `; `, or an empty text if there is none.
pub fn text(found: &Fit, kind: WarningKind) -> String {
    let warnings = found.warnings.iter();
    let of_kind = warnings.filter(|warning| warning.kind == kind);
    let texts: Vec<&str> = of_kind.map(|warning| &*warning.text).collect();
    texts.join("; ")
}

/// Returns by how many standard errors the estimate of a parameter is above a value.
pub fn off(found: &Fit, parameter: Parameter, truth: f64) -> f64 {
    let estimate = found.estimate(parameter).expect("it is free");
    (estimate.value - truth) / estimate.standard_error
}

/// Returns parameters as free ones, without bounds, priors or starts.
pub fn free_of(parameters: &[Parameter]) -> Vec<Free> {
    parameters.iter().copied().map(Free::new).collect()
}

/// Fits an experiment with the embedded table, by options that `change` makes of the default ones.
pub fn fit_with(
    experiment: &Experiment,
    free: &[Free],
    change: impl FnOnce(&mut Options),
) -> Result<Fit, Error> {
    let mut options = Options::default();
    change(&mut options);
    fit::fit(
        Table::embedded(),
        slice::from_ref(experiment),
        free,
        &options,
    )
}

/// Fits an experiment that is sound, by default options.
pub fn fitted(experiment: &Experiment, free: &[Free]) -> Fit {
    fit_with(experiment, free, |_| ()).expect("sound")
}

/// Fits an experiment that is sound, although most of its points may be left out.
pub fn fitted_of_few(experiment: &Experiment, free: &[Free]) -> Fit {
    fit_with(experiment, free, |options| options.allow_left_out = true).expect("sound")
}

/// Fits an experiment that is sound, with an interval of the profile likelihood of 95 % for each estimate.
pub fn profiled(experiment: &Experiment, free: &[Free]) -> Fit {
    fit_with(experiment, free, |options| {
        options.profile_level = Some(0.95)
    })
    .expect("sound")
}

/// Fits experiments together with the embedded table, by default options.
pub fn fit_all(experiments: &[Experiment], free: &[Free]) -> Result<Fit, Error> {
    fit::fit(Table::embedded(), experiments, free, &Options::default())
}

/// Returns the bodies of an experiment on a film or on layers, as if these were one film.
pub fn as_film(bodies: &Bodies) -> System {
    system_of(
        bodies.probe.clone(),
        bodies.sphere_modulus,
        bodies.film(),
        bodies.thickness().expect("there are layers"),
        bodies.base,
    )
}

/// Returns the film of an experiment.
pub fn film(experiment: &mut Experiment) -> &mut Layer {
    &mut experiment.bodies.layers[0].layer
}

/// A sphere on a half-space.
pub fn half_space(radius: f64, sphere_modulus: f64, solid: Elastic) -> Bodies {
    Bodies::half_space(half_space_of(
        Probe::Paraboloid { radius },
        sphere_modulus,
        solid,
    ))
}

/// The lens of the paper on a film of 10 um; the noise of its loads is 5 uN.
pub fn lens() -> Imagined {
    Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, &LENS)
}

/// A rigid colloidal probe of 20 um on a gel of 20 kPa and 10 um thickness, on glass.
pub fn gel() -> System {
    rigid_sphere(20e-6, [2e4, 0.45], 10e-6, [7e10, 0.2])
}

impl Imagined {
    /// A JKR test of the paper's lens on a film.
    pub fn lens(kind: Kind, film_thickness: f64, noise: f64, free: &[Parameter]) -> Self {
        let bodies = Bodies::coated(&paper_system(film_thickness));
        let mut truth = Experiment::new(measurement(kind, Vec::new()), bodies);
        truth.work_of_adhesion = 0.04;
        Self {
            truth,
            course: Course::Radii,
            radii: [42e-6, 131e-6],
            points: [40, 0],
            noise,
            noise_is_known: true,
            outliers: false,
            free: free_of(free),
            loss: Loss::Squares,
        }
    }

    /// A hard contact of some nanometres, whose attraction is not short.
    pub fn hard() -> Self {
        let mut hard = Self::lens(Kind::LoadPenetration, 1e-6, 1e-9, &[LENS[1]]);
        hard.truth.bodies = Bodies::coated(&rigid_sphere(20e-9, [5e10, 0.2], 1e-7, [2e11, 0.2]));
        hard.radii = [0.8e-9, 2e-9];
        hard.noise = 1e-11;
        hard
    }

    /// A force curve of a colloidal probe on a gel.
    pub fn probe(course: Course, work_of_adhesion: f64, free: &[Parameter]) -> Self {
        let bodies = Bodies::coated(&gel());
        let mut truth = Experiment::new(measurement(Kind::ForceHeight, Vec::new()), bodies);
        truth.work_of_adhesion = work_of_adhesion;
        truth.stiffness = Some(0.2);
        truth.contact_point = 1.3e-6;
        truth.baseline = 4e-10;
        Self {
            truth,
            course,
            radii: [0.1e-6, 5e-6],
            points: [120, 60],
            noise: 1.5e-10,
            noise_is_known: true,
            outliers: false,
            free: free_of(free),
            loss: Loss::Squares,
        }
    }

    /// Returns the contact of the bodies, by direct solves or in closed form.
    fn contact(&self) -> Contact {
        let bodies = &self.truth.bodies;
        let Some(thickness) = bodies.thickness() else {
            let probe = bodies.probe.clone();
            let half_space = half_space_of(probe, bodies.sphere_modulus, bodies.base);
            return Contact::half_space(&half_space).expect("physical");
        };
        let [from, to] = self.radii.map(|radius| radius / thickness);
        if !bodies.are_layered() {
            // The integrals of a cone reach beyond the contact.
            return solved_contact(&as_film(bodies), [0.3 * from, 1.5 * to], 1e-9);
        }
        let stack = bodies.stack().expect("physical");
        let modulus = bodies.sphere_modulus;
        let curve = solve::stack_curve(&stack, modulus, [0.3 * from, 1.1 * to], 1e-10);
        let radius = bodies.probe.radius().expect("a paraboloid");
        let system = stack.system(radius, modulus);
        Contact::new(&system, curve.expect("within reach")).expect("its own curve")
    }

    /// Returns the points without noise.
    pub fn exact(&self) -> Measurement {
        let truth = &self.truth;
        let kind = truth.measurement.kind;
        let contact = self.contact();
        let contact = |a, w| contact.load_and_penetration(a, w).expect("in range");
        let advancing = truth.work_of_adhesion;
        let receding = truth.work_of_adhesion_receding.unwrap_or(advancing);
        let stiffness = truth.stiffness.unwrap_or(f64::INFINITY);
        let imposed = |a: f64, w: f64| {
            let (load, penetration) = contact(a, w);
            penetration + load / stiffness
        };
        let [smallest, largest] = self.radii;
        let ([contacts, apart], steps) = (self.points, 4000);
        let first = 0.35 * smallest;
        let grid = |i: usize| first + (largest - first) * i as f64 / steps as f64;
        // The radius of the smallest imposed value, and that of a given one, on a fine grid.
        let pull_off = (0..=steps)
            .min_by(|&i, &j| imposed(grid(i), receding).total_cmp(&imposed(grid(j), receding)))
            .map_or(smallest, grid);
        let touches = (0..=steps)
            .map(grid)
            .find(|&a| a >= pull_off && imposed(a, advancing) >= 0.0)
            .unwrap_or(smallest);
        let at_radii = matches!(kind, Kind::LoadRadius | Kind::PenetrationRadius);
        let even = |from: f64, to: f64, count: usize| -> Vec<f64> {
            let step = (to - from) / (count.max(2) - 1) as f64;
            (0..count).map(|i| from + step * i as f64).collect()
        };
        let mut points: Vec<Point> = Vec::new();
        let mut add = |reading: &dyn Fn(f64) -> [f64; 2], values: Vec<f64>, direction| {
            for [abscissa, ordinate] in values.into_iter().map(reading) {
                points.push(Point {
                    line: points.len() as u64 + 2,
                    abscissa,
                    ordinate,
                    direction,
                });
            }
        };
        let abscissa_at = |value: f64| match kind {
            Kind::ForceHeight => truth.contact_point - value,
            _ => truth.contact_point + value,
        };
        let baseline = |abscissa: f64| {
            truth.load_offset
                + truth.baseline
                + truth.baseline_slope * (abscissa - truth.contact_point)
        };
        let reading = |a: f64, w: f64| {
            let (load, penetration) = contact(a, w);
            match kind {
                Kind::LoadRadius => [a, load + truth.load_offset],
                Kind::PenetrationRadius => [a, penetration + truth.contact_point],
                _ => {
                    let abscissa = abscissa_at(penetration + load / stiffness);
                    [abscissa, load + baseline(abscissa)]
                }
            }
        };
        let [advance, recede] = [advancing, receding].map(|w| move |a: f64| reading(a, w));
        let off = |value: f64| {
            let abscissa = abscissa_at(value);
            [abscissa, baseline(abscissa)]
        };
        let span = imposed(largest, advancing);
        let [approach, retract] = Direction::ALL.map(Some);
        if matches!(self.course, Course::Radii) {
            add(&advance, even(smallest, largest, contacts), None);
        }
        if matches!(self.course, Course::Approach | Course::Cycle) {
            if !at_radii {
                add(&off, even(-0.6 * span, -0.01 * span, apart), approach);
            }
            add(&advance, even(touches, largest, contacts), approach);
        }
        if matches!(self.course, Course::Retract | Course::Cycle) {
            if receding > advancing && matches!(self.course, Course::Cycle) {
                // The line does not move until its energy release rate is that of a receding one.
                let pinned = |w: f64| reading(largest, w);
                add(&pinned, even(advancing, receding, contacts / 6), retract);
            }
            let ends = if at_radii {
                smallest
            } else {
                smallest.max(1.01 * pull_off)
            };
            add(&recede, even(largest, ends, contacts), retract);
            if !at_radii {
                let from = imposed(pull_off, receding) - 0.01 * span;
                add(&off, even(from, from - 0.6 * span, apart), retract);
            }
        }
        measurement(kind, points)
    }

    /// Returns the experiment with noise that belongs to `seed`, with false starts.
    pub fn measured(&self, exact: &Measurement, seed: u64) -> Experiment {
        let mut random = Contacts::new(seed);
        let mut experiment = self.truth.clone();
        experiment.measurement = exact.clone();
        for (i, point) in experiment.measurement.points.iter_mut().enumerate() {
            point.ordinate += self.noise * random.normal();
            let moved = (i as u64 + 7 * seed).is_multiple_of(20);
            if self.outliers && moved {
                let upwards = (i / 20 + seed as usize).is_multiple_of(2);
                point.ordinate += if upwards { 20.0 } else { -20.0 } * self.noise;
            }
        }
        experiment.noise = self.noise_is_known.then_some(self.noise);
        // The truth of a free parameter is not a start.
        for free in &self.free {
            let truth = experiment.get(free.parameter).expect("a value");
            let start = match free.parameter {
                Parameter::FilmPoissonRatio => truth - 0.05,
                parameter if parameter.is_positive() => 1.5 * truth,
                _ => 0.0,
            };
            experiment.set(free.parameter, start).expect("physical");
        }
        experiment
    }

    /// Returns an experiment for each of the seeds, as [`Imagined::measured`] makes it.
    pub fn data(&self, seeds: Range<u64>) -> Vec<(u64, Experiment)> {
        let exact = self.exact();
        seeds
            .map(|seed| (seed, self.measured(&exact, seed)))
            .collect()
    }

    /// Returns the experiment with the true values and its noise, at the points to be measured.
    pub fn planned(&self) -> Experiment {
        Experiment {
            measurement: self.exact(),
            noise: Some(self.noise),
            ..self.truth.clone()
        }
    }

    /// Fits an experiment.
    pub fn fit_of(&self, experiment: &Experiment) -> Fit {
        fit_with(experiment, &self.free, |options| options.loss = self.loss).expect("sound")
    }

    /// Fits data that belong to `seed`.
    pub fn fit(&self, seed: u64) -> Fit {
        self.fit_of(&self.measured(&self.exact(), seed))
    }
}

/// Returns the number after some words of a text.
pub fn number_after(text: &str, words: &str) -> f64 {
    let rest = text.split(words).nth(1).unwrap_or_else(|| panic!("{text}"));
    let number = rest.split([' ', ',', '%']).next().expect("a word");
    number.parse().unwrap_or_else(|_| panic!("{text}"))
}
