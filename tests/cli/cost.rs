//! The options that all `tabulate cost` commands share: rows that are summed up again, and compared
//! with those of another run.

use acceptance::{Refused, workdir};
use cost::effects::{Row, markdown};
use cost::{compare, to_csv};
use tabulate::measure::read_csv;

const SCENE: &str = "\
title = 'A line'
a_over_t = 1
e1_over_e2 = { from = 0.3, to = 3 }
nu1 = 0.5
e0_over_e2 = 10
";

const MEASURE: &str = "cost effects scene.toml --tolerance 1e-2 --points 200";

#[test]
fn rows_are_summed_up_and_compared_with_those_of_another_run() {
    let workdir = workdir!();
    workdir.write("scene.toml", SCENE);
    let printed = workdir.succeed(format!("{MEASURE} -o rows.csv"));
    assert_eq!(workdir.succeed("cost effects --data rows.csv"), printed);

    assert_eq!(workdir.files(), ["rows.csv", "scene.toml"]);
    // The rows with one cell of the third changed, against themselves. There is no second run, as
    // it has other times.
    let rows: Vec<Row> = read_csv(&workdir.path("rows.csv")).expect("its own");
    assert_eq!(printed, markdown(&rows));
    assert_eq!(to_csv(&rows), workdir.read("rows.csv"));
    let compared = |change: fn(&mut Row)| {
        let mut before = rows.clone();
        change(&mut before[2]);
        compare(&before, &rows)
    };
    let noise: [fn(&mut Row); 4] = [
        |row| row.seconds *= 1e3,
        |row| row.saved_seconds = row.saved_seconds.map_or(Some(1.0), |_| None),
        |row| row.threads += 1,
        |row| row.worst_error *= 1.0 + 1e-3,
    ];
    assert!(noise.into_iter().all(|change| compared(change).is_ok()));
    compared(|row| row.worst_error *= 1.02).refused("row 3; worst_error was");
    compared(|row| row.solves += 1).refused("row 3; solves was");
    compare(&rows[..2], &rows).refused("the number of rows was 2 and is");

    workdir.write("partial.csv", to_csv(&rows[1..2]));
    workdir.refuses("1 | plot effects --data partial.csv -o x.svg | no row of the whole scene");
}

#[test]
fn rows_that_cannot_be_read_are_an_error_before_anything_is_measured() {
    let workdir = workdir!();
    workdir.write("other.csv", "a,b\n1,2\n");
    workdir.write("empty.csv", "");
    workdir.refuses(
        "
        1 | cost solve --data missing.csv | missing.csv
        1 | cost solve --data other.csv | other.csv
        1 | cost solve --compare missing.csv | missing.csv
        1 | cost solve --compare other.csv | other.csv
        1 | cost effects --data empty.csv | empty.csv; it has no rows
        1 | plot effects --data empty.csv -o x.svg | empty.csv; it has no rows
        ",
    );
    workdir.fail(2, "cost effects scene.toml --data other.csv");
    workdir.fail(2, "cost solve --data other.csv --compare other.csv");
    workdir.fail(2, "cost solve --data other.csv -o rows.csv");
}
