//! The homogeneous contact that describes the data best, by straight lines: JKR, or Hertz without
//! adhesion. It gives the start values of the fit.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::starts::IsUnknown;
use crate::estimate::problem::assigned::Assigned;
use crate::statistics::{LARGEST, extremes, median};
use crate::{Branch, Experiment, Kind, Parameter};

/// The most points that a search for a start uses.
const MOST_POINTS: usize = 40;
/// The multiples of the work of adhesion of the smallest force that are tried.
const NEAR_PULL_OFF: [f64; 6] = [0.8, 1.0, 1.2, 1.5, 2.0, 3.0];
/// The residual over the median of all from which on a point has no part in a straight line: the line
/// that a single spike draws to itself leaves the others far from it.
const FAR: f64 = 15.0;

/// Tells whether the level of the reading without a force is one of the parameters that `is`.
pub(crate) fn level_is(is: IsUnknown<'_>) -> bool {
    Parameter::LEVELS.into_iter().any(is)
}

/// The smallest modulus (Pa) of a homogeneous contact: far below that of any solid.
const LEAST_MODULUS: f64 = 1e-100;

/// A homogeneous contact.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Homogeneous {
    /// The compound modulus `E*`, Pa; `None` for penetrations against radii, which tell only
    /// `w/E*`.
    pub modulus: Option<f64>,
    /// The work of adhesion (J/m^2), or `w/E*` (m) without a modulus.
    pub work_of_adhesion: f64,
    /// The work of adhesion of the points on retract, if there are any.
    pub receding: Option<f64>,
    /// The reading without a force, its slope, and the contact point.
    pub level: f64,
    pub slope: f64,
    pub contact_point: f64,
    /// A large contact: its radius (m), load (N) and penetration (m).
    pub largest: [f64; 3],
}

/// Fits a homogeneous contact, in which the parameters that are unknown may change; `None` if it has no positive modulus.
pub(crate) fn homogeneous(assigned: &Assigned, is_unknown: IsUnknown<'_>) -> Option<Homogeneous> {
    let found = match assigned.experiment.measurement.kind {
        Kind::LoadRadius => of_loads_at_radii(assigned, is_unknown),
        Kind::PenetrationRadius => of_penetrations_at_radii(assigned, is_unknown),
        Kind::LoadPenetration | Kind::ForceHeight => {
            let branches = if is_unknown(Parameter::WorkOfAdhesion) {
                assigned.branches.clone()
            } else {
                assigned.branches_without_flat_ends(level_is(is_unknown))
            };
            let shown = Assigned {
                branches,
                ..assigned.clone()
            };
            let main = main_branch(&shown);
            let other = match main {
                Branch::Advancing => Branch::Receding,
                _ => Branch::Advancing,
            };
            // Under noise a way with few points in contact may tell no modulus.
            let found = of_loads_at_positions(&shown, is_unknown, main);
            found.or_else(|| of_loads_at_positions(&shown, is_unknown, other))
        }
        Kind::StiffnessRadius | Kind::StiffnessLoad | Kind::StiffnessDepth => None,
    };
    // Data of the wrong sign lead to a modulus of 0.
    found.filter(|found| found.modulus.is_none_or(|modulus| modulus > LEAST_MODULUS))
}

/// Returns at most [`MOST_POINTS`] points of a branch, from the largest contact to the smallest.
fn points_of(assigned: &Assigned, branch: Branch) -> Vec<[f64; 2]> {
    let points = &assigned.experiment.measurement.points;
    let all = assigned
        .order
        .iter()
        .filter(|&&i| assigned.branches[i] == branch);
    let stride = all.clone().count().div_ceil(MOST_POINTS).max(1);
    let some = all.step_by(stride);
    some.map(|&i| [points[i].abscissa, points[i].ordinate])
        .collect()
}

/// Returns the branch from which modulus and zeros are read: approach if retract has a work of
/// adhesion of its own, else the one with more points.
fn main_branch(assigned: &Assigned) -> Branch {
    let branches = assigned.branches.iter();
    let count = |branch| branches.clone().filter(|&&own| own == branch).count();
    let [advancing, receding] = Branch::CONTACTS.map(count);
    let hysteretic = assigned.experiment.work_of_adhesion_receding.is_some();
    if (hysteretic && advancing > 2) || advancing >= receding {
        Branch::Advancing
    } else {
        Branch::Receding
    }
}

/// Returns the radius of the paraboloid that stands for the probe: that of the largest contact, or
/// of half of the range of the penetrations or heights.
pub(crate) fn radius_of(assigned: &Assigned) -> f64 {
    let Experiment {
        measurement,
        bodies,
        ..
    } = &assigned.experiment;
    let contacts = measurement.points.iter().zip(&assigned.branches);
    let contacts = contacts.filter(|(_, branch)| branch.is_contact());
    let [least, most] = extremes(contacts.map(|(point, _)| point.abscissa));
    match measurement.kind {
        Kind::LoadRadius | Kind::PenetrationRadius => bodies.paraboloid(most, false),
        _ => bodies.paraboloid(0.5 * (most - least), true),
    }
}

/// Fits `F = 4 E*/(3 R) a^3 - sqrt(8 pi w E*) a^{3/2} + F0`, weighted as in the JKR plot.
fn of_loads_at_radii(assigned: &Assigned, is_unknown: IsUnknown<'_>) -> Option<Homogeneous> {
    let experiment = &assigned.experiment;
    let radius = radius_of(assigned);
    let adhesive = is_unknown(Parameter::WorkOfAdhesion) || experiment.work_of_adhesion > 0.0;
    let apart = points_of(assigned, Branch::Baseline);
    let known_level = if apart.is_empty() || !level_is(is_unknown) {
        experiment.load_offset
    } else {
        median(apart.iter().map(|point| point[1]).collect())
    };
    let fit_level = level_is(is_unknown) && apart.is_empty();
    let fit = |branch: Branch| {
        let points = points_of(assigned, branch);
        let rows = points.iter().map(|[a, load]| {
            let power = a * a.sqrt();
            let mut row = vec![power];
            if adhesive {
                row.push(1.0);
            }
            if fit_level {
                row.push(1.0 / power);
            }
            (row, (load - known_level) / power)
        });
        let (found, _) = least_squares(rows.collect())?;
        let modulus = 0.75 * radius * found[0];
        let intercept = if adhesive { found[1].min(0.0) } else { 0.0 };
        let level = if fit_level {
            *found.last()?
        } else {
            known_level
        };
        let largest = points[0];
        Some((modulus, intercept, level, largest))
    };
    let branch = main_branch(assigned);
    let (modulus, intercept, level, largest) = fit(branch)?;
    let work = |intercept: f64| intercept * intercept / (8.0 * PI * modulus);
    let other = (branch == Branch::Advancing).then(|| fit(Branch::Receding));
    let receding = other.flatten().map(|(_, intercept, ..)| work(intercept));
    (modulus > 0.0 && modulus.is_finite()).then(|| Homogeneous {
        modulus: Some(modulus),
        work_of_adhesion: work(intercept),
        receding,
        level,
        contact_point: experiment.contact_point,
        largest: [largest[0], largest[1] - level, 0.0],
        ..Homogeneous::default()
    })
}

/// Fits `delta = a^2/R - sqrt(2 pi a w/E*) + c`.
fn of_penetrations_at_radii(assigned: &Assigned, is_unknown: IsUnknown<'_>) -> Option<Homogeneous> {
    let experiment = &assigned.experiment;
    let radius = radius_of(assigned);
    let fit = |branch: Branch| {
        let points = points_of(assigned, branch);
        let rows = points.iter().map(|[a, penetration]| {
            let mut row = vec![a.sqrt()];
            let mut rest = penetration - a * a / radius;
            if is_unknown(Parameter::ContactPoint) {
                row.push(1.0);
            } else {
                rest -= experiment.contact_point;
            }
            (row, rest)
        });
        let (found, _) = least_squares(rows.collect())?;
        let root = found[0].min(0.0);
        let contact_point = found.get(1).copied().unwrap_or(experiment.contact_point);
        Some((root * root / (2.0 * PI), contact_point, points[0]))
    };
    let branch = main_branch(assigned);
    let (ratio, contact_point, largest) = fit(branch)?;
    let other = (branch == Branch::Advancing).then(|| fit(Branch::Receding));
    let receding = other.flatten().map(|(ratio, ..)| ratio);
    Some(Homogeneous {
        work_of_adhesion: ratio,
        receding,
        contact_point,
        largest: [largest[0], 0.0, largest[1] - contact_point],
        ..Homogeneous::default()
    })
}

/// Fits a straight line for each work of adhesion, and takes the best one.
///
/// For a given `w`, JKR's contact radius and penetration at a load are `E*^{-1/3} b` and
/// `E*^{-2/3} (b^2/R - sqrt(2 pi b w))`, with a `b` that does not depend on `E*`.
fn of_loads_at_positions(
    assigned: &Assigned,
    is_unknown: IsUnknown<'_>,
    branch: Branch,
) -> Option<Homogeneous> {
    let levels = levels(assigned, is_unknown, branch)?.into_iter();
    let found = levels.filter_map(|level| at_level(assigned, is_unknown, branch, level));
    let best = found.min_by(|one, other| one.1.total_cmp(&other.1));
    best.map(|(found, _)| found)
}

/// Fits as [`of_loads_at_positions`] at a level and a slope of the baseline. Returns the sum of squares, too.
fn at_level(
    assigned: &Assigned,
    is_unknown: IsUnknown<'_>,
    branch: Branch,
    [level, slope]: [f64; 2],
) -> Option<(Homogeneous, f64)> {
    let experiment = &assigned.experiment;
    let radius = radius_of(assigned);
    let compliance = experiment
        .stiffness
        .filter(|_| experiment.measurement.kind == Kind::ForceHeight)
        .map_or(0.0, f64::recip);
    // Forces with the positions that are penetrations but for the contact point.
    let forces_of = |branch: Branch| {
        let points = points_of(assigned, branch).into_iter();
        let points = points.map(|[x, reading]| {
            let force = reading - level - slope * (x - experiment.contact_point);
            [force, experiment.sense() * x - compliance * force]
        });
        let mut points: Vec<[f64; 2]> = points.collect();
        // Below the smallest force the contact is stable at a fixed penetration only.
        let least = (0..points.len())
            .min_by(|&i, &j| points[i][0].total_cmp(&points[j][0]))
            .map_or(0, |i| i + 1);
        points.truncate(least);
        points
    };
    let points = forces_of(branch);
    let work_of_least = |points: &[[f64; 2]]| {
        let least = points.iter().map(|point| point[0]).fold(0.0, f64::min);
        -least / (1.5 * PI * radius)
    };
    let most = points.iter().map(|point| point[0]).fold(0.0, f64::max);
    let pull_off = work_of_least(&points);
    let noise = assigned.noise / (1.5 * PI * radius);
    let candidates: Vec<f64> = if !is_unknown(Parameter::WorkOfAdhesion) {
        vec![experiment.work_of_adhesion]
    } else if pull_off > 3.0 * noise {
        NEAR_PULL_OFF.iter().map(|part| part * pull_off).collect()
    } else {
        (0..9)
            .map(|i| most / (PI * radius) * 10_f64.powf(-4.0 + 0.5 * f64::from(i)))
            .collect()
    };
    let known = -experiment.sense() * experiment.contact_point;
    let fit = |work: f64| {
        let rows = points.iter().map(|&[force, position]| {
            let penetration = scaled_penetration(force, work, radius);
            if is_unknown(Parameter::ContactPoint) {
                (vec![penetration, 1.0], position)
            } else {
                (vec![penetration], position + known)
            }
        });
        let (found, sum) = least_squares(rows.collect())?;
        (found[0] > 0.0).then_some((work, found, sum))
    };
    let best = candidates
        .into_iter()
        .filter_map(fit)
        .min_by(|one, other| one.2.total_cmp(&other.2))?;
    let (work_of_adhesion, found, sum) = best;
    let modulus = found[0].powf(-1.5);
    let contact_point = found
        .get(1)
        .map_or(experiment.contact_point, |shift| experiment.sense() * shift);
    let receding = (branch == Branch::Advancing)
        .then(|| forces_of(Branch::Receding))
        .filter(|points| !points.is_empty())
        .map(|points| work_of_least(&points));
    let homogeneous = Homogeneous {
        modulus: Some(modulus),
        work_of_adhesion,
        receding,
        level,
        slope,
        contact_point,
        largest: [
            modulus.powf(-1.0 / 3.0) * scaled_radius(most, work_of_adhesion, radius),
            most,
            found[0] * scaled_penetration(most, work_of_adhesion, radius),
        ],
    };
    modulus.is_finite().then_some((homogeneous, sum))
}

/// Lists the levels and slopes of the baseline that are tried: those of the points on it if they are not known. Where all
/// points are in contact, the level may be far from the one given, and the smallest reading of a branch is tried, too.
fn levels(assigned: &Assigned, is_unknown: IsUnknown<'_>, branch: Branch) -> Option<Vec<[f64; 2]>> {
    let experiment = &assigned.experiment;
    let known = [
        experiment.load_offset + experiment.baseline,
        experiment.baseline_slope,
    ];
    let points = points_of(assigned, Branch::Baseline);
    if !level_is(is_unknown) {
        return Some(vec![known]);
    }
    let of_reading = |[x, reading]: &[f64; 2]| reading - known[1] * (x - experiment.contact_point);
    if points.is_empty() {
        let readings = points_of(assigned, branch);
        let least = readings.iter().map(of_reading).min_by(f64::total_cmp);
        let tried = [Some(known[0]), least].into_iter().flatten();
        return Some(tried.map(|level| [level, known[1]]).collect());
    }
    if !is_unknown(Parameter::BaselineSlope) || points.len() < 3 {
        let level = median(points.iter().map(of_reading).collect());
        return Some(vec![[level, known[1]]]);
    }
    let rows = points
        .iter()
        .map(|&[x, reading]| (vec![1.0, x - experiment.contact_point], reading));
    let (found, _) = least_squares(rows.collect())?;
    Some(vec![[found[0], found[1]]])
}

/// Returns `E*^{1/3} a` of JKR.
fn scaled_radius(force: f64, work: f64, radius: f64) -> f64 {
    let pull = 3.0 * PI * work * radius;
    let root = (2.0 * pull * force + pull * pull).max(0.0).sqrt();
    (0.75 * radius * (force + pull + root)).max(0.0).cbrt()
}

/// Returns `E*^{2/3} delta` of JKR.
fn scaled_penetration(force: f64, work: f64, radius: f64) -> f64 {
    let b = scaled_radius(force, work, radius);
    b * b / radius - (2.0 * PI * b * work).sqrt()
}

/// Returns the least-squares solution and the sum of the squares; `None` of no rows or of rows that
/// are not finite. Rows with residuals beyond [`FAR`] times the median have no part in the solution, and
/// count as if they were there.
fn least_squares(rows: Vec<(Vec<f64>, f64)>) -> Option<(Vec<f64>, f64)> {
    let (found, residuals) = solution(&rows)?;
    let far = FAR * median(residuals.iter().map(|r| r.abs()).collect());
    let near = rows.into_iter().zip(&residuals);
    let near = near.filter(|(_, residual)| residual.abs() <= far);
    let near: Vec<(Vec<f64>, f64)> = near.map(|(row, _)| row).collect();
    let left_out = residuals.len() - near.len();
    if left_out == 0 || near.len() <= found.len() {
        return Some((found, residuals.norm_squared()));
    }
    let (found, residuals) = solution(&near)?;
    let squares = residuals.norm_squared() + left_out as f64 * far * far;
    Some((found, squares))
}

/// Returns the least-squares solution and the residuals.
fn solution(rows: &[(Vec<f64>, f64)]) -> Option<(Vec<f64>, DVector<f64>)> {
    let width = rows.first()?.0.len();
    let mut matrix = DMatrix::from_fn(rows.len(), width, |i, j| rows[i].0[j]);
    let right = DVector::from_iterator(rows.len(), rows.iter().map(|row| row.1));
    let finite = |value: &f64| value.abs() < LARGEST;
    if !(matrix.iter().all(finite) && right.iter().all(finite)) {
        return None;
    }
    // The columns are scaled to length 1, because their units are very different.
    let lengths = matrix.column_iter().map(|column| column.norm());
    let units: Vec<f64> = lengths
        .map(|length| length.max(f64::MIN_POSITIVE))
        .collect();
    for (mut column, unit) in matrix.column_iter_mut().zip(&units) {
        column /= *unit;
    }
    let svd = matrix.clone().svd(true, true);
    let solution = svd.solve(&right, f64::EPSILON).ok()?;
    let residuals = &matrix * &solution - right;
    let values = solution.iter().zip(&units);
    let values = values.map(|(value, unit)| value / unit);
    Some((values.collect(), residuals))
}
