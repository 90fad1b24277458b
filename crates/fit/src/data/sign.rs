//! Signs: a contact that is pressed together more must push back more, and the more stiffly the more it
//! is pressed.
//!
//! So a load rises with the depth, and lies below the straight line between the ends of its curve. If
//! the load counts in the opposite sense it falls and lies above this line, if the depth does it falls
//! and lies below, and if both do it rises and lies above.

use crate::statistics::{extremes, median};
use crate::{Direction, Kind, Point};

/// The part of the range of the abscissa that is taken for an end of the curve.
const END: f64 = 0.1;
/// The difference between the ends, in parts of the range of the loads, from which on it is one of a
/// contact: drag and drift lower a load by less.
const SEEN: f64 = 0.2;
/// The rise of the load at the deep end, in parts of the range of the loads, from which on it is that of a
/// contact.
const RISES: f64 = 0.02;
/// The distance of a curve from the line between its ends, in parts of their difference, from which on
/// it counts as lying above. A load that follows the root of the depth, as the drag of a liquid does, lies 0.2 above
/// the line.
const BENT: f64 = 0.25;
/// The distance below which a load that falls tells nothing by its bend: heights and depths in the opposite
/// sense are the usual reason.
const STRAIGHT: f64 = 0.02;
/// The same as [`BENT`] where the load is farther from 0 at the end that counts as apart.
const BENT_AND_FAR: f64 = 0.05;

/// Tells whether the abscissae and the ordinates of `points` may count in the opposite sense; `None` if neither
/// do.
pub fn opposite(kind: Kind, points: &[Point]) -> Option<[bool; 2]> {
    // The direction in which the abscissa grows when the bodies are pressed together.
    let inwards = if kind == Kind::ForceHeight { -1.0 } else { 1.0 };
    let depth = |point: &Point| inwards * point.abscissa;
    let [least, most] = extremes(points.iter().map(depth));
    // Medians bear points far from the curve.
    let end = |of: &dyn Fn(f64) -> bool| {
        let own: Vec<&Point> = points.iter().filter(|point| of(depth(point))).collect();
        let middle = |of: &dyn Fn(&Point) -> f64| median(own.iter().map(|one| of(one)).collect());
        [middle(&depth), middle(&|point| point.ordinate)]
    };
    let reach = END * (most - least);
    let apart = end(&|depth| depth <= least + reach);
    let deepest = end(&|depth| depth >= most - reach);
    let rise = deepest[1] - apart[1];
    let [low, high] = extremes(points.iter().map(|point| point.ordinate));
    if rise.abs() < SEEN * (high - low) {
        return None;
    }
    let between = points.iter().filter(|point| {
        let depth = depth(point);
        depth > least + reach && depth < most - reach
    });
    let above = between.map(|point| {
        let part = (depth(point) - apart[0]) / (deepest[0] - apart[0]);
        point.ordinate - apart[1] - part * rise
    });
    let above = median(above.collect());
    let opposite = if rise < 0.0 {
        // An adhesive contact pulls, where apart there is no load; but its load rises with the depth.
        let middle = |direction: Option<Direction>, from: f64, to: f64| {
            let own = points.iter().filter(|point| {
                point.direction == direction && (from..=to).contains(&depth(point))
            });
            let loads: Vec<f64> = own.map(|point| point.ordinate).collect();
            if loads.is_empty() {
                f64::NAN
            } else {
                median(loads)
            }
        };
        let rises = Direction::OF_POINTS.iter().any(|way| {
            let before = middle(*way, most - 3.0 * reach, most - 2.0 * reach);
            middle(*way, most - reach, most) - before > RISES * (high - low)
        });
        match kind {
            _ if rises => return None,
            Kind::LoadRadius | Kind::PenetrationRadius if above < 0.0 => return None,
            // Depths and stiffnesses are positive.
            kind if kind.is_stiffness() && deepest[0] < 0.0 && deepest[1] > 0.0 => [true, false],
            kind if kind.at_radii() || kind.is_stiffness() => [false, true],
            _ => {
                let of_load = above > -STRAIGHT * rise;
                [!of_load, of_load]
            }
        }
    } else {
        let is_far = apart[1].abs() > deepest[1].abs();
        let bent = if is_far { BENT_AND_FAR } else { BENT };
        let has_two_senses = kind.at_positions();
        [has_two_senses && above > bent * rise; 2]
    };
    (opposite != [false; 2]).then_some(opposite)
}
