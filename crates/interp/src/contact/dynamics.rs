//! The contact line in time: `da/dt = -v(G)` under a load or penetration that changes at a constant
//! rate.
//!
//! Where the line jumps, `a(t)` is all but vertical, and where the contact parts, the speed has no
//! bound. So the curve is followed along its length `s`, `ds^2 = (da/a1)^2 + (dt/T)^2`, with the
//! radius `a1` at the beginning and the duration `T` as units: nothing changes faster than `s`, and
//! while an infinitely fast line moves, time stands still. The slower the ramp, the stiffer the
//! equation, so the solver is implicit (Radau IIA of order 5).

use std::cell::Cell;

use differential_equations::interpolate::Interpolation;
use differential_equations::linalg::Matrix;
use differential_equations::methods::ImplicitRungeKutta;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};

use crate::{Contact, ContactLine, Control, CrackTip, Error, State};

/// Radius and time in units of their scales.
type Point = [f64; 2];
const RADIUS: usize = 0;
const TIME: usize = 1;

/// The longest step: no two moments are farther apart, for the sake of those who plot or integrate
/// them.
const LONGEST_STEP: f64 = 0.01;
/// Far more than a ramp takes: growth to 400 times the radius takes 40 000.
const STEPS: usize = 50_000;
/// The step of the derivatives: between rounding and what the stiffest equations allow.
const DIFFERENCE: f64 = 1e-10;
/// Halvings of a step that leave nothing of it.
const HALVINGS: usize = 60;

/// A contact at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedState {
    /// Time since the ramp began, s.
    pub time: f64,
    /// The contact.
    pub state: State,
    /// Its energy release rate `G`, J/m^2.
    pub energy_release_rate: f64,
}

impl<L: CrackTip> ContactLine<'_, L> {
    /// Brings what is controlled, the load (N), the penetration or the position of the spring (m),
    /// to a value in `duration` (s) at a constant rate. Gives the moments in between, from the
    /// beginning to the end, or to where the contact parts: [`ContactLine::state`] is `None` then.
    /// Between two moments the radius changes by 1 % of the first one at most, the time by 1 % of
    /// the duration. To hold what is controlled, impose its own value. The sphere has no inertia.
    ///
    /// `tolerance` bounds the error that the solver makes in a step, relative to the radius at the
    /// beginning and to the duration.
    ///
    /// A contact has parted when it is smaller than `tolerance` times its radius at the beginning,
    /// or than the smallest of [`Contact::contact_radius_range`], and `G` rises as it shrinks.
    ///
    /// ```
    /// # #[cfg(feature = "embedded")]
    /// # fn main() -> Result<(), interp::Error> {
    /// use interp::{Control, Elastic, RateDependent, System, Table};
    ///
    /// let film = Elastic::new(3.5e6, 0.5)?;
    /// let substrate = Elastic::new(2e11, 0.25)?;
    /// let system = System { sphere_radius: 1e-3, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
    /// let contact = Table::embedded().contact(&system)?;
    /// let mut line = contact.line(RateDependent::new(0.04, 1e-6, 0.6)?, 65e-6)?;
    /// line.ramp(Control::Load, 1e-3, 10.0, 1e-6)?;
    /// let unloading = line.ramp(Control::Load, -1e-3, 20.0, 1e-6)?;
    /// assert!(line.state().is_none()); // pulled off,
    /// let pull_off = unloading.last().expect("a moment").state;
    /// assert!(pull_off.load < -0.19e-3); // at more than 1.5 pi w R
    /// # Ok(()) }
    /// # #[cfg(not(feature = "embedded"))]
    /// # fn main() {}
    /// ```
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] where the line leaves [`Contact::contact_radius_range`];
    /// [`Error::Unphysical`] for a value that is not finite, a stiffness outside `[1e-100, 1e100]`,
    /// a `duration` that is not positive and finite, a `tolerance` outside `[1e-10, 1e-2]`, or a
    /// law without finite speeds; [`Error::Motion`] where the solver fails, as it does in ramps so
    /// slow that `G` is within some 1e-6 of that at rest (1e-5 at a tolerance of 1e-4):
    /// [`ContactLine::impose`] is as good for these. The line then stays where it was.
    pub fn ramp(
        &mut self,
        control: Control,
        value: f64,
        duration: f64,
        tolerance: f64,
    ) -> Result<Vec<TimedState>, Error> {
        control.check()?;
        Error::unless(value.is_finite(), control.name(), value, "finite")?;
        Error::unless(
            duration > 0.0 && duration.is_finite(),
            "duration",
            duration,
            "> 0 and finite",
        )?;
        Error::unless(
            (1e-10..=1e-2).contains(&tolerance),
            "tolerance",
            tolerance,
            "in [1e-10, 1e-2]",
        )?;
        let [advancing, receding] = self.law.at_rest();
        for beyond in [receding.next_up(), advancing.next_down().max(0.0)] {
            let speed = self.law.speed(beyond);
            Error::unless(
                speed.is_finite(),
                "speed of the crack-tip law",
                speed,
                "finite for a motion in time",
            )?;
        }
        let Some(start) = self.state else {
            return Ok(Vec::new());
        };
        let a1 = start.contact_radius;
        self.contact.under(control, value, a1)?;
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
        let (moments, parted) = motion.follow()?;
        self.state = moments
            .last()
            .filter(|_| !parted)
            .map(|moment| moment.state);
        Ok(moments)
    }
}

/// A ramp.
struct Motion<'a, L> {
    contact: &'a Contact,
    law: &'a L,
    control: Control,
    /// At the beginning and at the end.
    imposed: [f64; 2],
    a1: f64,
    duration: f64,
    tolerance: f64,
    range: [f64; 2],
    /// Why there is no direction somewhere.
    failure: Cell<Option<Error>>,
}

impl<L: CrackTip> Motion<'_, L> {
    /// The moments of the ramp, and whether the contact has parted at the last.
    fn follow(&self) -> Result<(Vec<TimedState>, bool), Error> {
        let mut point = [1.0, 0.0];
        let mut moments = vec![self.moment(&point)?];
        // The solver chooses its first step.
        let mut solver = solver(self.tolerance, 0.0);
        self.checked(&point, solver.init(self, 0.0, f64::MAX, &point))?;
        let ended = |point: &Point| point[TIME] >= 1.0;
        let parted = |point: &Point| point[RADIUS] * self.a1 < self.range[0];
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
            if !ended(&point) && !parted(&point) {
                moments.push(self.moment(&point)?);
                continue;
            }
            // Where in the step is the end?
            let (from, mut within, mut length) =
                (solver.t_prev(), 0.0, solver.t() - solver.t_prev());
            for _ in 0..HALVINGS {
                let middle = 0.5 * (within + length);
                let between = solver.interpolate(from + middle).unwrap_or(point);
                if ended(&between) || parted(&between) {
                    (point, length) = (between, middle)
                } else {
                    within = middle
                }
            }
            let parted = parted(&point);
            let end = if parted {
                (RADIUS, self.range[0] / self.a1)
            } else {
                (TIME, 1.0)
            };
            point = self.land(&before, length, end)?;
            if parted && !self.parts(&point)? {
                return Err(self
                    .contact
                    .outside(self.control.name(), self.imposed_at(&point)));
            }
            moments.push(self.moment(&point)?);
            return Ok((moments, parted));
        }
    }

    /// Whether a contact that shrinks to this will part: the smaller it is, the larger its energy
    /// release rate.
    fn parts(&self, point: &Point) -> Result<bool, Error> {
        let rate = |a| {
            self.contact
                .under(self.control, self.imposed_at(point), a)
                .map(|(_, rate)| rate)
        };
        Ok(rate(self.range[0])? > rate(self.range[0] * (1.0 + LONGEST_STEP))?)
    }

    /// The place near `before`, `length` from there, where one coordinate has its last value. An
    /// interpolation would not be as accurate as a step.
    fn land(
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

    /// What the solver says, unless there was no direction to give it.
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

    fn moment(&self, point: &Point) -> Result<TimedState, Error> {
        let (state, energy_release_rate) = self.contact.under(
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

    fn imposed_at(&self, point: &Point) -> f64 {
        let [from, to] = self.imposed;
        from + (to - from) * point[TIME]
    }

    /// The unit vector along the curve.
    fn direction(&self, point: &Point) -> Result<Point, Error> {
        // Where the solver tries a radius out of range, it is as if it were in range: no step ends
        // there but the last.
        let a = (point[RADIUS] * self.a1).clamp(self.range[0], self.range[1]);
        let (_, energy_release_rate) =
            self.contact
                .under(self.control, self.imposed_at(point), a)?;
        let speed = self.law.speed(energy_release_rate);
        Error::unless(
            !speed.is_nan(),
            "speed of the crack-tip law",
            speed,
            "a number",
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

/// The solver for a tolerance and a first step.
fn solver(
    tolerance: f64,
    first_step: f64,
) -> impl OrdinaryNumericalMethod<f64, Point> + Interpolation<f64, Point> {
    // Radau5 takes 0.1 r^(2/3) for a tolerance of r, as Hairer's code does, and takes it again for
    // each further coordinate that shares it.
    let tolerances = || vec![(10.0 * tolerance).powf(1.5); 2];
    let radau = ImplicitRungeKutta::radau5()
        .rtol(tolerances())
        .atol(tolerances());
    radau.h0(first_step).h_max(LONGEST_STEP).max_steps(STEPS)
}

impl<L: CrackTip> ODE<f64, Point> for Motion<'_, L> {
    fn diff(&self, _length: f64, point: &Point, derivative: &mut Point) {
        *derivative = self.direction(point).unwrap_or_else(|failure| {
            self.failure.set(Some(failure));
            [0.0; 2]
        });
    }

    /// By differences, as the solver would, but with a step that suits stiff equations: beyond a
    /// speed of 1 the direction is no longer linear.
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
