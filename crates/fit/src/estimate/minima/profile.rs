//! Profile-likelihood intervals.

use crate::estimate::problem::loss::weighted;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::estimate::problem::{Ending, Problem};

/// The most evaluations over the number of parameters + 1 of one fit.
const PATIENCE: usize = 30;
/// The relative changes at which the method stops.
const TOLERANCE: f64 = 1e-6;
/// The first step of the way to an end, in standard errors, and the factor from one step to the
/// next. They are those of every level, so that intervals are nested.
const STEP: f64 = 0.7;
const GROWTH: f64 = 1.3;
/// The largest standard error of a logarithm, or in units of the data, in which steps are measured.
const LARGEST_ERROR: f64 = 5.0;
/// The number of times that a step is halved, before a straight line gives the end.
const HALVINGS: usize = 5;
/// A minimum is lower if its sum of squares is smaller by more than the square of this part of the
/// growth at one standard error.
const LOWER: f64 = 0.1;
/// The farthest end sought, in standard errors, and for a positive value the largest change of its
/// logarithm, a factor of 1e6.
const FARTHEST: f64 = 40.0;
const FARTHEST_LOGARITHM: f64 = 14.0;
/// A work of adhesion (J/m^2) that no measurement tells from none, and one that no bodies exceed: the upper
/// end of a smaller one is sought between them.
const NO_WORK: f64 = 1e-12;
const LARGEST_WORK: f64 = 10.0;

/// One end of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum End {
    /// The value at which the sum of squares has grown as far as asked.
    At(f64),
    /// The data set no limit as far as this value, the farthest one looked at.
    Open(f64),
    /// The other values have no fit at this value.
    Failed(f64),
}

impl End {
    /// Returns the value of the end: `unlimited` where the data set no limit, and NaN where the
    /// other values have no fit.
    pub const fn or(self, unlimited: f64) -> f64 {
        match self {
            Self::At(value) => value,
            Self::Open(_) => unlimited,
            Self::Failed(_) => f64::NAN,
        }
    }
}

/// Finds the interval of each value in which the sum of squares, minimised over all other values,
/// exceeds its minimum by less than `deviations^2`.
///
/// # Errors
/// The place with the lowest sum of squares, if one is found that is lower than the minimum.
pub(crate) fn intervals<'a>(
    problem: &Problem<'a>,
    uncertainty: &Uncertainty,
    deviations: f64,
) -> Result<Vec<[End; 2]>, Box<Problem<'a>>> {
    let way = Way {
        problem,
        least: problem.misfit(),
        unit: uncertainty.growth,
        deviations,
    };
    let mut ends = Vec::new();
    for slot in 0..problem.slots.len() {
        let error = uncertainty.relative_error(slot).min(LARGEST_ERROR);
        ends.push([way.end(slot, -error)?, way.end(slot, error)?]);
    }
    Ok(ends)
}

/// Minimises over all values but that of a slot, from the present ones, which it replaces. Returns the sum of squares;
/// `None` where there is no contact.
pub(crate) fn with_fixed(
    current: &mut Problem<'_>,
    slot: usize,
    value: f64,
    patience: usize,
) -> Option<f64> {
    let fitted = current.with_fixed(slot, value)?;
    let fitted = fitted.minimise(patience, TOLERANCE);
    let of_prior = current.slots[slot].prior.map_or(0.0, |prior| {
        let residual = (value - prior.mean) / prior.width;
        weighted(current.loss, residual).0.powi(2)
    });
    for i in (0..current.x.len()).filter(|&i| i != slot) {
        current.x[i] = fitted.x[i - usize::from(i > slot)];
    }
    current.x[slot] = current.slots[slot].coordinate.of(value);
    current.ending = fitted.ending;
    Some(fitted.misfit() + of_prior)
}

/// The way from the minimum to the ends.
struct Way<'p, 'a> {
    problem: &'p Problem<'a>,
    /// The sum of squares at the minimum.
    least: f64,
    /// Its growth at one standard error, as a number of standard deviations.
    unit: f64,
    /// The standard errors asked for.
    deviations: f64,
}

/// A place on the way: the distance, and how far the sum of squares has grown, as a number of
/// standard errors.
#[derive(Clone, Copy)]
struct Place {
    distance: f64,
    grown: f64,
}

impl<'a> Way<'_, 'a> {
    /// Returns one end of an interval. The sign of `error` is that of the side.
    fn end(&self, slot: usize, error: f64) -> Result<End, Box<Problem<'a>>> {
        let mut current = self.problem.clone();
        let mut near = Place {
            distance: 0.0,
            grown: 0.0,
        };
        let parameter = self.problem.slots[slot].parameter;
        let is_work = parameter.is_work_of_adhesion();
        let mut logarithm = FARTHEST_LOGARITHM;
        if is_work && error > 0.0 {
            let [none, largest] =
                [NO_WORK, LARGEST_WORK].map(|work| (work / self.problem.value(slot)).ln());
            near.distance = none.max(0.0) / error;
            logarithm = logarithm.max(largest);
        }
        let farthest = if parameter.is_positive() {
            (near.distance + FARTHEST).min(logarithm / error.abs())
        } else {
            FARTHEST
        };
        let (mut distance, mut step) = (near.distance + STEP, STEP);
        while near.distance < farthest {
            let before = current.clone();
            let far = match self.grown(&mut current, slot, distance * error)? {
                Ok(grown) => Place { distance, grown },
                Err(end) => return Ok(end),
            };
            if far.grown >= self.deviations {
                return self.between(before, slot, error, [near, far]);
            }
            near = far;
            step *= GROWTH;
            distance = (distance + step).min(farthest);
        }
        Ok(End::Open(self.value(slot, near.distance * error)))
    }

    /// Finds the end between two places. The middles that are tried, and the fits there, are those
    /// of every level, so that intervals are nested even where the sum of squares has a jump. The
    /// fits start from the nearer place, from which the other values change without a jump.
    fn between(
        &self,
        mut nearer: Problem<'a>,
        slot: usize,
        error: f64,
        [mut near, mut far]: [Place; 2],
    ) -> Result<End, Box<Problem<'a>>> {
        for _ in 0..HALVINGS {
            let distance = 0.5 * (near.distance + far.distance);
            let mut current = nearer.clone();
            let Ok(grown) = self.grown(&mut current, slot, distance * error)? else {
                break;
            };
            let place = Place { distance, grown };
            if grown < self.deviations {
                (near, nearer) = (place, current);
            } else {
                far = place;
            }
        }
        // The root of a parabola is a straight line.
        let part = (self.deviations - near.grown) / (far.grown - near.grown);
        let distance = near.distance + part * (far.distance - near.distance);
        Ok(End::At(self.value(slot, distance * error)))
    }

    /// Returns the value at a distance, which is that of the logarithm of a positive value.
    fn value(&self, slot: usize, distance: f64) -> f64 {
        let best = self.problem.value(slot);
        if self.problem.slots[slot].parameter.is_positive() {
            best * distance.exp()
        } else {
            best + distance * self.problem.slots[slot].coordinate.size(best)
        }
    }

    /// Returns how far the sum of squares has grown at a distance, as a number of standard errors.
    fn grown(
        &self,
        current: &mut Problem<'a>,
        slot: usize,
        distance: f64,
    ) -> Result<Result<f64, End>, Box<Problem<'a>>> {
        let value = self.value(slot, distance);
        // Where the table ends, the data have set no limit.
        let Some(misfit) = with_fixed(current, slot, value, PATIENCE) else {
            return Ok(Err(End::Open(value)));
        };
        if current.ending == Ending::Failed {
            return Ok(Err(End::Failed(value)));
        }
        let growth = (misfit - self.least) / self.unit.powi(2);
        if growth < -LOWER * LOWER && current.update().is_ok() {
            current.ending = Ending::Converged;
            return Err(Box::new(current.clone()));
        }
        Ok(Ok(growth.max(0.0).sqrt()))
    }
}
