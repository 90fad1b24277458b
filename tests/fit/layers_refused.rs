//! Layers that are not there, that cannot be solved, or whose fit is interrupted.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use acceptance::assert_names;
use contact::Contact;
use fit::{
    Bodies, Cause, Experiment, Free, Interruptible, Kind, Layered, LayeredSolver, Parameter,
};
use interp::Probe;

use crate::imagined::{Imagined, fit_all};
use crate::layers::{lens, named, with_reach};

#[test]
fn what_layers_do_not_have_is_named() {
    let lens = lens(&[Parameter::WorkOfAdhesion]);
    let experiment = with_reach(lens.measured(&lens.exact(), 1));
    let refused = |experiment: &Experiment, free: Parameter| {
        let free = [Free::new(free)];
        let experiments = [experiment.clone()];
        fit_all(&experiments, &free)
            .expect_err("refused")
            .to_string()
    };
    let all = [
        "primer.modulus",
        "primer.thickness",
        "elastomer.modulus",
        "elastomer.thickness",
    ];
    let message = refused(&experiment, Parameter::LayerModulus(named("oxide")));
    assert_names(
        &message,
        &[&["oxide.modulus", "no such layer"][..], &all].concat(),
    );
    let message = refused(&experiment, Parameter::FilmThickness);
    assert_names(
        &message,
        &[&["film-thickness", "instead of one film"][..], &all].concat(),
    );
    let mut on_film = experiment.clone();
    on_film.bodies = Imagined::lens(Kind::LoadRadius, 1e-5, 5e-6, &[])
        .truth
        .bodies;
    let message = refused(&on_film, Parameter::LayerModulus(named("oxide")));
    assert_names(&message, &["oxide.modulus", "no stack of layers"]);
    let mut set = experiment;
    let error = set.set(Parameter::LayerThickness(named("oxide")), 1e-6);
    assert_names(
        &error.expect_err("refused").to_string(),
        &["oxide", "no such layer"],
    );
    let error = "oxide.poisson"
        .parse::<Parameter>()
        .expect_err("no parameter");
    assert_names(&error.to_string(), &["oxide.poisson", "LAYER.modulus"]);
}

#[test]
fn layers_that_cannot_be_solved_are_named() {
    let lens = lens(&[Parameter::WorkOfAdhesion]);
    let sound = with_reach(lens.measured(&lens.exact(), 1));
    let refused = |name: &str, is_modulus: bool, value: f64| {
        let mut experiment = sound.clone();
        let parameter = if is_modulus {
            Parameter::LayerModulus(named(name))
        } else {
            Parameter::LayerThickness(named(name))
        };
        experiment.set(parameter, value).expect("a number");
        fit_all(&[experiment], &lens.free)
            .expect_err("refused")
            .to_string()
    };
    let message = refused("primer", false, -1e-6);
    assert_names(&message, &["layer primer", "-1e-6", "> 0 and finite"]);
    let message = refused("primer", true, f64::INFINITY);
    assert_names(&message, &["layer primer", "inf", "must be finite"]);
    let message = refused("elastomer", true, 1e18);
    assert_names(&message, &["layer elastomer", "1e9 times"]);
    // A top layer of 10 nm under contacts of 130 um.
    let message = refused("elastomer", false, 1e-8);
    assert_names(&message, &["out of reach", "top layer"]);
}

#[test]
fn a_cone_on_layers_is_refused() {
    let lens = lens(&[Parameter::WorkOfAdhesion]);
    let mut experiment = with_reach(lens.measured(&lens.exact(), 1));
    let Bodies::Layered(layered) = &mut experiment.bodies else {
        unreachable!("a lens on layers")
    };
    layered.probe = Probe::Cone { half_angle: 1.4 };
    let error = fit_all(&[experiment], &lens.free);
    let message = error.expect_err("refused").to_string();
    assert_names(&message, &["stack", "paraboloid"]);
}

/// Counts the contacts that it makes, and is interrupted during one of them.
#[derive(Debug)]
struct Counted {
    made: AtomicUsize,
    last: usize,
    interrupted: Arc<AtomicBool>,
}

impl LayeredSolver for Counted {
    fn contact(&self, bodies: &Layered) -> Result<Contact, Cause> {
        if self.made.fetch_add(1, Ordering::Relaxed) + 1 == self.last {
            self.interrupted.store(true, Ordering::Relaxed);
        }
        fit::DirectSolver.contact(bodies)
    }
}

#[test]
fn an_interrupted_fit_makes_no_further_contact() {
    let primer = Parameter::LayerModulus(named("primer"));
    let lens = lens(&[primer, Parameter::WorkOfAdhesion]);
    let experiment = with_reach(lens.measured(&lens.exact(), 1));
    let contacts_until = |last: usize| {
        let interrupted = Arc::new(AtomicBool::new(false));
        let counted = Arc::new(Counted {
            made: AtomicUsize::new(0),
            last,
            interrupted: interrupted.clone(),
        });
        let mut experiment = experiment.clone();
        let Bodies::Layered(layered) = &mut experiment.bodies else {
            unreachable!("a lens is on layers")
        };
        layered.solver = Arc::new(Interruptible {
            solver: counted.clone(),
            interrupted,
        });
        let found = fit_all(&[experiment], &lens.free);
        let made = counted.made.load(Ordering::Relaxed);
        assert!(made >= last || found.is_ok(), "{found:?}");
        made
    };
    let all = contacts_until(usize::MAX);
    assert!(all > 10, "{all}");
    for last in [1, 2, all / 2, all] {
        assert_eq!(contacts_until(last), last);
    }
}
