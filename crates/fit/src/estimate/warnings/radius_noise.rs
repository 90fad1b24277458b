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
/// no outlier decides. Of sound data sets of 12 to 40 points at most one in a hundred reaches it; errors of radii that
/// are the larger ones do mostly.
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

/// Warns if the residuals of experiment `e` are more likely errors of the contact radii than of the ordinates.
pub(crate) fn doubt(problem: &Problem<'_>, e: usize, estimates: &[Estimate]) -> Option<Warning> {
    let assigned = &problem.assigned[e];
    let experiment = &assigned.experiment;
    let kind = experiment.measurement.kind;
    let slots = problem.slots_of(e);
    let is_told = |slot: &usize| {
        let one = &estimates[*slot];
        !problem.slots[*slot].coordinate.is_at_bound(one.value)
            && !(one.parameter.is_positive() && one.standard_error > one.value)
    };
    let is_sought = matches!(kind, Kind::LoadRadius | Kind::PenetrationRadius)
        && experiment.usual_noise().is_none()
        && assigned.abscissa_errors.is_empty()
        && assigned.counting() >= FEWEST
        && slots.iter().all(is_told)
        && !is_costly(problem);
    if !is_sought {
        return None;
    }
    let radii = experiment.measurement.points.iter();
    let widest = radii.fold(0.0, |widest: f64, point| widest.max(point.abscissa));
    let noise = assigned.noise;
    let mut other = problem.clone();
    let own = &mut other.assigned[e];
    own.noise = LEFT * noise;
    (own.experiment.noise, own.experiment.abscissa_noise) = (Some(own.noise), STEP * widest);
    other.weigh().ok()?;
    let errors = &other.assigned[e].abscissa_errors;
    let squares = assigned.counting_points().map(|i| errors[i].part.powi(2));
    let usual = (squares.sum::<f64>() / assigned.counting() as f64).sqrt();
    other.assigned[e].experiment.abscissa_noise *= noise / usual;
    for _ in 0..ROUNDS {
        other.weigh().ok()?;
        other.update().ok()?;
        other = other.minimise(PATIENCE, TOLERANCE);
        if other.ending != Ending::Converged {
            return None;
        }
    }
    other.weigh().ok()?;
    let [of_ordinates, of_radii] = [Residuals::of(problem, e)?, Residuals::of(&other, e)?];
    let by_radii = |without| of_radii.likelihood(without) - of_ordinates.likelihood(without);
    let without_one = (0..of_radii.squares.len()).map(|i| by_radii(Some(i)));
    let least = without_one.fold(f64::INFINITY, f64::min);
    if by_radii(None) < MORE_LIKELY || least < WITHOUT_ONE {
        return None;
    }
    let freedom = (assigned.counting() - slots.len()).max(1) as f64;
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
        ordinate = kind.names()[1]
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
