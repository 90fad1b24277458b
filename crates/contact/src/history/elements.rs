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
//! `N = 0`. The error falls with the square of the steps of time and radius.

use super::elastic::Node;
use super::exponentials::Exponentials;
use super::moments::mean;
use super::program::Program;
use super::{HistoryError, Phase, TimedContact};
use crate::{Control, State};

/// The radii of the elements: from the first touch, with penetrations and stiffnesses of the elastic
/// contact.
pub(super) struct Elements<'a> {
    pub nodes: &'a [Node],
    pub law: &'a Exponentials,
    pub control: Control,
}

/// The elements at one time.
struct Memory {
    /// `psi` of each element, m.
    psi: Vec<f64>,
    /// The memories `int exp(-rate (t-t')) d psi`, all elements of one rate after another.
    memories: Vec<f64>,
    /// `psi` at which the element would be free, m.
    free: Vec<f64>,
}

/// The largest part of the largest stress that a ring outside the contact may have from rounding.
const RING: f64 = 1e-6;
/// The most steps of Newton's method for a load or a spring.
const NEWTON: usize = 60;

impl Elements<'_> {
    /// Follows the program in steps of at most `longest` times the duration, each divided into
    /// `refined` parts. Returns the states at the times asked for and the largest contact radius.
    pub fn follow(
        &self,
        program: &Program,
        asked: &[f64],
        longest: f64,
        refined: usize,
    ) -> Result<(Vec<TimedContact>, f64), HistoryError> {
        let all = program.with(asked);
        let (k, m) = (self.nodes.len(), self.law.len());
        let mut memory = Memory {
            psi: vec![0.0; k],
            memories: vec![0.0; k * m],
            free: vec![0.0; k],
        };
        let mut wanted = asked.iter().copied().peekable();
        let mut states: Vec<TimedContact> = Vec::with_capacity(asked.len());
        let mut now = self.at_rest(all[0].time, all[0].value);
        let mut largest: f64 = 0.0;
        while wanted.next_if_eq(&now.time).is_some() {
            states.push(now);
        }
        for pair in all.windows(2) {
            let (from, at) = (&pair[0], &pair[1]);
            let whole = at.time - from.time;
            // A whole number of steps is one in other units, too.
            let parts = (whole / (longest * program.duration()) - 1e-9)
                .ceil()
                .max(1.0) as usize
                * refined;
            let h = whole / parts as f64;
            let factors: Vec<[f64; 2]> = self
                .law
                .rates
                .iter()
                .map(|rate| [(-rate * h).exp(), mean(rate * h)])
                .collect();
            let terms = self.law.weights.iter().zip(&factors);
            let w = self.law.constant
                + self.law.impulse / h
                + terms.map(|(weight, [_, mean])| weight * mean).sum::<f64>();
            for part in 1..=parts {
                let x = part as f64 / parts as f64;
                let value = from.value + (at.value - from.value) * x;
                let time = if part == parts {
                    at.time
                } else {
                    from.time + whole * x
                };
                let before = now.state.contact_radius;
                now = self.step(&mut memory, time, value, w, &factors, now.state.penetration)?;
                let radius = now.state.contact_radius;
                largest = largest.max(radius);
                now.phase = match () {
                    () if radius == 0.0 => Phase::Separated,
                    () if radius > before * (1.0 + 1e-12) => Phase::Advancing,
                    () if radius < before * (1.0 - 1e-12) => Phase::Receding,
                    () => Phase::Resting,
                };
            }
            while wanted.next_if_eq(&at.time).is_some() {
                states.push(now);
            }
        }
        Ok((states, largest))
    }

    /// Returns the state before the first touch.
    fn at_rest(&self, time: f64, value: f64) -> TimedContact {
        let penetration = if matches!(self.control, Control::Load) {
            0.0
        } else {
            value
        };
        TimedContact::separated(time, penetration)
    }

    /// Takes a step to a time.
    fn step(
        &self,
        memory: &mut Memory,
        time: f64,
        value: f64,
        w: f64,
        factors: &[[f64; 2]],
        guess: f64,
    ) -> Result<TimedContact, HistoryError> {
        let k = self.nodes.len();
        for (free, psi) in memory.free.iter_mut().zip(&memory.psi) {
            *free = self.law.constant * psi;
        }
        for ((weight, [e, _]), own) in self
            .law
            .weights
            .iter()
            .zip(factors)
            .zip(memory.memories.chunks_exact_mut(k))
        {
            for (memory, free) in own.iter_mut().zip(&mut memory.free) {
                *memory *= e;
                *free += weight * *memory;
            }
        }
        for (free, psi) in memory.free.iter_mut().zip(&memory.psi) {
            *free = psi - *free / w;
        }
        let penetration = match self.control {
            Control::Displacement => value,
            Control::Load => self.balance(&memory.free, w, guess, |load, _| (load - value, 0.0))?,
            Control::Spring { stiffness } => {
                self.balance(&memory.free, w, guess, |load, penetration| {
                    (penetration + load / stiffness - value, 1.0)
                })?
            }
        };
        let (load, _, contact_radius) = self.load(&memory.free, w, penetration);
        let touch = memory.free[0] + self.nodes[0].penetration;
        self.check_disc(&memory.free, w, penetration, contact_radius, time)?;
        for i in 0..k {
            let psi = memory.free[i].max(penetration - self.nodes[i].penetration);
            let change = psi - memory.psi[i];
            memory.psi[i] = psi;
            for ([_, mean], own) in factors.iter().zip(memory.memories.chunks_exact_mut(k)) {
                own[i] += mean * change;
            }
        }
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

    /// Returns load (N), stiffness `w S(a)` (N/m) and contact radius (m) at a penetration (m).
    fn load(&self, free: &[f64], w: f64, penetration: f64) -> (f64, f64, f64) {
        let force = |i: usize| w * (penetration - self.nodes[i].penetration - free[i]);
        let mut here = force(0);
        if here <= 0.0 {
            return (0.0, 0.0, 0.0);
        }
        // Below the radius of a flat end all elements are one.
        let mut load = here * self.nodes[0].stiffness;
        for (i, pair) in self.nodes.windows(2).enumerate() {
            let next = force(i + 1);
            let rise = pair[1].stiffness - pair[0].stiffness;
            if next <= 0.0 {
                let part = here / (here - next);
                load += 0.5 * here * part * rise;
                let radius = pair[0].radius + part * (pair[1].radius - pair[0].radius);
                return (load, w * (pair[0].stiffness + part * rise), radius);
            }
            load += 0.5 * (here + next) * rise;
            here = next;
        }
        let last = self.nodes[self.nodes.len() - 1];
        (load, w * last.stiffness, last.radius)
    }

    /// Finds the penetration at which a rising function of load and penetration is 0. The function
    /// returns its value, and its slope with the penetration at a fixed load; its slope with the
    /// load is that of `imposed`.
    fn balance(
        &self,
        free: &[f64],
        w: f64,
        guess: f64,
        f: impl Fn(f64, f64) -> (f64, f64),
    ) -> Result<f64, HistoryError> {
        let touch = free[0] + self.nodes[0].penetration;
        let of = |x: f64| {
            let (load, stiffness, _) = self.load(free, w, x);
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
        let mut x = guess.max(touch);
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
            if change <= 1e-14 * x.abs() {
                break;
            }
        }
        Ok(x)
    }

    /// Refuses a ring in contact outside the contact.
    fn check_disc(
        &self,
        free: &[f64],
        w: f64,
        penetration: f64,
        radius: f64,
        time: f64,
    ) -> Result<(), HistoryError> {
        let largest = self.nodes[self.nodes.len() - 1].penetration;
        let outside = self
            .nodes
            .iter()
            .zip(free)
            .filter(|(node, _)| node.radius > radius);
        for (node, free) in outside {
            if w * (penetration - node.penetration - free) > RING * w * largest {
                return Err(HistoryError::NotOneDisc {
                    time,
                    radius: node.radius,
                });
            }
        }
        Ok(())
    }
}
