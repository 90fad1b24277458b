//! The states of one branch at many imposed values, with their derivatives at a fixed imposed
//! value.

use crate::Error;
use crate::{Derivatives, Equilibria, Input, State};
use interp::check::finite_result;

/// Where several stable equilibria exist at an imposed value, the one that an experiment is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Branch {
    /// That of the smallest contact radius, [`Equilibria::loading`].
    Loading,
    /// That of the largest contact radius, [`Equilibria::unloading`].
    Unloading,
}

/// The most steps of Newton's method before the search by bracketing takes over.
const MOST_STEPS: usize = 8;
/// The largest error of the logarithm of a contact radius.
const TOLERANCE: f64 = 1e-15;

impl Equilibria<'_> {
    /// Writes into `states` the stable state at each `imposed` value, in their order.
    ///
    /// The states are those of [`Equilibria::loading`] or [`Equilibria::unloading`], to rounding:
    /// contact radii to 1e-12, except at the end of a branch, where the radius has an infinite
    /// slope and half as many digits. Each search starts from the state before it: on values in
    /// ascending or descending order it takes one or two evaluations of the curve, on values in no
    /// order about ten.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// use interp::{Elastic, HalfSpace, Probe};
    /// use contact::{Branch, Contact, Control, State};
    ///
    /// let system = HalfSpace { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
    /// let contact = Contact::half_space(&system)?;
    /// let equilibria = contact.equilibria(0.04, Control::Displacement)?;
    /// let mut states = [State::ORIGIN; 3];
    /// equilibria.branch(&[2e-6, 1e-6, 0.0], Branch::Unloading, &mut states)?;
    /// assert!(states[0].load > states[1].load && states[2].load < 0.0);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`interp::Error::InvalidArgument`] unless `states` is as long as `imposed`; else as
    /// [`Equilibria::loading`] or [`Equilibria::unloading`] at the first value that has an error.
    /// The states before it are written.
    pub fn branch(
        &self,
        imposed: &[f64],
        branch: Branch,
        states: &mut [State],
    ) -> Result<(), Error> {
        interp::Error::same_length(imposed, states)?;
        let mut follower = Follower {
            equilibria: self,
            branch,
            last: None,
        };
        for (state, &value) in states.iter_mut().zip(imposed) {
            *state = follower.state(value)?;
        }
        Ok(())
    }

    /// Writes into `states` what [`Equilibria::branch`] does, and into `derivatives` those of load
    /// and penetration at each state: with respect to the imposed value, and then, at a fixed
    /// imposed value, with respect to each of the `inputs`. They are in the order of the states,
    /// `1 + inputs.len()` for each.
    ///
    /// By the theorem on implicit functions the derivative of the load at a fixed imposed value `v`
    /// is `F_p - F_a v_p/v_a`, with partial derivatives with respect to the input `p` and the
    /// contact radius `a`. The derivative with respect to the stiffness `k` of a spring is `F/k^2`
    /// times that with respect to the position.
    ///
    /// Without adhesion the derivatives at an imposed value of 0 are 0, and so are those with
    /// respect to the work of adhesion everywhere.
    ///
    /// # Errors
    /// As [`Equilibria::branch`], [`Contact::gradient`](crate::Contact::gradient) and
    /// [`ContactGradient::by`](crate::ContactGradient::by); [`interp::Error::InvalidArgument`] unless
    /// `derivatives` has its length; [`interp::Error::Unphysical`] at the very end of a branch, where the
    /// derivatives are infinite.
    pub fn branch_with_gradient(
        &self,
        imposed: &[f64],
        branch: Branch,
        inputs: &[Input],
        states: &mut [State],
        derivatives: &mut [Derivatives],
    ) -> Result<(), Error> {
        let width = 1 + inputs.len();
        interp::Error::argument(
            derivatives.len() == width * imposed.len(),
            "the number of derivatives",
            derivatives.len() as f64,
            "that of the imposed values times (1 + that of the inputs)",
        )?;
        self.branch(imposed, branch, states)?;
        self.contact.same_material()?;
        for (state, derivatives) in states.iter().zip(derivatives.chunks_exact_mut(width)) {
            self.differentiate(state, inputs, derivatives)?;
        }
        Ok(())
    }

    /// Writes the derivatives at one state.
    fn differentiate(
        &self,
        state: &State,
        inputs: &[Input],
        derivatives: &mut [Derivatives],
    ) -> Result<(), Error> {
        let a = state.contact_radius;
        if a == 0.0 {
            derivatives.fill(Derivatives::ZERO);
            return Ok(());
        }
        let (w, mut gradient) = (self.energy.work_of_adhesion, None);
        let terms = self.contact.terms(a, w, &mut gradient)?;
        let unknown = |input: Input| Error::from(interp::Error::FixedParameter(input.name()));
        let by = |input: Input| terms.by_one(input).ok_or_else(|| unknown(input));
        // Under a flat punch not the contact radius but the energy release rate follows the imposed
        // value: `F = S delta`.
        let punch = self.contact.is_punch().then_some(terms.stiffness);
        let by_radius = match punch {
            Some(stiffness) => Derivatives {
                load: stiffness,
                penetration: 1.0,
            },
            None => by(Input::ContactRadius)?,
        };
        let imposed_by_radius = self.control.imposed(by_radius.load, by_radius.penetration);
        let (by_imposed, by_inputs) = derivatives
            .split_first_mut()
            .expect("the length is 1 + that of the inputs");
        *by_imposed = Derivatives {
            load: finite_result(a, by_radius.load / imposed_by_radius)?,
            penetration: finite_result(a, by_radius.penetration / imposed_by_radius)?,
        };
        for (derivative, &input) in by_inputs.iter_mut().zip(inputs) {
            let at_radius = match input {
                Input::WorkOfAdhesion if self.adhesionless() => Derivatives::ZERO,
                _ if punch.is_some() => Derivatives {
                    load: state.load * terms.stiffness_by(input).ok_or_else(|| unknown(input))?,
                    penetration: 0.0,
                },
                _ => by(input)?,
            };
            let change = self.control.imposed(at_radius.load, at_radius.penetration);
            *derivative = Derivatives {
                load: finite_result(a, at_radius.load - by_imposed.load * change)?,
                penetration: finite_result(
                    a,
                    at_radius.penetration - by_imposed.penetration * change,
                )?,
            };
        }
        Ok(())
    }
}

/// The last state found on a branch, from which the next one is sought.
#[derive(Clone, Copy, Debug)]
struct Last {
    section: usize,
    /// The logarithm of the contact radius.
    u: f64,
    /// The imposed value, `du/dv`, and the second and the third derivative of `u` as far as they are
    /// known.
    imposed: f64,
    speed: f64,
    acceleration: f64,
    jerk: f64,
}

impl Last {
    /// Returns the logarithm of the contact radius to be expected after a change of the imposed value.
    fn after(&self, change: f64) -> f64 {
        let bend = 0.5 * (self.acceleration + change * self.jerk / 3.0);
        self.u + change * (self.speed + change * bend)
    }

    /// Returns the state after a change of the imposed value, with the derivatives of the cubic
    /// polynomial that has both values and both slopes.
    fn followed_by(self, change: f64, u: f64, speed: f64) -> Self {
        let imposed = self.imposed + change;
        if change == 0.0 {
            return Self { u, speed, ..self };
        }
        let chord = (u - self.u) / change;
        let (bend, twist) = ((speed - chord) / change, (speed - self.speed) / change);
        Self {
            u,
            imposed,
            speed,
            acceleration: 2.0 * (3.0 * bend - twist),
            jerk: 6.0 * (2.0 * bend - twist) / change,
            ..self
        }
    }
}

/// Follows a branch from one imposed value to the next.
struct Follower<'a> {
    equilibria: &'a Equilibria<'a>,
    branch: Branch,
    last: Option<Last>,
}

impl Follower<'_> {
    /// Returns the state at an imposed value.
    fn state(&mut self, imposed: f64) -> Result<State, Error> {
        if let Some(found) = self.near_the_last(imposed)? {
            return Ok(found);
        }
        let found = match self.branch {
            Branch::Loading => self.equilibria.loading(imposed)?,
            Branch::Unloading => self.equilibria.unloading(imposed)?,
        };
        self.last = None;
        if self.equilibria.contact.is_punch() {
            return Ok(found);
        }
        if let Some((section, _)) = self.equilibria.section_of(self.branch, imposed)?
            && found.contact_radius > 0.0
        {
            let Equilibria {
                contact,
                energy,
                control,
                ..
            } = self.equilibria;
            let a = found.contact_radius;
            let (_, [load, penetration]) = contact.state_and_slopes(a, *energy)?;
            let speed = 1.0 / control.imposed(load, penetration);
            self.last = Some(Last {
                section,
                u: a.ln(),
                imposed,
                speed,
                acceleration: 0.0,
                jerk: 0.0,
            });
        }
        Ok(found)
    }

    /// Returns the state at an imposed value by Newton's method from the last state; `None` if
    /// there is no last state on the section, or if the method leaves the section or is slow.
    fn near_the_last(&mut self, imposed: f64) -> Result<Option<State>, Error> {
        let Some(last) = self.last else {
            return Ok(None);
        };
        let Equilibria {
            contact,
            energy,
            control,
            ..
        } = *self.equilibria;
        let section = match self.equilibria.section_of(self.branch, imposed)? {
            Some((number, section))
                if number == last.section && !section.imposed.contains(&imposed) =>
            {
                section
            }
            _ => return Ok(None),
        };
        let change = imposed - last.imposed;
        let mut u = last.after(change);
        // Newton's error after a step `s` is `s^2 v''/(2 v')`, that is `s^2 u''/(2 u'^2)`; four
        // times that is safe, and 4 s^2 for powers.
        let bend = 4.0 * (1.0 + (0.5 * last.acceleration / (last.speed * last.speed)).abs());
        let mut before = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            if !(u >= section.u[0] && u <= section.u[1]) {
                return Ok(None);
            }
            let a = contact.radius_at(u);
            let (at, [load, penetration]) = contact.state_and_slopes(a, energy)?;
            let slope = control.imposed(load, penetration);
            let step = (imposed - control.imposed(at.load, at.penetration)) / slope;
            // Where the steps shrink like squares, their ratio shows the error, too.
            let error = if before.is_finite() {
                (step * step * bend).max((step / before).powi(2) * step.abs())
            } else {
                step * step * bend
            };
            if error <= TOLERANCE {
                self.last = Some(last.followed_by(change, u + step, 1.0 / slope));
                return Ok(Some(State {
                    contact_radius: a * (1.0 + step),
                    load: at.load + load * step,
                    penetration: at.penetration + penetration * step,
                }));
            }
            if step.is_nan() || step.abs() >= before {
                return Ok(None);
            }
            (u, before) = (u + step, step.abs());
        }
        Ok(None)
    }
}
