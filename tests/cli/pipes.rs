//! Output that nobody reads to its end: `tabulate X | head -1`.

use std::io::pipe;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use acceptance::{arguments, assert_names, forged, shipped, workdir};
use interp::Table;

/// Runs the program in a folder. The readers of standard output and, if `both`, of standard error
/// are closed before it starts.
fn run_unread(folder: &Path, both: bool, args: &str) -> Output {
    let unread = || {
        let (reader, writer) = pipe().expect("a pipe");
        drop(reader);
        Stdio::from(writer)
    };
    let stderr = if both { unread() } else { Stdio::piped() };
    Command::new(env!("CARGO_BIN_EXE_tabulate-under-test"))
        .args(arguments(args))
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(unread())
        .stderr(stderr)
        .output()
        .expect("the program runs")
}

#[test]
fn a_closed_reader_is_no_failure_of_any_command() {
    let workdir = workdir!();
    let [table, points, costs] = ["paper.bin", "points.csv", "figures/table.csv"]
        .map(|name| shipped(name).display().to_string());
    workdir.write("scene.toml", crate::TWO_QUANTITIES.replace("1e-2", "1e-1"));
    let commands = [
        "--help",
        "--version",
        "help plot",
        "curve --help",
        "curve embedded --specimen paper",
        "curve --specimen paper",
        &format!("solve --points {points}"),
        &format!("query {table} --points {points}"),
        "info embedded --json",
        &format!("check {table} --points 20"),
        "generate scene.toml --plan",
        "generate scene.toml --certificate-points 20",
        &format!("cost table --data {costs}"),
        "completions zsh",
        "man",
    ];
    for args in commands {
        for both in [false, true] {
            let output = run_unread(&workdir.path("."), both, args);
            assert!(
                output.status.code() == Some(0) && output.stderr.is_empty(),
                "{args:?}: {output:?}"
            );
        }
    }
    assert!(workdir.files().contains(&"scene.h5".to_owned()));
}

#[test]
fn work_that_fails_ends_with_1_whoever_reads() {
    let workdir = workdir!();
    let sound = Table::read(shipped("paper.bin")).expect("a sound table");
    let wrong = forged(&sound, |_, _, value| 1.001 * value, |_| ()).expect("sound values");
    workdir.pack("wrong.bin", &wrong);
    for (args, status) in [
        ("check wrong.bin --points 20", 1),
        ("info missing.h5", 1),
        ("plough", 2),
    ] {
        for both in [false, true] {
            let output = run_unread(&workdir.path("."), both, args);
            let message = String::from_utf8(output.stderr).expect("UTF-8");
            assert_eq!(output.status.code(), Some(status), "{args:?}: {message}");
            assert!(!message.contains("panicked"), "{args:?}: {message}");
            assert_eq!(message.is_empty(), both, "{args:?}: {message}");
        }
    }
}

#[test]
fn output_that_cannot_be_written_ends_with_1() {
    let workdir = workdir!();
    let points = shipped("points.csv").display().to_string();
    let commands = [
        "--help",
        "-h",
        "help plot",
        "--version",
        "curve --help",
        "info embedded --json",
        &format!("query embedded --points {points}"),
        "completions zsh",
        "man",
    ];
    // A full disk, and standard output that is open for reading only.
    let cases = [
        (">/dev/full", "No space left"),
        ("1</dev/null", "Bad file descriptor"),
    ];
    for args in commands {
        for (redirection, why) in cases {
            let run = workdir.script(&format!("\"$0\" {args} {redirection}"));
            assert_eq!(run.status, 1, "{args:?} {redirection}: {run:?}");
            assert_names(&run.stderr, &["cannot write to standard output", why]);
        }
        assert_eq!(
            workdir.script(&format!("\"$0\" {args} >/dev/null")).status,
            0
        );
    }
}
