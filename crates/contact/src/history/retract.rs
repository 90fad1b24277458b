//! The retract after one turn: the time `t1` at which the approach had the present radius, and the
//! load.

use std::iter::Peekable;

use super::adhesion::Adhesion;
use super::exponentials::Exponentials;
use super::one_turn::{OneTurn, Step};
use super::program::Instant;
use super::{HistoryError, Phase, TimedContact};
use crate::State;

/// The part of the approach by which `t1` may rise from rounding, and the part of the largest
/// penetration by which the surface may come back.
const ROUNDING: f64 = 1e-9;
/// The change of `t1`, in parts of a step, after which it is found. A modulus that is singular at 0 changes much within a
/// step, so that the change after a small one may be as large.
const CONVERGED: f64 = 1e-13;
/// The most steps of Newton's method; halvings of the interval are among them.
const NEWTON: usize = 80;

impl OneTurn<'_> {
    /// Follows the retract. Returns false if the contact grows again.
    pub fn retract(
        &self,
        all: &[Instant],
        grown: usize,
        wanted: &mut Peekable<impl Iterator<Item = f64>>,
        adhesion: Option<Adhesion<'_>>,
        states: &mut Vec<TimedContact>,
    ) -> Result<bool, HistoryError> {
        let m = self.law.len();
        let mut lengths = self.lengths[self.lengths.len() - m..].to_vec();
        let mut step = Step::new();
        // The line was at the point `bracket`, or between it and the one before.
        let mut bracket = grown;
        let mut last_time = self.times[grown];
        let mut separated = self.penetrations[grown] <= 0.0;
        // By how much the adhesion lowers the contact of a point.
        let lowered = |penetration: f64| match adhesion {
            Some(adhesion) => adhesion.lowers(self.curve.radius(penetration)),
            None => Ok(0.0),
        };
        for pair in all.windows(2) {
            let (from, at) = (&pair[0], &pair[1]);
            let h = at.time - from.time;
            step.set(h, self.law);
            let rise = at.value - from.value;
            for (length, (e, [i0, ..])) in lengths.iter_mut().zip(&step.factors) {
                *length = e * *length + rise * i0;
            }
            let now = Now::new(at, rise / h, &lengths, self.law);
            let residual = |point: usize| -> Result<f64, HistoryError> {
                Ok(now.since(self, point) + lowered(self.penetrations[point])?)
            };
            let line = if separated {
                if now.since(self, self.touch) > self.tolerable() {
                    return Ok(false);
                }
                None
            } else {
                let mut above = residual(bracket)?;
                if bracket == grown && above >= 0.0 {
                    Some(Line::Resting)
                } else if above > self.tolerable() {
                    return Ok(false);
                } else {
                    let mut below = f64::NEG_INFINITY;
                    let mut low = bracket;
                    while low > self.touch {
                        low -= 1;
                        if self.penetrations[low] < self.penetrations[low + 1] {
                            below = residual(low)?;
                            if below >= 0.0 {
                                break;
                            }
                            above = below;
                        }
                    }
                    bracket = low + 1;
                    if below >= 0.0 {
                        Some(Line::Receding {
                            low,
                            t1: self.turn(&now, low, [below, above], &lowered)?,
                        })
                    } else {
                        None
                    }
                }
            };
            if let Some(Line::Receding { t1, .. }) = line {
                let slack = ROUNDING * (self.times[grown] - self.times[self.touch]);
                if t1 > last_time + slack {
                    return Ok(false);
                }
                last_time = last_time.min(t1);
            }
            separated = line.is_none();
            while wanted.next_if_eq(&at.time).is_some() {
                states.push(match line {
                    None => TimedContact::separated(at.time, at.value),
                    Some(line) => self.after_turn(&now, line, grown, adhesion)?,
                });
            }
        }
        Ok(true)
    }

    /// The penetration below which a surface that comes back does not count.
    fn tolerable(&self) -> f64 {
        ROUNDING * self.curve.last().penetration
    }

    /// Returns the time `t1` after the point `low`. The residuals `[below, above]` at this point and
    /// at the next one have different signs.
    fn turn(
        &self,
        now: &Now<'_>,
        low: usize,
        [below, above]: [f64; 2],
        lowered: &dyn Fn(f64) -> Result<f64, HistoryError>,
    ) -> Result<f64, HistoryError> {
        let [t0, t2] = [self.times[low], self.times[low + 1]];
        let speed = (self.penetrations[low + 1] - self.penetrations[low]) / (t2 - t0);
        let between = now.between(self, low, speed);
        let (mut low_t, mut high_t) = (t0, t2);
        let mut t = t0 + (t2 - t0) * below / (below - above);
        for _ in 0..NEWTON {
            let (value, slope) = between.since(t);
            let penetration = self.penetrations[low] + speed * (t - t0);
            let adhesion = lowered(penetration)?;
            // The adhesion changes slowly with the radius, like its root.
            let slope = slope + 0.25 * adhesion * speed / penetration.max(f64::MIN_POSITIVE);
            let value = value + adhesion;
            *if value >= 0.0 {
                &mut low_t
            } else {
                &mut high_t
            } = t;
            let newton = t - value / slope;
            let next = if newton > low_t && newton < high_t {
                newton
            } else {
                0.5 * (low_t + high_t)
            };
            let change = (next - t).abs();
            t = next;
            let rounding = 4.0 * f64::EPSILON * t.abs();
            let least = rounding.max(CONVERGED * (t2 - t0));
            if change <= least && (next == newton || adhesion == 0.0) || high_t - low_t <= rounding
            {
                break;
            }
        }
        Ok(t)
    }

    /// Returns the state of a contact whose line rests or recedes after the turn.
    fn after_turn(
        &self,
        now: &Now<'_>,
        line: Line,
        grown: usize,
        adhesion: Option<Adhesion<'_>>,
    ) -> Result<TimedContact, HistoryError> {
        let m = self.law.len();
        let (phase, t1, penetration, memories, piece, since) = match line {
            Line::Resting => {
                let memories = self.loads[grown * m..][..m].to_vec();
                let since = now.since(self, grown);
                (
                    Phase::Resting,
                    self.times[grown],
                    self.penetrations[grown],
                    memories,
                    self.pieces[grown],
                    since,
                )
            }
            Line::Receding { low, t1 } => {
                let (penetration, memories) = self.between(low, t1);
                let speed = (self.penetrations[low + 1] - self.penetrations[low])
                    / (self.times[low + 1] - self.times[low]);
                let since = if adhesion.is_some() {
                    now.between(self, low, speed).since(t1).0
                } else {
                    0.0
                };
                (
                    Phase::Receding,
                    t1,
                    penetration,
                    memories,
                    self.curve.piece(self.penetrations[low].max(0.0)),
                    since,
                )
            }
        };
        let lag = now.time - t1;
        let mut load = self.law.constant * self.curve.load(piece, penetration).0;
        for ((weight, _), memory) in self.law.after(lag).zip(&memories) {
            load += weight * memory;
        }
        let contact_radius = self.curve.radius(penetration);
        if let Some(adhesion) = adhesion {
            // The slope of the elastic curve has fewer digits than its stiffness.
            load += adhesion.contact.stiffness(contact_radius)? * since;
        }
        let state = State {
            contact_radius,
            load,
            penetration: now.penetration,
        };
        Ok(TimedContact {
            time: now.time,
            phase,
            state,
        })
    }
}

/// Where the line is after the turn.
#[derive(Clone, Copy)]
enum Line {
    /// At its largest radius.
    Resting,
    /// At the radius that the approach had at `t1`, after the point `low`.
    Receding { low: usize, t1: f64 },
}

/// The present time of the retract.
struct Now<'a> {
    time: f64,
    penetration: f64,
    /// `int_0^t phi(t-t') d delta` up to terms that depend on the time `t1`.
    whole: f64,
    law: &'a Exponentials,
}

impl<'a> Now<'a> {
    fn new(at: &Instant, speed: f64, lengths: &[f64], law: &'a Exponentials) -> Self {
        let terms = law.weights.iter().zip(lengths);
        let memory: f64 = terms.map(|(weight, length)| weight * length).sum();
        let whole = law.constant * at.value + law.impulse * speed + memory;
        Self {
            time: at.time,
            penetration: at.value,
            whole,
            law,
        }
    }

    /// Returns `D(t1, t)` for the time of a point of the approach.
    fn since(&self, own: &OneTurn<'_>, point: usize) -> f64 {
        let m = self.law.len();
        let lag = self.time - own.times[point];
        let mut sum = self.whole - self.law.constant * own.penetrations[point];
        for ((weight, _), old) in self.law.after(lag).zip(&own.lengths[point * m..]) {
            sum -= weight * old;
        }
        sum
    }

    /// Prepares `D(t1, t)` for times after the point `low`.
    fn between(&'a self, own: &OneTurn<'_>, low: usize, speed: f64) -> Between<'a> {
        let m = self.law.len();
        let (begin, penetration) = (own.times[low], own.penetrations[low]);
        let terms = self.law.after(self.time - begin);
        let mut whole = self.whole;
        let factors = terms
            .zip(&own.lengths[low * m..])
            .map(|((weight, _), old)| {
                whole -= weight * old;
                weight
            });
        let factors = factors.collect();
        Between {
            now: self,
            begin,
            penetration,
            speed,
            whole,
            factors,
        }
    }
}

/// `D(t1, t)` for times `t1` on one step of the approach.
struct Between<'a> {
    now: &'a Now<'a>,
    begin: f64,
    penetration: f64,
    speed: f64,
    /// The part that does not depend on `t1`.
    whole: f64,
    /// `weight exp(-rate (t - begin))`; 0 for the rates that are left out.
    factors: Vec<f64>,
}

impl Between<'_> {
    /// Returns `D(t1, t)` and its slope `-phi(t-t1) speed`.
    fn since(&self, t1: f64) -> (f64, f64) {
        /// Below this exponent the difference of two exponentials has fewer digits than its series.
        const SERIES: f64 = 1e-5;
        let law = self.now.law;
        let (lag, h) = (self.now.time - t1, t1 - self.begin);
        let mut sum = self.whole - law.constant * (self.penetration + self.speed * h);
        let mut modulus = law.constant;
        for (k, (e, rate)) in law.after(lag).enumerate() {
            let z = rate * h;
            let old = self.factors.get(k).copied().unwrap_or(0.0);
            let length = if z < SERIES {
                e * h * (1.0 - 0.5 * z)
            } else {
                (e - old) / rate
            };
            modulus += e;
            sum -= self.speed * length;
        }
        (sum, -modulus * self.speed)
    }
}
