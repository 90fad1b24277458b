//! The doubt about an estimated noise that is not the same in contact and off contact, or at small and large
//! ordinates.
//!
//! Errors of the abscissae change the ordinates in contact alone: the baseline does not depend on them. One
//! noise that stands for both is too small in contact, where the moduli and the work of adhesion are told,
//! and the more so the longer the baseline is.

use crate::estimate::problem::assigned::Assigned;
use crate::model::Predicted;
use crate::statistics::{BEYOND_CHANCE, far, ratio_of_squares};
use crate::{Warning, WarningKind};

/// The fewest degrees of freedom that tell the scatter of a part.
const FEWEST: f64 = 10.0;
/// The fewest of a half of the points.
const FEWEST_OF_HALF: f64 = 4.0;

/// Warns if the residuals of an experiment, in units of its estimated noise, are larger in contact than off
/// contact by more than chance makes them. `predicted` are the fitted states of
/// all points; the leverage of a point is the part of its noise that the fit follows.
pub(crate) fn doubt(
    assigned: &Assigned,
    predicted: &Predicted,
    (residuals, leverages): (&[f64], &[f64]),
) -> Option<Warning> {
    let (experiment, radii) = (&assigned.experiment, &predicted.radii);
    if experiment.usual_noise().is_some() || !assigned.abscissa_errors.is_empty() {
        return None;
    }
    let part = |in_contact: bool| -> Vec<[f64; 2]> {
        let points = assigned.counting_points();
        let points = points.zip(residuals.iter().zip(leverages));
        let own = points.filter(|(i, _)| (radii[*i] > 0.0) == in_contact);
        own.map(|(_, (residual, leverage))| [residual.abs(), *leverage])
            .collect()
    };
    let [contact, apart] = [true, false].map(part);
    let [of_contact, of_apart] = [&contact, &apart].map(|part| freedom(part));
    if of_contact.min(of_apart) < FEWEST {
        // The noise of a contact stiffness is relative to it.
        return if experiment.measurement.kind.is_stiffness() {
            None
        } else {
            grows(assigned, &predicted.values, (residuals, leverages))
        };
    }
    // An outlier would stand for the scatter of all.
    let far = far(contact.iter().map(|[size, _]| *size));
    let in_contact = scatter(&contact, far);
    let off_contact = scatter(&apart, f64::INFINITY);
    let told = contact.iter().map(|[_, leverage]| *leverage).sum::<f64>();
    // Outliers may make the estimated noise larger than the scatter of the others: no error is too small.
    if in_contact <= 1.0
        || told == 0.0
        || ratio_of_squares([in_contact, off_contact], [of_contact, of_apart]) <= BEYOND_CHANCE
    {
        return None;
    }
    // The variance of what the points tell, over that with the estimated noise.
    let free = |leverage: f64| (1.0 - leverage).max(f64::EPSILON);
    let own = contact
        .iter()
        .map(|[size, leverage]| leverage * size * size / free(*leverage));
    let factor = (own.sum::<f64>() / told).sqrt();
    let beside = if off_contact > 0.0 {
        let ratio = (in_contact / off_contact).sqrt();
        format!("{ratio:.1} times as much as those off contact")
    } else {
        "and those off contact do not".into()
    };
    let [abscissa, ordinate] = experiment.measurement.kind.names();
    Some(WarningKind::UnequalNoise.with(format!(
        "{}: points in contact scatter {beside}, and the noise of the {ordinate} is estimated from both: the \
         standard errors of what contacts tell are too small, by a factor of some {factor:.1}. If the model is \
         right, errors of the {abscissa} are the reason, or the noise of the {ordinate} is larger in contact: give \
         the errors of the {abscissa} their size, or each point its standard deviation",
        experiment.measurement.name
    )))
}

/// Warns if the residuals of a file without a baseline are larger at the larger ordinates than at the smaller
/// ones by more than chance makes them. The ordinates are those of the fit,
/// because an error makes a measured one larger.
fn grows(
    assigned: &Assigned,
    fitted: &[f64],
    (residuals, leverages): (&[f64], &[f64]),
) -> Option<Warning> {
    let experiment = &assigned.experiment;
    let points = assigned.counting_points();
    let all = points.zip(residuals.iter().zip(leverages));
    let sizes = |(i, (r, leverage)): (usize, (&f64, &f64))| (fitted[i].abs(), [r.abs(), *leverage]);
    let mut all: Vec<(f64, [f64; 2])> = all.map(sizes).collect();
    all.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let all: Vec<[f64; 2]> = all.into_iter().map(|(_, own)| own).collect();
    let (small, large) = all.split_at(all.len() / 2);
    let [of_small, of_large] = [small, large].map(freedom);
    if of_small.min(of_large) < FEWEST_OF_HALF {
        return None;
    }
    let far_of = |part: &[[f64; 2]]| far(part.iter().map(|[size, _]| *size));
    // What is far from all points may be the larger half of them: the doubt is then weaker, and its number is of each
    // half by itself.
    let beyond = far_of(&all);
    let [at_small, at_large] = [small, large].map(|part| scatter(part, beyond));
    if ratio_of_squares([at_large, at_small], [of_large, of_small]) <= BEYOND_CHANCE {
        return None;
    }
    let [at_small, at_large] = [small, large].map(|part| scatter(part, far_of(part)));
    let [abscissa, ordinate] = experiment.measurement.kind.names();
    Some(WarningKind::UnequalNoise.with(format!(
        "{}: points at the larger half of the {ordinate}s scatter {:.1} times as much as those at the smaller one, \
         and one noise is estimated for all: standard errors and intervals are not right. If the model is right, \
         the noise grows with the {ordinate}, or errors of the {abscissa} are the reason: give each point its \
         standard deviation, or the errors of the {abscissa} their size",
        experiment.measurement.name,
        (at_large / at_small).sqrt(),
    )))
}

/// Returns the mean square of residuals with their leverages; none counts for more than the square of `far`.
fn scatter(points: &[[f64; 2]], far: f64) -> f64 {
    let squares = points.iter().map(|[size, _]| size.min(far).powi(2));
    squares.sum::<f64>() / freedom(points)
}

/// Returns the degrees of freedom of points with their leverages.
fn freedom(points: &[[f64; 2]]) -> f64 {
    points.iter().map(|[_, leverage]| 1.0 - leverage).sum()
}
