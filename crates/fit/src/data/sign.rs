//! Signs: a contact that is pressed together more must push back more.

use std::fmt;

use super::assignment::Pair;
use super::source::Source;
use crate::{Kind, Point};

/// The part of the range of the abscissa that is taken for the deepest.
const DEEPEST: f64 = 0.1;

/// The doubt that one of two columns counts in the opposite sense.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// The abscissa.
    pub abscissa: Source,
    /// The heading of the ordinate.
    pub ordinate: String,
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:?} is smaller where {:?} says that the bodies are closer; one of them may count in \
             the opposite sense",
            self.ordinate, self.abscissa.heading
        )
    }
}

/// Returns the doubt that an axis counts in the opposite sense, if the deepest points have less
/// load or penetration than the others on average.
pub fn doubt(kind: Kind, points: &[Point], pair: &Pair) -> Option<Doubt> {
    // The direction in which the abscissa grows when the bodies are pressed together.
    let inwards = if kind == Kind::ForceHeight { -1.0 } else { 1.0 };
    let depth = |point: &Point| inwards * point.abscissa;
    let [least, most] = points.iter().fold(
        [f64::INFINITY, f64::NEG_INFINITY],
        |[least, most], point| [least.min(depth(point)), most.max(depth(point))],
    );
    let from = most - DEEPEST * (most - least);
    let mean = |points: &mut dyn Iterator<Item = &Point>| {
        let (sum, count) = points.fold((0.0, 0_u32), |(sum, count), point| {
            (sum + point.ordinate, count + 1)
        });
        sum / f64::from(count)
    };
    let deepest = mean(&mut points.iter().filter(|point| depth(point) >= from));
    let all = mean(&mut points.iter());
    (deepest < all).then(|| Doubt {
        abscissa: pair.abscissa.clone(),
        ordinate: pair.ordinate.heading.clone(),
    })
}
