//! Numbers that no contact experiment has, and `--allow magnitudes`.

use acceptance::{assert_cases, assert_names, shipped, workdir};

#[test]
fn a_person_who_means_it_can_go_on() {
    let workdir = workdir!();
    let lens = shipped("../crates/fit/data/lens.csv");
    let fit = format!("fit {} --specimen paper", lens.display());
    let commands = [
        &*format!("{fit} --film-thickness 30um --sphere-radius 2"),
        "curve embedded --specimen paper --sphere-radius 2 --points 3",
        "pull-off embedded --specimen paper --film-modulus 3e12",
        "pull-off embedded --specimen paper --substrate-modulus 3e12",
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
