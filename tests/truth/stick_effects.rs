//! What full friction does to a sphere: pull-off after three histories, the size of the effect, the
//! system of the paper, and what is refused.

use std::f64::consts::PI;

use acceptance::{assert_matches, material, paper_system, rigid_sphere, solved};
use contact::{Contact, Control, Hysteresis, Relaxation};
use interp::{Curve, Material, System};
use solve::Error;
use solve::stick::{StickCurves, Sticking};

use crate::stick::confined;

/// The system of the pull-offs: a rigid sphere on an incompressible film on a rigid base.
fn system() -> System {
    rigid_sphere(1.0, [0.75, 0.5], 1e-3, [f64::INFINITY, 0.0])
}

/// Pull-off loads over `pi w R` of the three histories, for `L = w R^2/(E1* t^3)`; the columns are
/// without friction, with one work of adhesion, and pressed on without attraction. By another
/// program.
const PULL_OFFS: [[f64; 4]; 5] = [
    [0.01, -1.5349, -1.5350, -1.5291],
    [0.1, -1.6883, -1.6883, -1.6434],
    [1.0, -1.9341, -1.8946, -1.8464],
    [10.0, -2.1445, -1.8938, -2.0597],
    [100.0, -2.3415, -1.6943, -2.2665],
];

#[test]
fn pull_offs_of_three_histories_agree() {
    let system = system();
    let of = system.material().expect("physical");
    let range = [1e-3, 20.0];
    let curves = StickCurves::new(&confined(), range, 1e-7).expect("converges");
    let contact = |curve: Curve| Contact::new(&system, curve).expect("its own curve");
    let contacts = [
        contact(solve::curve(&of, range, 1e-8).expect("converges")),
        contact(curves.receding(1.0).expect("a ratio")),
        contact(curves.receding(0.0).expect("a ratio")),
    ];
    for [l, expected @ ..] in PULL_OFFS {
        let w = l * system.film_thickness.powi(3);
        for (contact, expected) in contacts.iter().zip(expected) {
            let pull_off = contact.pull_off(w, Control::Load).expect("in range");
            let found = pull_off.load / (PI * w);
            assert!(
                (found - expected).abs() < 6e-5,
                "{l}: {found}, not {expected}"
            );
            // The slope of the force curve vanishes there; without adhesion it is that of the punch.
            let a = pull_off.contact_radius;
            let slope = |of: f64, w: f64| contact.moving_stiffness(of * a, w).expect("in range");
            let punch = contact.stiffness(a).expect("in range");
            let found = [slope(1.0, w), slope(1.0, 0.0) - punch].map(|slope| slope / punch);
            assert!(
                found[0].abs() < 1e-4 && found[1].abs() < 1e-5,
                "{l}: {found:?}"
            );
            assert!(slope(0.99, w) < 0.0 && slope(1.01, w) > 0.0, "{l}");
        }
    }
}

/// Load with stick over load without at equal penetration, without attraction, and the ratio of the
/// stiffnesses of the punch, at the `a/t` of the contact with stick. By another program.
const RATIOS: [[f64; 3]; 6] = [
    [0.3, 1.0008, 1.0015],
    [1.0, 1.058, 1.086],
    [2.0, 1.294, 1.366],
    [3.0, 1.570, 1.659],
    [5.0, 2.040, 2.126],
    [10.0, 2.730, 2.781],
];

#[test]
fn the_size_of_friction_agrees() {
    let film = confined();
    let of = system().material().expect("physical");
    let curves = StickCurves::new(&film, [1e-2, 12.0], 1e-6).expect("converges");
    for [x, of_load, of_punch] in RATIOS {
        let ratio = film.stiffening(x, 1e-6).expect("converges");
        assert!((ratio / of_punch - 1.0).abs() < 5e-4, "{x}: {ratio}");
        // The contact without friction that is as deep.
        let at = curves.at(x).expect("inside");
        let without = |x: f64| solved(x, &of, 1e-9);
        let (mut low, mut high) = (0.8 * x, 2.0 * x);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if middle * middle * without(middle).delta0 < x * x * at.delta_s {
                low = middle;
            } else {
                high = middle;
            }
        }
        let ratio = x.powi(3) * at.pi_s / (low.powi(3) * without(low).pi0);
        assert!((ratio / of_load - 1.0).abs() < 5e-4, "{x}: {ratio}");
    }
}

/// The paper's system: the change of `Eeq` and `Pi0` by full friction (%) at some `a/t`, by another
/// program. The deviations of 10 % of measured moduli have another reason.
const PAPER: [[f64; 3]; 4] = [
    [0.3, 0.01, 0.001],
    [1.0, 0.21, 0.16],
    [3.0, 0.11, 0.35],
    [10.0, 0.03, 0.08],
];

#[test]
fn full_friction_does_not_explain_the_deviations_of_the_paper() {
    let of = material([1.75, 0.5, 1e5, 0.25]);
    let film = Sticking::on_film(&of, 0.5).expect("physical");
    for [x, of_stiffness, of_load] in PAPER {
        let known = solved(x, &of, 1e-9);
        let (tip, _) = film.tip(x, 2.0, 1e-8).expect("converges");
        let stiffness = 1e2 * (tip.eeq_s / known.eeq - 1.0);
        let load = 1e2 * (tip.pi_s / known.pi0 - 1.0);
        assert!((stiffness - of_stiffness).abs() < 0.006, "{x}: {stiffness}");
        assert!((load - of_load).abs() < 0.006, "{x}: {load}");
    }
    // Over films of 0.3 to 300 um under the contact of 65.6 um of the paper's lens.
    for i in 0..13 {
        let x = 65.6 / (0.3 * 1e3_f64.powf(f64::from(i) / 12.0));
        let change = 1e2 * (film.stiffening(x, 1e-6).expect("converges") - 1.0);
        assert!((0.0..0.3).contains(&change), "{x}: {change}");
    }
    // The pull-off of this lens, of 1 mm and 0.04 J/m^2, where it is solved: the adhesion that is lower
    // by 25 % on films below 3 um has another reason, too.
    let range = [1e-2, 30.0];
    let curves = [
        StickCurves::new(&film, range, 1e-8).and_then(|curves| curves.receding(1.0)),
        solve::curve(&of, range, 1e-8),
    ];
    let curves = curves.map(|curve| curve.expect("converges"));
    let mut change = 0.0_f64;
    for i in 0..13 {
        let system = paper_system(2e-6 * 150_f64.powf(f64::from(i) / 12.0));
        let [stick, slide] = curves.each_ref().map(|curve| {
            let contact = Contact::new(&system, curve.clone()).expect("its own curve");
            let pull_off = contact.pull_off(0.04, Control::Load);
            pull_off.expect("in range").load
        });
        change = change.max((1e2 * (stick / slide - 1.0)).abs());
    }
    println!("the pull-off load changes by {change:.2} %");
    assert!((0.5..0.7).contains(&change), "{change}");
}

/// Griffith: where the line recedes, both stresses at its edge have the energy of its work of adhesion.
/// That at which the line grew has left its normal stress there; the pull adds both.
#[test]
fn a_receding_line_has_the_energy_of_both_stresses() {
    let curves = StickCurves::new(&confined(), [0.1, 10.0], 1e-8).expect("converges");
    for ratio in [0.0, 0.3, 0.8, 1.0] {
        let curve = curves.receding(ratio).expect("a ratio");
        for x in [0.1, 1.0, 10.0] {
            let (grown, gamma) = (
                curves.at(x).expect("in range"),
                curve.quantities(x).expect("in range").gamma,
            );
            let left = ratio.sqrt();
            let pull = 1.0 / gamma - left / grown.gamma_g;
            let energy = (left + pull * grown.gamma_s).hypot(pull * grown.gamma_t);
            assert!((energy - 1.0).abs() < 1e-7, "{ratio}, {x}: {energy}");
        }
    }
}

/// A sphere that sticks to a film which relaxes is pressed on without adhesion and pulled off with it. The loads are those of
/// another program, which marches the stuck contact from radius to radius and adds up Ting's integrals. The line recedes where
/// both stresses at its edge have the energy of the work of adhesion, with whatever ratio the curve was made.
#[test]
fn a_stuck_contact_that_relaxes_recedes_with_both_stresses() {
    let system = rigid_sphere(1e-4, [1e5, 0.5], 1e-5, [f64::INFINITY, 0.0]);
    let curves = StickCurves::new(&confined(), [1e-3, 2.2], 1e-8).expect("converges");
    let law = Relaxation::Prony {
        relaxed: 0.3,
        terms: vec![[0.7, 0.2]],
    };
    let program = [(0.0, 0.0), (1.0, 1e-6), (2.0, -1e-6)];
    let times = [1.0, 1.1, 1.2, 1.3, 1.4];
    let loads = [
        5.74152e-6,
        3.56521e-7,
        -1.664586e-6,
        -1.546997e-6,
        -9.84592e-7,
    ];
    for ratio in [0.0, 0.5, 1.0] {
        let curve = curves.receding(ratio).expect("a ratio");
        let contact = Contact::new(&system, curve).expect("its own curve");
        let history = contact.history(&law).expect("a law");
        let line = Hysteresis::new(0.0, 1e-3).expect("a law");
        let history = history.receding(line).expect("no growing adhesion");
        let course = history.at(Control::Displacement, &program, &times, None);
        let states = course.expect("in range").states;
        assert_eq!(states.len(), loads.len());
        for (at, load) in states.iter().zip(loads) {
            let found = at.state.load;
            let error = (found - load).abs() / loads[0];
            assert!(error < 1e-6, "{ratio}: {found} at {}, not {load}", at.time);
        }
    }
}

/// What is not solved is refused with the reason.
#[test]
fn what_is_not_solved_is_refused() {
    let of = Material::new(0.0, 0.3, f64::INFINITY, 0.25).expect("physical");
    let film = Sticking::on_film(&of, 0.5).expect("physical");
    let error = film.tip(1.0, 2.0, 1e-6).expect_err("beta is not 0");
    let Error::Coupled { beta, factor, .. } = error else {
        panic!("{error}");
    };
    assert!((beta - 2.0 / 7.0).abs() < 1e-15);
    assert!((factor - 1.0286).abs() < 1e-4, "{factor}");
    assert!(
        error.to_string().contains("artanh(beta)/beta = 1.0286"),
        "{error}"
    );
    // A film that is nearly incompressible is not taken for an incompressible one.
    let nearly = Material::new(0.0, 0.49, f64::INFINITY, 0.25).expect("physical");
    let nearly = Sticking::on_film(&nearly, 0.5).expect("physical");
    assert_matches!(nearly.tip(1.0, 2.0, 1e-6), Err(Error::Coupled { .. }));
    let curves = StickCurves::new(&confined(), [0.1, 1.0], 1e-6).expect("converges");
    let error = curves.receding(1.5).expect_err("more than one");
    assert!(error.to_string().contains("1.5"), "{error}");
    assert!(Sticking::on_film(&of, 0.6).is_err());
    assert!(confined().tip(31.0, 2.0, 1e-6).is_err());
}
