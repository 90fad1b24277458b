//! The contact line in time: `da/dt = -v(G)` under a load or penetration that changes at a constant
//! rate.
//!
//! Where the line jumps, `a(t)` is nearly vertical, and where the contact separates, the speed is
//! not bounded. So the curve `(a, t)` is followed along its length `s`,
//! `ds^2 = (da/a1)^2 + (dt/T)^2`, with the radius `a1` at the beginning and the duration `T` as
//! units. Neither coordinate changes faster than `s`, and the time is constant while the line moves
//! infinitely fast. The equation is the stiffer the slower the ramp is, so the solver is implicit
//! (Radau IIA of order 5).

use std::cell::Cell;

use differential_equations::interpolate::Interpolation;
use differential_equations::linalg::Matrix;
use differential_equations::methods::ImplicitRungeKutta;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};

use super::checks::finite_input;
use crate::{Contact, ContactLine, Control, CrackTip, Error, State};

/// A point of the curve: radius over `a1`, and time over `T`.
type Point = [f64; 2];
const RADIUS: usize = 0;
const TIME: usize = 1;

/// The longest step. It bounds the distance of neighbouring states, so that they can be plotted and
/// integrated.
const LONGEST_STEP: f64 = 0.01;
/// The largest number of steps. Growth to 400 times the radius takes 40 000.
const MOST_STEPS: usize = 50_000;
/// The step of the difference quotients: above rounding, and short for the stiffest equations.
const DIFFERENCE: f64 = 1e-10;
/// The number of halvings after which a step is shorter than rounding.
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

impl<L: CrackTip> ContactLine<'_, L> {
    /// Brings the load (N), the penetration (m) or the position of the spring (m) to `value` in
    /// `duration` (s) at a constant rate. To hold it constant, impose its present value.
    ///
    /// Returns the states from the beginning to the end of the ramp, or to the separation of the
    /// contact, after which [`ContactLine::state`] is `None`. Between neighbouring states the
    /// radius changes by at most 1 % of the first one, and the time by at most 1 % of the duration.
    /// The sphere has no inertia.
    ///
    /// `tolerance` bounds the error of the solver in one step, relative to the radius at the
    /// beginning and to the duration.
    ///
    /// A contact has separated when its radius is below `tolerance` times that at the beginning, or
    /// below the smallest of [`Contact::contact_radius_range`], and `G` rises as it shrinks.
    ///
    /// ```
    /// # #[cfg(feature = "embedded")]
    /// # fn main() -> Result<(), interp::Error> {
    /// use interp::{Control, Elastic, Probe, RateDependent, System, Table};
    ///
    /// let film = Elastic::new(3.5e6, 0.5)?;
    /// let substrate = Elastic::new(2e11, 0.25)?;
    /// let system = System { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
    /// let contact = Table::embedded().contact(&system)?;
    /// let mut line = contact.line(RateDependent::new(0.04, 1e-6, 0.6)?, 65e-6)?;
    /// line.ramp(Control::Load, 1e-3, 10.0, 1e-6)?;
    /// let unloading = line.ramp(Control::Load, -1e-3, 20.0, 1e-6)?;
    /// assert!(line.state().is_none()); // pulled off,
    /// let pull_off = unloading.last().expect("a state").state;
    /// assert!(pull_off.load < -0.19e-3); // at more than 1.5 pi w R
    /// # Ok(()) }
    /// # #[cfg(not(feature = "embedded"))]
    /// # fn main() {}
    /// ```
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] where the line leaves [`Contact::contact_radius_range`];
    /// [`Error::Unphysical`] for a `value` that is not finite, a stiffness outside
    /// `[1e-100, 1e100]`, or a `duration` that is not positive and finite;
    /// [`Error::InvalidArgument`] for a `tolerance` outside `[1e-10, 1e-2]`, or a law without
    /// finite speeds; [`Error::Motion`] where the solver fails. It fails on ramps so slow that `G`
    /// is within some 1e-6 of that at rest (1e-5 at a tolerance of 1e-4); [`ContactLine::impose`]
    /// is as accurate for these. After an error the state is that before the call.
    pub fn ramp(
        &mut self,
        control: Control,
        value: f64,
        duration: f64,
        tolerance: f64,
    ) -> Result<Vec<TimedState>, Error> {
        control.check()?;
        finite_input(control.name(), value)?;
        Error::unless(
            duration > 0.0 && duration.is_finite(),
            "duration",
            duration,
            "> 0 and finite",
        )?;
        Error::argument(
            (1e-10..=1e-2).contains(&tolerance),
            "tolerance",
            tolerance,
            "in [1e-10, 1e-2]",
        )?;
        let [advancing, receding] = self.law.at_rest();
        for moving in [receding.next_up(), advancing.next_down().max(0.0)] {
            let speed = self.law.speed(moving);
            let allowed = "finite for a motion in time: give the line a `RateDependent` law, or use `ContactLine::impose`";
            Error::argument(speed.is_finite(), SPEED, speed, allowed)?;
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
            failure: Cell::new(None),
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
    /// The error of the last direction that could not be computed.
    failure: Cell<Option<Error>>,
}

impl<L: CrackTip> Motion<'_, L> {
    /// Returns the states of the ramp, and whether the contact has separated in the last one.
    fn follow(&self) -> Result<(Vec<TimedState>, bool), Error> {
        let mut point = [1.0, 0.0];
        let mut states = vec![self.timed_state(&point)?];
        // With a first step of 0 the solver chooses one.
        let mut solver = solver(self.tolerance, 0.0);
        self.checked(&point, solver.init(self, 0.0, f64::MAX, &point))?;
        let ended = |point: &Point| point[TIME] >= 1.0;
        let separated = |point: &Point| point[RADIUS] * self.a1 < self.range[0];
        loop {
            let before = point;
            self.checked(&before, solver.step(self))?;
            if *solver.y() == before {
                continue; // The step was rejected.
            }
            point = *solver.y();
            if point[RADIUS] * self.a1 > self.range[1] {
                return Err(self
                    .contact
                    .outside(self.control.name(), self.imposed_at(&point)));
            }
            if !ended(&point) && !separated(&point) {
                states.push(self.timed_state(&point)?);
                continue;
            }
            // Bisection finds the length within the step at which the motion ends.
            let (from, mut within, mut length) =
                (solver.t_prev(), 0.0, solver.t() - solver.t_prev());
            for _ in 0..HALVINGS {
                let middle = 0.5 * (within + length);
                let between = solver.interpolate(from + middle).unwrap_or(point);
                if ended(&between) || separated(&between) {
                    (point, length) = (between, middle)
                } else {
                    within = middle
                }
            }
            let separated = separated(&point);
            let end = if separated {
                (RADIUS, self.range[0] / self.a1)
            } else {
                (TIME, 1.0)
            };
            point = self.end_point(&before, length, end)?;
            if separated && !self.shrinks_further(&point)? {
                return Err(self
                    .contact
                    .outside(self.control.name(), self.imposed_at(&point)));
            }
            states.push(self.timed_state(&point)?);
            return Ok((states, separated));
        }
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

    /// Returns the point at a `length` of about the given one from `before`, at which one
    /// coordinate has a given value. A step of the solver is more accurate than its interpolation.
    fn end_point(
        &self,
        before: &Point,
        length: f64,
        (coordinate, value): (usize, f64),
    ) -> Result<Point, Error> {
        let mut point = *before;
        if length > 0.0 {
            let mut solver = solver(self.tolerance, length);
            self.checked(before, solver.init(self, 0.0, length, before))?;
            while solver.t() < length {
                solver.set_h(solver.h().min(length - solver.t()));
                self.checked(&point, solver.step(self))?;
                point = *solver.y();
            }
        }
        let direction = self.direction(&point)?;
        let rest = (value - point[coordinate]) / direction[coordinate];
        if rest.abs() < LONGEST_STEP {
            point = [0, 1].map(|i| point[i] + rest * direction[i]);
        }
        point[coordinate] = value;
        Ok(point)
    }

    /// Accepts a step of the solver from `point`, unless it or the direction at one of its points
    /// failed.
    fn checked<T, E: std::fmt::Debug>(
        &self,
        point: &Point,
        step: Result<T, E>,
    ) -> Result<(), Error> {
        match (self.failure.take(), step) {
            (Some(failure), _) => Err(failure),
            (None, Ok(_)) => Ok(()),
            (None, Err(error)) => Err(Error::Motion {
                time: point[TIME] * self.duration,
                reason: format!("{error:?}"),
            }),
        }
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

    /// Returns the imposed value at a point.
    fn imposed_at(&self, point: &Point) -> f64 {
        let [from, to] = self.imposed;
        from + (to - from) * point[TIME]
    }

    /// Returns the unit vector along the curve.
    fn direction(&self, point: &Point) -> Result<Point, Error> {
        // The solver may try a radius out of range. The nearest one in range replaces it, because
        // only the last step can end out of range.
        let a = (point[RADIUS] * self.a1).clamp(self.range[0], self.range[1]);
        let (_, energy_release_rate) =
            self.contact
                .state_under(self.control, self.imposed_at(point), a)?;
        let speed = self.law.speed(energy_release_rate);
        Error::argument(
            !speed.is_nan(),
            SPEED,
            speed,
            "a number at any energy release rate",
        )?;
        let slope = speed * (self.duration / self.a1);
        let length = slope.hypot(1.0);
        Ok(if length.is_finite() {
            [-slope / length, 1.0 / length]
        } else {
            [-slope.signum(), 0.0]
        })
    }
}

/// Makes the solver for a tolerance and a first step.
fn solver(
    tolerance: f64,
    first_step: f64,
) -> impl OrdinaryNumericalMethod<f64, Point> + Interpolation<f64, Point> {
    // Radau5 replaces a tolerance r by 0.1 r^(2/3), as Hairer's code does. It would do so twice if
    // both coordinates shared one tolerance.
    let tolerances = || vec![(10.0 * tolerance).powf(1.5); 2];
    let radau = ImplicitRungeKutta::radau5()
        .rtol(tolerances())
        .atol(tolerances());
    radau
        .h0(first_step)
        .h_max(LONGEST_STEP)
        .max_steps(MOST_STEPS)
}

impl<L: CrackTip> ODE<f64, Point> for Motion<'_, L> {
    fn diff(&self, _length: f64, point: &Point, derivative: &mut Point) {
        *derivative = self.direction(point).unwrap_or_else(|failure| {
            self.failure.set(Some(failure));
            [0.0; 2]
        });
    }

    /// Computes difference quotients, as the solver would, but with a step for stiff equations:
    /// above a speed of 1 the direction is not linear over a longer one.
    fn jacobian(&self, length: f64, point: &Point, jacobian: &mut Matrix<f64>) {
        let (mut here, mut there) = ([0.0; 2], [0.0; 2]);
        self.diff(length, point, &mut here);
        for column in [RADIUS, TIME] {
            let mut beside = *point;
            beside[column] += DIFFERENCE;
            self.diff(length, &beside, &mut there);
            for row in [RADIUS, TIME] {
                jacobian[(row, column)] = (there[row] - here[row]) / DIFFERENCE;
            }
        }
    }
}
