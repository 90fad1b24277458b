//! What all `tabulate cost` commands share: rows that are summed up again, and compared with those of another run.

use acceptance::{Desk, assert_names};

const SCENE: &str = "\
title = 'A small box'
a_over_t = { from = 0.1, to = 10 }
e1_over_e2 = { from = 0.3, to = 3 }
nu1 = 0.5
e0_over_e2 = 10
";

const MEASURE: [&str; 7] = ["cost", "effects", "scene.toml", "--tolerance", "1e-2", "--points", "200"];

#[test]
fn rows_are_summed_up_and_compared_with_those_of_another_run() {
    let desk = Desk::new(env!("CARGO_BIN_EXE_tabulate-under-test"));
    desk.write("scene.toml", SCENE);
    let printed = desk.succeed(&[&MEASURE[..], &["-o", "rows.csv"]].concat());
    assert_eq!(desk.succeed(&["cost", "effects", "--data", "rows.csv"]), printed);

    let compare = |file: &str, status: i32| {
        let run = desk.run(&[&MEASURE[..], &["--compare", file]].concat());
        assert_eq!(run.status, status, "{}", run.stderr);
        run.stderr
    };
    let text = String::from_utf8(desk.read("rows.csv")).expect("UTF-8");
    let header: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    // The row of the second effect, with one cell changed.
    let changed = |column: &str, change: &dyn Fn(f64) -> f64| {
        let index = header.iter().position(|name| *name == column).expect("a column");
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let mut cells: Vec<String> = lines[3].split(',').map(str::to_owned).collect();
        cells[index] = change(cells[index].parse().expect("a number")).to_string();
        lines[3] = cells.join(",");
        desk.write("changed.csv", lines.join("\n"));
    };
    changed("saved_seconds", &|seconds| -seconds);
    assert_eq!(compare("changed.csv", 0), "");
    changed("worst_error", &|error| error * (1.0 + 1e-3));
    assert_eq!(compare("changed.csv", 0), "");
    changed("worst_error", &|error| error * 1.02);
    assert_names(&compare("changed.csv", 1), &["changed.csv", "row 3", "worst_error was"]);
    changed("solves", &|solves| solves + 1.0);
    assert_names(&compare("changed.csv", 1), &["row 3", "solves was"]);
    changed("seconds", &|seconds| seconds * 1e4);
    assert_names(&compare("changed.csv", 1), &["row 3", "seconds was"]);
    desk.write("short.csv", text.lines().take(3).collect::<Vec<_>>().join("\n"));
    assert_names(&compare("short.csv", 1), &["the number of rows was 2 and is"]);

    desk.write("partial.csv", [header.join(","), text.lines().nth(2).expect("a row").to_owned()].join("\n"));
    assert_names(&desk.fail(1, &["plot", "effects", "--data", "partial.csv", "-o", "x.svg"]), &["no row of the whole scene"]);
}

#[test]
fn rows_that_cannot_be_read_are_an_error_before_anything_is_measured() {
    let desk = Desk::new(env!("CARGO_BIN_EXE_tabulate-under-test"));
    desk.write("other.csv", "a,b\n1,2\n");
    for option in ["--data", "--compare"] {
        assert_names(&desk.fail(1, &["cost", "solve", option, "missing.csv"]), &["missing.csv"]);
        assert_names(&desk.fail(1, &["cost", "solve", option, "other.csv"]), &["other.csv"]);
    }
    desk.write("empty.csv", "");
    for command in [["cost", "effects"], ["plot", "effects"]] {
        let message = desk
            .fail(1, &[&command[..], &["--data", "empty.csv", "-o", "x.svg"][..if command[0] == "cost" { 2 } else { 4 }]].concat());
        assert_names(&message, &["empty.csv", "it has no rows"]);
    }
    desk.fail(2, &["cost", "effects", "scene.toml", "--data", "other.csv"]);
    desk.fail(2, &["cost", "solve", "--data", "other.csv", "--compare", "other.csv"]);
    desk.fail(2, &["cost", "solve", "--data", "other.csv", "-o", "rows.csv"]);
}
