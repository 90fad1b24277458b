//! Interruptions of `generate`: killed processes, full disks, read-only folders, two processes with
//! one output, spent budgets. Real processes, and generations in this process that a test can stop
//! after a number of points.
//!
//! No test depends on the speed of the machine: an interruption is given by the size of the
//! journal, by a clock that counts points, or by a call from inside the generation. Where a signal
//! may come too late, the attempt is repeated.

use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::sleep;
use std::time::Duration;

use acceptance::{Contacts, Workdir, arguments, assert_names, start};
use interp::Table;
use tabulate::Error;
use tabulate::table::{Budget, Generated, Observer, Options, Scene, generate};

/// A scene of some 40 pieces and 16,000 points.
pub const SCENE: &str = "\
title = 'Incompressible films'
tolerance = 1e-6
a_over_t = { from = 1e-2, to = 1e2 }
e1_over_e2 = { from = 1e-2, to = 1e2 }
nu1 = 0.5
e0_over_e2 = { from = 1, to = 1e4 }
";

/// A scene whose first plan misses the tolerance.
const COARSE: &str = "\
title = 'x'
tolerance = 1e-1
a_over_t = { from = 0.01, to = 100 }
e1_over_e2 = { from = 1e-2, to = 1e2 }
nu1 = { from = 0, to = 0.5 }
e0_over_e2 = { from = 1e-3, to = 1e3 }
";

pub const JOURNAL: &str = "table.h5.unfinished";

pub const GENERATE: &str = "generate scene.toml -o table.h5 --certificate-points 300";

pub const RESUME: &str = "generate scene.toml -o table.h5 --certificate-points 300 --resume";

pub fn workdir() -> Workdir {
    let workdir = acceptance::workdir!();
    workdir.write("scene.toml", SCENE);
    workdir
}

/// The file of an uninterrupted run on one thread.
pub static WHOLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let workdir = workdir();
    workdir.succeed(format!("{GENERATE} --jobs 1"));
    assert_eq!(workdir.files(), ["scene.toml", "table.h5"]);
    workdir.read("table.h5")
});

/// The table of [`WHOLE`].
static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let workdir = workdir();
    workdir.write("table.h5", &*WHOLE);
    workdir.table("table.h5")
});

/// The number of pieces of [`SCENE`].
fn pieces() -> usize {
    TABLE.shape()[0]
}

/// The number of points in a piece of [`SCENE`].
fn piece_points() -> usize {
    TABLE.shape()[1..].iter().product()
}

/// The number of bytes that a number of points takes in the journal.
fn bytes(points: usize) -> usize {
    8 * 4 * points
}

/// Counts the points that are finished, and calls a function when the solving begins.
struct Watch<'a> {
    points: AtomicUsize,
    at_solving: &'a (dyn Fn() + Sync),
}

impl<'a> Watch<'a> {
    fn new(at_solving: &'a (dyn Fn() + Sync)) -> Self {
        Self {
            points: AtomicUsize::new(0),
            at_solving,
        }
    }

    /// Returns a clock on which each finished point takes a second.
    fn clock(&self) -> impl Fn() -> Duration + Sync {
        move || Duration::from_secs(self.points.load(Ordering::Relaxed) as u64)
    }
}

impl Observer for Watch<'_> {
    fn begin(&self, what: &'static str, _: usize, _: usize) {
        if what == "solving" {
            (self.at_solving)();
        }
    }

    fn advance(&self, points: usize) {
        self.points.fetch_add(points, Ordering::Relaxed);
    }

    fn note(&self, text: &str) {
        println!("{text}");
    }
}

/// Generates the table of `scene.toml` in this process, within a budget of a number of points.
fn generate_within(
    workdir: &Workdir,
    output: &Path,
    certificate_points: usize,
    points: Option<usize>,
) -> Result<Generated, Error> {
    let scene = Scene::read(&workdir.path("scene.toml"), None).expect("a sound scene");
    let watch = Watch::new(&|| ());
    let clock = watch.clock();
    let options = Options {
        certificate_points,
        seed: 1,
        resume: true,
        budget: points.map(|points| Budget::on(&clock, Duration::from_secs(points as u64))),
    };
    generate(&scene, output, &options, &watch)
}

/// A run that stopped after a number of pieces, because its budget was spent.
pub fn unfinished(pieces: usize) -> Workdir {
    let workdir = workdir();
    let budget = pieces * piece_points();
    match generate_within(&workdir, &workdir.path("table.h5"), 300, Some(budget)) {
        Err(Error::Budget { spent }) => {
            assert_names(&spent, &[&format!("with {budget} of "), "are kept"]);
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(workdir.files(), ["scene.toml", JOURNAL]);
    workdir
}

/// Runs the program until the system kills it, because its journal would be longer than `bytes`
/// rounded to 512. The last record of the journal is torn.
fn kill_at(workdir: &Workdir, args: &str, bytes: usize) {
    let blocks = bytes / 512;
    let run = workdir.script(&format!(
        "ulimit -c 0; ulimit -f {blocks}; \"$0\" {args}; echo status $?"
    ));
    let is_killed = run.stdout.starts_with("status ") && run.stdout != "status 0\n";
    assert!(is_killed, "{run:?}");
    assert_eq!(workdir.read(JOURNAL).len(), 512 * blocks, "{run:?}");
}

/// Waits until the journal is as long as this. Returns false if the process has ended before.
fn reaches(workdir: &Workdir, child: &mut Child, bytes: usize) -> bool {
    loop {
        if child.try_wait().expect("its status").is_some() {
            return false;
        }
        if fs::metadata(workdir.path(JOURNAL)).is_ok_and(|data| data.len() >= bytes as u64) {
            return true;
        }
        sleep(Duration::from_millis(1));
    }
}

/// Sends a signal to a process that was not waited for yet.
fn send(signal: &str, child: &Child) {
    let mut kill = start(Command::new("kill").args([signal, &child.id().to_string()]));
    assert!(kill.wait().expect("kill runs").success());
}

pub fn assert_finished(workdir: &Workdir) {
    assert_eq!(workdir.files(), ["scene.toml", "table.h5"]);
    assert_equal(&workdir.read("table.h5"), &WHOLE);
}

/// Asserts that a file is that of an uninterrupted run.
#[track_caller]
pub fn assert_equal(found: &[u8], whole: &[u8]) {
    assert!(
        found == whole,
        "the table differs from that of an uninterrupted run"
    );
}

#[test]
fn killed_at_random_moments_and_resumed_with_any_number_of_jobs_the_file_is_the_same_to_the_byte() {
    let mut random = Contacts::new(71);
    // Not SIGINT: the processes of a script in the background ignore it.
    for signal in ["-KILL", "-KILL", "-TERM", "-TERM"] {
        let mut kills = 0;
        // On a busy machine a signal may find the process finished.
        while kills == 0 {
            let workdir = workdir();
            workdir.write("table.h5", "what was there");
            while kill_or_finish(&workdir, signal, &mut random) {
                kills += 1;
                let table = workdir.read("table.h5");
                let is_whole = table == *WHOLE || table == b"what was there";
                assert!(is_whole, "half a table");
            }
            assert_finished(&workdir);
        }
        println!("{signal}: killed {kills} times");
    }
}

/// Goes on with a run. Kills it when its journal has grown to a random size, or some time after the
/// last piece, when it checks or writes the table. Returns false if it has finished before.
fn kill_or_finish(workdir: &Workdir, signal: &str, random: &mut Contacts) -> bool {
    let jobs = ["1", "2", "5"][random.uniform(0.0, 3.0) as usize];
    let pause = random.uniform(0.0, 0.03);
    let solved = bytes(pieces() * piece_points());
    let mut part = |from, to| (random.uniform(from, to).max(0.0) * solved as f64) as usize;
    let size = match fs::metadata(workdir.path(JOURNAL)) {
        // The journal is empty while the nodes are chosen.
        Err(_) => Some(part(-0.5, 1.0)),
        Ok(journal) if journal.len() < solved as u64 => {
            Some(solved.min(journal.len() as usize + 1 + part(0.0, 0.4)))
        }
        Ok(_) => None,
    };
    let mut child = workdir.start(format!("{RESUME} --jobs {jobs}"));
    if size.is_some_and(|size| reaches(workdir, &mut child, size)) {
        // Any moment is good, one after the end too.
        sleep(Duration::from_secs_f64(pause));
        // A process that has ended takes a signal until it is waited for.
        if child.try_wait().expect("its status").is_none() {
            send(signal, &child);
        }
    }
    let status = child.wait().expect("it ends");
    assert!(status.success() || status.code().is_none(), "{status}");
    !status.success()
}

/// The system kills the process in the middle of a record.
#[test]
fn what_is_finished_is_not_solved_again() {
    let workdir = workdir();
    kill_at(&workdir, GENERATE, bytes(pieces() * piece_points() / 2));
    let text = workdir.succeed(RESUME);
    let line = text.lines().find(|line| line.starts_with("solved"));
    let line = line.expect("a line on the points solved");
    let words = line.split(|c: char| !c.is_ascii_digit());
    let numbers: Vec<usize> = words.filter_map(|word| word.parse().ok()).collect();
    assert!(line.contains("before"), "{line}");
    assert_eq!(numbers[0], pieces() * piece_points());
    // The header takes the room of a part of a piece.
    let kept = [pieces() / 2 - 1, pieces() / 2].map(|pieces| pieces * piece_points());
    assert!((kept[0]..=kept[1]).contains(&numbers[1]), "{line}");
    assert_finished(&workdir);
    // There is nothing to go on from, so this begins at the beginning.
    let again = workdir.succeed(RESUME);
    assert!(!again.contains("before"), "{again}");
    assert_finished(&workdir);
}

/// A refined plan depends on the certificate, and the file must not depend on the process that
/// refined it.
#[test]
fn a_refined_run_is_resumed_with_its_own_certificate_only() {
    let workdir = workdir();
    workdir.write("scene.toml", COARSE);
    let generate = "generate scene.toml -o table.h5 --resume";
    let [first, second] = refined_once(&workdir);
    let whole = workdir.read("table.h5");
    kill_at(&workdir, generate, bytes(first) + bytes(second) / 2);
    let refined = || {
        let journal = workdir.read(JOURNAL);
        journal.windows(9).any(|word| word == b"round = 1")
    };
    assert!(refined());
    let words = "cannot resume; certificate_points = 10000 and seed = 1";
    workdir.refuses(format!(
        "
        1 | {generate} --seed 2 | {words}
        1 | {generate} --certificate-points 300 | {words}
        "
    ));
    assert!(refined());
    workdir.succeed(format!("{generate} --jobs 1"));
    assert_equal(&workdir.read("table.h5"), &whole);
}

/// Generates the table of [`COARSE`] without a budget. Returns the points of both rounds.
fn refined_once(workdir: &Workdir) -> [usize; 2] {
    let made =
        generate_within(workdir, &workdir.path("table.h5"), 10_000, None).expect("within reach");
    assert_eq!(made.refined.len(), 1, "{:?}", made.refined);
    let first = made.refined[0].0.iter().product();
    [first, made.points - first]
}

/// Starts the program with a signal set as an option of `env` says, sends it when eight pieces are kept, and waits.
/// A script in the background would let it ignore SIGINT.
fn interrupt(workdir: &Workdir, option: &str, signal: &str) -> Output {
    let mut command = Command::new("env");
    command.args([
        &format!("--{option}-signal={signal}"),
        env!("CARGO_BIN_EXE_tabulate-under-test"),
    ]);
    let mut child = start(
        command
            .args(arguments(RESUME))
            .current_dir(workdir.path(".")),
    );
    if reaches(workdir, &mut child, bytes(8 * piece_points()) + 1) {
        send(&format!("-{signal}"), &child);
    }
    child.wait_with_output().expect("it ends")
}

/// A process that ends by a status, and not by the signal, lets a script go on that Ctrl-C interrupts.
#[test]
fn ctrl_c_and_schedulers_are_told_what_is_kept_and_how_to_go_on() {
    for (signal, number) in [("INT", 2), ("TERM", 15)] {
        // On a busy machine a signal may find the process finished.
        let (workdir, output) = loop {
            let workdir = workdir();
            let output = interrupt(&workdir, "default", signal);
            if workdir.path(JOURNAL).exists() {
                break (workdir, output);
            }
        };
        assert_eq!(output.status.signal(), Some(number), "{output:?}");
        let message = String::from_utf8(output.stderr).expect("UTF-8");
        let total = pieces() * piece_points();
        let mut words = message.split(' ');
        let kept = words.find_map(|word| word.parse::<usize>().ok());
        let kept = kept.expect("a number of points");
        let are_pieces = kept >= 7 * piece_points() && kept.is_multiple_of(piece_points());
        assert!(are_pieces, "{kept}");
        let words = "points solved; kept in table.h5.unfinished; --resume";
        assert_names(&message, &format!("{kept} of {total} {words}"));
        // As many as it says are there. One more may have been finished while it spoke.
        let text = workdir.succeed(RESUME);
        let resumed = [kept, kept + piece_points()].map(|kept| format!("({kept} before"));
        assert!(resumed.iter().any(|words| text.contains(words)), "{text}");
        assert_finished(&workdir);
    }
}

#[test]
fn a_generation_that_was_started_to_ignore_a_signal_goes_on() {
    for signal in ["INT", "TERM"] {
        let workdir = workdir();
        let output = interrupt(&workdir, "ignore", signal);
        assert!(output.status.success(), "{output:?}");
        assert_finished(&workdir);
    }
}

/// Generates `table.h5` in this process, and calls `meanwhile` before the first piece is solved.
fn generate_and(workdir: &Workdir, meanwhile: &(dyn Fn() + Sync)) {
    let scene = Scene::read(&workdir.path("scene.toml"), None).expect("a sound scene");
    let options = Options {
        certificate_points: 300,
        seed: 1,
        resume: false,
        budget: None,
    };
    let watch = Watch::new(meanwhile);
    generate(&scene, &workdir.path("table.h5"), &options, &watch).expect("within reach");
}

#[test]
fn of_two_generators_on_one_output_the_second_says_so() {
    let workdir = workdir();
    generate_and(&workdir, &|| {
        for second in [GENERATE, RESUME] {
            let words = "table.h5; being made by another process";
            workdir.refuses(format!("1 | {second} | {words}"));
        }
    });
    assert_finished(&workdir);
}

/// A program that tidies up may remove it.
#[test]
fn a_journal_that_is_gone_when_the_table_is_complete_is_not_missed() {
    let workdir = workdir();
    generate_and(&workdir, &|| {
        fs::remove_file(workdir.path(JOURNAL)).expect("it is there");
    });
    assert_finished(&workdir);
}

#[test]
fn links_to_one_output_are_one_output_on_its_own_disk() {
    let workdir = workdir();
    fs::create_dir(workdir.path("folder")).expect("a new folder");
    workdir.write("folder/real.h5", "what was there");
    std::os::unix::fs::symlink("folder/real.h5", workdir.path("table.h5")).expect("a link");
    generate_and(&workdir, &|| {
        assert!(workdir.path("folder/real.h5.unfinished").exists());
        let second = "generate scene.toml -o folder/real.h5";
        let words = "real.h5; being made by another process";
        workdir.refuses(format!("1 | {second} | {words}"));
        assert_eq!(workdir.files(), ["folder", "scene.toml", "table.h5"]);
    });
    assert_equal(&workdir.read("folder/real.h5"), &WHOLE);
    let entries = fs::read_dir(workdir.path("folder"));
    assert_eq!(entries.expect("a folder").count(), 1);
}

/// A nanosecond is over before anything is done, on any machine.
#[test]
fn when_the_budget_is_spent_the_finished_pieces_are_kept() {
    const LEAST: &str = "--jobs 1 --budget 1e-9";
    let workdir = workdir();
    workdir.write("table.h5", "what was there");
    let budget = |workdir: &Workdir| workdir.run(format!("{RESUME} {LEAST}"));
    let run = budget(&workdir);
    assert_eq!((run.status, run.stdout.as_str()), (1, ""));
    assert_names(&run.stderr, "budget is spent before the nodes are chosen");
    assert_eq!(workdir.read("table.h5"), b"what was there");
    for wrong in ["0", "-1", "nan", "inf"] {
        let message = workdir.fail(1, format!("{GENERATE} --budget {wrong}"));
        assert_names(&message, &["--budget", "seconds"]);
    }
    // Once the nodes are chosen, the smallest budget finishes one more piece.
    let begun = pieces() - 5;
    let workdir = unfinished(begun);
    for finished in begun + 1..pieces() {
        let run = budget(&workdir);
        assert_eq!(run.status, 1, "{run:?}");
        let [done, all] = [finished, pieces()].map(|pieces| pieces * piece_points());
        let words = format!("budget is spent; with {done} of {all} points solved");
        assert_names(&run.stderr, &format!("{words}; they are kept; --resume"));
    }
    assert_eq!(budget(&workdir).status, 0);
    assert_finished(&workdir);
}

#[test]
fn a_budget_that_does_not_allow_another_round_leaves_the_table_of_this_one() {
    let workdir = workdir();
    workdir.write("scene.toml", COARSE);
    let [first, second] = refined_once(&workdir);
    let within =
        |points| generate_within(&workdir, &workdir.path("other.h5"), 10_000, Some(points));
    // A point takes a second on this clock, in the certificate too.
    let round = first + 10_000;
    let twice = within(2 * round).expect("enough for a round");
    assert!(twice.refined.is_empty() && twice.points == first);
    let certificate = twice.table.description().certificate;
    assert!(certificate.max_error > twice.table.description().tolerance);
    let other = workdir.table("other.h5");
    assert_eq!(other.description().certificate, certificate);
    // The second round is expected to take longer in proportion to its points.
    let expected = round + (round as f64 * second as f64 / first as f64).ceil() as usize;
    let enough = within(expected + 1).expect("enough for two rounds");
    assert!(enough.refined.len() == 1 && enough.points == first + second);
    assert!(workdir.read("other.h5") == workdir.read("table.h5"));
}
