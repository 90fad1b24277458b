//! Equilibria beyond what a curve or a table holds.

use acceptance::{
    Refused, assert_matches, larger, looked_up, paper_system, relative, rigid_probe, solid, table,
};
use contact::{Contact, Control, Error, State};
use interp::{Probe, System, Table};

use crate::equilibria::CONTROLS;

/// Returns a table that begins at an `a/t` of 1.
pub fn thin_films() -> Table {
    table(
        "
        title      = 'Thin films'
        tolerance  = 1e-4
        a_over_t   = { from = 1, to = 10 }
        e1_over_e2 = 1.75
        nu1        = 0.5
        e0_over_e2 = 1e5
    ",
    )
}

#[test]
fn a_state_out_of_range_is_an_error_with_the_radii() {
    let contact_on = |t: f64| looked_up(&paper_system(t));
    let w = 0.04;
    // A film so thin that the table ends before the pull-off radius; one so thick that a table
    // begins beyond it, and with too large an a/t for the expansion.
    let thick = thin_films();
    let wide = System {
        probe: Probe::Paraboloid { radius: 1.0 },
        ..paper_system(1e-2)
    };
    for contact in [
        contact_on(1e-9),
        Contact::in_table(&thick, &wide).expect("in the table"),
    ] {
        let [from, to] = contact.contact_radius_range();
        let smallest = if from == 0.0 { 1e-60 } else { from };
        let assert_outside = |result: Result<State, Error>| match result {
            Err(
                error @ Error::OutsideRadii {
                    from: least,
                    to: most,
                    ..
                },
            ) => {
                assert_eq!([least, most], [smallest, to]);
                acceptance::assert_names(&error.to_string(), &format!("{smallest:?}; {to:?}"));
            }
            other => panic!("{other:?}"),
        };
        assert_outside(contact.zero_load(w));
        for control in CONTROLS {
            assert_outside(contact.pull_off(w, control));
            let equilibria = contact.equilibria(w, control).expect("physical");
            assert_outside(equilibria.loading(0.0));
            assert_outside(equilibria.unloading(-1e-6));
            assert_outside(equilibria.at(1e30).map(|found| found[0].state));
            let curve = equilibria.force_displacement(1e-6, 3);
            assert!(matches!(curve, Err(Error::OutsideRadii { .. })));
        }
    }
    let contact = contact_on(1e-5);
    let equilibria = contact.equilibria(w, Control::Load).expect("physical");
    let least = equilibria.pull_off().expect("in range").load;
    let Err(
        error @ Error::NoContact {
            name: "load",
            least: found,
            ..
        },
    ) = equilibria.unloading(1.01 * least)
    else {
        panic!("apart")
    };
    assert_eq!(found, least);
    let words = format!("load; {:?}; {least:?}", 1.01 * least);
    acceptance::assert_names(&error.to_string(), &words);
    let apart = equilibria.loading(-1e-9);
    assert!(matches!(apart, Err(Error::NoContact { least: 0.0, .. })));
    for points in [0, 1, 1_000_001, usize::MAX] {
        let curve = equilibria.force_displacement(1e-4, points);
        curve.refused("number of points");
    }
}

#[test]
fn without_adhesion_a_table_needs_no_stiffness() {
    let table = table(
        "
        title      = 'No adhesion'
        tolerance  = 1e-4
        quantities = ['pi0', 'delta0']
        a_over_t   = { from = 0.1, to = 10 }
        e1_over_e2 = 1.75
        nu1        = 0.5
        e0_over_e2 = 1e5
    ",
    );
    let contact = Contact::in_table(&table, &paper_system(1e-5)).expect("in the table");
    let embedded = looked_up(&paper_system(1e-5));
    let mut worst = 0.0;
    for control in CONTROLS {
        let (load, penetration) = embedded.load_and_penetration(2e-5, 0.0).expect("in range");
        let at = control.imposed(load, penetration);
        let equilibria = contact.equilibria(0.0, control);
        let equilibria = equilibria.expect("nothing else is needed");
        let found = equilibria.unloading(at).expect("in range");
        worst = larger(worst, relative(found.contact_radius, 2e-5));
        assert_eq!(equilibria.pull_off().expect("the origin"), State::ORIGIN);
        let missing = contact.equilibria(0.04, control);
        missing.map(drop).refused("the table does not hold");
        // Before the curve begins.
        let before = equilibria.unloading(1e-6 * at);
        assert!(matches!(before, Err(Error::OutsideRadii { .. })));
        let apart = equilibria.unloading(-at);
        assert!(matches!(apart, Err(Error::NoContact { least: 0.0, .. })));
    }
    println!("radii without adhesion: {worst:.1e}");
    // Measured: 1.6e-6.
    assert!(worst <= 1e-4);
}

/// A cone goes on for ever: what ends is the table.
#[test]
fn beyond_the_largest_cone_another_table_helps() {
    let cone = Probe::Cone { half_angle: 1.2 };
    let system = rigid_probe(cone, solid(1e6, 0.3), 1e-6, solid(1e9, 0.3));
    let equilibria = looked_up(&system)
        .equilibria(0.0, Control::Load)
        .map(|all| all.unloading(1e6).map(drop));
    let found = equilibria.expect("in range");
    assert_matches!(found, Err(Error::OutsideRadii { at_end_of_probe, .. }) if !at_end_of_probe);
}
