//! Whether the model describes the data to their noise.
//!
//! Where the noise is not known it is estimated from the residuals, and then a sum of squares tells
//! nothing. What tells is whether neighbouring residuals are alike: half the mean square of their
//! differences is the variance of independent noise, whatever smooth misfit it stands on. Where the
//! noise is known, neighbours that are alike tell that it is not independent.

use nalgebra::DVector;

use super::detector;
use super::radius_noise;
use super::shared_noise;
use super::unequal_noise;
use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::statistics::{
    BEYOND_CHANCE, CLIPPED, clipped, deviations, excess, far, likeness_of_neighbours,
    likeness_of_runs,
};
use crate::{Branch, Direction, Fit, Loss, Warning, WarningKind};

/// The excess of squares over those of one outlier in ten points, in standard deviations, from which
/// outliers are not the reason. One fit in a thousand with so many outliers exceeds it.
const BEYOND_OUTLIERS: f64 = 3.0;

/// The part of sound fits in which neighbours are alike by as many standard deviations as are doubted,
/// 3.1 in a fit of one experiment. At 4.5, noise with a correlation of 0.5 in 40 points would hardly be
/// found.
const ALIKE: f64 = 1e-3;
/// The number of neighbouring residuals whose means are the first to be compared; twice as many are the next.
const SHORTEST_RUN: usize = 8;
/// The ratio of the scatter to the given noise above which nothing is said.
const SMALLER: f64 = 0.8;

/// Adds the doubts about noise and agreement, from the residuals and the share of each that the fit
/// follows. Returns of each experiment whether its noise is not the same in contact and off contact.
pub(crate) fn add(
    warnings: &mut Vec<Warning>,
    fit: &Fit,
    problem: &Problem<'_>,
    (residuals, leverages): (&DVector<f64>, &[f64]),
) -> Vec<bool> {
    let freedom = fit.degrees_of_freedom as f64;
    let poor = fit.reduced_chi_squared.and_then(|reduced| {
        let sums = [fit.chi_squared, freedom, reduced];
        poor(problem.loss, residuals.as_slice(), sums)
    });
    let count = problem.assigned.len() as f64;
    let chance = ALIKE / count;
    let mut of_radii = radius_noise::doubts(problem, &fit.estimates, poor.is_some());
    warnings.extend(poor);
    let mut unequal = vec![false; problem.assigned.len()];
    let experiments = problem.assigned.iter().zip(&fit.experiments);
    let experiments = experiments.zip(problem.rows_of_experiments());
    for (e, ((assigned, fitted), rows)) in experiments.enumerate() {
        let own = residuals.rows(rows.start, rows.len());
        // Neighbours read the speeds of the contact line from the same radii, and their residuals are alike.
        if assigned.experiment.has_line_law() {
            continue;
        }
        let leverages = &leverages[rows];
        let followed: f64 = leverages.iter().sum();
        let freedom = own.len() as f64 - followed;
        warnings.extend(large_noise(assigned, own.norm_squared(), freedom));
        // Rounding makes neighbours alike.
        if detector::add(warnings, fitted, assigned) {
            continue;
        }
        // What shared noise makes too small misfits, so that neighbours are alike, and scatters in contact. A wrong
        // model scatters in contact, too.
        let doubt = shared_noise::doubt(problem, e, &fit.estimates)
            .or_else(|| beside_neighbours(assigned, own.as_slice(), chance))
            .or_else(|| {
                let states = &problem.predicted.as_ref()?[e];
                unequal_noise::doubt(assigned, states, (own.as_slice(), leverages))
            })
            .or_else(|| of_radii[e].take());
        let kind = doubt.as_ref().map(|one| one.kind);
        unequal[e] = matches!(
            kind,
            Some(WarningKind::SharedNoise | WarningKind::UnequalNoise)
        );
        warnings.extend(doubt);
    }
    unequal
}

/// Warns if the residuals exceed a noise that is given by more than chance: their squares, or under a
/// robust loss, which forgives outliers, squares of which none counts more than that of two
/// deviations.
fn poor(
    loss: Loss,
    residuals: &[f64],
    [chi_squared, freedom, reduced]: [f64; 3],
) -> Option<Warning> {
    let how = match loss {
        Loss::Squares => (excess(chi_squared, freedom) > BEYOND_CHANCE)
            .then(|| format!("reduced chi^2 is {reduced:.3}")),
        _ => {
            let (mean, [chance, outliers]) = clipped(residuals, freedom);
            (chance > BEYOND_CHANCE && outliers > BEYOND_OUTLIERS).then(|| {
                format!(
                    "with residuals beyond 2 standard deviations counted as 2, their mean square \
                     is {mean:.2}, and by chance {:.2}",
                    CLIPPED[0]
                )
            })
        }
    };
    let how = how?;
    let text = format!("the model does not describe the data to their noise: {how}");
    Some(WarningKind::PoorFit.with(text))
}

/// Warns if the residuals of an experiment are smaller than the errors that are given by more than
/// chance.
fn large_noise(assigned: &Assigned, chi_squared: f64, freedom: f64) -> Option<Warning> {
    let reduced = chi_squared / freedom;
    let is_small = excess(chi_squared, freedom) < -BEYOND_CHANCE && reduced.sqrt() < SMALLER;
    if !is_small {
        return None;
    }
    let experiment = &assigned.experiment;
    let [abscissa, ordinate] = experiment.measurement.kind.names();
    let is_known = experiment.usual_noise().is_some();
    let (too_large, remedy) = match (is_known, assigned.abscissa_errors.is_empty()) {
        // An estimated noise is what the residuals make of it.
        (false, true) => return None,
        (true, true) => (
            format!("noise that is given for the {ordinate} is"),
            "the noise of these data, or leave it out".to_string(),
        ),
        (true, false) => (
            format!("noise or the errors of the {abscissa} that are given are"),
            format!("those of these data, or leave the noise of the {ordinate} out"),
        ),
        (false, false) => (
            format!("errors that are given for the {abscissa} are"),
            "those of these data, or none".to_string(),
        ),
    };
    Some(WarningKind::LargeNoise.with(format!(
        "{}: the {too_large} too large, by a factor of some {:.1}, and the standard errors with \
         it: the data scatter less, reduced chi^2 is {reduced:.2e}; give {remedy}",
        experiment.measurement.name,
        reduced.sqrt().recip()
    )))
}

/// Warns if residuals whose noise is not given exceed the noise that neighbouring ones show, or else if
/// neighbouring residuals of an experiment are alike, or the means of some of them far from 0, by more
/// than independent noise is with the probability `chance`.
fn beside_neighbours(assigned: &Assigned, own: &[f64], chance: f64) -> Option<Warning> {
    let name = &assigned.experiment.measurement.name;
    // Neighbours are of one direction: noise that is not independent is so in time.
    let branches = [Branch::Advancing, Branch::Receding, Branch::Baseline];
    let ways = branches
        .iter()
        .flat_map(|branch| Direction::OF_POINTS.map(|way| (*branch, way)));
    let of_ways = |own: &[f64]| -> Vec<Vec<f64>> {
        ways.clone()
            .map(|way| in_order(assigned, own, way))
            .collect()
    };
    let of_neighbours = |ways: &[Vec<f64>]| {
        let found = ways.iter().filter_map(|ordered| {
            let [z, ratio] = likeness_of_neighbours(ordered)?;
            Some([z, ratio, ordered.len() as f64])
        });
        found.collect::<Vec<[f64; 3]>>()
    };
    let found = of_neighbours(&of_ways(own));
    let worst = found
        .iter()
        .max_by(|one, other| one[0].total_cmp(&other[0]));
    let is_known = assigned.experiment.usual_noise().is_some();
    if let Some([z, ratio, count]) = worst.filter(|[z, ..]| *z > BEYOND_CHANCE && !is_known) {
        return Some(WarningKind::PoorFit.with(format!(
            "{name}: the model does not describe the data to the noise that neighbouring \
             points show: reduced chi^2 is {ratio:.3} with this noise; or the noise is not \
             independent, and then standard errors are too small by a factor of {}",
            factor_of_errors(*z, *count)
        )));
    }
    // An outlier would hide the others.
    let far = far(own.iter().map(|r| r.abs()));
    let near: Vec<f64> = own.iter().map(|r| r.clamp(-far, far)).collect();
    let near = of_ways(&near);
    // All branches together, each by the number of its points.
    let found = of_neighbours(&near);
    let sum = |of: fn(&[f64; 3]) -> f64| found.iter().map(of).sum::<f64>();
    let points = sum(|[_, _, count]| *count);
    let deviations = sum(|[z, _, count]| z * count.sqrt()) / points.sqrt();
    let (what, deviations, factor) = if deviations > beyond(chance) {
        (
            "neighbouring residuals are alike".to_owned(),
            deviations,
            factor_of_errors(deviations, points),
        )
    } else if let Some((length, [deviations, ratio])) = slow(&near, chance) {
        let what = format!("the means of {length} neighbouring residuals are too far from 0");
        (what, deviations, format!("some {:.1}", ratio.sqrt()))
    } else {
        return None;
    };
    Some(WarningKind::StructuredResiduals.with(format!(
        "{name}: {what}, by {deviations:.1} standard deviations more than by chance. Either the \
         model or its fixed values do not describe the data, or the noise is not independent, and \
         then standard errors are too small by a factor of {factor}"
    )))
}

/// Returns the length of the runs whose means scatter the most, with their [`likeness_of_runs`]; `None` if
/// independent noise does so with a probability above `chance`.
fn slow(ways: &[Vec<f64>], chance: f64) -> Option<(usize, [f64; 2])> {
    let lengths = (0..).map(|i| SHORTEST_RUN << i);
    let found: Vec<(usize, [f64; 2])> = lengths
        .map_while(|length| Some((length, likeness_of_runs(ways, length)?)))
        .collect();
    let beyond = beyond(chance / found.len() as f64);
    let doubtful = found
        .into_iter()
        .filter(|(_, [deviations, _])| *deviations > beyond);
    doubtful.max_by(|one, other| one.1[1].total_cmp(&other.1[1]))
}

/// Returns the standard deviations that a normal number exceeds with a probability, but at most
/// [`BEYOND_CHANCE`].
fn beyond(chance: f64) -> f64 {
    deviations(1.0 - 2.0 * chance).min(BEYOND_CHANCE)
}

/// Returns in words the factor by which noise that is not independent makes the error of a mean larger, from how
/// many standard deviations neighbours of `count` points are alike. Their correlation falls by its own
/// value from point to point. Where neighbours are nearly equal, it tells a least factor only.
fn factor_of_errors(deviations: f64, count: f64) -> String {
    /// The largest correlation that is told from 1.
    const LARGEST: f64 = 0.99;
    let correlation = (deviations / count.sqrt()).clamp(0.0, LARGEST);
    let factor = ((1.0 + correlation) / (1.0 - correlation)).sqrt();
    let how = if correlation < LARGEST {
        "some"
    } else {
        "more than"
    };
    format!("{how} {factor:.1}")
}

/// Returns the residuals of a branch and direction by descending imposed value, and those of one reading
/// in time: a load that is held has residuals in the order of the errors of its abscissae.
fn in_order(
    assigned: &Assigned,
    residuals: &[f64],
    (branch, direction): (Branch, Option<Direction>),
) -> Vec<f64> {
    let mut rows = vec![None; assigned.branches.len()];
    for (i, residual) in assigned.counting_points().zip(residuals) {
        rows[i] = Some(*residual);
    }
    let points = &assigned.experiment.measurement.points;
    let is_own = |i: &usize| assigned.branches[*i] == branch && points[*i].direction == direction;
    let order = assigned.order.iter().copied();
    let mut order: Vec<usize> = order.filter(is_own).collect();
    for run in order.chunk_by_mut(|&i, &j| points[i].ordinate == points[j].ordinate) {
        run.sort_unstable();
    }
    order.into_iter().filter_map(|i| rows[i]).collect()
}
