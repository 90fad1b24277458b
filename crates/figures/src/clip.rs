//! Cuts lines where they leave the axes of a panel.

use crate::axis::Axis;
use crate::chart::Point;

/// Returns the pieces of a line that are between the axes. Each segment is cut where it leaves
/// them, by the method of Liang and Barsky (1984).
pub fn inside(points: &[Point], axes: &[Axis; 2]) -> Vec<Vec<(f64, f64)>> {
    let place = |point: &Point| [0, 1].map(|k| axes[k].position(point[k]));
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut connected = false;
    for ends in points.windows(2) {
        let (from, to) = (place(&ends[0]), place(&ends[1]));
        let drawable = from.iter().chain(&to).all(|place| place.is_finite());
        let (mut enter, mut leave) = (0.0_f64, if drawable { 1.0_f64 } else { f64::NEG_INFINITY });
        for k in 0..2 {
            for (distance, speed) in [(from[k], to[k] - from[k]), (1.0 - from[k], from[k] - to[k])]
            {
                if speed > 0.0 {
                    enter = enter.max(-distance / speed);
                } else if speed < 0.0 {
                    leave = leave.min(-distance / speed);
                } else if distance < 0.0 {
                    leave = f64::NEG_INFINITY;
                }
            }
        }
        if enter > leave {
            connected = false;
            continue;
        }
        let at = |part: f64, end: &Point| {
            if part == 0.0 || part == 1.0 {
                return (end[0], end[1]);
            }
            let value = |k: usize| axes[k].value(from[k] + part * (to[k] - from[k]));
            (value(0), value(1))
        };
        if !connected {
            pieces.push(vec![at(enter, &ends[0])]);
        }
        if let Some(piece) = pieces.last_mut() {
            piece.push(at(leave, &ends[1]));
        }
        connected = leave == 1.0;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It leaves through the top at 0.35, and comes back at 0.65 without a point between.
    #[test]
    fn a_line_that_leaves_the_axes_comes_back_as_another() {
        let axes = [0, 1].map(|_| Axis::linear("", [0.0, 1.0]));
        let points = [[0.2, 0.5], [0.5, 1.5], [0.8, 0.5]];
        let ends: Vec<usize> = inside(&points, &axes).iter().map(Vec::len).collect();
        assert_eq!(ends, [2, 2]);
    }
}
