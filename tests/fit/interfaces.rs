//! Fits of films that slide or are joined by springs, and what fits say about interfaces.

use acceptance::{Refused, assert_names, rigid_sphere, solid, springs};
use fit::{Bodies, Fit, Free, Kind, LayerQuantity, Parameter, WarningKind, forecast};
use interp::{System, Table};
use solve::solve_stack;
use solve::stack::{Interface, Stack};

use crate::imagined::{Imagined, as_film, assert_silent, fitted};
use crate::layers::{fit_of, layer, modulus_of, named, on_layers, recover, with_reach};

const INFINITY: f64 = f64::INFINITY;

fn stiffness() -> Parameter {
    Parameter::Layer(named("film"), LayerQuantity::InterfaceStiffness)
}

fn modulus() -> Parameter {
    modulus_of("film")
}

/// A lens on an elastomer of 10 um on silicon, with an interface between them. A parameter and the work of
/// adhesion are free.
fn lens(interface: Interface, parameter: Parameter) -> Imagined {
    let free = [parameter, Parameter::WorkOfAdhesion];
    let mut lens = Imagined::lens(Kind::LoadRadius, 10e-6, 1e-6, &free);
    set(&mut lens, interface, |_| {});
    lens
}

/// Puts the film of an imagined experiment on its substrate with an interface.
fn set(imagined: &mut Imagined, interface: Interface, change: impl Fn(&mut System)) {
    let mut system = as_film(&imagined.truth.bodies);
    change(&mut system);
    let mut film = layer("film", system.film, system.film_thickness);
    film.layer.interface = interface;
    imagined.truth.bodies = on_layers(&system, &[film]);
}

/// Returns the text of the only warning of a kind.
fn only(found: &Fit, kind: WarningKind) -> &str {
    let mut of_kind = found.warnings.iter().filter(|one| one.kind == kind);
    match (of_kind.next(), of_kind.next()) {
        (Some(warning), None) => &warning.text,
        _ => panic!("not one {kind:?} in {:?}", found.warnings),
    }
}

#[test]
fn the_stiffness_of_an_interface_is_found() {
    let lens = lens(springs(3e11, INFINITY), stiffness());
    let expected = [WarningKind::LargeStrain];
    recover("lens, interface's stiffness", &lens, &expected);
}

#[test]
fn the_modulus_of_a_sliding_film_is_found() {
    let lens = lens(Interface::Sliding, modulus());
    let expected = [WarningKind::LargeStrain, WarningKind::Friction];
    recover("lens, modulus of a sliding film", &lens, &expected);
}

/// Data of a film that slides tell no lower bound of the stiffness, data of a bonded one no upper
/// bound, and data of a film far thicker than the contact neither.
#[test]
fn data_that_do_not_tell_the_interface_are_named() {
    // As good as sliding and bonded, by springs whose stiffness can be free.
    let [slides, bonded] = [1.0, 1e22].map(|stiffness| springs(stiffness, INFINITY));
    let cases = [
        (slides, 10e-6, "no lower bound; sliding"),
        (bonded, 10e-6, "no upper bound; bonded"),
        (slides, 5e-3, "not told by these data; wider"),
    ];
    for (truth, thickness, words) in cases {
        let mut of_truth = lens(truth, stiffness());
        set(&mut of_truth, truth, |of| of.film_thickness = thickness);
        let exact = of_truth.exact();
        for seed in 0..5 {
            let found = fit_of(of_truth.measured(&exact, seed), &of_truth);
            assert_names(only(&found, WarningKind::InterfaceNotSeen), words);
        }
    }
    // Where the stiffness is found, nothing is open.
    let told = lens(springs(3e11, INFINITY), stiffness());
    let found = fit_of(told.measured(&told.exact(), 0), &told);
    assert_silent(&found, WarningKind::InterfaceNotSeen);
}

/// Under a rigid sphere on a rigid base, the load is proportional to the modulus: the
/// factor is the ratio of the stiffnesses of the widest contact.
#[test]
fn a_fit_that_assumes_bonding_says_what_sliding_would_change() {
    let mut bonded = lens(Interface::Bonded, modulus());
    set(&mut bonded, Interface::Bonded, |system| {
        system.sphere_modulus = INFINITY;
        system.substrate = solid(INFINITY, 0.25);
    });
    let found = fit_of(bonded.measured(&bonded.exact(), 0), &bonded);
    let film = as_film(&bonded.truth.bodies);
    let widest = bonded.radii[1] / film.film_thickness;
    let eeq = |interface| {
        let stack = Stack::of_film(&film, interface).expect("physical");
        let solution = solve_stack(widest, &stack, INFINITY, 1e-8).expect("within reach");
        solution.quantities.eeq
    };
    let factor = eeq(Interface::Bonded) / eeq(Interface::Sliding);
    let told = only(&found, WarningKind::AssumesBonding);
    assert_names(told, "film.modulus; bonded; slid");
    let printed = told
        .split(" times as large")
        .next()
        .and_then(|before| before.rsplit(' ').next())
        .and_then(|number| number.parse::<f64>().ok())
        .expect("a factor");
    assert!((printed / factor - 1.0).abs() <= 2e-3, "{printed} {factor}");

    // A film that slides, or is on springs, assumes nothing.
    for interface in [Interface::Sliding, springs(3e11, INFINITY)] {
        let other = lens(interface, modulus());
        let found = fit_of(other.measured(&other.exact(), 0), &other);
        assert_silent(&found, WarningKind::AssumesBonding);
    }
    // Contacts that are small beside the film do not feel its interface.
    let mut thick = lens(Interface::Bonded, modulus());
    set(&mut thick, Interface::Bonded, |of| of.film_thickness = 0.1);
    let found = fit_of(thick.measured(&thick.exact(), 0), &thick);
    assert_silent(&found, WarningKind::AssumesBonding);
}

/// No stack of such a contrast is solved, and the base is as good as rigid.
#[test]
fn the_softest_films_on_glass_have_the_doubts_of_those_on_a_rigid_base() {
    let told = |base: f64| {
        let free = [Parameter::FilmModulus];
        let mut soft = Imagined::lens(Kind::LoadRadius, 1e-4, 1e-9, &free);
        let film = rigid_sphere(1e-3, [50.0, 0.5], 1e-4, [base, 0.25]);
        soft.truth.bodies = Bodies::coated(&film);
        soft.truth.work_of_adhesion = 0.0;
        let found = fitted(&soft.measured(&soft.exact(), 0), &soft.free);
        [WarningKind::AssumesBonding, WarningKind::Friction]
            .map(|kind| only(&found, kind).to_owned())
    };
    assert_eq!(told(7e10), told(INFINITY));
}

/// The errors of a plan are those at the planned value, and a bonded or sliding film has none.
#[test]
fn the_stiffness_of_an_interface_is_planned_where_it_is_free() {
    let planned = |interface| {
        let planned = with_reach(lens(interface, modulus()).planned());
        let free = [modulus(), stiffness()].map(Free::new);
        forecast(Table::embedded(), &[planned], &free)
    };
    planned(springs(2e11, INFINITY)).expect("a stiffness is planned");
    for interface in [Interface::Bonded, Interface::Sliding] {
        planned(interface)
            .refused("film.interface-stiffness; planned as 0 or infinite; plan another one");
    }
}
