//! Straight lines through values in time, as few as their noise allows.
//!
//! A range of values is divided where two lines are best, until each part is straight; neighbours that are one line are
//! then joined again. Noise that is alike over more than some ten points is taken for a course.

use std::ops::Range;

use crate::statistics::noise_over;

/// The distances, in points, over which fourth differences show the noise: noise of neighbours that are alike is seen over
/// the larger ones alone.
const DISTANCES: [usize; 3] = [1, 3, 9];
/// The ratio of the differences over one distance and the one before up to which both show noise. It is 81 where they show a
/// smooth course.
const LARGEST_RATIO: f64 = 3.0;
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

/// Returns the values of the lines at the times, which rise. `least_noise` is the standard deviation below which there is
/// no noise, and above 0.
pub(super) fn lines(times: &[f64], values: &[f64], least_noise: f64) -> Vec<f64> {
    if values.len() <= MOST_UNFITTED {
        return values.to_vec();
    }
    let course = Course {
        times,
        values,
        least_noise,
    };
    let least = Noise {
        variance: least_noise * least_noise,
        alike: 1.0,
    };
    let mut parts = Vec::new();
    course.divide(0..times.len(), least, MOST_DIVISIONS, &mut parts);
    let corners = course.corners(&joined(parts));
    let mut next = 1;
    let value = |&time: &f64| {
        while next + 1 < corners.len() && corners[next].0 < time {
            next += 1;
        }
        let [(t0, x0), (t1, x1)] = [corners[next - 1], corners[next]];
        x0 + (x1 - x0) * ((time - t0) / (t1 - t0))
    };
    times.iter().map(value).collect()
}

/// Noise of values in time.
#[derive(Clone, Copy, Debug)]
struct Noise {
    variance: f64,
    /// The variance over that which neighbours show: 1 if each value is independent, more if neighbours are alike.
    alike: f64,
}

impl Noise {
    /// Returns the noise of values whose course is smooth nearly everywhere.
    fn of(values: &[f64], least: f64) -> Self {
        let over = |distance: usize| noise_over(distance, values).max(least);
        let [near, farther @ ..] = DISTANCES.map(over);
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
    /// each side. Where they jump back, which slow noise makes of a steady course, a line joins the middles of both. A part
    /// that is not fitted has its corners at its points.
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
            if let Some(next) =
                next.filter(|next| begins && part.line.goes_back_to(&next.line, end))
            {
                corners.extend([&part.line, &next.line].map(|line| (line.time, line.value)));
                begins = false;
                continue;
            }
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

    /// Tells whether the next line, whose slope is like that of this one, begins at a time farther back than this one ends.
    fn goes_back_to(&self, next: &Self, time: f64) -> bool {
        /// The ratio of the slopes, and the jump over the rise from the middle of one line to that of the other, at most.
        const ALIKE: f64 = 1.5;
        const SMALL: f64 = 0.5;
        let ratio = next.slope() / self.slope();
        let jump = (next.at(time) - self.at(time)) / (self.slope() * (next.time - self.time));
        (ALIKE.recip()..=ALIKE).contains(&ratio) && (-SMALL..0.0).contains(&jump)
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
