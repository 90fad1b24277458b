//! Any history: independent viscoelastic elements, one for each radius.
//!
//! The stress of a contact is a sum of flat punches of all smaller radii `s`. Each obeys a law of
//! its own,
//!
//! ```text
//! N(s, t) = int phi(t-t') d psi(s, t')
//! psi = delta(t) - delta0(s) inside the contact, and creeps back at N = 0 outside
//! F = int_0^a N dS(s)
//! ```
//!
//! A step of the time sets `psi = max(psi_free, delta - delta0(s))` with the `psi_free` at which
//! `N = 0`. Under a penetration the error falls with the square of the distance of the radii, and hardly depends on the
//! steps of the time; under a load or a spring it falls with the square of both.

use super::elastic::Node;
use super::exponentials::Exponentials;
use super::memory::{Memory, Step};
use super::program::Instant;
use super::{Phase, TimedContact};
use crate::{Control, Error, State};

/// The radii of the elements: from the first touch, with penetrations and stiffnesses of the elastic
/// contact.
pub(super) struct Elements<'a> {
    pub nodes: &'a [Node],
    pub law: &'a Exponentials,
    pub control: Control,
}

/// The part of the largest penetration by which a ring outside the contact may be too deep from rounding.
const RING: f64 = 1e-6;
/// For a load or a spring: the change of the penetration, relative to it, at which Newton's method ends, and its most steps.
const CLOSE: f64 = 1e-12;
const NEWTON: usize = 60;
/// The longest step of a run without refinement, in parts of the duration.
pub(super) const LONGEST: f64 = 0.02;

impl Elements<'_> {
    /// Follows the program in steps of at most [`LONGEST`] times the duration, each divided into
    /// `refined` parts. Returns the states at the instants and the largest contact radius.
    pub fn follow(
        &self,
        instants: &[Instant],
        refined: usize,
    ) -> Result<(Vec<TimedContact>, f64), Error> {
        let recovery = self.law.creep();
        let k = self.nodes.len();
        let slots = self.law.len().max(recovery.rates.len());
        let mut now = instants[0].apart(self.control);
        let mut memory = Memory {
            penetration: now.state.penetration,
            touching: 0,
            used: 0,
            psi: vec![0.0; k],
            stress: vec![0.0; k],
            memories: vec![0.0; k * slots],
            free: vec![0.0; k],
            separation: vec![0.0; k],
            sums: vec![0.0; k],
        };
        let mut states = Vec::with_capacity(instants.len());
        states.push(now);
        let mut largest: f64 = 0.0;
        let duration = instants[instants.len() - 1].time - now.time;
        for pair in instants.windows(2) {
            let (from, at) = (&pair[0], &pair[1]);
            let whole = at.time - from.time;
            // A whole number of steps is one in other units, too.
            let parts = (whole / (LONGEST * duration) - 1e-9).ceil().max(1.0) as usize * refined;
            let step = Step::new(self.law, &recovery, whole / parts as f64);
            for part in 1..=parts {
                let x = part as f64 / parts as f64;
                let value = from.value + (at.value - from.value) * x;
                let time = if part == parts {
                    at.time
                } else {
                    from.time + whole * x
                };
                let before = now.state.contact_radius;
                now = self.take(&mut memory, &step, time, value)?;
                let radius = now.state.contact_radius;
                largest = largest.max(radius);
                now.phase = match () {
                    () if radius == 0.0 => Phase::Separated,
                    () if radius > before * (1.0 + 1e-12) => Phase::Advancing,
                    () if radius < before * (1.0 - 1e-12) => Phase::Receding,
                    () => Phase::Resting,
                };
            }
            states.push(now);
        }
        Ok((states, largest))
    }

    /// Takes a step to a time.
    fn take(
        &self,
        memory: &mut Memory,
        step: &Step<'_>,
        time: f64,
        value: f64,
    ) -> Result<TimedContact, Error> {
        let (k, n, used) = (self.nodes.len(), memory.touching, memory.used);
        let mut left = vec![0.0; n];
        for (left, psi) in left.iter_mut().zip(&memory.psi) {
            *left = self.law.constant * psi;
        }
        let terms = self.law.weights.iter().zip(&step.factors);
        for ((weight, [e, _]), own) in terms.zip(memory.memories.chunks_exact(k)) {
            let factor = weight * e;
            for (left, memory) in left.iter_mut().zip(own) {
                *left += factor * memory;
            }
        }
        for ((free, psi), left) in memory.free.iter_mut().zip(&memory.psi).zip(&left) {
            *free = psi - left / step.w;
        }
        memory.free[n..used].copy_from_slice(&memory.psi[n..used]);
        for (decay, own) in step.decays.iter().zip(memory.memories.chunks_exact(k)) {
            for (free, amplitude) in memory.free[n..used].iter_mut().zip(&own[n..used]) {
                *free += (decay - 1.0) * amplitude;
            }
        }
        self.sum(memory);
        let penetration = match self.control {
            Control::Displacement => value,
            Control::Load => self.balance(memory, step, |load, _| (load - value, 0.0))?,
            Control::Spring { stiffness } => self.balance(memory, step, |load, penetration| {
                (penetration + load / stiffness - value, 1.0)
            })?,
        };
        let (load, _, contact_radius) = self.load(memory, step, penetration);
        let touch = memory.free[0] + self.nodes[0].penetration;
        self.check_disc(memory, penetration, contact_radius, time)?;
        self.remember(memory, step, penetration);
        let load = match self.control {
            Control::Load if value > 0.0 => value,
            Control::Load => 0.0,
            _ => load,
        };
        let contact_radius = if penetration > touch {
            contact_radius
        } else {
            0.0
        };
        Ok(TimedContact {
            time,
            phase: Phase::Resting,
            state: State {
                contact_radius,
                load,
                penetration,
            },
        })
    }

    /// Prepares the load of the elements in contact, whose stresses rise in proportion to the penetration.
    fn sum(&self, memory: &mut Memory) {
        let (mut largest, mut sum) = (f64::NEG_INFINITY, 0.0);
        for i in 0..memory.touching {
            let at = |i: usize| self.nodes[i].penetration + memory.free[i];
            largest = at(i).max(largest);
            memory.separation[i] = largest;
            memory.sums[i] = sum;
            if i + 1 < memory.touching {
                let rise = self.nodes[i + 1].stiffness - self.nodes[i].stiffness;
                sum += 0.5 * rise * (at(i) + at(i + 1));
            }
        }
    }

    /// Finds the penetration at which a rising function of load and penetration is 0. The function
    /// returns its value, and its slope with the penetration at a fixed load; its slope with the
    /// load is that of `imposed`.
    fn balance(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        f: impl Fn(f64, f64) -> (f64, f64),
    ) -> Result<f64, Error> {
        let touch = memory.free[0] + self.nodes[0].penetration;
        let of = |x: f64| {
            let (load, stiffness, _) = self.load(memory, step, x);
            let (value, direct) = f(load, x);
            (value, direct + stiffness * self.control.imposed(1.0, 0.0))
        };
        // Without contact.
        let (value, direct) = f(0.0, touch);
        if value >= 0.0 {
            return Ok(if direct > 0.0 { touch - value } else { touch });
        }
        // The load is a convex function of the penetration.
        let mut low = touch;
        let mut high = f64::INFINITY;
        let mut x = memory.penetration.max(touch);
        for _ in 0..NEWTON {
            let (value, slope) = of(x);
            if value == 0.0 {
                break;
            }
            *if value < 0.0 { &mut low } else { &mut high } = x;
            let mut next = x - value / slope;
            if !(next > low && next < high) {
                next = if high.is_finite() {
                    0.5 * (low + high)
                } else {
                    low + 2.0
                        * (low - touch)
                            .abs()
                            .max(1e-3 * self.nodes[self.nodes.len() - 1].penetration)
                };
            }
            let change = (next - x).abs();
            x = next;
            if change <= CLOSE * x.abs() {
                break;
            }
        }
        Ok(x)
    }

    /// Refuses a ring in contact outside the contact.
    fn check_disc(
        &self,
        memory: &Memory,
        penetration: f64,
        radius: f64,
        time: f64,
    ) -> Result<(), Error> {
        let largest = self.nodes[self.nodes.len() - 1].penetration;
        let first = self.nodes.partition_point(|node| node.radius <= radius);
        for (node, free) in self.nodes.iter().zip(&memory.free).skip(first) {
            let excess = penetration - node.penetration - free;
            if excess > RING * largest {
                return Err(Error::NotOneDisc {
                    time,
                    radius: node.radius,
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::elastic::elements;
    use crate::history::program::Program;
    use crate::{Contact, Relaxation};
    use interp::{Elastic, HalfSpace, Probe, Profile};

    /// Halved distances of the radii, and under a load halved steps, leave a quarter of the error.
    #[test]
    fn the_error_is_of_second_order() {
        let system = HalfSpace {
            probe: Probe::Paraboloid { radius: 1.0 },
            sphere_modulus: f64::INFINITY,
            solid: Elastic::new(1.0, 0.5).expect("a solid"),
        };
        let contact = Contact::half_space(&system).expect("a contact");
        let law = Relaxation::Prony {
            relaxed: 0.3,
            terms: vec![[0.7, 0.6]],
        };
        let times: Vec<f64> = (0..=30).map(|i| 0.1 * f64::from(i)).collect();
        let programs = [
            (
                Control::Displacement,
                vec![(0.0, 0.0), (1.0, 1e-2), (3.0, 0.0)],
            ),
            (Control::Load, vec![(0.0, 0.0), (1.0, 1e-4), (3.0, 2e-4)]),
        ];
        for (control, points) in programs {
            let history = contact.history(&law).expect("a law");
            let exact = history
                .at(control, &points, &times, Some(1e-10))
                .expect("within reach")
                .states;
            let largest =
                |of: fn(&State) -> f64| exact.iter().map(|at| of(&at.state)).fold(0.0, f64::max);
            let program = Program::new(control.name(), &points, &times).expect("a program");
            let instants = program.with(&times);
            let sum = Exponentials::new(&law, [0.1, 3.0], 1e-10);
            let errors = [1, 2, 4, 8].map(|refined| {
                let most = 1.1 * largest(|state| state.contact_radius);
                let nodes = elements(&contact, most, refined).expect("within reach");
                let elements = Elements {
                    nodes: &nodes,
                    law: &sum,
                    control,
                };
                let (states, _) = elements.follow(&instants, refined).expect("a course");
                let error = |of: fn(&State) -> f64| {
                    let pairs = states.iter().zip(&exact);
                    pairs
                        .map(|(a, b)| (of(&a.state) - of(&b.state)).abs())
                        .fold(0.0, f64::max)
                        / largest(of)
                };
                match control {
                    Control::Load => error(|state| state.penetration),
                    _ => error(|state| state.load),
                }
            });
            println!("{control:?}: {errors:?}");
            for pair in errors.windows(2) {
                assert!(pair[0] > 3.0 * pair[1], "{control:?}: {errors:?}");
            }
            assert!(errors[3] < 1e-5, "{control:?}: {errors:?}");
        }
    }

    /// Until its second growth a contact is that of one turn, which integrals follow.
    #[test]
    fn a_flat_end_is_followed_as_by_integrals() {
        let points: Vec<[f64; 2]> = (0..30)
            .map(|i| 1e-7 * f64::from(i))
            .map(|r| [r, 1e6 * (r - 1e-6).max(0.0).powi(2)])
            .collect();
        let cone = Probe::FlatEndedCone {
            radius: 1e-6,
            half_angle: 1.2,
        };
        follows_integrals(cone, 1e-6);
        let profile = Profile::new(&points).expect("convex");
        follows_integrals(Probe::Profile(profile), 1e-5);
    }

    fn follows_integrals(probe: Probe, tolerance: f64) {
        let system = HalfSpace {
            probe,
            sphere_modulus: f64::INFINITY,
            solid: Elastic::new(1e4, 0.45).expect("a solid"),
        };
        let contact = Contact::half_space(&system).expect("a contact");
        let law = Relaxation::Prony {
            relaxed: 0.3,
            terms: vec![[0.7, 0.3]],
        };
        let history = contact.history(&law).expect("a law");
        let mut points = vec![(0.0, 0.0), (1.0, 3e-7), (1.5, 1.5e-7), (2.0, 3e-7)];
        let times: Vec<f64> = (0..=30).map(|i| 0.05 * f64::from(i)).collect();
        let loads = |points: &[(f64, f64)], tolerance: f64| -> Vec<f64> {
            let course = history.at(Control::Displacement, points, &times, Some(tolerance));
            let states = course.expect("within reach").states;
            states.iter().map(|at| at.state.load).collect()
        };
        let by_elements = loads(&points, tolerance);
        points.pop();
        let exact = loads(&points, 1e-10);
        let largest = exact.iter().copied().fold(0.0, f64::max);
        for (found, exact) in by_elements.iter().zip(&exact) {
            let error = (found - exact).abs() / largest;
            assert!(error < tolerance, "{found}, not {exact}");
        }
    }
}
