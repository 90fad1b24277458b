//! An experiment that takes the starts that the data show, one after another.

use interp::Table;

use crate::estimate::problem::assigned::Assigned;
use crate::{Error, Parameter};

/// The most steps of the search for a modulus.
const MOST_STEPS: usize = 12;
/// The accuracy of the logarithm of a modulus to start from.
const ACCURACY: f64 = 0.02;
/// A step of the modulus that leaves more than this part of the excess load ends the search: the load
/// hardly depends on a modulus as large, from where no step of a fit leads back.
const SATURATED: f64 = 0.98;
/// Tells of a parameter whether its start is sought in the data.
pub(crate) type IsUnknown<'a> = &'a dyn Fn(Parameter) -> bool;

/// An experiment that takes the starts that the data show.
pub(crate) struct Starts<'a> {
    pub table: &'a Table,
    pub at: Assigned,
    pub is_unknown: IsUnknown<'a>,
    /// The modulus that is matched to the data.
    pub matched: Option<Parameter>,
    /// The parameters that have taken one.
    pub given: Vec<Parameter>,
}

impl Starts<'_> {
    /// Gives a parameter its start.
    pub fn give(&mut self, parameter: Parameter, value: f64) -> Result<(), Error> {
        self.given.push(parameter);
        Ok(self.at.experiment.replace(parameter, value)?)
    }

    /// Gives a parameter its start if it is unknown.
    pub fn give_unknown(&mut self, parameter: Parameter, value: f64) -> Result<(), Error> {
        if (self.is_unknown)(parameter) {
            self.give(parameter, value)?;
        }
        Ok(())
    }
}

/// Returns the modulus at which an excess that grows with its logarithm is 0, sought from the logarithm `u` on; `None`
/// where the excess is not known there. Where none is found, it is the last one before the excess no longer depends on the
/// modulus, or is not known.
pub(crate) fn root_of_modulus(mut u: f64, excess: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let mut value = excess(u)?;
    let up = value < 0.0;
    let mut step = if up { 1.0 } else { -1.0 };
    let mut bracket = None;
    for _ in 0..MOST_STEPS {
        let Some(next) = excess(u + step) else { break };
        if (next < 0.0) != up {
            bracket = Some(([u, value], [u + step, next]));
            break;
        }
        if next.abs() >= SATURATED * value.abs() {
            break;
        }
        (u, value) = (u + step, next);
        step *= 1.5;
    }
    let Some((mut one, mut other)) = bracket else {
        return Some(u.exp());
    };
    for _ in 0..MOST_STEPS {
        if (one[0] - other[0]).abs() < ACCURACY {
            break;
        }
        let part = (one[1] / (one[1] - other[1])).clamp(0.2, 0.8);
        let u = one[0] + part * (other[0] - one[0]);
        let Some(value) = excess(u) else { break };
        if (value < 0.0) == (one[1] < 0.0) {
            one = [u, value];
        } else {
            other = [u, value];
        }
    }
    let u = one[0] + one[1] / (one[1] - other[1]) * (other[0] - one[0]);
    Some(u.exp())
}
