//! Limits and checks that come before any work, and measurements that no figure can show.

use std::fs;

use acceptance::{Workdir, assert_cases, shipped, workdir};

use crate::TWO_QUANTITIES;

#[test]
fn a_number_of_points_that_memory_does_not_hold_is_refused() {
    let workdir = workdir!();
    workdir.write("scene.toml", TWO_QUANTITIES);
    let most = "4294967295";
    workdir.refuses(format!(
        "
        2 | generate scene.toml --certificate-points {most} | {most}; 1000000
        2 | check embedded --points {most} | {most}; 1000000
        2 | pack x.h5 -o x.bin --tolerance 1e-2 --points {most} | {most}; 1000000
        2 | cost effects scene.toml --points {most} | {most}; 1000000
        2 | curve --points {most} | {most}; 1000000
        "
    ));
    assert_eq!(workdir.files(), ["scene.toml"]);
}

/// A scene whose planning takes long, so that this test would not end if it came first.
const SLOW: &str = "
    title      = 'x'
    tolerance  = 1e-9
    a_over_t   = { from = 1e-6, to = 1e6 }
    e1_over_e2 = { from = 1e-6, to = 1e6 }
    nu1        = { from = 0, to = 0.4999 }
    e0_over_e2 = { from = 1e-6, to = 1e6 }
";

#[test]
fn what_makes_no_table_is_refused_before_a_solve() {
    let workdir = workdir!();
    // A part of the scene, its new text, and words of the error.
    let changes = r#"
        'x' | "a\u0000b" | title; U+0000
        e0_over_e2 = { from = 1e-6, to = 1e6 } | e0_over_e2 = { from = 1, to = 1.0000000001 } | e0_over_e2; 2 nodes; 1.0000000001; too close
        from = 0, to = 0.4999 | from = 0.3, to = 0.3000000001 | nu1; 0.3000000001; too close
        from = 0, to = 0.4999 | from = 0.3, to = 0.30001, nodes = 9999 | nu1; 9999 nodes; too close
        e0_over_e2 = { from = 1e-6, to = 1e6 } | e0_over_e2 = { from = 1, to = 1.0000000000000002, nodes = 5 } | e0_over_e2; 5 nodes
        1e6 }\n    e1_over_e2 = { from = 1e-6, to = 1e6 } | 1e6, nodes = 9999 }\n    e1_over_e2 = { from = 1e-6, to = 1e6, nodes = 9999 } | 9999 x 9999 x; at most 10000 nodes
        "#;
    for more in ["", "--plan", "--resume"] {
        assert_cases(changes, |[from, to, _]| {
            let [from, to] = [from, to].map(|text| text.replace("\\n", "\n"));
            assert!(SLOW.contains(&from));
            workdir.write("scene.toml", SLOW.replace(&from, &to));
            let message = workdir.fail(1, format!("generate scene.toml {more}"));
            assert_eq!(workdir.files(), ["scene.toml"]);
            message
        });
    }
}

/// The figures of measurements, with a column of numbers of each.
const FIGURES: [(&str, &str); 4] = [
    ("table", "table-cost"),
    ("effects", "effects"),
    ("lookup", "lookup-cost"),
    ("solve", "work-precision"),
];

/// Writes the shipped measurements with another value in a row and a column. Returns the line.
fn write_with(workdir: &Workdir, costs: &str, row: usize, column: usize, value: &str) -> usize {
    let text = fs::read_to_string(shipped(&format!("figures/{costs}.csv"))).expect("shipped");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut writer = csv::Writer::from_writer(Vec::new());
    let header = reader.headers().expect("a header");
    writer.write_record(header).expect("in memory");
    for (i, record) in reader.records().enumerate() {
        let record = record.expect("a row");
        let mut fields: Vec<&str> = record.iter().collect();
        if i == row {
            fields[column] = value;
        }
        writer.write_record(fields).expect("in memory");
    }
    workdir.write("costs.csv", writer.into_inner().expect("in memory"));
    row + 2
}

/// Some of what is refused, in full: the file of measurements, the column and the value.
const REFUSED: [(&str, &str, &str); 6] = [
    ("lookup", "seconds", "0"),
    ("lookup", "seconds", "inf"),
    ("lookup", "max_error", "1e300"),
    ("table", "solve_seconds", "0"),
    ("solve", "tolerance", "0"),
    ("effects", "worst_error", "inf"),
];

/// Every number of every file of measurements is replaced by numbers that no measurement gives. The
/// figure or the summary, by turns, either shows it, or names the line and the column.
#[test]
fn a_measurement_that_cannot_be_shown_is_named_with_its_line_and_column() {
    let workdir = workdir!();
    let mut named = 0;
    for (costs, figure) in FIGURES {
        let text = fs::read_to_string(shipped(&format!("figures/{costs}.csv"))).expect("shipped");
        let header: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
        let mut refused = 0;
        for (column, name) in header.iter().enumerate() {
            for (i, value) in ["0", "inf", "-1", "1e300", "NaN"].into_iter().enumerate() {
                let line = write_with(&workdir, costs, 1, column, value);
                if REFUSED.contains(&(costs, name, value)) {
                    let plot = format!("plot {figure} --data costs.csv -o no.svg");
                    let words = format!("line {line}: {name} = {value} is outside");
                    workdir.refuses(format!("1 | {plot} | costs.csv; {words}"));
                    named += 1;
                }
                let run = workdir.run(if (column + i).is_multiple_of(2) {
                    format!("plot {figure} --data costs.csv -o x.svg")
                } else {
                    format!("cost {costs} --data costs.csv")
                });
                if run.status == 0 {
                    continue;
                }
                refused += 1;
                assert_eq!((run.status, &*run.stdout), (1, ""), "{name} = {value}");
                let place = format!("line {line}");
                let reasons = [&place, "there is no row", "each row must save"];
                let is_named = reasons.iter().any(|words| run.stderr.contains(words));
                assert!(is_named, "{name} = {value}: {run:?}");
            }
        }
        assert!(refused > 25, "{costs}: {refused}");
    }
    assert_eq!(named, REFUSED.len());
    assert_eq!(workdir.files(), ["costs.csv", "x.svg"]);
}
