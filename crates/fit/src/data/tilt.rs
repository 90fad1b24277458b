//! A baseline that is tilted: the drift of the instrument, or light that the sample reflects.

use crate::statistics::{extremes, median};
use crate::{Kind, Point};

/// The number of parts of equal length that the range of the heights has.
const PARTS: usize = 20;
/// The last of them that is on the baseline.
const LAST: usize = 13;
/// A baseline differs from a straight line by less than this part of its fall, and a force that rises rises by more.
const SEEN: f64 = 0.05;

/// Tells whether a force falls along a straight line while the bodies come closer, and rises only near the
/// end. With the signs of height or force turned, this would be no contact.
pub fn is_tilted(kind: Kind, points: &[Point]) -> bool {
    if kind != Kind::ForceHeight {
        return false;
    }
    let [least, most] = extremes(points.iter().map(|point| point.abscissa));
    let range = most - least;
    let mut parts = vec![Vec::new(); PARTS];
    for point in points {
        let part = (1.0 - (point.abscissa - least) / range) * PARTS as f64;
        parts[(part as usize).min(PARTS - 1)].push(point.ordinate);
    }
    if parts.iter().any(Vec::is_empty) {
        return false;
    }
    let forces: Vec<f64> = parts.into_iter().map(median).collect();
    let fall = forces[1] - forces[LAST];
    let line = |i: usize| forces[1] - fall * (i as f64 - 1.0) / (LAST as f64 - 1.0);
    let is_straight = (0..=LAST).all(|i| (forces[i] - line(i)).abs() <= SEEN * fall);
    let lowest = forces.iter().copied().fold(f64::INFINITY, f64::min);
    fall > 0.0 && is_straight && forces[PARTS - 1] - lowest > SEEN * fall
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_fall_and_a_rise_are_a_tilted_baseline() {
        let force = |height: f64| (10.0 - height).max(0.0).powf(1.5);
        let check = |kind, force: &dyn Fn(f64) -> f64| {
            let point = |i: u64| Point {
                line: i,
                abscissa: 200.0 - i as f64,
                ordinate: force(200.0 - i as f64) + 0.01 * ((i * 7919) % 101) as f64,
                direction: None,
            };
            is_tilted(kind, &(0..=200).map(point).collect::<Vec<_>>())
        };
        let of_heights = |force: &dyn Fn(f64) -> f64| check(Kind::ForceHeight, force);
        assert!(of_heights(&|z| force(z) + 0.3 * z));
        assert!(!check(Kind::LoadPenetration, &|z| force(z) + 0.3 * z));
        assert!(!of_heights(&force));
        // The opposite sense of heights, of forces, and a straight line.
        assert!(!of_heights(&|z| force(200.0 - z)));
        assert!(!of_heights(&|z| (z - 120.0).max(0.0)));
        assert!(!of_heights(&|z| -force(z)));
        assert!(!of_heights(&|z| 0.3 * z));
    }
}
