//! Fits of contact stiffness: the truth within the intervals, for data by direct solves.

mod doubts;
mod loss;
mod refused;

use std::f64::consts::PI;

use acceptance::{Contacts, assert_close, larger, rigid_sphere, solid, solved_contact, system_of};
use contact::Contact;
use fit::{
    AreaFunction, Bodies, ContactDepth, Error, Experiment, Fit, Free, Indentation, Kind, Parameter,
    PointErrors, WarningKind, simulate,
};
use interp::{Probe, System, Table};

use crate::imagined::{
    assert_silent, assert_warned, assert_warns, fit_all, free_of, half_space, measurement_at,
    measurement_of, number_after, text,
};
use crate::layers::{layer, modulus_of, on_layers};
use crate::recovery::{SETS, assert_recovers};

/// A diamond on 500 nm of silicon dioxide on silicon.
pub fn oxide() -> System {
    system_of(
        Probe::Paraboloid { radius: 1e-5 },
        1.1466e12,
        solid(7.2e10, 0.17),
        5e-7,
        solid(1.7e11, 0.28),
    )
}

/// The contact by direct solves, without the table.
fn solved(system: &System, radii: [f64; 2]) -> Contact {
    let range = [0.5 * radii[0], 1.5 * radii[1]].map(|a| a / system.film_thickness);
    solved_contact(system, range, 1e-10)
}

fn evenly([from, to]: [f64; 2], count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| from + (to - from) * i as f64 / (count - 1) as f64)
}

/// Makes an experiment of points.
fn experiment(kind: Kind, bodies: Bodies, points: Vec<[f64; 2]>) -> Experiment {
    Experiment::new(measurement_of(kind, points), bodies)
}

/// Multiplies the stiffnesses by normal noise, and moves the abscissae by theirs.
pub fn noisy(exact: &Experiment, noise: f64, seed: u64) -> Experiment {
    let mut random = Contacts::new(seed);
    let mut made = exact.clone();
    for point in &mut made.measurement.points {
        point.ordinate *= 1.0 + noise * random.normal();
        if exact.abscissa_noise > 0.0 {
            point.abscissa += exact.abscissa_noise * random.normal();
        }
    }
    made
}

/// Fits 200 data sets, from other values than the true ones.
fn recover(
    name: &str,
    exact: &[Experiment],
    (noise, is_known): (f64, bool),
    free: &[Parameter],
    expected: &[WarningKind],
) {
    let frees = free_of(free);
    let fit_of = |seed: u64| {
        let made = exact.iter().enumerate().map(|(e, exact)| {
            let mut made = noisy(exact, noise, 1000 * seed + e as u64);
            made.noise = is_known.then_some(noise);
            for (parameter, factor) in [
                (Parameter::FilmModulus, 1.5),
                (Parameter::FilmThickness, 1.2),
                (Parameter::Hardness, 0.7),
                (Parameter::TipRounding, 0.0),
                (Parameter::FrameCompliance, 0.0),
            ] {
                if free.contains(&parameter)
                    && let Some(value) = made.get(parameter)
                {
                    made.set(parameter, factor * value).expect("allowed");
                }
            }
            made
        });
        let made: Vec<Experiment> = made.collect();
        fit_all(&made, &frees).expect("sound data")
    };
    // Films on which the interface matters are said to be taken as bonded.
    let expected = [expected, &[WarningKind::AssumesBonding]].concat();
    assert_recovers(name, &exact[0], 0..SETS, fit_of, &expected);
}

/// Returns the fit of these parameters to one set of data.
fn fitted<const N: usize>(measured: Experiment, free: [Parameter; N]) -> Result<Fit, Error> {
    fit_all(&[measured], &free.map(Free::new))
}

/// Stiffnesses at contact radii.
pub fn at_radii(system: &System, radii: [f64; 2], count: usize) -> Experiment {
    let contact = solved(system, radii);
    let point = |a| [a, contact.stiffness(a).expect("in range")];
    let points = evenly(radii, count).map(point).collect();
    let bodies = Bodies::coated(system);
    experiment(Kind::StiffnessRadius, bodies, points)
}

/// Stiffnesses at the loads of a plastic contact of the hardness 10 GPa.
pub fn at_loads(system: &System, radii: [f64; 2], count: usize) -> Experiment {
    let mut made = at_radii(system, radii, count);
    made.measurement.kind = Kind::StiffnessLoad;
    made.indentation.hardness = Some(1e10);
    for point in &mut made.measurement.points {
        point.abscissa = PI * 1e10 * point.abscissa.powi(2);
    }
    made
}

#[test]
fn stiffness_at_contact_radii_and_loads() {
    use Parameter::{FilmModulus, FilmThickness, Hardness};
    let radii = at_radii(&oxide(), [5e-8, 1.5e-6], 30);
    // Of so many loads with errors a first fit takes some.
    let mut many_loads = at_loads(&oxide(), [2e-7, 1e-6], 100);
    many_loads.abscissa_noise = 1e-4;
    let mut loads = at_loads(&oxide(), [5e-8, 1e-6], 30);
    loads.indentation.beta = 1.034;
    for point in &mut loads.measurement.points {
        point.ordinate *= 1.034;
    }
    let both = [FilmModulus, FilmThickness];
    for (name, exact, noise, free) in [
        ("radius", &radii, (0.02, true), &[FilmModulus][..]),
        ("radius, thickness", &radii, (0.02, false), &both),
        ("load errors", &many_loads, (0.01, true), &[FilmModulus]),
        ("hardness", &loads, (0.01, true), &[FilmModulus, Hardness]),
    ] {
        let exact = std::slice::from_ref(exact);
        let name = format!("stiffness, {name}");
        let expected = [WarningKind::Friction, WarningKind::OneHardness];
        recover(&name, exact, noise, free, &expected[..free.len()]);
    }
    // A hardness that rises by a tenth makes the modulus wrong by what is told.
    let [least, most] = [5e-8_f64, 1e-6].map(|a| 2.0 * a.ln());
    for point in &mut loads.measurement.points {
        let place = ((point.abscissa / (PI * 1e10)).ln() - least) / (most - least) - 0.5;
        point.abscissa *= 1.0 + 0.1 * place;
    }
    loads.noise = Some(0.01);
    let found = fitted(loads, [FilmModulus, Hardness]).expect("sound");
    let told = number_after(&text(&found, WarningKind::OneHardness), "would change by ");
    let modulus = found.estimate(FilmModulus).expect("free").value;
    let truth = oxide().film.young();
    let wrong = 1e2 * (modulus / truth - 1.0);
    assert!(
        (wrong / -told - 1.0).abs() < 0.15 && wrong.abs() > 5.0,
        "{wrong} {told}"
    );
}

/// A rigid substrate tells no hardness to start from, and neither does a film whose modulus is unknown.
#[test]
fn hardness_on_a_rigid_substrate_without_a_start() {
    let mut system = oxide();
    system.substrate = solid(f64::INFINITY, 0.25);
    for radii in [[1.5e-8, 1.5e-7], [1e-7, 1.5e-6]] {
        let mut made = at_loads(&system, radii, 30);
        made.indentation.hardness = None;
        let free = [Parameter::FilmModulus, Parameter::Hardness];
        made.set(free[0], 1e6).expect("allowed");
        let found = fitted(made, free).expect("sound data");
        for (estimate, truth) in found.estimates.iter().zip([system.film.young(), 1e10]) {
            assert_close(estimate.value, truth, 1e-4);
        }
    }
}

#[test]
fn stiffness_at_loads_of_an_elastic_contact() {
    let film = rigid_sphere(2e-5, [2e6, 0.49], 5e-6, [7e10, 0.2]);
    let radii = [1e-6, 5e-6];
    let contact = solved(&film, radii);
    for (w, free) in [
        (0.0, &[Parameter::FilmModulus][..]),
        (5e-3, &[Parameter::FilmModulus, Parameter::WorkOfAdhesion]),
    ] {
        let exact = [at_elastic_loads(&film, &contact, radii, w)];
        // The widest contacts are as wide as this nearly incompressible film is thick.
        let expected = [
            WarningKind::LargeStrain,
            WarningKind::Friction,
            WarningKind::LargeContact,
        ];
        recover("elastic load", &exact, (0.01, true), free, &expected);
    }
}

/// Stiffnesses at the loads, where they are above 0, of an elastic contact.
fn at_elastic_loads(system: &System, contact: &Contact, radii: [f64; 2], w: f64) -> Experiment {
    let point = |a| {
        let load = contact.load(a, w).expect("in range");
        [load, contact.stiffness(a).expect("in range")]
    };
    let points = evenly(radii, 40).map(point);
    let points = points.filter(|[load, _]| *load > 0.0).collect();
    let mut exact = experiment(Kind::StiffnessLoad, Bodies::coated(system), points);
    exact.work_of_adhesion = w;
    exact
}

/// The steps of the differences lead beyond the widest contact that is solved, 0.55 R.
#[test]
fn loads_up_to_the_end_of_the_exact_sphere() {
    let system = System {
        probe: Probe::Sphere { radius: 1e-6 },
        ..oxide()
    };
    let radii = [2e-7, 5.4999e-7];
    let contact = solved_contact(&system, [0.02, 1.5], 1e-9);
    let exact = at_elastic_loads(&system, &contact, radii, 0.0);
    let found = fitted(exact, [Parameter::FilmModulus]).expect("sound data");
    assert!(found.converged);
    assert_close(found.estimates[0].value, system.film.young(), 1e-4);
}

/// Stiffnesses and loads at depths, by Oliver and Pharr's formulae.
fn at_depths(bodies: Bodies, contact: &Contact, known: &Indentation, hardness: f64) -> Experiment {
    let mut loads = Vec::new();
    let points = evenly([8e-8, 5e-7], 25).map(|a| {
        let stiffness = known.beta * contact.stiffness(a).expect("in range");
        let load = PI * hardness * a * a;
        let contact_depth = a / (24.56 / PI).sqrt();
        let h = contact_depth - known.tip_rounding + known.epsilon * load / stiffness;
        loads.push(load);
        [
            h + known.frame_compliance * load,
            1.0 / (1.0 / stiffness + known.frame_compliance),
        ]
    });
    let points = points.collect();
    let mut made = experiment(Kind::StiffnessDepth, bodies, points);
    made.indentation = Indentation {
        loads,
        ..known.clone()
    };
    made
}

/// A sample and a bare reference, of which the latter tells tip and frame.
#[test]
fn stiffness_at_depths_with_a_reference_sample() {
    use Parameter::{FilmModulus, FrameCompliance, TipRounding};
    let known = Indentation {
        beta: 1.034,
        tip_rounding: 6e-9,
        frame_compliance: 2e-7,
        ..Indentation::NEW
    };
    let system = oxide();
    let contact = solved(&system, [8e-8, 5e-7]);
    let film = at_depths(Bodies::coated(&system), &contact, &known, 1e10);
    let bare = Contact::half_space(&system.without_film()).expect("physical");
    let reference = at_depths(on_layers(&system, &[]), &bare, &known, 1.2e10);
    let definition = [WarningKind::ContactDepth, WarningKind::Friction];
    let both = [film, reference];
    let free = [FilmModulus, TipRounding, FrameCompliance];
    recover("depth", &both[..1], (0.01, true), &free[..1], &definition);
    recover("reference", &both, (0.005, false), &free, &definition);
}

/// A stack of one layer gives the fit of the film, for each kind.
#[test]
fn a_stack_of_one_layer_is_a_film() {
    let system = oxide();
    let one = layer("oxide", system.film, system.film_thickness);
    let name = modulus_of("oxide");
    for kind in [
        Kind::StiffnessRadius,
        Kind::StiffnessLoad,
        Kind::StiffnessDepth,
    ] {
        let (range, thinning) = match kind {
            Kind::StiffnessRadius => ([1e-7, 1e-6], 0.0),
            Kind::StiffnessLoad => ([3e-4, 2e-2], 0.0),
            _ => ([5e-8, 3e-7], 0.3),
        };
        let abscissae = measurement_at(kind, evenly(range, 12));
        let mut plan = Experiment::new(abscissae, Bodies::coated(&system));
        plan.indentation.hardness = Some(1e10);
        plan.indentation.thinning = thinning;
        let table = Table::embedded();
        let made = simulate(table, &plan, 0.01, 5).expect("a contact");
        let mut stack = made.clone();
        stack.bodies = on_layers(&system, &[one]);
        let fitted = |experiment: &Experiment, parameter| {
            let found = fitted(experiment.clone(), [parameter]);
            found.expect("sound data").estimates.remove(0)
        };
        let film = fitted(&made, Parameter::FilmModulus);
        let stack = fitted(&stack, name);
        let apart = (film.value - stack.value).abs() / film.standard_error;
        assert!(apart < 2e-3, "{kind:?}: {film:?} {stack:?}");
        let errors = film.standard_error / stack.standard_error - 1.0;
        assert!(errors.abs() < 2e-3, "{kind:?}: {film:?} {stack:?}");
    }
}

/// A top layer that is thinner under the tip, between the thicknesses that are solved, against a
/// solve of each thickness.
#[test]
fn a_thinned_top_layer_is_the_stack_of_that_thickness() {
    let system = oxide();
    let stack = |top: f64| {
        let titanium = layer("titanium", solid(1.2e11, 0.34), 3e-7);
        let gold = layer("gold", solid(8e10, 0.42), top);
        on_layers(&system, &[titanium, gold])
    };
    let thickness = 2e-7;
    let known = Indentation {
        thinning: 0.5,
        hardness: Some(2e9),
        ..Indentation::NEW
    };
    let depths = measurement_at(Kind::StiffnessDepth, evenly([2e-8, 2e-7], 6));
    let mut plan = Experiment::new(depths, stack(thickness));
    plan.indentation = known;
    let made = simulate(Table::embedded(), &plan, 0.0, 0).expect("a contact");
    let mut worst: f64 = 0.0;
    for (point, load) in made.measurement.points.iter().zip(&made.indentation.loads) {
        let contact_depth = point.abscissa - 0.75 * load / point.ordinate;
        let a = contact_depth * (24.56 / PI).sqrt();
        let alone = stack(thickness - 0.5 * contact_depth);
        let alone = Experiment::new(measurement_at(Kind::StiffnessRadius, [a]), alone);
        let direct = simulate(Table::embedded(), &alone, 0.0, 0).expect("a contact");
        let direct = direct.measurement.points[0].ordinate;
        worst = larger(worst, (point.ordinate / direct - 1.0).abs());
    }
    assert!(worst < 1e-6, "{worst:e}");
}

/// Metals: the definition of the contact depth moves the modulus, and the contact is plastic.
#[test]
fn doubts_of_metals_are_named() {
    let system = System {
        film: solid(7e10, 0.35),
        ..oxide()
    };
    let contact = solved(&system, [8e-8, 2e-6]);
    let known = Indentation::NEW;
    let mut metal = at_depths(Bodies::coated(&system), &contact, &known, 8e8);
    metal.noise = Some(0.01);
    let found = fitted(metal.clone(), [Parameter::FilmModulus]).expect("sound data");
    let words = "oliver-pharr; loubet; plastic; pile up; film-modulus";
    assert_warns(&found, WarningKind::ContactDepth, words);
    assert_silent(&found, WarningKind::DeepContact);
    // Twice as deep as the film's half.
    let mut thin = metal;
    thin.set(Parameter::FilmThickness, 1e-7).expect("a film");
    let found = fitted(thin, [Parameter::FilmModulus]).expect("sound data");
    assert_warned(&found, WarningKind::DeepContact);
}

/// Standard deviations of the points are those of the stiffness, N/m.
#[test]
fn standard_deviations_of_points_are_in_newtons_per_metre() {
    let exact = at_radii(&oxide(), [1e-7, 1e-6], 20);
    let found = |change: &dyn Fn(&mut Experiment)| {
        let mut made = noisy(&exact, 0.01, 3);
        change(&mut made);
        fitted(made, [Parameter::FilmModulus]).expect("sound data")
    };
    let relative = found(&|one| one.noise = Some(0.01));
    let absolute = found(&|one| {
        let points = one.measurement.points.iter();
        one.errors = PointErrors {
            abscissa: Vec::new(),
            ordinate: points.map(|point| 0.01 * point.ordinate).collect(),
        };
    });
    let [one, other] = [&relative, &absolute].map(|fit| &fit.estimates[0]);
    assert_close(one.value, other.value, 1e-9);
    assert_close(one.standard_error, other.standard_error, 1e-6);
    let point = &relative.experiments[0].points[0];
    let error = point.deviation / point.ordinate - 0.01;
    assert!(error.abs() < 1e-12, "{point:?}");
}

/// Loubet's depth makes another contact from the same depth, and the half-space of the substrate
/// keeps its modulus under either where the data were made by it.
#[test]
fn loubets_depth_is_found_from_data_made_by_it() {
    let depths = measurement_at(Kind::StiffnessDepth, evenly([3e-8, 5e-7], 20));
    let mut plan = Experiment::new(depths, half_space(0.1, 1.1466e12, solid(1.7e11, 0.28)));
    plan.indentation = Indentation {
        contact_depth: ContactDepth::Loubet,
        hardness: Some(1e10),
        tip_rounding: 5e-9,
        frame_compliance: 1e-7,
        area: AreaFunction::new(&[24.5, 300.0, 50.0]).expect("allowed"),
        ..Indentation::NEW
    };
    let made = simulate(Table::embedded(), &plan, 0.0, 1).expect("a contact");
    let free = [Parameter::FilmModulus, Parameter::TipRounding];
    let found = fitted(made, free).expect("sound data");
    assert_close(found.estimates[0].value, 1.7e11, 1e-6);
    assert!((found.estimates[1].value - 5e-9).abs() < 1e-14, "{found:?}");
}

/// A stiffness that is read too high also makes the contact depth, and with it the fitted stiffness, too high.
#[test]
fn the_deviation_at_a_depth_is_that_of_the_difference_from_the_fit() {
    const NOISE: f64 = 0.01;
    const STEP: f64 = 1e-4;
    let system = oxide();
    let known = Indentation::NEW;
    let contact = solved(&system, [8e-8, 5e-7]);
    let mut made = at_depths(Bodies::coated(&system), &contact, &known, 1e10);
    made.noise = Some(NOISE);
    let found = fitted(made.clone(), [Parameter::FilmModulus]).expect("sound data");
    let points = &found.experiments[0].points;
    for (i, point) in points.iter().enumerate() {
        let difference = |by: f64| {
            let mut moved = made.clone();
            let read = &mut moved.measurement.points[i].ordinate;
            *read *= by.exp();
            let read = *read;
            let predictions = moved.predictions(Table::embedded(), None, &[]);
            (read / predictions.expect("sound").ordinates[i]).ln()
        };
        let factor = (difference(STEP) - difference(-STEP)) / (2.0 * STEP);
        assert!((0.1..0.95).contains(&factor), "{i}: {factor}");
        assert_close(point.deviation, factor * NOISE * point.ordinate, 1e-5);
    }
}
