//! `tabulate fit --probe`: files of measurements under probes of several shapes.

use std::f64::consts::PI;
use std::fmt::Write;

use acceptance::{assert_close, assert_estimate, assert_near, estimate, number, workdir};

/// The reduced modulus of a solid of 1 MPa with a Poisson ratio of 0.5 under a rigid probe, Pa, the
/// work of adhesion, J/m^2, and the reading of the penetration at first touch, m.
const MODULUS: f64 = 1e6 / 0.75;
const ADHESION: f64 = 0.02;
const CONTACT_POINT: f64 = 3e-7;

/// Load and penetration of a contact of radius `a` on a half-space, by `b` at its edge and the mean
/// of `b` (Sneddon), with JKR's adhesion.
fn state(a: f64, b: f64, mean: f64) -> [f64; 2] {
    let pulled = (2.0 * PI * a * ADHESION / MODULUS).sqrt();
    [2.0 * MODULUS * a * (b - mean - pulled), b - pulled]
}

/// Returns a file of measured points with columns in um and uN.
fn file(states: impl Iterator<Item = [f64; 2]>) -> String {
    let mut text = "penetration [um],load [uN]\n".to_owned();
    for (i, [load, penetration]) in states.enumerate() {
        // A disturbance of 1e-4 of a uN that has no trend.
        let noise = 1e-4 * (2.4 * (i * i) as f64).sin();
        let [penetration, load] = [penetration + CONTACT_POINT, load].map(|value| 1e6 * value);
        let _ = writeln!(text, "{penetration:?},{:?}", load + noise);
    }
    text
}

#[test]
fn a_file_of_a_half_space_under_a_cone_gives_the_closed_form() {
    let workdir = workdir!();
    let slope = 70_f64.to_radians().tan().recip();
    let cone = (0..50).map(|i| {
        let a = 6e-6 - 1e-7 * f64::from(i);
        let b = 0.5 * PI * slope * a;
        state(a, b, 0.5 * b)
    });
    workdir.write("cone.csv", file(cone));
    let fit = "fit cone.csv --half-space --sphere-modulus inf --film-poisson-ratio 0.5 --work-of-adhesion 0.02 \
         --film-modulus 2e6 --json --free film-modulus,work-of-adhesion,contact-point --probe cone";
    let object = workdir.json(format!("{fit} --half-angle 70"));
    assert_eq!(object["converged"], true);
    for (name, truth) in [
        ("film_modulus", 1e6),
        ("work_of_adhesion", ADHESION),
        ("contact_point", CONTACT_POINT),
    ] {
        assert_close(
            number(&object, &format!("parameters/{name}/value")),
            truth,
            1e-3,
        );
    }
    workdir.refuses(format!("1 | {fit} | --probe cone needs --half-angle"));
}

/// The load on a flat punch does not depend on the work of adhesion until it pulls off: no fit finds one, or two.
#[test]
fn the_adhesion_of_a_flat_punch_is_that_of_its_pull_off() {
    let workdir = workdir!();
    let bodies = "--probe flat-punch --sphere-radius 5um --sphere-modulus inf --film-thickness 10um \
         --film-modulus 20kPa --film-poisson-ratio 0.49 --substrate-modulus inf";
    workdir.simulate(format!(
        "--kind load-penetration --from -0.5um --to 0.5um --points 60 --noise 1nN -o punch.csv {bodies} \
             --work-of-adhesion 1mJ/m^2"
    ));
    for (free, names) in [
        ("", "work-of-adhesion"),
        ("--free film-modulus,work-of-adhesion", "work-of-adhesion"),
        (
            "--free film-modulus,work-of-adhesion,work-of-adhesion-receding",
            "work-of-adhesion and work-of-adhesion-receding",
        ),
    ] {
        workdir.refuses(format!(
            "1 | fit punch.csv {bodies} {free} | {names}; until it pulls off; --work-of-adhesion 1J/m^2; pull-off --load"
        ));
    }
    // The stiffness tells the modulus.
    let object = workdir.json(format!(
        "fit punch.csv {bodies} --free film-modulus --work-of-adhesion 1mJ/m^2 --json"
    ));
    assert_estimate(&object, "film_modulus", 2e4, 0.01 * 2e4);
}

/// A cone adheres weakly: the points that tell it are few, and the logarithm of a work of adhesion does not come back
/// from 0.
#[test]
fn weak_adhesion_under_a_cone_is_found() {
    let workdir = workdir!();
    let bodies = "--probe cone --half-angle 70 --sphere-modulus inf --film-poisson-ratio 0.5 --film-thickness 5um \
         --substrate-modulus 70GPa --substrate-poisson-ratio 0.25";
    for seed in [0, 2, 4] {
        workdir.simulate(format!(
            "--kind load-penetration --from=-0.5um --to 1um --points 60 --noise 0.2nN --work-of-adhesion 0.2mJ/m^2 \
             --film-modulus 20kPa --seed {seed} {bodies} -o cone.csv"
        ));
        let found = workdir.json(format!(
            "fit cone.csv {bodies} --noise 0.2nN --free film-modulus,work-of-adhesion,contact-point,load-offset --json"
        ));
        for (name, truth) in [("film_modulus", 20e3), ("work_of_adhesion", 0.2e-3)] {
            let [value, error] = estimate(&found, name);
            assert_near(value, truth, 3.0 * error);
            assert!(error < 0.5 * truth, "{seed} {name}: {value} {error}");
        }
    }
}
