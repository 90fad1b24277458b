//! Layers that are not there, that cannot be solved, or whose fit is interrupted.

use std::slice;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use acceptance::{Refused, solid};
use fit::{Experiment, Fixed, Free, Interrupt, Kind, Parameter};

use crate::imagined::{Imagined, fit_all};
use crate::layers::{lens, modulus_of, named, thickness_of, with_reach};

#[test]
fn what_layers_do_not_have_is_named() {
    let lens = lens(&[Parameter::WorkOfAdhesion]);
    let experiment = with_reach(lens.measured(&lens.exact(), 1));
    let all = "primer.modulus; primer.thickness; elastomer.modulus; elastomer.thickness";
    let fitted =
        |experiment: &Experiment, free| fit_all(slice::from_ref(experiment), &[Free::new(free)]);
    let oxide = modulus_of("oxide");
    fitted(&experiment, oxide).refused(&format!("oxide.modulus; no such layer; {all}"));
    fitted(&experiment, Parameter::FilmThickness)
        .refused(&format!("film-thickness; instead of one film; {all}"));
    let mut on_film = experiment.clone();
    on_film.bodies = Imagined::lens(Kind::LoadRadius, 1e-5, 5e-6, &[])
        .truth
        .bodies;
    fitted(&on_film, oxide).refused("oxide.modulus; no stack of layers");
    let mut set = experiment;
    let thickness = thickness_of("oxide");
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
    with(thickness_of("primer"), -1e-6).refused("layer primer; -1e-6; > 0 and finite");
    with(modulus_of("primer"), f64::INFINITY).refused("layer primer; inf; must be finite");
    with(modulus_of("elastomer"), 1e18).refused("layer elastomer; 1e9 times");
    // A top layer of 10 nm under contacts of 130 um.
    with(thickness_of("elastomer"), 1e-8).refused("out of reach; top layer");
}

#[test]
fn an_interrupted_fit_is_an_error_and_ends() {
    let primer = modulus_of("primer");
    let lens = lens(&[primer, Parameter::WorkOfAdhesion]);
    let experiment = with_reach(lens.measured(&lens.exact(), 1));
    let contacts_until = |last: usize| {
        // Asked before each contact; from the contact after `last` on, nobody waits.
        let asked = Arc::new(AtomicUsize::new(0));
        let mut experiment = experiment.clone();
        let count = Arc::clone(&asked);
        experiment.bodies.interrupt =
            Interrupt::when(move || count.fetch_add(1, Ordering::Relaxed) >= last);
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

#[test]
fn values_of_a_name_are_those_of_all_layers_that_have_it() {
    let mut experiment = lens(&[Parameter::WorkOfAdhesion]).truth;
    let name = named("both");
    let layers = experiment.bodies.layers.iter_mut();
    layers.for_each(|layer| layer.name = Some(name));
    let ratio = Fixed::NamedPoissonRatio(name);
    experiment.set(modulus_of("both"), 1e7).expect("physical");
    experiment.set_fixed(ratio, 0.2).expect("physical");
    let layers = experiment.bodies.layers.iter();
    let solids = layers.map(|layer| layer.layer.solid);
    assert_eq!(solids.collect::<Vec<_>>(), [solid(1e7, 0.2); 2]);
}
