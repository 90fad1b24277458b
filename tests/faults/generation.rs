//! What may happen while a table is made: processes that are killed, disks that are full, folders
//! that are read-only, two at a time. Real processes.

use std::fs;
use std::process::Command;
use std::sync::LazyLock;
use std::thread::sleep;
use std::time::{Duration, Instant};

use acceptance::{Contacts, Desk, assert_names, checksum};
use interp::Table;

/// Some 40 pieces and 16,000 points: about half a second on one thread.
const SCENE: &str = "\
title = 'Incompressible films'
tolerance = 1e-6
a_over_t = { from = 1e-2, to = 1e2 }
e1_over_e2 = { from = 1e-2, to = 1e2 }
nu1 = 0.5
e0_over_e2 = { from = 1, to = 1e4 }
";
const JOURNAL: &str = "table.h5.unfinished";
const GENERATE: [&str; 6] = [
    "generate",
    "scene.toml",
    "-o",
    "table.h5",
    "--certificate-points",
    "300",
];
const RESUME: [&str; 7] = [
    "generate",
    "scene.toml",
    "-o",
    "table.h5",
    "--certificate-points",
    "300",
    "--resume",
];

fn desk() -> Desk {
    let desk = Desk::new(env!("CARGO_BIN_EXE_tabulate-under-test"));
    desk.write("scene.toml", SCENE);
    desk
}

/// The file of an uninterrupted run on one thread.
static WHOLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let desk = desk();
    desk.succeed(&[&GENERATE[..], &["--jobs", "1"]].concat());
    assert_eq!(desk.files(), ["scene.toml", "table.h5"]);
    desk.read("table.h5")
});

/// Starts a run and kills it when its journal has reached so many bytes. Returns false if it had
/// finished before.
fn kill_at(desk: &Desk, args: &[&str], bytes: u64, signal: &str) -> bool {
    let mut child = desk.start(args);
    let start = Instant::now();
    loop {
        if child.try_wait().expect("its status").is_some() {
            return false;
        }
        if fs::metadata(desk.path(JOURNAL)).is_ok_and(|data| data.len() >= bytes) {
            break;
        }
        assert!(
            start.elapsed() < Duration::from_secs(60),
            "no {bytes} bytes after a minute"
        );
        sleep(Duration::from_micros(200));
    }
    assert!(
        Command::new("kill")
            .args([signal, &child.id().to_string()])
            .status()
            .expect("kill runs")
            .success()
    );
    child.wait().expect("it ends");
    true
}

/// An unfinished run with at least `bytes` in its journal.
fn unfinished(bytes: u64) -> Desk {
    let desk = desk();
    assert!(
        kill_at(&desk, &GENERATE, bytes, "-KILL"),
        "it finished before it was killed"
    );
    desk
}

fn assert_finished(desk: &Desk) {
    assert_eq!(desk.files(), ["scene.toml", "table.h5"]);
    assert!(
        desk.read("table.h5") == *WHOLE,
        "the table differs from that of an uninterrupted run"
    );
}

#[test]
fn killed_at_random_moments_and_resumed_with_any_number_of_jobs_the_file_is_the_same_to_the_byte() {
    let mut random = Contacts::new(71);
    let mut kills = 0;
    for signal in ["-KILL", "-KILL", "-INT", "-TERM"] {
        let desk = desk();
        desk.write("table.h5", "what was there");
        loop {
            let jobs = ["1", "2", "5"][random.uniform(0.0, 3.0) as usize];
            let mut child = desk.start(&[&RESUME[..], &["--jobs", jobs]].concat());
            // Moments of every stage: planning, solving, checking, writing.
            sleep(Duration::from_secs_f64(random.uniform(0.0, 0.8)));
            if let Some(status) = child.try_wait().expect("its status") {
                assert!(status.success());
                break;
            }
            assert!(
                Command::new("kill")
                    .args([signal, &child.id().to_string()])
                    .status()
                    .expect("kill runs")
                    .success()
            );
            if child.wait().expect("it ends").success() {
                break;
            }
            kills += 1;
            let table = desk.read("table.h5");
            assert!(
                table == *WHOLE || table == b"what was there",
                "half a table"
            );
            if kills > 100 {
                desk.succeed(&RESUME);
                break;
            }
        }
        assert_finished(&desk);
    }
    println!("killed {kills} times");
    assert!(kills >= 4);
}

#[test]
fn what_is_finished_is_not_solved_again() {
    let length = WHOLE.len() as u64;
    let desk = unfinished(length / 2);
    let text = desk.succeed(&RESUME);
    let line = text
        .lines()
        .find(|line| line.starts_with("solved"))
        .expect("a line on what was solved");
    let numbers: Vec<usize> = line
        .split(|c: char| !c.is_ascii_digit())
        .filter_map(|word| word.parse().ok())
        .collect();
    println!("{line}");
    assert!(
        line.contains("before") && numbers[1] > 0 && numbers[1] < numbers[0],
        "{line}"
    );
    assert_finished(&desk);
    // There is nothing to go on from, so this begins at the beginning.
    let again = desk.succeed(&RESUME);
    assert!(!again.contains("before"), "{again}");
    assert_finished(&desk);
}

#[test]
fn a_torn_or_damaged_end_of_the_journal_is_solved_again() {
    let desk = unfinished(100_000);
    let journal = desk.read(JOURNAL);
    let mut random = Contacts::new(72);
    for i in 0..16 {
        let mut torn = journal.clone();
        let at = random.uniform(0.0, journal.len() as f64) as usize;
        match i % 4 {
            0 => torn.truncate(at),
            1 => torn.extend(vec![0xff; at % 100 + 1]),
            // What a loss of power may leave.
            2 => torn.extend(vec![0; at % 5000 + 1]),
            // Damage to the header, in the first bytes, is an error; see below.
            _ => torn[at.max(1500)] ^= 0x10,
        }
        desk.write(JOURNAL, &torn);
        desk.succeed(&RESUME);
        assert_finished(&desk);
    }
}

/// A record of the journal.
fn record(number: u64, bytes: &[u8]) -> Vec<u8> {
    [
        &number.to_le_bytes()[..],
        &(bytes.len() as u64).to_le_bytes(),
        &checksum(bytes).to_le_bytes(),
        bytes,
    ]
    .concat()
}

#[test]
fn a_sound_record_that_is_no_piece_is_dropped() {
    let desk = unfinished(100_000);
    let journal = desk.read(JOURNAL);
    for forged in [
        record(0, b"short"),
        record(1, &[0; 8]),
        record(1_000_000, &[1; 16]),
        record(u64::MAX, b"a second header"),
    ] {
        desk.write(JOURNAL, [&journal[..], &forged].concat());
        desk.succeed(&RESUME);
        assert_finished(&desk);
    }
}

#[test]
fn a_header_that_is_damaged_or_of_other_nodes_is_an_error_and_nothing_is_lost() {
    let desk = unfinished(100_000);
    let journal = desk.read(JOURNAL);
    let length = u64::from_le_bytes(journal[16..24].try_into().expect("eight bytes")) as usize;
    let (header, pieces) = journal[28..].split_at(length);
    let header = String::from_utf8(header.to_vec()).expect("UTF-8");
    let with =
        |header: &str| [&journal[..8], &record(u64::MAX, header.as_bytes()), pieces].concat();
    assert_eq!(with(&header), journal);
    let nodes = header
        .lines()
        .find(|line| line.starts_with("nodes = "))
        .expect("the first axis");
    let mut damaged = journal.clone();
    damaged[100] ^= 1;
    let mut cases = vec![
        (damaged, "cannot be read"),
        (with(&(header.clone() + "more = 1\n")), "cannot be read"),
    ];
    for wrong in ["0", "1", "20000", "100000000000", "9223372036854775807"] {
        cases.push((
            with(&header.replacen(nodes, &format!("nodes = {wrong}"), 1)),
            "not the scene's",
        ));
    }
    cases.push((
        with(&header.replacen("from = 0.01", "from = -1.0", 1)),
        "not the scene's",
    ));
    for (forged, words) in cases {
        desk.write(JOURNAL, &forged);
        assert_names(
            &desk.fail(1, &RESUME),
            &["cannot resume", JOURNAL, words, "without --resume"],
        );
        assert!(desk.read(JOURNAL) == forged, "the journal has changed");
    }
    assert_eq!(desk.run(&GENERATE).status, 0);
    assert_finished(&desk);
}

/// A refined plan depends on the certificate: the file must not depend on who refined it.
#[test]
fn a_refined_run_is_resumed_with_its_own_certificate_only() {
    let desk = desk();
    // The first plan misses the tolerance.
    desk.write(
        "scene.toml",
        "title = 'x'\ntolerance = 2e-2\na_over_t = { from = 0.01, to = 100 }\ne1_over_e2 = { from = 1e-2, to = 1e2 }\n\
         nu1 = { from = 0, to = 0.5 }\ne0_over_e2 = { from = 1e-3, to = 1e3 }\n",
    );
    let generate = ["generate", "scene.toml", "-o", "table.h5", "--resume"];
    assert_names(&desk.succeed(&generate), &["refined"]);
    let whole = desk.read("table.h5");
    let mut child = desk.start(&generate);
    let refined = || {
        fs::read(desk.path(JOURNAL))
            .is_ok_and(|bytes| bytes.windows(9).any(|word| word == b"round = 1"))
    };
    while !refined() {
        assert!(
            child.try_wait().expect("its status").is_none(),
            "it finished before it was killed"
        );
        sleep(Duration::from_millis(1));
    }
    child.kill().expect("it runs");
    child.wait().expect("it ends");
    for other in [["--seed", "2"], ["--certificate-points", "300"]] {
        let message = desk.fail(1, &[&generate[..], &other].concat());
        assert_names(
            &message,
            &["cannot resume", "--certificate-points 10000 --seed 1"],
        );
    }
    assert!(refined());
    desk.succeed(&[&generate[..], &["--jobs", "1"]].concat());
    assert!(
        desk.read("table.h5") == whole,
        "the table differs from that of an uninterrupted run"
    );
}

#[test]
fn a_file_in_the_place_of_the_journal_is_not_touched() {
    let desk = desk();
    desk.write(JOURNAL, "notes of mine");
    for args in [&GENERATE[..], &RESUME] {
        assert_names(&desk.fail(1, args), &[JOURNAL, "is not the journal"]);
    }
    assert_eq!(desk.read(JOURNAL), b"notes of mine");
}

#[test]
fn without_resume_a_run_begins_anew_and_says_so() {
    let desk = unfinished(100_000);
    let run = desk.run(&GENERATE);
    assert_eq!(run.status, 0);
    assert_names(&run.stderr, &["dropped", "--resume"]);
    assert!(!run.stdout.contains("before"), "{}", run.stdout);
    assert_finished(&desk);
}

#[test]
fn a_scene_that_has_changed_is_not_resumed_and_nothing_is_lost() {
    let desk = unfinished(100_000);
    let journal = desk.read(JOURNAL);
    desk.write("scene.toml", SCENE.replace("to = 1e4 ", "to = 2e4 "));
    assert_names(
        &desk.fail(1, &RESUME),
        &["cannot resume", JOURNAL, "another text of the scene"],
    );
    desk.write("scene.toml", SCENE);
    let other = [&RESUME[..], &["--tolerance", "1e-4"]].concat();
    assert_names(
        &desk.fail(1, &other),
        &["cannot resume", "tolerance = 1e-6", "0.0001"],
    );
    assert!(desk.read(JOURNAL) == journal, "the journal has changed");
    desk.succeed(&RESUME);
    assert_finished(&desk);
}

#[test]
fn of_two_generators_on_one_output_the_second_says_so() {
    let desk = desk();
    let first = desk.start(&GENERATE);
    while !desk.path(JOURNAL).exists() {
        sleep(Duration::from_millis(1));
    }
    for second in [&GENERATE[..], &RESUME] {
        assert_names(
            &desk.fail(1, second),
            &["table.h5", "being made by another process"],
        );
    }
    assert_eq!(desk.end(&GENERATE, first).status, 0);
    assert_finished(&desk);
}

#[test]
fn links_to_one_output_are_one_output_on_its_own_disk() {
    let desk = desk();
    fs::create_dir(desk.path("folder")).expect("a new folder");
    desk.write("folder/real.h5", "what was there");
    std::os::unix::fs::symlink("folder/real.h5", desk.path("table.h5")).expect("a link");
    let first = desk.start(&GENERATE);
    while !desk.path("folder/real.h5.unfinished").exists() {
        sleep(Duration::from_millis(1));
    }
    let second = ["generate", "scene.toml", "-o", "folder/real.h5"];
    assert_names(
        &desk.fail(1, &second),
        &["real.h5", "being made by another process"],
    );
    assert_eq!(desk.files(), ["folder", "scene.toml", "table.h5"]);
    assert_eq!(desk.end(&GENERATE, first).status, 0);
    assert!(
        desk.read("folder/real.h5") == *WHOLE,
        "the table differs from that of an uninterrupted run"
    );
    assert_eq!(
        fs::read_dir(desk.path("folder")).expect("a folder").count(),
        1
    );
}

#[test]
fn when_the_budget_is_spent_the_finished_pieces_are_kept() {
    let desk = desk();
    desk.write("table.h5", "what was there");
    let budget =
        |seconds: &str| desk.run(&[&RESUME[..], &["--jobs", "1", "--budget", seconds]].concat());
    let run = budget("1e-3");
    assert_eq!((run.status, run.stdout.as_str()), (1, ""));
    assert_names(
        &run.stderr,
        &["budget is spent before the nodes are chosen"],
    );
    assert_eq!(desk.read("table.h5"), b"what was there");
    for wrong in ["0", "-1", "nan", "inf"] {
        let message = desk.fail(1, &[&GENERATE[..], &["--budget", wrong]].concat());
        assert_names(&message, &["--budget", "seconds"]);
    }
    // Once the nodes are chosen, the smallest budget gets a piece further.
    let mut seconds = 0.1;
    while !desk.path(JOURNAL).exists() {
        seconds *= 1.5;
        let run = budget(&seconds.to_string());
        assert!(seconds < 60.0 && run.status == 1, "{run:?}");
    }
    let mut rounds = 0;
    loop {
        let run = budget("1e-3");
        if run.status == 0 {
            break;
        }
        assert_names(
            &run.stderr,
            &[
                "budget is spent",
                "points solved; they are kept",
                "--resume",
            ],
        );
        rounds += 1;
        assert!(rounds < 60, "{run:?}");
    }
    println!("{rounds} budgets were spent");
    assert!(rounds > 1);
    assert_finished(&desk);
}

#[test]
fn stated_nodes_are_obeyed_and_a_table_that_misses_its_tolerance_is_kept() {
    let desk = desk();
    desk.write(
        "scene.toml",
        SCENE.replace("to = 1e2 ", "to = 1e2, nodes = 4 "),
    );
    let run = desk.run(&GENERATE);
    assert_eq!(run.status, 1);
    assert_names(&run.stderr, &["is written", "exceeds the tolerance"]);
    let table = Table::open(desk.path("table.h5")).expect("a sound table");
    assert!(table.description().certificate.max_error > 1e-6);
    assert_eq!(desk.files(), ["scene.toml", "table.h5"]);
}

/// A limit on the size of files stands for a full disk where nothing may be mounted.
#[test]
fn a_full_disk_is_an_error_and_what_is_finished_is_safe() {
    let desk = desk();
    desk.write("table.h5", "what was there");
    // In units of 512 bytes: first the journal does not fit, then, as it is longer than the table,
    // neither does.
    for limit in [1, 40, 300] {
        let run = desk.script(&format!(
            "trap '' XFSZ; ulimit -f {limit}; exec $0 generate scene.toml -o table.h5 --certificate-points 300 --resume"
        ));
        assert_eq!(run.status, 1, "{run:?}");
        assert_names(&run.stderr, &["cannot write", "too large"]);
        assert_eq!(desk.read("table.h5"), b"what was there");
    }
    assert!(fs::metadata(desk.path(JOURNAL)).expect("it is kept").len() > 40 * 512);
    desk.succeed(&RESUME);
    assert_finished(&desk);
}

/// A disk of a few hundred kilobytes, where this process may mount one.
#[test]
fn a_small_disk_that_fills_up_in_any_stage_is_an_error() {
    let mounted = "mkdir disk && mount -t tmpfs -o size=64k none disk";
    let desk = desk();
    if desk
        .script(&format!("unshare -m sh -c '{mounted}'; rmdir disk"))
        .stderr
        .is_empty()
    {
        let script = format!(
            "{mounted} && cp scene.toml disk && cd disk &&
             for size in 64k 200k 400k 600k 700k 2m; do
                 mount -o remount,size=$size none . && $0 generate scene.toml --certificate-points 300 --resume; echo status $?
             done; ls -a; cp scene.h5 ../table.h5"
        );
        let run = desk.script(&format!("unshare -m sh -c '{script}' $0"));
        let statuses: Vec<&str> = run
            .stdout
            .lines()
            .filter_map(|line| line.strip_prefix("status "))
            .collect();
        println!("{statuses:?} {}", run.stderr);
        assert!(
            statuses.contains(&"1") && statuses.last() == Some(&"0"),
            "{run:?}"
        );
        for message in run.stderr.lines() {
            assert_names(message, &["cannot write", "No space left"]);
        }
        assert!(
            desk.read("table.h5") == *WHOLE,
            "the table differs from that of an uninterrupted run"
        );
    } else {
        println!("nothing may be mounted here: the limit on files' size stands for it");
    }
}

#[test]
fn a_name_that_the_library_does_not_take_is_an_error_before_any_solving() {
    let desk = desk();
    let run = desk.script("exec $0 generate scene.toml -o \"$(printf 'n\\377.h5')\"");
    assert_eq!(run.status, 1, "{run:?}");
    assert_names(&run.stderr, &["cannot write", "UTF-8"]);
    // The journal's name is as long as names may be.
    let name = format!("{}.h5", "x".repeat(241));
    desk.succeed(&[
        "generate",
        "scene.toml",
        "-o",
        &name,
        "--certificate-points",
        "20",
    ]);
    desk.fail(1, &["generate", "scene.toml", "-o", &format!("x{name}")]);
    assert_eq!(desk.files(), ["scene.toml", name.as_str()]);
}

#[test]
fn a_read_only_folder_is_an_error_before_any_solving() {
    let desk = desk();
    fs::create_dir(desk.path("folder")).expect("a new folder");
    // Permissions do not bind the superuser, a read-only file system does.
    let run = desk.script(
        "if [ $(id -u) = 0 ]; then
             exec unshare -m sh -c 'mount -t tmpfs -o ro none folder && exec $0 generate scene.toml -o folder/table.h5' $0
         else
             chmod a-w folder; exec $0 generate scene.toml -o folder/table.h5
         fi",
    );
    println!("{run:?}");
    assert_eq!(run.status, 1);
    assert!(
        run.stderr.contains("cannot write folder/table.h5") || run.stderr.contains("mount"),
        "{run:?}"
    );
    assert_eq!(
        fs::read_dir(desk.path("folder")).expect("a folder").count(),
        0
    );
}
