//! What lies in the place of a generation's files, and what a journal says of its build.

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;

use acceptance::{Workdir, assert_names, start};

use crate::kept::with_header;

const SCENE: &str = "\
title = 'Three pieces'
tolerance = 1e-2
a_over_t = { from = 1, to = 2, nodes = 3 }
e1_over_e2 = { from = 1, to = 2, nodes = 3 }
nu1 = 0.5
e0_over_e2 = inf
";
const JOURNAL: &str = "table.h5.unfinished";
const GENERATE: &str = "generate scene.toml -o table.h5 --certificate-points 20";

fn workdir() -> Workdir {
    let workdir = acceptance::workdir!();
    workdir.write("scene.toml", SCENE);
    workdir
}

/// A folder with a generation that has finished one piece.
fn unfinished() -> Workdir {
    let workdir = workdir();
    let run = workdir.run(format!("{GENERATE} --budget 1e-9"));
    assert_eq!(run.status, 1, "{run:?}");
    assert_names(&run.stderr, &["with 3 of 9 points solved"]);
    workdir
}

#[test]
fn a_name_beside_the_table_is_nobodys_but_the_users() {
    let partial = "table.h5.partial";
    let workdir = workdir();
    workdir.write("precious", "mine");
    for kind in 0..4 {
        match kind {
            0 => symlink("precious", workdir.path(partial)).expect("a link"),
            1 => symlink("nowhere", workdir.path(partial)).expect("a link"),
            2 => fs::create_dir(workdir.path(partial)).expect("a folder"),
            _ => drop(workdir.write(partial, "mine too")),
        }
        workdir.succeed(GENERATE);
        assert_eq!(workdir.read("precious"), b"mine");
        assert_eq!(
            workdir.files(),
            ["precious", "scene.toml", "table.h5", partial]
        );
        match kind {
            0 | 1 => {
                assert!(workdir.path(partial).is_symlink());
                fs::remove_file(workdir.path(partial)).expect("removed");
            }
            2 => fs::remove_dir(workdir.path(partial)).expect("removed"),
            _ => assert_eq!(workdir.read(partial), b"mine too"),
        }
    }
}

#[test]
fn a_journal_that_is_no_file_is_refused_and_not_followed() {
    let workdir = workdir();
    workdir.write("empty", "");
    let mut make = start(Command::new("mkfifo").arg(workdir.path("pipe")));
    assert!(make.wait().expect("mkfifo runs").success());
    fs::create_dir(workdir.path("folder")).expect("a new folder");
    let files = workdir.files();
    for other in ["pipe", "empty", "folder", "nowhere"] {
        symlink(other, workdir.path(JOURNAL)).expect("a link");
        for more in ["", "--resume"] {
            let message = workdir.fail(1, format!("{GENERATE} {more}"));
            assert_names(&message, &["cannot write", JOURNAL, "it is no file"]);
        }
        fs::remove_file(workdir.path(JOURNAL)).expect("still there");
        assert_eq!(workdir.files(), files);
    }
    fs::rename(workdir.path("pipe"), workdir.path(JOURNAL)).expect("renamed");
    assert_names(&workdir.fail(1, GENERATE), &[JOURNAL, "it is no file"]);
    fs::remove_file(workdir.path(JOURNAL)).expect("still there");
    fs::rename(workdir.path("folder"), workdir.path(JOURNAL)).expect("renamed");
    assert_names(&workdir.fail(1, GENERATE), &[JOURNAL, "it is no file"]);
}

#[test]
fn pieces_of_another_build_or_processor_are_not_resumed() {
    let workdir = unfinished();
    let journal = workdir.read(JOURNAL);
    assert_eq!(with_header(&journal, str::to_owned), journal);
    let text = String::from_utf8_lossy(&journal).into_owned();
    let build = text.lines().find_map(|line| line.strip_prefix("build = "));
    let build = build.expect("the build is named").trim_matches('"');
    let (hash, processor) = build.split_once(" on ").expect("a build and a processor");
    for other in [
        format!("0000000000000000 on {processor}"),
        format!("{hash} on m68k"),
    ] {
        let changed = with_header(&journal, |header| header.replace(build, &other));
        workdir.write(JOURNAL, changed);
        workdir.refuses(format!("1 | {GENERATE} --resume | cannot resume; {JOURNAL}; another build; {other}; {build}; remove this file"));
    }
    workdir.write(JOURNAL, &journal);
    let resumed = workdir.succeed(format!("{GENERATE} --resume"));
    assert_names(&resumed, &["9 points (3 before they were resumed)"]);
}

/// The process is killed while it writes the table, which is longer than its journal.
#[test]
fn what_a_killed_generation_leaves_is_removed_by_the_next() {
    let workdir = workdir();
    for _ in 0..3 {
        let run = workdir.script(&format!(
            "ulimit -c 0; ulimit -f 12; \"$0\" {GENERATE} --resume; echo status $?"
        ));
        let is_killed = run.stdout.starts_with("status ") && run.stdout != "status 0\n";
        assert!(is_killed, "{run:?}");
        let files = workdir.files().into_iter();
        let hidden = files.filter(|name| name.starts_with(".table.h5.unfinished-"));
        assert_eq!(hidden.count(), 2, "{run:?}");
    }
    let run = workdir.run(format!("{GENERATE} --resume"));
    assert_eq!(run.status, 0, "{run:?}");
    assert_names(&run.stderr, &[".table.h5.unfinished-", "is removed"]);
    assert_eq!(workdir.files(), ["scene.toml", "table.h5"]);
}
