//! The tables of a scene to one tolerance after another: the rows of `tabulate cost table`.

use std::time::Instant;

use cost::Measured;
use cost::clock::Timing;
use cost::table::{Evaluation, POINTS, Row, SEED, TOLERANCES, break_even};
use interp::Material;

use super::Made;
use super::limits::{check, is_limit, points};
use crate::Error;
use crate::table::{Budget, Observer, Scene, low_rank};

/// Makes the tables of a scene to the [`TOLERANCES`], from the loosest to the `tightest`, within a budget for all of
/// them. The scene's own tolerance is ignored.
///
/// The time of the next table is predicted from its planned nodes, the points of its two
/// certificates, and the time per point of the last table. A table that is still being solved when
/// the budget ends is given up. The first tolerance without a table, and the reason, is in
/// [`Measured::left_out`]. So is a loose one whose low-rank form misses it; then the next one is tried.
///
/// # Errors
/// Those of [`generate`](crate::table::generate()) and of packing if not even the first table can
/// be made; [`Error::Write`] for temporary files that cannot be written.
pub fn measure(
    scene: &Scene,
    tightest: f64,
    budget: Option<Budget<'_>>,
    timing: Timing,
    observer: &dyn Observer,
) -> Result<Measured<Row>, Error> {
    let mut measured = Measured::from(Vec::new());
    let rows: &mut Vec<Row> = &mut measured.rows;
    let mut missed = None;
    let mut seconds_per_point = None;
    for tolerance in TOLERANCES.into_iter().filter(|&one| one >= tightest) {
        let scene = Scene {
            tolerance,
            ..scene.clone()
        };
        let began = budget.map(|budget| budget.now());
        let made = budget
            .zip(seconds_per_point)
            .map_or(Ok(()), |(budget, seconds)| check(&scene, budget, seconds))
            .and_then(|()| row(&scene, budget, timing, observer));
        match made {
            Ok(row) => {
                seconds_per_point = budget.zip(began).map(|(budget, began)| {
                    let took = budget.now().saturating_sub(began).as_secs_f64();
                    took / points(&scene, row.nodes().iter().product())
                });
                rows.push(row);
            }
            // Another grid has another low-rank form.
            Err(error @ Error::Packed(_)) if rows.is_empty() => {
                measured.left_out.push(without(tolerance, &error, budget));
                missed = Some(error);
            }
            Err(error) if !rows.is_empty() && is_limit(&error) => {
                measured.left_out.push(without(tolerance, &error, budget));
                break;
            }
            Err(Error::Budget { spent }) => {
                return Err(Error::Budget {
                    spent: format!("{spent}{}", of_budget(budget)),
                });
            }
            Err(error) => return Err(error),
        }
    }
    match missed {
        Some(error) if measured.rows.is_empty() => Err(error),
        _ => Ok(measured),
    }
}

/// Says why there is no table, with the budget if it is about that.
fn without(tolerance: f64, error: &Error, budget: Option<Budget<'_>>) -> String {
    let budget = match error {
        Error::Budget { .. } => of_budget(budget),
        _ => String::new(),
    };
    format!("There is no table to {tolerance:e}: {error}{budget}.")
}

fn of_budget(budget: Option<Budget<'_>>) -> String {
    budget.map_or_else(String::new, |budget| {
        let whole = budget.whole().as_secs_f64();
        format!(" (--budget is {whole:?} s; give a larger one)")
    })
}

/// Makes, packs and times the table of a scene to its tolerance.
fn row(
    scene: &Scene,
    budget: Option<Budget<'_>>,
    timing: Timing,
    observer: &dyn Observer,
) -> Result<Row, Error> {
    let made = Made::new(scene, budget, observer).map_err(|error| match error {
        Error::Budget { .. } => Error::Budget {
            spent: format!("before the table to {:e} is finished", scene.tolerance),
        },
        error => error,
    })?;
    let began = Instant::now();
    let packed = low_rank(&made.table, scene.tolerance, None, None, observer)?;
    let packed_bytes = packed.to_packed()?.len() as u64;
    let pack_seconds = began.elapsed().as_secs_f64();
    let places = scene
        .random_points(POINTS, SEED)
        .into_iter()
        .map(|[a_over_t, e1, nu1, e0]| Ok((a_over_t, scene.material([e1, nu1, e0])?)))
        .collect::<Result<Vec<(f64, Material)>, Error>>()?;
    let evaluation =
        Evaluation::measure(&places, &scene.quantities, scene.tolerance, &packed, timing)?;
    let [
        a_over_t_nodes,
        e1_over_e2_nodes,
        nu1_nodes,
        e0_over_e2_nodes,
    ] = made.table.shape().map(|nodes| nodes as u64);
    let ranks = packed.ranks().unwrap_or_default();
    // The largest of all tiles.
    let [rank_1, rank_2, rank_3] = [0, 1, 2].map(|bond| {
        ranks
            .iter()
            .map(|ranks| ranks[bond] as u64)
            .max()
            .unwrap_or(0)
    });
    let mut row = Row {
        tolerance: scene.tolerance,
        a_over_t_nodes,
        e1_over_e2_nodes,
        nu1_nodes,
        e0_over_e2_nodes,
        solves: made.solves,
        threads: rayon::current_num_threads() as u64,
        seconds: made.seconds,
        dense_bytes: made.bytes,
        dense_error: made.table.description().certificate.max_error,
        pack_seconds,
        packed_bytes,
        packed_error: packed.description().certificate.max_error,
        rank_1,
        rank_2,
        rank_3,
        solve_seconds: evaluation.solve,
        curve_seconds: evaluation.curve,
        point_seconds: evaluation.point,
        break_even_alone: f64::NAN,
        break_even_along: f64::NAN,
    };
    let making = row.making();
    row.break_even_alone = break_even(
        making,
        evaluation.solve,
        evaluation.curve + evaluation.point,
    );
    row.break_even_along = break_even(making, evaluation.solve, evaluation.point);
    Ok(row)
}
