//! The steps up to the turn of a penetration, or of the position of a spring, that grows, may be held, and falls: Lee
//! and Radok's and Ting's integrals on any elastic contact.
//!
//! ```text
//! advancing, held:  F = int_0^t phi(t-t') dF_el(delta(t'))          a = a_el(delta)
//! receding:         D(t1, t) = int_t1^t phi(t-t') d delta(t') = -d(a1),   a1 = a_el(delta(t1))
//!                   F = int_0^t1 phi(t-t') dF_el(delta(t')) - S(a1) d(a1)
//! ```
//!
//! `d` is the flat-punch penetration of the adhesion, 0 without one. The contact rests at its largest
//! radius while `D` is above `-d`, with `D` in place of `-d` in the load.
//!
//! Both integrals are sums of exponentials, with one memory for each at every point of the
//! approach. A step of the approach lies on one piece of the elastic curve, whose load is a cubic
//! polynomial of the penetration, and so of the time: its integral has a closed form.

use super::exponentials::Exponentials;
use super::moments::{moments, slopes};
use super::setting::Setting;
use super::{Phase, TimedContact};
use crate::{Derivatives, Error, State};

/// A place of a program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub time: f64,
    pub value: f64,
    /// The number of the point, if it is one.
    pub point: Option<usize>,
}

/// A point of the approach.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Passed {
    pub time: f64,
    pub penetration: f64,
    /// The elastic load and stiffness.
    pub load: f64,
    pub stiffness: f64,
    /// The slope of the stiffness.
    pub bend: f64,
}

/// The approach so far, with the memories of all exponentials at each of its points.
pub(super) struct Approach<'a> {
    pub setting: &'a Setting<'a>,
    pub passed: Vec<Passed>,
    /// The integrals of `exp(-rate (t-t'))` over the elastic load and the penetration.
    pub loads: Vec<f64>,
    pub lengths: Vec<f64>,
    /// For each derivative `A` and its integrals, and under a spring the derivative of the
    /// penetration and its integrals; derivatives of one exponential one after another.
    pub totals: Vec<f64>,
    pub of_totals: Vec<f64>,
    pub moved: Vec<f64>,
    pub of_moved: Vec<f64>,
    /// The number of the point of the first touch.
    pub touch: usize,
    step: Step,
}

/// Steps whose lengths differ by less, relatively, are of one length: the rounding of times.
const SAME: f64 = 1e-11;

/// The factors of one length of a step.
pub(super) struct Step {
    h: f64,
    pub factors: Vec<(f64, [f64; 3])>,
}

impl Step {
    pub fn new() -> Self {
        Self {
            h: 0.0,
            factors: Vec::new(),
        }
    }

    /// Changes the length of the step if it differs by more than rounding.
    pub fn set(&mut self, h: f64, law: &Exponentials) {
        if (h - self.h).abs() > SAME * h {
            self.h = h;
            self.factors.clear();
            self.factors
                .extend(law.rates.iter().map(|rate| moments(rate * h)));
        }
    }
}

/// The most steps of Newton's method for a spring, and the change of the penetration, in parts of the step, at
/// which the next one would be below rounding.
const NEWTON: usize = 60;
const CONVERGED: f64 = 1e-9;

impl Passed {
    /// Returns the [`slopes`] of the elastic load on a step from here.
    pub fn slopes_to(&self, to: &Self) -> [f64; 3] {
        let load = |at: &Self| (at.load, at.stiffness);
        slopes(load(self), load(to), to.penetration - self.penetration)
    }
}

impl<'a> Approach<'a> {
    /// Begins at the first place, without a contact.
    /// There is room for all of so many `places`, of which the approach takes the first.
    pub fn new(setting: &'a Setting<'a>, first: &Place, places: usize) -> Self {
        let (m, width) = (setting.law.len(), setting.width);
        let spring = setting.compliance > 0.0;
        let zeros = |count: usize| {
            let mut zeros = Vec::with_capacity(count * places);
            zeros.resize(count, 0.0);
            zeros
        };
        let mut own = Self {
            setting,
            passed: Vec::with_capacity(places),
            loads: zeros(m),
            lengths: zeros(m),
            totals: zeros(width),
            of_totals: zeros(width * m),
            moved: Vec::new(),
            of_moved: zeros(if spring { width * m } else { 0 }),
            touch: 0,
            step: Step::new(),
        };
        // A flat end has a stiffness at the first touch.
        own.passed.push(own.at(first.time, first.value));
        if width > 0 {
            own.moved.resize(width, 0.0);
            own.moved[0] = 1.0;
        }
        own
    }

    /// Returns the elastic contact at a penetration.
    pub fn at(&self, time: f64, penetration: f64) -> Passed {
        let curve = &self.setting.curve;
        let piece = curve.piece(penetration.max(0.0));
        let (load, stiffness) = curve.load(piece, penetration);
        Passed {
            time,
            penetration,
            load,
            stiffness,
            bend: curve.bend(piece, penetration),
        }
    }

    /// Takes a step; `None` where the penetration falls. Writes the derivatives of the load.
    pub fn advance(
        &mut self,
        place: &Place,
        by: &mut [f64],
    ) -> Result<Option<TimedContact>, Error> {
        let setting = self.setting;
        let law = &setting.law;
        let (m, old) = (law.len(), self.loads.len() - law.len());
        let from = self.passed[self.passed.len() - 1];
        let h = place.time - from.time;
        self.step.set(h, law);
        // The memories and moments that every penetration at the end of the step has in common.
        let (mut before, mut sums) = (0.0, [0.0; 3]);
        for (k, (e, integrals)) in self.step.factors.iter().enumerate() {
            before += law.weights[k] * e * self.loads[old + k];
            for (sum, integral) in sums.iter_mut().zip(integrals) {
                *sum += law.weights[k] * integral;
            }
        }
        let load_at = |to: &Passed| {
            if to.penetration <= 0.0 {
                return 0.0;
            }
            let slopes = from.slopes_to(to);
            let rise = to.penetration - from.penetration;
            let last: f64 = slopes
                .iter()
                .zip(sums)
                .map(|(slope, sum)| slope * sum)
                .sum();
            let speed = rise / h;
            let at_once =
                (law.impulse * to.stiffness - law.second_impulse * to.bend * speed) * speed;
            law.constant * to.load + before + last + at_once
        };
        let mean = law.constant + sums[0] + law.impulse / h;
        let Some(to) = self.end_of_step(place, &from, mean, &load_at) else {
            return Ok(None);
        };
        let load = load_at(&to);
        let slopes = if to.penetration > 0.0 {
            from.slopes_to(&to)
        } else {
            [0.0; 3]
        };
        let rise = to.penetration - from.penetration;
        for (k, (e, [i0, i1, i2])) in self.step.factors.iter().enumerate() {
            let length = e * self.lengths[old + k] + rise * i0;
            let own = e * self.loads[old + k] + slopes[0] * i0 + slopes[1] * i1 + slopes[2] * i2;
            self.loads.push(own);
            self.lengths.push(length);
        }
        self.passed.push(to);
        if to.penetration <= 0.0 {
            self.touch = self.passed.len() - 1;
        }
        let radius = setting.curve.radius(to.penetration);
        if setting.width > 0 {
            self.differentiate(radius, load, (h, mean), by)?;
        }
        debug_assert_eq!(self.loads.len(), m * self.passed.len());
        let phase = match () {
            () if to.penetration <= 0.0 => {
                return Ok(Some(TimedContact::separated(to.time, to.penetration)));
            }
            () if rise > 0.0 => Phase::Advancing,
            () => Phase::Resting,
        };
        Ok(Some(TimedContact {
            time: to.time,
            phase,
            state: State {
                contact_radius: radius,
                load,
                penetration: to.penetration,
            },
        }))
    }

    /// Returns the elastic contact at the end of a step; `None` where the penetration falls.
    fn end_of_step(
        &self,
        place: &Place,
        from: &Passed,
        mean: f64,
        load_at: &impl Fn(&Passed) -> f64,
    ) -> Option<Passed> {
        let compliance = self.setting.compliance;
        let imposed = place.value;
        let begin = from.penetration;
        if compliance == 0.0 || imposed <= 0.0 {
            return (imposed >= begin).then(|| self.at(place.time, imposed));
        }
        let excess = |to: &Passed| to.penetration + compliance * load_at(to) - imposed;
        let least = self.at(place.time, begin.max(0.0));
        let at_least = excess(&least);
        if at_least > 0.0 {
            // The position of the base is held to its rounding.
            let slack = CONVERGED * imposed;
            return (at_least <= slack).then_some(least);
        }
        let most = imposed.min(self.setting.curve.last().penetration);
        let (mut low, mut high) = (least.penetration, most);
        let mut to = least;
        let mut excess_at = at_least;
        for _ in 0..NEWTON {
            let slope = 1.0 + compliance * mean * to.stiffness;
            let newton = to.penetration - excess_at / slope;
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let change = (next - to.penetration).abs();
            to = self.at(place.time, next);
            excess_at = excess(&to);
            *if excess_at < 0.0 { &mut low } else { &mut high } = next;
            if change <= CONVERGED * (most - least.penetration) || excess_at == 0.0 {
                break;
            }
        }
        Some(to)
    }

    /// Adds the derivatives of the last point, and writes those of its load.
    fn differentiate(
        &mut self,
        radius: f64,
        load: f64,
        (h, mean): (f64, f64),
        by: &mut [f64],
    ) -> Result<(), Error> {
        let setting = self.setting;
        let (law, m, width) = (&setting.law, setting.law.len(), setting.width);
        let to = self.passed[self.passed.len() - 1];
        let last = self.totals.len() - width;
        let spring = setting.compliance > 0.0;
        // The derivatives of the elastic load at this penetration.
        let mut elastic = vec![0.0; width];
        if radius > 0.0 && !setting.inputs.is_empty() {
            let mut of_inputs = vec![Derivatives::ZERO; setting.inputs.len()];
            let contact = setting.contact;
            contact.derivatives(radius, 0.0, setting.inputs, &mut of_inputs)?;
            for (own, by) in elastic[2..].iter_mut().zip(of_inputs) {
                *own = by.load - to.stiffness * by.penetration;
            }
        }
        let (old, new) = (self.of_totals.len() - width * m, self.loads.len() - m);
        // All but the change of the penetration at the end of the step.
        for (column, by) in by.iter_mut().enumerate() {
            let total = self.totals[last + column];
            *by = law.constant * total + mean * (elastic[column] - total);
            let memories = &self.of_totals[old + column * m..][..m];
            for ((weight, (e, _)), memory) in
                law.weights.iter().zip(&self.step.factors).zip(memories)
            {
                *by += weight * e * memory;
            }
        }
        let of_law = &mut by[2 + setting.inputs.len()..];
        for (by, variation) in of_law.iter_mut().zip(&setting.variations) {
            if to.penetration <= 0.0 {
                break;
            }
            let before = self.passed[self.passed.len() - 2];
            let speed = (to.penetration - before.penetration) / h;
            *by += variation.constant * to.load + variation.impulse * to.stiffness * speed
                - variation.second_impulse * to.bend * speed * speed;
            let terms = variation.weights.iter().zip(&self.loads[new..]);
            *by += terms.map(|(weight, load)| weight * load).sum::<f64>();
        }
        let mut moved = vec![0.0; width];
        setting.complete(load, mean * to.stiffness, by, &mut moved);
        for (column, moved) in moved.iter().enumerate() {
            let total = elastic[column] + to.stiffness * moved;
            let change = total - self.totals[last + column];
            for (k, (e, [i0, ..])) in self.step.factors.iter().enumerate() {
                let own = e * self.of_totals[old + column * m + k] + change * i0;
                self.of_totals.push(own);
            }
            self.totals.push(total);
        }
        if spring {
            let last = self.moved.len() - width;
            let old = self.of_moved.len() - width * m;
            for (column, moved) in moved.iter().enumerate() {
                let change = moved - self.moved[last + column];
                for (k, (e, [i0, ..])) in self.step.factors.iter().enumerate() {
                    let own = e * self.of_moved[old + column * m + k] + change * i0;
                    self.of_moved.push(own);
                }
            }
        }
        self.moved.extend(moved);
        Ok(())
    }
}
