//! The results printed in the paper, JKR as its homogeneous case, and changes of units.

use std::f64::consts::PI;
use std::sync::LazyLock;

use acceptance::{paper_system, shipped, solved_contact};
use contact::{Contact, Control};
use interp::Table;

/// Work of adhesion of the paper's Table 1, J/m^2.
const W: f64 = 0.04;

static TABLE: LazyLock<Table> =
    LazyLock::new(|| Table::read(shipped("paper.bin")).expect("a sound table"));

fn contact(film_thickness: f64) -> Contact {
    Contact::in_table(&TABLE, &paper_system(film_thickness)).expect("the table is the paper's")
}

/// Asserts that `value`, rounded to `digits` decimals, is the printed one.
fn assert_rounds_to(value: f64, printed: f64, digits: i32) {
    let unit = 10.0_f64.powi(-digits);
    assert!(
        (value - printed).abs() <= 0.5 * unit * (1.0 + 1e-9),
        "{value} does not round to {printed}"
    );
}

#[test]
fn the_zero_load_radii_are_the_papers() {
    let no_film = Contact::half_space(&paper_system(1e-6).without_film()).expect("physical");
    let contacts = [(1e-6, 65.77, 2), (10e-6, 67.06, 2), (100e-6, 73.5, 1)]
        .map(|(t, printed, digits)| (contact(t), printed, digits));
    for (contact, printed, digits) in [(no_film, 65.63, 2)].into_iter().chain(contacts) {
        let radius = contact.zero_load(W).expect("inside").contact_radius;
        println!("zero-load radius {:.3} um", radius * 1e6);
        assert_rounds_to(radius * 1e6, printed, digits);
    }
}

#[test]
fn a_line_through_the_jkr_plot_gives_the_papers_modulus_and_work_of_adhesion() {
    let (system, no_film) = (paper_system(1e-6), 65.63e-6);
    for (t, modulus, work) in [
        (1e-6, 0.998, 1.002),
        (3e-6, 0.994, 1.006),
        (10e-6, 0.981, 1.020),
        (100e-6, 0.786, 0.838),
    ] {
        let bias = contact(t)
            .film_bias(W, [0.6 * no_film, 2.0 * no_film], 15)
            .expect("inside");
        // The paper reads the intercept with the sphere's modulus; that of sphere and substrate is
        // 1e-5 less.
        let found = [
            bias.fit.modulus / system.sphere_modulus,
            bias.fit.work_of_adhesion_with(system.sphere_modulus) / W,
        ];
        println!("{t:e} {:.4} {:.4}", found[0], found[1]);
        assert_rounds_to(found[0], modulus, 3);
        assert_rounds_to(found[1], work, 3);
        let known = [bias.modulus, bias.work_of_adhesion_at_known_modulus].map(|bias| 1.0 + bias);
        assert!(
            known
                .iter()
                .zip(found)
                .all(|(known, found)| (known / found - 1.0).abs() < 2e-5),
            "{known:?}"
        );
        // Its finding: less than 3 % up to 10 um.
        let verdict = [bias.modulus, bias.work_of_adhesion_at_known_modulus]
            .into_iter()
            .any(|bias| bias.abs() > 0.03);
        assert_eq!(verdict, t > 10e-6);
    }
}

#[test]
fn the_pull_off_loads_of_the_papers_system() {
    /// Two independent scripts printed the values. Half of the last digit, and 3e-7 more, because
    /// -1.50374973 is printed as -1.5038.
    const PRINTED: f64 = 0.5e-4 + 3e-7;
    /// Under displacement control the scripts took the radius of least penetration from a grid, and
    /// the load is not stationary there. Measured: 8.1e-5.
    const GRID: f64 = 1e-4;
    for (t, expected) in [
        (1e-6, [-1.5038, -0.8343]),
        (10e-6, [-1.5401, -0.8402]),
        (30e-6, [-1.5775, -0.7564]),
        (100e-6, [-1.5233, -0.7478]),
    ] {
        let system = paper_system(t);
        let unit = PI * W * system.probe.radius().expect("a paraboloid");
        let contacts = [contact(t), solved_contact(&system, [1e-2, 1e3], 1e-9)];
        for (i, control) in [Control::Load, Control::Displacement]
            .into_iter()
            .enumerate()
        {
            let [found, solved] = contacts
                .each_ref()
                .map(|contact| contact.pull_off(W, control).expect("inside").load / unit);
            println!(
                "pull-off on {t:e} m: {found:.8} pi w R, direct {:.1e}, printed {:.1e} away",
                found - solved,
                found - expected[i]
            );
            assert!((found - solved).abs() <= 2e-7);
            assert!((found - expected[i]).abs() <= if i == 0 { PRINTED } else { GRID });
        }
    }
}
