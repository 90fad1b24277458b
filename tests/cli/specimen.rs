//! What nobody gives: a fit asks for it, other commands name the values of the paper's example.

use acceptance::{Data, Workdir, assert_close, assert_names, number, rows, workdir};
use serde_json::Value;

/// The flags of the paper's system, and the questions that a fit asks without them.
const PAPER: &str = "
    --sphere-radius | 1mm | radius of the sphere
    --sphere-modulus | 2MPa | how stiff is the sphere?
    --film-thickness | 1um | how thick is the film?
    --film-modulus | 3.5MPa | Young's modulus of the film?
    --film-poisson-ratio | 0.5 | Poisson ratio of the film?
    --substrate-modulus | 200GPa | Young's modulus of the substrate?
    --substrate-poisson-ratio | 0.25 | Poisson ratio of the substrate?
    --work-of-adhesion | 40mJ/m^2 | what is the work of adhesion?
    ";

/// Returns the flags of the paper's system without some of them.
fn without(left_out: &str) -> String {
    let is_left_out = |flag: &str| left_out.split(' ').any(|one| one == flag);
    let flags = rows::<3>(PAPER).into_iter();
    let flags = flags.filter(|[flag, ..]| !is_left_out(flag));
    flags
        .map(|[flag, value, _]| format!("{flag} {value} "))
        .collect()
}

/// Writes a lens on a film of 30 um, a gel under a cantilever, and depths against radii.
fn measured() -> Workdir {
    let workdir = workdir!();
    let all = without("--film-thickness");
    let lens = "simulate --kind load-radius --film-thickness 30um --from 42um --to 130um --noise 2uN -o lens.csv";
    let gel = "simulate --kind force-height --film-thickness 30um --stiffness 0.1N/m --from 1um --to -1um --noise 1nN \
               -o gel.csv";
    let depths = "simulate --kind penetration-radius --film-thickness 30um --from 42um --to 130um --noise 10nm -o depths.csv";
    for command in [lens, gel, depths] {
        workdir.succeed(format!("{command} {all}"));
    }
    workdir
}

#[test]
fn a_fit_lists_all_that_is_missing_at_once_and_no_more() {
    let workdir = measured();
    let stack = "base = { young_modulus = inf }\n[[layers]]\nyoung_modulus = 1e6\npoisson_ratio = 0.5\n\
                 thickness = 1e-5\nname = \"top\"\n";
    workdir.write("stack.toml", stack);
    // By default the modulus of the sphere and the work of adhesion are free: they need no value, nor does
    // the modulus of the film under a rigid sphere. Of two moduli the data tell the start of one, and of none
    // without loads. Each file has its own value.
    let cases = "
        lens.csv | sphere-radius film-thickness film-modulus film-poisson-ratio substrate-modulus substrate-poisson-ratio
        gel.csv | sphere-radius film-thickness film-modulus film-poisson-ratio substrate-modulus substrate-poisson-ratio stiffness
        gel.csv --sphere-modulus inf | sphere-radius film-thickness film-poisson-ratio substrate-modulus substrate-poisson-ratio stiffness
        gel.csv --sphere-modulus inf --substrate-modulus inf --stiffness 1 | sphere-radius film-thickness film-poisson-ratio
        lens.csv --half-space | sphere-radius film-modulus film-poisson-ratio
        lens.csv --stack stack.toml | sphere-radius
        lens.csv --stack stack.toml --free top.modulus | sphere-radius sphere-modulus work-of-adhesion
        lens.csv --probe cone --half-angle 70 --half-space | film-modulus film-poisson-ratio
        lens.csv --half-space --free sphere-modulus,film-modulus,work-of-adhesion | sphere-radius film-modulus film-poisson-ratio
        depths.csv --half-space --free sphere-modulus,contact-point | sphere-radius sphere-modulus film-modulus film-poisson-ratio work-of-adhesion
        lens.csv lens.csv --value film-thickness=30um,1um --value film-modulus=1MPa | sphere-radius film-poisson-ratio substrate-modulus substrate-poisson-ratio
        ";
    for [more, missing] in rows(cases) {
        let message = workdir.fail(1, format!("fit {more}"));
        let is_missing = |flag: &str| missing.split(' ').any(|name| flag == format!("--{name}"));
        for [flag, _, question] in rows(PAPER) {
            let asked = message.contains(&format!("{flag} is missing: "));
            assert_eq!(asked, is_missing(flag), "{more:?}: {flag}: {message}");
            assert_eq!(message.contains(question), asked, "{more:?}: {message}");
        }
        let film_modulus = is_missing("--film-modulus") && !more.contains("film-modulus");
        let is_named = message.contains("name film-modulus in --free");
        assert_eq!(is_named, film_modulus, "{message}");
        let is_advised = message.contains("give --half-space");
        assert!(!(more.contains("--half-space") && is_advised), "{message}");
        let stiffness = message.contains("--stiffness");
        assert_eq!(stiffness, is_missing("--stiffness"), "{message}");
        assert_names(&message, "--specimen paper");
    }
    let both = "fit lens.csv --half-space --free sphere-modulus,film-modulus";
    workdir.refuses(format!("1 | {both} | starts from it: a guess will do"));
}

#[test]
fn a_free_modulus_and_a_free_work_of_adhesion_need_no_value() {
    let workdir = measured();
    let fit = |more: &str| -> Value {
        let known = without("--sphere-modulus --work-of-adhesion --film-thickness");
        let arguments = "fit lens.csv --json --film-thickness 30um";
        workdir.found(format!("{arguments} {known} {more}"))
    };
    let found = fit("");
    assert_close(number(&found, "parameters/sphere_modulus/value"), 2e6, 0.02);
    // A value that is given for them changes nothing.
    for value in ["1kPa", "1GPa"] {
        let given = format!("--sphere-modulus {value} --work-of-adhesion 1J/m^2");
        assert_eq!(found, fit(&given));
    }
}

#[test]
fn the_specimen_of_the_paper_stands_in_where_it_is_asked_for() {
    let workdir = measured();
    let fit = |known: &str| {
        let arguments = "fit lens.csv --json --film-thickness 30um";
        workdir.found(format!("{arguments} {known}"))
    };
    let all = without("--film-thickness --sphere-modulus --work-of-adhesion");
    assert_eq!(fit("--specimen paper"), fit(&all));
    // The stiffness is of no specimen.
    workdir.refuses("1 | fit gel.csv --specimen paper | gel.csv; --stiffness");
}

#[test]
fn other_commands_name_the_values_of_the_example_in_a_comment_line() {
    let workdir = workdir!();
    let range = "--from 40um --to 50um";
    let simulate = format!("simulate --kind load-radius --noise 0 {range}");
    let commands = [
        "curve embedded --points 2",
        "pull-off embedded --json",
        &simulate,
    ];
    for command in commands {
        let plain = workdir.answer(command);
        assert_eq!(plain.stderr.lines().count(), 1, "{plain:?}");
        assert!(plain.stderr.starts_with("# "), "{plain:?}");
        for [flag, value, _] in rows(PAPER) {
            let name = flag.trim_start_matches('-').replace('-', "_");
            assert_names(&plain.stderr, &[&format!("{name} = {value}")]);
        }
        // The data do not change, but for the command that the comment of simulated ones quotes.
        let data = |text: &str| -> Vec<String> {
            let lines = text.lines().filter(|line| !line.starts_with('#'));
            lines.map(str::to_owned).collect()
        };
        for more in ["--specimen paper", &without("")] {
            let run = workdir.run(format!("{command} {more}"));
            assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{command:?}");
            assert_eq!(data(&run.stdout), data(&plain.stdout), "{command:?}");
        }
        let most = without("--film-modulus");
        let run = workdir.run(format!("{command} {most}"));
        assert_names(&run.stderr, &["# ", ": film_modulus = 3.5MPa\n"]);
        assert!(!run.stderr.contains(','), "{run:?}");
    }
    // Of a stack the specimen has the probe only, and a rigid substrate needs no Poisson ratio.
    let stack = "base = { young_modulus = inf }\n[[layers]]\nyoung_modulus = 1e6\npoisson_ratio = 0.5\nthickness = 1e-5\n";
    workdir.write("stack.toml", stack);
    let run = workdir.run("curve --stack stack.toml --to 2e-5 --points 2");
    let is_of_film = run.stderr.contains("film") || run.stderr.contains("substrate");
    assert!(!is_of_film, "{run:?}");
    let words = "sphere_radius; sphere_modulus; work_of_adhesion";
    assert_names(&run.stderr, words);
    let rigid = "--substrate-modulus inf";
    let known = without("--substrate-modulus --substrate-poisson-ratio");
    let run = workdir.run(format!("curve embedded --points 2 {rigid} {known}"));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    assert_eq!(Data::parse("curve", &run.stdout).cases().count(), 2);
}
