//! The noise of the ordinates, estimated from the residuals where nobody gives it.

use std::ops::Range;

use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::statistics::{
    MEDIAN, ratio_of_squares, robust_deviation, student_deviations, weighted_median,
};
use crate::{Fit, Kind, Loss, Warning, WarningKind};

/// The change of an estimated noise that needs another round.
const CHANGE: f64 = 0.02;
/// The degrees of freedom from which on the points of one file tell its noise alone.
const ENOUGH: f64 = 20.0;
/// By how many standard deviations the mean square of a file may exceed that of another one of the same
/// noise, and by how many it may be below.
const CHANCE: f64 = 2.0;
const LEFT: f64 = 4.0;
/// The smallest noise, relative to the range of the ordinates, that an estimate can give.
const LEAST: f64 = 1e-12;
/// The noises that are tried beside errors of the abscissae: the first over the largest residual, the
/// least ratio of one to the next, and the most of them, down to 1e-6 of the first or farther.
const FIRST: f64 = 4.0;
const STEP: f64 = 1.2;
const TRIED: u32 = 77;
/// The fewest points that tell a noise, and the least part of those that would tell it if the abscissae
/// were exact, where these are few.
const LEAST_TOLD: f64 = 2.0;
const LEAST_PART: f64 = 0.4;
/// The part below which errors of the abscissae are why few points tell the noise.
const HIDDEN: f64 = 0.5;
/// The number of standard errors with 95 % of the true values, 2 with many points, from which the
/// noise is doubted.
const UNCERTAIN: f64 = 2.3;

/// Estimates the noise of the experiments in which it is not known. Returns the uncertainty with
/// the new noise, and whether the noise changed.
pub(crate) fn estimate_noise(
    problem: &mut Problem<'_>,
    uncertainty: Uncertainty,
) -> (Uncertainty, bool) {
    let Some(residuals) = problem.plain_residuals() else {
        return (uncertainty, false);
    };
    let of_files = of_files(problem, residuals.as_slice(), &uncertainty.leverages);
    let mut changed = false;
    let mut jacobian = uncertainty.jacobian.clone();
    let all_rows = problem.rows_of_experiments().into_iter().zip(&of_files);
    for (assigned, (rows, alone)) in problem.assigned.iter_mut().zip(all_rows) {
        if assigned.experiment.usual_noise().is_some() || rows.is_empty() {
            continue;
        }
        let leverages = &uncertainty.leverages[rows.clone()];
        let points: Vec<usize> = assigned.counting_points().collect();
        let before: Vec<f64> = points.iter().map(|&i| assigned.deviation(i)).collect();
        let own = residuals.rows(rows.start, rows.len());
        let sizes = own.iter().zip(&before);
        let sizes: Vec<f64> = sizes.map(|(r, deviation)| (r * deviation).abs()).collect();
        let least = LEAST * assigned.experiment.compared_range();
        let noise = match alone {
            Some(alone) => alone.with(of_files.iter().flatten().filter(|one| alone.agrees(one))),
            None => beside_abscissae(assigned, problem.loss, &points, &sizes, leverages),
        };
        let noise = noise.max(least);
        changed |= (assigned.noise / noise).ln().abs() > CHANGE;
        assigned.noise = noise;
        for ((row, &i), before) in rows.zip(&points).zip(before) {
            jacobian
                .row_mut(row)
                .scale_mut(before / assigned.deviation(i));
        }
    }
    let residuals = problem.plain_residuals().zip(problem.residuals_alone());
    let Some((residuals, alone)) = residuals else {
        return (uncertainty, false);
    };
    let (blocks, sizes) = (uncertainty.blocks, uncertainty.sizes);
    let residuals = [residuals, alone];
    (
        Uncertainty::new(jacobian, blocks, residuals, problem.loss, sizes),
        changed,
    )
}

/// The noise of a file by its own residuals, and their degrees of freedom.
struct Alone {
    noise: f64,
    freedom: f64,
    kind: Kind,
}

impl Alone {
    /// Takes the residuals of a file whose abscissae are exact.
    fn new(assigned: &Assigned, loss: Loss, (residuals, leverages): (&[f64], &[f64])) -> Self {
        let count = residuals.len() as f64;
        let freedom = (count - leverages.iter().sum::<f64>()).max(0.5);
        let excess = match loss {
            Loss::Squares => (residuals.iter().map(|r| r * r).sum::<f64>() / freedom).sqrt(),
            _ => robust_deviation(residuals.iter().copied()) * (count / freedom).sqrt(),
        };
        Self {
            noise: excess * assigned.noise,
            freedom,
            kind: assigned.experiment.measurement.kind,
        }
    }

    /// Tells whether another file may have the noise of this one. That of this one may be larger by no more than
    /// chance makes it; it may be smaller by more, because the fit can follow its few points.
    fn agrees(&self, other: &Self) -> bool {
        let ratio = ratio_of_squares(
            [self, other].map(|one| one.noise.powi(2)),
            [self.freedom, other.freedom],
        );
        // Two noises of 0 have no ratio, and agree.
        let is_likely = ratio.is_nan() || (-LEFT..=CHANCE).contains(&ratio);
        self.kind == other.kind && is_likely
    }

    /// Returns the noise beside `all` files that agree, itself among them. Parameters that files have in
    /// common can follow the few points of one of them, whose residuals then tell no noise: what is missing
    /// to [`ENOUGH`] degrees of freedom comes from all files.
    fn with<'a>(&self, all: impl Iterator<Item = &'a Self>) -> f64 {
        let squares = |one: &Self| one.freedom * one.noise.powi(2);
        let [of_all, freedom] = all.fold([0.0; 2], |[sum, freedom], one| {
            [sum + squares(one), freedom + one.freedom]
        });
        let missing = (ENOUGH - self.freedom).max(0.0);
        ((squares(self) + missing * of_all / freedom) / (self.freedom + missing)).sqrt()
    }
}

/// Returns the noise of each file by itself; `None` where it is known, or beside errors of the abscissae.
fn of_files(problem: &Problem<'_>, residuals: &[f64], leverages: &[f64]) -> Vec<Option<Alone>> {
    let alone = |(assigned, rows): (&Assigned, Range<usize>)| {
        let is_known = assigned.experiment.usual_noise().is_some();
        let own = (&residuals[rows.clone()], &leverages[rows]);
        (!is_known && !own.0.is_empty() && assigned.abscissa_errors.is_empty())
            .then(|| Alone::new(assigned, problem.loss, own))
    };
    let rows = problem.rows_of_experiments();
    problem.assigned.iter().zip(rows).map(alone).collect()
}

/// Returns the largest noise at which the residuals are what chance makes of it and of the errors of
/// the abscissae, whose parts differ from point to point. A point weighs as in the restricted
/// likelihood of the noise (Patterson and Thompson, Biometrika 58, 545, 1971), by the share that the
/// noise has of its variance: chi^2 alone would leave the noise to points at which it is hidden. Where
/// errors of the abscissae explain the residuals alone, it is the least noise that [`LEAST_TOLD`]
/// points tell: with a smaller one a single point of no slope would draw the fit to itself.
fn beside_abscissae(
    assigned: &Assigned,
    loss: Loss,
    points: &[usize],
    sizes: &[f64],
    leverages: &[f64],
) -> f64 {
    let least_told = LEAST_TOLD.min(LEAST_PART * most_told(leverages));
    let mut tried = assigned.clone();
    let mut residuals = Vec::with_capacity(points.len());
    // The residuals in units of their deviations, over what chance makes of them, or infinity where
    // too few points tell.
    let mut excess = |noise: f64| {
        tried.noise = noise;
        if told(&tried, leverages) < least_told {
            return f64::INFINITY;
        }
        residuals.clear();
        let of_points = points.iter().zip(sizes.iter().zip(leverages));
        residuals.extend(of_points.map(|(&i, (size, leverage))| {
            let deviation = tried.deviation_alone(i);
            let free = (1.0 - leverage).max(f64::EPSILON);
            [
                size / deviation / free.sqrt(),
                free * (noise / deviation).powi(2),
            ]
        }));
        match loss {
            Loss::Squares => {
                let sum = |of: fn(&[f64; 2]) -> f64| residuals.iter().map(of).sum::<f64>();
                (sum(|[r, weight]| r * r * weight) / sum(|[_, weight]| *weight)).sqrt()
            }
            _ => weighted_median(&mut residuals) / MEDIAN,
        }
    };
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let [mut least, mut most] = [FIRST * largest; 2];
    for _ in 0..TRIED {
        let excess = excess(least);
        if excess > 1.0 {
            break;
        }
        // A noise smaller by a factor makes the mean square larger by the fourth power at most.
        most = least;
        least *= excess.sqrt().min(1.0 / STEP);
    }
    while most > (1.0 + 0.1 * CHANGE) * least {
        let middle = (least * most).sqrt();
        let end = if excess(middle) > 1.0 {
            &mut least
        } else {
            &mut most
        };
        *end = middle;
    }
    least
}

/// Returns how many points without errors of the abscissae would tell the noise as well as these.
fn told(assigned: &Assigned, leverages: &[f64]) -> f64 {
    let of_point = |(i, leverage): (usize, &f64)| {
        let share = assigned.noise / assigned.deviation_alone(i);
        (1.0 - leverage) * share.powi(4)
    };
    let points = assigned.counting_points();
    points.zip(leverages).map(of_point).sum()
}

/// Returns how many would if the abscissae were exact.
fn most_told(leverages: &[f64]) -> f64 {
    leverages.iter().map(|leverage| 1.0 - leverage).sum()
}

/// Warns of an estimated noise that few points tell: because there are few, or because the errors of the abscissae hide it
/// at the others.
pub(crate) fn add(
    warnings: &mut Vec<Warning>,
    fit: &Fit,
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
) {
    let freedom = fit.degrees_of_freedom;
    let within = student_deviations(0.95, freedom.max(1));
    if fit.reduced_chi_squared.is_none() && within > UNCERTAIN {
        let plural = if freedom == 1 { "" } else { "s" };
        warnings.push(WarningKind::NoiseNotSeen.with(format!(
            "{freedom} degree{plural} of freedom tell the noise, so few that 95 % of the true values lie within \
             {within:.1} standard errors, not 2: give the noise, or measure more points"
        )));
        return;
    }
    for (assigned, rows) in problem.assigned.iter().zip(problem.rows_of_experiments()) {
        let leverages = &uncertainty.leverages[rows];
        let experiment = &assigned.experiment;
        if experiment.usual_noise().is_some() || experiment.has_exact_abscissae() {
            continue;
        }
        let told = told(assigned, leverages);
        let freedom = told.round().max(1.0) as usize;
        let within = student_deviations(0.95, freedom);
        if within > UNCERTAIN && told < HIDDEN * most_told(leverages) {
            let [abscissa, ordinate] = experiment.measurement.kind.names();
            warnings.push(WarningKind::NoiseNotSeen.with(format!(
                "{}: the noise of the {ordinate} is estimated, and the errors given for the \
                 {abscissa} are larger at most points. The few others determine it only as well as {freedom} degree{} of freedom: \
                 95 % of the true values lie within {within:.1} standard errors, not 2. Give the noise of the {ordinate}, too",
                experiment.measurement.name,
                if freedom == 1 { "" } else { "s" }
            )));
        }
    }
}
