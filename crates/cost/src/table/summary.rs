//! The tables summed up as Markdown.

use super::evaluation::POINTS;
use super::{Row, TOLERANCES};
use crate::clock::human;
use crate::numbers::{grouped, human_bytes, human_count};

/// Returns two tables in Markdown: the tables that were made, and their break-even with direct
/// solves. Names the tolerances that have no row.
pub fn markdown(rows: &[Row]) -> String {
    let threads = rows.first().map_or(0, |row| row.threads);
    let mut text = format!(
        "| tolerance | nodes | solves | time, {threads} threads | .h5 | certified error | ranks | packed | certified error |\n"
    );
    text += "|---|---|---|---|---|---|---|---|---|\n";
    for row in rows {
        let joined = |numbers: &[u64], between| {
            numbers
                .iter()
                .map(u64::to_string)
                .collect::<Vec<_>>()
                .join(between)
        };
        let (nodes, ranks) = (
            joined(&row.nodes(), " × "),
            joined(&[row.rank_1, row.rank_2, row.rank_3], ", "),
        );
        let (solves, seconds) = (grouped(row.solves), human(row.seconds));
        let [dense, packed] = [row.dense_bytes, row.packed_bytes].map(human_bytes);
        let Row {
            tolerance,
            dense_error,
            packed_error,
            ..
        } = row;
        text += &format!(
            "| {tolerance:e} | {nodes} | {solves} | {seconds} | {dense} | {dense_error:.1e} | {ranks} | {packed} | \
             {packed_error:.1e} |\n"
        );
    }
    text += "\n| tolerance | direct solve | curve of a new material | further point | break-even after N evaluations of new materials | after N further points |\n";
    text += "|---|---|---|---|---|---|\n";
    for row in rows {
        let [solve, curve, point] =
            [row.solve_seconds, row.curve_seconds, row.point_seconds].map(human);
        let [alone, along] = [row.break_even_alone, row.break_even_along].map(human_count);
        text += &format!(
            "| {:e} | {solve} | {curve} | {point} | {alone} | {along} |\n",
            row.tolerance
        );
    }
    text += &format!(
        "\nA certified error is the largest relative error at sampled points. A solve or a lookup is a mean over {POINTS} \
         random points of the scene, on one thread; lookups are in the packed table. A table costs the processor time of \
         {threads} threads that make and pack it, and saves the time of a solve less that of a lookup at each evaluation. \
         Break-even is after N evaluations, where both are equal.\n"
    );
    let missing: Vec<String> = TOLERANCES
        .into_iter()
        .filter(|&tolerance| rows.iter().all(|row| row.tolerance != tolerance))
        .map(|tolerance| format!("{tolerance:e}"))
        .collect();
    if !missing.is_empty() {
        text += &format!("Tolerances without a table: {}.\n", missing.join(", "));
    }
    text
}
