//! Where labels go: beside their points, where they cover least of what is drawn already.

use plotters::style::RGBColor;

/// Where a label is, seen from its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Side {
    Right,
    BelowRight,
    Below,
    BelowLeft,
    Left,
    AboveLeft,
    Above,
    AboveRight,
}

impl Side {
    /// Clockwise.
    const ALL: [Self; 8] = [
        Self::Right,
        Self::BelowRight,
        Self::Below,
        Self::BelowLeft,
        Self::Left,
        Self::AboveLeft,
        Self::Above,
        Self::AboveRight,
    ];

    /// How many eighths of a turn from another.
    fn turns(self, other: Self) -> usize {
        let apart = (self as usize).abs_diff(other as usize);
        apart.min(Self::ALL.len() - apart)
    }

    /// Rightwards and downwards.
    fn direction(self) -> [f64; 2] {
        match self {
            Self::Right => [1.0, 0.0],
            Self::Left => [-1.0, 0.0],
            Self::Above => [0.0, -1.0],
            Self::Below => [0.0, 1.0],
            Self::AboveRight => [1.0, -1.0],
            Self::AboveLeft => [-1.0, -1.0],
            Self::BelowRight => [1.0, 1.0],
            Self::BelowLeft => [-1.0, 1.0],
        }
    }
}

/// A text that belongs to a point.
#[derive(Clone, Debug)]
pub struct Label {
    pub text: String,
    pub colour: RGBColor,
    /// The preferred one.
    pub side: Side,
}

/// What labels must not cover, in the drawing's coordinates.
#[derive(Clone, Debug, Default)]
pub struct Obstacles {
    /// Points, close to each other, of what is drawn.
    points: Vec<[f64; 2]>,
    labels: Vec<Rectangle>,
}

/// Where labels may be.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    pub x: [f64; 2],
    pub y: [f64; 2],
}

#[derive(Clone, Copy, Debug)]
struct Rectangle {
    centre: [f64; 2],
    half: [f64; 2],
}

impl Rectangle {
    fn holds(&self, point: &[f64; 2]) -> bool {
        (0..2).all(|k| (point[k] - self.centre[k]).abs() <= self.half[k])
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|k| (self.centre[k] - other.centre[k]).abs() < self.half[k] + other.half[k])
    }

    fn is_in(&self, room: &Room) -> bool {
        let sides = [room.x, room.y];
        (0..2).all(|k| {
            self.centre[k] - self.half[k] >= sides[k][0]
                && self.centre[k] + self.half[k] <= sides[k][1]
        })
    }
}

impl Obstacles {
    /// A straight line, of points this far apart.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], distance: f64) {
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / distance)
            .ceil()
            .max(1.0) as usize;
        self.points.extend(
            (0..=steps)
                .map(|i| [0, 1].map(|k| from[k] + (to[k] - from[k]) * (i as f64 / steps as f64))),
        );
    }
}

/// Where a label is tried.
#[derive(Clone, Copy, Debug)]
struct Place {
    side: Side,
    /// From its point, in pixels.
    distance: f64,
    /// Further down, in pixels.
    down: f64,
}

/// Where a label is tried, the best place first: near its point and on the preferred side, to whose
/// left or right it may also slide up and down.
fn places(preferred: Side) -> Vec<Place> {
    const DISTANCES: [f64; 5] = [5.0, 9.0, 14.0, 22.0, 32.0];
    const SLIDES: [f64; 15] = [
        0.0, -5.0, 5.0, -10.0, 10.0, -15.0, 15.0, -20.0, 20.0, -25.0, 25.0, -30.0, 30.0, -35.0,
        35.0,
    ];
    let mut places = Vec::new();
    for side in Side::ALL {
        let slides = if matches!(side, Side::Right | Side::Left) {
            &SLIDES[..]
        } else {
            &SLIDES[..1]
        };
        for (i, &distance) in DISTANCES.iter().enumerate() {
            for (j, &down) in slides.iter().enumerate() {
                places.push((
                    4 * side.turns(preferred) + i + j.div_ceil(2),
                    Place {
                        side,
                        distance,
                        down,
                    },
                ));
            }
        }
    }
    places.sort_by_key(|(rank, _)| *rank);
    places.into_iter().map(|(_, place)| place).collect()
}

impl Label {
    /// The centre of a text of this size beside `at`, near the preferred side: in the room, not on
    /// other labels, and on the fewest obstacles. It becomes one itself.
    pub fn place(
        &self,
        at: [f64; 2],
        size: [f64; 2],
        pixel: f64,
        room: &Room,
        obstacles: &mut Obstacles,
    ) -> [f64; 2] {
        let rectangle = |place: Place| {
            let direction = place.side.direction();
            // Diagonally, the corner is closer than the sides would be.
            let distance = if direction[0] * direction[1] == 0.0 {
                place.distance
            } else {
                0.6 * place.distance
            };
            let half = size.map(|length| 0.5 * length);
            let mut centre = [0, 1].map(|k| at[k] + direction[k] * (half[k] + distance * pixel));
            centre[1] += place.down * pixel;
            Rectangle { centre, half }
        };
        let covers = |rectangle: &Rectangle| {
            let padded = Rectangle {
                half: rectangle.half.map(|half| half + 2.0 * pixel),
                ..*rectangle
            };
            let points = obstacles
                .points
                .iter()
                .filter(|point| padded.holds(point))
                .count();
            let labels = obstacles
                .labels
                .iter()
                .filter(|label| label.overlaps(&padded))
                .count();
            points + 1000 * labels + if rectangle.is_in(room) { 0 } else { 5000 }
        };
        let best = places(self.side)
            .into_iter()
            .map(rectangle)
            .min_by_key(covers)
            .expect("there are places");
        obstacles.labels.push(best);
        best.centre
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Room = Room {
        x: [0.0, 200.0],
        y: [0.0, 100.0],
    };

    fn place(at: [f64; 2], side: Side, obstacles: &mut Obstacles) -> [f64; 2] {
        Label {
            text: String::new(),
            colour: RGBColor(0, 0, 0),
            side,
        }
        .place(at, [40.0, 10.0], 1.0, &ROOM, obstacles)
    }

    #[test]
    fn a_label_is_where_it_is_wanted_if_nothing_is_there() {
        let mut nothing = Obstacles::default();
        assert_eq!(
            place([100.0, 50.0], Side::Right, &mut nothing),
            [125.0, 50.0]
        );
        assert_eq!(
            place([100.0, 20.0], Side::Above, &mut nothing),
            [100.0, 10.0]
        );
    }

    #[test]
    fn a_label_gives_way_to_lines_labels_and_the_edge() {
        let mut line = Obstacles::default();
        line.line([0.0, 50.0], [200.0, 50.0], 1.0);
        let [_, y] = place([100.0, 50.0], Side::Right, &mut line);
        assert!((y - 50.0).abs() > 5.0, "{y}");

        let mut labels = Obstacles::default();
        let first = place([100.0, 50.0], Side::Right, &mut labels);
        let second = place([100.0, 52.0], Side::Right, &mut labels);
        assert!(
            (first[0] - second[0]).abs() >= 40.0 || (first[1] - second[1]).abs() >= 10.0,
            "{first:?} {second:?}"
        );

        let [x, _] = place([190.0, 50.0], Side::Right, &mut Obstacles::default());
        assert!(x + 20.0 <= 200.0, "{x}");
    }
}
