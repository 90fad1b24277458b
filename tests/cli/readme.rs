//! The READMEs show the examples that are compiled, and the certificate of the table that is
//! shipped.

use interp::Table;

use crate::copy_folders;

fn read(path: &str) -> String {
    let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

#[test]
fn shows_the_examples() {
    for (path, readme) in [
        ("crates/interp/examples/force.rs", "crates/interp/README.md"),
        (
            "crates/contact/examples/contact.rs",
            "crates/contact/README.md",
        ),
        ("crates/solve/examples/curve.rs", "crates/solve/README.md"),
        ("crates/fit/examples/file.rs", "crates/fit/EXPERIMENTS.md"),
    ] {
        let example = read(path);
        let lines = example.split_inclusive('\n');
        let program: String = lines.skip_while(|line| line.starts_with("//!")).collect();
        let block = format!("```rust\n{}```", program.trim_start());
        let readme_text = read(readme);
        assert!(readme_text.contains(&block), "{readme}: {path}");
        // What is said of a program of one's own names every crate that the example uses.
        if let Some((_, said)) = readme_text.split_once("cargo add ") {
            let (packages, _) = said.split_once('`').expect("the command ends");
            let uses = example.lines().filter_map(|line| line.strip_prefix("use "));
            for name in uses.filter_map(|path| path.split("::").next()) {
                let package = format!("coated-contact-{name}");
                let is_named = packages.split(' ').any(|named| named == package);
                assert!(name == "std" || is_named, "{readme}: {package}");
            }
        }
    }
}

/// The commands of the README that are followed by their output.
#[test]
fn shows_what_its_commands_print() {
    let readme = read("README.md");
    let mut shown = 0;
    let command_line = "\n    cargo run --release -p coated-contact-tabulate --no-default-features --features cli -- ";
    for block in readme.split(command_line).skip(1) {
        let Some((command, rest)) = block.split_once("\n\n```text\n") else {
            continue;
        };
        if command.contains('\n') {
            continue;
        }
        let (output, _) = rest.split_once("```").expect("the output ends");
        let printed = acceptance::workdir!().succeed(command);
        // Processors differ in the last digits of a solve, whose tolerance is 1e-8.
        let same = |a: &str, b: &str| {
            let numbers = a.parse::<f64>().ok().zip(b.parse::<f64>().ok());
            a == b || numbers.is_some_and(|(a, b)| (a / b - 1.0).abs() <= 1e-7)
        };
        let cells =
            |text: &str| -> Vec<String> { text.split([',', '\n']).map(str::to_owned).collect() };
        let (shown_cells, printed_cells) = (cells(output), cells(&printed));
        assert_eq!(shown_cells.len(), printed_cells.len(), "{command}");
        for (a, b) in shown_cells.iter().zip(&printed_cells) {
            assert!(same(a, b), "{command}: {a}, {b}");
        }
        shown += 1;
    }
    assert_eq!(shown, 1);
}

#[test]
fn quotes_the_certificates_of_the_shipped_tables() {
    for table in ["tables/paper.bin", "crates/interp/embedded/universal.bin"] {
        let path = format!("{}/../{table}", env!("CARGO_MANIFEST_DIR"));
        let shipped = Table::read(path).expect("a shipped table");
        let certificate = shipped.description().certificate;
        let [most, median] = [certificate.max_error, certificate.median_error];
        let quoted = format!("{most:.1e} ({median:.1e})");
        for file in ["README.md", "tables/README.md"] {
            assert!(read(file).contains(&quoted), "{file}: {quoted} of {table}");
        }
    }
}

/// Every command of the page about fits, with its output if it is shown.
#[test]
fn the_commands_of_the_fits_print_what_is_shown() {
    let readme = read("crates/fit/EXPERIMENTS.md");
    let workdir = acceptance::workdir!();
    copy_folders(&workdir, &["crates/fit/data", "crates/fit/examples"]);
    let mut shown = 0;
    for block in readme.split("\n\n    tabulate ").skip(1) {
        let (command, rest) = block.split_once("\n\n").expect("the block ends");
        let run = workdir.answer(command.replace('\\', ""));
        let mut notes = run.stderr.lines();
        assert!(
            notes.all(|note| note.contains("surface tension")),
            "{run:?}"
        );
        if let Some(rest) = rest.strip_prefix("```text\n") {
            let (output, _) = rest.split_once("```").expect("the output ends");
            assert_eq!(output, run.stdout, "{command}");
            shown += 1;
        }
    }
    assert_eq!(shown, 18);
}
