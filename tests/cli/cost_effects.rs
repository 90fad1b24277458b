//! `tabulate cost effects`: the errors of the load without an effect, against loads in SI units,
//! closed forms and limits; and its rows, against `generate`.

use std::f64::consts::PI;

use acceptance::{Contacts, assert_near, half_space_of, layer, material, solid, with_interfaces};
use contact::Contact;
use cost::effects::{A_OVER_R, EXPONENT, Effect, STRENGTHS, TABOR, errors};
use interp::{Material, Probe};
use solve::solve_stack;
use solve::stack::Interface;

use crate::solved;

/// Radius of the sphere (m), and its modulus (Pa).
const RADIUS: f64 = 1e-3;

const MODULUS: f64 = 2e6;

/// Adhesionless load and load (N) by eq. 9, for a sphere of this modulus.
fn loads(a: f64, a_over_t: f64, material: &Material, modulus: f64, w: f64) -> [f64; 2] {
    let q = solved(a_over_t, material, 1e-10).quantities;
    let pressed = a.powi(3) * modulus * q.pi0 / (2.0 * RADIUS);
    let es = material.sphere_film_modulus();
    let adhesion = (8.0 * PI * w * es * modulus * a.powi(3)).sqrt() * q.eeq / q.gamma;
    [pressed, pressed - adhesion]
}

/// The error without an effect, over a substrate of the Poisson ratio 0.25.
fn error(effect: Effect, a_over_t: f64, [e1, nu1, e0]: [f64; 3], strength: f64) -> f64 {
    let scene = material([e1, nu1, e0, 0.25]);
    errors(&[effect], a_over_t, &scene, strength).expect("solved")[0]
}

/// A rigid sphere or substrate is one that is a million times stiffer. The bare substrate is JKR's.
#[test]
fn errors_are_those_of_the_loads_of_other_systems() {
    const RIGID: f64 = 1e6;
    let mut contacts = Contacts::new(61);
    for _ in 0..200 {
        let a_over_t = contacts.log_uniform(1e-2, 1e2);
        let e1 = contacts.log_uniform(0.1, 10.0);
        let e0 = contacts.log_uniform(1.0, 30.0);
        let nu1 = contacts.uniform(0.0, 0.49);
        let strength = contacts.log_uniform(STRENGTHS[0], STRENGTHS[1]);
        let scene = material([e1, nu1, e0, 0.25]);
        let a = 6e-5;
        let [pressed, stuck] = loads(a, a_over_t, &scene, MODULUS, 1.0);
        let w = (strength * pressed / (pressed - stuck)).powi(2);
        let [_, load] = loads(a, a_over_t, &scene, MODULUS, w);
        assert!(((pressed - load) / pressed / strength - 1.0).abs() < 1e-12);

        let solid = solid(e0 * MODULUS, 0.25);
        let bare = half_space_of(Probe::Paraboloid { radius: RADIUS }, MODULUS, solid);
        let load_of = |[e1, nu1, e0]: [f64; 3], modulus| {
            loads(a, a_over_t, &material([e1, nu1, e0, 0.25]), modulus, w)[1]
        };
        let others = [
            Contact::half_space(&bare)
                .and_then(|contact| contact.load(a, w))
                .expect("a contact"),
            load_of([e1 / RIGID, nu1, e0 / RIGID], RIGID * MODULUS),
            load_of([e1, nu1, RIGID * e0], MODULUS),
            load_of([e1, 0.5, e0], MODULUS),
            pressed,
            load,
        ];
        let effects = &Effect::ALL[..others.len()];
        let found =
            errors(effects, a_over_t, &scene, strength).expect("moderate contrasts converge");
        for ((&effect, found), other) in effects.iter().zip(found).zip(others) {
            let expected = ((other - load) / pressed).abs();
            // A substrate of thirty times the sphere's modulus is rigid to 1e-6 only.
            let allowed = 5e-5 * (other / pressed).abs().max(1.0);
            let is_near = (found - expected).abs() <= allowed;
            assert!(
                is_near,
                "{effect:?} at {a_over_t}: {found:e}, not {expected:e}"
            );
        }
    }
}

/// Loads under a rigid sphere are in units of the film's modulus.
#[test]
fn errors_under_a_rigid_sphere_are_the_limit_of_those_under_a_stiff_one() {
    let effects = [
        Effect::Film,
        Effect::SubstrateCompliance,
        Effect::FilmCompressibility,
        Effect::Adhesion,
    ];
    for (a_over_t, nu1, e0_over_e1) in [(0.1, 0.3, 3.0), (1.0, 0.1, 20.0), (10.0, 0.45, 30.0)] {
        let stiff = material([1e-6, nu1, 1e-6 * e0_over_e1, 0.25]);
        let rigid = material([0.0, nu1, e0_over_e1, 0.25]);
        let [stiff, rigid] = [stiff, rigid]
            .map(|material| errors(&effects, a_over_t, &material, 0.5).expect("solved"));
        for (effect, (stiff, rigid)) in effects.iter().zip(stiff.into_iter().zip(rigid)) {
            let is_near = (stiff - rigid).abs() <= 5e-5 * (1.0 + rigid);
            assert!(is_near, "{effect:?} at {a_over_t}: {stiff:e}, {rigid:e}");
        }
    }
}

#[test]
fn the_error_of_a_bonded_film_is_that_of_the_loads_of_both() {
    let (bonded, strength) = (material([1.75, 0.5, 1e5, 0.25]), 0.5);
    for a_over_t in [0.1, 1.0, 10.0] {
        let sliding = with_interfaces(
            solid(1e5, 0.25),
            &[(layer(1.75, 0.5, 1.0), Interface::Sliding)],
        );
        let slid = solve_stack(a_over_t, &sliding, 1.0, 1e-9).expect("within reach");
        let [slid, stuck] =
            [slid, solved(a_over_t, &bonded, 1e-9)].map(|solution| solution.quantities);
        let pressed = stuck.pi0 / slid.pi0 - 1.0;
        let adhesion = stuck.eeq / stuck.gamma / (slid.eeq / slid.gamma) - 1.0;
        let expected = (pressed - strength * adhesion).abs();
        let found = error(Effect::Interface, a_over_t, [1.75, 0.5, 1e5], strength);
        assert_near(found, expected, 1e-4 * expected);
    }
}

/// Returns the load of a paraboloid on a half-space that relaxes by a power law, at a time of a cycle that turns at 1, over
/// the elastic load at the turn: `b t^(b - alpha) B(t1/t; b, 1 - alpha)` with `b` = 3/2 (Ting 1966).
fn relaxing_load(time: f64) -> f64 {
    const STEPS: u32 = 20_000;
    let (b, c) = (1.5, 1.0 - EXPONENT);
    let touched = if time <= 1.0 {
        time
    } else {
        (time - 2.0_f64.powf(1.0 / c) * (time - 1.0)).max(0.0)
    };
    // The integral of u^(b-1) (1-u)^(c-1) over v = (1-u)^c, by the midpoint rule.
    let from = (1.0 - touched / time).powf(c);
    let step = (1.0 - from) / f64::from(STEPS);
    let values = (0..STEPS).map(|i| {
        let v = from + (f64::from(i) + 0.5) * step;
        (1.0 - v.powf(1.0 / c)).powf(b - 1.0)
    });
    b * time.powf(b - EXPONENT) * values.sum::<f64>() * step / c
}

/// On a thick film alone, the loads are JKR's on a half-space of film, and every error is a closed
/// form.
#[test]
fn a_thick_film_is_a_half_space() {
    for strength in STRENGTHS {
        let thick = material([0.5, 0.3, 40.0, 0.25]);
        let [film, sphere, substrate, compressibility] = [
            thick.sphere_substrate_modulus(),
            thick.film_modulus(),
            thick.sphere_film_modulus(),
            material([0.5, 0.5, 40.0, 0.25]).sphere_film_modulus(),
        ]
        .map(|modulus| {
            let ratio = modulus / thick.sphere_film_modulus();
            (ratio - 1.0 - strength * (ratio.sqrt() - 1.0)).abs()
        });
        // Sneddon's load of the sphere, `E* [(a^2 + R^2) artanh(a/R) - a R]`, beside Hertz's.
        let ratio = A_OVER_R;
        let exact = (1.0 + ratio * ratio) * ratio.atanh() - ratio;
        let shape = 1.0 - 4.0 / 3.0 * ratio.powi(3) / exact;
        // The zone is (pi/4) (w R^2/Es*)^(1/3)/mu^2, and JKR pulls off at a^3 = 9 pi w R^2/(8 Es*).
        let range = PI / 24.0 * (8.0 / (9.0 * PI)).cbrt() / (TABOR * TABOR);
        // A punch that sticks to a half-space is stiffer by artanh(beta)/beta, with Dundurs' beta of
        // the film and an incompressible sphere.
        let beta = thick.sphere_film_modulus() / thick.film_modulus() * (2.0 / 7.0);
        let friction = 1.0 - beta / beta.atanh();
        let turn = relaxing_load(1.0);
        let times = (1..=100).map(|i| f64::from(i) / 50.0);
        let changes = times.map(|time| {
            let elastic = (1.0 - (time - 1.0).abs()).powf(1.5);
            (relaxing_load(time) / turn - elastic).abs()
        });
        let relaxation = changes.fold(0.0, f64::max);
        let of_bodies = [film, sphere, substrate, compressibility, strength, 0.0];
        let of_model = [shape, range, 0.0, friction, relaxation];
        let expected = of_bodies.into_iter().chain(of_model);
        let found = errors(&Effect::ALL, 1e-6, &thick, strength).expect("solved");
        for ((effect, found), expected) in Effect::ALL.iter().zip(found).zip(expected) {
            let is_near = (found - expected).abs() <= 1e-5;
            assert!(
                is_near,
                "{effect:?}, {strength}: {found:e}, not {expected:e}"
            );
        }
    }
}
