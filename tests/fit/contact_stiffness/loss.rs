//! Storage and loss: the modulus and the loss tangent of a film from stiffness and phase.

use acceptance::{Data, Refused, larger, rigid_sphere, solid, system_of};
use fit::{Bodies, Kind, Parameter, WarningKind, simulate};
use interp::{Probe, Table};
use rayon::prelude::*;

use super::{at_radii, experiment, fitted, oxide};
use crate::imagined::{assert_warns, text};

/// The modulus and the loss tangent of a film from stiffness and phase, against solves with complex
/// moduli by another program.
#[test]
fn a_complex_modulus_is_found_to_one_percent_up_to_a_loss_tangent_of_one() {
    let data = Data::read("complex_stiffness");
    let cases: Vec<_> = data.cases().collect();
    let films: Vec<Vec<_>> = (0..cases.len())
        .step_by(6)
        .flat_map(|first| [0, 1].map(|tangent| [0, 2, 4].map(|i| first + tangent + i).to_vec()))
        .collect();
    let misses = films.par_iter().map(|rows| {
        let get = |i: usize, name: &str| cases[rows[i]].get(name);
        let (unit, thickness) = (1e9, 1e-6);
        let (young, tangent) = (get(0, "e1_over_e2") * unit, get(0, "loss_tangent"));
        let system = system_of(
            Probe::Paraboloid { radius: 0.1 },
            unit,
            solid(1.3 * young, get(0, "nu1")),
            thickness,
            solid(get(0, "e0_over_e2") * unit, get(0, "nu0")),
        );
        let point = |i| {
            let a = get(i, "a_over_t") * thickness;
            let stiffness = 2.0 * a * unit * get(i, "eeq");
            [a, stiffness * get(i, "phase").cos()]
        };
        let points = (0..3).map(point).collect();
        let mut measured = experiment(Kind::StiffnessRadius, Bodies::coated(&system), points);
        measured.indentation.phases = (0..3).map(|i| get(i, "phase")).collect();
        measured.noise = Some(1e-3);
        let found = fitted(measured, [Parameter::FilmModulus]).expect("sound data");
        let loss = found.experiments[0].loss.expect("phases are measured");
        let of = |i| get(i, "a_over_t");
        // Where the substrate hides the film, its modulus does not matter to the stiffness.
        [
            (found.estimates[0].value / young - 1.0).abs(),
            (loss.tangent() / tangent - 1.0).abs(),
            of(0),
        ]
    });
    let misses: Vec<[f64; 3]> = misses.collect();
    let worst = misses.iter().fold([0.0_f64; 2], |worst, one| {
        [larger(worst[0], one[0]), larger(worst[1], one[1])]
    });
    assert!(worst[0] < 0.01 && worst[1] < 0.01, "{misses:?}");
}

/// On a rigid base and under a rigid sphere the loss tangent of the film is that of the stiffness,
/// and a frame in series with the contact is taken out.
#[test]
fn a_film_alone_has_the_loss_tangent_of_its_stiffness() {
    let system = rigid_sphere(1e-4, [1e6, 0.4], 1e-6, [f64::INFINITY, 0.3]);
    for (phase, compliance) in [(0.2, 0.0), (0.7, 0.0), (0.4, 0.05)] {
        let mut measured = at_radii(&system, [3e-7, 5e-6], 8);
        let points = &mut measured.measurement.points;
        measured.indentation.frame_compliance = compliance;
        measured.indentation.phases = points
            .iter_mut()
            .map(|point| {
                let stiffness: f64 = point.ordinate;
                let real = f64::cos(phase) / stiffness + compliance;
                let imaginary = f64::sin(phase) / stiffness;
                let phase = imaginary.atan2(real);
                point.ordinate = phase.cos() / real.hypot(imaginary);
                phase
            })
            .collect();
        measured.noise = Some(1e-3);
        let found = fitted(measured, [Parameter::FilmModulus]).expect("sound data");
        let loss = found.experiments[0].loss.expect("phases are measured");
        assert!((loss.angle - phase).abs() < 1e-5, "{phase}: {loss:?}");
        let value = found.estimates[0].value;
        assert!((value / 1e6 - 1.0).abs() < 1e-5, "{phase}: {value}");
    }
}

/// The substrate alone has a loss, or the phases count in the opposite sense.
#[test]
fn phases_of_other_bodies_are_doubted() {
    let plan = |tangent: f64, seed: u64| {
        let mut plan = at_radii(&oxide(), [5e-8, 1.5e-6], 20);
        plan.indentation.loss_tangent = tangent;
        simulate(Table::embedded(), &plan, 0.01, seed).expect("a contact")
    };
    let found = |made| fitted(made, [Parameter::FilmModulus]).expect("data");
    for seed in 0..4 {
        let mut made = plan(0.1, seed);
        let sound = text(&found(made.clone()), WarningKind::PoorFit);
        assert!(sound.is_empty(), "{sound}");
        let phases = made.indentation.phases.clone();
        made.indentation.phases = phases.iter().map(|phase| -phase).collect();
        assert_warns(
            &found(made.clone()),
            WarningKind::Implausible,
            "loss tangent of -0.; sign",
        );
        made.indentation.phases = phases.iter().map(|phase| 0.1 - phase).collect();
        assert_warns(
            &found(made),
            WarningKind::PoorFit,
            "phases; only the film; without phases",
        );
    }
}

#[test]
fn a_loss_tangent_above_one_is_refused() {
    let mut measured = at_radii(&oxide(), [5e-8, 2e-7], 8);
    measured.indentation.phases = vec![0.9; 8];
    let found = fitted(measured, [Parameter::FilmModulus]);
    found.refused("the loss tangent of the film is 2.1; holds up to 1");
    // Noise may bring a tangent of 1 to 1.05 where it is as large.
    let alone = rigid_sphere(1e-4, [1e6, 0.4], 1e-6, [f64::INFINITY, 0.3]);
    let mut measured = at_radii(&alone, [3e-7, 5e-6], 8);
    for (scatter, accepted) in [(0.0, false), (0.1, true)] {
        let phases = (0..8).map(|i| 1.05_f64.atan() + [scatter, -scatter][i % 2]);
        measured.indentation.phases = phases.collect();
        let found = fitted(measured.clone(), [Parameter::FilmModulus]);
        assert_eq!(found.is_ok(), accepted, "{scatter}");
    }
}
