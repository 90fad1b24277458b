//! `--half-space`: a probe on a body without a film, where closed forms are known.

use std::f64::consts::PI;

use acceptance::{assert_close, value, workdir};

/// A sphere of 1 mm and 2 MPa on a solid of 3.5 MPa and Poisson ratio 0.4, with 40 mJ/m^2.
const LENS: &str = "--half-space --sphere-radius 1mm --sphere-modulus 2MPa --film-modulus 3.5MPa \
                    --film-poisson-ratio 0.4 --work-of-adhesion 40mJ/m^2";
const RADIUS: f64 = 1e-3;
const WORK: f64 = 0.04;

fn modulus() -> f64 {
    1.0 / ((1.0 - 0.16) / 3.5e6 + 1.0 / 2e6)
}

#[test]
fn the_curve_is_that_of_jkr() {
    let rows = workdir!().csv(format!("curve {LENS} --from 10um --to 200um --points 5"));
    for row in rows.cases() {
        let a = row.get("contact_radius");
        let lowered = (2.0 * PI * a * WORK / modulus()).sqrt();
        let load = 4.0 * modulus() * a.powi(3) / (3.0 * RADIUS) - 2.0 * modulus() * a * lowered;
        assert_close(row.get("load"), load, 1e-12);
        assert_close(row.get("penetration"), a * a / RADIUS - lowered, 1e-12);
        assert_close(row.get("contact_stiffness"), 2.0 * modulus() * a, 1e-12);
    }
}

/// JKR's pull-off under a load and under a displacement, the work of adhesion of a measured one, and Bradley's, of
/// an attraction that reaches far.
#[test]
fn pull_offs_are_those_of_jkr_and_bradley() {
    let workdir = workdir!();
    let load = |flags: &str| value(&workdir.succeed(format!("pull-off {LENS} {flags}")), "load");
    assert_close(load(""), -1.5 * PI * WORK * RADIUS, 1e-12);
    assert_close(
        load("--control displacement"),
        -PI * WORK * RADIUS * 5.0 / 6.0,
        1e-12,
    );
    let (bodies, _) = LENS.split_once(" --work-of-adhesion").expect("a work");
    let measured = format!("pull-off {bodies} --load=-0.1mN");
    let work = value(&workdir.succeed(measured), "work_of_adhesion");
    assert_close(work, 1e-4 / (1.5 * PI * RADIUS), 1e-12);
    let stiff = "pull-off --half-space --sphere-radius 1um --sphere-modulus inf --film-modulus 100GPa \
                 --film-poisson-ratio 0.5 --work-of-adhesion 40mJ/m^2 --interaction-range 5nm";
    let bradley = value(&workdir.succeed(stiff), "load");
    assert_close(bradley, -2.0 * PI * WORK * 1e-6, 1e-3);
}

/// Lee and Radok: a sphere that is pressed into a body whose modulus falls like t^(-1/2), at a constant speed.
#[test]
fn a_history_is_that_of_lee_and_radok() {
    let speed: f64 = 1e-6;
    let text = format!(
        "history --half-space --sphere-radius 1mm --sphere-modulus inf --film-modulus 3.5MPa --film-poisson-ratio 0.4 \
         --relaxation power-law -n 0.5 --reference-time 1 -p 'penetration 0:0 2:{}' --at 0.5,1,2",
        2.0 * speed
    );
    let reduced = 3.5e6 / (1.0 - 0.16);
    for row in workdir!().csv(text).cases() {
        let t = row.get("time");
        // The integral of (t - s)^(-1/2) times the rate of s^(3/2): 3/2 B(3/2, 1/2) t.
        let memory = 0.75 * PI * t;
        let load = 4.0 / 3.0 * RADIUS.sqrt() * reduced * speed.powf(1.5) * memory;
        assert_close(row.get("load"), load, 1e-7);
        assert_close(row.get("contact_radius"), (RADIUS * speed * t).sqrt(), 1e-7);
    }
}

#[test]
fn what_a_half_space_has_not_is_refused() {
    workdir!().refuses(
        "
        2 | curve --half-space --film-thickness 1um | --half-space; --film-thickness
        2 | curve --half-space --substrate-modulus 1GPa | --half-space; --substrate-modulus
        2 | curve embedded --half-space | --half-space; TABLE
        2 | curve --half-space --tolerance 1e-6 | --half-space; --tolerance
        2 | pull-off --half-space --interface sliding | --half-space; --interface
        2 | history --half-space --stack s.toml | --half-space; --stack
        1 | curve --half-space --friction stick | --friction stick; half-space; leave out --half-space
        1 | pull-off --half-space --sphere-radius 10um --load=-2uN | give --sphere-modulus, --film-modulus, --film-poisson-ratio;
        1 | curve --half-space --film-modulus 1e15Pa | the half-space's modulus = 1e15 Pa; check the units
        1 | history --half-space --relaxation power-law -n 0.2 -p 'penetration 0:0 1:1um' | --all-relax; --sphere-modulus inf
        ",
    );
}
