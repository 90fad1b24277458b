//! The solves summed up as Markdown.

use super::rows::{NYSTROM, NYSTROM_REACH, PAPER, REFUSED, Row, by_contact, fastest};
use crate::clock::human;

/// Returns three tables in Markdown: the paper's material, harder contacts, and Nyström's method
/// beside the solve.
pub fn markdown(rows: &[Row]) -> String {
    let (paper, harder): (Vec<&[Row]>, Vec<&[Row]>) =
        by_contact(rows).partition(|rows| rows[0].contact == PAPER);
    [
        paper_table(&paper),
        harder_table(&harder),
        nystrom_table(by_contact(rows)),
    ]
    .concat()
}

/// Time and achieved error at some tolerances.
fn paper_table(contacts: &[&[Row]]) -> String {
    let row = |rows: &&[Row]| {
        let cells = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12].map(|tolerance| {
            solved(rows, tolerance, |row, error| {
                format!("{} ({error:.0e})", human(row.seconds))
            })
        });
        let method = solved(rows, 1e-10, |row, _| row.method.clone());
        format!("| {} |{}{method}\n", rows[0].a_over_t, cells.concat())
    };
    let rows: String = contacts.iter().map(row).collect();
    format!(
        "The paper's material: time and, in brackets, achieved error at each tolerance\n\n\
         | a/t | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12 | method at 1e-10 |\n|---|---|---|---|---|---|---|\n{rows}"
    )
}

/// Method, size, time, estimated and achieved error at some tolerances.
fn harder_table(contacts: &[&[Row]]) -> String {
    let row = |rows: &&[Row]| {
        let cells = [1e-6, 1e-8, 1e-10].map(|tolerance| {
            solved(rows, tolerance, |row, error| {
                let (time, estimated) =
                    (human(row.seconds), row.error_estimated.unwrap_or(f64::NAN));
                format!(
                    "{} {}, {time} ({estimated:.0e}, {error:.0e})",
                    row.method, row.size
                )
            })
        });
        format!(
            "| {} | {} |{}\n",
            rows[0].contact,
            rows[0].a_over_t,
            cells.concat()
        )
    };
    let rows: String = contacts.iter().map(row).collect();
    format!(
        "\nHarder contacts: method, size of the system, time and, in brackets, estimated and achieved error at each tolerance\n\n\
         | contact | a/t | 1e-6 | 1e-8 | 1e-10 |\n|---|---|---|---|---|\n{rows}"
    )
}

/// Returns the cell of the solve to one tolerance.
fn solved(rows: &[Row], tolerance: f64, cell: impl Fn(&Row, f64) -> String) -> String {
    let row = rows
        .iter()
        .find(|row| row.tolerance == tolerance && row.method != NYSTROM);
    let text = row.map(|row| {
        row.error
            .map_or_else(|| REFUSED.to_owned(), |error| cell(row, error))
    });
    format!(" {} |", text.unwrap_or_default())
}

/// Nodes and time of Nyström's method for some errors, and the ratio of its time to that of the
/// solve.
fn nystrom_table<'a>(contacts: impl Iterator<Item = &'a [Row]>) -> String {
    let row = |rows: &[Row]| {
        let cells = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10].map(|error| {
            let pair = (
                fastest(rows, error, |method| method == NYSTROM),
                fastest(rows, error, |method| method != NYSTROM),
            );
            match pair {
                (Some(nystrom), Some(own)) => {
                    let ratio = nystrom.seconds / own.seconds;
                    format!(
                        " {} nodes, {} ({ratio:.0}) |",
                        nystrom.size,
                        human(nystrom.seconds)
                    )
                }
                _ => " not reached |".to_owned(),
            }
        });
        format!(
            "| {} | {} |{}\n",
            rows[0].contact,
            rows[0].a_over_t,
            cells.concat()
        )
    };
    let rows: String = contacts
        .filter(|rows| rows.iter().any(|row| row.method == NYSTROM))
        .map(row)
        .collect();
    format!(
        "\nNyström's method: nodes, time and, in brackets, its ratio to the time of the solve, for each achieved error\n\n\
         | contact | a/t | 1e-2 | 1e-4 | 1e-6 | 1e-8 | 1e-10 |\n|---|---|---|---|---|---|---|\n{rows}\
         \nNyström's method is left out above a/t = {NYSTROM_REACH}, where one of its solves takes seconds.\n"
    )
}
