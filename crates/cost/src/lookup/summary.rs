//! The lookups summed up as Markdown.

use super::{FURTHER, NEW, Row};
use crate::clock::human;

/// Returns a table in Markdown: a line for each form, with two of its times.
pub fn markdown(rows: &[Row]) -> String {
    let mut text = format!(
        "| form | {NEW} | {FURTHER} | load: median error | largest | with adhesion: median | largest |\n|---|---|---|---|---|---|---|\n"
    );
    let (mut scope, mut points) = ("", 0);
    for group in rows.chunk_by(|a, b| (&a.scope, &a.form) == (&b.scope, &b.form)) {
        let first = &group[0];
        if first.scope != scope {
            (scope, points) = (&first.scope, first.points);
            text += &format!(
                "| *{points} points, {}, at a given {}* | | | | | | |\n",
                scope.replace("/E2", "/E2\\*"),
                first.at
            );
        }
        let time = |what| {
            group
                .iter()
                .find(|row| row.what == what)
                .map_or_else(|| "–".to_owned(), |row| human(row.seconds))
        };
        let largest = if first.max_factor >= 2.0 {
            factor(first.max_factor)
        } else {
            percent(first.max_error)
        };
        let adhesive = |error: Option<f64>| match error {
            None => "–".to_owned(),
            Some(error) if error >= 10.0 => factor(1.0 + error),
            Some(error) => percent(error),
        };
        let errors = [
            percent(first.median_error),
            largest,
            adhesive(first.adhesive_median_error),
            adhesive(first.adhesive_max_error),
        ];
        let fewer = if first.points == points {
            String::new()
        } else {
            format!(" ({} points)", first.points)
        };
        text += &format!(
            "| {}{fewer} | {} | {} | {} |\n",
            first.form,
            time(NEW),
            time(FURTHER),
            errors.join(" | ")
        );
    }
    text
}

/// Returns an error with one digit, in percent from 1e-3 on.
fn percent(error: f64) -> String {
    if error < 1e-3 {
        format!("{error:.0e}")
    } else {
        format!("{} %", one_digit(100.0 * error))
    }
}

/// Returns a factor with one digit.
fn factor(factor: f64) -> String {
    format!("× {}", one_digit(factor))
}

/// Returns a number rounded to one digit.
fn one_digit(number: f64) -> f64 {
    format!("{number:.0e}")
        .parse()
        .expect("a printed number is read")
}
