//! The equilibria of a contact with a given work of adhesion under a load, a penetration or a
//! spring, their stability, and the separation.

use std::sync::OnceLock;

use super::turning_points::Section;
use crate::Error;
use crate::line_energy::LineEnergy;
use crate::root::root;
use crate::{Branch, Contact, State};
use interp::check::{finite_input, work_of_adhesion};

/// The quantity that is imposed on the contact. The stability of the equilibria depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// The load `F`, N: a dead weight.
    Load,
    /// The penetration `delta`, m: a rigid testing machine.
    Displacement,
    /// The position `delta + F/k` (m) of the far end of a spring in series with the contact, such
    /// as a cantilever. It is 0 where the sphere would just touch.
    Spring {
        /// The stiffness `k` of the spring, N/m, from 1e-100 to 1e100.
        stiffness: f64,
    },
}

impl Control {
    /// Returns the name of the imposed quantity.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Displacement => "penetration",
            Self::Spring { .. } => "position of the spring",
        }
    }

    /// Accepts a spring unless its stiffness is so extreme that computations would overflow.
    pub(crate) fn check(self) -> Result<(), interp::Error> {
        match self {
            Self::Spring { stiffness } => interp::Error::unless(
                (1e-100..=1e100).contains(&stiffness),
                "stiffness of the spring",
                stiffness,
                "in [1e-100, 1e100] N/m; without a spring the load is imposed, and under a rigid drive the penetration",
            ),
            _ => Ok(()),
        }
    }

    /// Returns the imposed value at a `load` (N) and a `penetration` (m), or its slope from their
    /// slopes.
    pub fn imposed(self, load: f64, penetration: f64) -> f64 {
        match self {
            Self::Load => load,
            Self::Displacement => penetration,
            Self::Spring { stiffness } => penetration + load / stiffness,
        }
    }
}

/// An equilibrium at an imposed value, of a contact whose states are of the kind `S`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium<S = State> {
    /// The state of the contact.
    pub state: S,
    /// Whether the contact returns to this state after a small change of its radius. It does where
    /// the imposed value grows with the contact radius.
    pub stable: bool,
}

/// The equilibria of a contact with one work of adhesion under one control, at all contact radii of
/// [`Contact::contact_radius_range`]. "In range" below means in this range.
///
/// At each contact radius there is one equilibrium, `G = w`, and so one imposed value `v(a)`: the
/// load, the penetration or the spring's position. The equilibrium is stable where `v` grows with
/// `a`, because a slightly larger contact at an unchanged `v` has `G > w`, and shrinks back.
///
/// The turning points of `v` are found by the change of sign of its exact slope on a grid of
/// `ln a`, at most 0.2 apart under a paraboloid or a sphere and 0.05 under other shapes, which contains
/// the radii where the shape bends and points between them; and then refined to rounding. Where the
/// slope comes nearer to 0 at a point of the grid than at both of its neighbours without a change
/// of sign, its extremum is searched, too. Two turning points are missed only between two
/// neighbouring points of the grid at which the slope does not show its extremum; their hysteresis
/// is too small to matter. Where lower bounds of the slopes show that `v` grows from some radius to
/// the end of the range, these radii are left out of the search: under a cone, for instance, from
/// about ten times the radius of the last turning point on.
///
/// JKR has one turning point, a minimum, and so has a contact that is smaller than the curve's
/// nodes, under a shape that does not bend there. Films and bends can cause more turning points, and
/// then several stable equilibria at one `v`.
#[derive(Clone, Debug)]
pub struct Equilibria<'a> {
    pub(crate) contact: &'a Contact,
    pub(crate) energy: LineEnergy,
    pub(crate) control: Control,
    /// In ascending order of contact radius.
    pub(crate) sections: Vec<Section>,
    /// The logarithms of radii up to the end of the range to which the last section goes on without
    /// a turning point, and the imposed values there, made when they are needed.
    pub(crate) beyond: Vec<(f64, OnceLock<f64>)>,
}

impl Contact {
    /// Finds the turning points of the equilibria with work of adhesion `w` (J/m^2) under a
    /// `control`.
    ///
    /// Each function of the result then takes a few evaluations of the curve.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// # use interp::{Elastic, Probe, System, Table};
    /// # use contact::{Contact, Control};
    /// # let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    /// # let system = System { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, film, film_thickness: 1e-5, substrate };
    /// let contact = Contact::in_table(Table::embedded(), &system)?;
    /// let equilibria = contact.equilibria(0.04, Control::Load)?;
    /// let at_rest = equilibria.unloading(0.0)?; // 67.06 um
    /// assert!((at_rest.contact_radius / 67.06e-6 - 1.0).abs() < 1e-4);
    /// for equilibrium in equilibria.at(-1e-4)? {
    ///     println!("{} m, stable: {}", equilibrium.state.contact_radius, equilibrium.stable);
    /// }
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] for a `w` that is negative, infinite or NaN, or a spring's stiffness
    /// outside `[1e-100, 1e100]`; [`interp::Error::MissingQuantity`] without `pi0`, `delta0` and, with
    /// adhesion, `eeq` and `gamma`.
    pub fn equilibria(&self, w: f64, control: Control) -> Result<Equilibria<'_>, Error> {
        work_of_adhesion(w)?;
        if self.is_punch() {
            control.check()?;
            return self.equilibria_of_punch(w, control);
        }
        self.equilibria_with(LineEnergy::of_jkr(w), control)
    }

    /// Returns the equilibria of a flat punch. Its line stays at the edge of the punch, so that there
    /// is one stable equilibrium at every imposed value from that of the pull-off on.
    fn equilibria_of_punch(&self, w: f64, control: Control) -> Result<Equilibria<'_>, Error> {
        let [radius, _] = self.contact_radius_range();
        let (load, penetration) = self.load_and_penetration(radius, w)?;
        Ok(Equilibria {
            contact: self,
            energy: LineEnergy::of_jkr(w),
            control,
            sections: vec![Section {
                u: [radius.ln(); 2],
                imposed: [control.imposed(load, penetration), f64::MAX],
                rises: true,
            }],
            beyond: Vec::new(),
        })
    }

    /// Returns the state in which a contact with work of adhesion `w` (J/m^2) separates on
    /// unloading, [`Equilibria::pull_off`].
    ///
    /// # Errors
    /// As [`Contact::equilibria`] and [`Equilibria::pull_off`].
    pub fn pull_off(&self, w: f64, control: Control) -> Result<State, Error> {
        self.equilibria(w, control)?.pull_off()
    }

    /// Returns the stable state with work of adhesion `w` (J/m^2) at zero load.
    ///
    /// It is the state that unloading under load control reaches, [`Equilibria::unloading`].
    /// Without adhesion it is [`State::ORIGIN`].
    ///
    /// # Errors
    /// As [`Contact::equilibria`] and [`Equilibria::unloading`].
    pub fn zero_load(&self, w: f64) -> Result<State, Error> {
        self.equilibria(w, Control::Load)?.unloading(0.0)
    }
}

impl Equilibria<'_> {
    /// Returns all equilibria in range at an `imposed` load (N), penetration (m) or position of the
    /// spring (m), in ascending order of contact radius.
    ///
    /// There are none beyond pull-off. At a turning point the stable and the unstable equilibrium
    /// are one; it is called unstable at a minimum and stable at a maximum. An unstable equilibrium
    /// with a contact radius below the range is left out.
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] if a stable equilibrium has a contact radius out of range;
    /// [`interp::Error::Unphysical`] if `imposed` is not finite.
    pub fn at(&self, imposed: f64) -> Result<Vec<Equilibrium>, Error> {
        self.check(imposed)?;
        if self.adhesionless() && imposed == 0.0 {
            return Ok(vec![Equilibrium {
                state: State::ORIGIN,
                stable: true,
            }]);
        }
        let mut here = Vec::new();
        for i in 0..self.sections.len() {
            let section = self.section(i, imposed)?;
            // A turning point belongs to the section that ends there.
            if section.holds(imposed) && (i == 0 || imposed != section.imposed[0]) {
                here.push(Equilibrium {
                    state: self.find(&section, imposed)?,
                    stable: section.rises,
                });
            }
        }
        Ok(here)
    }

    /// Returns the stable equilibrium at an `imposed` value that unloading from a large contact
    /// reaches: that of the largest contact radius.
    ///
    /// # Errors
    /// As [`Equilibria::at`]; [`Error::NoContact`] for a value below that of
    /// [`Equilibria::pull_off`].
    pub fn unloading(&self, imposed: f64) -> Result<State, Error> {
        self.check(imposed)?;
        if self.adhesionless() && imposed == 0.0 {
            return Ok(State::ORIGIN);
        }
        match self.section_of(Branch::Unloading, imposed)? {
            Some((_, section)) => self.find(&section, imposed),
            None => {
                let values = self.sections.iter().flat_map(|section| section.imposed);
                let least = if self.adhesionless() {
                    0.0
                } else {
                    values.fold(f64::INFINITY, f64::min)
                };
                Err(Error::NoContact {
                    name: self.control.name(),
                    value: imposed,
                    least,
                })
            }
        }
    }

    /// Returns the stable equilibrium at an `imposed` value that loading reaches after the first
    /// touch: that of the smallest contact radius.
    ///
    /// The attraction has no range, so the surfaces meet where load and penetration are 0. There
    /// the contact grows at once to `loading(0.0)`.
    ///
    /// # Errors
    /// As [`Equilibria::at`]; [`Error::NoContact`] for a negative value, at which the sphere does
    /// not touch yet.
    pub fn loading(&self, imposed: f64) -> Result<State, Error> {
        self.check(imposed)?;
        if imposed < 0.0 {
            return Err(Error::NoContact {
                name: self.control.name(),
                value: imposed,
                least: 0.0,
            });
        }
        if self.adhesionless() && imposed == 0.0 {
            return Ok(State::ORIGIN);
        }
        let first = &self.sections[0];
        let starts_in_range = first.imposed[0] <= if first.rises { imposed } else { 0.0 };
        match self.section_of(Branch::Loading, imposed)? {
            Some((_, section)) if starts_in_range => self.find(&section, imposed),
            _ => Err(self.contact.outside(self.control.name(), imposed)),
        }
    }

    /// Returns the state in which the contact finally separates on unloading: the equilibrium of
    /// the smallest imposed value.
    ///
    /// Under a flat end, the smallest contact has the radius of the end, and may be this state.
    ///
    /// Unloading follows the stable equilibria of the largest contact radius down to their end, a
    /// minimum of the imposed value. If another stable equilibrium with a smaller contact radius
    /// exists at this value, the contact jumps to it, and unloading continues from there. No
    /// equilibrium is left to jump to at the smallest of all minima.
    ///
    /// [`Equilibria::force_displacement`] gives the jumps before the separation. Without adhesion
    /// the state is [`State::ORIGIN`].
    ///
    /// # Errors
    /// [`Error::OutsideRadii`] if its contact radius is out of range.
    pub fn pull_off(&self) -> Result<State, Error> {
        if self.adhesionless() {
            return Ok(State::ORIGIN);
        }
        let [first, last] = self.ends();
        if (first.rises && !self.contact.begins_at_flat_end()) || !last.rises {
            return Err(self.contact.outside(
                "the pull-off at work of adhesion",
                self.energy.work_of_adhesion,
            ));
        }
        let stable = self.sections.iter().filter(|section| section.rises);
        let least = stable
            .min_by(|a, b| a.imposed[0].total_cmp(&b.imposed[0]))
            .unwrap_or(last);
        self.state(least.u[0])
    }

    pub(crate) fn adhesionless(&self) -> bool {
        self.energy.work_of_adhesion == 0.0
    }

    /// Returns the first and the last section.
    fn ends(&self) -> [&Section; 2] {
        [&self.sections[0], &self.sections[self.sections.len() - 1]]
    }

    /// Accepts an imposed value unless a stable equilibrium may have a contact radius out of range.
    pub(crate) fn check(&self, imposed: f64) -> Result<(), Error> {
        finite_input(self.control.name(), imposed)?;
        let [first, last] = self.ends();
        // Below the contact of a flat end there is none.
        let below = first.rises
            && imposed < first.imposed[0]
            && !self.contact.begins_at_flat_end()
            && !(self.adhesionless() && imposed <= 0.0);
        let most = self.section(self.sections.len() - 1, imposed)?.imposed[1];
        if last.rises && imposed <= most && !below {
            Ok(())
        } else {
            Err(self.contact.outside(self.control.name(), imposed))
        }
    }

    /// Returns the state at the contact radius with logarithm `u`.
    pub(crate) fn state(&self, u: f64) -> Result<State, Error> {
        let a = self.contact.radius_at(u);
        self.contact.state(a, self.energy.at(a))
    }

    /// Returns the imposed value of a state.
    pub(crate) fn imposed(&self, state: &State) -> f64 {
        self.control.imposed(state.load, state.penetration)
    }

    /// Returns the logarithm of the contact radius at which a section has an imposed value. The
    /// value must occur in the section.
    pub(crate) fn log_radius(&self, section: &Section, imposed: f64) -> Result<f64, Error> {
        root(
            |u| Ok(self.imposed(&self.state(u)?) - imposed),
            section.u[0],
            section.u[1],
        )
    }

    /// Returns the state of a section at an imposed value.
    fn find(&self, section: &Section, imposed: f64) -> Result<State, Error> {
        if self.contact.is_punch() {
            let [radius, _] = self.contact.contact_radius_range();
            let (state, _) = self.contact.state_under(self.control, imposed, radius)?;
            return Ok(state);
        }
        self.state(self.log_radius(section, imposed)?)
    }
}
