//! Whether the model describes the data to their noise.

use nalgebra::DVector;

use super::problem::Problem;
use super::warnings::{BEYOND_CHANCE, Warnings};
use crate::statistics::{CLIPPED, clipped, excess};
use crate::{Fit, Loss, WarningKind};

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
        return;
    };
    let how = match problem.loss {
        Loss::Squares => (excess(fit.chi_squared, freedom) > BEYOND_CHANCE)
            .then(|| format!("reduced chi^2 is {reduced:.3}")),
        _ => {
            let [mean, excess] = clipped(residuals.as_slice(), freedom);
            (excess > BEYOND_CHANCE).then(|| {
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
