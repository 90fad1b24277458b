//! Parameters that are not fitted, and with which the model would describe the data better.
//!
//! The gain of a further parameter is the decrease of the sum of squares that the linearised model
//! predicts for it (Rao's score test). No further fit is made.

use nalgebra::DVector;

use super::unfitted_pull::{adhesion_seen, unfitted_pull};
use super::{files_apart, line_law, lost_radii};
use crate::estimate::fixed_values::residuals_of;
use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::loss::influence;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::statistics::BEYOND_CHANCE;
use crate::{Kind, Loss, Parameter, Warning, WarningKind};

/// A column counts as a combination of those that are fitted if less than this part of it is left
/// without them.
pub(super) const LEFT: f64 = 1e-3;
/// A zero of an instrument is named already from this number of its standard errors on, if it would mislead: the values
/// found may be so correlated with it that chi^2 does not tell. For each zero, chance reaches it in one fit of 2000.
const HINT: f64 = 3.5;
/// The same of a spring, whose stiffness is given more often than a zero is: by chance one fit of 15,000 or fewer reaches it.
const OF_SPRING: f64 = 4.0;
/// What looks like a spring in one curve.
const OTHERWISE: &str = "if this cannot be, check the thickness, the Poisson ratio, the scale of the positions, and whether \
     the bodies relax on the way, which look alike";
/// The change of a value found, in its standard errors, from which on a zero misleads.
const MISLED: f64 = 5.0;
/// The fewest points of each way for which one work of adhesion is doubted.
const FEWEST: usize = 5;
/// The kurtosis less 3 below which the residuals are of two kinds. It is 0 of a normal
/// distribution,
/// -1.2 of a uniform one, and -2 of two values. It is not looked at below [`MANY`] points.
const TWO_KINDS: f64 = -1.2;
const MANY: usize = 50;

pub(crate) fn add(
    warnings: &mut Vec<Warning>,
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
    residuals: &DVector<f64>,
) {
    let score = Score::new(problem, uncertainty, residuals);
    let pulls = (0..problem.assigned.len()).map(|e| unfitted_pull(problem, e));
    let pulls: Vec<Option<f64>> = pulls.collect();
    let adhesion = if pulls.iter().any(Option::is_some) {
        None
    } else {
        score.adhesion()
    };
    if let Some((gain, work)) = &adhesion {
        warnings.push(WarningKind::AdhesionWanted.with(format!(
            "work-of-adhesion is 0 and not fitted, but adhesion would describe the data better: it would lower chi^2 by \
             {:.0}, with a work of adhesion of some {work:.1e} J/m^2; free it if the bodies can adhere, and if not, check the thickness, the shape of \
             the probe, the zeros of the instrument that are fixed, and whether the film slides or relaxes",
            gain.chi_squared
        )));
    }
    let explained = adhesion.map_or(0.0, |found| found.0.significance);
    let mut law_is_doubted = false;
    let mut apart = Vec::new();
    for (e, assigned) in problem.assigned.iter().enumerate() {
        let experiment = &assigned.experiment;
        if experiment.measurement.kind.is_stiffness() || lost_radii::doubt(assigned).is_some() {
            continue;
        }
        let fitted = problem.parameters_of(e);
        if let Some(pull) = pulls[e] {
            // The zeros of the instrument would make up for it, and are not named.
            warnings.push(WarningKind::AdhesionWanted.with(adhesion_seen(experiment, pull)));
            continue;
        }
        let is_wanted = |parameter: &Parameter| {
            !fitted.contains(parameter) && experiment.why_without_effect(*parameter).is_none()
        };
        let zeros = Parameter::ZEROS.into_iter().filter(is_wanted);
        if let Some((doubt, significance)) = line_law::doubt(&score, e) {
            law_is_doubted = true;
            let of_zeros = score.largest_gain(e, zeros.clone());
            let is_better = significance > score.significance(of_zeros);
            warnings.push(doubt);
            if is_better {
                continue;
            }
        }
        let own_value = files_apart::own_value(&score, e);
        if let Some(spring) = score.spring(e, zeros.clone(), explained) {
            warnings.push(spring);
            apart.extend(own_value);
        } else {
            // What a value of its own explains better is no zero.
            let own = own_value.as_ref().map_or(0.0, |own| own.significance);
            let named = warnings.len();
            zeros_wanted(warnings, &score, e, zeros, explained.max(own));
            apart.extend(own_value.filter(|_| warnings.len() == named));
        }
        // By adhesion that depends on the speed loading and unloading differ, too.
        if !fitted.contains(&Parameter::WorkOfAdhesionReceding) && !experiment.has_line_law() {
            warnings.extend(score.mixed(e));
        }
    }
    files_apart::add(warnings, &score, &apart);
    if !law_is_doubted {
        warnings.extend(line_law::doubt_of_retracts(problem));
    }
}

/// Warns of each of these zeros of experiment `e` that the data want or hint at, unless adhesion explains the data better.
fn zeros_wanted(
    warnings: &mut Vec<Warning>,
    score: &Score<'_>,
    e: usize,
    zeros: impl Iterator<Item = Parameter>,
    explained: f64,
) {
    let name = &score.problem.assigned[e].experiment.measurement.name;
    let mut level_named = false;
    for parameter in zeros {
        let is_level = Parameter::LEVELS.contains(&parameter);
        if is_level && level_named {
            continue;
        }
        let Some((gain, column)) = score.gain_of(e, parameter, |_| true) else {
            continue;
        };
        // What adhesion explains better is no zero of the instrument.
        if gain.significance < explained {
            continue;
        }
        if gain.is_significant() {
            level_named |= is_level;
            // Other errors look like an offset, and this one can be seen.
            let compare = match parameter {
                Parameter::LoadOffset => ", and compare it with the load without contact",
                _ => "",
            };
            warnings.push(WarningKind::OffsetWanted.with(format!(
                "{name}: {parameter} is not fitted, and with it the model would describe the data better: \
                 chi^2 would be lower by {:.0}, with {parameter} at {:+.2e} {}; free it{compare}",
                gain.chi_squared,
                gain.change,
                parameter.unit()
            )));
        } else if parameter != Parameter::BaselineSlope
            && let Some((misled, change)) = score.hint(&gain, column, HINT)
        {
            level_named |= is_level;
            warnings.push(WarningKind::OffsetHinted.with(format!(
                "{name}: {parameter} is not fitted, and the data hint at {:+.1e} {}, which is {:.1} of its \
                 standard errors. It would change {misled} by {change:+.0} of its standard errors: free it, unless its value is known",
                gain.change,
                parameter.unit(),
                gain.significance.sqrt(),
            )));
        }
    }
}

/// Returns the derivatives of the residuals with respect to a parameter of experiment `e` at the points chosen, and 0
/// elsewhere.
pub(crate) fn column(
    problem: &Problem<'_>,
    e: usize,
    parameter: Parameter,
    chosen: impl Fn(usize) -> bool,
) -> Option<DVector<f64>> {
    let derivatives = problem.predict(e, &[parameter]).ok()?.derivatives;
    let own = &problem.assigned[e];
    let rows = problem.rows_of_experiments()[e].clone();
    let mut column = DVector::zeros(problem.residual_count());
    for (row, i) in rows.zip(own.counting_points()).filter(|(_, i)| chosen(*i)) {
        column[row] = derivatives[i] / own.deviation(i);
    }
    let is_finite = column.iter().all(|value| value.is_finite());
    is_finite.then_some(column)
}

/// What a further parameter would gain.
pub(super) struct Gain {
    /// The decrease of the sum of squares.
    pub chi_squared: f64,
    /// The same in units of the variance of the residuals.
    pub significance: f64,
    /// The change of the parameter.
    pub change: f64,
}

impl Gain {
    pub fn is_significant(&self) -> bool {
        self.significance > BEYOND_CHANCE * BEYOND_CHANCE
    }
}

/// The residuals by their influence, and what of a column is no combination of the fitted ones.
pub(super) struct Score<'a> {
    pub problem: &'a Problem<'a>,
    /// The residuals as they are.
    raw: &'a DVector<f64>,
    pub uncertainty: &'a Uncertainty,
    pub residuals: DVector<f64>,
    /// The variance of a residual per unit of the noise.
    variance: f64,
    /// Whether it follows from the residuals.
    variance_is_estimated: bool,
}

impl<'a> Score<'a> {
    fn new(problem: &'a Problem<'_>, uncertainty: &'a Uncertainty, raw: &'a DVector<f64>) -> Self {
        let robust = problem.loss != Loss::Squares;
        let residuals = raw.map(|residual| influence(problem.loss, residual).0);
        let freedom = (residuals.len() as f64 - problem.slots.len() as f64 - 1.0).max(1.0);
        Self {
            problem,
            raw,
            uncertainty,
            variance: residuals.norm_squared() / freedom,
            variance_is_estimated: robust
                || problem.experiments().any(|one| one.usual_noise().is_none()),
            residuals,
        }
    }

    /// Returns the gain of a parameter of experiment `e` at the points chosen, and its column.
    pub fn gain_of(
        &self,
        e: usize,
        parameter: Parameter,
        chosen: impl Fn(usize) -> bool,
    ) -> Option<(Gain, DVector<f64>)> {
        let column = column(self.problem, e, parameter, chosen)?;
        Some((self.gain(&column)?, column))
    }

    /// Returns the value found that a further parameter of this column would change the most, and by how many of its
    /// standard errors, if the parameter is `least` of its own standard errors away and the value misleads.
    fn hint(&self, gain: &Gain, column: DVector<f64>, least: f64) -> Option<(Parameter, f64)> {
        let changes = self.uncertainty.changes_in_errors(&(column * gain.change));
        let found = self.problem.slots.iter().zip(changes);
        let (slot, change) = found.max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()))?;
        let is_hint = gain.significance > least * least && change.abs() > MISLED;
        is_hint.then_some((slot.parameter, change))
    }

    /// Returns the largest decrease of the sum of squares by one of some parameters of experiment `e`; 0 where all are
    /// fitted.
    fn largest_gain(&self, e: usize, parameters: impl Iterator<Item = Parameter>) -> f64 {
        let gains = parameters.filter_map(|one| self.gain_of(e, one, |_| true));
        gains.map(|(gain, _)| gain.chi_squared).fold(0.0, f64::max)
    }

    /// Returns the gain of a column; `None` if it is a combination of the fitted ones.
    pub fn gain(&self, column: &DVector<f64>) -> Option<Gain> {
        let rest = self.uncertainty.without_fitted(column);
        let length = rest.norm_squared();
        if length.is_nan() || length <= LEFT * LEFT * column.norm_squared() {
            return None;
        }
        let product = self.residuals.dot(&rest);
        let chi_squared = product * product / length;
        Some(Gain {
            chi_squared,
            significance: self.significance(chi_squared),
            change: -product / length,
        })
    }

    /// Returns a decrease of the sum of squares in units of the variance that the residuals then have.
    pub fn significance(&self, chi_squared: f64) -> f64 {
        let freedom = self.residuals.len() as f64;
        let remaining = (self.variance - chi_squared / freedom).max(1e-9 * self.variance);
        let variance = if self.variance_is_estimated {
            remaining
        } else {
            remaining.max(1.0)
        };
        chi_squared / variance
    }

    /// Returns what adhesion would gain in contacts that are fitted without, and the work of adhesion that it would be,
    /// J/m^2; `None` unless by more than chance, and clearly better than the zeros of the
    /// instrument of all files together.
    ///
    /// The parameter is that on which the residuals depend to first order: the square root of the work of adhesion `w` at
    /// contact radii; `w` itself at penetrations and heights, where the load changes by `-w dA/ddelta` with the area `A` of
    /// the contact, on a half-space by `-pi R w`. There a [pull](Experiment::pull) that the noise hides is found, too.
    fn adhesion(&self) -> Option<(Gain, f64)> {
        /// A work of adhesion that changes no contact by much.
        const SMALL: f64 = 1e-10;
        /// What adhesion leaves of the sum of squares at contact radii, over what the zeros leave, below which it explains the
        /// data better. Against positions it takes a small part of the noise, and more than any zero suffices.
        const CLEARLY: f64 = 0.5;
        const WORK: Parameter = Parameter::WorkOfAdhesion;
        let problem = self.problem;
        if problem.slot_of(WORK).is_some() {
            return None;
        }
        let is_at_radii = |one: &Assigned| one.experiment.measurement.kind.at_radii();
        let at_radii = is_at_radii(problem.assigned.first()?);
        let could_adhere = |one: &Assigned| {
            let experiment = &one.experiment;
            is_at_radii(one) == at_radii
                && !experiment.measurement.kind.is_stiffness()
                && experiment.get(WORK) == Some(0.0)
                && experiment.why_without_effect(WORK).is_none()
        };
        if !problem.assigned.iter().all(could_adhere) {
            return None;
        }
        let moved = residuals_of(problem, |experiment| experiment.replace(WORK, SMALL))?;
        let mut change = (moved - self.raw) / if at_radii { SMALL.sqrt() } else { SMALL };
        for (e, rows) in problem.rows_of_experiments().iter().enumerate() {
            let radii = problem.predict(e, &[]).ok()?.radii;
            let points = problem.assigned[e].counting_points();
            for (row, _) in rows.clone().zip(points).filter(|(_, i)| radii[*i] == 0.0) {
                change[row] = 0.0;
            }
        }
        let gain = self.gain(&change)?;
        if !gain.is_significant() || gain.change <= 0.0 {
            return None;
        }
        let of_zeros = |e: usize| {
            let experiment = &problem.assigned[e].experiment;
            let has_effect = |zero: &Parameter| experiment.why_without_effect(*zero).is_none();
            self.largest_gain(e, Parameter::ZEROS.into_iter().filter(has_effect))
        };
        let zeros: f64 = (0..problem.assigned.len()).map(of_zeros).sum();
        let left = |explained: f64| (self.residuals.norm_squared() - explained).max(0.0);
        let clearly = if at_radii { CLEARLY } else { 1.0 };
        let explains = left(gain.chi_squared) < clearly * left(zeros);
        let work = if at_radii {
            gain.change.powi(2)
        } else {
            gain.change
        };
        explains.then_some((gain, work))
    }

    /// Warns of a spring in series with the contact that explains the data of experiment `e` better than each of these zeros
    /// and than adhesion, of which the significance is given: the frame, the load cell, or a cantilever of another
    /// stiffness.
    fn spring(
        &self,
        e: usize,
        zeros: impl Iterator<Item = Parameter>,
        explained: f64,
    ) -> Option<Warning> {
        /// What the spring explains of the sum of squares beyond the noise, at least.
        const EXPLAINED: f64 = 0.7;
        let own = &self.problem.assigned[e];
        let experiment = &own.experiment;
        let measurement = &experiment.measurement;
        let given = match measurement.kind {
            Kind::LoadPenetration => None,
            Kind::ForceHeight
                if self
                    .problem
                    .parameters_of(e)
                    .contains(&Parameter::Stiffness) =>
            {
                return None;
            }
            Kind::ForceHeight => experiment.stiffness,
            _ => return None,
        };
        let column = self.spring_column(e)?;
        let rows = &self.problem.rows_of_experiments()[e];
        let gain = self.gain(&column)?;
        let compliance = given.map_or(0.0, f64::recip) + gain.change;
        let of_zeros = self.largest_gain(e, zeros);
        // A spring is no answer to a model that is wrong otherwise.
        let noise = (own.seen_noise() / own.noise).powi(2) * rows.len() as f64;
        let sum = self.residuals.rows(rows.start, rows.len()).norm_squared();
        let explains = gain.chi_squared > EXPLAINED * (sum - noise);
        let is_best = explains && gain.chi_squared > of_zeros && gain.significance > explained;
        if !(is_best && compliance > 0.0) {
            return None;
        }
        let (name, stiffness) = (&measurement.name, 1.0 / compliance);
        if !gain.is_significant() {
            let (misled, change) = self.hint(&gain, column, OF_SPRING)?;
            let what = match given {
                None => "that the penetrations hold the deflection of a spring".to_owned(),
                Some(given) => format!("at another stiffness than {given:.2e} N/m"),
            };
            return Some(WarningKind::SpringWanted.with(format!(
                "{name}: the data hint {what}, some {stiffness:.2e} N/m, by {:.1} of its standard errors. It would change \
                 {misled} by {change:+.0} of its standard errors: check the stiffness of what carries the load",
                gain.significance.sqrt()
            )));
        }
        let gain = gain.chi_squared;
        Some(WarningKind::SpringWanted.with(match given {
            None => format!(
                "{name}: the penetrations seem to hold the deflection of a spring of the order of {stiffness:.0e} N/m in \
                 series with the contact, such as a frame or load cell: it would lower chi^2 by {gain:.0}, more than any zero; subtract \
                 load/stiffness from the penetrations, or fit them as heights with the stiffness; {OTHERWISE}"
            ),
            Some(given) if experiment.from_deflection => format!(
                "{name}: deflections {:.3} times as large would lower chi^2 by {gain:.0}, more than any zero: check the \
                 sensitivity of the detector",
                given / stiffness
            ),
            Some(given) => format!(
                "{name}: a stiffness of some {stiffness:.2e} N/m in place of {given:.2e} would lower chi^2 by {gain:.0}, \
                 more than any zero: check it, or free it (stiffness); {OTHERWISE}"
            ),
        }))
    }

    /// Returns the derivatives of the residuals of experiment `e` with respect to the compliance of a spring in series with the
    /// contact, which moves the contact point in proportion to the load.
    pub fn spring_column(&self, e: usize) -> Option<DVector<f64>> {
        let own = &self.problem.assigned[e];
        let experiment = &own.experiment;
        let mut column = column(self.problem, e, Parameter::ContactPoint, |_| true)?;
        let predicted = self.problem.predict(e, &[]).ok()?.values;
        let rows = self.problem.rows_of_experiments()[e].clone();
        for (row, i) in rows.zip(own.counting_points()) {
            let abscissa = experiment.measurement.points[i].abscissa;
            let load = predicted[i] - experiment.baseline_at(abscissa);
            column[row] *= experiment.sense() * load;
        }
        Some(column)
    }

    /// Warns if approach and retract, or loading and unloading in time, differ.
    fn mixed(&self, e: usize) -> Option<Warning> {
        let problem = self.problem;
        // Bodies that relax have a loop without adhesion.
        if problem.assigned[e].experiment.relaxing.is_some() {
            return None;
        }
        let assigned = &problem.assigned[e];
        let points = &assigned.experiment.measurement.points;
        let name = &assigned.experiment.measurement.name;
        let has_directions = points.iter().all(|point| point.direction.is_some());
        let unloading = assigned.unloading();
        let unloads = |i: usize| unloading[i];
        let in_contact = |i: &usize| assigned.branches[*i].is_contact();
        let contacts = (0..points.len()).filter(in_contact);
        let ways = [false, true].map(|way| contacts.clone().filter(|&i| unloads(i) == way).count());
        let has_both = ways.iter().all(|&count| count >= FEWEST);
        let advice = if let Some([one, other]) = assigned.baselines_apart() {
            format!(
                "their baselines are {:.2e} N apart, as drag of the liquid or drift makes them: fit one direction alone",
                (one - other).abs()
            )
        } else if assigned
            .experiment
            .get(Parameter::WorkOfAdhesionReceding)
            .is_some()
        {
            "fit one direction alone".to_owned()
        } else {
            format!(
                "{}fit each direction with a work of adhesion of its own (work-of-adhesion-receding), or one direction alone",
                if has_directions {
                    ""
                } else {
                    "give the points their directions, then "
                }
            )
        };
        if has_both
            && assigned.experiment.work_of_adhesion > 0.0
            && let Some((gain, _)) = self.gain_of(e, Parameter::WorkOfAdhesion, unloads)
            && gain.is_significant()
        {
            return Some(WarningKind::MixedBranches.with(format!(
                "{name}: loading and unloading do not have one work of adhesion: with one for \
                 each of them, {:.2e} J/m^2 apart, chi^2 would be lower by {:.0}; {advice}",
                gain.change.abs(),
                gain.chi_squared
            )));
        }
        let rows = &problem.rows_of_experiments()[e];
        let own = self.raw.rows(rows.start, rows.len());
        let moment = |power: i32| own.iter().map(|r| r.powi(power)).sum::<f64>() / own.len() as f64;
        let are_one_way = has_directions && !has_both;
        let are_two_kinds = own.len() >= MANY && moment(4) / moment(2).powi(2) - 3.0 < TWO_KINDS;
        (!are_one_way && are_two_kinds).then(|| {
            WarningKind::MixedBranches.with(format!(
                "{name}: the residuals are of two kinds, as those of loading and unloading under \
                 adhesion hysteresis; {advice}"
            ))
        })
    }
}
