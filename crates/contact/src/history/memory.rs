//! What the elements remember, and how a step of the time changes it.
//!
//! Within a step the penetration is a straight line of the time. An element that stays in contact follows it, one that
//! stays outside recovers, both exactly. Of the others the moment of touch or release is found.

use super::elements::Elements;
use super::exponentials::{Creep, Exponentials};
use super::moments::mean;

/// The elements at one time. The first ones are in contact.
pub(super) struct Memory {
    /// The penetration, m.
    pub penetration: f64,
    /// The number of elements in contact, and of those that have been.
    pub touching: usize,
    pub used: usize,
    /// `psi` of each element, m.
    pub psi: Vec<f64>,
    /// `N` of each element, m; 0 outside the contact.
    pub stress: Vec<f64>,
    /// In contact the memories `int exp(-rate (t-t')) d psi`, outside the amplitudes of the recovery; all elements of
    /// one rate after another.
    pub memories: Vec<f64>,
    /// At the end of the step, m: `psi` of an element outside the contact; of one in contact that at which `N` would be 0 there.
    pub free: Vec<f64>,
    /// For each element in contact the penetration (m) at the end of the step below which it, or one before it, is free.
    pub separation: Vec<f64>,
    /// For each element in contact the integral over the stiffness, from the first one to it, of the penetration at which
    /// each element loses contact, N.
    pub sums: Vec<f64>,
}

/// A step of the time.
pub(super) struct Step<'a> {
    pub recovery: &'a Creep,
    /// The length, s.
    pub length: f64,
    /// For each rate of the law the decay, and its mean, over the step.
    pub factors: Vec<[f64; 2]>,
    /// For each rate of the recovery the decay over the step.
    pub decays: Vec<f64>,
    /// `N` at the end of the step over the change of `psi`.
    pub w: f64,
}

impl<'a> Step<'a> {
    pub fn new(law: &Exponentials, recovery: &'a Creep, length: f64) -> Self {
        Self {
            recovery,
            length,
            factors: (law.rates.iter())
                .map(|rate| [(-rate * length).exp(), mean(rate * length)])
                .collect(),
            decays: recovery
                .rates
                .iter()
                .map(|rate| (-rate * length).exp())
                .collect(),
            w: rise(law, length),
        }
    }
}

/// Returns `N` over the change of `psi`, after a steady change that began a `length` (s) ago.
fn rise(law: &Exponentials, length: f64) -> f64 {
    let terms = law.weights.iter().zip(&law.rates);
    law.constant
        + law.impulse / length
        + terms
            .map(|(weight, rate)| weight * mean(rate * length))
            .sum::<f64>()
}

impl Elements<'_> {
    /// Moves all elements to the end of a step at which the penetration is known.
    pub(super) fn remember(&self, memory: &mut Memory, step: &Step<'_>, penetration: f64) {
        let (k, before, used) = (self.nodes.len(), memory.touching, memory.used);
        let (held, touching) = self.inside(memory, step, penetration);
        let now = held + touching.len();
        for i in now..before {
            self.release(memory, step, i, penetration);
        }
        for i in before..now {
            self.touch(memory, step, i, penetration);
        }
        let changes: Vec<f64> = (0..held)
            .map(|i| penetration - self.nodes[i].penetration - memory.psi[i])
            .collect();
        for ([decay, mean], own) in step.factors.iter().zip(memory.memories.chunks_exact_mut(k)) {
            for (memory, change) in own.iter_mut().zip(&changes) {
                *memory = decay * *memory + mean * change;
            }
        }
        let out = before.max(now)..used.max(now);
        for (decay, own) in step.decays.iter().zip(memory.memories.chunks_exact_mut(k)) {
            for amplitude in &mut own[out.clone()] {
                *amplitude *= decay;
            }
        }
        if !out.is_empty() {
            memory.psi[out.clone()].copy_from_slice(&memory.free[out]);
        }
        for (psi, node) in memory.psi[..now].iter_mut().zip(self.nodes) {
            *psi = penetration - node.penetration;
        }
        let terms = memory.stress.iter_mut().zip(self.nodes).zip(&memory.free);
        for ((stress, node), free) in terms.take(held) {
            *stress = step.w * (penetration - node.penetration - free);
        }
        if now < before {
            memory.stress[now..before].fill(0.0);
        } else {
            memory.stress[held..now].copy_from_slice(&touching);
        }
        memory.touching = now;
        memory.used = used.max(now);
        memory.penetration = penetration;
    }

    /// Returns the number of elements that stay in contact up to the end of a step, and the stresses of those beyond that
    /// touch within it.
    pub(super) fn inside(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        penetration: f64,
    ) -> (usize, Vec<f64>) {
        let before = memory.touching;
        let held = memory.separation[..before].partition_point(|&at| at < penetration);
        let mut touching = Vec::new();
        if held == before {
            let stresses =
                (before..self.nodes.len()).map(|i| self.stress(memory, step, i, penetration));
            touching.extend(stresses.take_while(|&stress| stress > 0.0));
        }
        (held, touching)
    }

    /// Brings an element that touches within a step to its end.
    fn touch(&self, memory: &mut Memory, step: &Step<'_>, i: usize, penetration: f64) {
        let k = self.nodes.len();
        let imposed = penetration - self.nodes[i].penetration;
        let part = self.part(memory, step, i, imposed - memory.free[i], penetration);
        let length = part * step.length;
        let own = |slot: usize| memory.memories[slot * k + i];
        let mut psi = memory.psi[i];
        let amplitudes: Vec<f64> = (step.recovery.rates.iter().enumerate())
            .map(|(j, rate)| {
                let decay = (-rate * (step.length - length)).exp();
                psi += (decay - 1.0) * own(j);
                decay * own(j)
            })
            .collect();
        let memories = step.recovery.memories(self.law, &amplitudes);
        for (j, (rate, at_touch)) in self.law.rates.iter().zip(&memories).enumerate() {
            let decay = (-rate * length).exp();
            memory.memories[j * k + i] = decay * at_touch + mean(rate * length) * (imposed - psi);
        }
    }

    /// Returns the stress, `psi` and the memories of an element that stays in contact from the begin of the step, after
    /// a part of the step; after more than the step as if it went on.
    pub(super) fn imposed(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        i: usize,
        penetration: f64,
    ) -> impl Fn(f64) -> (f64, f64, Vec<f64>) {
        let k = self.nodes.len();
        let begin = memory.psi[i];
        let change = penetration - self.nodes[i].penetration - begin;
        let at_begin: Vec<f64> = (0..self.law.len())
            .map(|j| memory.memories[j * k + i])
            .collect();
        let length = step.length;
        move |part: f64| {
            let terms = self.law.rates.iter().zip(&at_begin);
            let memories: Vec<f64> = terms
                .map(|(rate, own)| {
                    let z = rate * part * length;
                    let mean = mean(z);
                    // 1 - z mean(z) = exp(-z)
                    (1.0 - z * mean) * own + mean * part * change
                })
                .collect();
            let psi = begin + part * change;
            let terms = self.law.weights.iter().zip(&memories);
            let stress = self.law.constant * psi
                + self.law.impulse / length * change
                + terms.map(|(weight, memory)| weight * memory).sum::<f64>();
            (stress, psi, memories)
        }
    }

    /// Brings an element that is released within a step to its end.
    fn release(&self, memory: &mut Memory, step: &Step<'_>, i: usize, penetration: f64) {
        let k = self.nodes.len();
        let end = self.stress(memory, step, i, penetration).min(0.0);
        let (part, (_, psi, memories)) = {
            let after = self.imposed(memory, step, i, penetration);
            let part = crossing(|part| after(part).0, [memory.stress[i], end]);
            (part, after(part))
        };
        let recovery = step.recovery;
        let amplitudes = recovery.released(self.law, psi, &memories);
        let mut end = if self.law.constant > 0.0 {
            0.0
        } else {
            psi - amplitudes.iter().sum::<f64>()
        };
        for (j, (rate, amplitude)) in recovery.rates.iter().zip(&amplitudes).enumerate() {
            let own = (-rate * (1.0 - part) * step.length).exp() * amplitude;
            memory.memories[j * k + i] = own;
            end += own;
        }
        memory.psi[i] = end;
    }

    /// Returns the part of the step for which an element has touched that is free before it and at its end
    /// is `excess` (m) above the free one.
    fn part(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        i: usize,
        excess: f64,
        penetration: f64,
    ) -> f64 {
        let gap = (memory.psi[i] + self.nodes[i].penetration - memory.penetration).max(0.0);
        if i >= memory.used {
            return excess / (excess + gap);
        }
        let change = penetration - memory.penetration;
        let gap_at = |x: f64| {
            let amplitudes = memory.memories[i..].iter().step_by(self.nodes.len());
            let terms = step.recovery.rates.iter().zip(amplitudes);
            let recovered = terms.map(|(rate, own)| (-rate * x * step.length).exp_m1() * own);
            gap + recovered.sum::<f64>() - x * change
        };
        1.0 - crossing(gap_at, [gap, -excess]).min(1.0 - CLOSE)
    }

    /// Returns `N` (m) of an element at the end of a step. A negative one is that of the element if it did not lose
    /// contact, or `w` times the gap.
    pub(super) fn stress(
        &self,
        memory: &Memory,
        step: &Step<'_>,
        i: usize,
        penetration: f64,
    ) -> f64 {
        let excess = penetration - self.nodes[i].penetration - memory.free[i];
        if memory.stress[i] > 0.0 || excess <= 0.0 {
            return step.w * excess;
        }
        rise(
            self.law,
            self.part(memory, step, i, excess, penetration) * step.length,
        ) * excess
    }
}

/// The part of the change over a step to which a value is 0, and the shortest part of a step.
const CLOSE: f64 = 1e-7;

/// Returns where in a step a function falls to 0, from its values at the begin and the end.
fn crossing(f: impl Fn(f64) -> f64, [begin, end]: [f64; 2]) -> f64 {
    const MOST: usize = 20;
    if begin <= 0.0 {
        return 0.0;
    }
    let (mut low, mut high) = ([0.0, begin], [1.0, end]);
    let mut x = 1.0;
    // The method of Illinois: of an end that stays the value counts half.
    let mut stays = 0;
    for _ in 0..MOST {
        if high[1] >= 0.0 || low[1] <= 0.0 {
            break;
        }
        x = low[0] + (high[0] - low[0]) * low[1] / (low[1] - high[1]);
        let value = f(x);
        if value.abs() <= CLOSE * (begin - end) {
            break;
        }
        if value > 0.0 {
            low = [x, value];
            if stays == 1 {
                high[1] *= 0.5;
            }
            stays = 1;
        } else {
            high = [x, value];
            if stays == -1 {
                low[1] *= 0.5;
            }
            stays = -1;
        }
    }
    x
}
