//! What is refused of contacts in time, and what is answered at the ends of the range.

use acceptance::{assert_names, rigid_probe, solid, solved_contact};
use contact::{Control, HistoryError, Hysteresis, RateDependent, Relaxation};
use interp::{Probe, System};

use super::{CYCLES, PARABOLOID, half_space, solid_law};

/// The bound for bodies that do not relax, on both sides of the largest that is accepted.
#[test]
fn bodies_that_do_not_relax() {
    let of = |substrate: f64| {
        rigid_probe(
            Probe::Paraboloid { radius: 1e-5 },
            solid(1e3, 0.5),
            1e-5,
            solid(substrate, 0.5),
        )
    };
    let contact = |substrate: f64| {
        let system = of(substrate);
        solved_contact(&system, [1e-4, 2.0], 1e-9)
    };
    let rigid = contact(f64::INFINITY);
    let law = solid_law();
    let program = [(0.0, 0.0), (1.0, 1e-6), (2.0, 0.0)];
    let run = |substrate: f64| {
        let own = contact(substrate);
        let history = own.history(&law).expect("a law").beside(&rigid);
        history
            .run(Control::Displacement, &program, None)
            .map(|course| course.unlike_bodies)
    };
    let [soft, stiff] = [1e5, 1e7].map(|substrate| run(substrate).expect("a course"));
    // The rise of the load is inversely proportional to the modulus of the base.
    assert!(
        soft > 1e-4 && soft < 2e-2 && (soft / stiff / 100.0 - 1.0).abs() < 0.05,
        "{soft} {stiff}"
    );
    let refused = run(3e3).expect_err("too soft a base");
    assert!(
        matches!(refused, HistoryError::UnlikeBodies { .. }),
        "{refused}"
    );
    assert_names(&refused.to_string(), &["do not relax", "2e-2", "rigid"]);
    let own = contact(1e5);
    for other in [
        &own,
        &half_space(PARABOLOID),
        &solved_contact(
            &System {
                film_thickness: 2e-5,
                ..of(f64::INFINITY)
            },
            [1e-4, 1.0],
            1e-9,
        ),
    ] {
        let history = own.history(&law).expect("a law").beside(other);
        let refused = history.run(Control::Displacement, &program, None);
        let refused = refused.expect_err("other bodies").to_string();
        assert_names(&refused, &["same film, thickness and probe", "rigid base"]);
    }
}

/// Each mistake has an error that says what to do.
#[test]
fn mistakes() {
    let contact = half_space(PARABOLOID);
    let law = solid_law();
    let history = contact.history(&law).expect("a law");
    let refuse = |control, program: &[(f64, f64)], times: &[f64], tolerance, names: &[&str]| {
        let error = history
            .at(control, program, times, tolerance)
            .expect_err("a mistake");
        assert_names(&error.to_string(), names);
    };
    let up = [(0.0, 0.0), (1.0, 1e-3)];
    let depth = Control::Displacement;
    refuse(depth, &up[..1], &[], None, &["two points", "1"]);
    refuse(
        depth,
        &[up[1], up[0]],
        &[],
        None,
        &["point 2", "times", "rise"],
    );
    refuse(
        depth,
        &[up[0], (0.0, 1e-3)],
        &[],
        None,
        &["point 2", "close together"],
    );
    refuse(
        depth,
        &[up[0], (f64::NAN, 1e-3)],
        &[],
        None,
        &["point 2", "finite"],
    );
    refuse(
        depth,
        &[(0.0, 1e-4), up[1]],
        &[],
        None,
        &["begins in contact", "0.0001", "not known"],
    );
    refuse(depth, &up, &[-1.0], None, &["-1.0", "begins at 0.0"]);
    refuse(depth, &up, &[f64::INFINITY], None, &["inf", "finite"]);
    refuse(depth, &up, &[0.5], Some(1e-12), &["1e-12", "1e-10"]);
    refuse(
        Control::Spring { stiffness: 0.0 },
        &up,
        &[0.5],
        None,
        &["stiffness"],
    );
    let laws = [
        (
            Relaxation::PowerLaw {
                exponent: 1.0,
                time: 1.0,
            },
            "below 1",
        ),
        (
            Relaxation::PowerLaw {
                exponent: 0.5,
                time: 0.0,
            },
            "relaxation time",
        ),
        (
            Relaxation::Prony {
                relaxed: 0.3,
                terms: vec![[0.6, 1.0]],
            },
            "sum",
        ),
        (
            Relaxation::Prony {
                relaxed: -0.1,
                terms: vec![[1.1, 1.0]],
            },
            "relaxed fraction",
        ),
        (
            Relaxation::ModifiedPowerLaw {
                relaxed: 0.1,
                exponent: f64::NAN,
                time: 1.0,
            },
            "exponent",
        ),
        (
            Relaxation::FractionalZener {
                relaxed: 0.1,
                exponent: 1e-4,
                time: 1.0,
            },
            "0.001",
        ),
    ];
    for (law, name) in laws {
        let error = contact.history(&law).expect_err("no solid");
        assert_names(&error.to_string(), &[name]);
    }
    let punch = half_space(Probe::FlatPunch { radius: 1.0 });
    assert_names(
        &punch.history(&law).expect_err("a punch").to_string(),
        &["punch"],
    );
    let growing = contact
        .history(&law)
        .expect("a law")
        .receding(1e-4)
        .expect_err("growing adhesion");
    assert_names(&growing.to_string(), &["0.0001", "Hysteresis", "no law"]);
    let slow = Hysteresis::new(0.0, 1e-4).expect("a law");
    let rate = RateDependent::new(slow, 1e-6, 0.6).expect("a law");
    let history = contact.history(&law).expect("a law");
    let fast = history.receding(rate).expect_err("a speed").to_string();
    assert_names(&fast, &["speed", "Hysteresis"]);
    let adhesive = contact.history(&law).expect("a law");
    let adhesive = adhesive
        .receding(Hysteresis::new(0.0, 1e-6).expect("a law"))
        .expect("receding alone");
    for (control, program) in [(Control::Load, &up[..]), (depth, &CYCLES[..])] {
        let error = adhesive
            .at(control, program, &[0.5], None)
            .expect_err("not served");
        assert!(
            matches!(error, HistoryError::AdhesiveProgram { .. }),
            "{error}"
        );
    }
}

/// Two instants that nothing tells apart ask for no more exponentials than others do.
#[test]
fn instants_at_any_distance_are_answered() {
    let contact = half_space(Probe::Paraboloid { radius: 1.0 });
    let law = Relaxation::FractionalZener {
        relaxed: 0.1,
        exponent: 0.5,
        time: 1.0,
    };
    let history = contact.history(&law).expect("a law");
    let program = [(0.0, 0.0), (1.0, 1e-3), (1.0_f64.next_up(), 1e-3)];
    for first in [1e-49, 1e-300, 5e-324] {
        let found = history.at(Control::Displacement, &program, &[first, 1.0], Some(1e-2));
        match found {
            Ok(course) => assert_eq!(course.states.len(), 2),
            Err(error) => assert_names(&error.to_string(), &["time"]),
        }
    }
}
