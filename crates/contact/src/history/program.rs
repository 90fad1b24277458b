//! What is imposed in time: points joined by straight lines.

use std::ops::RangeInclusive;

use super::TimedContact;
use crate::{Control, Error};

/// The durations that are followed, s: their inverse squares do not overflow.
const DURATIONS: RangeInclusive<f64> = 1e-50..=1e50;

/// Points `(time, value)` joined by straight lines, long enough for all times asked for.
#[derive(Clone, Debug)]
pub(super) struct Program {
    /// The time of the first point, s.
    pub origin: f64,
    /// From the first point on, so that they resolve the shortest steps, s.
    pub times: Vec<f64>,
    pub values: Vec<f64>,
}

impl Program {
    /// Takes points whose times rise and whose first value, of the quantity `name`, is without a contact, and
    /// holds the last value until the last of the times asked for.
    pub fn new(name: &'static str, points: &[(f64, f64)], asked: &[f64]) -> Result<Self, Error> {
        if points.len() < 2 {
            return Error::refused(format!(
                "a program needs two points or more, and has {}: give the times and values at which it bends",
                points.len()
            ));
        }
        let origin = points[0].0;
        let mut own = Self {
            origin,
            times: Vec::with_capacity(points.len() + 1),
            values: Vec::with_capacity(points.len() + 1),
        };
        for (i, &(time, value)) in points.iter().enumerate() {
            let number = i + 1;
            if !(time.is_finite() && value.is_finite()) {
                return Error::refused(format!(
                    "point {number} of the program is ({time:?} s, {value:?}): both must be finite"
                ));
            }
            match own.times.last() {
                Some(&before) if time - origin <= before => {
                    return Error::refused(format!(
                        "point {number} of the program is at {time:?} s and the one before it at {:?} s: times \
                         must rise; for a sudden change give two times that are close together",
                        points[i - 1].0
                    ));
                }
                _ => own.times.push(time - origin),
            }
            own.values.push(value);
        }
        let (begin, end) = (origin, own.duration());
        for &time in asked {
            if !(time >= begin && time.is_finite()) {
                return Error::refused(format!(
                    "the state at {time:?} s is not known: the program begins at {begin:?} s; ask for finite times from there on"
                ));
            }
        }
        let latest = asked.iter().map(|time| time - origin).fold(end, f64::max);
        if latest > end {
            own.times.push(latest);
            own.values.push(own.values[own.values.len() - 1]);
        }
        let value = own.duration();
        if !DURATIONS.contains(&value) {
            return Error::refused(format!(
                "the program takes {value:?} s, and programs from 1e-50 to 1e50 s are followed: give its times in seconds"
            ));
        }
        let value = own.values[0];
        if value > 0.0 {
            return Error::refused(format!(
                "the program begins in contact, at {name} = {value:?}: the history before its first point is not known, and \
                 the forces depend on it; begin at {name} <= 0"
            ));
        }
        Ok(own)
    }

    /// Returns the largest value.
    pub fn largest(&self) -> f64 {
        self.values
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the duration, s.
    pub fn duration(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    /// Returns times within the long segments, close together after each point, where a load changes most.
    pub fn between(&self) -> impl Iterator<Item = f64> {
        /// The length of a long segment over the time at its end.
        const LONG: f64 = 0.01;
        const HALVINGS: i32 = 10;
        let segments = self.times.windows(2).map(|ends| [ends[0], ends[1]]);
        let long = segments.filter(|[from, to]| to - from > LONG * to);
        long.flat_map(|[from, to]| {
            (1..=HALVINGS).map(move |i| from + (to - from) * 0.5_f64.powi(i))
        })
    }

    /// Returns the value on the segment before the point `end`, at a `time` within it.
    pub fn on_segment(&self, end: usize, time: f64) -> f64 {
        let [t0, t1] = [self.times[end - 1], self.times[end]];
        let [v0, v1] = [self.values[end - 1], self.values[end]];
        if time >= t1 {
            v1
        } else {
            v0 + (v1 - v0) * ((time - t0) / (t1 - t0))
        }
    }

    /// Merges the times of the points with those asked for, ascending.
    pub fn with(&self, asked: &[f64]) -> Vec<Instant> {
        let mut all = Vec::with_capacity(self.times.len() + asked.len());
        let mut next = 0;
        for (i, (&time, &value)) in self.times.iter().zip(&self.values).enumerate() {
            while next < asked.len() && asked[next] < time {
                let at = asked[next];
                if all.last().is_none_or(|last: &Instant| last.time < at) {
                    all.push(Instant {
                        time: at,
                        value: self.on_segment(i, at),
                    });
                }
                next += 1;
            }
            all.push(Instant { time, value });
        }
        all
    }
}

/// A time with the imposed value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant {
    pub time: f64,
    pub value: f64,
}

impl Instant {
    /// Returns the surfaces at a distance, under the value that is imposed.
    pub fn apart(&self, control: Control) -> TimedContact {
        let is_load = control == Control::Load;
        TimedContact::separated(self.time, if is_load { 0.0 } else { self.value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_asked_for_lie_between_the_points_and_beyond_them() {
        let asked = [0.0, 0.5, 1.0, 1.0, 3.0];
        let points = [(0.0, 0.0), (1.0, 2.0), (2.0, 1.0)];
        let program = Program::new("load", &points, &asked).expect("a program");
        let all: Vec<_> = program
            .with(&asked)
            .iter()
            .map(|at| (at.time, at.value))
            .collect();
        assert_eq!(
            all,
            [(0.0, 0.0), (0.5, 1.0), (1.0, 2.0), (2.0, 1.0), (3.0, 1.0)]
        );
    }
}
