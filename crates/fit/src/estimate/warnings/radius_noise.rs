//! The doubt that residuals at contact radii are errors of the radius, which the fit takes as exact.
//!
//! The fit is made again with errors of the radius, and with a small part of the noise of the ordinate. With the
//! deviation `s_i` of point `i` and its residual `r_i` in this unit, a likelihood with the most likely scale is
//!
//! ```text
//! 2 ln L = -n ln(sum r_i^2) - sum ln(s_i^2)
//! ```

use crate::estimate::minima::valley::is_costly;
use crate::estimate::problem::{Ending, Problem};
use crate::{Estimate, Kind, Warning, WarningKind};

/// The fewest points.
const FEWEST: usize = 12;
/// The difference of `2 ln L` from which on the radii are named, and that which must be left without any one point, so that
/// no outlier decides. Of sound data sets of 12 to 40 points at most one in a hundred reaches it; where the errors
/// of the radii are the larger ones, most data sets do.
const MORE_LIKELY: f64 = 5.0;
const WITHOUT_ONE: f64 = 2.0;
/// The step of a radius, in parts of the widest one, for the slopes.
const STEP: f64 = 1e-5;
/// The noise of the ordinate beside errors of the radius, in parts of the noise without.
const LEFT: f64 = 0.05;
/// The rounds of weights and values, the most evaluations of each over the number of parameters + 1, and the relative
/// changes at which it ends.
const ROUNDS: usize = 3;
const PATIENCE: usize = 30;
const TOLERANCE: f64 = 1e-6;

/// Returns for each experiment the warning that its residuals are more likely errors of the contact radii than of the
/// ordinates. One fit is made for all experiments that may have them: those whose noise is not known, and those with one
/// noise where the residuals are too large for it.
pub(crate) fn doubts(
    problem: &Problem<'_>,
    estimates: &[Estimate],
    are_too_large: bool,
) -> Vec<Option<Warning>> {
    let count = problem.assigned.len();
    let sought: Vec<usize> = (0..count)
        .filter(|&e| is_sought(problem, e, estimates, are_too_large))
        .collect();
    let mut warnings = vec![None; count];
    if let Some(other) = with_errors_of_radii(problem, &sought) {
        for e in sought {
            warnings[e] = doubt(problem, &other, e, estimates);
        }
    }
    warnings
}

/// Tells whether errors of its radii may be what an experiment has.
fn is_sought(problem: &Problem<'_>, e: usize, estimates: &[Estimate], are_too_large: bool) -> bool {
    let assigned = &problem.assigned[e];
    let experiment = &assigned.experiment;
    let is_told = |slot: &usize| {
        let one = &estimates[*slot];
        let is_open = one.parameter.is_positive() && one.standard_error > one.value;
        !(is_open || problem.slots[*slot].coordinate.is_at_bound(one.value))
    };
    matches!(
        experiment.measurement.kind,
        Kind::LoadRadius | Kind::PenetrationRadius
    ) && (experiment.noise.is_none() || are_too_large)
        && experiment.errors.ordinate.is_empty()
        && assigned.abscissa_errors.is_empty()
        && assigned.counting() >= FEWEST
        && problem.slots_of(e).iter().all(is_told)
        && !is_costly(problem)
}

/// Fits again with errors of the radii of some experiments, that make as much as their noise; `None` where there are none,
/// and where that fit does not converge.
fn with_errors_of_radii<'a>(problem: &Problem<'a>, sought: &[usize]) -> Option<Problem<'a>> {
    if sought.is_empty() {
        return None;
    }
    let mut other = problem.clone();
    for &e in sought {
        let own = &mut other.assigned[e];
        let radii = own.experiment.measurement.points.iter();
        let widest = radii.fold(0.0, |widest: f64, point| widest.max(point.abscissa));
        own.noise *= LEFT;
        (own.experiment.noise, own.experiment.abscissa_noise) = (Some(own.noise), STEP * widest);
    }
    other.weigh().ok()?;
    for &e in sought {
        let own = &mut other.assigned[e];
        let squares = own
            .counting_points()
            .map(|i| own.abscissa_errors[i].part.powi(2));
        let usual = (squares.sum::<f64>() / own.counting() as f64).sqrt();
        own.experiment.abscissa_noise *= problem.assigned[e].noise / usual;
    }
    for _ in 0..ROUNDS {
        other.weigh().ok()?;
        other.update().ok()?;
        other = other.minimise(PATIENCE, TOLERANCE);
        if other.ending != Ending::Converged {
            return None;
        }
    }
    other.weigh().ok()?;
    Some(other)
}

/// Compares the fit with that with errors of the radii in experiment `e`.
fn doubt(
    problem: &Problem<'_>,
    other: &Problem<'_>,
    e: usize,
    estimates: &[Estimate],
) -> Option<Warning> {
    let [of_ordinates, of_radii] = [problem, other].map(|of| Residuals::of(of, e));
    let (of_ordinates, of_radii) = (of_ordinates?, of_radii?);
    let by_radii = |without| of_radii.likelihood(without) - of_ordinates.likelihood(without);
    let count = of_radii.squares.len();
    let without_one = (0..count).map(|i| by_radii(Some(i)));
    let least = without_one.fold(f64::INFINITY, f64::min);
    // One of many files is far off by chance.
    let many = 2.0 * (problem.assigned.len() as f64).ln();
    if by_radii(None) < MORE_LIKELY + many || least < WITHOUT_ONE {
        return None;
    }
    let experiment = &problem.assigned[e].experiment;
    let slots = problem.slots_of(e);
    let freedom = count.saturating_sub(slots.len()).max(1) as f64;
    let scale = (of_radii.squares.iter().sum::<f64>() / freedom).sqrt();
    let deviation = scale * other.assigned[e].experiment.abscissa_noise;
    let names = problem.slot_names();
    let changes = slots.iter().map(|&slot| {
        let change = (other.value(slot) - estimates[slot].value) / estimates[slot].standard_error;
        format!("{} by {change:+.1} of its standard errors", names[slot])
    });
    let changes: Vec<String> = changes.collect();
    Some(WarningKind::RadiusNoise.with(format!(
        "{name}: the residuals are more likely errors of the contact radius, of some {deviation:.1e} m, than one noise of the \
         {ordinate}, which the fit takes for all points: standard errors may be too small. Give the errors of the contact \
         radius their size, which changes {}; or, if the noise of the {ordinate} grows with it, give each point its standard \
         deviation",
        changes.join(" and "),
        name = experiment.measurement.name,
        ordinate = experiment.measurement.kind.names()[1]
    )))
}

/// The squares of the residuals of one experiment, in units of their deviations, and the logarithms of these squared.
struct Residuals {
    squares: Vec<f64>,
    logarithms: Vec<f64>,
}

impl Residuals {
    fn of(problem: &Problem<'_>, e: usize) -> Option<Self> {
        let rows = problem.rows_of_experiments()[e].clone();
        let residuals = problem.plain_residuals()?;
        let own = residuals.rows(rows.start, rows.len());
        let assigned = &problem.assigned[e];
        let logarithm = |i| 2.0 * assigned.deviation(i).ln();
        Some(Self {
            squares: own.iter().map(|residual| residual * residual).collect(),
            logarithms: assigned.counting_points().map(logarithm).collect(),
        })
    }

    /// Returns twice the logarithm of the likelihood with the most likely scale of all deviations, `without` one point.
    fn likelihood(&self, without: Option<usize>) -> f64 {
        let sum = |values: &[f64]| values.iter().sum::<f64>() - without.map_or(0.0, |i| values[i]);
        let count = self.squares.len() - usize::from(without.is_some());
        -(count as f64) * sum(&self.squares).ln() - sum(&self.logarithms)
    }
}
