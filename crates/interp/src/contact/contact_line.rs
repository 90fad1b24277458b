//! The contact line: where a load or a penetration, changed slowly, takes it.

use crate::contact::contact::finite;
use crate::contact::crack_tip;
use crate::{Contact, Control, CrackTip, Error, State};

/// How far (of a radius) an equilibrium may be on the wrong side of the line that goes to it:
/// rounding moves the line and the equilibrium, most near a turning point.
const ROUNDING: f64 = 1e-6;

/// A contact and where its line is, which is moved by a load, a penetration or a spring according
/// to a [`CrackTip`] law.
///
/// [`ContactLine::impose`] moves it so slowly that the line is at rest all the time;
/// `ContactLine::ramp` (feature `dynamics`) in a given time.
///
/// ```
/// # fn main() -> Result<(), interp::Error> {
/// use interp::{Contact, Control, Elastic, HalfSpace, Hysteresis};
///
/// let system = HalfSpace { sphere_radius: 1e-3, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
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
    /// None once the contact has parted.
    pub(crate) state: Option<State>,
}

impl Contact {
    /// The line of a contact that has slowly grown to radius `a` (m).
    ///
    /// # Errors
    /// Those of [`Contact::load_and_penetration`]; [`Error::Unphysical`] for a law whose energies
    /// at rest are negative, infinite or in the wrong order; [`Error::MissingQuantity`] without all
    /// four quantities.
    pub fn line<L: CrackTip>(&self, law: L, a: f64) -> Result<ContactLine<'_, L>, Error> {
        let [advancing, _] = crack_tip::checked(law.at_rest())?;
        self.quantities(a)?;
        let state = self.state(a, advancing)?;
        Ok(ContactLine {
            contact: self,
            law,
            state: Some(state),
        })
    }

    /// The state at contact radius `a` (m) under an imposed value, whatever the work of adhesion,
    /// and its energy release rate (J/m^2), negative where the edge presses.
    pub(crate) fn under(
        &self,
        control: Control,
        imposed: f64,
        a: f64,
    ) -> Result<(State, f64), Error> {
        let (quantities, mechanics) = (self.quantities(a)?, self.mechanics());
        let (load, penetration) = mechanics.load_and_penetration(a, 0.0, &quantities);
        // What an edge singularity of 1 N/m takes away: that of a flat punch.
        let penetration_of_edge = 1.0 / mechanics.edge_of_flat_punch(1.0, quantities.gamma);
        let load_of_edge = mechanics.stiffness(a, quantities.eeq) * penetration_of_edge;
        let edge = (control.imposed(load, penetration) - imposed)
            / control.imposed(load_of_edge, penetration_of_edge);
        let state = State {
            contact_radius: a,
            load: load - edge * load_of_edge,
            penetration: penetration - edge * penetration_of_edge,
        };
        Ok((state, finite(a, mechanics.energy_release_rate(a, edge))?))
    }
}

impl<L: CrackTip> ContactLine<'_, L> {
    /// The contact as it is; `None` once it has parted.
    pub const fn state(&self) -> Option<State> {
        self.state
    }

    /// Brings what is controlled slowly to a value: the load (N), the penetration or the position
    /// of the spring (m). Gives the new state; `None` once the contact has parted, which is for
    /// good.
    ///
    /// The line stays where it is while the energy release rate is between the two energies of the
    /// [law at rest](CrackTip::at_rest). Beyond them it goes to the nearest [stable
    /// equilibrium](crate::Equilibria) with the energy it has passed, in a jump if need be, whose
    /// kinetic energy is lost. Where there is none, the contact parts. All at once or in steps
    /// makes no difference, unless they go back.
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] where the line may leave the curve; [`Error::Unphysical`] for a
    /// value that is not finite, or a stiffness outside `[1e-100, 1e100]`. The line then stays
    /// where it was.
    pub fn impose(&mut self, control: Control, value: f64) -> Result<Option<State>, Error> {
        control.check()?;
        Error::unless(value.is_finite(), control.name(), value, "finite")?;
        let Some(State {
            contact_radius: a, ..
        }) = self.state
        else {
            return Ok(None);
        };
        let [advancing, receding] = self.law.at_rest();
        let (here, energy_release_rate) = self.contact.under(control, value, a)?;
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
