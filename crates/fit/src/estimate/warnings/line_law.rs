//! The doubt that adhesion follows another law of the speed of the contact line than the one fitted.
//!
//! Speeds of neighbours are read from the same radii, so that residuals are alike and do not tell whether the model
//! holds. Rao's score test does: of a work of adhesion of its own for each of up to four ranges of the speed of a line
//! that advances, and of one that recedes. Where it finds none, the retracts are fitted alone.

use nalgebra::DVector;

use super::wanted::{Score, column};
use crate::estimate::minima::search::{COARSE, PATIENCE};
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::slot::Slot;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::estimate::problem::{Ending, Problem};
use crate::statistics::excess;
use crate::{Branch, Parameter, Warning, WarningKind};

/// The most ranges of the speed of a line that advances, and of one that recedes; and the fewest points in a range.
const RANGES: usize = 4;
const FEWEST: usize = 5;
/// The size of a speed, in its standard deviations, from which on the line counts as moving.
const MOVES: f64 = 3.0;
/// The share of a column's norm that is no combination of the other columns, below which the column is not counted.
const LEFT: f64 = 0.2;
/// The excess of the gain from which on the law is doubted, in standard deviations: hardly one sound fit is beyond it
/// (`tests/fit/line_speed.rs` counts them).
const DOUBTED: f64 = 5.0;
/// By how many of its standard errors the work of adhesion of retracts alone is less than that of both ways, at least: none of
/// 1000 sound fits is beyond it (`tests/fit/line_speed.rs`). Where it is more than that of both ways, retracts alone may err.
const LESS: f64 = 2.8;
/// The rounds in which the weights of retracts alone become those of their fit.
const ROUNDS: usize = 3;

/// Returns the doubt about the law of experiment `e`, if works of adhesion of their own gain more than chance, and what
/// they gain, in units of the variance of the residuals.
pub(super) fn doubt(score: &Score<'_>, e: usize) -> Option<(Warning, f64)> {
    let own = &score.problem.assigned[e];
    let experiment = &own.experiment;
    if !experiment.has_line_law() {
        return None;
    }
    // Where the speed most likely is: one that was read too large would have a residual of one sign.
    let speed = |i: usize| {
        let error = own.abscissa_errors.get(i);
        experiment.line_speeds[i].speed + error.map_or(0.0, |error| error.speed_shift)
    };
    // Where a line may rest the law is steepest, and the mean of what errors of the speed make of it is not 0.
    let moves = |i: usize| {
        let line = experiment.line_speeds[i];
        speed(i).abs() >= MOVES * line.deviation
    };
    let ranges = ranges(
        own.counting_points(),
        |i| own.branches[i].is_contact() && moves(i),
        speed,
    );
    let works = Parameter::WORKS.into_iter();
    let works: Vec<DVector<f64>> = works
        .filter_map(|work| column(score.problem, e, work, |_| true))
        .collect();
    let rows = &score.problem.rows_of_experiments()[e];
    let mut row_of = vec![0; own.branches.len()];
    for (row, i) in rows.clone().zip(own.counting_points()) {
        row_of[i] = row;
    }
    let of_range = |range: &Vec<usize>| {
        let mut column = DVector::zeros(score.residuals.len());
        for row in range.iter().map(|&i| row_of[i]) {
            column[row] = works.iter().map(|work| work[row]).sum();
        }
        column
    };
    let columns: Vec<DVector<f64>> = ranges.iter().map(of_range).collect();
    let (chi_squared, freedom) = joint_gain(score, &columns);
    // Residuals of neighbours that are alike have a variance below 1, but the mean over a range has the stated one.
    let significance = score.significance(chi_squared).min(chi_squared);
    if freedom == 0 || excess(significance, freedom as f64) <= DOUBTED {
        return None;
    }
    let gains = columns
        .iter()
        .zip(&ranges)
        .filter_map(|(column, range)| Some((score.gain(column)?, range)));
    let (most, range) =
        gains.max_by(|one, other| one.0.chi_squared.total_cmp(&other.0.chi_squared))?;
    let [first, last] = [range[0], range[range.len() - 1]];
    let work = experiment.work_of(own.branches[first]);
    let way = if speed(first) > 0.0 {
        "recedes"
    } else {
        "advances"
    };
    let doubt = WarningKind::PoorFit.with(format!(
        "{}: adhesion does not follow this law of the speed of the contact line: with a work of adhesion of its own in each of \
         {} ranges of the speed, chi^2 would be lower by {chi_squared:.0}, most where the line {way} with {:.1e} to {:.1e} m/s, \
         where it would be {:.0} % {}. Values may be wrong by far more than their standard errors. Fit the \
         retract alone, which does not rest on the law of a line that advances; and check the zero and the drift of the load, \
         and that loads and radii are of the same times",
        experiment.measurement.name,
        ranges.len(),
        speed(first).abs(),
        speed(last).abs(),
        1e2 * (most.change / work).abs(),
        if most.change > 0.0 { "larger" } else { "smaller" },
    ));
    Some((doubt, significance))
}

/// Returns the doubt that the retracts, fitted alone, have less work of adhesion: where the line is always much faster than
/// the doubling speed, the other values make up for a wrong law of the line that advances.
pub(super) fn doubt_of_retracts(problem: &Problem<'_>) -> Option<Warning> {
    let has_both = |own: &Assigned| {
        let has = |way| own.branches.contains(way);
        own.experiment.has_line_law() && Branch::CONTACTS.iter().all(has)
    };
    let is_work = |slot: &Slot| slot.parameter == Parameter::WorkOfAdhesion;
    let slot = problem.slots.iter().position(is_work)?;
    let cycle = problem.assigned.iter().find(|own| has_both(own))?;
    let mut retracts = problem.clone();
    let branches = retracts.assigned.iter_mut().filter(|own| has_both(own));
    let branches = branches.flat_map(|own| own.branches.iter_mut());
    for branch in branches.filter(|branch| **branch == Branch::Advancing) {
        *branch = Branch::LeftOut;
    }
    retracts.update().ok()?;
    for _ in 0..ROUNDS {
        retracts.weigh().ok()?;
        retracts = retracts.minimise(PATIENCE, COARSE);
    }
    let error = Uncertainty::of(&retracts)?.relative_error(slot);
    let [both, alone] = [problem, &retracts].map(|one| one.value(slot));
    let is_less = (both / alone).ln() > LESS * error;
    (is_less && retracts.ending == Ending::Converged).then(|| {
        WarningKind::PoorFit.with(format!(
            "{}: adhesion does not follow this law of the speed of the contact line both ways: the retract alone has \
             work-of-adhesion = {alone:.2e} +- {:.1e} J/m^2, in place of {both:.2e} J/m^2. Fit the retract alone, which does \
             not rest on the law of a line that advances",
            cycle.experiment.measurement.name,
            alone * error
        ))
    })
}

/// Returns the points in ranges of the speed: of a line that advances, then of one that recedes, each by rising size.
fn ranges(
    points: impl Iterator<Item = usize>,
    counts: impl Fn(usize) -> bool,
    speed: impl Fn(usize) -> f64,
) -> Vec<Vec<usize>> {
    let (receding, advancing): (Vec<usize>, Vec<usize>) =
        points.filter(|&i| counts(i)).partition(|&i| speed(i) > 0.0);
    let in_ranges = |mut way: Vec<usize>| {
        way.sort_by(|&i, &j| speed(i).abs().total_cmp(&speed(j).abs()));
        let count = (way.len() / FEWEST).min(RANGES);
        let size = way
            .len()
            .checked_div(count)
            .map_or(usize::MAX, |size| size + 1);
        let ranges = way.chunks(size).filter(|range| range.len() >= FEWEST);
        ranges.map(<[usize]>::to_vec).collect::<Vec<_>>()
    };
    [advancing, receding].map(in_ranges).concat()
}

/// Returns the gain of all columns together, and how many of them are no combination of the others and of the fitted ones.
fn joint_gain(score: &Score<'_>, columns: &[DVector<f64>]) -> (f64, usize) {
    let (mut apart, mut chi_squared) = (Vec::<DVector<f64>>::new(), 0.0);
    for column in columns {
        let mut rest = score.uncertainty.without_fitted(column);
        for other in &apart {
            let along = rest.dot(other);
            rest.axpy(-along, other, 1.0);
        }
        let length = rest.norm();
        if length > LEFT * column.norm() {
            rest /= length;
            chi_squared += score.residuals.dot(&rest).powi(2);
            apart.push(rest);
        }
    }
    (chi_squared, apart.len())
}
