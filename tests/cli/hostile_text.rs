//! Text from files that would steer a terminal, or forge a line.

use acceptance::{Workdir, assert_names, workdir};

use crate::TWO_QUANTITIES;

/// A title of a window, a forged line, a colour in one character, and a direction of writing.
const TITLE: &str = "a\u{1b}]0;x\u{7}\ncertified error max 0\u{9b}31m\u{202e}b";
const SHOWN: &str = r"a\u{1b}]0;x\u{7}\u{a}certified error max 0\u{9b}31m\u{202e}b";

fn assert_harmless(text: &str) {
    let harmful = |c: char| (c.is_control() && c != '\n') || c == '\u{202e}';
    assert!(!text.contains(harmful), "{text:?}");
}

/// A folder with a scene of this title and its table.
fn workdir() -> Workdir {
    let workdir = workdir!();
    let title = TITLE
        .chars()
        .map(|c| format!("\\u{:04x}", u32::from(c)))
        .collect::<String>();
    workdir.write(
        "scene.toml",
        TWO_QUANTITIES
            .replace("'Two quantities'", &format!("\"{title}\""))
            .replace("1e-2", "1e-1"),
    );
    workdir
}

#[test]
fn titles_are_shown_escaped() {
    let workdir = workdir();
    let generate = "generate scene.toml -o x.h5 --certificate-points 20";
    let printed = workdir.succeed(generate);
    workdir.succeed("pack x.h5 -o x.bin");
    let pack = "pack x.h5 -o y.bin --tolerance 0.1 --points 20";
    for text in [
        printed,
        workdir.succeed("info x.h5"),
        workdir.succeed("info x.bin"),
        workdir.succeed(pack),
    ] {
        assert_harmless(&text);
        assert_names(&text, &[SHOWN]);
        let (rows, _) = text.split_once("\n\n").unwrap_or((&text, ""));
        let forged = |line: &&str| line.starts_with("certified error");
        assert_eq!(rows.lines().filter(forged).count(), 1, "{text}");
    }
    workdir.succeed("report x.h5 -o x.html");
    let page = workdir.text("x.html");
    assert_harmless(&page);
    assert_names(&page, &[&format!("<title>{SHOWN}</title>")]);
    let json = workdir.succeed("info x.h5 --json");
    assert_harmless(&json);
    assert_eq!(json.lines().count(), 1);
    let object = acceptance::json(&json);
    assert_eq!(object["title"], TITLE);
}

#[test]
fn errors_show_fields_and_names_escaped() {
    let workdir = workdir();
    workdir.write("bad.toml", "title = 'x'\nb = 'y' # \u{202e}\u{9b}31m\n");
    workdir.write(
        "bad\u{1b}[2J\n.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,\u{1b}[2J,0.5,1\n",
    );
    workdir.write("header.csv", "a_over_t,\u{1b}[2J\n1,1\n");
    workdir.write("costs.csv", "without,\u{1b}[2J\n\u{1b}[2J,1\n");
    for command in [
        "generate bad.toml",
        "solve --points 'bad\u{1b}[2J\n.csv'",
        "solve --points header.csv",
        "solve --points 'no\u{1b}[2J\n.csv'",
        "cost effects --data costs.csv",
        "info 'no\u{1b}[2J\n.h5'",
        "curve -o 'no\u{1b}[2J\n/x.csv'",
    ] {
        let message = workdir.fail(1, command);
        assert_harmless(&message);
        assert!(
            message.contains("\\u{1b}[2J") || message.contains("\\u{202e}\\u{9b}31m"),
            "{message}"
        );
        let is_toml = command.starts_with("generate");
        assert!(is_toml || message.lines().count() == 1, "{message}");
    }
    workdir.write("y\u{1b}[2J\n.toml", TWO_QUANTITIES);
    let printed = workdir.succeed("generate 'y\u{1b}[2J\n.toml' --certificate-points 20");
    assert_harmless(&printed);
    assert_names(&printed, &["written         y\\u{1b}[2J\\u{a}.h5 ("]);
}
