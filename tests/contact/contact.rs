//! A contact besides its equilibria: energy release rates from measurements, apparent JKR
//! parameters and validity.

use std::f64::consts::PI;

use acceptance::{
    Refused, assert_close, assert_matches, flat_ended_cone, looked_up, paper_system, power_law,
    relative, rigid_probe, rounded_cone, solid, solved, system_of,
};
use contact::{Contact, Error, JkrFit, JkrPoint, Neglected};
use interp::{HalfSpace, Material, Probe, System};
use solve::solve;

pub fn bare() -> HalfSpace {
    paper_system(1e-6).without_film()
}

pub fn half_space() -> Contact {
    Contact::half_space(&bare()).expect("physical")
}

/// A half-space as film and substrate, whose contacts are solved from a radius on.
pub fn beginning_at(radius: f64) -> Contact {
    let system = paper_system(1e-3);
    let system = System {
        substrate: system.film,
        ..system
    };
    let range = [radius, 1e-3].map(|a| a / system.film_thickness);
    let curve = solve::curve(&system.material().expect("physical"), range, 1e-10);
    Contact::new(&system, curve.expect("solved")).expect("its material")
}

pub fn coated(film_thickness: f64) -> Contact {
    looked_up(&paper_system(film_thickness))
}

#[test]
fn a_load_that_no_adhesive_contact_bears_has_no_energy_release_rate() {
    let contact = coated(1e-5);
    let (load, penetration) = contact.load_and_penetration(5e-5, 0.0).expect("in range");
    let (a, g) = contact
        .radius_and_energy_release_rate(load * (1.0 - 1e-4), penetration)
        .expect("in range");
    assert!(a > 5e-5 && g > 0.0 && g < 0.04, "{a}, {g}");
    for (load, penetration) in [
        (1.001 * load, penetration),
        (1e-9, 0.0),
        (1e-9, -1e-9),
        (1.0, -1.0),
    ] {
        let found = contact.radius_and_energy_release_rate(load, penetration);
        found.refused("load = ; is not physical");
    }
    // Deeper, and under more tension, than the largest radius has it.
    for (load, penetration) in [(1.0, 1.0), (-1e6, -1e-6)] {
        let found = contact.radius_and_energy_release_rate(load, penetration);
        assert_matches!(found, Err(Error::OutsideRadii { .. }));
    }
    // A flat punch so small that it sees the film only.
    let (a, g) = contact
        .radius_and_energy_release_rate(-1e-20, -1e-9)
        .expect("far below the nodes");
    let (load, penetration) = contact.load_and_penetration(a, g).expect("below the nodes");
    let misses = [relative(load, -1e-20), relative(penetration, -1e-9)];
    let found = a < 1e-17 && misses.iter().all(|&miss| miss < 1e-12);
    assert!(found, "{a}: {load}, {penetration}");
}

#[test]
fn the_jkr_fit_of_a_half_space_gives_its_modulus_and_work_of_adhesion_back() {
    let (contact, w) = (half_space(), 0.04);
    let e = contact.mechanics().sphere_film_modulus();
    let bias = contact.film_bias(w, [4e-5, 1.3e-4], 15).expect("physical");
    let of_work = [
        bias.work_of_adhesion,
        bias.work_of_adhesion_at_known_modulus,
    ];
    for bias in [[bias.modulus].as_slice(), &of_work].concat() {
        assert!(bias.abs() <= 1e-13, "{bias:e}");
    }
    assert!(!bias.exceeds(1e-12) && bias.exceeds(-1.0) && bias.exceeds(f64::NAN));
    assert!((bias.fit.modulus / e - 1.0).abs() <= 1e-13);
    // From measured radii and loads, in any order.
    let points =
        [9e-5, 5e-5, 7e-5].map(|a| JkrPoint::new(a, contact.load(a, w).expect("any radius"), 1e-3));
    let fit = JkrFit::through(&points).expect("three points");
    assert!(relative(fit.modulus, e) <= 1e-13 && relative(fit.work_of_adhesion(), w) <= 1e-13);
    // Loads above Hertz are no adhesion.
    let repelled = points.map(|point| JkrPoint {
        ordinate: point.ordinate - 2.0 * fit.intercept,
        ..point
    });
    let repelled = JkrFit::through(&repelled).expect("three points");
    assert!(relative(repelled.work_of_adhesion(), -w) <= 1e-12);
    for points in [
        &[][..],
        &points[..1],
        &[points[0]; 3],
        &[JkrPoint {
            abscissa: f64::NAN,
            ordinate: 1.0,
        }; 2],
    ] {
        JkrFit::through(points).refused("spread of the JKR plot's abscissas");
    }
    let falling = [0.0, 1.0].map(|x| JkrPoint {
        abscissa: x,
        ordinate: -x,
    });
    // The slope is a number, the modulus is none.
    let steep = [0.0, 1.0].map(|x| JkrPoint {
        abscissa: x,
        ordinate: 1.5e308 * x,
    });
    for points in [falling, steep] {
        JkrFit::through(&points).refused("slope of the JKR plot; is not physical");
    }
}

/// The error of a fit that ignores the film is relative to a compliant sphere.
#[test]
fn under_a_rigid_sphere_there_is_a_jkr_fit_but_no_film_bias() {
    let material = Material::new(0.0, 0.5, 1e5, 0.25).expect("a rigid sphere");
    let curve = solve::curve(&material, [0.5, 10.0], 1e-8).expect("converges");
    let film = solid(3.5e6, 0.5);
    let substrate = solid(3.5e11, 0.25);
    let system = System {
        sphere_modulus: f64::INFINITY,
        film,
        substrate,
        ..paper_system(1e-5)
    };
    let contact = Contact::new(&system, curve).expect("the system of the curve");
    let radii = [1e-5, 5e-5];
    let bias = contact.film_bias(0.04, radii, 15);
    bias.refused("sphere_modulus = inf; finite; Contact::jkr_fit");
    // The film, between its own modulus and that of the substrate, is all that deforms.
    let fit = contact.jkr_fit(0.04, radii, 15).expect("as the error says");
    let between = film.reduced()..1e-2 * substrate.reduced();
    assert!(between.contains(&fit.modulus), "{fit:?}");
    // Without the film the compound modulus is finite, and JKR is exact.
    let bare = Contact::half_space(&system.without_film()).expect("a compliant solid");
    let bias = bare.film_bias(0.04, radii, 15).expect("a half-space");
    assert!(!bias.exceeds(1e-12), "{bias:?}");
    // Without adhesion there is no error of the work of adhesion, either.
    bare.film_bias(0.0, radii, 15).refused("work of adhesion");
}

#[test]
fn numbers_of_points_are_bounded() {
    for points in [0, 1, 1_000_001, usize::MAX] {
        let fit = half_space().jkr_fit(0.04, [4e-5, 1.3e-4], points);
        fit.refused("number of points");
    }
}

/// A very thin film between rigid bodies is the elastic foundation from which the compressibility
/// is derived.
#[test]
fn the_compressibility_is_the_ratio_of_a_thin_films_two_stiffnesses() {
    for nu1 in [0.5, 0.3, 0.0] {
        let film = solid(1e6, nu1);
        let rigid = solid(f64::INFINITY, 0.25);
        let system = rigid_probe(Probe::Paraboloid { radius: 1e-3 }, film, 1e-9, rigid);
        let material = system.material().expect("physical");
        let x = 1e3;
        let (a, shear) = (x * system.film_thickness, 0.5 * film.young() / (1.0 + nu1));
        let stiffness =
            2.0 * a * film.reduced() * solve(x, &material, 1e-8).expect("converges").quantities.eeq;
        let flowing = 3.0 * PI * shear * a.powi(4) / (8.0 * system.film_thickness.powi(3));
        let curve =
            interp::Curve::through(&[(x, material.thick_film_limit())], material).expect("a node");
        let contact = Contact::new(&system, curve).expect("its own");
        let film = contact.validity(a).expect("physical").film.expect("coated");
        assert!((film.a_over_t / x - 1.0).abs() < 1e-14);
        let expected = match film.compressibility {
            0.0 => flowing,
            compressibility => flowing / compressibility,
        };
        assert_close(stiffness, expected, 0.01);
    }
}

/// A program that lets the contact be any set of rings found these loads over those of a disc, less 1, at the same
/// penetration: under `r^n` on a film of Poisson ratio 0.3, `contrast` times as stiff as its substrate.
#[test]
fn validity_says_where_a_stiff_film_makes_no_disc() {
    for (contrast, exponent, a_over_t, error) in [
        (50.0, 1.0, 2.95, 0.0),
        (100.0, 1.0, 1.76, 3e-4),
        (200.0, 1.0, 0.78, 0.0),
        (200.0, 1.0, 1.09, 0.029),
        (200.0, 1.0, 2.80, 0.012),
        (1e3, 1.0, 0.45, 0.0),
        (1e3, 1.0, 0.64, 0.137),
        (1e3, 1.0, 1.09, 0.270),
        (1e4, 1.0, 0.21, 0.0),
        (1e4, 1.0, 0.76, 1.10),
        (1e3, 1.5, 1.64, 0.0),
        (1e4, 1.5, 0.76, 0.0),
        (50.0, 6.0, 0.98, -2e-4),
        (50.0, 6.0, 2.22, -0.0082),
        (100.0, 3.0, 2.36, -0.0022),
        (100.0, 6.0, 2.36, -0.0138),
        (200.0, 6.0, 0.93, -4e-4),
        (1e3, 6.0, 1.64, -0.0095),
        (1e4, 6.0, 0.76, -1e-4),
    ] {
        let (t, half_angle) = (1e-6, 88_f64.to_radians());
        let contact = looked_up(&system_of(
            if exponent == 1.0 {
                Probe::Cone { half_angle }
            } else {
                let coefficient = 0.03 * f64::powf(t, 1.0 - exponent);
                power_law(coefficient, exponent)
            },
            f64::INFINITY,
            solid(1e9, 0.3),
            t,
            solid(1e9 / contrast, 0.3),
        ));
        let film = contact.validity(a_over_t * t).expect("in the table").film;
        let says = film.expect("coated").no_disc;
        let case = format!("{contrast} times as stiff, r^{exponent}, a/t {a_over_t}");
        assert_eq!(says, f64::abs(error) > 1e-3, "{case}");
    }
    // Under a flat punch another such program found loads smaller by 1.1, 3.4, 7.6 and 2.2 %.
    for (contrast, a_over_t) in [(30.0, 2.0), (100.0, 3.0), (1e3, 6.0), (1e3, 25.0)] {
        let radius = a_over_t * 1e-6;
        let punch = rigid_probe(
            Probe::FlatPunch { radius },
            solid(1e9, 0.3),
            1e-6,
            solid(1e9 / contrast, 0.3),
        );
        let film = looked_up(&punch).validity(radius).expect("its radius").film;
        assert!(film.expect("coated").no_disc, "{contrast} {a_over_t}");
    }
    // What the film cannot do: under a paraboloid or the round end of a cone, on a substrate as stiff, and where it is wide
    // beside its bending length.
    let no_disc = |probe: &Probe, young: f64, a: f64| {
        let [film, substrate] = [young, 1e6].map(|young| solid(young, 0.3));
        let contact = looked_up(&rigid_probe(probe.clone(), film, 1e-6, substrate));
        let film = contact.validity(a).expect("in the table").film;
        film.expect("coated").no_disc
    };
    let cone = Probe::Cone { half_angle: 1.5 };
    assert!(no_disc(&cone, 1e9, 1e-6));
    assert!(!no_disc(&Probe::Paraboloid { radius: 1e-3 }, 1e9, 1e-6));
    assert!(!no_disc(&Probe::FlatPunch { radius: 1e-6 }, 1e9, 1e-6));
    let rounded = |radius: f64| rounded_cone(radius, 1.5);
    assert!(no_disc(&rounded(1e-6), 1e9, 1e-6) && !no_disc(&rounded(1e-3), 1e9, 1e-6));
    let flat = |radius: f64| flat_ended_cone(radius, 1.5);
    assert!(no_disc(&flat(1e-6), 1e8, 2e-6) && !no_disc(&flat(1e-8), 1e8, 2e-6));
    assert!(!no_disc(&cone, 1e6, 1e-6) && !no_disc(&cone, 1e9, 2e-5));
}

/// A stiff film that is bent by its thickness, beside direct solves: `strain` is that of a softer film alone.
#[test]
fn validity_says_how_far_a_stiff_film_is_bent() {
    let a = 5e-6;
    let of = |young: f64, base: f64| {
        let probe = Probe::Paraboloid { radius: 1e-4 };
        let system = rigid_probe(probe, solid(young, 0.3), 1e-5, solid(base, 0.3));
        let validity = looked_up(&system).validity(a).expect("in the table");
        (system, validity)
    };
    let (system, validity) = of(1e9, 1e5);
    let bent = validity.film.expect("coated");
    let material = system.material().expect("physical");
    let exact = solved(0.5, &material, 1e-9);
    // Penetrations are in units of a^2/R, and the stiffnesses are 2 a E1* eeq and 2 a E0*.
    let expected = exact.delta0 * a * a / 1e-4 / 1e-5 * (1.0 - 1e-4 / exact.eeq);
    assert_close(bent.bending, expected, 3e-6);
    assert!(bent.strain < 0.0 && validity.neglected().contains(&Neglected::Bending));
    for (young, base) in [(1e6, 1e6), (1e6, 1e9), (1e6, f64::INFINITY)] {
        let softer = of(young, base).1.film.expect("coated");
        assert!(softer.bending < 1e-6, "{young:e} {base:e}");
    }
}

#[test]
fn validity_says_how_large_thin_and_short_ranged_a_contact_is() {
    let contact = coated(1e-5);
    let validity = contact.validity(5e-5).expect("physical");
    let film = validity.film.expect("coated");
    assert!((validity.a_over_r - 0.05).abs() < 1e-15 && !validity.is_large_contact());
    assert!((film.a_over_t - 5.0).abs() < 1e-14 && film.in_range);
    assert_eq!(film.compressibility, 0.0);
    let wide = System {
        probe: Probe::Paraboloid { radius: 0.1 },
        ..paper_system(1e-5)
    };
    let wide = looked_up(&wide);
    let validity = wide.validity(0.011).expect("physical");
    assert!(validity.is_large_contact() && !validity.film.expect("coated").in_range);
    let system = System {
        film: solid(3.5e6, 0.3),
        ..paper_system(1e-5)
    };
    let compressible = looked_up(&system);
    let film = compressible.validity(1e-4).expect("physical").film;
    let film = film.expect("coated");
    assert!(relative(film.compressibility, 3.0 / 16.0 * 0.4 / 0.7 * 100.0) < 1e-13);
    assert_eq!(half_space().validity(5e-5).expect("physical").film, None);
    // Between rigid bodies the film has all of the penetration, that of an elastic foundation.
    let system = System {
        sphere_modulus: f64::INFINITY,
        substrate: solid(f64::INFINITY, 0.3),
        ..system
    };
    let film = looked_up(&system).validity(5e-4).expect("physical").film;
    let of_foundation = 5e-4 * 5e-4 / (2.0 * 1e-3) / 1e-5;
    assert!((film.expect("coated").strain / of_foundation - 1.0).abs() < 0.05);

    let (w, z0): (f64, f64) = (0.04, 3e-10);
    let range = contact.zone_size(w, z0).expect("physical");
    let es = 0.7 * 2e6;
    assert!((range.tabor / (1e-3 * w * w / (es * es * z0.powi(3))).cbrt() - 1.0).abs() < 1e-13);
    // Dugdale: pi K_I^2 / (8 stress^2).
    let k = contact.stress_intensity(5e-5, w).expect("in range");
    assert!((range.cohesive_zone / (PI * k * k / 8.0 / (w / z0).powi(2)) - 1.0).abs() < 1e-13);
    assert!(range.is_jkr());
    assert!(!contact.zone_size(w, 1e-6).expect("physical").is_jkr());
    // A pull-off that is not known has no tension.
    let wide = beginning_at(5e-4);
    let range = wide.zone_size(w, z0).expect("physical");
    assert!(range.tension.is_nan() && !range.is_jkr());
}
