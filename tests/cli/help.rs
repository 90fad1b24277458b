//! Help, examples, usage and exit status; completions and man pages.

use acceptance::{Workdir, assert_names, rows, workdir};

use crate::copy_folders;

#[test]
fn the_help_of_every_command_has_its_arguments_and_the_program_says_whose_modulus() {
    let workdir = workdir!();
    let commands = "
        generate | SCENE.toml -o --output TABLE.h5 --tolerance --jobs --resume --plan --budget --certificate-points --seed
        solve | --a-over-t --e1-over-e2 --nu1 --e0-over-e2 --nu0 --tolerance --json --points --stack --sphere-modulus -o --output
        query | TABLE --points -o --output
        curve | TABLE --stack --film-thickness --sphere-radius --work-of-adhesion --sphere-modulus -o --output
        history | TABLE --relaxation --relaxation-exponent --relaxed-fraction --relaxation-time --program --stiffness --points --at
        fit | DATA --kind --free --stiffness --robust --noise --json --csv --plot --plot-kind --column --sphere-modulus --film-thickness --specimen --allow
        simulate | --kind --noise --seed --from --to --expect --specimen
        info | TABLE
        report | TABLE -o --output REPORT.html
        plot | fig2 fig3 fig4 force-displacement
        plot fig2 | -o --output FILE.svg|FILE.png
        plot error-map | [TABLE] -o --output
        cost | solve
        check | TABLE --points --seed
        unpack | TABLE.bin -o --output TABLE.h5
        pack | TABLE.h5 -o --output TABLE.bin --tolerance --points --seed
        ";
    let program = workdir.succeed("--help");
    let words = "generate; solve; query; curve; info; check; pack; unpack; cost; REDUCED; 30um, 70GPa; E2* = E2/(1 - nu2^2); inf";
    assert_names(&program, words);
    for [command, arguments] in rows(commands) {
        let help = workdir.succeed(format!("{command} --help"));
        assert_names(&help, &arguments.split(' ').collect::<Vec<_>>());
        assert_names(&help, &[&format!("Usage: tabulate {command}")]);
    }
    assert_names(&workdir.succeed("history --help"), &["flow of its solvent"]);
    for command in ["solve", "curve"] {
        assert_names(
            &workdir.succeed(format!("{command} --help")),
            "educed modulus E2*; inf",
        );
    }
    assert_names(
        &workdir.succeed("--version"),
        &["tabulate ", env!("CARGO_PKG_VERSION")],
    );
}

#[test]
fn wrong_usage_ends_with_2_and_failed_work_with_1() {
    let workdir = workdir!();
    workdir.write_points("1,1,0.5,inf\n");
    let one = "solve --a-over-t 1 --e1-over-e2 1 --nu1 0.5 --e0-over-e2 inf";
    workdir.refuses(format!(
        "
        2 |  | Usage
        2 | plough | plough
        2 | {one} --plough | --plough
        2 | solve --a-over-t 1 --e1-over-e2 1 --nu1 0.5 | --e0-over-e2
        2 | {one} --nu0 quarter | quarter
        2 | {one} --points points.csv | --points
        2 | {one} -o out.csv | --output
        2 | solve --points points.csv --json | --json
        2 | query table.h5 | --points
        2 | pack table.h5 | --output
        2 | report table.h5 | --output
        2 | curve table.h5 --tolerance 1e-3 | --tolerance
        1 | {one} --nu0 0.6 | nu0; 0.6; (-1, 0.5]
        1 | {one} --nu0 nan | nu0; NaN
        1 | {one} --tolerance 1e-20 | tolerance; 1e-20
        1 | solve --a-over-t -1 --e1-over-e2 1 --nu1 0.5 --e0-over-e2 inf | a_over_t; -1; 1e-6; 10000
        1 | solve --points missing.csv | missing.csv
        1 | query missing.h5 --points points.csv | missing.h5
        1 | info points.csv | points.csv
        1 | pack points.csv -o table.bin | not a coated-contact table
        1 | curve --film-poisson-ratio 0.6 | film; Poisson ratio; 0.6
        "
    ));
    workdir.succeed(one);
    assert_eq!(workdir.files(), ["points.csv"]);
}

/// The beginning of an example in a help text.
const EXAMPLE: &str = "  tabulate";

/// Examples that take too long for a test. Other tests run most of these commands on smaller input.
const LONG: [&str; 12] = [
    "tabulate generate                                  # the default scene: a million contacts",
    "tabulate report tables/paper.h5 -o paper.html",
    "tabulate report embedded -o report.html",
    "tabulate report embedded --probe flat-punch --sphere-radius 1e-5 -o punch.html",
    "tabulate unpack embedded -o universal.h5",
    "tabulate plot error-map tables/paper.h5 -o errors.svg",
    "tabulate cost solve -o solve.csv",
    "tabulate cost table --budget 20 -o table.csv",
    "tabulate cost table --to 1e-4",
    "tabulate cost lookup tables/paper.h5 -o lookup.csv",
    "tabulate cost effects tables/incompressible.toml --tolerance 1e-3 --points 1000",
    "tabulate cost history -o history.csv",
];

/// The name of a command, word by word, and its help.
type Help = (Vec<String>, String);

/// Returns the help of the program and of every command.
fn helps(workdir: &Workdir) -> Vec<Help> {
    let mut helps: Vec<Help> = vec![(vec![], workdir.succeed("--help"))];
    let mut read = 0;
    while let Some((name, text)) = helps.get(read).cloned() {
        for command in commands(&text) {
            let name: Vec<String> = name.iter().cloned().chain([command]).collect();
            let text = workdir.succeed(format!("{} --help", name.join(" ")));
            helps.push((name, text));
        }
        read += 1;
    }
    helps
}

/// Returns the commands that a help lists, without `help` itself.
fn commands(help: &str) -> Vec<String> {
    let Some((_, list)) = help.split_once("\nCommands:\n") else {
        return vec![];
    };
    let lines = list.lines().take_while(|line| !line.is_empty());
    lines
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next())
        .filter(|name| !name.is_empty() && *name != "help")
        .map(str::to_owned)
        .collect()
}

fn examples(help: &str) -> Vec<&str> {
    help.split_once("\nExamples")
        .map_or("", |(_, section)| section)
        .lines()
        .filter(|line| line.starts_with(EXAMPLE))
        .map(str::trim)
        .collect()
}

#[test]
fn every_help_shows_examples_and_names_moduli_with_the_star() {
    let helps = helps(&workdir!());
    assert!(helps.len() > 25, "{} commands", helps.len());
    for (name, text) in &helps {
        let examples = examples(text);
        assert!(!examples.is_empty(), "{name:?} has no example");
        let command = ["tabulate".to_owned()]
            .into_iter()
            .chain(name.clone())
            .collect::<Vec<_>>()
            .join(" ");
        for example in examples {
            assert!(example.starts_with(&command), "{name:?}: {example}");
        }
        let unstarred = text.replace("E1/E2*", "").replace("E0/E2*", "");
        for modulus in ["E1/E2", "E0/E2"] {
            assert!(!unstarred.contains(modulus), "{name:?}: {modulus}");
        }
    }
}

#[test]
fn the_examples_work_when_pasted_at_the_root_of_the_repository() {
    let workdir = workdir!();
    copy_folders(
        &workdir,
        &[
            "tables",
            "tables/figures",
            "tables/stacks",
            "crates/fit/data",
        ],
    );
    let helps = helps(&workdir);
    let mut left: Vec<&str> = helps.iter().flat_map(|(_, text)| examples(text)).collect();
    left.sort_unstable();
    left.dedup();
    for long in LONG {
        let place = left.iter().position(|example| *example == long);
        left.remove(place.unwrap_or_else(|| panic!("no help shows {long:?}")));
    }
    assert!(left.len() > 25, "{left:?}");
    for example in left {
        let run = workdir.script(&format!("tabulate() {{ \"$0\" \"$@\"; }}\n{example}"));
        assert!(
            run.status == 0 && run.stderr.is_empty(),
            "{example}: {run:?}"
        );
        let words: Vec<&str> = example.split_whitespace().collect();
        let output = words.windows(2).find(|pair| ["-o", ">"].contains(&pair[0]));
        let (text, file) = match output {
            Some(pair) => (run.stdout, workdir.read(pair[1])),
            None => (String::new(), run.stdout.into_bytes()),
        };
        assert!(file.len() > 30, "{example} leaves {file:?} and {text:?}");
    }
}

#[test]
fn completions_and_man_pages_mention_every_command_and_option() {
    let workdir = workdir!();
    let helps = helps(&workdir);
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = workdir.succeed(format!("completions {shell}"));
        for (name, _) in &helps {
            if let Some(last) = name.last() {
                assert!(script.contains(last), "{shell}: {name:?}");
            }
        }
        assert_names(&script, &["film-thickness", "certificate-points"]);
    }
    // A shell can read it, where there is one. Bash warns of a locale that is not installed.
    let run = workdir
        .script("command -v bash >/dev/null || exit 0\n\"$0\" completions bash | LC_ALL=C bash -n");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));

    for (name, text) in &helps {
        let page = workdir.succeed(format!("man {}", name.join(" ")));
        let page = page.replace('\\', "");
        let title = [&["tabulate".to_owned()][..], name].concat().join("-");
        assert_names(&page, &[&format!(".TH {title} 1"), ".SH EXAMPLES"]);
        for command in commands(text) {
            assert_names(&page, &[&format!("{title}-{command}(1)")]);
        }
        let options = text.split_whitespace().filter(|word| {
            word.strip_prefix("--")
                .is_some_and(|name| name.chars().all(|c| c.is_ascii_lowercase() || c == '-'))
        });
        assert_names(&page, &options.collect::<Vec<_>>());
    }
    assert_names(&workdir.fail(1, "man plough"), &["plough", "curve"]);
    assert_names(
        &workdir.fail(1, "man curve extra"),
        &["`curve` has no commands of its own"],
    );
}

#[test]
fn a_file_is_not_given_the_ending_of_another_format() {
    let workdir = workdir!();
    for command in [
        "generate -o table.bin --plan",
        "unpack embedded -o table.BIN",
        "pack embedded -o table.h5",
        // Those of scenes, measurements, pages and figures.
        "unpack embedded -o table.csv",
        "pack embedded -o table.toml",
    ] {
        let message = workdir.fail(2, command);
        assert_names(&message, &["table.", "let the name end in .", "pack"]);
    }
    assert!(workdir.files().is_empty());
}
