//! Several files with one value, of which each has its own.

use acceptance::{Contacts, solid};
use fit::{Experiment, Fit, Kind, Parameter, WarningKind};

use crate::imagined::{
    assert_silent, assert_warns, fit_all, free_of, half_space, measurement_of, number_after, text,
};

const RADIUS: f64 = 10e-6;
const FREE: [Parameter; 3] = [
    Parameter::FilmModulus,
    Parameter::ContactPoint,
    Parameter::LoadOffset,
];

/// Makes loads of a rigid sphere at penetrations, those of a spring beside them, of a half-space of a reduced modulus.
fn pressed(modulus: f64, deepest: f64, spring: f64, seed: u64) -> Experiment {
    let mut random = Contacts::new(seed);
    let load = |depth: f64| 4.0 / 3.0 * modulus * RADIUS.sqrt() * depth.max(0.0).powf(1.5);
    let points = (0..150).map(|i| {
        let depth = deepest * (f64::from(i) / 75.0 - 1.0);
        let noise = 0.01 * load(deepest) * random.normal();
        [depth + load(depth) / spring, load(depth) + noise]
    });
    let measured = measurement_of(Kind::LoadPenetration, points);
    Experiment::new(measured, half_space(RADIUS, f64::INFINITY, solid(1e4, 0.5)))
}

fn fitted(files: &[Experiment]) -> Fit {
    fit_all(files, &free_of(&FREE)).expect("sound")
}

/// Contacts at five places of a sample whose moduli scatter: no spring and no zero is the reason.
#[test]
fn moduli_that_scatter_from_file_to_file_are_told_from_a_spring() {
    let at_places = |scatter: f64, seed: u64| {
        let files = [-1.0, -0.5, 0.1, 0.6, 1.2].into_iter().zip(5 * seed..);
        let files = files.map(|(part, seed)| {
            let modulus = 1.3e4 * (1.0 + scatter * part);
            pressed(modulus, 8e-7, f64::INFINITY, seed)
        });
        fitted(&files.collect::<Vec<Experiment>>())
    };
    for seed in 0..10 {
        for scatter in [0.05, 0.2] {
            let found = at_places(scatter, seed);
            let words = "do not have one film-modulus; scatter; spring";
            assert_warns(&found, WarningKind::PoorFit, words);
            let said = text(&found, WarningKind::PoorFit);
            let least = number_after(&said, "of their own, some ");
            assert!(
                (-200.0 * scatter..-30.0 * scatter).contains(&least),
                "{said}"
            );
            for other in [WarningKind::SpringWanted, WarningKind::OffsetWanted] {
                assert_silent(&found, other);
            }
        }
        let sound = at_places(0.0, seed);
        assert_silent(&sound, WarningKind::PoorFit);
    }
}

/// The spring of a load cell below contacts of several depths is not taken for other moduli.
#[test]
fn a_spring_below_contacts_of_several_depths_is_told() {
    for (depths, seed) in [&[3e-7, 5e-7, 8e-7][..], &[3e-7, 8e-7]]
        .into_iter()
        .flat_map(|depths| (0..10).map(move |seed| (depths, seed)))
    {
        let under = |&deepest: &f64| pressed(1.3e4, deepest, 0.1, seed);
        let found = fitted(&depths.iter().map(under).collect::<Vec<Experiment>>());
        assert_warns(&found, WarningKind::SpringWanted, "load cell");
        let said = text(&found, WarningKind::PoorFit);
        assert!(!said.contains("do not have one"), "{said}");
    }
}

/// Each of eight files alone hardly tells the spring, and all of them tell it.
#[test]
fn a_spring_that_files_tell_together_is_told() {
    for seed in 0..10 {
        let files = (0..8_u32).zip(8 * seed..).map(|(i, seed)| {
            let deepest = 2e-7 + 6e-7 * f64::from(i) / 7.0;
            pressed(1.3e4, deepest, 0.3, seed)
        });
        let found = fitted(&files.collect::<Vec<Experiment>>());
        assert_warns(&found, WarningKind::SpringWanted, "spring");
    }
}
