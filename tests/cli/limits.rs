//! Limits and checks that come before any work, and measurements that no figure can show.

use std::fs;

use acceptance::{assert_cases, shipped, workdir};

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

/// The library names each of these numbers by its line: the tests of `tabulate::plot`.
#[test]
fn a_measurement_that_cannot_be_shown_is_named_with_its_line_and_column() {
    let workdir = workdir!();
    let sound = fs::read_to_string(shipped("figures/lookup.csv")).expect("shipped");
    let first_row = sound.lines().nth(1).expect("there are rows");
    let seconds = first_row.split(',').nth(3).expect("a column of seconds");
    workdir.write("costs.csv", sound.replacen(seconds, "inf", 1));
    workdir.refuses(
        "
        1 | plot lookup-cost --data costs.csv -o no.svg | costs.csv; line 2: seconds = inf is outside
        1 | cost lookup --data costs.csv | costs.csv; line 2: seconds = inf is outside
        ",
    );
    assert_eq!(workdir.files(), ["costs.csv"]);
}
