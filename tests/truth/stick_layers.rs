//! Layers that stick on top: films cut into layers, the shift of Dundurs, and films on springs or that
//! slide below.

use acceptance::{larger, layer, material, relative, solid, springs, stack};
use solve::solve_stack;
use solve::stack::Interface;
use solve::stick::Sticking;

use crate::interface_limits::film;

/// A film cut into layers, and the shift of Dundurs: with all `b_i/E_i*` shifted by one constant,
/// that of the sphere included, nothing changes.
#[test]
fn layers_of_one_material_are_one_film_and_dundurs_shift_changes_nothing() {
    let layers = [0.2, 0.5, 0.3].map(|thickness| layer(2.0, 0.5, thickness));
    let two = [layer(20.0, 0.3, 0.4), layer(2.0, 0.5, 0.6)];
    let of_film = Sticking::on_film(&material([2.0, 0.5, 20.0, 0.3]), 0.5).expect("physical");
    let [cut, above] = [&layers[..], &two].map(|layers| {
        let stack = stack(solid(20.0, 0.3), layers);
        Sticking::on_stack(&stack, 1.0, 0.5).expect("physical")
    });
    for x in [0.3, 2.0] {
        let expected = of_film.tip(x, 2.0, 1e-9).expect("converges").0;
        // The layer of the base's material is part of it.
        for (found, x) in [(&cut, x), (&above, 0.6 * x)] {
            let found = found.tip(x, 2.0, 1e-9).expect("converges").0;
            for (a, b) in [
                (found.eeq_s, expected.eeq_s),
                (found.pi_s, expected.pi_s),
                (found.gamma_g, expected.gamma_g),
            ] {
                assert!(relative(a, b) <= 1e-12, "{a}, not {b}");
            }
        }
    }
    // Of a punch up to 300 top layers wide, in thicknesses of all layers.
    for (sticking, most) in [(&cut, 300.0), (&above, 180.0)] {
        assert!(relative(sticking.most_of_punch(), most) <= 1e-12);
        assert!(sticking.punch(1.001 * most, 1e-4).is_err());
    }
    // E* = E/(1 - nu^2) is kept; b/E* is shifted.
    let shifted = |e: f64, nu: f64, shift: f64| {
        let reduced = e / (1.0 - nu * nu);
        let b = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)) + shift * reduced;
        let nu = (1.0 - 2.0 * b) / (2.0 * (1.0 - b));
        (reduced * (1.0 - nu * nu), nu)
    };
    let [plain, moved] = [0.0, 0.05].map(|shift| {
        let ((e1, nu1), (e0, nu0)) = (shifted(2.0, 0.4, shift), shifted(3.0, 0.35, shift));
        // The sphere has E2* = 1 as unit: E2 = 1 - nu2^2.
        let (_, nu2) = shifted(1.0 - 0.2 * 0.2, 0.2, shift);
        let film = Sticking::on_film(&material([e1, nu1, e0, nu0]), nu2).expect("physical");
        film.punch(2.0, 1e-11).expect("converges")
    });
    assert!(
        relative(plain.eeq_s, moved.eeq_s) <= 1e-12,
        "{plain:?}, {moved:?}"
    );
    assert!(relative(plain.gamma_eff, moved.gamma_eff) <= 1e-12);
}

/// A film on springs: without friction on top it is that of the other solver, with stick it is
/// stiffer; springs that are stiff enough bond it.
#[test]
fn films_on_springs_may_stick_on_top() {
    let stack = |interface: Interface| film(solid(40.0, 0.3), (2.0, 0.5), interface);
    let on =
        |interface: Interface| Sticking::on_stack(&stack(interface), 1.0, 0.5).expect("physical");
    let bonded = Sticking::on_film(&material([2.0, 0.5, 40.0, 0.3]), 0.5).expect("physical");
    let (stiff, soft) = (springs(1e8, f64::INFINITY), springs(1.0, 50.0));
    for x in [0.5, 3.0] {
        let punch = on(soft).punch(x, 1e-10).expect("converges");
        let slides = on(soft).without_friction();
        let slides = slides.punch(x, 1e-10).expect("converges");
        let known = solve_stack(x, &stack(soft), 1.0, 1e-11).expect("converges");
        assert!(relative(slides.eeq_s, known.quantities.eeq) <= 1e-10);
        assert!(punch.eeq_s > slides.eeq_s, "{x}");
        let sprung = on(stiff).tip(x, 2.0, 1e-8).expect("converges").0;
        let glued = bonded.tip(x, 2.0, 1e-8).expect("converges").0;
        assert!(relative(sprung.eeq_s, glued.eeq_s) <= 1e-6);
        assert!(relative(sprung.pi_s, glued.pi_s) <= 1e-6);
    }
}

/// A film that slides on its base is the limit of weaker and weaker springs, which other panels
/// resolve. Measured: 1.1e-7 at a tangential stiffness of 1e-9 `E1*/t`.
#[test]
fn films_that_slide_below_may_stick_on_top() {
    let mut worst = 0.0;
    for (nu, base) in [(0.5, f64::INFINITY), (0.3, f64::INFINITY), (0.5, 40.0)] {
        let on = |interface: Interface| {
            let stack = film(solid(base, 0.2), (0.75, nu), interface);
            Sticking::on_stack(&stack, f64::INFINITY, 0.5).expect("physical")
        };
        let weak = on(springs(1e-9, f64::INFINITY));
        let slides = on(Interface::Sliding);
        for x in [0.1, 1.0, 5.0, 20.0] {
            let [found, known] =
                [&slides, &weak].map(|one| one.punch(x, 1e-10).expect("converges"));
            worst = larger(worst, relative(found.eeq_s, known.eeq_s));
            worst = larger(worst, relative(found.gamma_eff, known.gamma_eff));
            let without = slides.clone().without_friction();
            assert!(found.eeq_s > without.punch(x, 1e-10).expect("converges").eeq_s);
            if nu == 0.5 && x < 10.0 {
                let [found, known] =
                    [&slides, &weak].map(|one| one.tip(x, 2.0, 1e-9).expect("converges").0);
                for (a, b) in [(found.pi_s, known.pi_s), (found.gamma_g, known.gamma_g)] {
                    worst = larger(worst, relative(a, b));
                }
            }
        }
    }
    println!("sliding and weak springs: {worst:.1e}");
    assert!(worst <= 1e-6, "{worst:e}");
}
