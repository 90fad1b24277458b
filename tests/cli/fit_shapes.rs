//! `tabulate fit --probe`: files of measurements under probes of several shapes.

use acceptance::{assert_estimate, assert_near, estimate, workdir};

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
    workdir.refuses(format!(
        "1 | fit punch.csv {bodies} --friction stick --work-of-adhesion 1J/m^2 --free film-modulus | punch.csv: a flat punch; \
         fit it without friction; names the modulus with full friction"
    ));
    // Rounding makes some standard error finite where points before the pull-off are left out.
    let wide = "--probe flat-punch --sphere-radius 0.5mm --sphere-modulus inf --film-thickness 100um --film-poisson-ratio 0.5 \
         --substrate-modulus 70GPa --substrate-poisson-ratio 0.2";
    workdir.simulate(format!(
        "--kind load-penetration --from=-12um --to 4um --points 90 --noise 200uN --seed 5 {wide} --film-modulus 50kPa \
         --work-of-adhesion 100mJ/m^2 -o wide.csv"
    ));
    workdir.refuses(format!(
        "1 | fit wide.csv {wide} | determine work-of-adhesion; until it pulls off"
    ));
    // The stiffness tells the modulus.
    let object = workdir.json(format!(
        "fit punch.csv {bodies} --free film-modulus --work-of-adhesion 1mJ/m^2 --json"
    ));
    assert_estimate(&object, "film_modulus", 2e4, 0.01 * 2e4);
    workdir.refuses("1 | fit punch.csv --probe cone | --probe cone needs --half-angle");
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
