//! Whole force-displacement curves: loading and unloading, with the jumps.

use crate::Error;
use crate::{Control, Equilibria, State};
use interp::check::number_of_points;

/// A sudden change of the contact at a fixed imposed value.
///
/// The load is fixed under [`Control::Load`], the penetration under [`Control::Displacement`].
/// Under [`Control::Spring`] the position of the far end is fixed, so that load and penetration
/// move along a line of slope `-k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// The state in which stability is lost, or in which the surfaces meet.
    pub from: State,
    /// The state in which the contact, or the separated sphere, comes to rest. `None` if the
    /// contact separates under a load, where the sphere does not come to rest.
    pub to: Option<State>,
}

/// Infinitely slow loading from the first touch, and unloading until separation.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceDisplacement {
    /// The branches of stable states in order, up to the largest imposed value. A jump precedes
    /// each branch; the first jump is that into contact.
    pub loading: Vec<Vec<State>>,
    /// The branches of stable states in order, down to separation. A jump follows each branch; the
    /// last jump is the separation.
    pub unloading: Vec<Vec<State>>,
    /// All jumps in order: one for each branch. Without adhesion there is no jump at first touch
    /// and none at separation.
    pub jumps: Vec<Jump>,
}

impl Equilibria<'_> {
    /// Computes the force-displacement curve from first touch to the imposed value `most` (load in
    /// N; penetration or position of the spring in m) and back.
    ///
    /// Each branch consists of `points` states, ends included, evenly spaced in contact radius.
    ///
    /// The surfaces meet at load and penetration 0, where the contact jumps to
    /// [`Equilibria::loading`] of 0. From then on it follows the stable equilibria. Where they end,
    /// it jumps to the next stable equilibrium at this imposed value: to a larger contact on
    /// loading, to a smaller one or to separation on unloading. Inertia, which might carry the
    /// contact further, is not considered.
    ///
    /// Without adhesion the branches end at the smallest radius of
    /// [`Contact::contact_radius_range`](crate::Contact::contact_radius_range).
    ///
    /// # Errors
    /// As [`Equilibria::loading`] at `most` and at 0, and as [`Equilibria::pull_off`];
    /// [`interp::Error::InvalidArgument`] unless `points` is 2 to 1,000,000.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// use interp::{Elastic, HalfSpace, Probe};
    /// use contact::{Contact, Control};
    ///
    /// let system = HalfSpace { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
    /// let contact = Contact::half_space(&system)?;
    /// let curve = contact.equilibria(0.04, Control::Displacement)?.force_displacement(1e-5, 50)?;
    /// assert_eq!((curve.loading.len(), curve.unloading.len(), curve.jumps.len()), (1, 1, 2));
    /// let apart = curve.jumps[1];
    /// assert!(apart.from.load < 0.0 && apart.to.is_some_and(|to| to.load == 0.0 && to.penetration == apart.from.penetration));
    /// # Ok(()) }
    /// ```
    pub fn force_displacement(&self, most: f64, points: usize) -> Result<ForceDisplacement, Error> {
        number_of_points(points)?;
        if self.contact.is_punch() {
            return self.of_punch(most, points);
        }
        let u_turn = self.loading(most)?.contact_radius.ln();
        self.loading(0.0)?;
        self.pull_off()?;
        let mut reached = Vec::new();
        for number in 0..self.sections.len() {
            let section = self.section(number, most)?;
            if section.rises && section.u[0] <= u_turn {
                reached.push(section);
            }
        }
        let (mut loading, mut unloading, mut jumps) = (Vec::new(), Vec::new(), Vec::new());

        // A section adds a branch to loading where its imposed value exceeds all before it.
        let (mut extreme, mut from) = (0.0, State::ORIGIN);
        for section in &reached {
            if section.imposed[1] > extreme {
                let touches_at_once = self.adhesionless() && loading.is_empty();
                let start = if touches_at_once {
                    section.u[0]
                } else {
                    self.log_radius(section, extreme)?
                };
                let branch = self.states_between(start, section.u[1].min(u_turn), points)?;
                if !touches_at_once {
                    jumps.push(Jump {
                        from,
                        to: Some(branch[0]),
                    });
                }
                (extreme, from) = (section.imposed[1], branch[points - 1]);
                loading.push(branch);
            }
        }
        // A section adds a branch to unloading where its imposed value is below all since the turn.
        let mut last: Option<State> = None;
        for section in reached.iter().rev() {
            if last.is_none() || section.imposed[0] < extreme {
                let start = if last.is_none() {
                    u_turn
                } else {
                    self.log_radius(section, extreme)?
                };
                let branch = self.states_between(start, section.u[0], points)?;
                jumps.extend(last.map(|from| Jump {
                    from,
                    to: Some(branch[0]),
                }));
                (extreme, last) = (section.imposed[0], Some(branch[points - 1]));
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

    /// Returns the curve of a flat punch, with states evenly spaced in the imposed value.
    fn of_punch(&self, most: f64, points: usize) -> Result<ForceDisplacement, Error> {
        self.loading(most)?;
        let apart = self.pull_off()?;
        let first_between = |from: f64, to: f64, count: usize| -> Result<Vec<State>, Error> {
            let part = |i: usize| i as f64 / (points - 1) as f64;
            (0..count)
                .map(|i| self.unloading((1.0 - part(i)) * from + part(i) * to))
                .collect()
        };
        let loading = first_between(0.0, most, points)?;
        // Rounding may put the value of the pull-off beyond the last equilibrium.
        let mut unloading = first_between(most, self.imposed(&apart), points - 1)?;
        unloading.push(apart);
        let jumps = if self.adhesionless() {
            Vec::new()
        } else {
            let touch = Jump {
                from: State::ORIGIN,
                to: Some(loading[0]),
            };
            let separation = Jump {
                from: apart,
                to: self.separated(&apart),
            };
            vec![touch, separation]
        };
        Ok(ForceDisplacement {
            loading: vec![loading],
            unloading: vec![unloading],
            jumps,
        })
    }

    /// Returns `points` states between the contact radii with logarithms `start` and `end`.
    fn states_between(&self, start: f64, end: f64, points: usize) -> Result<Vec<State>, Error> {
        let [start, end] = [start, end].map(|u| self.contact.radius_at(u));
        let part = |i: usize| i as f64 / (points - 1) as f64;
        let radius = |i: usize| (1.0 - part(i)) * start + part(i) * end;
        (0..points)
            .map(|i| self.contact.state(radius(i), self.energy.at(radius(i))))
            .collect()
    }

    /// Returns the state in which the sphere comes to rest after it has separated in state `from`.
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
