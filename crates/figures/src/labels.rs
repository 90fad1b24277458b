//! Places the labels of a panel: next to the points that they name, clear of lines, of markers and
//! of each other.
//!
//! All lengths are pixels, rightwards and downwards. Each label has several candidate places around
//! its points. A candidate costs more the farther it is from its point, the more it covers, and
//! where something of another colour or the point of another label is closer than its own point.
//! Each label in turn takes the cheapest candidate, given the places of the others, until no label
//! moves. Of the results that begin with one label each, the cheapest is taken.

use plotters::style::RGBColor;

/// The position of a label relative to its point.
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
    /// All sides, clockwise.
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

    /// Returns the angle to `other` in eighths of a turn.
    fn turns(self, other: Self) -> usize {
        let apart = (self as usize).abs_diff(other as usize);
        apart.min(Self::ALL.len() - apart)
    }

    /// Returns the direction from the point to the label.
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

/// A text to be placed.
#[derive(Clone, Debug)]
pub struct Label {
    /// The points that the text may be next to, the preferred one first.
    pub anchors: Vec<[f64; 2]>,
    /// The width and the height of the text.
    pub size: [f64; 2],
    /// The colour of the text and of the line or marker that it names.
    pub colour: RGBColor,
    /// The preferred side.
    pub side: Side,
}

/// The lines and markers that labels should not cover: points along them, each with its colour.
#[derive(Clone, Debug, Default)]
pub struct Obstacles(Vec<(RGBColor, [f64; 2])>);

impl Obstacles {
    /// Adds a straight line.
    pub fn line(&mut self, colour: RGBColor, from: [f64; 2], to: [f64; 2]) {
        /// The distance of the points of a line.
        const STEP: f64 = 3.0;
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let steps = (length / STEP).ceil().max(1.0) as usize;
        self.0.extend((0..=steps).map(|i| {
            let part = i as f64 / steps as f64;
            (colour, [0, 1].map(|k| from[k] + (to[k] - from[k]) * part))
        }));
    }
}

/// The rectangle in which labels must be.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// The left and the right end.
    pub x: [f64; 2],
    /// The upper and the lower end.
    pub y: [f64; 2],
}

/// The place of a label.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The centre of the text.
    pub centre: [f64; 2],
    /// Whether the text covers a line, a marker or another label, or leaves the room.
    pub collides: bool,
}

#[derive(Clone, Copy, Debug)]
struct Rectangle {
    centre: [f64; 2],
    half: [f64; 2],
}

impl Rectangle {
    /// Returns the distance of a point: 0 inside.
    fn distance(&self, point: &[f64; 2]) -> f64 {
        let [x, y] = [0, 1].map(|k| ((point[k] - self.centre[k]).abs() - self.half[k]).max(0.0));
        // `hypot` is much slower, and guards against squares that overflow: those of pixels do not.
        (x * x + y * y).sqrt()
    }

    fn overlaps(&self, other: &Self) -> bool {
        /// The least distance of two labels.
        const GAP: f64 = 2.0;
        (0..2)
            .all(|k| (self.centre[k] - other.centre[k]).abs() < self.half[k] + other.half[k] + GAP)
    }

    fn is_in(&self, room: &Room) -> bool {
        let sides = [room.x, room.y];
        (0..2).all(|k| {
            self.centre[k] - self.half[k] >= sides[k][0]
                && self.centre[k] + self.half[k] <= sides[k][1]
        })
    }
}

/// A place that a label may take, and its cost without the other labels.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    rectangle: Rectangle,
    cost: f64,
    /// Whether the label covers a line or a marker there, or leaves the room.
    collides: bool,
}

/// The cost of an eighth of a turn away from the preferred side. A pixel between a label and its
/// point costs 1.
const TURN: f64 = 5.0;
/// The cost of another point than the preferred one.
const OTHER_ANCHOR: f64 = 6.0;
/// The cost of each pixel by which a label is closer to something that it does not name.
const AMBIGUOUS: f64 = 2.0;
/// The cost of a covered point of a line or marker.
const COVERED: f64 = 12.0;
/// The cost of an overlap with another label.
const OVERLAP: f64 = 1000.0;
/// The cost of a label that leaves the room.
const OUTSIDE: f64 = 5000.0;

impl Label {
    /// Returns the places around the points of the label, given the points of the `others`. Left
    /// and right of a point a label may also slide up and down.
    fn candidates(
        &self,
        others: &[[f64; 2]],
        room: &Room,
        obstacles: &Obstacles,
    ) -> Vec<Candidate> {
        const DISTANCES: [f64; 6] = [7.0, 10.0, 14.0, 19.0, 26.0, 35.0];
        const SLIDES: [f64; 11] = [
            0.0, -4.0, 4.0, -8.0, 8.0, -12.0, 12.0, -16.0, 16.0, -20.0, 20.0,
        ];
        let mut candidates = Vec::new();
        for (i, anchor) in self.anchors.iter().enumerate() {
            for side in Side::ALL {
                let beside = matches!(side, Side::Right | Side::Left);
                let slides = if beside { &SLIDES[..] } else { &SLIDES[..1] };
                for distance in DISTANCES {
                    for down in slides {
                        let rectangle = self.rectangle(anchor, side, distance, *down);
                        let (mut cost, collides) =
                            self.cost(&rectangle, anchor, others, room, obstacles);
                        cost += down.abs() + TURN * side.turns(self.side) as f64;
                        cost += if i == 0 { 0.0 } else { OTHER_ANCHOR };
                        candidates.push(Candidate {
                            rectangle,
                            cost,
                            collides,
                        });
                    }
                }
            }
        }
        candidates
    }

    /// Returns the place of the label at a distance from a point on one side, moved down.
    fn rectangle(&self, anchor: &[f64; 2], side: Side, distance: f64, down: f64) -> Rectangle {
        let direction = side.direction();
        // Diagonally, the corner is closer than the sides would be.
        let diagonal = direction[0] * direction[1] != 0.0;
        let distance = if diagonal { 0.6 * distance } else { distance };
        let half = self.size.map(|length| 0.5 * length);
        let mut centre = [0, 1].map(|k| anchor[k] + direction[k] * (half[k] + distance));
        centre[1] += down;
        Rectangle { centre, half }
    }

    /// Returns the cost of a place next to a point, and whether the label collides there.
    fn cost(
        &self,
        rectangle: &Rectangle,
        anchor: &[f64; 2],
        others: &[[f64; 2]],
        room: &Room,
        obstacles: &Obstacles,
    ) -> (f64, bool) {
        /// A label covers a point that is closer than this.
        const CLEAR: f64 = 2.0;
        let own = rectangle.distance(anchor);
        let (mut covered, mut foreign) = (0.0, f64::INFINITY);
        for point in others {
            foreign = rectangle.distance(point).min(foreign);
        }
        for (colour, point) in &obstacles.0 {
            let distance = rectangle.distance(point);
            if distance <= CLEAR {
                covered += 1.0;
            }
            if *colour != self.colour {
                foreign = distance.min(foreign);
            }
        }
        let outside = if rectangle.is_in(room) { 0.0 } else { OUTSIDE };
        let cost = own + AMBIGUOUS * (own - foreign).max(0.0) + COVERED * covered + outside;
        (cost, covered + outside > 0.0)
    }
}

pub fn place(labels: &[Label], room: &Room, obstacles: &Obstacles) -> Vec<Placed> {
    let candidates: Vec<Vec<Candidate>> = labels
        .iter()
        .map(|label| {
            let others = labels.iter().flat_map(|other| &other.anchors);
            let others = others.filter(|point| !label.anchors.contains(point));
            label.candidates(&others.copied().collect::<Vec<_>>(), room, obstacles)
        })
        .collect();
    // The label that chooses first has all places to choose from: each in turn is the first.
    (0..labels.len())
        .map(|first| settled(&candidates, first))
        .min_by(|(_, a), (_, b)| a.total_cmp(b))
        .map_or_else(Vec::new, |(placed, _)| places(&placed))
}

/// Returns the places that no label leaves, beginning with the label `first`, and their cost.
fn settled(candidates: &[Vec<Candidate>], first: usize) -> (Vec<Option<Candidate>>, f64) {
    /// More rounds than any figure takes.
    const ROUNDS: usize = 20;
    let count = candidates.len();
    let mut placed: Vec<Option<Candidate>> = vec![None; count];
    let mut total = 0.0;
    for _ in 0..ROUNDS {
        let before = places(&placed);
        total = 0.0;
        for i in (0..count).map(|k| (first + k) % count) {
            placed[i] = None;
            let cost = |candidate: &Candidate| {
                let others = placed.iter().flatten();
                let overlaps =
                    others.filter(|other| candidate.rectangle.overlaps(&other.rectangle));
                candidate.cost + OVERLAP * overlaps.count() as f64
            };
            let best = candidates[i]
                .iter()
                .map(|candidate| (cost(candidate), candidate))
                .min_by(|(a, _), (b, _)| a.total_cmp(b));
            total += best.map_or(0.0, |(cost, _)| cost);
            placed[i] = best.map(|(_, candidate)| *candidate);
        }
        if places(&placed) == before {
            break;
        }
    }
    (placed, total)
}

fn places(placed: &[Option<Candidate>]) -> Vec<Placed> {
    let all = || placed.iter().flatten().enumerate();
    let place = |(i, candidate): (usize, &Candidate)| Placed {
        centre: candidate.rectangle.centre,
        collides: candidate.collides
            || all().any(|(k, other)| k != i && candidate.rectangle.overlaps(&other.rectangle)),
    };
    all().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROOM: Room = Room {
        x: [0.0, 200.0],
        y: [0.0, 100.0],
    };
    const RED: RGBColor = RGBColor(255, 0, 0);
    const BLUE: RGBColor = RGBColor(0, 0, 255);

    fn label(at: [f64; 2], side: Side) -> Label {
        Label {
            anchors: vec![at],
            size: [40.0, 10.0],
            colour: RED,
            side,
        }
    }

    fn place_one(at: [f64; 2], side: Side, obstacles: &Obstacles) -> [f64; 2] {
        place(&[label(at, side)], &ROOM, obstacles)[0].centre
    }

    #[test]
    fn a_label_is_on_its_preferred_side_if_nothing_is_there() {
        let nothing = Obstacles::default();
        assert_eq!(
            place_one([100.0, 50.0], Side::Right, &nothing),
            [127.0, 50.0]
        );
        assert_eq!(
            place_one([100.0, 20.0], Side::Above, &nothing),
            [100.0, 8.0]
        );
    }

    #[test]
    fn the_first_side_is_beside_the_last() {
        assert_eq!(Side::Right.turns(Side::AboveRight), 1);
        assert_eq!(Side::Right.turns(Side::Left), 4);
    }

    #[test]
    fn a_label_gives_way_to_lines_labels_and_the_edge() {
        let mut line = Obstacles::default();
        line.line(RED, [0.0, 50.0], [200.0, 50.0]);
        let [_, y] = place_one([100.0, 50.0], Side::Right, &line);
        assert!((y - 50.0).abs() > 5.0, "{y}");

        let both = [[100.0, 50.0], [100.0, 52.0]].map(|at| label(at, Side::Right));
        let [first, second] = place(&both, &ROOM, &Obstacles::default())[..] else {
            panic!("two labels have two places");
        };
        assert!(!first.collides && !second.collides);
        let [first, second] = [first.centre, second.centre];
        assert!(
            (first[0] - second[0]).abs() >= 40.0 || (first[1] - second[1]).abs() >= 10.0,
            "{first:?} {second:?}"
        );

        let [x, _] = place_one([190.0, 50.0], Side::Right, &Obstacles::default());
        assert!(x + 20.0 <= 200.0, "{x}");
    }

    #[test]
    fn a_label_without_room_says_that_it_collides() {
        let mut lines = Obstacles::default();
        for x in 0..20 {
            let x = 10.0 * f64::from(x);
            lines.line(BLUE, [x, 0.0], [x, 100.0]);
        }
        let crowded = place(&[label([100.0, 50.0], Side::Right)], &ROOM, &lines);
        assert!(crowded[0].collides);
    }

    #[test]
    fn a_label_is_closer_to_its_own_line_than_to_another() {
        // Two vertical lines, 12 apart; the label of the left one prefers the right side.
        let mut lines = Obstacles::default();
        lines.line(RED, [100.0, 0.0], [100.0, 100.0]);
        lines.line(BLUE, [112.0, 0.0], [112.0, 100.0]);
        let [x, _] = place_one([100.0, 50.0], Side::Right, &lines);
        assert!(x + 20.0 < 100.0, "{x}");
    }

    #[test]
    fn a_label_of_a_line_takes_the_point_of_it_with_room() {
        // The preferred point is in a gap between two other lines.
        let mut lines = Obstacles::default();
        for y in [20.0, 40.0] {
            lines.line(BLUE, [0.0, y], [80.0, y]);
        }
        let mut along = label([30.0, 30.0], Side::Above);
        along.anchors.push([150.0, 30.0]);
        let [x, y] = place(&[along], &ROOM, &lines)[0].centre;
        assert_eq!([x, y], [150.0, 18.0]);
    }

    #[test]
    fn crowded_labels_share_the_room() {
        // Five ends of lines, 4 apart: none of the labels is far from its own.
        let labels: Vec<Label> = (0..5)
            .map(|i| label([100.0, 40.0 + 4.0 * f64::from(i)], Side::Right))
            .collect();
        let placed = place(&labels, &ROOM, &Obstacles::default());
        let centres: Vec<[f64; 2]> = placed.iter().map(|place| place.centre).collect();
        for (label, centre) in labels.iter().zip(&centres) {
            assert!(
                (label.anchors[0][1] - centre[1]).abs() < 40.0,
                "{centres:?}"
            );
        }
        for (i, a) in centres.iter().enumerate() {
            for b in &centres[..i] {
                let apart = (a[0] - b[0]).abs() >= 40.0 || (a[1] - b[1]).abs() >= 10.0;
                assert!(apart, "{centres:?}");
            }
        }
    }
}
