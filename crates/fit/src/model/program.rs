//! The penetrations or heights that are imposed on a contact in time, without their noise.
//!
//! A contact that relaxes is followed through one approach, which may be held, and one retract. Noise would turn it
//! around at every point, and a retract whose slope changes makes the contact grow again. Noisy values are therefore
//! replaced by straight lines through them, as few as the noise allows. Noise that is alike over more than some ten points
//! is taken for a course.

use std::ops::Range;

use crate::statistics::{MEDIAN, median};

/// The distances, in points, over which fourth differences show the noise: noise of neighbours that are alike is seen over
/// the larger ones alone.
const DISTANCES: [usize; 3] = [1, 3, 9];
/// The ratio of the differences over one distance and the one before up to which both show noise. It is 81 where they show a
/// smooth course.
const LARGEST_RATIO: f64 = 3.0;
/// The least noise, in parts of the range of the values.
const LEAST_NOISE: f64 = 1e-6;
/// The change of a value, over the least noise, above which it was noisy.
const NOISY: f64 = 10.0;
/// The standard deviations by which the residuals of a line, squared and added, may exceed what noise makes of them.
const EXCESS: f64 = 5.0;
/// The growth of that sum, over the variance of the noise, above which two lines are not one. It is some 2 where they are.
const SEPARATE: f64 = 25.0;
/// The distance between two lines, over what a corner within the interval between them makes of it, up to which they meet:
/// noise may have put the points next to a corner to the other line.
const NEAR: f64 = 3.0;
/// The fewest points from whose differences the noise is estimated.
const FEWEST_FOR_NOISE: usize = 12;
/// The most points of a part that are left as they are measured.
const MOST_UNFITTED: usize = 3;
/// How often a range of points is divided at most, so that the time stays in proportion to the number of points. The
/// points of a part that needs more are left as they are measured.
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
    /// Takes the noise off measured values at times that rise, and makes them rise to the largest one and fall from
    /// there.
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

/// Returns the values of the lines at the times; those measured if they have no noise and do not go back.
fn without_noise(times: &[f64], measured: &[f64]) -> Vec<f64> {
    if measured.len() <= MOST_UNFITTED {
        return measured.to_vec();
    }
    let least = measured.iter().copied().fold(f64::INFINITY, f64::min);
    let course = Course {
        times,
        values: measured,
        // Not 0 where all values are one.
        least_noise: (LEAST_NOISE * (measured[largest(measured)] - least)).max(f64::MIN_POSITIVE),
    };
    let mut parts = Vec::new();
    let all = 0..times.len();
    let least = Noise {
        variance: course.least_noise * course.least_noise,
        alike: 1.0,
    };
    course.divide(all, least, MOST_DIVISIONS, &mut parts);
    let corners = course.corners(&joined(parts));
    let mut next = 1;
    let value = |&time: &f64| {
        while next + 1 < corners.len() && corners[next].0 < time {
            next += 1;
        }
        let [(t0, x0), (t1, x1)] = [corners[next - 1], corners[next]];
        x0 + (x1 - x0) * ((time - t0) / (t1 - t0))
    };
    let values: Vec<f64> = times.iter().map(value).collect();
    let is_noisy = |(a, b): (&f64, &f64)| (a - b).abs() > NOISY * course.least_noise;
    if rise_and_fall(measured) && !values.iter().zip(measured).any(is_noisy) {
        measured.to_vec()
    } else {
        values
    }
}

/// Noise of values in time.
#[derive(Clone, Copy, Debug)]
struct Noise {
    variance: f64,
    /// How many values are alike: the variance over that between neighbours, 1 if each is independent.
    alike: f64,
}

impl Noise {
    /// Returns the noise of values whose course is smooth nearly everywhere, from their fourth differences: those of
    /// independent noise have 70 times its variance.
    fn of(values: &[f64], least: f64) -> Self {
        let over = |distance: usize| {
            let differences = values.windows(4 * distance + 1).map(|part| {
                let at = |i: usize| part[i * distance];
                (at(0) - 4.0 * at(1) + 6.0 * at(2) - 4.0 * at(3) + at(4)).abs()
            });
            median(differences.collect()) / (MEDIAN * 70.0_f64.sqrt())
        };
        let [near, farther @ ..] = DISTANCES.map(over).map(|deviation| deviation.max(least));
        let mut deviation = near;
        for far in farther {
            if far > LARGEST_RATIO * deviation {
                break;
            }
            deviation = deviation.max(far);
        }
        Self {
            variance: deviation * deviation,
            alike: (deviation / near).powi(2),
        }
    }
}

/// Points that follow each other, with the line through them.
#[derive(Clone, Debug)]
struct Part {
    range: Range<usize>,
    line: Line,
    noise: Noise,
}

impl Part {
    /// Whether the line is as near to the points as their noise allows.
    fn is_straight(&self) -> bool {
        let count = self.line.count;
        let allowed = count + EXCESS * (2.0 * count * self.noise.alike).sqrt();
        self.line.residual_sum() <= self.noise.variance * allowed
    }

    /// Returns this part and the next one as one part.
    fn with(&self, next: &Self) -> Self {
        let line = self.line.with(&next.line);
        let sum = |part: &Self| part.line.count * part.noise.variance;
        Self {
            range: self.range.start..next.range.end,
            noise: Noise {
                variance: (sum(self) + sum(next)) / line.count,
                alike: self.noise.alike.max(next.noise.alike),
            },
            line,
        }
    }

    fn is_fitted(&self) -> bool {
        self.range.len() > MOST_UNFITTED
    }
}

/// Joins neighbours whose points are no farther from one line than from two: a division may have cut a straight course.
fn joined(parts: Vec<Part>) -> Vec<Part> {
    let mut joined: Vec<Part> = Vec::new();
    for mut part in parts {
        while let Some(last) = joined.last() {
            let both = last.with(&part);
            let apart = last.line.residual_sum() + part.line.residual_sum();
            let allowed = SEPARATE * both.noise.alike * both.noise.variance;
            if !both.is_straight() || both.line.residual_sum() - apart > allowed {
                break;
            }
            joined.pop();
            part = both;
        }
        joined.push(part);
    }
    joined
}

/// Values in time.
struct Course<'a> {
    times: &'a [f64],
    values: &'a [f64],
    least_noise: f64,
}

impl Course<'_> {
    /// Divides the points of a range into straight parts. The noise of a part of few points is that of the part around it.
    fn divide(&self, range: Range<usize>, around: Noise, divisions: usize, parts: &mut Vec<Part>) {
        let noise = if range.len() < FEWEST_FOR_NOISE {
            around
        } else {
            Noise::of(&self.values[range.clone()], self.least_noise)
        };
        let part = |range: Range<usize>| Part {
            line: self.line(range.clone()),
            range,
            noise,
        };
        let whole = part(range.clone());
        if range.len() < 3 || whole.is_straight() {
            parts.push(whole);
            return;
        }
        if divisions == 0 {
            parts.extend(range.map(|i| part(i..i + 1)));
            return;
        }
        let forwards = self.residual_sums(range.clone());
        let backwards = self.residual_sums(range.clone().rev());
        let sum = |&k: &usize| forwards[k - 1] + backwards[range.len() - 1 - k];
        let best = (1..range.len()).min_by(|a, b| sum(a).total_cmp(&sum(b)));
        let middle = range.start + best.unwrap_or(1);
        self.divide(range.start..middle, noise, divisions - 1, parts);
        self.divide(middle..range.end, noise, divisions - 1, parts);
    }

    /// Returns the corners of the lines of some parts. Where the values jump from one line to the next, there is a corner on
    /// each side. A part that is not fitted has its corners at its points.
    fn corners(&self, parts: &[Part]) -> Vec<(f64, f64)> {
        let mut corners = Vec::new();
        let mut begins = true;
        for (i, part) in parts.iter().enumerate() {
            let [begin, end] = [part.range.start, part.range.end - 1].map(|i| self.times[i]);
            if !part.is_fitted() {
                corners.extend(part.range.clone().map(|i| (self.times[i], self.values[i])));
                begins = true;
                continue;
            }
            if begins {
                corners.push((begin, part.line.at(begin)));
            }
            let next = parts.get(i + 1).filter(|next| next.is_fitted());
            let corner = next.and_then(|next| {
                part.line
                    .meets(&next.line, [end, self.times[next.range.start]])
            });
            begins = corner.is_none();
            corners.push(corner.unwrap_or((end, part.line.at(end))));
        }
        corners
    }

    /// Returns the line through the points of a range.
    fn line(&self, range: Range<usize>) -> Line {
        let mut line = Line::default();
        range.for_each(|i| line.add(self.times[i], self.values[i]));
        line
    }

    /// Returns the sums of the squared residuals of the lines through the first one, two, ... of some points.
    fn residual_sums(&self, numbers: impl Iterator<Item = usize>) -> Vec<f64> {
        let mut line = Line::default();
        let sum = |i: usize| {
            line.add(self.times[i], self.values[i]);
            line.residual_sum()
        };
        numbers.map(sum).collect()
    }
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
        let point = Self {
            count: 1.0,
            time,
            value,
            ..Self::default()
        };
        *self = self.with(&point);
    }

    /// Returns the line through the points of two lines.
    fn with(&self, other: &Self) -> Self {
        let count = self.count + other.count;
        let [time, value] = [other.time - self.time, other.value - self.value];
        let share = other.count / count;
        let weight = self.count * share;
        Self {
            count,
            time: self.time + share * time,
            value: self.value + share * value,
            of_times: self.of_times + other.of_times + weight * time * time,
            of_both: self.of_both + other.of_both + weight * time * value,
            of_values: self.of_values + other.of_values + weight * value * value,
        }
    }

    fn slope(&self) -> f64 {
        if self.of_times > 0.0 {
            self.of_both / self.of_times
        } else {
            0.0
        }
    }

    /// Returns the sum of the squared residuals.
    fn residual_sum(&self) -> f64 {
        (self.of_values - self.slope() * self.of_both).max(0.0)
    }

    fn at(&self, time: f64) -> f64 {
        self.value + self.slope() * (time - self.time)
    }

    /// Returns the standard error of the line at its ends.
    fn error_at_end(&self) -> f64 {
        2.0 * self.residual_sum().sqrt() / self.count
    }

    /// Returns the corner of this line and the next one; `None` where the values jump between the end of this line and
    /// the beginning of the next.
    fn meets(&self, next: &Self, [end, begin]: [f64; 2]) -> Option<(f64, f64)> {
        let middle = f64::midpoint(end, begin);
        let (jump, slopes) = (
            next.at(middle) - self.at(middle),
            self.slope() - next.slope(),
        );
        let errors = self.error_at_end() + next.error_at_end();
        if jump.abs() > NEAR * slopes.abs() * (begin - end) + 3.0 * errors {
            return None;
        }
        let time = middle + jump / slopes;
        if self.time < time && time < next.time {
            Some((time, self.at(time)))
        } else {
            Some((middle, f64::midpoint(self.at(middle), next.at(middle))))
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    /// An approach from 0 to 1, a hold and a retract in straight lines, or half a wave.
    fn course(wave: bool) -> (Vec<f64>, Vec<f64>) {
        let times: Vec<f64> = (0..=300_i32).map(|i| f64::from(i) / 100.0).collect();
        let value = |&time: &f64| {
            if wave {
                (time / 3.0 * PI).sin()
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

    /// Returns the largest difference of a program from the values that it was made of before their noise.
    fn worst(program: &Program, values: &[f64]) -> f64 {
        let difference = |(point, value): (&(f64, f64), &f64)| (point.1 - value).abs();
        program
            .points
            .iter()
            .zip(values)
            .map(difference)
            .fold(0.0, f64::max)
    }

    #[test]
    fn values_without_noise_stay_as_they_are() {
        let (times, ramps) = course(false);
        let changed = |change: fn(usize, f64) -> f64| -> Vec<f64> {
            ramps
                .iter()
                .enumerate()
                .map(|(i, &value)| change(i, value))
                .collect()
        };
        for (name, values) in [
            ("ramps", ramps.clone()),
            ("half a wave", course(true).1),
            (
                "a step and a hold",
                changed(|i, _| if i < 100 { 0.0 } else { 1.0 }),
            ),
            (
                "a retract in one interval",
                changed(|i, value| if i < 200 { value } else { 0.0 }),
            ),
            (
                "a jump",
                changed(|i, value| if i < 50 { value } else { value + 0.1 }),
            ),
            (
                "an overshoot",
                changed(|i, value| if (100..105).contains(&i) { 1.05 } else { value }),
            ),
        ] {
            let program = Program::new(&times, &values);
            assert_eq!(program.changed, 0.0, "{name}");
            let expected: Vec<(f64, f64)> = times.iter().copied().zip(values).collect();
            assert_eq!(program.points, expected, "{name}");
        }
        assert_eq!(Program::new(&times, &[2.0; 301]).changed, 0.0);
        let steps = [0.0, 0.0, 1.0, 1.0, 1.0, 0.5];
        let program = Program::new(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], &steps);
        assert_eq!((program.changed, program.turn), (0.0, 4));
        assert!(Program::new(&[], &[]).points.is_empty());
        assert_eq!(
            Program::new(&[0.0, 1.0], &[1.0, 2.0]).points,
            [(0.0, 1.0), (1.0, 2.0)]
        );
    }

    /// A wave of few points, whose differences are large, is no noise.
    #[test]
    fn a_smooth_course_of_few_points_is_kept() {
        for count in [31, 51, 101] {
            let times: Vec<f64> = (0..count)
                .map(|i| f64::from(i) / f64::from(count - 1))
                .collect();
            let values: Vec<f64> = times.iter().map(|time| (PI * time).sin().powi(2)).collect();
            let program = Program::new(&times, &values);
            assert!(program.changed < 1e-3, "{count}: {:e}", program.changed);
        }
    }

    /// What is left of the noise is less than it was, and slopes are those of three lines.
    #[test]
    fn noise_is_taken_off() {
        for deviation in [1e-4, 1e-3, 1e-2] {
            for seed in 0..20 {
                let (times, values) = course(false);
                let program = Program::new(&times, &noisy(&values, deviation, seed));
                let worst = worst(&program, &values);
                assert!(
                    worst < 2.0 * deviation,
                    "{worst:e} of {deviation:e}, {seed}"
                );
                assert!(program.changed > deviation && program.changed < 4.0 * deviation);
                let slope = |i: usize| (program.points[i + 1].1 - program.points[i].1) / 0.01;
                let bends =
                    (1..times.len() - 1).filter(|&i| (slope(i) - slope(i - 1)).abs() > 1e-9);
                assert!(bends.count() <= 4, "{deviation:e}, {seed}");
            }
        }
    }

    /// Lines follow a curved course to a hundredth of its range.
    #[test]
    fn noise_of_a_curved_course_is_taken_off() {
        let (times, values) = course(true);
        for seed in 0..20 {
            let program = Program::new(&times, &noisy(&values, 1e-3, seed));
            let worst = worst(&program, &values);
            assert!(worst < 1e-2, "{worst:e}");
            assert!((130..170).contains(&program.turn), "{}", program.turn);
        }
    }
}
