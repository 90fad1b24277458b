//! Whether the model describes the data to their noise.

use nalgebra::DVector;

use super::problem::Problem;
use super::warnings::{BEYOND_CHANCE, Warnings};
use crate::statistics::{excess, excess_of_median, median};
use crate::{Fit, Loss, WarningKind};

/// The median of residuals, over that of normal noise, below which outliers may be the reason: 19 %
/// of outliers raise it by as much.
const BY_OUTLIERS: f64 = 1.3;
/// The median of the absolute value of a normal number.
const HALF: f64 = 0.674_49;

/// Warns if the residuals exceed the noise by more than chance: their squares, or under a robust
/// loss, which forgives outliers, their median.
pub(super) fn add(
    warnings: &mut Warnings,
    fit: &Fit,
    problem: &Problem<'_>,
    residuals: &DVector<f64>,
) {
    let freedom = fit.degrees_of_freedom as f64;
    let Some(reduced) = fit.reduced_chi_squared else {
        return;
    };
    let how = match problem.loss {
        Loss::Squares => (excess(fit.chi_squared, freedom) > BEYOND_CHANCE)
            .then(|| format!("reduced chi^2 is {reduced:.3}")),
        _ => {
            let count = residuals.len() as f64;
            let sizes = residuals.iter().map(|residual| residual.abs()).collect();
            let ratio = median(sizes) / HALF * (count / freedom.max(1.0)).sqrt();
            (ratio > BY_OUTLIERS && excess_of_median(ratio, count) > BEYOND_CHANCE).then(|| {
                format!(
                    "half of the residuals exceed {:.2} standard deviations, and by chance {HALF:.2}",
                    HALF * ratio
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
