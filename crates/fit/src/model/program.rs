//! The penetrations or heights that are imposed on a contact in time, without their noise.
//!
//! A contact that relaxes is followed through one approach, which may be held, and one retract. Noise would turn it
//! around at every point, and a retract whose slope changes makes the contact grow again. Noisy values are therefore
//! replaced by straight lines through them.

use super::straight_lines::lines;
use crate::statistics::range;

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
