//! Fits of contacts on stacks of layers.

use acceptance::{larger, solid};
use fit::{
    Bodies, Experiment, Fit, Kind, LayerName, LayerQuantity, NamedLayer, Parameter, Reach, Solver,
    WarningKind,
};
use interp::{Elastic, Probe, System, Table};
use solve::stack::Layer;

use crate::imagined::{
    self, Course, FORCE_CURVE, Imagined, LENS, as_film, assert_warned, fit_all, measurement_at, off,
};
use crate::recovery::assert_recovers;

const STRAIN: [WarningKind; 1] = [WarningKind::LargeStrain];

pub fn named(name: &str) -> LayerName {
    name.parse().expect("a name")
}

pub fn modulus_of(layer: &str) -> Parameter {
    Parameter::Layer(named(layer), LayerQuantity::Modulus)
}

pub fn thickness_of(layer: &str) -> Parameter {
    Parameter::Layer(named(layer), LayerQuantity::Thickness)
}

pub fn layer(name: &str, solid: Elastic, thickness: f64) -> NamedLayer {
    NamedLayer {
        name: Some(named(name)),
        layer: Layer::bonded(solid, thickness),
    }
}

/// Puts a sphere on layers on a base.
pub fn on_layers(system: &System, layers: &[NamedLayer]) -> Bodies {
    Bodies {
        layers: layers.to_vec(),
        solver: Solver::Direct,
        ..Bodies::coated(system)
    }
}

/// A lens on an elastomer on a softer primer on silicon.
pub fn lens(free: &[Parameter]) -> Imagined {
    let mut lens = Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, free);
    let system = as_film(&lens.truth.bodies);
    let primer = layer("primer", solid(5e5, 0.5), 4e-6);
    let elastomer = layer("elastomer", solid(3.5e6, 0.5), 6e-6);
    lens.truth.bodies = on_layers(&system, &[primer, elastomer]);
    lens
}

/// A rigid colloidal probe on a gel on a stiffer primer on glass.
fn probe(course: Course, work_of_adhesion: f64, free: &[Parameter]) -> Imagined {
    let mut probe = Imagined::probe(course, work_of_adhesion, free);
    let system = as_film(&probe.truth.bodies);
    let primer = layer("primer", solid(1e5, 0.4), 3e-6);
    let gel = layer("gel", system.film, 5e-6);
    probe.truth.bodies = on_layers(&system, &[primer, gel]);
    probe
}

/// Gives the contacts on layers the reach that the measurement needs.
pub fn with_reach(mut experiment: Experiment) -> Experiment {
    experiment.bodies.reach = Reach::of(&experiment.measurement, &experiment.bodies.probe);
    experiment
}

pub fn fit_of(experiment: Experiment, imagined: &Imagined) -> Fit {
    imagined.fit_of(&with_reach(experiment))
}

/// Fits 50 data sets.
pub fn recover(name: &str, imagined: &Imagined, expected: &[WarningKind]) {
    let exact = imagined.exact();
    let fit_of = |seed| fit_of(imagined.measured(&exact, seed), imagined);
    assert_recovers(name, &imagined.truth, 0..50, fit_of, expected);
}

#[test]
fn the_modulus_of_a_buried_layer_is_found() {
    let primer = modulus_of("primer");
    let lens = lens(&[primer, Parameter::WorkOfAdhesion]);
    recover("lens, primer's modulus", &lens, &STRAIN);
}

#[test]
fn the_thickness_of_a_layer_is_found_from_a_force_curve() {
    let mut free = FORCE_CURVE;
    free[0] = thickness_of("gel");
    let probe = probe(Course::Retract, 2e-4, &free);
    recover("probe, gel's thickness", &probe, &STRAIN);
}

#[test]
fn sphere_and_layer_are_found_together() {
    let elastomer = modulus_of("elastomer");
    let mut lens = lens(&[LENS[0], elastomer, LENS[1]]);
    lens.noise = 2e-7;
    recover("lens, sphere and elastomer", &lens, &STRAIN);
}

/// The film of an imagined experiment as a stack of one layer.
fn as_one_layer(imagined: &Imagined) -> Imagined {
    let mut layered = imagined.clone();
    let system = as_film(&layered.truth.bodies);
    let film = layer("film", system.film, system.film_thickness);
    layered.truth.bodies = on_layers(&system, &[film]);
    for free in &mut layered.free {
        free.parameter = match free.parameter {
            Parameter::FilmModulus => modulus_of("film"),
            Parameter::FilmThickness => thickness_of("film"),
            other => other,
        };
    }
    layered
}

#[test]
fn one_layer_gives_the_fit_of_the_film() {
    use Parameter::{
        Baseline, ContactPoint, FilmModulus, FilmThickness, SphereModulus, WorkOfAdhesion,
        WorkOfAdhesionReceding,
    };
    let mut hysteretic = Imagined::probe(
        Course::Cycle,
        1e-4,
        &[
            FilmModulus,
            WorkOfAdhesion,
            WorkOfAdhesionReceding,
            ContactPoint,
            Baseline,
        ],
    );
    hysteretic.truth.work_of_adhesion_receding = Some(4e-4);
    let of_lens = |free: &[Parameter]| Imagined::lens(Kind::LoadRadius, 100e-6, 5e-7, free);
    let cases = [
        of_lens(&[SphereModulus, FilmModulus, WorkOfAdhesion]),
        of_lens(&[FilmThickness, WorkOfAdhesion]),
        hysteretic,
    ];
    for imagined in cases {
        let layered = as_one_layer(&imagined);
        let exact = imagined.exact();
        let film = fit_of(imagined.measured(&exact, 1), &imagined);
        let stack = fit_of(layered.measured(&exact, 1), &layered);
        assert!(film.converged && stack.converged);
        for (film, stack) in film.estimates.iter().zip(&stack.estimates) {
            let off = (film.value - stack.value).abs() / film.standard_error;
            let errors = (film.standard_error / stack.standard_error - 1.0).abs();
            // The table that the film is looked up in has an error of 7e-7.
            assert!(off < 1e-2 && errors < 1e-2, "{film:?} {stack:?}");
        }
        let off = |fit: &Fit| {
            let without = fit.without_film.as_ref().expect("JKR");
            without.modulus.map(|bias| bias.relative)
        };
        let [without_film, without_layer] = [&film, &stack].map(off);
        assert_eq!(without_film.is_some(), without_layer.is_some());
        let [a, b] = [without_film, without_layer].map(|off| off.unwrap_or(0.0));
        assert!((a - b).abs() <= 1e-3 * (1.0 + a.abs()), "{a} {b}");
        let kinds = |fit: &Fit| -> Vec<WarningKind> {
            let kinds = fit.warnings.iter().map(|one| one.kind);
            // The exact sphere is not solved on a stack.
            kinds
                .filter(|kind| *kind != WarningKind::LargeContact)
                .collect()
        };
        assert_eq!(kinds(&film), kinds(&stack));
    }
}

#[test]
fn differences_are_the_derivatives_of_the_film() {
    use Parameter::{
        Baseline, BaselineSlope, ContactPoint, FilmModulus, FilmThickness, LoadOffset, Stiffness,
        WorkOfAdhesion,
    };
    let parameters = [
        FilmModulus,
        FilmThickness,
        WorkOfAdhesion,
        LoadOffset,
        ContactPoint,
        Baseline,
        BaselineSlope,
        Stiffness,
    ];
    let imagined = Imagined::probe(Course::Retract, 2e-4, &parameters);
    let layered = as_one_layer(&imagined);
    let prediction = |imagined: &Imagined| {
        let free: Vec<Parameter> = imagined.free.iter().map(|one| one.parameter).collect();
        let experiment = with_reach(imagined.planned());
        experiment
            .predictions(Table::embedded(), None, &free)
            .expect("in range")
    };
    let [film, stack] = [&imagined, &layered].map(prediction);
    assert_eq!(film.branches, stack.branches);
    let width = parameters.len();
    for (k, parameter) in parameters.into_iter().enumerate() {
        let column =
            |of: &[f64]| -> Vec<f64> { of.iter().skip(k).step_by(width).copied().collect() };
        let [exact, differences] = [&film, &stack].map(|of| column(&of.derivatives));
        // The last contacts are so close to the end of the branch that derivatives grow without
        // limit there.
        let [contacts, _] = imagined.points;
        let is_clear = |i: &usize| !(contacts - 10..contacts).contains(i);
        let points = (0..exact.len()).filter(is_clear);
        let points = points.map(|i| (exact[i], differences[i]));
        let scale = points
            .clone()
            .map(|(exact, _)| exact.abs())
            .fold(0.0, larger);
        let error = points.map(|(a, b)| (a - b).abs() / scale).fold(0.0, larger);
        let is_close = scale > 0.0 && error < 1e-4;
        assert!(is_close, "{parameter}: {error:e} of {scale:e}");
    }
}

#[test]
fn without_the_layers_the_sphere_touches_the_base() {
    let lens = lens(&LENS);
    let found = fit_of(lens.measured(&lens.exact(), 1), &lens);
    let without = found.without_film.expect("a half-space");
    let modulus = without.modulus.expect("a modulus");
    assert_eq!(modulus.parameter, Parameter::SphereModulus);
    assert!(modulus.relative < -0.02 && modulus.matters(), "{modulus:?}");
}

#[test]
fn contacts_are_made_as_far_as_the_data_need_them() {
    let probe = Probe::Paraboloid { radius: 1e-3 };
    let of = |kind, abscissae: &[f64]| {
        Reach::of(&measurement_at(kind, abscissae.iter().copied()), &probe)
    };
    let radii = of(Kind::LoadRadius, &[1e-5, 1e-4]);
    assert_eq!((radii.needed, radii.expected), (1.2e-4, 1.2e-4));
    let most = of(Kind::LoadRadius, &[9e-4]);
    assert_eq!(most.needed, 1e-3);
    let path = of(Kind::LoadPenetration, &[-1e-6, 3e-6]);
    assert_eq!(path.needed, 0.0);
    assert!((path.expected - 3.0 * 4e-9_f64.sqrt()).abs() < 1e-12);
}

#[test]
fn a_punch_on_one_layer_has_the_loads_on_the_film() {
    let mut film = imagined::gel();
    film.probe = Probe::FlatPunch { radius: 8e-6 };
    let gel = layer("gel", film.film, film.film_thickness);
    let predicted = |bodies: Bodies| {
        let measurement = measurement_at(Kind::LoadPenetration, [1e-7, 1.5e-6]);
        let experiment = with_reach(Experiment::new(measurement, bodies));
        let predicted = experiment.predictions(Table::embedded(), None, &[]);
        predicted.expect("in range").ordinates
    };
    let on_layer = predicted(on_layers(&film, &[gel]));
    for (film, layer) in predicted(Bodies::coated(&film)).into_iter().zip(on_layer) {
        let error = (layer / film - 1.0).abs();
        // The table that the film is looked up in has an error of 7e-7.
        assert!(film > 0.0 && error < 2e-6, "{film:e} {layer:e}");
    }
}

/// Two moduli that stand for one another: the valley bends within the standard errors.
#[test]
fn an_error_that_is_too_small_on_one_side_is_told_on_layers() {
    let moduli = ["primer", "elastomer"].map(modulus_of);
    let mut lens = lens(&[moduli[0], moduli[1], Parameter::WorkOfAdhesion]);
    lens.noise *= 0.3;
    let found = imagined::fitted(&with_reach(lens.measured(&lens.exact(), 5)), &lens.free);
    println!("{:?} {:?}", found.estimates, found.warnings);
    assert_warned(&found, WarningKind::NonlinearError);
}

#[test]
fn lenses_on_two_coatings_tell_the_modulus_of_their_primer() {
    let primer = modulus_of("primer");
    let lens = lens(&[primer, Parameter::WorkOfAdhesion]);
    let (thin, mut thick) = (lens.clone(), lens.clone());
    let thickness = thickness_of("elastomer");
    thick.truth.set(thickness, 1e-5).expect("a layer");
    let experiments = [&thin, &thick].map(|lens| with_reach(lens.measured(&lens.exact(), 5)));
    let found = fit_all(&experiments, &lens.free).expect("sound data");
    assert!(found.converged && found.estimates.len() == 2);
    let both = found.estimate(primer).expect("it is free");
    assert!(off(&found, primer, 5e5).abs() < 4.0, "{both:?}");
    let [thin, _] = experiments;
    let alone = fit_all(&[thin], &lens.free).expect("sound data");
    let alone = alone.estimate(primer).expect("it is free");
    assert!(both.standard_error < alone.standard_error);
}
