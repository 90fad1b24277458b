//! The places at which a measured history is followed: its points, the first touch, and what divides long
//! steps.
//!
//! Where the contact begins, the elastic load rises like a power of the time since then, and where a spring
//! suddenly moves at another speed, the penetration follows as fast as the law lets it. From such a place
//! on, the steps grow in proportion to the time since it.

use super::approach::Place;
use super::program::Program;

/// The fewest steps of a history without and with a spring.
const FEWEST: f64 = 120.0;
const FEWEST_OF_A_SPRING: f64 = 250.0;
/// The first step after a sudden change, in parts of the longest step.
const FIRST: f64 = 1e-3;
/// The later ones, in parts of the time since the change.
const GROWTH: f64 = 0.4;
/// The smallest change of the speed of a spring that is sudden, in parts of the largest speed, and the
/// most of these changes. A turn between two points changes the speed at both. More of them are noise.
const SUDDEN: f64 = 0.1;
const MOST_SUDDEN: usize = 4;

/// How long the steps are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Steps {
    /// The longest step, s.
    longest: f64,
    /// The steps after a sudden change, in parts of the time since the change.
    growth: f64,
    /// Whether sudden changes of the speed matter.
    of_spring: bool,
}

impl Steps {
    /// Returns the steps for a program.
    pub fn new(program: &Program, of_spring: bool) -> Self {
        let fewest = if of_spring {
            FEWEST_OF_A_SPRING
        } else {
            FEWEST
        };
        Self {
            longest: program.duration() / fewest,
            growth: GROWTH,
            of_spring,
        }
    }

    /// Returns steps of half the length.
    pub fn halved(self) -> Self {
        Self {
            longest: 0.5 * self.longest,
            growth: 0.5 * self.growth,
            ..self
        }
    }

    /// Returns the shortest step that matters for the law, s. What the first touch divides, and the steps
    /// after it, have small loads.
    pub fn shortest(self, program: &Program) -> f64 {
        let steps = program.times.windows(2).map(|pair| pair[1] - pair[0]);
        steps.fold(self.longest, f64::min)
    }

    /// Returns the places.
    pub fn places(self, program: &Program) -> Vec<Place> {
        let sudden = if self.of_spring {
            sudden_changes(program)
        } else {
            Vec::new()
        };
        let inner = |time, value| Place {
            time,
            value,
            point: None,
        };
        let mut places = Vec::with_capacity(program.times.len());
        // The last sudden change, and before the first touch none: nothing happens there.
        let mut change = None;
        for (point, (&t1, &v1)) in program.times.iter().zip(&program.values).enumerate() {
            if point > 0 {
                let [t0, v0] = [program.times[point - 1], program.values[point - 1]];
                let mut time = t0;
                if change.is_none() && v1 > 0.0 {
                    // A program begins at 0 or below.
                    time = (time + (t1 - t0) * (v0 / (v0 - v1))).min(t1);
                    change = Some(time);
                    if time > t0 && time < t1 {
                        places.push(inner(time, 0.0));
                    }
                } else if change.is_some() && sudden.contains(&(point - 1)) {
                    change = Some(t0);
                }
                if let Some(change) = change {
                    while let Some(next) = self.within(change, [time, t1]) {
                        time = next;
                        places.push(inner(time, program.on_segment(point, time)));
                    }
                }
            }
            places.push(Place {
                time: t1,
                value: v1,
                point: Some(point),
            });
        }
        places
    }

    /// Returns the end of the next step from one time to another; `None` where a single step is left.
    fn within(self, change: f64, [from, to]: [f64; 2]) -> Option<f64> {
        let left = to - from;
        let parts = (left / self.longest * (1.0 - 1e-9)).ceil().max(1.0);
        let graded = (self.growth * (from - change)).max(FIRST * self.longest);
        let step = graded.min(left / parts);
        // The last step may be half as long again: none is very short. Times do not resolve shorter ones.
        let next = from + step;
        (1.5 * step < left && next > from).then_some(next)
    }
}

/// Returns the points at which the speed changes most, if it changes suddenly.
fn sudden_changes(program: &Program) -> Vec<usize> {
    let times = program.times.windows(2).map(|pair| pair[1] - pair[0]);
    let rises = program.values.windows(2).map(|pair| pair[1] - pair[0]);
    let speeds: Vec<f64> = rises.zip(times).map(|(rise, time)| rise / time).collect();
    let largest = speeds
        .iter()
        .fold(0.0, |most: f64, speed| most.max(speed.abs()));
    let changes = speeds.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let mut sudden: Vec<(f64, usize)> = changes
        .zip(1..)
        .filter(|&(change, _)| change > SUDDEN * largest)
        .collect();
    sudden.sort_by(|a, b| b.0.total_cmp(&a.0));
    sudden.truncate(MOST_SUDDEN);
    sudden.into_iter().map(|(_, point)| point).collect()
}
