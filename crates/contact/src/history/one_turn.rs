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

use super::adhesion::Adhesion;
use super::elastic::ElasticCurve;
use super::exponentials::Exponentials;
use super::moments::{moments, slopes};
use super::program::{Instant, Program};
use super::{HistoryError, Phase, TimedContact};
use crate::State;

/// Steps whose lengths differ by less, relatively, are of one length: the rounding of times.
const SAME: f64 = 1e-11;

/// A penetration with at most one turn.
pub(super) struct OneTurn<'a> {
    pub curve: &'a ElasticCurve,
    pub law: &'a Exponentials,
    /// The points of the approach.
    pub times: Vec<f64>,
    pub penetrations: Vec<f64>,
    pub pieces: Vec<usize>,
    /// The integrals of `exp(-rate (t-t')) d F_el` up to each point, all rates of one after another.
    pub loads: Vec<f64>,
    /// The same of `d delta`.
    pub lengths: Vec<f64>,
    /// The number of the point of the first touch.
    pub touch: usize,
}

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
    let done = own.retract(&all[turn..], grown, &mut wanted, adhesion, &mut states)?;
    Ok(done.then_some(states))
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
            let from = from.max(0.0);
            let piece = self.curve.piece(from);
            let load = |at: f64| self.curve.load(piece, at);
            slopes(load(from), load(to), rise)
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
        let bend = self.curve.bend(self.pieces[last], penetration);
        let load = if penetration > 0.0 {
            self.law.constant * elastic
                + self.sum_of_loads(last)
                + self.law.impulse * stiffness * speed
                - self.law.second_impulse * bend * speed * speed
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

    /// Returns penetration and the load's memories at a time after the point `low`.
    pub fn between(&self, low: usize, t: f64) -> (f64, Vec<f64>) {
        let m = self.law.len();
        let [p0, p2] = [self.penetrations[low], self.penetrations[low + 1]];
        let (h, whole) = (t - self.times[low], self.times[low + 1] - self.times[low]);
        let penetration = p0 + (p2 - p0) * (h / whole);
        let piece = self.curve.piece(p0.max(0.0));
        let load = |at: f64| self.curve.load(piece, at);
        let slopes = slopes(load(p0), load(penetration), penetration - p0);
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
