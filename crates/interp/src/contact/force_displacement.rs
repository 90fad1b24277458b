//! Loading and unloading as they go, with the jumps.

use crate::contact::equilibria::Section;
use crate::{Control, Equilibria, Error, State};

/// A sudden change of the contact, at a fixed imposed value: the load under [`Control::Load`], the
/// penetration under [`Control::Displacement`], and under [`Control::Spring`] the position of its
/// far end, so that load and penetration move on the line of slope `-k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Where stability is lost, or the surfaces meet.
    pub from: State,
    /// Where the contact, or without one the sphere, comes to rest: nowhere if it separates under a
    /// load.
    pub to: Option<State>,
}

/// Loading from the first touch and unloading until separation, infinitely slowly.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceDisplacement {
    /// Branches of stable states in order, with a jump before each one (the first is that into
    /// contact), ending at the largest imposed value.
    pub loading: Vec<Vec<State>>,
    /// Branches of stable states in order, with a jump after each one (the last is the separation).
    pub unloading: Vec<Vec<State>>,
    /// All jumps in order: as many as branches but for the turn, which is none. Without adhesion
    /// there is none at first touch and at separation, either.
    pub jumps: Vec<Jump>,
}

impl Equilibria<'_> {
    /// The whole force-displacement curve up to the imposed value `most` (load in N; penetration or
    /// position of the spring in m) and back, as branches of `points` states each, ends included,
    /// evenly spaced in contact radius.
    ///
    /// The surfaces meet at load and penetration 0, where the contact jumps to
    /// [`Equilibria::loading`] of 0. From then on it follows the stable equilibria, and where they
    /// end it jumps to the next stable equilibrium at the same imposed value: to a larger contact
    /// on loading, to a smaller one or to separation on unloading. What a contact's inertia might
    /// do beyond is not considered.
    ///
    /// Without adhesion the branches end at the smallest radius of
    /// [`Contact::contact_radius_range`](crate::Contact::contact_radius_range).
    ///
    /// # Errors
    /// Those of [`Equilibria::loading`] at `most` and at 0, those of [`Equilibria::pull_off`], and
    /// [`Error::Unphysical`] unless `points` is 2 to 1,000,000.
    ///
    /// ```
    /// # fn main() -> Result<(), interp::Error> {
    /// use interp::{Contact, Control, Elastic, HalfSpace};
    ///
    /// let system = HalfSpace { sphere_radius: 1e-3, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
    /// let contact = Contact::half_space(&system)?;
    /// let curve = contact.equilibria(0.04, Control::Displacement)?.force_displacement(1e-5, 50)?;
    /// assert_eq!((curve.loading.len(), curve.unloading.len(), curve.jumps.len()), (1, 1, 2));
    /// let apart = curve.jumps[1];
    /// assert!(apart.from.load < 0.0 && apart.to.is_some_and(|to| to.load == 0.0 && to.penetration == apart.from.penetration));
    /// # Ok(()) }
    /// ```
    pub fn force_displacement(&self, most: f64, points: usize) -> Result<ForceDisplacement, Error> {
        Error::unless(
            (2..=1_000_000).contains(&points),
            "number of points",
            points as f64,
            "2 to 1000000",
        )?;
        let u_turn = self.loading(most)?.contact_radius.ln();
        self.loading(0.0)?;
        self.pull_off()?;
        let reached: Vec<&Section> = self
            .sections
            .iter()
            .filter(|section| section.rises && section.u[0] <= u_turn)
            .collect();
        let (mut loading, mut unloading, mut jumps) = (Vec::new(), Vec::new(), Vec::new());

        // Loading goes where the imposed value is larger than ever before.
        let (mut record, mut from) = (0.0, State::ORIGIN);
        for section in &reached {
            if section.imposed[1] > record {
                let touches_at_once = self.adhesionless() && loading.is_empty();
                let start = if touches_at_once {
                    section.u[0]
                } else {
                    self.place(section, record)?
                };
                let branch = self.branch(start, section.u[1].min(u_turn), points)?;
                if !touches_at_once {
                    jumps.push(Jump {
                        from,
                        to: Some(branch[0]),
                    });
                }
                (record, from) = (section.imposed[1], branch[points - 1]);
                loading.push(branch);
            }
        }
        // Unloading goes where it is smaller than ever since.
        let mut last: Option<State> = None;
        for section in reached.iter().rev() {
            if last.is_none() || section.imposed[0] < record {
                let start = if last.is_none() {
                    u_turn
                } else {
                    self.place(section, record)?
                };
                let branch = self.branch(start, section.u[0], points)?;
                jumps.extend(last.map(|from| Jump {
                    from,
                    to: Some(branch[0]),
                }));
                (record, last) = (section.imposed[0], Some(branch[points - 1]));
                unloading.push(branch);
            }
        }
        if !self.adhesionless() {
            jumps.extend(last.map(|from| Jump {
                from,
                to: self.separated(&from),
            }));
        }
        Ok(ForceDisplacement {
            loading,
            unloading,
            jumps,
        })
    }

    /// The states between the logarithms of two contact radii.
    fn branch(&self, start: f64, end: f64, points: usize) -> Result<Vec<State>, Error> {
        let [start, end] = [start.exp(), end.exp()];
        let radius = |part: f64| (1.0 - part) * start + part * end;
        (0..points)
            .map(|i| {
                self.contact.state(
                    radius(i as f64 / (points - 1) as f64),
                    self.work_of_adhesion,
                )
            })
            .collect()
    }

    /// Where the sphere comes to rest after it has separated.
    fn separated(&self, from: &State) -> Option<State> {
        match self.control {
            Control::Load => None,
            Control::Displacement | Control::Spring { .. } => Some(State {
                penetration: self.imposed(from),
                ..State::ORIGIN
            }),
        }
    }
}
