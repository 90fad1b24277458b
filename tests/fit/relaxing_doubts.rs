//! Doubts about fits of bodies that relax.

use acceptance::solid;
use contact::Relaxation;
use fit::{Bodies, Experiment, Free, Kind, Parameter, WarningKind};

use crate::imagined::{fit_all, fitted, free_of, text};
use crate::relaxing::{noisy, planned, power};

/// A gel that relaxes on a base, 60 points in 2 s.
fn relaxing(law: Relaxation, young: f64, base: f64) -> Experiment {
    let mut plan = planned(Kind::LoadPenetration, 1e-5, &law, 0.0);
    let Bodies::Coated(system) = &mut plan.bodies else {
        unreachable!("a gel is on a base")
    };
    system.film = solid(young, 0.5);
    system.substrate = solid(base, 0.25);
    if let Some(relaxing) = &mut plan.relaxing {
        relaxing.all_bodies = base < f64::INFINITY;
    }
    noisy(&plan, 1)
}

#[test]
fn a_relaxation_time_that_the_points_do_not_see_is_doubted() {
    for (time, is_doubted) in [(0.01, true), (0.3, false), (10.0, true)] {
        let law = Relaxation::Prony {
            relaxed: 0.3,
            terms: vec![[0.7, time]],
        };
        let data = relaxing(law, 2e3, f64::INFINITY);
        let bounds = Free::new(Parameter::RelaxationTime(1)).within(0.5 * time, 2.0 * time);
        let found = fit_all(&[data], &[Free::new(Parameter::FilmModulus), bounds]);
        let said = text(&found.expect("sound"), WarningKind::RelaxationTime);
        let is_said = said.contains("two intervals between points");
        assert_eq!(is_said, is_doubted, "{time}: {said}");
    }
}

#[test]
fn a_stiff_film_on_a_soft_base_that_relax_together_is_doubted() {
    for (young, base, is_doubted) in [(2e4, 2e3, true), (2e3, 2e4, false), (2e3, 1e3, false)] {
        let data = relaxing(power(), young, base);
        let found = fitted(&data, &free_of(&[Parameter::FilmModulus]));
        let doubted = found.warns_of(WarningKind::TensileInside);
        assert_eq!(doubted, is_doubted, "{young:e} {base:e}");
    }
}
