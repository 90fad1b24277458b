//! The penetrations or heights that are imposed on a contact in time, without their noise.
//!
//! A contact that relaxes is followed through one approach, which may be held, and one retract. Noise would turn it
//! around at every point, and a retract whose slope changes makes the contact grow again. Noisy values are therefore
//! replaced by a polyline through them, with as few corners as the noise allows.

use std::ops::Range;

use crate::statistics::{MEDIAN, median};

/// The distances, in points, over which differences tell the noise. Noise that changes slowly is seen over the
/// larger one alone.
const DISTANCES: [usize; 2] = [1, 3];
/// The least noise, in parts of the range of the values.
const LEAST_NOISE: f64 = 1e-6;
/// How many times the least noise a value must change by, or its noise is none.
const MANY: f64 = 10.0;
/// The standard deviations by which the squares of the residuals of a line may exceed their mean.
const EXCESS: f64 = 5.0;
/// The number of points that tell their noise.
const TELLING: usize = 24;
/// The number of points through which no line is drawn.
const FEW: usize = 3;
/// How often the points are divided at most, which binary division of any number of points does not need.
const MOST_DIVISIONS: usize = 64;

/// The imposed values of a measured history.
pub(crate) struct Program {
    /// Times (s) with penetrations or positions of the spring (m).
    pub points: Vec<(f64, f64)>,
    /// The largest change that took the noise off, or made the values rise to the largest one and fall from there, m.
    pub changed: f64,
    /// The number of the point of the largest value.
    pub turn: usize,
}

impl Program {
    /// Takes measured values at times that rise.
    pub fn new(times: &[f64], measured: &[f64]) -> Self {
        let mut values = without_noise(times, measured);
        let turn = largest(&values);
        for i in 1..values.len() {
            values[i] = if i <= turn {
                values[i].max(values[i - 1])
            } else {
                values[i].min(values[i - 1])
            };
        }
        let changes = values.iter().zip(measured).map(|(a, b)| (a - b).abs());
        Self {
            changed: changes.fold(0.0, f64::max),
            points: times.iter().copied().zip(values).collect(),
            turn,
        }
    }
}

/// Returns the number of the largest value, the last one of several; 0 of none.
fn largest(values: &[f64]) -> usize {
    let last = |&i: &usize, &j: &usize| values[i].total_cmp(&values[j]);
    (0..values.len()).max_by(last).unwrap_or(0)
}

/// Whether values rise to the largest one and fall from there.
fn rise_and_fall(values: &[f64]) -> bool {
    let (up, down) = values.split_at(largest(values));
    up.is_sorted() && down.is_sorted_by(|a, b| a >= b)
}

/// Returns the values of the polyline at the times; those measured if they have no noise and do not go back.
fn without_noise(times: &[f64], measured: &[f64]) -> Vec<f64> {
    if measured.len() <= FEW {
        return measured.to_vec();
    }
    let least = measured.iter().copied().fold(f64::INFINITY, f64::min);
    let course = Course {
        times,
        values: measured,
        least_noise: LEAST_NOISE * (measured[largest(measured)] - least),
    };
    let mut parts = Vec::new();
    course.divide(
        0..times.len(),
        course.least_noise,
        MOST_DIVISIONS,
        &mut parts,
    );
    let corners = course.corners(&parts);
    let mut next = 1;
    let value = |&time: &f64| {
        while next + 1 < corners.len() && corners[next].0 < time {
            next += 1;
        }
        let [(t0, x0), (t1, x1)] = [corners[next - 1], corners[next]];
        x0 + (x1 - x0) * ((time - t0) / (t1 - t0))
    };
    let values: Vec<f64> = times.iter().map(value).collect();
    let is_noise = |(a, b): (&f64, &f64)| (a - b).abs() > MANY * course.least_noise;
    if rise_and_fall(measured) && !values.iter().zip(measured).any(is_noise) {
        measured.to_vec()
    } else {
        values
    }
}

/// Values in time.
struct Course<'a> {
    times: &'a [f64],
    values: &'a [f64],
    least_noise: f64,
}

impl Course<'_> {
    /// Divides the points of a range until a line through each part is as near as the noise of the part allows. The noise
    /// of a part of few points is that of the part around it.
    fn divide(
        &self,
        range: Range<usize>,
        noise_around: f64,
        divisions: usize,
        parts: &mut Vec<Range<usize>>,
    ) {
        let noise = if range.len() < TELLING {
            noise_around
        } else {
            noise(&self.values[range.clone()]).max(self.least_noise)
        };
        let count = range.len() as f64;
        let allowed = noise * noise * (count + EXCESS * (2.0 * count).sqrt());
        let forwards = self.squares(range.clone());
        if range.len() < 3 || forwards[range.len() - 1] <= allowed {
            parts.push(range);
            return;
        }
        if divisions == 0 {
            parts.extend(range.map(|i| i..i + 1));
            return;
        }
        let backwards = self.squares(range.clone().rev());
        let sum = |&k: &usize| forwards[k - 1] + backwards[range.len() - 1 - k];
        let best = (1..range.len()).min_by(|a, b| sum(a).total_cmp(&sum(b)));
        let middle = range.start + best.unwrap_or(1);
        self.divide(range.start..middle, noise, divisions - 1, parts);
        self.divide(middle..range.end, noise, divisions - 1, parts);
    }

    /// Returns the corners of the polyline of some parts. Two lines meet where they cross, if that is between their means,
    /// else at their mean between the parts. A part of few points has its corners at these.
    fn corners(&self, parts: &[Range<usize>]) -> Vec<(f64, f64)> {
        let lines: Vec<Option<Line>> = parts
            .iter()
            .map(|part| (part.len() > FEW).then(|| self.line(part)))
            .collect();
        let mut corners = Vec::new();
        for (i, part) in parts.iter().enumerate() {
            let [begin, end] = [part.start, part.end - 1].map(|i| self.times[i]);
            let Some(line) = lines[i] else {
                corners.extend(part.clone().map(|i| (self.times[i], self.values[i])));
                continue;
            };
            if i == 0 || lines[i - 1].is_none() {
                corners.push((begin, line.at(begin)));
            }
            match lines.get(i + 1) {
                Some(Some(next)) => {
                    let between = f64::midpoint(end, self.times[part.end]);
                    corners.push(line.meets(next, between));
                }
                _ => corners.push((end, line.at(end))),
            }
        }
        corners
    }

    /// Returns the line through the points of a range.
    fn line(&self, range: &Range<usize>) -> Line {
        let mut line = Line::default();
        range
            .clone()
            .for_each(|i| line.add(self.times[i], self.values[i]));
        line
    }

    /// Returns the sums of the squared residuals of the lines through the first one, two, ... of some points.
    fn squares(&self, numbers: impl Iterator<Item = usize>) -> Vec<f64> {
        let mut line = Line::default();
        let sum = |i: usize| {
            line.add(self.times[i], self.values[i]);
            line.square()
        };
        numbers.map(sum).collect()
    }
}

/// Returns the standard deviation of the noise of values whose course is smooth nearly everywhere, from their fourth
/// differences: those of noise have 70 times its variance.
fn noise(values: &[f64]) -> f64 {
    let over = |distance: usize| {
        let differences = values.windows(4 * distance + 1).map(|part| {
            let at = |i: usize| part[i * distance];
            (at(0) - 4.0 * at(1) + 6.0 * at(2) - 4.0 * at(3) + at(4)).abs()
        });
        median(differences.collect()) / (MEDIAN * 70.0_f64.sqrt())
    };
    DISTANCES.map(over).into_iter().fold(0.0, f64::max)
}

/// A straight line of least squares, by the means and the sums of squared deviations from them.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    count: f64,
    time: f64,
    value: f64,
    of_times: f64,
    of_both: f64,
    of_values: f64,
}

impl Line {
    fn add(&mut self, time: f64, value: f64) {
        self.count += 1.0;
        let from = [time - self.time, value - self.value];
        self.time += from[0] / self.count;
        self.value += from[1] / self.count;
        let to = [time - self.time, value - self.value];
        self.of_times += from[0] * to[0];
        self.of_both += from[0] * to[1];
        self.of_values += from[1] * to[1];
    }

    fn slope(&self) -> f64 {
        if self.of_times > 0.0 {
            self.of_both / self.of_times
        } else {
            0.0
        }
    }

    /// Returns the sum of the squared residuals.
    fn square(&self) -> f64 {
        (self.of_values - self.slope() * self.of_both).max(0.0)
    }

    fn at(&self, time: f64) -> f64 {
        self.value + self.slope() * (time - self.time)
    }

    /// Returns where it meets the next line, if that is between their means; else their mean at a time between them.
    fn meets(&self, next: &Self, between: f64) -> (f64, f64) {
        let later = (next.at(between) - self.at(between)) / (self.slope() - next.slope());
        let time = between + later;
        if self.time < time && time < next.time {
            (time, self.at(time))
        } else {
            (between, f64::midpoint(self.at(between), next.at(between)))
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    /// An approach from 0 to 1, a hold and a retract in straight lines, or half a wave.
    fn course(wave: bool) -> (Vec<f64>, Vec<f64>) {
        let times: Vec<f64> = (0..=300_i32).map(|i| f64::from(i) / 100.0).collect();
        let value = |&time: &f64| {
            if wave {
                (time / 3.0 * std::f64::consts::PI).sin()
            } else {
                time.min(1.0).min(3.0 - time)
            }
        };
        let values = times.iter().map(value).collect();
        (times, values)
    }

    /// Adds noise that is evenly distributed with a standard deviation.
    fn noisy(values: &[f64], deviation: f64, seed: u64) -> Vec<f64> {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let largest = deviation * 3.0_f64.sqrt();
        let noise = |value: &f64| value + random.random_range(-largest..largest);
        values.iter().map(noise).collect()
    }

    #[test]
    fn values_without_noise_stay_as_they_are() {
        for wave in [false, true] {
            let (times, values) = course(wave);
            let program = Program::new(&times, &values);
            assert_eq!(program.changed, 0.0);
            assert_eq!(
                program.points,
                times.into_iter().zip(values).collect::<Vec<_>>()
            );
        }
        let steps = [0.0, 0.0, 1.0, 1.0, 1.0, 0.5];
        let program = Program::new(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], &steps);
        assert_eq!((program.changed, program.turn), (0.0, 4));
        assert!(Program::new(&[], &[]).points.is_empty());
        assert_eq!(
            Program::new(&[0.0, 1.0], &[1.0, 2.0]).points,
            [(0.0, 1.0), (1.0, 2.0)]
        );
    }

    /// What is left of the noise is less than it was, and slopes are nearly those without it.
    #[test]
    fn noise_is_taken_off() {
        for deviation in [1e-4, 1e-3, 1e-2] {
            for seed in 0..20 {
                let (times, values) = course(false);
                let program = Program::new(&times, &noisy(&values, deviation, seed));
                let departure = |(point, value): (&(f64, f64), &f64)| (point.1 - value).abs();
                let worst = program
                    .points
                    .iter()
                    .zip(&values)
                    .map(departure)
                    .fold(0.0, f64::max);
                assert!(
                    worst < 2.0 * deviation,
                    "{worst:e} of {deviation:e}, {seed}"
                );
                assert!(program.changed > deviation && program.changed < 4.0 * deviation);
                let slope = |i: usize| (program.points[i + 10].1 - program.points[i].1) / 0.1;
                for (i, expected) in [(20, 1.0), (60, 1.0), (150, 0.0), (220, -1.0), (280, -1.0)] {
                    let error = (slope(i) - expected).abs();
                    assert!(
                        error < 10.0 * deviation,
                        "{error:e} of {deviation:e}, {seed}"
                    );
                }
            }
        }
    }

    #[test]
    fn noise_of_a_curved_course_is_taken_off() {
        let (times, values) = course(true);
        for seed in 0..20 {
            let program = Program::new(&times, &noisy(&values, 1e-3, seed));
            let departure = |(point, value): (&(f64, f64), &f64)| (point.1 - value).abs();
            let worst = program
                .points
                .iter()
                .zip(&values)
                .map(departure)
                .fold(0.0, f64::max);
            assert!(worst < 5e-3, "{worst:e}");
            assert!((130..170).contains(&program.turn), "{}", program.turn);
        }
    }
}
