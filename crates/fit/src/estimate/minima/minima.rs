//! The minima that several starts lead to: the best one, and those that chance may have made worse.

use std::ops::Range;
use std::rc::Rc;

use interp::Table;
use levenberg_marquardt::LeastSquaresProblem;

use super::minimum::{Minimum, Rival};
use super::profile::with_fixed;
use super::search::{COARSE, PATIENCE, is_bad, settle};
use super::valley::{MARGIN, bend, doubtful, is_costly, other_sides};
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::basin::Basin;
use crate::estimate::problem::few::{hold_back, thin};
use crate::estimate::problem::no_adhesion;
use crate::estimate::problem::slot::{Slot, slots};
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::estimate::problem::{Ending, Problem};
use crate::estimate::start::{self, Variation};
use crate::statistics::BEYOND_CHANCE;
use crate::{Branch, Error, Experiment, Free, LayerQuantity, Loss, Parameter};

/// The factors by which the start of a modulus, or of a quantity of a layer, is varied.
const FACTORS: [f64; 2] = [0.05, 20.0];
/// The thicknesses of a film, over the largest contact radius, from which a fit starts.
const THICKNESSES: [f64; 2] = [0.1, 1.0];
/// The changes of the load by adhesion, over the range of the loads, that are tried where a work of adhesion ended at 0. The
/// fit starts again at that of the least sum of squares, because a logarithm does not come back from 0.
const ADHESION: [f64; 6] = [0.05, 0.1, 0.2, 0.3, 0.5, 0.8];
/// The most evaluations over the number of parameters + 1 of a fit from another start.
const FEWER: usize = 12;
/// A minimum is no better than one found before it if its sum of squares is smaller by less than this:
/// one standard error of one value makes as much.
const ALIKE: f64 = 1.0;
/// Minima whose values differ by less than this number of standard errors are one.
const APART: f64 = 3.0;

/// Finds the best minimum, and its rivals.
///
/// The first start is enough where its end describes the data and tells all moduli, thicknesses and works of adhesion to
/// [`super::valley`]'s small errors. Else other starts are tried, and the valley of the least known value is followed to
/// both sides. From a work of adhesion that ended at 0 a fit starts again with adhesion.
pub(crate) fn minimum<'a>(
    table: &'a Table,
    data: &[Assigned],
    (free, given): (&[Free], &[Slot]),
    loss: Loss,
) -> Result<Minimum<'a>, Error> {
    let few: Vec<Assigned> = data.iter().map(hold_back).map(thin).collect();
    let evaluations = Rc::default();
    let from = |slots: &[Slot], variation| {
        let mut problem = start::problem(table, &few, slots, loss, variation)?;
        problem.evaluations = Rc::clone(&evaluations);
        problem.weigh()?;
        Ok::<_, Error>(problem)
    };
    let first = from(given, Variation::None);
    let first = first.map(|problem| problem.minimise(PATIENCE, COARSE));
    let is_good = |first: &Problem<'_>| first.ending == Ending::Converged && !is_bad(first);
    let is_bad = !first.as_ref().is_ok_and(is_good);
    // Where bodies relax a start has been chosen among several laws.
    let relaxes = |first: &Problem<'_>| first.experiments().any(|one| one.relaxing.is_some());
    let cheap = first.as_ref().ok();
    let cheap = cheap.filter(|first| !is_costly(first) && !relaxes(first));
    let doubtful = cheap.and_then(|first| {
        let uncertainty = Uncertainty::of(first)?;
        let slot = *doubtful(first, &uncertainty).first()?;
        Some((slot, uncertainty.relative_error(slot)))
    });
    let from_data = without_starts(data, free);
    // A thin and a stiff film may look like a thick and a soft one.
    let is_free = |parameter| free.iter().any(|one| one.parameter == parameter);
    let is_film_free = is_free(Parameter::FilmModulus) && is_free(Parameter::FilmThickness);
    let needs_others = is_bad || doubtful.is_some() || from_data.is_some() || is_film_free;
    let (first, failure) = match first {
        Ok(first) if !needs_others => return Ok(best(vec![first], data)),
        Ok(first) => (Some(first), None),
        Err(failure) => (None, Some(failure)),
    };
    let slots = from_data.as_deref().unwrap_or(given);
    let mut variations = variations(free, &few, is_bad);
    if from_data.is_some() {
        variations.insert(0, Variation::None);
    }
    // A start where the model has no contact is no start.
    let starts = variations.into_iter();
    let starts = starts.filter_map(|variation| from(slots, variation).ok());
    let mut starts: Vec<Problem<'_>> = starts.collect();
    let mut ends: Vec<Problem<'_>> = Vec::new();
    let mut places = Vec::new();
    if let Some(first) = first {
        let shared = starts.into_iter().map(|start| start.with_slots_of(&first));
        starts = shared.flatten().collect();
        if let Some((slot, error)) = doubtful {
            places = other_sides(&first, slot, error);
        }
        ends.push(first);
    }
    starts.extend(places.iter().cloned());
    for mut start in starts {
        let known = ends.iter().filter(|end| end.ending == Ending::Converged);
        start.known = known
            .filter_map(|end| Some(Basin::new(end.x.clone(), end.jacobian()?)))
            .collect();
        let mut end = start.minimise(FEWER, COARSE);
        end.known = Rc::new([]);
        if end.ending != Ending::Known {
            ends.push(end);
        }
    }
    // All points together may have a minimum where few points have none.
    ends.extend(places);
    match failure.filter(|_| ends.is_empty()) {
        Some(failure) => Err(failure),
        None => Ok(best(ends, data)),
    }
}

/// Lists the other starts: those of a film that is thinner or thicker, softer or stiffer, and if
/// the first start led nowhere, of the modulus that is free.
fn variations(free: &[Free], assigned: &[Assigned], is_bad: bool) -> Vec<Variation> {
    let film = Parameter::FilmModulus;
    let has_film = |one: &Assigned| {
        one.experiment.bodies.thickness().is_some()
            && one.experiment.why_without_effect(film).is_none()
    };
    let mut variations = Vec::new();
    let names: Vec<Parameter> = free.iter().map(|one| one.parameter).collect();
    let ranked = names.iter().filter_map(|one| Some((rank(*one)?, *one)));
    let first = ranked
        .min()
        .map(|(_, parameter)| parameter)
        .filter(|_| is_bad);
    let film = (names.contains(&film) && assigned.iter().any(has_film)).then_some(film);
    let other = first.filter(|first| Some(*first) != film);
    for parameter in film.into_iter().chain(other) {
        variations.extend(FACTORS.map(|factor| Variation::Times(parameter, factor)));
    }
    if names.contains(&Parameter::FilmThickness) {
        variations.extend(THICKNESSES.map(Variation::Thickness));
    }
    variations
}

/// Returns the rank of a parameter among those whose start may be multiplied, the first to be
/// multiplied first.
const fn rank(parameter: Parameter) -> Option<usize> {
    Some(match parameter {
        Parameter::FilmModulus => 0,
        Parameter::FilmThickness => 1,
        Parameter::Layer(_, LayerQuantity::Modulus) => 2,
        Parameter::Layer(_, LayerQuantity::Thickness) => 3,
        Parameter::Layer(_, LayerQuantity::InterfaceStiffness) => 4,
        Parameter::SphereModulus => 5,
        _ => return None,
    })
}

/// Returns the slots of what is free without the starts given, if any is given.
fn without_starts(data: &[Assigned], free: &[Free]) -> Option<Vec<Slot>> {
    if free.iter().all(|one| one.start.is_none()) {
        return None;
    }
    let without_start = |one: &Free| Free {
        start: None,
        ..*one
    };
    let free: Vec<Free> = free.iter().map(without_start).collect();
    let experiments = data.iter().map(|one| one.experiment.clone());
    let experiments: Vec<Experiment> = experiments.collect();
    slots(&experiments, &free).ok()
}

/// Follows the best ends on few points to all points, and compares what comes out.
fn best<'a>(mut ends: Vec<Problem<'a>>, data: &[Assigned]) -> Minimum<'a> {
    let has_converged = |end: &Problem<'_>| end.ending == Ending::Converged;
    if ends.iter().any(has_converged) {
        ends.retain(has_converged);
    }
    ends.sort_by(|one, other| one.misfit().total_cmp(&other.misfit()));
    let nearly = farthest(&ends[0]);
    let mut minima: Vec<Minimum<'_>> = Vec::new();
    for (i, problem) in ends.into_iter().enumerate() {
        if i > 0 && problem.misfit() > nearly {
            break;
        }
        minima.push(settle(problem, data));
    }
    if let Some(place) = minima.iter().find_map(|one| with_adhesion(&one.problem)) {
        minima.push(settle(place, data));
    }
    // One after another, because the points in common differ from pair to pair.
    let is_better = |one: &Minimum<'_>, other: &Minimum<'_>| {
        let failed = [one, other].map(|minimum| minimum.problem.ending != Ending::Converged);
        match failed {
            [false, true] => true,
            [true, false] => false,
            _ => excess(one, other) > ALIKE,
        }
    };
    let first = (1..minima.len()).fold(0, |best, i| {
        if is_better(&minima[i], &minima[best]) {
            i
        } else {
            best
        }
    });
    let mut best = minima.swap_remove(first);
    for other in &minima {
        if let Some(rival) = rival(&best, other) {
            best.rivals.push(rival);
        }
    }
    if let Some(uncertainty) = &best.uncertainty {
        best.bend = bend(&best.problem, uncertainty);
    }
    best
}

/// Returns the place with the least sum of squares at some works of adhesion, if a work of adhesion ended at 0.
fn with_adhesion<'a>(problem: &Problem<'a>) -> Option<Problem<'a>> {
    let slots = no_adhesion::ended_at_zero(problem);
    let first = *slots.first()?;
    let place = |part: f64| {
        let mut place = problem.clone();
        for &slot in &slots {
            let work = no_adhesion::work_of_part(problem, slot, part)?;
            place.x[slot] = place.slots[slot].coordinate.of(work);
        }
        let work = place.value(first);
        Some((with_fixed(&mut place, first, work, FEWER)?, place))
    };
    let places = ADHESION.into_iter().filter_map(place);
    let (_, mut place) = places.min_by(|one, other| one.0.total_cmp(&other.0))?;
    place.update().ok()?;
    Some(place)
}

/// Returns the sum of squares up to which an end on few points may be the best one on all.
fn farthest(best: &Problem<'_>) -> f64 {
    let least = best.misfit();
    let known = (0..best.assigned.len()).all(|e| has_known_scale(best, e));
    let unknown = if known {
        0.0
    } else {
        least * (MARGIN / best.counting() as f64).exp_m1()
    };
    least + unknown.max(MARGIN)
}

/// Tells whether the squares of an experiment are in units of a noise that does not follow from
/// them.
fn has_known_scale(problem: &Problem<'_>, e: usize) -> bool {
    problem.loss != Loss::Squares || problem.assigned[e].experiment.usual_noise().is_some()
}

/// Starts again from a place that is lower than this minimum, which becomes a rival of the new one.
pub(crate) fn replace_by<'a>(minimum: &mut Minimum<'a>, lower: Problem<'a>, data: &[Assigned]) {
    let old = std::mem::replace(minimum, settle(lower, data));
    let rival = rival(minimum, &old);
    minimum.rivals.extend(rival);
}

/// Returns another minimum, that is none of the rivals known, if chance may have made it worse.
fn rival(best: &Minimum<'_>, other: &Minimum<'_>) -> Option<Rival> {
    let uncertainty = best.uncertainty.as_ref()?;
    let slots = best.problem.slots.len();
    let values_of = |problem: &Problem<'_>| -> Vec<f64> {
        (0..slots).map(|slot| problem.value(slot)).collect()
    };
    let values = values_of(&other.problem);
    let is_apart_from = |others: &[f64]| {
        (0..slots).any(|slot| (others[slot] - values[slot]).abs() > APART * uncertainty.error(slot))
    };
    let both = [best, other].map(|minimum| minimum.problem.ending) == [Ending::Converged; 2];
    let mut known = best.rivals.iter().map(|rival| &rival.values);
    let is_new =
        is_apart_from(&values_of(&best.problem)) && known.all(|rival| is_apart_from(rival));
    if !both || !is_new {
        return None;
    }
    let excess = excess(best, other);
    (excess < BEYOND_CHANCE * BEYOND_CHANCE).then_some(Rival { values, excess })
}

/// Returns by how much the sum of squares of `other` exceeds that of `one`, on the points that count
/// in either: on those that count in both, the one that leaves out more would seem better. One that
/// is of fewer points is minimised again on these. Where the noise is not known it is the excess of
/// the same likelihood, `nu ln(S_other/S_one)` with the sums `S` and the degrees of freedom `nu`.
fn excess(one: &Minimum<'_>, other: &Minimum<'_>) -> f64 {
    let counts = [one, other].map(|minimum| minimum.problem.counting());
    let (mut one, mut other) = (one.problem.clone(), other.problem.clone());
    for (one, other) in one.assigned.iter_mut().zip(&mut other.assigned) {
        for (one, other) in one.branches.iter_mut().zip(&mut other.branches) {
            if *one == Branch::LeftOut {
                *one = *other;
            }
            *other = *one;
        }
    }
    if one.update().is_err() || one.weigh().is_err() || other.update().is_err() {
        return f64::NAN;
    }
    for (other, one) in other.assigned.iter_mut().zip(&one.assigned) {
        other.noise = one.noise;
        for (other, one) in other.abscissa_errors.iter_mut().zip(&one.abscissa_errors) {
            other.part = one.part;
        }
    }
    if one.counting() > counts[0] {
        one = one.minimise(FEWER, COARSE);
    }
    if other.counting() > counts[1] {
        other = other.minimise(FEWER, COARSE);
    }
    let residuals = [&one, &other].map(Problem::weighted_residuals);
    let [Some(ours), Some(theirs)] = residuals else {
        return f64::NAN;
    };
    let squares = |rows: Range<usize>| {
        [&ours, &theirs].map(|all| all.rows(rows.start, rows.len()).norm_squared())
    };
    // Both have the same points, and after these the priors.
    let [of_one, of_other] = squares(one.counting()..ours.len());
    let mut excess = of_other - of_one;
    for (e, rows) in one.rows_of_experiments().into_iter().enumerate() {
        let freedom = usize::max(rows.len(), one.slots.len() + 1) - one.slots.len();
        let [of_one, of_other] = squares(rows);
        excess += if has_known_scale(&one, e) {
            of_other - of_one
        } else {
            freedom as f64 * (of_other / of_one).ln()
        };
    }
    excess
}
