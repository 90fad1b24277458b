//! `tabulate cost table`: that its rows say what `generate` and `pack` say, from when on a table
//! pays, and what a budget leaves out.

use acceptance::{Desk, assert_names};
use interp::{LowRank, Table};
use tabulate::cost::table::{Row, TOLERANCES, break_even, markdown};
use tabulate::cost::{read_csv, to_csv};

const SCENE: &str = "\
title = 'A small box'
a_over_t = { from = 0.1, to = 10 }
e1_over_e2 = { from = 0.3, to = 3 }
nu1 = 0.5
e0_over_e2 = inf
";

fn desk() -> Desk {
    let desk = Desk::new(env!("CARGO_BIN_EXE_tabulate-under-test"));
    desk.write("scene.toml", SCENE);
    desk
}

fn rows(desk: &Desk, file: &str) -> Vec<Row> {
    read_csv(&desk.path(file)).expect("the command has written it")
}

#[test]
fn rows_say_what_generate_and_pack_say() {
    let desk = desk();
    let printed = desk.succeed(&["cost", "table", "scene.toml", "-o", "table.csv"]);
    let rows = rows(&desk, "table.csv");
    assert_eq!(
        to_csv(&rows),
        desk.read("table.csv"),
        "numbers do not read back"
    );
    assert_eq!(
        rows.iter().map(|row| row.tolerance).collect::<Vec<_>>(),
        TOLERANCES
    );
    assert_eq!(desk.files(), ["scene.toml", "table.csv"]);
    for row in rows.iter().step_by(3) {
        let tolerance = row.tolerance.to_string();
        let said = desk.succeed(&[
            "generate",
            "scene.toml",
            "-o",
            "table.h5",
            "--tolerance",
            &tolerance,
        ]);
        desk.succeed(&[
            "pack",
            "table.h5",
            "-o",
            "table.bin",
            "--tolerance",
            &tolerance,
        ]);
        let (dense, packed) = (
            Table::open(desk.path("table.h5")).expect("sound"),
            Table::read(desk.path("table.bin")).expect("sound"),
        );
        assert_eq!(row.nodes(), dense.shape().map(|nodes| nodes as u64));
        assert_names(&said, &[&format!("{} points in", row.solves)]);
        assert_eq!(row.dense_error, dense.description().certificate.max_error);
        assert_eq!(row.packed_error, packed.description().certificate.max_error);
        assert_eq!(row.dense_bytes, desk.read("table.h5").len() as u64);
        assert_eq!(row.packed_bytes, desk.read("table.bin").len() as u64);
        let ranks = packed
            .low_rank()
            .map(LowRank::ranks)
            .expect("low rank")
            .map(|rank| rank as u64);
        assert_eq!([row.rank_1, row.rank_2, row.rank_3], ranks);
        assert_names(
            &printed,
            &[&format!(
                "| {:e} | {} × {} × 1 × 1 |",
                row.tolerance, row.a_over_t_nodes, row.e1_over_e2_nodes
            )],
        );
    }
    for row in &rows {
        assert!(
            row.dense_error <= row.tolerance && row.packed_error <= row.tolerance,
            "{row:?}"
        );
        let times = [
            row.seconds,
            row.pack_seconds,
            row.solve_seconds,
            row.curve_seconds,
            row.point_seconds,
        ];
        assert!(
            times.iter().all(|time| time.is_finite() && *time > 0.0),
            "{row:?}"
        );
        assert_eq!(
            row.break_even_alone,
            break_even(
                row.making(),
                row.solve_seconds,
                row.curve_seconds + row.point_seconds
            )
        );
        assert_eq!(
            row.break_even_along,
            break_even(row.making(), row.solve_seconds, row.point_seconds)
        );
        assert!(row.making() >= row.seconds + row.pack_seconds);
    }

    desk.succeed(&[
        "plot",
        "table-cost",
        "--data",
        "table.csv",
        "-o",
        "table.svg",
    ]);
    assert!(desk.read("table.svg").starts_with(b"<svg"));
    // A solve that takes no longer than a lookup: infinity reads back, too.
    let never = vec![Row {
        break_even_alone: f64::INFINITY,
        ..rows[0].clone()
    }];
    desk.write("never.csv", to_csv(&never));
    assert_eq!(self::rows(&desk, "never.csv"), never);
    assert_names(&markdown(&never), &["| never |"]);
}

#[test]
fn a_table_breaks_even_where_both_have_taken_the_same_time() {
    assert_eq!(break_even(10.0, 3.0, 1.0), 5.0);
    let (making, solve, lookup) = (17.0, 31e-6, 24e-6);
    let count = break_even(making, solve, lookup);
    assert!(
        (making + count * lookup - count * solve).abs() <= 1e-12 * making,
        "{count}"
    );
    assert_eq!(break_even(making, lookup, lookup), f64::INFINITY);
    assert_eq!(break_even(making, lookup, solve), f64::INFINITY);
}

/// All seven tables of the default box take minutes.
#[test]
fn a_budget_is_kept_and_what_it_leaves_out_is_said() {
    let desk = desk();
    let run = desk.run(&["cost", "table", "--budget", "1.5", "-o", "table.csv"]);
    if run.status == 1 {
        assert_names(&run.stderr, &["the budget is spent", "1.5 s"]);
        assert_eq!(desk.files(), ["scene.toml"]);
        return;
    }
    assert_eq!(run.status, 0);
    let rows = rows(&desk, "table.csv");
    assert!((1..TOLERANCES.len()).contains(&rows.len()), "{rows:?}");
    let next = TOLERANCES[rows.len()];
    assert_names(
        &run.stderr,
        &[&format!(
            "from {next:e} on left out: the budget of 1.5 s is spent"
        )],
    );
    assert_eq!(run.stdout, markdown(&rows));
}

#[test]
fn tolerances_out_of_reach_are_left_out_and_the_reason_is_said() {
    let desk = desk();
    desk.write(
        "stated.toml",
        SCENE.replace("to = 10 }", "to = 10, nodes = 10 }"),
    );
    let run = desk.run(&["cost", "table", "stated.toml", "-o", "table.csv"]);
    assert_eq!(run.status, 0);
    let rows = rows(&desk, "table.csv");
    assert!(
        (1..4).contains(&rows.len()),
        "ten nodes keep {} tolerances",
        rows.len()
    );
    let said = desk.run(&[
        "generate",
        "stated.toml",
        "--tolerance",
        &TOLERANCES[rows.len()].to_string(),
    ]);
    assert_eq!(said.status, 1);
    let error = Table::open(desk.path("stated.h5"))
        .expect("sound")
        .description()
        .certificate
        .max_error;
    let why = format!(
        "its certified error {error:.1e} leaves no room below the tolerance {:e}",
        TOLERANCES[rows.len()]
    );
    assert_names(
        &run.stderr,
        &[&format!(
            "from {:e} on left out: {why}",
            TOLERANCES[rows.len()]
        )],
    );

    desk.write(
        "coarse.toml",
        SCENE.replace("to = 10 }", "to = 10, nodes = 3 }"),
    );
    let message = desk.fail(1, &["cost", "table", "coarse.toml", "-o", "none.csv"]);
    assert_names(&message, &["its certified error", "leaves no room", "1e-2"]);
    assert!(!desk.files().contains(&"none.csv".to_owned()));
}

#[test]
fn bad_scenes_and_budgets_are_errors_that_name_the_value() {
    let desk = desk();
    for budget in ["0", "-1", "1e10", "NaN", "inf"] {
        let value = budget.parse::<f64>().expect("a number");
        let message = desk.fail(1, &["cost", "table", "scene.toml", "--budget", budget]);
        assert_names(
            &message,
            &[
                &format!("--budget = {value:?}"),
                "above 0 and at most 1e9 seconds",
            ],
        );
    }
    desk.fail(2, &["cost", "table", "scene.toml", "--budget", "soon"]);
    desk.write("wrong.toml", SCENE.replace("nu1 = 0.5", "nu1 = 0.6"));
    for command in ["table", "effects"] {
        assert_names(
            &desk.fail(1, &["cost", command, "missing.toml"]),
            &["cannot read missing.toml"],
        );
        assert_names(
            &desk.fail(1, &["cost", command, "wrong.toml"]),
            &["wrong.toml", "nu1 = 0.6", "(-1, 0.5]"],
        );
        assert_names(
            &desk.fail(1, &["cost", command, "scene.toml", "-o", "scene.toml"]),
            &["scene.toml", "it is the input"],
        );
        assert_names(
            &desk.fail(1, &["cost", command, "scene.toml", "-o", "none/x.csv"]),
            &["none/x.csv", "there is no folder"],
        );
    }
    assert_eq!(desk.read("scene.toml"), SCENE.as_bytes());
}
