//! A penetration that grows, may be held, and falls: Lee and Radok's and Ting's integrals on any
//! elastic contact, to many digits.
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

use super::elastic::ElasticCurve;
use super::exponentials::Exponentials;
use super::moments::moments;
use super::program::{Instant, Program};
use super::{HistoryError, Phase, TimedContact};
use crate::{Contact, State};

/// The lag times the rate beyond which an exponential is 0.
const FORGOTTEN: f64 = 45.0;
/// The part of the length of a step by which `t1` may rise from rounding.
const ROUNDING: f64 = 1e-9;
/// Steps whose lengths differ by less, relatively, are of one length: the rounding of times.
const SAME: f64 = 1e-11;
/// The change of `t1`, in parts of a step, after which the next one would be below rounding.
const CONVERGED: f64 = 1e-8;
/// The most steps of Newton's method; halvings of the interval are among them.
const NEWTON: usize = 80;

/// Adhesion of the receding line.
#[derive(Clone, Copy)]
pub(super) struct Adhesion<'a> {
    pub contact: &'a Contact,
    /// The energy at which the line recedes, J/m^2.
    pub work: f64,
}

impl Adhesion<'_> {
    /// Returns the flat-punch penetration (m) by which adhesion lowers a contact of a radius (m).
    fn lowers(self, radius: f64) -> Result<f64, HistoryError> {
        if radius <= 0.0 {
            return Ok(0.0);
        }
        let mechanics = self.contact.mechanics();
        let edge = mechanics.edge_singularity(radius, self.work)?;
        let quantities = self.contact.quantities(radius)?;
        Ok(mechanics
            .lowered_by(radius, edge, quantities.eeq, quantities.gamma)
            .penetration)
    }
}

/// A penetration with at most one turn.
pub(super) struct OneTurn<'a> {
    curve: &'a ElasticCurve,
    law: &'a Exponentials,
    /// The points of the approach.
    times: Vec<f64>,
    penetrations: Vec<f64>,
    pieces: Vec<usize>,
    /// The integrals of `exp(-rate (t-t')) d F_el` up to each point, all rates of one after another.
    loads: Vec<f64>,
    /// The same of `d delta`.
    lengths: Vec<f64>,
    /// The number of the point of the first touch.
    touch: usize,
}

/// The factors of one length of a step.
struct Step {
    h: f64,
    factors: Vec<(f64, [f64; 3])>,
}

impl Step {
    fn new() -> Self {
        Self {
            h: 0.0,
            factors: Vec::new(),
        }
    }

    /// Changes the length of the step if it differs by more than rounding.
    fn set(&mut self, h: f64, law: &Exponentials) {
        if (h - self.h).abs() > SAME * h {
            self.h = h;
            self.factors.clear();
            self.factors
                .extend(law.rates.iter().map(|rate| moments(rate * h)));
        }
    }
}

/// Follows the program; `None` if the contact grows again after the turn.
///
/// `asked` are the times of the states, ascending.
pub(super) fn follow(
    curve: &ElasticCurve,
    law: &Exponentials,
    program: &Program,
    asked: &[f64],
    adhesion: Option<Adhesion<'_>>,
) -> Result<Option<Vec<TimedContact>>, HistoryError> {
    let all = program.with(asked);
    let largest = program.largest();
    let turn = all
        .iter()
        .rposition(|at| at.value == largest)
        .expect("it is one of the values");
    let rises = all[..=turn]
        .windows(2)
        .all(|pair| pair[0].value <= pair[1].value);
    let falls = all[turn..]
        .windows(2)
        .all(|pair| pair[0].value >= pair[1].value);
    if !(rises && falls) {
        return Ok(None);
    }
    let m = law.len();
    let mut own = OneTurn {
        curve,
        law,
        times: Vec::with_capacity(turn + curve.nodes.len() + 1),
        penetrations: Vec::new(),
        pieces: Vec::new(),
        loads: vec![0.0; m],
        lengths: vec![0.0; m],
        touch: 0,
    };
    own.push(all[0].time, all[0].value);
    let mut states = Vec::with_capacity(asked.len());
    let mut wanted = asked.iter().copied().peekable();
    let mut step = Step::new();
    let mut speed = 0.0;
    let mut grown = 0;
    for (i, at) in all[..=turn].iter().enumerate() {
        if i > 0 {
            speed = own.approach(&all[i - 1], at, &mut step);
            if speed > 0.0 {
                grown = own.times.len() - 1;
            }
        }
        while wanted.next_if_eq(&at.time).is_some() {
            states.push(own.advancing(speed));
        }
    }
    own.retract(&all[turn..], grown, &mut wanted, adhesion, &mut states)
        .map(|done| done.then_some(states))
}

impl OneTurn<'_> {
    /// Adds a point of the approach whose memories have been added.
    fn push(&mut self, time: f64, penetration: f64) {
        self.times.push(time);
        self.penetrations.push(penetration);
        self.pieces.push(self.curve.piece(penetration.max(0.0)));
    }

    /// Goes on to the next point of the program, with points between where the penetration passes
    /// from one piece of the elastic curve to the next one. Returns the speed.
    fn approach(&mut self, from: &Instant, to: &Instant, step: &mut Step) -> f64 {
        let speed = (to.value - from.value) / (to.time - from.time);
        let mut penetration = from.value;
        let nodes = &self.curve.nodes;
        let first = nodes.partition_point(|node| node.penetration <= from.value);
        let past = nodes.partition_point(|node| node.penetration < to.value);
        for node in &nodes[first..past.max(first)] {
            let time = from.time + (node.penetration - from.value) / speed;
            self.advance(time, penetration, node.penetration, speed, step);
            penetration = node.penetration;
        }
        self.advance(to.time, penetration, to.value, speed, step);
        speed
    }

    /// Takes one step of the approach, on one piece of the elastic curve.
    fn advance(&mut self, time: f64, from: f64, to: f64, speed: f64, step: &mut Step) {
        let h = time - self.times[self.times.len() - 1];
        if h <= 0.0 {
            return;
        }
        step.set(h, self.law);
        let m = self.law.len();
        let old = self.loads.len() - m;
        let rise = speed * h;
        let slopes = if to > 0.0 && rise > 0.0 {
            let piece = self.curve.piece(from.max(0.0));
            let (f0, s0) = self.curve.load(piece, from.max(0.0));
            let (f1, s1) = self.curve.load(piece, to);
            let (d0, d1, d) = (s0 * rise, s1 * rise, f1 - f0);
            // d F_el/dy with y from 1 at the beginning to 0 at the end of the step.
            let square = 3.0 * (d0 + d1) - 6.0 * d;
            [d1, 6.0 * d - 2.0 * d0 - 4.0 * d1, square]
        } else {
            [0.0; 3]
        };
        for (k, (e, [i0, i1, i2])) in step.factors.iter().enumerate() {
            let load = e * self.loads[old + k] + slopes[0] * i0 + slopes[1] * i1 + slopes[2] * i2;
            let length = e * self.lengths[old + k] + rise * i0;
            self.loads.push(load);
            self.lengths.push(length);
        }
        self.push(time, to);
        if to <= 0.0 {
            self.touch = self.times.len() - 1;
        }
    }

    /// Returns the state at the last point of the approach.
    fn advancing(&self, speed: f64) -> TimedContact {
        let last = self.times.len() - 1;
        let penetration = self.penetrations[last];
        let (elastic, stiffness) = self.curve.load(self.pieces[last], penetration);
        let load = if penetration > 0.0 {
            self.law.constant * elastic
                + self.sum_of_loads(last)
                + self.law.impulse * stiffness * speed
        } else {
            0.0
        };
        let radius = self.curve.radius(penetration);
        let phase = match () {
            () if radius == 0.0 => Phase::Separated,
            () if speed > 0.0 => Phase::Advancing,
            () => Phase::Resting,
        };
        TimedContact {
            time: self.times[last],
            phase,
            state: State {
                contact_radius: radius,
                load,
                penetration,
            },
        }
    }

    /// Returns the weighted sum of the load's memories at a point.
    fn sum_of_loads(&self, point: usize) -> f64 {
        let m = self.law.len();
        let terms = self.law.weights.iter().zip(&self.loads[point * m..]);
        terms.map(|(weight, load)| weight * load).sum()
    }

    /// Follows the retract. Returns false if the contact grows again.
    fn retract(
        &self,
        all: &[Instant],
        grown: usize,
        wanted: &mut std::iter::Peekable<impl Iterator<Item = f64>>,
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
            if change <= CONVERGED * (t2 - t0) && (next == newton || adhesion == 0.0)
                || high_t - low_t <= 4.0 * f64::EPSILON * t.abs()
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
        for ((weight, rate), memory) in self.law.weights.iter().zip(&self.law.rates).zip(&memories)
        {
            if rate * lag > FORGOTTEN {
                break;
            }
            load += weight * (-rate * lag).exp() * memory;
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

    /// Returns penetration and the load's memories at a time after the point `low`.
    fn between(&self, low: usize, t: f64) -> (f64, Vec<f64>) {
        let m = self.law.len();
        let [p0, p2] = [self.penetrations[low], self.penetrations[low + 1]];
        let (h, whole) = (t - self.times[low], self.times[low + 1] - self.times[low]);
        let penetration = p0 + (p2 - p0) * (h / whole);
        let piece = self.curve.piece(p0.max(0.0));
        let (f0, s0) = self.curve.load(piece, p0);
        let (f1, s1) = self.curve.load(piece, penetration);
        let rise = penetration - p0;
        let (d0, d1, d) = (s0 * rise, s1 * rise, f1 - f0);
        let slopes = [d1, 6.0 * d - 2.0 * d0 - 4.0 * d1, 3.0 * (d0 + d1) - 6.0 * d];
        let memories = self
            .law
            .rates
            .iter()
            .zip(&self.loads[low * m..])
            .map(|(rate, load)| {
                let (e, [i0, i1, i2]) = moments(rate * h);
                e * load + slopes[0] * i0 + slopes[1] * i1 + slopes[2] * i2
            });
        (penetration, memories.collect())
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

    /// Returns the number of exponentials that have not died out after a lag.
    fn alive(&self, lag: f64) -> usize {
        self.law
            .rates
            .partition_point(|rate| rate * lag <= FORGOTTEN)
    }

    /// Returns `D(t1, t)` for the time of a point of the approach.
    fn since(&self, own: &OneTurn<'_>, point: usize) -> f64 {
        let m = self.law.len();
        let lag = self.time - own.times[point];
        let old = &own.lengths[point * m..][..self.alive(lag)];
        let mut sum = self.whole - self.law.constant * own.penetrations[point];
        for ((weight, rate), old) in self.law.weights.iter().zip(&self.law.rates).zip(old) {
            sum -= weight * (-rate * lag).exp() * old;
        }
        sum
    }

    /// Prepares `D(t1, t)` for times after the point `low`.
    fn between(&'a self, own: &OneTurn<'_>, low: usize, speed: f64) -> Between<'a> {
        let m = self.law.len();
        let (begin, penetration) = (own.times[low], own.penetrations[low]);
        let lag = self.time - begin;
        let old = &own.lengths[low * m..][..self.alive(lag)];
        let terms = self.law.weights.iter().zip(&self.law.rates).zip(old);
        let mut whole = self.whole;
        let factors = terms.map(|((weight, rate), old)| {
            let e = (-rate * lag).exp();
            whole -= weight * e * old;
            e
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
    /// `exp(-rate (t - begin))`; 0 for the rates that are left out.
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
        for (k, (weight, rate)) in law.weights.iter().zip(&law.rates).enumerate() {
            let exponent = rate * lag;
            if exponent > FORGOTTEN {
                break;
            }
            let e = (-exponent).exp();
            let z = rate * h;
            let old = self.factors.get(k).copied().unwrap_or(0.0);
            let length = if z < SERIES {
                e * h * (1.0 - 0.5 * z)
            } else {
                (e - old) / rate
            };
            modulus += weight * e;
            sum -= weight * self.speed * length;
        }
        (sum, -modulus * self.speed)
    }
}
