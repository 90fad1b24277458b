//! The attraction of finite range against values by two other programs, Maugis' closed form, the
//! energy balance and the limit of long ranges.

use acceptance::{Case, Data, Refused, larger, layer, slopes, solid, stack};
use contact::Control;
use interp::Elastic;
use solve::Error;
use solve::cohesive::{Cohesive, CohesiveState, REACH};
use solve::stack::{Layer, Stack};
use std::f64::consts::PI;

/// The thickness of the films, m, and the modulus of the sphere, Pa: units of the file.
pub const THICKNESS: f64 = 1e-6;
const MODULUS: f64 = 1e6;

/// Returns the attraction of a row, and the unit of its loads, `pi w R`.
fn of_row(case: &Case<'_>) -> (Cohesive, f64) {
    let in_units = case.stack();
    let scaled = |one: Elastic| solid(one.young() * MODULUS, one.poisson());
    let layers: Vec<Layer> = in_units
        .layers()
        .iter()
        .map(|one| Layer::bonded(scaled(one.solid), one.thickness * THICKNESS))
        .collect();
    let (unit, sphere_modulus) = match case.text("sphere") {
        "rigid" => (
            layers.last().expect("a layer").solid.reduced(),
            f64::INFINITY,
        ),
        _ => (MODULUS, MODULUS),
    };
    let (radius, w) = (
        case.get("r_over_t") * THICKNESS,
        case.get("w") * unit * THICKNESS,
    );
    let stack = stack(scaled(in_units.base()), &layers);
    let range = w / (case.get("sigma0") * unit);
    let cohesive = on_stack(&stack, radius, sphere_modulus, w, range);
    (cohesive.expect("physical"), PI * w * radius)
}

/// Loads count relative to `pi w R`, penetrations and outer radii relative to their size.
#[test]
fn states_and_pull_offs_agree_with_reference_values() {
    let data = Data::read("cohesive");
    let (mut worst, mut count) = (0.0, 0);
    for case in data.cases() {
        let (cohesive, unit) = of_row(&case);
        let a = case.get("a_over_t") * THICKNESS;
        let at_radius = cohesive.state(a).expect("solved");
        let [load, penetration, outer] =
            ["load_over_piwR", "penetration_over_t", "c_over_t"].map(|name| case.get(name));
        let errors = |state: &CohesiveState| {
            [
                state.load / unit - load,
                (state.penetration / THICKNESS - penetration) / penetration,
                (state.outer_radius / THICKNESS - outer) / outer,
            ]
            .map(f64::abs)
        };
        let [kind, system] = ["kind", "system"].map(|column| case.text(column));
        let name = format!("{kind} {system} at {a:e} m");
        let error = errors(&at_radius).into_iter().fold(0.0, larger);
        assert!(error < 1e-12, "{name}: {:?}", errors(&at_radius));
        worst = larger(worst, error);
        let control = match kind {
            "pull_off_load" => Control::Load,
            "pull_off_displacement" => Control::Displacement,
            _ => continue,
        };
        let pull_off = cohesive.pull_off(control).expect("solved");
        let [load_error, penetration_error, _] = errors(&pull_off);
        // The imposed value is stationary, the other one is not.
        let error = if control == Control::Load {
            load_error
        } else {
            penetration_error
        };
        assert!(error < 1e-12, "pull-off of {name}: {error:e}");
        worst = larger(worst, error);
        count += 1;
    }
    println!("{count} pull-offs, largest error {worst:.1e}");
    assert!(count > 10, "{count}");
}

/// Puts a sphere with an attraction on a stack.
pub fn on_stack(
    stack: &Stack,
    radius: f64,
    modulus: f64,
    work: f64,
    range: f64,
) -> Result<Cohesive, Error> {
    Cohesive::new(&stack.system(radius, modulus), Some(stack), work, range)
}

/// A rigid sphere on a half-space of the reduced modulus `MODULUS`, with `R = 1` and `w` in its units,
/// and the parameter `lambda = 2 sigma0 (R/(pi w K^2))^{1/3}`, `K = 4 E*/3`.
fn half_space(lambda: f64) -> (Cohesive, f64, f64) {
    const RADIUS: f64 = 1e-3;
    const WORK: f64 = 1e-6 * MODULUS * RADIUS;
    let stack = stack(solid(MODULUS, 0.0), &[layer(MODULUS, 0.0, RADIUS)]);
    let k = 4.0 / 3.0 * MODULUS;
    let stress = 0.5 * lambda / (RADIUS / (PI * WORK * k * k)).cbrt();
    let cohesive = on_stack(&stack, RADIUS, f64::INFINITY, WORK, WORK / stress);
    (cohesive.expect("physical"), RADIUS, WORK)
}

/// Maugis (1992): with `a` in units of `(pi w R^2/K)^{1/3}`, the load in `pi w R`, the penetration in
/// `(pi^2 w^2 R/K^2)^{1/3}`, `m = c/a` and `t = sqrt(m^2 - 1)`,
///
/// ```text
/// 1 = lambda a^2/2 [t + (m^2-2) arccos(1/m)] + 4 lambda^2 a/3 [t arccos(1/m) - m + 1]
/// F = a^3 - lambda a^2 [t + m^2 arccos(1/m)]         delta = a^2 - 4/3 a lambda t
/// ```
#[test]
fn states_on_a_half_space_are_those_of_maugis() {
    let mut worst = 0.0;
    for lambda in [0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0] {
        let (cohesive, radius, w) = half_space(lambda);
        let k = 4.0 / 3.0 * MODULUS;
        let unit = (PI * w * radius * radius / k).cbrt();
        for a in [0.1, 0.4, 0.8, 1.2, 1.8, 2.5] {
            let state = cohesive.state(a * unit).expect("solved");
            let m = state.outer_radius / state.contact_radius;
            let t = ((m - 1.0) * (m + 1.0)).sqrt();
            let angle = t.atan();
            let opening = 0.5 * lambda * a * a * (t + (m * m - 2.0) * angle)
                + 4.0 / 3.0 * lambda * lambda * a * (t * angle - m + 1.0);
            // The equation for m loses the digits of a thin annulus.
            let noise = 1e-15 * (lambda * a * a + lambda * lambda * a) * m * m;
            assert!(
                (opening - 1.0).abs() < 1e-12 + noise,
                "{lambda}, {a}: {opening}"
            );
            let load = a.powi(3) - lambda * a * a * (t + m * m * angle);
            let penetration = a * a - 4.0 / 3.0 * a * lambda * t;
            let errors = [
                state.load / (PI * w * radius) - load,
                state.penetration / (unit * unit / radius) - penetration,
            ];
            let size = 1.0 + a.powi(3);
            worst = errors.iter().map(|e| e.abs() / size).fold(worst, larger);
        }
    }
    println!("Maugis: {worst:.1e}");
    assert!(worst < 1e-12);
}

/// The paper's film under a sphere of 100 times its thickness, and a rigid sphere on a confined
/// incompressible film, at Dugdale's `lambda`, with the radius, the work of adhesion and the range.
fn on_film(lambda: f64, confined: bool) -> (Cohesive, [f64; 3]) {
    let (young, base, sphere_modulus) = if confined {
        (0.75, f64::INFINITY, f64::INFINITY)
    } else {
        (1.75, 1e5, MODULUS)
    };
    let film = layer(young * MODULUS, 0.5, THICKNESS);
    let k = 4.0 / 3.0 / (1.0 / film.solid.reduced() + 1.0 / sphere_modulus);
    let stack = stack(solid(base * MODULUS, 0.25), &[film]);
    let (radius, w) = (100.0 * THICKNESS, 2e-3 * MODULUS * THICKNESS);
    let stress = 0.5 * lambda / (radius / (PI * w * k * k)).cbrt();
    let range = w / stress;
    let cohesive = on_stack(&stack, radius, sphere_modulus, w, range);
    (cohesive.expect("physical"), [radius, w, range])
}

/// Returns the nodes of the midpoint rule on `[0, 1]`, and the weights, after a substitution whose
/// derivatives vanish at both ends.
fn nodes(count: u32) -> impl Iterator<Item = (f64, f64)> {
    let bend = |u: f64| {
        let angle = 2.0 * PI * u;
        (u - angle.sin() / (2.0 * PI), 1.0 - angle.cos())
    };
    (0..count).map(move |i| {
        let (u, slope) = bend((f64::from(i) + 0.5) / f64::from(count));
        let (v, next) = bend(u);
        (v, slope * next / f64::from(count))
    })
}

/// Returns the sum of `weight(r) * values(r)` over the steps at `radii`.
fn integral(values: &[f64], radii: &[f64], steps: &[f64], weight: impl Fn(f64) -> f64) -> f64 {
    let terms = values.iter().zip(radii).zip(steps);
    terms
        .map(|((value, &r), step)| value * weight(r) * step)
        .sum()
}

/// The load is the derivative of the energy with respect to the penetration, and the integral of the
/// pressure less that of the traction. With the gap `h`, elastic energy and that of the surfaces are
///
/// ```text
/// U = F delta/2 - (pi/2R) int_0^c r^3 p dr + (sigma0/2) int_annulus h dA - w pi c^2
/// ```
///
/// It knows nothing of how the outer radius was found.
#[test]
fn the_load_is_the_slope_of_the_energy() {
    const POINTS: u32 = 200;
    let [mut worst, mut worst_sum] = [0.0; 2];
    for confined in [false, true] {
        for (lambda, a) in [(0.3, 3.0), (1.0, 2.0), (3.0, 4.0), (8.0, 2.0)] {
            let (cohesive, [radius, w, range]) = on_film(lambda, confined);
            let stress = w / range;
            let energy = |a: f64| {
                let state = cohesive.state(a).expect("solved");
                let c = state.outer_radius;
                // r = a sin(psi) in the contact.
                let (inside, steps): (Vec<f64>, Vec<f64>) = nodes(POINTS)
                    .map(|(part, weight)| ((0.5 * PI * part).sin_cos(), 0.5 * PI * weight))
                    .map(|((sin, cos), step)| (a * sin, a * cos * step))
                    .unzip();
                let pressure = cohesive.pressure(a, &inside).expect("solved");
                let load = 2.0 * PI * integral(&pressure, &inside, &steps, |r| r)
                    - stress * PI * (c - a) * (c + a);
                let moment = integral(&pressure, &inside, &steps, |r| r.powi(3))
                    - 0.25 * stress * (c.powi(4) - a.powi(4));
                let (outside, steps): (Vec<f64>, Vec<f64>) = nodes(POINTS)
                    .map(|(part, weight)| (a + (c - a) * part, (c - a) * weight))
                    .unzip();
                let gap = cohesive.gap(a, &outside).expect("solved");
                let opening = 2.0 * PI * integral(&gap, &outside, &steps, |r| r);
                let energy = 0.5 * state.load * state.penetration - 0.5 * PI / radius * moment
                    + 0.5 * stress * opening
                    - w * PI * c * c;
                (energy, load, state)
            };
            let a = a * THICKNESS;
            let [rise, descent] = slopes(0.01 * a, |change| {
                let (energy, _, state) = energy(a + change);
                [energy, state.penetration]
            });
            let (_, load, state) = energy(a);
            let scale = PI * w * radius;
            let errors = [
                (rise / descent - state.load) / scale,
                (load - state.load) / scale,
            ];
            println!("{confined} {lambda} {errors:?} {:.3}", state.load / scale);
            worst = larger(worst, errors[0].abs());
            worst_sum = larger(worst_sum, errors[1].abs());
        }
    }
    assert!(worst < 1e-9 && worst_sum < 1e-10, "{worst}, {worst_sum}");
}

/// The pull-off load of a long range is DMT's `-2 pi w R` on every film.
#[test]
fn a_long_range_is_the_limit_of_dmt() {
    for confined in [false, true] {
        let [far, farther] = [0.02, 0.01].map(|lambda| {
            let (cohesive, [radius, w, _]) = on_film(lambda, confined);
            let pull_off = cohesive.pull_off(Control::Load).expect("solved");
            pull_off.load / (-2.0 * PI * w * radius) - 1.0
        });
        println!("{far:.1e} {farther:.1e}");
        assert!(farther.abs() < 0.01 && farther.abs() < 0.7 * far.abs());
    }
}

/// The contact begins where the attraction across the gap ends.
#[test]
fn the_contact_continues_the_attraction_before_it() {
    for confined in [false, true] {
        let (cohesive, [radius, w, range]) = on_film(0.5, confined);
        let mut outer = (2.0 * radius * range).sqrt();
        while cohesive.without_contact(outer).is_err() {
            outer *= 0.999;
        }
        let before = cohesive.without_contact(outer).expect("solved");
        let after = cohesive.state(2e-3 * outer).expect("solved");
        let error = (after.load - before.load) / (PI * w * radius);
        println!(
            "{error:.1e}, c {:.4}",
            after.outer_radius / before.outer_radius
        );
        assert!(
            error.abs() < 5e-3 && (after.outer_radius / before.outer_radius - 1.0).abs() < 2e-3
        );
        // Far before the contact the load vanishes and the gap in the middle is the range.
        let first = cohesive.without_contact(1e-4 * outer).expect("solved");
        assert!((first.penetration / -range - 1.0).abs() < 1e-3);
    }
}

/// The gap where the attraction ends is its range, whatever other radii are asked for, in any order.
#[test]
fn the_gap_at_a_radius_does_not_depend_on_other_radii() {
    for nu in [0.3, 0.5] {
        let film = stack(solid(1e3 * MODULUS, 0.25), &[layer(MODULUS, nu, THICKNESS)]);
        let [radius, range] = [1e3, 1.3].map(|length| length * THICKNESS);
        let cohesive = on_stack(&film, radius, f64::INFINITY, 0.05, range).expect("physical");
        let a = 0.01 * THICKNESS;
        let outer = cohesive.state(a).expect("solved").outer_radius;
        for far in [1.5, 1.99].map(|factor| factor * outer) {
            let gaps = cohesive.gap(a, &[far, outer, a]).expect("solved");
            let ascending = cohesive.gap(a, &[a, outer, far]).expect("solved");
            let error = (gaps[1] / range - 1.0).abs();
            println!("c/t {:.1}: {error:.1e}", outer / THICKNESS);
            assert!(error < 1e-8);
            assert_eq!(gaps, ascending.into_iter().rev().collect::<Vec<f64>>());
        }
    }
}

#[test]
fn values_outside_the_domain_are_named() {
    let (cohesive, [radius, ..]) = on_film(1.0, false);
    for a in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.001 * radius] {
        cohesive.state(a).refused("contact radius");
    }
    let film = stack(solid(MODULUS, 0.5), &[layer(MODULUS, 0.5, THICKNESS)]);
    for (w, range, name) in [
        (0.0, 1e-9, "work of adhesion"),
        (f64::NAN, 1e-9, "work of adhesion"),
        (0.05, 0.0, "interaction range"),
        (1e-300, 1e-300, "interaction range"),
        (0.05, f64::INFINITY, "interaction range"),
        (0.05, 2.0 * radius, "interaction range"),
    ] {
        on_stack(&film, radius, MODULUS, w, range).refused(name);
    }
    let outer = cohesive.state(0.01 * radius).expect("solved").outer_radius;
    cohesive
        .gap(0.01 * radius, &[2.001 * outer])
        .refused("radius");
    assert!(cohesive.gap(0.01 * radius, &[]).expect("none").is_empty());
    let strong = on_stack(&film, radius, MODULUS, 1e300, 1e-9).expect("positive");
    strong.without_contact(1e-3 * radius).refused("overflows");
}

/// The attraction before the contact is solved up to the reach; its cost grows with the radius.
#[test]
fn an_attraction_beyond_the_reach_is_refused() {
    let film = layer(MODULUS, 0.5, THICKNESS);
    let stack = stack(solid(1e5 * MODULUS, 0.25), &[film]);
    let reach = REACH * THICKNESS;
    for radius in [1.0, 1e30] {
        // The bodies would touch at sqrt(2 h0 R), 1.4 mm and more.
        let far = on_stack(&stack, radius, MODULUS, 1e-9, 1e-6).expect("physical");
        far.without_contact(0.999 * reach).expect("within reach");
        far.without_contact(1.001 * reach).refused("outer radius");
    }
}
