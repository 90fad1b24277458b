//! The slow motion of the contact line under a load, a penetration or a spring.

use super::crack_tip::energies_in_order;
use crate::Error;
use crate::{Contact, Control, CrackTip, State};
use interp::check::{finite_input, finite_result};

/// The part of a radius by which an equilibrium may lie on the wrong side of the line that moves to
/// it. Rounding shifts both, most of all near a turning point.
const ROUNDING: f64 = 1e-6;

/// A contact with the position of its line, which moves by a [`CrackTip`] law.
///
/// [`ContactLine::impose`] changes a load, a penetration or the position of a spring so slowly that
/// the line is at rest all the time. [`ContactLine::ramp`] changes it in a given time.
///
/// ```
/// # fn main() -> Result<(), contact::Error> {
/// use interp::{Elastic, HalfSpace, Probe};
/// use contact::{Contact, Control, Hysteresis};
///
/// let system = HalfSpace { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
/// let contact = Contact::half_space(&system)?;
/// let mut line = contact.line(Hysteresis::new(0.03, 0.05)?, 50e-6)?;
/// let loaded = line.impose(Control::Load, 1e-3)?.expect("in contact");
/// let unloaded = line.impose(Control::Load, 0.8e-3)?.expect("in contact");
/// assert_eq!(unloaded.contact_radius, loaded.contact_radius); // pinned
/// assert_eq!(line.impose(Control::Load, -0.3e-3)?, None); // pulled off
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct ContactLine<'a, L> {
    pub(crate) contact: &'a Contact,
    pub(crate) law: L,
    /// `None` after the contact has separated.
    pub(crate) state: Option<State>,
}

impl Contact {
    /// Returns the line of a contact that has slowly grown to radius `a` (m) under a crack-tip
    /// `law`.
    ///
    /// # Errors
    /// As [`Contact::load_and_penetration`]; [`interp::Error::Unphysical`] for a law whose energies at rest
    /// are negative, infinite or in the wrong order; [`interp::Error::MissingQuantity`] without all four
    /// quantities; [`interp::Error::OtherProbe`] under a flat punch; [`Error::Sticks`] with full friction.
    pub fn line<L: CrackTip>(&self, law: L, a: f64) -> Result<ContactLine<'_, L>, Error> {
        let [advancing, _] = self.energies_of_line(&law)?;
        self.quantities(a)?;
        let state = self.state(a, advancing)?;
        Ok(ContactLine {
            contact: self,
            law,
            state: Some(state),
        })
    }

    /// Returns the line of this contact in a `state` that another line of it had, such as one that
    /// was saved; `None` after it has separated.
    ///
    /// # Errors
    /// As [`Contact::line`]; [`interp::Error::Unphysical`] for a load or penetration that is not finite.
    pub fn line_in<L: CrackTip>(
        &self,
        law: L,
        state: Option<State>,
    ) -> Result<ContactLine<'_, L>, Error> {
        self.energies_of_line(&law)?;
        if let Some(state) = state {
            self.quantities(state.contact_radius)?;
            finite_input("load", state.load)?;
            finite_input("penetration", state.penetration)?;
        }
        Ok(ContactLine {
            contact: self,
            law,
            state,
        })
    }

    /// Returns the energies at rest of the law of a line, which neither a flat punch nor a contact
    /// with full friction has.
    fn energies_of_line(&self, law: &impl CrackTip) -> Result<[f64; 2], Error> {
        let energies = energies_in_order(law.at_rest())?;
        self.without_stick(
            "a contact line that moves under a crack-tip law",
            "what sticks depends on the history of the contact; ask for the states with one work of \
             adhesion, or take the curve of a receding contact",
        )?;
        if self.is_punch() {
            return Err(self.makes_no_sense("a contact line that moves"));
        }
        Ok(energies)
    }

    /// Returns the state at contact radius `a` (m) under an `imposed` value, and its energy release
    /// rate (J/m^2), which is negative where the stress at the edge is compressive. No work of
    /// adhesion is assumed.
    pub(crate) fn state_under(
        &self,
        control: Control,
        imposed: f64,
        a: f64,
    ) -> Result<(State, f64), Error> {
        let mechanics = self.mechanics();
        mechanics.check_radius(a)?;
        let (without, quantities) = self.adhesionless_and_quantities(a)?;
        let (load, penetration) = (without.load, without.penetration);
        // An edge singularity of 1 N/m reduces both by those of a flat punch.
        let penetration_of_edge = 1.0 / mechanics.edge_of_flat_punch(1.0, quantities.gamma);
        let load_of_edge = mechanics.stiffness(a, quantities.eeq) * penetration_of_edge;
        let edge = (control.imposed(load, penetration) - imposed)
            / control.imposed(load_of_edge, penetration_of_edge);
        let state = State {
            contact_radius: a,
            load: finite_result(a, load - edge * load_of_edge)?,
            penetration: finite_result(a, penetration - edge * penetration_of_edge)?,
        };
        Ok((
            state,
            finite_result(a, mechanics.energy_release_rate(a, edge))?,
        ))
    }
}

impl<L: CrackTip> ContactLine<'_, L> {
    /// Returns the present state; `None` after the contact has separated.
    pub const fn state(&self) -> Option<State> {
        self.state
    }

    /// Brings the load (N), the penetration (m) or the position of the spring (m) slowly to
    /// `value`. Returns the new state, or `None` after the contact has separated. A separated
    /// contact does not form again.
    ///
    /// The line does not move while the energy release rate is between the two energies of the [law
    /// at rest](CrackTip::at_rest). Outside them it moves to the nearest [stable
    /// equilibrium](crate::Equilibria) of the energy that was passed. The motion may be a jump,
    /// whose kinetic energy is lost. Where there is no such equilibrium, the contact separates. One
    /// large change and several small ones in one direction give one result.
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] where the line may leave the curve; [`interp::Error::Unphysical`] for a
    /// `value` that is not finite, or a stiffness outside `[1e-100, 1e100]`. After an error the
    /// state is that before the call.
    pub fn impose(&mut self, control: Control, value: f64) -> Result<Option<State>, Error> {
        control.check()?;
        finite_input(control.name(), value)?;
        let Some(State {
            contact_radius: a, ..
        }) = self.state
        else {
            return Ok(None);
        };
        let [advancing, receding] = self.law.at_rest();
        let (here, energy_release_rate) = self.contact.state_under(control, value, a)?;
        let stable = |energy| {
            let equilibria = self
                .contact
                .equilibria(energy, control)?
                .at(value)?
                .into_iter();
            let stable = equilibria
                .filter(|equilibrium| equilibrium.stable)
                .map(|equilibrium| equilibrium.state);
            Ok::<_, Error>(stable.filter(|state| state.contact_radius > 0.0))
        };
        self.state = if energy_release_rate > receding {
            stable(receding)?.rfind(|state| state.contact_radius <= a * (1.0 + ROUNDING))
        } else if energy_release_rate < advancing {
            stable(advancing)?.find(|state| state.contact_radius >= a * (1.0 - ROUNDING))
        } else {
            Some(here)
        };
        Ok(self.state)
    }
}
