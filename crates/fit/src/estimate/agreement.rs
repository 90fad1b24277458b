//! Whether the model describes the data to their noise.
//!
//! Where the noise is not known it is estimated from the residuals, and then a sum of squares tells
//! nothing. What tells is whether neighbouring residuals are alike: half the mean square of their
//! differences is the variance of independent noise, whatever smooth misfit it stands on.

use nalgebra::DVector;

use super::doubts::{BEYOND_CHANCE, Warnings};
use super::problem::{Assigned, Problem};
use crate::statistics::{CLIPPED, clipped, excess, likeness_of_neighbours};
use crate::{Branch, Fit, Loss, WarningKind};

/// The excess of squares over those of one outlier in ten points, in standard deviations, from which
/// outliers are not the reason. One fit in a thousand with so many outliers exceeds it.
const BEYOND_OUTLIERS: f64 = 3.0;

/// Warns if the residuals exceed the noise by more than chance: their squares, or under a robust
/// loss, which forgives outliers, squares of which none counts more than that of two deviations.
pub(super) fn add(
    warnings: &mut Warnings,
    fit: &Fit,
    problem: &Problem<'_>,
    residuals: &DVector<f64>,
) {
    let freedom = fit.degrees_of_freedom as f64;
    let Some(reduced) = fit.reduced_chi_squared else {
        beside_neighbours(warnings, problem, residuals);
        return;
    };
    let how = match problem.loss {
        Loss::Squares => (excess(fit.chi_squared, freedom) > BEYOND_CHANCE)
            .then(|| format!("reduced chi^2 is {reduced:.3}")),
        _ => {
            let (mean, [chance, outliers]) = clipped(residuals.as_slice(), freedom);
            (chance > BEYOND_CHANCE && outliers > BEYOND_OUTLIERS).then(|| {
                format!(
                    "with residuals beyond 2 standard deviations counted as 2, their mean square \
                     is {mean:.2}, and by chance {:.2}",
                    CLIPPED[0]
                )
            })
        }
    };
    if let Some(how) = how {
        warnings.add(
            WarningKind::PoorFit,
            format!("the model does not describe the data to their noise: {how}"),
        );
    }
}

/// Warns if the residuals of an experiment without a known noise exceed the noise that neighbouring
/// residuals show.
fn beside_neighbours(warnings: &mut Warnings, problem: &Problem<'_>, residuals: &DVector<f64>) {
    let mut row = 0;
    for assigned in &problem.assigned {
        let count = assigned.counting();
        let own = residuals.rows(row, count);
        row += count;
        if assigned.experiment.usual_noise().is_some() {
            continue;
        }
        let found = [Branch::Advancing, Branch::Receding, Branch::Baseline].map(|branch| {
            let ordered = in_order(assigned, own.as_slice(), branch);
            likeness_of_neighbours(&ordered)
        });
        let worst = found
            .into_iter()
            .flatten()
            .max_by(|one, other| one[0].total_cmp(&other[0]));
        if let Some([_, ratio]) = worst.filter(|[deviations, _]| *deviations > BEYOND_CHANCE) {
            warnings.add(
                WarningKind::PoorFit,
                format!(
                    "{}: the model does not describe the data to the noise that neighbouring \
                     points show: reduced chi^2 is {ratio:.3} with this noise, or the noise is not \
                     independent",
                    assigned.experiment.measurement.name
                ),
            );
        }
    }
}

/// Returns the residuals of a branch by descending imposed value.
pub(super) fn in_order(assigned: &Assigned, residuals: &[f64], branch: Branch) -> Vec<f64> {
    let mut rows = vec![None; assigned.branches.len()];
    let counts = assigned
        .branches
        .iter()
        .enumerate()
        .filter(|(_, branch)| **branch != Branch::LeftOut);
    for ((i, _), residual) in counts.zip(residuals) {
        rows[i] = Some(*residual);
    }
    assigned
        .order
        .iter()
        .filter(|&&i| assigned.branches[i] == branch)
        .filter_map(|&i| rows[i])
        .collect()
}
