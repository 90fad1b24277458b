//! Layers that are not there, that cannot be solved, or whose fit is interrupted.

use std::slice;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use acceptance::Refused;
use fit::{Bodies, Experiment, Free, Interrupt, Kind, Parameter};
use interp::Probe;

use crate::imagined::{Imagined, fit_all};
use crate::layers::{lens, named, with_reach};

#[test]
fn what_layers_do_not_have_is_named() {
    let lens = lens(&[Parameter::WorkOfAdhesion]);
    let experiment = with_reach(lens.measured(&lens.exact(), 1));
    let all = "primer.modulus; primer.thickness; elastomer.modulus; elastomer.thickness";
    let fitted =
        |experiment: &Experiment, free| fit_all(slice::from_ref(experiment), &[Free::new(free)]);
    let oxide = Parameter::LayerModulus(named("oxide"));
    fitted(&experiment, oxide).refused(&format!("oxide.modulus; no such layer; {all}"));
    fitted(&experiment, Parameter::FilmThickness)
        .refused(&format!("film-thickness; instead of one film; {all}"));
    let mut on_film = experiment.clone();
    on_film.bodies = Imagined::lens(Kind::LoadRadius, 1e-5, 5e-6, &[])
        .truth
        .bodies;
    fitted(&on_film, oxide).refused("oxide.modulus; no stack of layers");
    let mut set = experiment;
    let thickness = Parameter::LayerThickness(named("oxide"));
    set.set(thickness, 1e-6).refused("oxide; no such layer");
    let unknown = "oxide.poisson".parse::<Parameter>();
    unknown.refused("oxide.poisson; LAYER.modulus");
}

#[test]
fn layers_that_cannot_be_solved_are_named() {
    let lens = lens(&[Parameter::WorkOfAdhesion]);
    let sound = with_reach(lens.measured(&lens.exact(), 1));
    let with = |parameter: Parameter, value: f64| {
        let mut experiment = sound.clone();
        experiment.set(parameter, value).expect("a number");
        fit_all(&[experiment], &lens.free)
    };
    let [modulus, thickness] = [Parameter::LayerModulus, Parameter::LayerThickness];
    with(thickness(named("primer")), -1e-6).refused("layer primer; -1e-6; > 0 and finite");
    with(modulus(named("primer")), f64::INFINITY).refused("layer primer; inf; must be finite");
    with(modulus(named("elastomer")), 1e18).refused("layer elastomer; 1e9 times");
    // A top layer of 10 nm under contacts of 130 um.
    with(thickness(named("elastomer")), 1e-8).refused("out of reach; top layer");
}

#[test]
fn a_cone_on_layers_is_refused() {
    let lens = lens(&[Parameter::WorkOfAdhesion]);
    let mut experiment = with_reach(lens.measured(&lens.exact(), 1));
    let Bodies::Layered(layered) = &mut experiment.bodies else {
        unreachable!("a lens on layers")
    };
    layered.probe = Probe::Cone { half_angle: 1.4 };
    fit_all(&[experiment], &lens.free).refused("stack; paraboloid");
}

#[test]
fn an_interrupted_fit_is_an_error_and_ends() {
    let primer = Parameter::LayerModulus(named("primer"));
    let lens = lens(&[primer, Parameter::WorkOfAdhesion]);
    let experiment = with_reach(lens.measured(&lens.exact(), 1));
    let contacts_until = |last: usize| {
        // Asked before each contact; from the contact after `last` on, nobody waits.
        let asked = Arc::new(AtomicUsize::new(0));
        let mut experiment = experiment.clone();
        let Bodies::Layered(layered) = &mut experiment.bodies else {
            unreachable!("a lens is on layers")
        };
        let count = Arc::clone(&asked);
        layered.interrupt = Interrupt::when(move || count.fetch_add(1, Ordering::Relaxed) >= last);
        let found = fit_all(&[experiment], &lens.free);
        let asked = asked.load(Ordering::Relaxed);
        if last == usize::MAX {
            found.expect("nobody interrupts it");
        } else {
            found.refused("interrupted");
        }
        asked
    };
    let all = contacts_until(usize::MAX);
    assert!(all > 10, "{all}");
    for last in [0, 1, 2, all / 2, all - 1] {
        // A step that is refused is shortened some times, and then the fit is at its end.
        let refused = contacts_until(last) - last;
        assert!((1..2 * all).contains(&refused), "{refused} after {last}");
    }
}
