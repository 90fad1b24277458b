//! The noise of the ordinates, estimated from the residuals where nobody gives it.

use super::doubts::Warnings;
use super::problem::{Assigned, Problem};
use super::search::range;
use super::uncertainty::Uncertainty;
use crate::statistics::{median, student_deviations, weighted_median};
use crate::{Branch, Loss, WarningKind};

/// The change of an estimated noise that needs another round.
const CHANGE: f64 = 0.02;
/// The smallest noise, relative to the range of the ordinates, that an estimate can give.
const LEAST: f64 = 1e-12;
/// The noises that are tried beside errors of the abscissae: the first over the largest residual, the
/// ratio of one to the next, and the most of them, down to 1e-6 of the first.
const FIRST: f64 = 4.0;
const STEP: f64 = 1.2;
const TRIED: u32 = 77;
/// The fewest points that tell a noise.
const LEAST_TOLD: f64 = 2.0;
/// The median of the absolute value of a normal number.
const MEDIAN: f64 = 0.674_49;
/// The number of standard errors with 95 % of the true values, 2 with many points, from which the
/// noise is doubted.
const UNCERTAIN: f64 = 2.3;

/// Estimates the noise of the experiments in which it is not known. Returns the uncertainty with
/// the new noise, and whether the noise changed.
pub(super) fn estimate_noise(
    problem: &mut Problem<'_>,
    uncertainty: Uncertainty,
) -> (Uncertainty, bool) {
    let Some(mut residuals) = problem.plain_residuals() else {
        return (uncertainty, false);
    };
    let (mut row, mut changed) = (0, false);
    let mut jacobian = uncertainty.jacobian.clone();
    for assigned in &mut problem.assigned {
        let rows = row..row + assigned.counting();
        row = rows.end;
        if assigned.experiment.usual_noise().is_some() || rows.is_empty() {
            continue;
        }
        let leverages = &uncertainty.leverages[rows.clone()];
        let points = counting(assigned);
        let before: Vec<f64> = points.iter().map(|&i| assigned.deviation(i)).collect();
        let own = residuals.rows(rows.start, rows.len());
        let sizes = own.iter().zip(&before);
        let sizes: Vec<f64> = sizes.map(|(r, deviation)| (r * deviation).abs()).collect();
        let least = LEAST * range(&assigned.experiment);
        let noise = if assigned.abscissa_parts.is_empty() {
            let count = rows.len() as f64;
            let free = (count - leverages.iter().sum::<f64>()).max(0.5);
            let excess = match problem.loss {
                Loss::Squares => (own.norm_squared() / free).sqrt(),
                _ => median(own.iter().map(|r| r.abs()).collect()) / MEDIAN * (count / free).sqrt(),
            };
            excess * assigned.noise
        } else {
            beside_abscissae(assigned, problem.loss, &sizes, leverages)
        };
        let noise = noise.max(least);
        changed |= (assigned.noise / noise).ln().abs() > CHANGE;
        assigned.noise = noise;
        for ((row, &i), before) in rows.zip(&points).zip(before) {
            let ratio = before / assigned.deviation(i);
            residuals[row] *= ratio;
            jacobian.row_mut(row).scale_mut(ratio);
        }
    }
    let sizes = uncertainty.sizes;
    (
        Uncertainty::new(jacobian, &residuals, problem.loss, sizes),
        changed,
    )
}

/// Returns the largest noise at which the residuals are what chance makes of it and of the errors of
/// the abscissae, whose parts differ from point to point. A point weighs as in the restricted
/// likelihood of the noise (Patterson and Thompson, Biometrika 58, 545, 1971), by the share that the
/// noise has of its variance: chi^2 alone would leave the noise to points at which it is hidden. Where
/// errors of the abscissae explain the residuals alone, it is the least noise that [`LEAST_TOLD`]
/// points tell: with a smaller one a single point of no slope would draw the fit to itself.
fn beside_abscissae(assigned: &Assigned, loss: Loss, sizes: &[f64], leverages: &[f64]) -> f64 {
    let points = counting(assigned);
    let mut tried = assigned.clone();
    // The residuals in units of their deviations, over what chance makes of them; and how many tell.
    let mut at = |noise: f64| {
        tried.noise = noise;
        let of_points = points.iter().zip(sizes.iter().zip(leverages));
        let mut residuals: Vec<[f64; 2]> = of_points
            .map(|(&i, (size, leverage))| {
                let deviation = tried.deviation(i);
                let free = (1.0 - leverage).max(f64::EPSILON);
                [
                    size / deviation / free.sqrt(),
                    free * (noise / deviation).powi(2),
                ]
            })
            .collect();
        let excess = match loss {
            Loss::Squares => {
                let sum = |of: fn(&[f64; 2]) -> f64| residuals.iter().map(of).sum::<f64>();
                (sum(|[r, weight]| r * r * weight) / sum(|[_, weight]| *weight)).sqrt()
            }
            _ => weighted_median(&mut residuals) / MEDIAN,
        };
        (excess, told(&tried, &points, leverages))
    };
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let mut least = FIRST * largest;
    for _ in 0..TRIED {
        let (excess, told) = at(least);
        if excess > 1.0 {
            break;
        }
        if told < LEAST_TOLD {
            return least;
        }
        least /= STEP;
    }
    let mut most = least * STEP;
    while most > (1.0 + 0.1 * CHANGE) * least {
        let middle = (least * most).sqrt();
        let end = if at(middle).0 > 1.0 {
            &mut least
        } else {
            &mut most
        };
        *end = middle;
    }
    least
}

/// Returns how many points without errors of the abscissae would tell the noise as well as these.
fn told(assigned: &Assigned, points: &[usize], leverages: &[f64]) -> f64 {
    let of_point = |(&i, leverage): (&usize, &f64)| {
        let share = assigned.noise / assigned.deviation(i);
        (1.0 - leverage) * share.powi(4)
    };
    points.iter().zip(leverages).map(of_point).sum()
}

/// Warns of an estimated noise that few points tell, because the errors of the abscissae hide it at
/// the others.
pub(super) fn add(warnings: &mut Warnings, problem: &Problem<'_>, uncertainty: &Uncertainty) {
    let mut row = 0;
    for assigned in &problem.assigned {
        let points = counting(assigned);
        let leverages = &uncertainty.leverages[row..row + points.len()];
        row += points.len();
        let experiment = &assigned.experiment;
        if experiment.usual_noise().is_some() || assigned.abscissa_parts.is_empty() {
            continue;
        }
        let told = told(assigned, &points, leverages);
        let freedom = told.round().max(1.0) as usize;
        let within = student_deviations(0.95, freedom);
        if within > UNCERTAIN {
            let [abscissa, ordinate] = experiment.measurement.kind.names();
            warnings.add(
                WarningKind::NoiseNotSeen,
                format!(
                    "{}: the noise of the {ordinate} is estimated, and the errors given for the \
                     {abscissa} hide it at most points: the rest tell it as {freedom} degrees of \
                     freedom would, with which 95 % of the true values lie within {within:.1} \
                     standard errors; give the noise, too",
                    experiment.measurement.name
                ),
            );
        }
    }
}

/// Lists the points that count.
fn counting(assigned: &Assigned) -> Vec<usize> {
    let counts = |i: &usize| assigned.branches[*i] != Branch::LeftOut;
    (0..assigned.branches.len()).filter(counts).collect()
}
