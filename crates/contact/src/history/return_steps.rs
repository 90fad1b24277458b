//! The steps after the turn: the time `t1` at which the approach had the present radius, and the load.

use super::approach::{Approach, Passed, Place, Step};
use super::elastic::hermite;
use super::moments::moments;
use super::{Phase, TimedContact};
use crate::{Error, State};

/// The part of the approach by which its time of the present radius may rise.
const ROUNDING: f64 = 1e-9;
/// The change of that time, in parts of its step and of the time since, over which the load is linear to rounding. A
/// modulus that is singular at 0 changes much within a short time.
const LINEAR: f64 = 1e-6;
/// The same with adhesion, whose change with that time is not known exactly.
const CONVERGED: f64 = 1e-13;
/// The most steps of Newton's method; halvings of the interval are among them.
const NEWTON: usize = 80;

/// The retract so far.
pub(super) struct Return<'a> {
    approach: &'a Approach<'a>,
    time: f64,
    penetration: f64,
    /// The integrals over the penetration up to now, and over its derivatives.
    lengths: Vec<f64>,
    moved: Vec<f64>,
    of_moved: Vec<f64>,
    step: Step,
    /// The last point of the approach, where the line rests.
    grown: usize,
    /// The line was at this point of the approach, or between it and the one before.
    bracket: usize,
    /// The time at which the approach had the last radius.
    last: f64,
    separated: bool,
}

/// The present step.
struct Now {
    time: f64,
    h: f64,
    /// The imposed value.
    value: f64,
    /// What the integral over the penetration would be if it stayed where it was, without the constant.
    stays: f64,
    mean: f64,
}

/// The contact if the line is where the approach had it at a time.
struct Line {
    penetration: f64,
    load: f64,
    /// By how much the imposed value would have to be larger.
    excess: f64,
    /// The derivatives of the excess and of the load with respect to that time.
    slope: f64,
    load_slope: f64,
    /// What is left of the integral over the penetration since that time.
    since: f64,
}

impl<'a> Return<'a> {
    /// Begins at the last point of the approach.
    pub fn new(approach: &'a Approach<'a>) -> Self {
        let (m, width) = (approach.setting.law.len(), approach.setting.width);
        let bracket = approach.passed.len() - 1;
        let Passed {
            time, penetration, ..
        } = approach.passed[bracket];
        let tail = |of: &[f64], count: usize| of[of.len() - count.min(of.len())..].to_vec();
        Self {
            approach,
            time,
            penetration,
            lengths: tail(&approach.lengths, m),
            moved: tail(&approach.moved, width),
            of_moved: tail(&approach.of_moved, width * m),
            step: Step::new(),
            grown: bracket,
            bracket,
            last: time,
            separated: penetration <= 0.0,
        }
    }

    /// Takes a step, and writes the derivatives of the load.
    pub fn recede(&mut self, place: &Place, by: &mut [f64]) -> Result<TimedContact, Error> {
        let setting = self.approach.setting;
        let law = &setting.law;
        let h = place.time - self.time;
        self.step.set(h, law);
        let (mut stays, mut means) = (0.0, 0.0);
        for ((weight, (e, [i0, ..])), length) in law
            .weights
            .iter()
            .zip(&self.step.factors)
            .zip(&self.lengths)
        {
            stays += weight * e * length;
            means += weight * i0;
        }
        let now = Now {
            time: place.time,
            h,
            value: place.value,
            stays,
            mean: law.constant + means + law.impulse / h,
        };
        let found = self.line(&now)?;
        let (state, line) = match found {
            None => (TimedContact::separated(now.time, now.value), None),
            Some((low, t1, line)) => {
                let passed = self.passed_at(low, t1);
                let contact_radius = setting.curve.radius(passed.penetration);
                // The slope of the elastic curve has fewer digits than its stiffness.
                let pulled = match setting.receding {
                    Some(_) => setting.contact.stiffness(contact_radius)? * line.since,
                    None => 0.0,
                };
                let state = State {
                    contact_radius,
                    load: line.load + pulled,
                    penetration: line.penetration,
                };
                let rests =
                    self.bracket == self.grown && t1 == self.approach.passed[self.grown].time;
                let contact = TimedContact {
                    time: now.time,
                    phase: if rests {
                        Phase::Resting
                    } else {
                        Phase::Receding
                    },
                    state,
                };
                (contact, Some((low, t1, passed)))
            }
        };
        let rise = state.state.penetration - self.penetration;
        let before = std::mem::take(&mut self.moved);
        self.take(rise);
        if setting.width > 0 {
            match line {
                Some((low, t1, passed)) => {
                    self.moved = self.differentiate(&now, (low, t1, passed), &state, &before, by);
                }
                None => {
                    by.fill(0.0);
                    self.moved = vec![0.0; setting.width];
                    self.moved[0] = 1.0;
                }
            }
            self.take_moved(&before);
        }
        self.separated = line.is_none();
        (self.time, self.penetration) = (now.time, state.state.penetration);
        Ok(state)
    }

    /// Adds the last step to the integral over the penetration.
    fn take(&mut self, rise: f64) {
        for (length, (e, [i0, ..])) in self.lengths.iter_mut().zip(&self.step.factors) {
            *length = e * *length + rise * i0;
        }
    }

    /// Adds the last step to the integrals over the derivatives of the penetration.
    fn take_moved(&mut self, before: &[f64]) {
        let m = self.approach.setting.law.len();
        let columns = self.of_moved.chunks_exact_mut(m);
        for ((own, now), before) in columns.zip(&self.moved).zip(before) {
            for (own, (e, [i0, ..])) in own.iter_mut().zip(&self.step.factors) {
                *own = e * *own + (now - before) * i0;
            }
        }
    }

    /// Returns where the line is: after a point of the approach, at a time, and the contact. `None`
    /// without one.
    fn line(&mut self, now: &Now) -> Result<Option<(usize, f64, Line)>, Error> {
        let passed = &self.approach.passed;
        let touch = self.approach.touch;
        let grows = Error::GrowsAgain { time: now.time };
        let slack = ROUNDING * self.approach.setting.curve.last().penetration;
        if self.separated {
            let comes_back = self.at_point(now, touch)?.excess < -slack;
            return if comes_back { Err(grows) } else { Ok(None) };
        }
        let mut above = self.at_point(now, self.bracket)?;
        let adheres = self.approach.setting.receding.is_some();
        if adheres && self.bracket == self.grown && above.excess <= 0.0 {
            let line = Line {
                penetration: now.value,
                ..above
            };
            return Ok(Some((self.grown - 1, passed[self.grown].time, line)));
        }
        if above.excess < -slack {
            return Err(grows);
        }
        let mut low = self.bracket;
        let mut below = None;
        while low > touch {
            low -= 1;
            if passed[low].penetration < passed[low + 1].penetration {
                let at = self.at_point(now, low)?;
                if at.excess <= 0.0 {
                    below = Some(at);
                    break;
                }
                above = at;
            }
        }
        let Some(below) = below else {
            return Ok(None);
        };
        self.bracket = low + 1;
        let [t0, t2] = [passed[low].time, passed[low + 1].time];
        let (mut low_t, mut high_t) = (t0, t2);
        let speed = (passed[low + 1].penetration - passed[low].penetration) / (t2 - t0);
        let slopes = [&below, &above].map(|at| at.slope * speed * (t2 - t0));
        let mut t = t0 + (t2 - t0) * root_between([below.excess, above.excess.max(0.0)], slopes);
        let mut line = self.full(now, low, t)?;
        for _ in 0..NEWTON {
            *if line.excess < 0.0 {
                &mut low_t
            } else {
                &mut high_t
            } = t;
            let newton = t - line.excess / line.slope;
            let is_inside = newton >= low_t && newton <= high_t;
            let next = if is_inside {
                newton
            } else {
                0.5 * (low_t + high_t)
            };
            let change = next - t;
            let close = if adheres {
                CONVERGED * (t2 - t0)
            } else {
                LINEAR * (t2 - t0).min(now.time - t)
            };
            t = next;
            let rounding = 4.0 * f64::EPSILON * t.abs();
            if change.abs() <= close.max(rounding) || high_t - low_t <= rounding {
                line.load += line.load_slope * change;
                line.penetration = now.value - self.approach.setting.compliance * line.load;
                break;
            }
            line = self.full(now, low, t)?;
        }
        if t > self.last + ROUNDING * (passed[passed.len() - 1].time - passed[touch].time) {
            return Err(grows);
        }
        self.last = self.last.min(t);
        Ok(Some((low, t, line)))
    }

    /// Returns the elastic contact of the approach at a time after the point `low`.
    fn passed_at(&self, low: usize, time: f64) -> Passed {
        let [from, to] = [self.approach.passed[low], self.approach.passed[low + 1]];
        let part = (time - from.time) / (to.time - from.time);
        let penetration = from.penetration + (to.penetration - from.penetration) * part;
        self.approach.at(time, penetration)
    }

    /// Returns the contact if the line is where it was at a point of the approach.
    fn at_point(&self, now: &Now, point: usize) -> Result<Line, Error> {
        let setting = self.approach.setting;
        let law = &setting.law;
        let m = law.len();
        let passed = self.approach.passed[point];
        let lag = now.time - passed.time;
        let (lengths, loads) = (
            &self.approach.lengths[point * m..][..m],
            &self.approach.loads[point * m..][..m],
        );
        let asks_load = setting.compliance > 0.0 || setting.receding.is_some();
        let (mut length, mut load) = (
            law.constant * passed.penetration,
            law.constant * passed.load,
        );
        let mut modulus = law.constant;
        for (k, (e, _)) in law.after(lag).enumerate() {
            modulus += e;
            length += e * lengths[k];
            if asks_load {
                load += e * loads[k];
            }
        }
        // Its slope is that of a speed of 1 m/s.
        self.with(now, [length, load], [modulus, 1.0], &passed)
    }

    /// Returns the contact if the line is where it was at a time after the point `low`.
    fn full(&self, now: &Now, low: usize, t1: f64) -> Result<Line, Error> {
        let setting = self.approach.setting;
        let law = &setting.law;
        let m = law.len();
        let [from, to] = [self.approach.passed[low], self.approach.passed[low + 1]];
        let passed = self.passed_at(low, t1);
        let speed = (to.penetration - from.penetration) / (to.time - from.time);
        let (lag, h) = (now.time - t1, t1 - from.time);
        let slopes = from.slopes_to(&passed);
        let rise = passed.penetration - from.penetration;
        let (mut length, mut load) = (
            law.constant * passed.penetration,
            law.constant * passed.load,
        );
        let mut modulus = law.constant;
        for (k, (own, rate)) in law.after(lag).enumerate() {
            let (e, [i0, i1, i2]) = moments(rate * h);
            modulus += own;
            length += own * (e * self.approach.lengths[low * m + k] + rise * i0);
            let memory = e * self.approach.loads[low * m + k];
            load += own * (memory + slopes[0] * i0 + slopes[1] * i1 + slopes[2] * i2);
        }
        self.with(now, [length, load], [modulus, speed], &passed)
    }

    /// Returns the contact from the integrals over the penetration and the load up to the time of the line, where the
    /// elastic contact was `passed`: the present penetration is that at which the integral from there on is that of the
    /// adhesion. Its derivative is that of the relaxed `modulus` and the `speed` there.
    fn with(
        &self,
        now: &Now,
        [length, load]: [f64; 2],
        [modulus, speed]: [f64; 2],
        passed: &Passed,
    ) -> Result<Line, Error> {
        let setting = self.approach.setting;
        let stays = setting.law.constant * self.penetration + now.stays;
        let lowered = setting.lowers(passed.penetration)?;
        let penetration = self.penetration + (length - stays - lowered) / now.mean;
        let by_time = modulus * speed;
        Ok(Line {
            penetration,
            load,
            excess: penetration + setting.compliance * load - now.value,
            // The adhesion changes slowly with the radius, like its root: its change is left out.
            slope: by_time * (1.0 / now.mean + setting.compliance * passed.stiffness),
            load_slope: by_time * passed.stiffness,
            since: stays - length + now.mean * (now.value - self.penetration),
        })
    }

    /// Writes the derivatives of the load, and returns those of the penetration.
    fn differentiate(
        &self,
        now: &Now,
        (low, t1, passed): (usize, f64, Passed),
        state: &TimedContact,
        before: &[f64],
        by: &mut [f64],
    ) -> Vec<f64> {
        let approach = self.approach;
        let setting = approach.setting;
        let law = &setting.law;
        let (m, width) = (law.len(), setting.width);
        let [from, to] = [approach.passed[low], approach.passed[low + 1]];
        let (lag, h) = (now.time - t1, t1 - from.time);
        let part = h / (to.time - from.time);
        let spring = setting.compliance > 0.0;
        let slopes = from.slopes_to(&passed);
        let rise = passed.penetration - from.penetration;
        let last_rise = state.state.penetration - self.penetration;
        // At the time of the line: the decay since, that within its step, and the mean there.
        let factors = law
            .rates
            .iter()
            .map(|rate| ((-rate * lag).exp(), moments(rate * h)));
        let factors: Vec<(f64, (f64, [f64; 3]))> = factors.collect();
        let between = |of: &[f64], column: usize| {
            let [old, new] = [low, low + 1].map(|point| of[point * width + column]);
            [old, old + (new - old) * part]
        };
        for (column, by) in by.iter_mut().enumerate() {
            let [old, total] = between(&approach.totals, column);
            let memories = &approach.of_totals[(low * width + column) * m..][..m];
            *by = law.constant * total;
            for (k, (decay, (e, [i0, ..]))) in factors.iter().enumerate() {
                *by += law.weights[k] * decay * (e * memories[k] + (total - old) * i0);
            }
            if !spring {
                continue;
            }
            // As if the present penetration did not change in this step.
            let [old, there] = between(&approach.moved, column);
            let memories = &approach.of_moved[(low * width + column) * m..][..m];
            let mut since = law.constant * (before[column] - there);
            for (k, (decay, (e, [i0, ..]))) in factors.iter().enumerate() {
                let stays = self.step.factors[k].0 * self.of_moved[column * m + k];
                let then = decay * (e * memories[k] + (there - old) * i0);
                since += law.weights[k] * (stays - then);
            }
            *by += passed.stiffness * (since - now.mean * before[column]);
        }
        let of_law = &mut by[2 + setting.inputs.len()..];
        for (by, variation) in of_law.iter_mut().zip(&setting.variations) {
            *by += variation.constant * passed.load;
            let mut since = variation.constant * (state.state.penetration - passed.penetration)
                + variation.impulse * last_rise / now.h;
            for (k, (decay, (e, [i0, i1, i2]))) in factors.iter().enumerate() {
                let load = e * approach.loads[low * m + k]
                    + slopes[0] * i0
                    + slopes[1] * i1
                    + slopes[2] * i2;
                let length = e * approach.lengths[low * m + k] + rise * i0;
                *by += variation.weights[k] * decay * load;
                since += variation.weights[k] * (self.lengths[k] - decay * length);
            }
            *by += passed.stiffness * since;
        }
        let mut moved = vec![0.0; width];
        let stiffness = if spring {
            now.mean * passed.stiffness
        } else {
            0.0
        };
        setting.complete(state.state.load, stiffness, by, &mut moved);
        moved
    }
}

/// Returns about where in `[0, 1]` a function is 0 that rises from a value of at most 0 to one of at least 0, from the
/// values and the slopes at the ends.
fn root_between([below, above]: [f64; 2], [s0, s1]: [f64; 2]) -> f64 {
    // The inverse function has the inverse slopes.
    let width = (above - below).max(f64::MIN_POSITIVE);
    let part = -below / width;
    let guess = hermite([0.0, 1.0], [width / s0, width / s1], part);
    if (0.0..=1.0).contains(&guess) {
        guess
    } else {
        part
    }
}
