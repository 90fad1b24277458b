//! The files that commands write: never an input, never through a link to nothing, and nothing is
//! left beside them for good.

use std::fs::{self, File, Permissions};
use std::io::Write;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::{Command, Stdio};
use std::thread::yield_now;

use acceptance::{Workdir, assert_names, shipped, table, workdir};

use crate::TWO_QUANTITIES;

const POINTS: &str = "a_over_t,e1_over_e2,nu1,e0_over_e2\n1,1.5,0.5,inf\n2,1.5,0.5,inf\n";

/// A folder with a table, a scene, points and rows of measurements.
fn workdir() -> Workdir {
    let workdir = workdir!();
    workdir.pack("table", &table(TWO_QUANTITIES));
    workdir.write("scene", TWO_QUANTITIES);
    workdir.write("points", POINTS);
    for costs in ["table", "effects", "lookup", "solve"] {
        let rows = fs::read(shipped(&format!("figures/{costs}.csv"))).expect("shipped");
        workdir.write(&format!("{costs}.svg"), rows);
    }
    workdir
}

/// Commands up to their output, and the inputs of each.
const COMMANDS: [(&str, &[&str]); 15] = [
    ("solve --points points", &["points"]),
    ("query table --points points", &["points", "table"]),
    ("curve table", &["table"]),
    ("generate scene", &["scene"]),
    ("report table", &["table"]),
    ("pack table", &["table"]),
    ("unpack table", &["table"]),
    ("plot table-cost --data table.svg", &["table.svg"]),
    ("plot effects --data effects.svg", &["effects.svg"]),
    ("plot lookup-cost --data lookup.svg", &["lookup.svg"]),
    ("plot work-precision --data solve.svg", &["solve.svg"]),
    ("cost table scene", &["scene"]),
    ("cost effects scene", &["scene"]),
    ("cost lookup table", &["table"]),
    ("cost solve --compare solve.svg", &["solve.svg"]),
];

#[test]
fn no_command_replaces_its_input_under_any_name() {
    let workdir = workdir();
    fs::create_dir(workdir.path("folder")).expect("a new folder");
    for (command, inputs) in COMMANDS {
        for input in inputs {
            let content = workdir.read(input);
            let ending = if input.ends_with(".svg") { ".svg" } else { "" };
            let names = ["link", "hard"].map(|name| format!("{name}{ending}"));
            symlink(input, workdir.path(&names[0])).expect("a link");
            fs::hard_link(workdir.path(input), workdir.path(&names[1])).expect("a link");
            let files = workdir.files();
            let other = format!("folder/../{input}");
            for output in [*input, &other, &names[0], &names[1]] {
                let words = format!("cannot write; {output}; it is the input");
                workdir.refuses(format!("1 | {command} -o {output} | {words}"));
                assert!(workdir.read(input) == content, "{command:?} -o {output}");
                assert_eq!(workdir.files(), files);
            }
            for name in names {
                fs::remove_file(workdir.path(&name)).expect("removed");
            }
        }
    }
    // The table of a figure has a name without the ending of a picture.
    symlink("table", workdir.path("map.svg")).expect("a link");
    workdir.refuses("1 | plot error-map table -o map.svg | map.svg; it is the input");
}

#[test]
fn what_is_appended_to_the_points_is_refused() {
    let workdir = workdir();
    let run = workdir.script("exec \"$0\" query table --points points >> points");
    assert_eq!(run.status, 1, "{run:?}");
    assert_names(&run.stderr, &["points", "both input and standard output"]);
    assert_eq!(workdir.read("points"), POINTS.as_bytes());
}

#[test]
fn links_are_followed_to_files_and_refused_where_they_lead_nowhere() {
    let workdir = workdir();
    let solve = "solve --points points -o";
    symlink("nowhere.csv", workdir.path("dangling.csv")).expect("a link");
    symlink("circle.csv", workdir.path("circle.csv")).expect("a link");
    for output in ["dangling.csv", "circle.csv"] {
        let words = format!("cannot write; {output}; is a link to; remove the link");
        workdir.refuses(format!("1 | {solve} {output} | {words}"));
        assert!(workdir.path(output).is_symlink());
    }
    assert!(!workdir.path("nowhere.csv").exists());
    workdir.write("real.csv", "what was there");
    symlink("real.csv", workdir.path("link.csv")).expect("a link");
    workdir.succeed(format!("{solve} link.csv"));
    assert!(workdir.path("link.csv").is_symlink());
    assert!(workdir.read("real.csv").starts_with(b"a_over_t,"));
    workdir.refuses(format!(
        "
        1 | {solve} new/ | cannot write; the name of a folder
        1 | {solve} - | cannot write; give the name of a file
        1 | {solve} /dev/null | cannot write; is not a file
        1 | {solve} /dev/stdout | cannot write; stream of the program
        1 | {solve} /proc/self/fd/1 | cannot write; stream of the program
        1 | {solve} . | cannot write; is not a file
        1 | {solve} missing/out.csv | cannot write; there is no folder missing
        1 | solve --points none.csv -o missing/out.csv | cannot write; there is no folder missing
        "
    ));
}

#[test]
fn a_read_only_file_is_not_replaced() {
    let workdir = workdir();
    let file = workdir.write("kept.h5", "kept");
    let mut permissions = fs::metadata(&file).expect("a file").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&file, permissions).expect("ours");
    workdir.refuses("1 | generate scene -o kept.h5 | kept.h5; read-only; another name");
    assert_eq!(workdir.read("kept.h5"), b"kept");
}

/// Those of a new file would let all read what was private, and keep a group from writing what was shared.
#[test]
fn a_file_that_is_replaced_keeps_its_permissions() {
    let workdir = workdir();
    for mode in [0o600, 0o640, 0o664] {
        for (command, output) in [
            ("solve --points points", "out.csv"),
            ("unpack table", "out.h5"),
        ] {
            let file = workdir.write(output, "old");
            fs::set_permissions(&file, Permissions::from_mode(mode)).expect("ours");
            workdir.succeed(format!("{command} -o {output}"));
            let data = fs::metadata(&file).expect("a file");
            assert_eq!(data.permissions().mode() & 0o777, mode, "{command}");
        }
    }
}

#[test]
fn a_minus_as_input_is_told_the_name_of_standard_input() {
    workdir().refuses(
        "
        1 | solve --points - | -; /dev/stdin
        1 | generate - -o x.h5 | -; /dev/stdin
        1 | fit - --half-space | -; /dev/stdin
        1 | plot effects --data - -o x.svg | -; /dev/stdin
        ",
    );
    let missing = workdir().fail(1, "solve --points none.csv");
    assert!(!missing.contains("/dev/stdin"), "{missing}");
}

#[test]
fn a_missing_temporary_folder_is_told_with_the_variable_that_names_it() {
    let run = workdir().script("TMPDIR=missing \"$0\" cost table scene");
    assert_eq!(run.status, 1, "{run:?}");
    assert_names(&run.stderr, "cannot write missing; TMPDIR");
}

/// A stack that no machine has room for stands for a limit on the number of threads.
#[test]
fn a_fit_needs_no_further_thread_and_a_solve_tells_the_variable_of_their_number() {
    let workdir = workdir();
    let data = "contact_radius,load\n1e-5,1e-6\n2e-5,8e-6\n3e-5,27e-6\n";
    workdir.write("data.csv", data);
    let without = "RUST_MIN_STACK=1000000000000000000 exec \"$0\"";
    let fit = "fit data.csv --half-space --sphere-radius 1mm --sphere-modulus inf --work-of-adhesion 0 --film-poisson-ratio 0.5 --free film-modulus";
    let run = workdir.script(&format!("{without} {fit}"));
    assert_eq!(run, workdir.run(fit), "{run:?}");
    let run = workdir.script(&format!("{without} solve --points points"));
    assert_ne!(run.status, 0, "{run:?}");
    assert_names(&run.stderr, "does not give the threads; RAYON_NUM_THREADS");
}

/// The names of the hidden files in a folder.
fn hidden(workdir: &Workdir) -> Vec<String> {
    let mut files = workdir.files();
    files.retain(|name| name.starts_with('.'));
    files
}

#[test]
fn what_killed_processes_leave_is_named_and_removed_by_the_next_run() {
    let workdir = workdir();
    let rows = "1,1.5,0.5,inf\n".repeat(300);
    workdir.write("points", format!("{POINTS}{rows}"));
    // Not those of another output, and nothing but files.
    let foreign = [
        ".other.csv.unfinished-abcdef.lock",
        ".out.csv.unfinished-folder.lock",
    ];
    workdir.write(foreign[0], "");
    fs::create_dir(workdir.path(foreign[1])).expect("a new folder");
    for command in ["solve", "query table"] {
        for _ in 0..3 {
            // The system kills the process when its file would be longer than this.
            let run = workdir.script(&format!(
                "ulimit -c 0; ulimit -f 8; \"$0\" {command} --points points -o out.csv; echo status $?"
            ));
            assert!(run.stdout.starts_with("status "), "{run:?}");
            assert_ne!(run.stdout, "status 0\n", "{run:?}");
        }
        assert_eq!(hidden(&workdir).len(), foreign.len() + 2, "{command}");
        let command = format!("{command} --points points -o out.csv");
        let run = workdir.answer(&command);
        assert_names(&run.stderr, ".out.csv.unfinished-; is removed");
        assert_eq!(hidden(&workdir), foreign);
        let again = workdir.run(&command).stderr;
        assert!(!again.contains("is removed"), "{again}");
    }
}

#[test]
fn the_file_of_a_living_process_stays() {
    let workdir = workdir();
    let mut slow = Command::new(env!("CARGO_BIN_EXE_tabulate-under-test"))
        .args(["solve", "--points", "/dev/stdin", "-o", "out.csv"])
        .current_dir(workdir.path("."))
        .stdin(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut points = slow.stdin.take().expect("a pipe");
    points.write_all(POINTS.as_bytes()).expect("read");
    // It has begun, and waits for more points.
    while hidden(&workdir).len() < 2 {
        assert!(slow.try_wait().expect("its status").is_none());
        yield_now();
    }
    let living = hidden(&workdir);
    let quick = "solve --points points -o out.csv";
    assert_eq!(workdir.succeed(quick), "");
    assert_eq!(hidden(&workdir), living);
    let first = workdir.read("out.csv");
    points.write_all(b"3,1.5,0.5,inf\n").expect("read");
    drop(points);
    assert!(slow.wait().expect("it ends").success());
    assert_eq!(hidden(&workdir), [""; 0]);
    let second = workdir.read("out.csv");
    assert!(second.len() > first.len() && second.starts_with(&first));
}

#[test]
fn a_pipe_is_no_table_and_says_so() {
    let workdir = workdir();
    let made = Command::new("mkfifo")
        .arg(workdir.path("pipe"))
        .status()
        .expect("mkfifo runs");
    assert!(made.success());
    workdir.refuses(
        "
        1 | info pipe | is not a file; to a file first
        1 | check pipe | is not a file; to a file first
        1 | query pipe --points points | is not a file; to a file first
        1 | curve pipe | is not a file; to a file first
        1 | pack pipe -o x.bin | is not a file; to a file first
        1 | info /dev/null | is not a file; to a file first
        1 | info . | is not a file; to a file first
        ",
    );
    let run = workdir.script("\"$0\" info /dev/stdin < table; cat table | \"$0\" info /dev/stdin");
    assert_eq!(run.status, 1, "{run:?}");
    assert_names(&run.stderr, &["/dev/stdin", "is not a file"]);
    assert!(run.stdout.contains("Two quantities"), "{run:?}");
}

#[test]
fn a_standard_error_that_fails_does_not_change_the_status() {
    let workdir = workdir();
    File::open("/dev/full").expect("a device that is always full");
    for closed in ["2>/dev/full", "2>&-"] {
        let run = workdir.script(&format!(
            "\"$0\" info missing {closed}; echo $?; \"$0\" curve --to 5e-4 --points 2 {closed} >/dev/null; echo $?"
        ));
        assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("1\n0\n", ""));
    }
}
