//! Many points: in bounded memory, in the order of the file.

use std::fmt::Write;

use acceptance::{Data, Workdir, assert_names, material, workdir};
use interp::Table;

use crate::paper_table;

/// The number of points that are answered together, and a few more than twice that.
const BATCH: usize = 4096;
const MANY: usize = 2 * BATCH + 100;

const HEADER: &str = "a_over_t,e1_over_e2,nu1,e0_over_e2\n";

/// Returns a point of the paper's table.
fn row(i: usize) -> String {
    let x = 1e-2 * (1.0 + i as f64);
    format!("{x},1.75,0.5,1e5\n")
}

fn rows(count: usize) -> String {
    (0..count).fold(HEADER.to_owned(), |text, i| text + &row(i))
}

#[test]
fn points_keep_their_order_over_many_batches() {
    let workdir = workdir!();
    let table = paper_table();
    workdir.write("points.csv", rows(MANY));
    let printed = workdir.succeed(format!("query {table} --points points.csv"));
    let data = Data::parse("query", &printed);
    let read = Table::read(&table).expect("sound");
    let curve = read.curve(&material([1.75, 0.5, 1e5, 0.25]));
    let curve = curve.expect("inside");
    assert_eq!(data.cases().count(), MANY);
    for (i, case) in data.cases().enumerate() {
        let x = 1e-2 * (1.0 + i as f64);
        assert_eq!(case.get("a_over_t"), x);
        assert_eq!(case.quantities(), curve.quantities(x).expect("inside"));
    }
    // From a pipe too, and into a file.
    let run = workdir.script(&format!(
        "cat points.csv | \"$0\" query {table} --points /dev/stdin -o out.csv"
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    assert_eq!(workdir.read("out.csv"), printed.as_bytes());
}

#[test]
fn an_error_names_the_first_wrong_line_and_leaves_no_file() {
    let workdir = workdir!();
    let table = paper_table();
    let mut text = rows(MANY);
    // One cannot be looked up, a later one not be read; then there is a good one.
    let _ = write!(text, "1,1e9,0.5,1e5\n1,1.75,half,1e5\n{}", row(1));
    workdir.write("points.csv", &text);
    let line = format!("line {}", MANY + 2);
    let command = format!("query {table} --points points.csv");
    let run = workdir.run(&command);
    assert_eq!(run.status, 1);
    assert_names(&run.stderr, &["points.csv", &line, "e1_over_e2"]);
    // The batches before it are printed, and nothing of its own.
    assert_eq!(run.stdout.lines().count(), 1 + 2 * BATCH);
    let message = workdir.fail(1, format!("{command} -o out.csv"));
    assert_names(&message, &["points.csv", &line]);
    assert!(!message.contains("out.csv"), "{message}");
    assert_eq!(workdir.files(), ["points.csv"]);
}

/// The memory that the program may map. With all points in memory it took six times as much for
/// four times the points of this test.
const MEMORY: usize = 300_000;

/// Returns the number of lines that a command prints within that memory.
fn lines_within_memory(workdir: &Workdir, command: &str) -> usize {
    let run = workdir.script(&format!(
        "export RAYON_NUM_THREADS=2 MALLOC_ARENA_MAX=2; ulimit -v {MEMORY}; exec \"$0\" {command} > out.csv"
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{command}");
    let printed = workdir.read("out.csv");
    printed.iter().filter(|byte| **byte == b'\n').count()
}

#[test]
fn memory_does_not_grow_with_the_number_of_points() {
    const COUNT: usize = 250_000;
    let workdir = workdir!();
    let table = paper_table();
    let points =
        |row: &str, count| workdir.write("points.csv", HEADER.to_owned() + &row.repeat(count));
    points("1,1,0.25,1\n", COUNT);
    // Film and substrate are equal, and solved in closed form.
    let solved = lines_within_memory(&workdir, "solve --points points.csv");
    assert_eq!(solved, COUNT + 1);
    points("1,1.75,0.5,1e5\n", COUNT / 4);
    let query = format!("query {table} --points points.csv --gradient");
    assert_eq!(lines_within_memory(&workdir, &query), COUNT / 4 + 1);
}

#[test]
fn input_without_an_end_is_refused() {
    let workdir = workdir!();
    let long = "1".repeat(3 << 20);
    // A quotation that never ends joins all lines.
    let quoted = format!("{HEADER}\"{}", "1,1,0.5,1\n".repeat(1 << 19));
    for (name, text) in [
        ("field.csv", format!("{HEADER}1,1,0.5,{long}\n")),
        ("header.csv", long.clone()),
        ("comment.csv", format!("#{long}")),
        ("quoted.csv", quoted),
    ] {
        workdir.write(name, text);
        let words = format!("{name}; longer than 1048576 bytes");
        workdir.refuses(format!("1 | solve --points {name} | {words}"));
    }
    workdir.write("scene.toml", b"title = '\xe9'\n");
    workdir.refuses(
        "
        1 | solve --points /dev/zero | /dev/zero; no text in UTF-8
        1 | generate /dev/zero -o x.h5 | /dev/zero; longer than
        1 | plot effects --data /dev/zero -o x.svg | /dev/zero; no text in UTF-8
        1 | generate scene.toml | scene.toml; save it with this encoding
        ",
    );
}
