//! `tabulate cost table`: its rows against `generate` and `pack`, the break-even of a table, and
//! the tables that a limit leaves out.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use acceptance::{Workdir, assert_names, assert_near, larger, workdir};
use cost::clock::Timing;
use cost::table::{Row, TOLERANCES, break_even, markdown};
use cost::{Measured, to_csv};
use interp::Table;
use tabulate::Error;
use tabulate::measure::{self, read_csv};
use tabulate::table::{Budget, Observer, Plan, Scene};

const SCENE: &str = "\
title = 'A small box'
a_over_t = { from = 0.1, to = 10 }
e1_over_e2 = { from = 0.3, to = 3 }
nu1 = 0.5
e0_over_e2 = inf
";

fn workdir() -> Workdir {
    let workdir = workdir!();
    workdir.write("scene.toml", SCENE);
    workdir
}

fn rows(workdir: &Workdir, file: &str) -> Vec<Row> {
    read_csv(&workdir.path(file)).expect("the command has written it")
}

fn tolerances(rows: &[Row]) -> Vec<f64> {
    rows.iter().map(|row| row.tolerance).collect()
}

/// Counts the points that are solved.
#[derive(Default)]
pub struct Work(AtomicU64);

impl Observer for Work {
    fn begin(&self, _: &'static str, _: usize, _: usize) {}

    fn advance(&self, points: usize) {
        self.0.fetch_add(points as u64, Ordering::Relaxed);
    }

    fn note(&self, _: &str) {}
}

impl Work {
    /// Measures the small box. A second of the budget is a point that is solved, on any machine.
    fn measure(&self, budget: Option<u64>) -> Result<Measured<Row>, Error> {
        let scene = Scene::parse(SCENE, None).expect("the scene is sound");
        let clock = || Duration::from_secs(self.0.load(Ordering::Relaxed));
        let budget = budget.map(|points| Budget::on(&clock, Duration::from_secs(points)));
        measure::table(&scene, 1e-8, budget, Timing::Brief, self)
    }
}

#[test]
fn rows_say_what_generate_and_pack_say() {
    let workdir = workdir();
    let Measured { rows, left_out } = Work::default().measure(None).expect("within reach");
    assert_eq!(tolerances(&rows), TOLERANCES);
    assert!(left_out.is_empty(), "{left_out:?}");
    let printed = markdown(&rows);
    for row in rows.iter().step_by(3) {
        let tolerance = row.tolerance.to_string();
        let generate = format!("generate scene.toml -o table.h5 --tolerance {tolerance}");
        let said = workdir.succeed(generate);
        let pack = format!("pack table.h5 -o table.bin --tolerance {tolerance}");
        workdir.succeed(pack);
        let dense = Table::open(workdir.path("table.h5")).expect("sound");
        let packed = Table::read(workdir.path("table.bin")).expect("sound");
        assert_eq!(row.nodes(), dense.shape().map(|nodes| nodes as u64));
        assert_names(&said, &format!("{} points in", row.solves));
        assert_eq!(row.dense_error, dense.description().certificate.max_error);
        assert_eq!(row.packed_error, packed.description().certificate.max_error);
        assert_eq!(row.dense_bytes, workdir.read("table.h5").len() as u64);
        assert_eq!(row.packed_bytes, workdir.read("table.bin").len() as u64);
        let ranks = packed.ranks().expect("low rank")[0].map(|rank| rank as u64);
        assert_eq!([row.rank_1, row.rank_2, row.rank_3], ranks);
        let [a_over_t, e1, ..] = row.nodes();
        let cells = format!("| {:e} | {a_over_t} × {e1} × 1 × 1 |", row.tolerance);
        assert_names(&printed, &cells);
    }
    for row in &rows {
        let error = larger(row.dense_error, row.packed_error);
        assert!(error <= row.tolerance, "{row:?}");
        let (solve, curve, point) = (row.solve_seconds, row.curve_seconds, row.point_seconds);
        for time in [row.seconds, row.pack_seconds, solve, curve, point] {
            assert!(time.is_finite() && time > 0.0, "{row:?}");
        }
        let alone = break_even(row.making(), solve, curve + point);
        assert_eq!(row.break_even_alone, alone);
        let along = break_even(row.making(), solve, point);
        assert_eq!(row.break_even_along, along);
        assert!(row.making() >= row.seconds + row.pack_seconds);
    }
}

#[test]
fn the_command_writes_and_prints_the_rows_down_to_a_tolerance() {
    let workdir = workdir();
    let printed = workdir.succeed("cost table scene.toml --to 1e-3 -o table.csv");
    let rows = rows(&workdir, "table.csv");
    assert_eq!(to_csv(&rows), workdir.read("table.csv"));
    assert_eq!(tolerances(&rows), [1e-2, 1e-3]);
    assert_eq!(workdir.files(), ["scene.toml", "table.csv"]);
    assert_eq!(printed, markdown(&rows));
    let words =
        "break-even after N evaluations; Tolerances without a table: 1e-4, 1e-5, 1e-6, 1e-7, 1e-8.";
    assert_names(&printed, words);
    for row in &rows {
        assert_names(&printed, &format!("| {:e} | ", row.tolerance));
    }

    workdir.succeed("plot table-cost --data table.csv -o table.svg");
    assert!(workdir.read("table.svg").starts_with(b"<svg"));
    // A solve that takes no longer than a lookup: infinity is read back, too.
    let never = vec![Row {
        break_even_alone: f64::INFINITY,
        ..rows[0].clone()
    }];
    workdir.write("never.csv", to_csv(&never));
    assert_eq!(self::rows(&workdir, "never.csv"), never);
    assert_names(&markdown(&never), &["| never |"]);

    // Another run has the kept sizes and errors, and other times. The last row is not measured
    // again.
    let mut kept = rows;
    workdir.write("kept.csv", to_csv(&kept));
    let compare = "cost table scene.toml --compare kept.csv --to";
    let run = workdir.answer(format!("{compare} 1e-2"));
    let words = "kept.csv: the last 1 of its 2 rows are not compared";
    assert_names(&run.stderr, words);
    kept[0].packed_bytes += 1;
    workdir.write("kept.csv", to_csv(&kept));
    let run = workdir.run(format!("{compare} 1e-2"));
    assert_eq!(run.status, 1);
    assert_names(&run.stderr, "kept.csv; row 1; packed_bytes was");
}

#[test]
fn a_table_breaks_even_where_both_have_taken_the_same_time() {
    assert_eq!(break_even(10.0, 3.0, 1.0), 5.0);
    let (making, solve, lookup) = (17.0, 31e-6, 24e-6);
    let count = break_even(making, solve, lookup);
    assert_near(making + count * lookup, count * solve, 1e-12 * making);
    assert_eq!(break_even(making, lookup, lookup), f64::INFINITY);
    assert_eq!(break_even(making, lookup, solve), f64::INFINITY);
}

/// The budget is in points, so that every machine stops at the same table.
#[test]
fn a_budget_is_kept_and_the_table_that_it_leaves_out_is_named() {
    let points = |tolerance: f64| {
        let scene = Scene::parse(SCENE, Some(tolerance)).expect("the scene is sound");
        Plan::new(&scene).expect("within reach").points() as u64
    };
    // Two certificates of 5000 points each.
    let table = |tolerance: f64| points(tolerance) + 10_000;
    let three: u64 = TOLERANCES[..3].iter().map(|&t| table(t)).sum();
    let work = Work::default();
    let budget = three + table(1e-5) / 2;
    let measured = work.measure(Some(budget));
    let Measured { rows, left_out } = measured.expect("the first table is within the budget");
    // No more is solved.
    assert_eq!(work.0.into_inner(), three);
    assert_eq!(tolerances(&rows), TOLERANCES[..3]);
    assert_eq!(left_out.len(), 1);
    let words =
        "There is no table to 1e-5: the budget is spent but for ; this table would take about ";
    assert_names(&left_out[0], words);
    assert_names(&left_out[0], &format!("--budget is {:?} s", budget as f64));
    let words = "Tolerances without a table: 1e-5, 1e-6, 1e-7, 1e-8.";
    assert_names(&markdown(&rows), words);
}

#[test]
fn a_budget_that_does_not_suffice_for_the_first_table_is_an_error() {
    let workdir = workdir();
    let command = "cost table scene.toml -o table.csv --budget 1e-9";
    workdir.refuses(format!(
        "1 | {command} | the budget is spent; 1e-9 s; larger"
    ));
    assert_eq!(workdir.files(), ["scene.toml"]);
}

#[test]
fn tolerances_out_of_reach_are_left_out_and_the_reason_is_said() {
    let workdir = workdir();
    let stated = SCENE.replace("to = 10 }", "to = 10, nodes = 10 }");
    workdir.write("stated.toml", stated);
    let run = workdir.answer("cost table stated.toml --to 1e-8 -o table.csv");
    let rows = rows(&workdir, "table.csv");
    assert!((1..4).contains(&rows.len()), "{rows:?}");
    let tolerance = TOLERANCES[rows.len()];
    let said = workdir.run(format!("generate stated.toml --tolerance {tolerance}"));
    assert_eq!(said.status, 1);
    let table = Table::open(workdir.path("stated.h5")).expect("sound");
    let error = table.description().certificate.max_error;
    let reason = format!(
        "There is no table to {tolerance:e}: its certified error {error:.1e} leaves no room below the tolerance {tolerance:e}"
    );
    assert_names(&run.stderr, &format!("tabulate: {reason}"));
    assert_names(&run.stdout, &[&markdown(&rows), &reason]);
    // The file of rows does not hold the reason.
    let printed = workdir.succeed("cost table --data table.csv");
    assert_eq!(printed, markdown(&rows));

    let coarse = SCENE.replace("to = 10 }", "to = 10, nodes = 3 }");
    workdir.write("coarse.toml", coarse);
    let words = "its certified error; leaves no room; 1e-2";
    workdir.refuses(format!("1 | cost table coarse.toml -o none.csv | {words}"));
    assert!(!workdir.files().contains(&"none.csv".to_owned()));
}

/// The low-rank form of one grid may miss its tolerance, and that of the next one hold.
#[test]
fn a_loose_tolerance_that_is_missed_is_left_out() {
    let workdir = workdir();
    workdir.write("scene.toml", include_str!("../../tables/adhesionless.toml"));
    let run = workdir.answer("cost table scene.toml --to 1e-3 -o table.csv");
    assert_names(&run.stderr, "There is no table to 1e-2; low-rank form");
    let made: Vec<f64> = rows(&workdir, "table.csv")
        .iter()
        .map(|row| row.tolerance)
        .collect();
    assert_eq!(made, [1e-3]);
}

#[test]
fn bad_scenes_and_budgets_are_errors_that_name_the_value() {
    let workdir = workdir();
    workdir.write("wrong.toml", SCENE.replace("nu1 = 0.5", "nu1 = 0.6"));
    workdir.refuses(
        "
        1 | cost table scene.toml --budget 0 | --budget = 0.0; above 0 and at most 1e9 seconds
        1 | cost table scene.toml --budget -1 | --budget = -1.0; above 0 and at most 1e9 seconds
        1 | cost table scene.toml --budget 1e10 | --budget = 10000000000.0; above 0 and at most 1e9 seconds
        1 | cost table scene.toml --budget NaN | --budget = NaN; above 0 and at most 1e9 seconds
        1 | cost table scene.toml --budget inf | --budget = inf; above 0 and at most 1e9 seconds
        2 | cost table scene.toml --budget soon | soon
        1 | cost table scene.toml --to 1e-9 | --to = 1e-9; from 1e-2 to 1e-8
        1 | cost table scene.toml --to 0.1 | --to = 0.1; from 1e-2 to 1e-8
        1 | cost table scene.toml --to -1 | --to = -1.0; from 1e-2 to 1e-8
        1 | cost table scene.toml --to NaN | --to = NaN; from 1e-2 to 1e-8
        ",
    );
    for command in ["table", "effects"] {
        workdir.refuses(format!(
            "
            1 | cost {command} missing.toml | cannot read missing.toml
            1 | cost {command} wrong.toml | wrong.toml; nu1 = 0.6; (-1, 0.5]
            1 | cost {command} scene.toml -o scene.toml | scene.toml; it is the input
            1 | cost {command} scene.toml -o none/x.csv | none/x.csv; there is no folder
            "
        ));
    }
    assert_eq!(workdir.read("scene.toml"), SCENE.as_bytes());
}
