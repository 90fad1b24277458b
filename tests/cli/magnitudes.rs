//! Numbers that no contact experiment has, and `--allow magnitudes`.

use acceptance::{Data, Workdir, assert_cases, assert_names, workdir};

/// Writes the lens of the paper on a film of 30 um, with its numbers times factors.
fn lens(workdir: &Workdir, file: &str, factors: [f64; 2]) {
    let simulate = "simulate --specimen paper --kind load-radius --film-thickness 30um --from 42um --to 130um --noise 2uN \
                    -o exact.csv";
    workdir.succeed(simulate);
    let text = String::from_utf8(workdir.read("exact.csv")).expect("UTF-8");
    let mut scaled = String::from("contact_radius,load\n");
    for case in Data::parse("exact", &text).cases() {
        let [radius, load] = ["contact_radius", "load"].map(|name| case.get(name));
        scaled += &format!("{:?},{:?}\n", radius * factors[0], load * factors[1]);
    }
    workdir.write(file, scaled);
}

/// The command of a fit of the lens with more flags.
fn fit(file: &str, more: &str) -> String {
    let is_given = more.contains("--film-thickness");
    let thickness = if is_given {
        ""
    } else {
        "--film-thickness 30um"
    };
    format!("fit {file} --specimen paper --noise 2uN {thickness} {more}")
}

#[test]
fn a_wrong_unit_does_not_pass() {
    let workdir = workdir!();
    lens(&workdir, "lens.csv", [1.0, 1.0]);
    lens(&workdir, "mm.csv", [1e3, 1.0]);
    lens(&workdir, "mn.csv", [1.0, 1e3]);
    let cases = "
        lens.csv | --sphere-radius 2 | radius of the sphere = 2 m; 2 mm
        lens.csv | --film-thickness 30 | film thickness = 30 m; 30 um
        lens.csv | --sphere-radius 150um | half the radius of the sphere
        mm.csv |  | contact radius; below the radius of the sphere
        mn.csv |  | sphere-modulus; mN or uN taken for N
        ";
    assert_cases(cases, |[file, more, _]| {
        let message = workdir.fail(1, fit(file, more));
        let allows = message.contains("--allow magnitudes");
        assert!(allows || file == "mm.csv", "{message}");
        message
    });
    let sound = fit("lens.csv", "");
    let expected = workdir.succeed(&sound);
    let allowing = format!("{sound} --allow magnitudes");
    assert_eq!(workdir.succeed(&allowing), expected);
}

#[test]
fn a_person_who_means_it_can_go_on() {
    let workdir = workdir!();
    let commands = [
        "curve embedded --specimen paper --sphere-radius 2 --points 3",
        "pull-off embedded --specimen paper --film-modulus 3e12",
        "simulate --specimen paper --kind load-radius --from 1mm --to 2mm --noise 0 --sphere-radius 0.5 --film-thickness 1mm",
        "curve --specimen paper --points 2 --friction stick --work-of-adhesion-receding 40",
        "history --half-space --sphere-modulus inf --relaxation prony --relaxed-fraction 0.3 --relaxation-time 1 \
         --work-of-adhesion-receding 40 -p 'penetration 0:0 1:4um 2:-200um' --points 3",
    ];
    for command in commands {
        let message = workdir.fail(1, command);
        assert_names(&message, "--allow magnitudes; is above");
        workdir.succeed(format!("{command} --allow magnitudes"));
    }
    workdir.refuses("2 | curve --allow everything | everything; magnitudes");
}

/// A contact that would be wider than the sphere is told in the words of a person.
#[test]
fn a_contact_beyond_the_sphere_is_told_without_the_limits_of_the_search() {
    let workdir = workdir!();
    let wide = "pull-off --specimen paper --sphere-radius 100nm --control spring --stiffness 1uN/m --work-of-adhesion 10";
    let message = workdir.fail(1, wide);
    assert_names(
        &message,
        "above 1e-7 m; contact of this probe; smaller value",
    );
    assert!(!message.contains("1e-60"), "{message}");
}

/// MPa taken for Pa below a layer that is right, and the reverse: all layers are looked at.
#[test]
fn every_layer_of_a_stack_is_checked() {
    let workdir = workdir!();
    let cases = "
        inf | 0.02 | the modulus of a layer = 0.02 Pa
        inf | 7e13 | the modulus of a layer = 7e13 Pa
        7e12 | 2e5 | the modulus of the base = 7e12 Pa
        ";
    assert_cases(cases, |[base, gel, _]| {
        let layer = |young: &str| {
            format!("[[layers]]\nyoung_modulus = {young}\npoisson_ratio = 0.4\nthickness = 3e-6\n")
        };
        let layers = layer(gel) + &layer("2e5");
        let text = format!("base = {{ young_modulus = {base}, poisson_ratio = 0.3 }}\n{layers}");
        workdir.write("stack.toml", text);
        let lens = "--stack stack.toml --sphere-radius 100um --sphere-modulus inf --work-of-adhesion 1mJ/m^2";
        let pull_off = workdir.fail(1, format!("pull-off {lens}"));
        let message = workdir.fail(1, format!("curve {lens}"));
        assert_eq!(message, pull_off);
        message
    });
}
