//! The pull-off: the lowest imposed value of the branch of states, from large contacts to the first
//! attraction across a gap.
//!
//! The imposed value has a minimum along the branch where a separation becomes unstable. Under a short
//! range it is near that of JKR, from which the search starts; under a long one it may lie before the
//! contact, whose surface the attraction holds up after the contact has closed, or at a contact that is
//! far smaller than the attraction around it. Where there are several minima, a separation jumps from
//! each to the next lower one, and ends at the lowest.

use contact::Control;

use crate::Error;
use crate::cohesive::fixed_radius::FixedRadius;
use crate::cohesive::search::{self, Point};
use crate::cohesive::{Cohesive, CohesiveState, REACH};

/// The first step of `ln a` in a search from a minimum of JKR under a short range, and under a long
/// one.
const SHORT_STEP: f64 = 0.1;
const LONG_STEP: f64 = 0.25;

/// The contact radius over that of the attraction from which the search for a minimum of small contacts begins.
const SMALL: f64 = 0.01;
/// The step of `ln a` in this search.
const SMALL_STEP: f64 = 1.4;
/// The ratio of both radii below which the states are those before the contact: the value changes with the square of
/// this ratio.
const CLOSED: f64 = 1e-4;
/// The part of the value by which a small contact must be lower than the states before the contact.
const ROUNDING: f64 = 1e-9;
/// The part of the value by which a small contact may be lower than these states, at most.
const SHALLOW: f64 = 1e-3;
/// The largest contact radius over that of the sphere.
const OF_SPHERE: f64 = 0.9;

impl Cohesive {
    /// Returns the last stable state of a separation: that of the lowest imposed value on the branch
    /// from large contacts to the attraction across a gap.
    ///
    /// It may be a state before the contact, of radius 0: a long range holds the surface up after the contact has
    /// closed.
    ///
    /// # Errors
    /// As [`Cohesive::state`] at the pull-off; [`Error::PullOffReach`] for a pull-off beyond
    /// [`REACH`]; [`Error::Domain`] for a spring that is not positive.
    pub fn pull_off(&self, control: Control) -> Result<CohesiveState, Error> {
        if let Control::Spring { stiffness } = control {
            Error::check("stiffness of the spring", stiffness, [1e-100, 1e100])?;
        }
        let (minima, ends) = self.jkr_minima(control);
        let largest = (0.9 * REACH).min(OF_SPHERE / self.curvature);
        let first = self.first_contact();
        let last = first.unwrap_or_else(|| self.reach());
        let smallest = SMALL * last;
        let mut lowest: Option<Point> = None;
        for (log, _) in minima {
            let found = if log.exp() > largest {
                Err(self.beyond())
            } else {
                self.lowest_contact(control, log, [smallest.ln(), largest.ln()], last)
            };
            let found = match found {
                // The minima of JKR ascend: this one is higher than one that was found.
                Err(Error::PullOffReach { .. }) if lowest.is_some() => None,
                found => found?,
            };
            let lower = found.filter(|found| lowest.is_none_or(|lowest| found.1 < lowest.1));
            lowest = lower.or(lowest);
        }
        if !ends {
            return Err(self.beyond());
        }
        let before = self.lowest_before_contact(control, last)?;
        let size = before.1.abs();
        if lowest.is_none_or(|lowest| before.1 < lowest.1 + SHALLOW * size) && first.is_some() {
            let small = self.lowest_small_contact(control, last.ln())?;
            let lower = small.filter(|small| {
                small.1 < before.1 - ROUNDING * size
                    && lowest.is_none_or(|lowest| small.1 < lowest.1)
            });
            lowest = lower.or(lowest);
        }
        match lowest {
            Some((log, value)) if value < before.1 => self.state(log.exp() * self.thickness),
            _ if first.is_none() && before.0 >= last.ln() => Err(self.beyond()),
            _ => Ok(self.before_contact(before.0.exp()).0),
        }
    }

    /// Finds the minimum of the imposed value near that of JKR at a radius of the given logarithm,
    /// between the logarithms `smallest` and `largest`; `None` where the value falls down to the
    /// smallest radius. `closed` is the radius of the attraction when the contact begins.
    fn lowest_contact(
        &self,
        control: Control,
        jkr: f64,
        [smallest, largest]: [f64; 2],
        closed: f64,
    ) -> Result<Option<Point>, Error> {
        let mut width = None;
        let mut value = |log: f64| self.imposed_at(control, log, &mut width);
        // The tip of JKR is two thirds into a short zone. Under a long one the search begins at a
        // contact as wide as the attraction is when it closes.
        let (zone, radius) = (self.zone(), jkr.exp());
        let (start, step) = if zone < 0.25 * radius.min(1.0) {
            ((radius - 2.0 / 3.0 * zone).ln(), SHORT_STEP)
        } else {
            (radius.max(closed).ln(), LONG_STEP)
        };
        if start <= smallest {
            return Ok(None);
        }
        let mut start = start.min(largest - step);
        let (here, above) = loop {
            let mut point = |log: f64| value(log).map(|value| (log, value));
            match point(start).and_then(|here| Ok((here, point(start + step)?))) {
                Err(Error::PullOffReach { .. }) if start - step > smallest => start -= step,
                pair => break pair?,
            }
        };
        let rises = above.1 >= here.1;
        match search::bracket_from(&mut value, [here, above], [smallest, largest])? {
            Some(bracket) => Ok(Some(search::minimum(&mut value, bracket)?)),
            None if rises => Ok(None),
            None => Err(self.beyond()),
        }
    }

    /// Finds the minimum of the imposed value among contacts that have just begun, where the logarithm of the radius of the
    /// attraction is `closed`.
    fn lowest_small_contact(&self, control: Control, closed: f64) -> Result<Option<Point>, Error> {
        let [small, smallest] = [SMALL, CLOSED].map(|ratio| closed + ratio.ln());
        // Each annulus is sought anew: these contacts differ too much for one to be near the next.
        let mut value = |log: f64| self.imposed_at(control, log, &mut None);
        let point = |log: f64| value(log).map(|value| (log, value));
        let points = [point(small)?, point(small + SMALL_STEP)?];
        search::bracket_from(&mut value, points, [smallest, closed])?
            .map(|bracket| search::minimum(&mut value, bracket))
            .transpose()
    }

    /// Returns the imposed value of a contact, whose radius has the logarithm `log`. `width` is that of the annulus of
    /// the contact before it, near which this one is sought.
    fn imposed_at(
        &self,
        control: Control,
        log: f64,
        width: &mut Option<f64>,
    ) -> Result<f64, Error> {
        let radius = log.exp();
        let mut contact = FixedRadius::new(radius, &self.symbol)
            .ok_or_else(|| self.no_contact(radius, "rounding has left no digits"))?;
        let solution = self
            .solution(&mut contact, radius * self.thickness, *width)
            .map_err(|error| match error {
                Error::AnnulusReach { .. } => self.beyond(),
                error => error,
            })?;
        *width = Some(solution.annulus.outer - solution.annulus.inner);
        let (load, penetration) = (solution.part.load, solution.part.penetration);
        Ok(control.imposed(self.load_in_si(load), penetration * self.thickness))
    }

    /// Makes the error of a pull-off beyond the reach.
    fn beyond(&self) -> Error {
        let (reach, thickness, radius) = (
            self.reach() * self.thickness,
            self.thickness,
            self.sphere_radius,
        );
        let reason = if reach < radius {
            format!(
                "up to which an attraction of finite range is solved on a top layer of {thickness:?} m; take a smaller sphere or a \
                 thicker layer, or leave out the range of the attraction: JKR, the limit of short ranges, is solved on thinner layers"
            )
        } else {
            format!(
                "and the radius of the sphere is {radius:?} m, beside which the model takes contacts to be narrow; take a smaller \
                 work of adhesion, a shorter range, or a larger sphere"
            )
        };
        Error::PullOffReach(format!(
            "at the pull-off the contact, or the attraction around it, is wider than {:.3e} m, {reason}",
            reach.min(OF_SPHERE * radius)
        ))
    }
}
