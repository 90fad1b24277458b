//! The doubt about an estimated noise that is not the same in contact and off contact.
//!
//! Errors of the abscissae change the ordinates in contact alone: the baseline does not depend on them. One
//! noise that stands for both is too small in contact, where the moduli and the work of adhesion are told,
//! and the more so the longer the baseline is.

use super::doubts::{BEYOND_CHANCE, Warnings};
use super::problem::Assigned;
use crate::WarningKind;
use crate::statistics::{MEDIAN, median};

/// The residual over the robust standard deviation of its part, from which on it counts as if it were this
/// one: an outlier would stand for the scatter of all.
const FAR: f64 = 3.0;
/// The fewest degrees of freedom that tell the scatter of a part.
const FEWEST: f64 = 8.0;

/// Warns if the residuals of an experiment, in units of its estimated noise, are larger in contact than off
/// contact by more than chance makes them. `radii` are the fitted contact radii of all points.
pub(super) fn add(
    warnings: &mut Warnings,
    assigned: &Assigned,
    radii: &[f64],
    residuals: &[f64],
    leverages: &[f64],
) {
    let experiment = &assigned.experiment;
    if experiment.usual_noise().is_some() || !assigned.abscissa_parts.is_empty() {
        return;
    }
    let part = |in_contact: bool| {
        let points = assigned
            .counting_points()
            .zip(residuals.iter().zip(leverages));
        let own = points.filter(|(i, _)| (radii[*i] > 0.0) == in_contact);
        let own = own.map(|(_, (residual, leverage))| (residual.abs(), 1.0 - leverage));
        let (sizes, free): (Vec<f64>, Vec<f64>) = own.unzip();
        Scatter::new(&sizes, free.iter().sum())
    };
    let [contact, apart] = [true, false].map(part);
    if contact.freedom.min(apart.freedom) < FEWEST {
        return;
    }
    let spread = (2.0 / contact.freedom + 2.0 / apart.freedom).sqrt();
    let ratio = contact.mean_square / apart.mean_square;
    // An estimated noise is what all residuals make of it: smaller ones are rounding.
    if contact.mean_square <= 1.0 || ratio.ln() <= BEYOND_CHANCE * spread {
        return;
    }
    let beside = if ratio.is_finite() {
        format!("{:.1} times as much as those off contact", ratio.sqrt())
    } else {
        "and those off contact do not".into()
    };
    let [abscissa, ordinate] = experiment.measurement.kind.names();
    warnings.add(
        WarningKind::UnequalNoise,
        format!(
            "{}: points in contact scatter {beside}, and the noise of the \
             {ordinate} is estimated from both: the standard errors of what contacts tell are too small, by a \
             factor of up to {:.1}. Errors of the {abscissa} have this effect: give their size, or leave out \
             points off contact",
            experiment.measurement.name,
            contact.mean_square.sqrt()
        ),
    );
}

/// How much the residuals of a part scatter.
struct Scatter {
    mean_square: f64,
    freedom: f64,
}

impl Scatter {
    /// Returns the scatter of residuals of these `sizes`, which have a `freedom` of their own.
    fn new(sizes: &[f64], freedom: f64) -> Self {
        let far = FAR * median(sizes.to_vec()) / MEDIAN;
        let far = if far > 0.0 { far } else { f64::INFINITY };
        let squares = sizes.iter().map(|size| size.min(far).powi(2));
        Self {
            mean_square: squares.sum::<f64>() / freedom,
            freedom,
        }
    }
}
