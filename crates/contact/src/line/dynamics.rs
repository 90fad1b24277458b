//! The contact line in time: `da/dt = -v(G)` under a load or penetration that changes at a constant
//! rate.
//!
//! With the radius `a1` at the beginning and the duration `T` as units, the equation for `x = a/a1` is
//! the stiffer the slower the ramp is, and where the line jumps `x` is nearly vertical. Implicit steps
//! in time (`implicit_step.rs`) take both: on a slow ramp the root of each stage is the equilibrium,
//! whatever the stiffness, and through a jump the steps are so short that the radius changes little in
//! each, if need be shorter than what the time can tell apart.

use super::implicit_step::{ORDER, step};
use crate::Error;
use crate::{Contact, ContactLine, Control, CrackTip, State};
use interp::check::{finite_input, positive};

/// A point of the motion: radius over `a1`, and time over `T`.
type Point = [f64; 2];
const RADIUS: usize = 0;
const TIME: usize = 1;

/// The longest step in both coordinates. It bounds the distance of neighbouring states, so that they
/// can be plotted and integrated.
const LONGEST_STEP: f64 = 0.01;
/// The largest number of steps. Growth to 400 times the radius takes 40 000.
const MOST_STEPS: usize = 100_000;
/// The part of the length with which a step is tried again whose stages have no solution.
const SHORTER: f64 = 0.2;
/// The smallest and the largest change of the length of a step.
const CHANGES: [f64; 2] = [0.1, 4.0];
/// The number of halvings after which an interval is shorter than rounding.
const HALVINGS: usize = 60;

/// The name of a law's speed in errors.
const SPEED: &str = "speed of the crack-tip law";

/// The state of a contact at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedState {
    /// Time since the ramp began, s.
    pub time: f64,
    /// The state of the contact.
    pub state: State,
    /// The energy release rate `G`, J/m^2.
    pub energy_release_rate: f64,
}

/// Accepts the relative tolerance of contacts in time.
pub(crate) fn check_tolerance(tolerance: f64) -> Result<(), interp::Error> {
    let holds = (1e-10..=1e-2).contains(&tolerance);
    interp::Error::argument(holds, "tolerance", tolerance, "in [1e-10, 1e-2]")
}

impl<L: CrackTip> ContactLine<'_, L> {
    /// Brings the load (N), the penetration (m) or the position of the spring (m) to `value` in
    /// `duration` (s) at a constant rate. To hold it constant, impose its present value.
    ///
    /// Returns the states from the beginning to the end of the ramp, or to the separation of the
    /// contact, after which [`ContactLine::state`] is `None`. Between neighbouring states the
    /// radius changes by at most 1 % of the first one, and the time by at most 1 % of the duration.
    /// Times never fall. States of a jump have one time where an f64 cannot tell their times apart.
    /// The sphere has no inertia.
    ///
    /// `tolerance` bounds the error of the solver in one step, relative to the radius at the
    /// beginning and to the duration.
    ///
    /// A contact has separated when its radius is below `tolerance` times that at the beginning, or
    /// below the smallest of [`Contact::contact_radius_range`], and `G` rises as it shrinks.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// use interp::{Elastic, Probe, System, Table};
    /// use contact::{Contact, Control, RateDependent};
    ///
    /// let film = Elastic::new(3.5e6, 0.5)?;
    /// let substrate = Elastic::new(2e11, 0.25)?;
    /// let system = System { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
    /// let contact = Contact::in_table(Table::embedded(), &system)?;
    /// let mut line = contact.line(RateDependent::new(0.04, 1e-6, 0.6)?, 65e-6)?;
    /// line.ramp(Control::Load, 1e-3, 10.0, 1e-6)?;
    /// let unloading = line.ramp(Control::Load, -1e-3, 20.0, 1e-6)?;
    /// assert!(line.state().is_none()); // pulled off,
    /// let pull_off = unloading.last().expect("a state").state;
    /// assert!(pull_off.load < -0.19e-3); // at more than 1.5 pi w R
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] where the line leaves [`Contact::contact_radius_range`];
    /// [`interp::Error::Unphysical`] for a `value` that is not finite, a stiffness outside
    /// `[1e-100, 1e100]`, or a `duration` that is not positive and finite;
    /// [`interp::Error::InvalidArgument`] for a `tolerance` outside `[1e-10, 1e-2]`, or a law without
    /// finite speeds; [`Error::Motion`] for a ramp of more than 100 000 steps. After an error the
    /// state is that before the call.
    pub fn ramp(
        &mut self,
        control: Control,
        value: f64,
        duration: f64,
        tolerance: f64,
    ) -> Result<Vec<TimedState>, Error> {
        control.check()?;
        finite_input(control.name(), value)?;
        positive("duration", duration)?;
        check_tolerance(tolerance)?;
        let [advancing, receding] = self.law.at_rest();
        for moving in [receding.next_up(), advancing.next_down().max(0.0)] {
            let speed = self.law.speed(moving);
            let allowed = "finite for a motion in time: give the line a `RateDependent` law, or use `ContactLine::impose`";
            interp::Error::argument(speed.is_finite(), SPEED, speed, allowed)?;
        }
        let Some(start) = self.state else {
            return Ok(Vec::new());
        };
        let a1 = start.contact_radius;
        self.contact.state_under(control, value, a1)?;
        let [least, most] = self.contact.contact_radius_range();
        if !(least..=most).contains(&a1) {
            return Err(self.contact.outside(control.name(), value));
        }
        let motion = Motion {
            contact: self.contact,
            law: &self.law,
            control,
            imposed: [control.imposed(start.load, start.penetration), value],
            a1,
            duration,
            tolerance,
            range: [least.max(tolerance * a1), most],
        };
        let (states, separated) = motion.follow()?;
        let last = states.last().filter(|_| !separated);
        self.state = last.map(|last| last.state);
        Ok(states)
    }
}

/// The motion of a contact line in one ramp.
struct Motion<'a, L> {
    contact: &'a Contact,
    law: &'a L,
    control: Control,
    /// The imposed values at the beginning and at the end.
    imposed: [f64; 2],
    /// The contact radius at the beginning, m.
    a1: f64,
    duration: f64,
    tolerance: f64,
    /// The radius (m) below which the contact has separated, and the largest of the curve.
    range: [f64; 2],
}

impl<L: CrackTip> Motion<'_, L> {
    /// Returns the states of the ramp, and whether the contact has separated in the last one.
    fn follow(&self) -> Result<(Vec<TimedState>, bool), Error> {
        let mut point: Point = [1.0, 0.0];
        let mut states = vec![self.timed_state(&point)?];
        let mut length = LONGEST_STEP;
        let mut steps = 0;
        // A line that runs without bound asks for steps that vanish.
        while steps < MOST_STEPS && length > f64::MIN_POSITIVE {
            steps += 1;
            let slope = self.slope(point[TIME], point[RADIUS])?;
            let next = if slope.is_infinite() {
                Some([self.leap(&point, slope.signum())?, point[TIME]])
            } else {
                self.step(&point, &mut length)?
            };
            let Some(next) = next else { continue };
            let before = std::mem::replace(&mut point, next);
            let a = point[RADIUS] * self.a1;
            if a > self.range[1] {
                return Err(self.outside(&point));
            }
            if a < self.range[0] {
                point = self.separation(&before, point)?;
                if !self.shrinks_further(&point)? {
                    return Err(self.outside(&point));
                }
                states.push(self.timed_state(&point)?);
                return Ok((states, true));
            }
            states.push(self.timed_state(&point)?);
            if point[TIME] >= 1.0 {
                return Ok((states, false));
            }
        }
        Err(Error::Motion {
            time: point[TIME] * self.duration,
            steps,
        })
    }

    /// Tries a step of at most `length`, which becomes that of the next one; `None` if it is to be
    /// tried again.
    fn step(&self, point: &Point, length: &mut f64) -> Result<Option<Point>, Error> {
        let rest = 1.0 - point[TIME];
        let h = length.min(LONGEST_STEP).min(rest);
        let slope_at = |t: f64, x: f64| self.slope(t, x);
        let tried = step(
            slope_at,
            [point[TIME], point[RADIUS]],
            h,
            2.0 * LONGEST_STEP,
        )?;
        let Some(tried) = tried else {
            *length = SHORTER * h;
            return Ok(None);
        };
        let moved = (tried.value - point[RADIUS]).abs();
        let [least, most] = CHANGES;
        let change = (0.9 * (self.tolerance / tried.error).powf(1.0 / ORDER))
            .min(0.9 * LONGEST_STEP / moved)
            .clamp(least, most);
        *length = change * h;
        let accepted = tried.error <= self.tolerance && moved <= LONGEST_STEP;
        if !accepted {
            return Ok(None);
        }
        let time = if h == rest { 1.0 } else { point[TIME] + h };
        Ok(Some([tried.value, time]))
    }

    /// Returns the radius to which the line leaps where its speed is infinite: the nearest one with a
    /// finite speed, or one at the length of the longest step.
    fn leap(&self, point: &Point, direction: f64) -> Result<f64, Error> {
        let infinite = |x: f64| Ok::<_, Error>(self.slope(point[TIME], x)?.is_infinite());
        let (mut near, mut far) = (point[RADIUS], point[RADIUS] + direction * LONGEST_STEP);
        if infinite(far)? {
            return Ok(far);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            *if infinite(middle)? {
                &mut near
            } else {
                &mut far
            } = middle;
        }
        Ok(far)
    }

    /// Returns the point between `before` and `point` at which the least radius was passed, by
    /// shorter steps from `before`. Below it the speed counts as that at the least radius.
    fn separation(&self, before: &Point, point: Point) -> Result<Point, Error> {
        const MOST: usize = 10;
        let least = self.range[0] / self.a1;
        let [mut radius, mut time] = point;
        for _ in 0..MOST {
            let since = (radius - least) / self.slope(time, least)?;
            if since.is_nan() {
                break;
            }
            time = (time - since).clamp(before[TIME], point[TIME]);
            let h = time - before[TIME];
            if since.abs() <= self.tolerance || h == 0.0 {
                break;
            }
            let slope_at = |t: f64, x: f64| self.slope(t, x);
            let start = [before[TIME], before[RADIUS]];
            let Some(tried) = step(slope_at, start, h, 2.0 * LONGEST_STEP)? else {
                break;
            };
            radius = tried.value;
        }
        Ok([least, time])
    }

    /// Tells whether a contact that has shrunk to the least radius shrinks on until it separates.
    /// It does if its energy release rate rises as the radius falls.
    fn shrinks_further(&self, point: &Point) -> Result<bool, Error> {
        let rate = |a| {
            self.contact
                .state_under(self.control, self.imposed_at(point), a)
                .map(|(_, rate)| rate)
        };
        Ok(rate(self.range[0])? > rate(self.range[0] * (1.0 + LONGEST_STEP))?)
    }

    /// Returns the state at a point.
    fn timed_state(&self, point: &Point) -> Result<TimedState, Error> {
        let (state, energy_release_rate) = self.contact.state_under(
            self.control,
            self.imposed_at(point),
            point[RADIUS] * self.a1,
        )?;
        Ok(TimedState {
            time: point[TIME] * self.duration,
            state,
            energy_release_rate,
        })
    }

    /// Makes the error of a line that leaves the range at a point.
    fn outside(&self, point: &Point) -> Error {
        let imposed = self.imposed_at(point);
        self.contact.outside(self.control.name(), imposed)
    }

    /// Returns the imposed value at a point.
    fn imposed_at(&self, point: &Point) -> f64 {
        let [from, to] = self.imposed;
        from + (to - from) * point[TIME]
    }

    /// Returns `dx/dt` in the units of a point.
    fn slope(&self, time: f64, radius: f64) -> Result<f64, Error> {
        // A stage may try a radius out of range. The nearest one in range replaces it, because only
        // the last step can end out of range.
        let a = (radius * self.a1).clamp(self.range[0], self.range[1]);
        let imposed = self.imposed_at(&[radius, time]);
        let (_, energy_release_rate) = self.contact.state_under(self.control, imposed, a)?;
        let speed = self.law.speed(energy_release_rate);
        interp::Error::argument(
            !speed.is_nan(),
            SPEED,
            speed,
            "a number at any energy release rate",
        )?;
        Ok(-speed * (self.duration / self.a1))
    }
}
