//! The results printed in the paper, JKR as its homogeneous case, and changes of units.

use std::f64::consts::PI;
use std::sync::LazyLock;

use acceptance::{Contacts, larger, paper_system, shipped, solid, solved};
use contact::{Contact, Control, JkrPoint};
use interp::{System, Table};

/// Work of adhesion of the paper's Table 1, J/m^2.
const W: f64 = 0.04;

static TABLE: LazyLock<Table> =
    LazyLock::new(|| Table::read(shipped("paper.bin")).expect("a sound table"));

fn contact(film_thickness: f64) -> Contact {
    Contact::in_table(&TABLE, &paper_system(film_thickness)).expect("the table is the paper's")
}

/// Returns the place of the only minimum of `f` between `low` and `high`, by golden section.
fn minimum(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..80 {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if f(left) < f(right) {
            high = right
        } else {
            low = left
        }
    }
    0.5 * (low + high)
}

/// Returns the loads at pull-off under load control, where the load is least, and under
/// displacement control, where the penetration is.
fn pull_off(unit: f64, load_and_penetration: impl Fn(f64) -> (f64, f64)) -> [f64; 2] {
    let (from, to) = (0.02 * unit, 2.0 * unit);
    // On a coarse grid first: the golden section needs a single minimum.
    let least = |f: &dyn Fn(f64) -> f64| {
        let at = |i: usize| from + (to - from) * i as f64 / 400.0;
        let best = (0..=400)
            .min_by(|&i, &j| f(at(i)).total_cmp(&f(at(j))))
            .expect("a grid");
        assert!(best > 0 && best < 400, "the minimum is inside");
        minimum(at(best - 1), at(best + 1), f)
    };
    [
        least(&|a| load_and_penetration(a).0),
        least(&|a| load_and_penetration(a).1),
    ]
    .map(|a| load_and_penetration(a).0)
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
fn the_compound_modulus_is_0_7() {
    let es = paper_system(1e-6)
        .material()
        .expect("physical")
        .sphere_film_modulus();
    assert!((es - 0.7).abs() <= f64::EPSILON, "{es}");
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
        println!(
            "line on {t:e} m: E/E2* = {:.4}, w/w0 = {:.4}",
            found[0], found[1]
        );
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
    /// Difference between the table and direct solves, whose least penetration is found by golden
    /// section. Measured: 1.9e-8.
    const DIRECT: f64 = 2e-7;
    let expected = [
        (1e-6, [-1.5038, -0.8343], -0.83422),
        (10e-6, [-1.5401, -0.8402], -0.84024),
        (30e-6, [-1.5775, -0.7564], -0.75643),
        (100e-6, [-1.5233, -0.7478], -0.74782),
    ];
    for (t, expected, displacement) in expected {
        let (system, contact) = (paper_system(t), contact(t));
        let (material, mechanics) = (system.material().expect("physical"), contact.mechanics());
        let direct = |a: f64| {
            let edge = mechanics.edge_singularity(a, W).expect("physical");
            mechanics.load_and_penetration(a, edge, &solved(a / t, &material, 1e-10))
        };
        let solved = pull_off(66e-6, direct);
        for (i, control) in [Control::Load, Control::Displacement]
            .into_iter()
            .enumerate()
        {
            let unit = PI * W * system.probe.radius().expect("a paraboloid");
            let (found, solved) = (
                contact.pull_off(W, control).expect("inside").load / unit,
                solved[i] / unit,
            );
            println!(
                "pull-off on {t:e} m: {found:.8} pi w R, direct {:.1e}, printed {:.1e} away",
                found - solved,
                found - expected[i]
            );
            assert!((found - solved).abs() <= DIRECT);
            assert!((found - expected[i]).abs() <= if i == 0 { PRINTED } else { GRID });
            // The least penetration itself, to five digits: a regression value, that of the direct
            // solves.
            assert!(i == 0 || (found - displacement).abs() <= 0.5e-5, "{found}");
        }
    }
}

#[test]
fn the_load_is_eq_9_in_its_reduced_form() {
    /// Relative to the larger of the two terms. Measured: 8.4e-16.
    const EXACT: f64 = 2e-14;
    let mut worst = 0.0;
    let mut contacts = Contacts::new(61);
    for _ in 0..1000 {
        let film = solid(contacts.log_uniform(3e4, 1e8), 0.5);
        let system = System {
            film,
            ..paper_system(contacts.log_uniform(1e-7, 5e-6))
        };
        let contact = Contact::in_table(&TABLE, &system).expect("inside");
        let a = contacts.log_uniform(1e-2, 1e2) * system.film_thickness;
        let w = contacts.log_uniform(1e-3, 1.0);
        let point = JkrPoint::new(
            a,
            contact.load(a, w).expect("inside"),
            contact.mechanics().sphere_radius(),
        );
        let [pi0, eeq, gamma, _] = contact.quantities(a).expect("inside").to_array();
        let e = system.sphere_modulus;
        let es = 1.0 / (1.0 / e + 0.75 / film.young());
        let (first, second) = (
            e / (2.0 * 6.0_f64.sqrt()) * point.abscissa * pi0,
            (4.0 * w * es / 3.0).sqrt() * eeq / gamma,
        );
        worst = larger(
            worst,
            (point.ordinate - (first - second)).abs() / first.max(second),
        );
    }
    println!("eq. 9: largest deviation {worst:.1e}");
    assert!(worst <= EXACT);
}

#[test]
fn the_stiffness_is_2_a_modulus_eeq() {
    let contact = contact(10e-6);
    for a in [1e-6, 1e-5, 1e-4] {
        let eeq = contact.quantities(a).expect("inside").eeq;
        let stiffness = contact.stiffness(a).expect("inside");
        assert!((stiffness / (2.0 * a * 2e6 * eeq) - 1.0).abs() <= 4.0 * f64::EPSILON);
    }
}
