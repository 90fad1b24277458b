//! The penetrations or heights that are imposed on a contact in time, without their noise.
//!
//! A contact that relaxes is followed through one approach, which may be held, and one retract. Noise would turn it
//! around at every point, and a retract whose slope changes makes the contact grow again. Noisy values are therefore
//! replaced by straight lines through them.

use super::straight_lines::lines;
use crate::statistics::{median, range, robust_deviation};

/// The least noise, in parts of the range of the values.
const LEAST_NOISE: f64 = 1e-6;
/// The change of a value, over the least noise, above which it was noisy.
const NOISY: f64 = 10.0;

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
        let largest = largest(&values);
        let turn = end_of_hold(times, [&values, measured], largest).unwrap_or(largest);
        if !values.is_empty() {
            make_rise(&mut values[..=turn]);
            values[turn..].reverse();
            make_rise(&mut values[turn..]);
            values[turn..].reverse();
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

/// Returns the number of the last point of a hold at the largest value, where the values of the hold go to and fro, as
/// slow noise does: a contact that is followed through a small retract in a hold would grow again.
fn end_of_hold(times: &[f64], [values, measured]: [&[f64]; 2], largest: usize) -> Option<usize> {
    /// The part of the range within which values are held, and the part of the duration that a hold has at least.
    const HELD: f64 = 0.01;
    const LONG: f64 = 0.05;
    /// The distance from their median that values of the hold have at most, over the median distance: twice that of a
    /// straight line, and more.
    const SCATTER: f64 = 3.0;
    /// The distance of the medians of the first and the last third of a hold over that scatter or the noise that the
    /// lines have taken off, at most.
    const STEADY: f64 = 2.0;
    /// The distance from the median of the lowest value of the hold over that of the largest one, at least.
    const EVEN: f64 = 0.3;
    let least = values.get(largest)? - HELD * range(values.iter().copied());
    let is_held = |value: &f64| *value >= least;
    let [first, last] = [
        values.iter().position(is_held)?,
        values.iter().rposition(is_held)?,
    ];
    let is_long = times[last] - times[first] > LONG * (times[times.len() - 1] - times[0]);
    let held = &values[first..=last];
    let level = median(held.to_vec());
    let scatter = median(held.iter().map(|value| (value - level).abs()).collect());
    let end = values
        .iter()
        .rposition(|value| *value >= level - SCATTER * scatter)?;
    // Neither a slow fall nor an overshoot is noise: they go one way.
    let third = held.len() / 3;
    let ends = [&held[..third], &held[held.len() - third..]].map(|part| median(part.to_vec()));
    let noise = robust_deviation((first..=last).map(|i| values[i] - measured[i]));
    let is_steady = (ends[0] - ends[1]).abs() <= STEADY * scatter.max(noise);
    let arrived = held.iter().position(|value| *value >= level).unwrap_or(0) + first;
    let lowest = values[arrived..=end].iter().copied().fold(level, f64::min);
    let is_even = level - lowest + noise >= EVEN * (values[largest] - level);
    (is_long && is_steady && is_even && !rise_and_fall(held)).then_some(end)
}

/// Replaces values by the rising ones with the least squares of the changes.
fn make_rise(values: &mut [f64]) {
    // The sums and the numbers of neighbours that have one value.
    let mut equal: Vec<(f64, usize)> = Vec::with_capacity(values.len());
    let mean = |(sum, count): (f64, usize)| sum / count as f64;
    for &value in &*values {
        let mut last = (value, 1);
        while let Some(&before) = equal.last()
            && mean(before) > mean(last)
        {
            equal.pop();
            last = (before.0 + last.0, before.1 + last.1);
        }
        equal.push(last);
    }
    let mut begin = 0;
    for one in equal {
        values[begin..begin + one.1].fill(mean(one));
        begin += one.1;
    }
}

/// Whether values rise to the largest one and fall from there.
fn rise_and_fall(values: &[f64]) -> bool {
    let (up, down) = values.split_at(largest(values));
    up.is_sorted() && down.is_sorted_by(|a, b| a >= b)
}

/// Returns the values of straight lines at the times; those measured if they have no noise and do not go back.
fn without_noise(times: &[f64], measured: &[f64]) -> Vec<f64> {
    // Not 0 where all values are one.
    let least_noise = (LEAST_NOISE * range(measured.iter().copied())).max(f64::MIN_POSITIVE);
    let values = lines(times, measured, least_noise);
    let is_noisy = |(a, b): (&f64, &f64)| (a - b).abs() > NOISY * least_noise;
    if rise_and_fall(measured) && !values.iter().zip(measured).any(is_noisy) {
        measured.to_vec()
    } else {
        values
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
        let pairs = program.points.iter().zip(values);
        let differences = pairs.map(|(point, value)| (point.1 - value).abs());
        differences.fold(0.0, f64::max)
    }

    #[test]
    fn values_without_noise_stay_as_they_are() {
        let (times, ramps) = course(false);
        let changed = |change: fn(usize, f64) -> f64| -> Vec<f64> {
            let numbered = ramps.iter().enumerate();
            numbered.map(|(i, &value)| change(i, value)).collect()
        };
        let step = changed(|i, _| if i < 100 { 0.0 } else { 1.0 });
        let at_once = changed(|i, value| if i < 200 { value } else { 0.0 });
        let jump = changed(|i, value| if i < 50 { value } else { value + 0.1 });
        let overshoot = changed(|i, value| if (100..105).contains(&i) { 1.05 } else { value });
        for (name, values) in [
            ("ramps", ramps.clone()),
            ("half a wave", course(true).1),
            ("a step and a hold", step),
            ("a retract in one interval", at_once),
            ("a jump", jump),
            ("an overshoot", overshoot),
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

    /// Neither hum nor ringing, which the points follow, makes a retract of a hold: it ends where the retract begins.
    #[test]
    fn slow_noise_of_a_hold_is_no_retract() {
        let (times, values) = course(false);
        let hum = |time: f64| 1e-3 * (2.0 * PI * 3.7 * time).sin();
        let ring = |time: f64| 3e-3 * (-(time - 1.0) / 0.1).exp() * (50.0 * (time - 1.0)).cos();
        for (name, added) in [("hum", &hum as &dyn Fn(f64) -> f64), ("ringing", &ring)] {
            let pairs = times.iter().zip(&values);
            let measured: Vec<f64> = pairs
                .map(|(&time, &value)| value + if value == 1.0 { added(time) } else { 0.0 })
                .collect();
            let program = Program::new(&times, &measured);
            assert!(
                (199..=201).contains(&program.turn),
                "{name}: {}",
                program.turn
            );
            assert!(program.changed > 5e-4 && program.changed < 1e-2, "{name}");
            assert!(
                worst(&program, &values) < 2e-3,
                "{name}: {:e}",
                worst(&program, &values)
            );
            assert!(rise_and_fall(
                &program
                    .points
                    .iter()
                    .map(|point| point.1)
                    .collect::<Vec<_>>()
            ));
        }
    }

    /// A hold in which the values fall slowly, or after an overshoot, and a retract that slows down are followed, and so are
    /// steps of an approach.
    #[test]
    fn what_goes_one_way_is_kept() {
        let (times, ramps) = course(false);
        let of = |value: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            times
                .iter()
                .zip(&ramps)
                .map(|(&time, &ramp)| value(time, ramp))
                .collect()
        };
        let creep = |time: f64, ramp: f64| {
            if ramp == 1.0 {
                1.0 - 5e-3 * (time - 1.0)
            } else {
                ramp
            }
        };
        let settles = |time: f64, ramp: f64| {
            ramp + if ramp == 1.0 {
                5e-3 * (-(time - 1.0) / 0.1).exp()
            } else {
                0.0
            }
        };
        let slows = |time: f64, ramp: f64| {
            if time < 1.0 {
                ramp
            } else {
                (-(time - 1.0) / 20.0).exp()
            }
        };
        let steps = |time: f64, _: f64| (time.fract() * 2.0).min(1.0) + time.floor();
        let sudden = |time: f64, _: f64| time.floor();
        for (name, values) in [
            ("creep", of(&creep)),
            ("an overshoot", of(&settles)),
            ("a slow retract", of(&slows)),
            ("steps", of(&steps)),
            ("sudden steps", of(&sudden)),
        ] {
            assert_eq!(Program::new(&times, &values).changed, 0.0, "{name}");
            for seed in 0..10 {
                let range = range(values.iter().copied());
                let program = Program::new(&times, &noisy(&values, 3e-4 * range, seed));
                let worst = worst(&program, &values) / range;
                // The lines cut a sharp corner.
                assert!(worst < 6e-3, "{name}, {seed}: {worst:e}");
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
