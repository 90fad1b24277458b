//! Quantities with a unit behind the number, negative values, and other mistakes.

use acceptance::{shipped, workdir};

#[test]
fn quantities_with_a_unit_are_those_in_si_units() {
    let workdir = workdir!();
    let pairs: [[&str; 2]; 5] = [
        [
            "curve embedded --film-thickness 1e-5 --film-modulus 3.5e6 --film-poisson-ratio 0.5 --substrate-modulus 2e11 \
             --substrate-poisson-ratio 0.25 --sphere-radius 1e-3 --sphere-modulus 2e6 --work-of-adhesion 0.04 \
             --from 2e-5 --to 1e-4 --points 4",
            "curve embedded --film-thickness 10\u{b5}m --film-modulus 3.5MPa --film-poisson-ratio 0.5 \
             --substrate-modulus 200GPa --substrate-poisson-ratio 0.25 --sphere-radius 0.1cm --sphere-modulus 2000kPa \
             --work-of-adhesion 40mN/m --from 20um --to 0.1mm --points 4",
        ],
        [
            "pull-off --specimen paper --interaction-range 5e-9 --control spring --stiffness 40 --sphere-radius 1e-5 \
             --work-of-adhesion 0.05",
            "pull-off --specimen paper --interaction-range 5nm --control spring --stiffness 40mN/mm --sphere-radius 10um \
             --work-of-adhesion 50mJ/m2",
        ],
        [
            "simulate --specimen paper --kind force-height --from 2e-6 --to -1e-6 --points 9 --noise 1e-9 --stiffness 0.1 \
             --value contact-point=2e-7 --value baseline=-1e-9 --segments approach",
            "simulate --specimen paper --kind force-height --from 2um --to -1um --points 9 --noise 1nN --stiffness 100pN/nm \
             --value contact-point=200nm --value baseline=-1nN --segments approach",
        ],
        [
            "solve --stack stack.toml --sphere-modulus 2e6 --a-over-t 6.5",
            "solve --stack stack.toml --sphere-modulus 2MPa --a-over-t 6.5",
        ],
        [
            "history --specimen paper --sphere-modulus inf --film-modulus 2e4 --film-thickness 1e-4 --relaxation prony --relaxed-fraction 0.2 \
             --relaxation-time 0.002,0.5 --relaxation-weight 0.3,0.5 --program 'penetration 0:0 0.001:1e-8 2:0' --at 5e-4,1.5",
            "history --specimen paper --sphere-modulus inf --film-modulus 20kPa --film-thickness 100um --relaxation prony --relaxed-fraction 0.2 \
             --relaxation-time 2ms,500ms --relaxation-weight 0.3,0.5 --program 'penetration 0s:0 1ms:10nm 2:0' --at 500us,1.5s",
        ],
    ];
    let stack = "base = { young_modulus = inf }\n[[layers]]\nyoung_modulus = 1e6\npoisson_ratio = 0.5\nthickness = 1e-5\n";
    workdir.write("stack.toml", stack);
    for pair in pairs {
        let [si, with_units] = pair.map(|command| {
            let text = workdir.succeed(command);
            // The comment of simulated data quotes the command.
            let lines = text.lines().filter(|line| !line.starts_with('#'));
            lines.map(str::to_owned).collect::<Vec<_>>()
        });
        assert_eq!(si, with_units, "{}", pair[1]);
    }
    // A space before the unit, in one argument.
    workdir.succeed("curve embedded --points 2 --film-thickness '1e-6 m'");
}

#[test]
fn a_fit_takes_units_in_every_setting() {
    let workdir = workdir!();
    let lens = shipped("../crates/fit/data/lens.csv");
    let fit = format!("fit {} --specimen paper --json", lens.display());
    let fit = |settings: &str| workdir.found(format!("{fit} {settings}"));
    let free = "--free sphere-modulus,film-thickness,work-of-adhesion";
    let si = format!(
        "{free} --film-thickness 3e-5 --noise 2e-6 --bounds sphere-modulus=1e5..1e8 --prior film-thickness=3e-5+-1e-6 \
         --value load-offset=1e-7"
    );
    let units = format!(
        "{free} --film-thickness 30um --noise 2uN --bounds sphere-modulus=0.1MPa..100MPa \
         --prior film-thickness=30um+-1um --value load-offset=100nN"
    );
    assert_eq!(fit(&si), fit(&units));
}

#[test]
fn a_negative_value_is_refused_with_the_reason() {
    let workdir = workdir!();
    workdir.refuses(
        "
        1 | curve --sphere-radius -1e-3 | sphere_radius = -0.001; above 0
        1 | curve --film-thickness -30um | film_thickness = -3e-5; above 0
        1 | curve --sphere-radius 0 | sphere_radius = 0.0; a radius or a thickness is above 0
        1 | curve --sphere-modulus -2e6 | sphere_modulus = -2000000.0; a modulus is above 0
        1 | curve --film-modulus -3.5MPa | film_modulus = -3500000.0; a modulus is above 0
        1 | curve --substrate-modulus -1e-3 | substrate_modulus = -0.001; a modulus is above 0
        1 | curve --work-of-adhesion -1e-2 | work_of_adhesion = -0.01; at least 0
        1 | curve --film-poisson-ratio -2e0 | film: Poisson ratio = -2.0
        1 | curve --from -1e-6 | --from is -1e-6 m
        1 | pull-off --control spring --stiffness -1e-3 | stiffness of the spring = -0.001
        1 | pull-off --interaction-range -1e-9 | interaction range = -1e-9
        1 | curve --tolerance -1e-3 | tolerance = -0.001
        1 | curve --tolerance 0.9e-12 --points 2 | tolerance = 9e-13; 1e-12 to 0.01
        1 | curve --probe cone --half-angle -1e1 | --half-angle -10.0
        1 | simulate --kind load-radius --from 1um --to 2um --noise -1e-6 | --noise -1e-6
        1 | solve --a-over-t -1e-3 --e1-over-e2 1 --nu1 0.5 --e0-over-e2 1 | a_over_t = -0.001
        ",
    );
}

#[test]
fn what_is_no_quantity_is_named_with_examples() {
    let workdir = workdir!();
    let simulate = "simulate --kind load-radius --from 1um --to 2um";
    workdir.refuses(format!(
        r#"
        2 | curve --sphere-radius 30GPa | a length is wanted; 30um
        2 | curve --film-modulus 30um | a modulus is wanted; 70GPa
        2 | curve --work-of-adhesion 1N | a work of adhesion is wanted; 40mJ/m^2
        2 | curve --film-poisson-ratio 0.5um | is a length; without a unit
        2 | curve --film-modulus 70gpa | "gpa"; case counts
        2 | curve --film-thickness 1,5um | "1,5um"; mark is a point
        2 | curve --film-thickness thin | "thin"; is not a number
        2 | curve --film-thickness --points | --points is a flag; is missing
        2 | curve --from 1N | a length is wanted; 30um
        1 | {simulate} --noise 1um | --noise; a force is wanted; 2uN
        2 | {simulate} --noise 0 --value load-offset=1nm | 1nm; a force is wanted
        2 | {simulate} --noise 0 --bounds film-modulus=1um..2um | 1um; a modulus is wanted
        "#
    ));
}
