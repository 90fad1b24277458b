//! What was measured: the points of one experiment, in SI units.

use std::fmt;

use super::Branch;

/// The most groups of numbers that a sentence names.
const SHOWN: usize = 10;

named! {
    /// The two quantities that a measurement pairs.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Kind {
        /// Contact radius (m) and load (N): a JKR test.
        LoadRadius = "load-radius",
        /// Contact radius (m) and penetration (m).
        PenetrationRadius = "penetration-radius",
        /// Penetration (m) and load (N).
        LoadPenetration = "load-penetration",
        /// Height of the cantilever's base (m) and force (N): an AFM. The height is smaller when the
        /// base is closer to the sample; contact point - height = penetration + force/stiffness.
        ForceHeight = "force-height",
        /// Contact radius (m) and contact stiffness (N/m): see [`Indentation`](crate::Indentation).
        StiffnessRadius = "stiffness-radius",
        /// Load (N) and contact stiffness (N/m), in an elastic contact or with a hardness.
        StiffnessLoad = "stiffness-load",
        /// Penetration (m) and contact stiffness (N/m) of an indenter, with the load of each point.
        StiffnessDepth = "stiffness-depth",
    }
}

impl Kind {
    /// Returns the names of abscissa and ordinate.
    pub const fn names(self) -> [&'static str; 2] {
        match self {
            Self::LoadRadius => ["contact radius", "load"],
            Self::PenetrationRadius => ["contact radius", "penetration"],
            Self::LoadPenetration => ["penetration", "load"],
            Self::ForceHeight => ["height", "force"],
            Self::StiffnessRadius => ["contact radius", "contact stiffness"],
            Self::StiffnessLoad => ["load", "contact stiffness"],
            Self::StiffnessDepth => ["penetration", "contact stiffness"],
        }
    }

    /// Returns the SI units of abscissa and ordinate.
    pub const fn units(self) -> [&'static str; 2] {
        match self {
            Self::LoadRadius | Self::LoadPenetration | Self::ForceHeight => ["m", "N"],
            Self::PenetrationRadius => ["m", "m"],
            Self::StiffnessRadius | Self::StiffnessDepth => ["m", "N/m"],
            Self::StiffnessLoad => ["N", "N/m"],
        }
    }

    /// Returns the change of an `ordinate` over that of the number that a fit compares: a stiffness is compared by its
    /// logarithm.
    pub(crate) const fn scale(self, ordinate: f64) -> f64 {
        if self.is_stiffness() { ordinate } else { 1.0 }
    }

    /// Tells whether a contact stiffness is measured.
    pub const fn is_stiffness(self) -> bool {
        matches!(
            self,
            Self::StiffnessRadius | Self::StiffnessLoad | Self::StiffnessDepth
        )
    }

    /// Tells whether a force is measured against a position.
    pub const fn at_positions(self) -> bool {
        matches!(self, Self::LoadPenetration | Self::ForceHeight)
    }

    /// Tells whether the abscissa is the contact radius.
    pub const fn at_radii(self) -> bool {
        matches!(
            self,
            Self::LoadRadius | Self::PenetrationRadius | Self::StiffnessRadius
        )
    }
}

named! {
    /// The direction in which a point was measured.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Direction {
        /// The sphere moves towards the sample.
        Approach = "approach",
        /// The sphere moves away from the sample.
        Retract = "retract",
    }
}

impl Direction {
    /// What is known of the direction of a point.
    pub(crate) const OF_POINTS: [Option<Self>; 3] =
        [None, Some(Self::Approach), Some(Self::Retract)];
}

/// What the numbers of the points count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbering {
    /// The lines of a file, from 1.
    Lines,
    /// The items of an array, from 0.
    Points,
}

impl fmt::Display for Numbering {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lines => "line",
            Self::Points => "point",
        })
    }
}

impl Numbering {
    /// Names numbers that rise, such as `line 3` or `lines 3, 5, 8 to 12`; of many, the first ones.
    pub(crate) fn names(self, numbers: &[u64]) -> String {
        let groups: Vec<String> = numbers
            .chunk_by(|one, next| *next == one + 1)
            .map(|group| match *group {
                [first, _, .., last] => format!("{first} to {last}"),
                [first, last] => format!("{first}, {last}"),
                _ => group[0].to_string(),
            })
            .collect();
        let more = if groups.len() > SHOWN { ", ..." } else { "" };
        let plural = if numbers.len() == 1 { "" } else { "s" };
        let shown = groups.len().min(SHOWN);
        format!("{self}{plural} {}{more}", groups[..shown].join(", "))
    }
}

/// One measured point, in SI units. Loads and forces are positive in compression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The number of the point, by the [`Numbering`] of the measurement.
    pub line: u64,
    /// The contact radius, penetration or height (m), or the load (N), by the [`Kind`].
    pub abscissa: f64,
    /// The load or force (N), the penetration (m) or the stiffness (N/m), by the [`Kind`].
    pub ordinate: f64,
    /// The direction, where it is known.
    pub direction: Option<Direction>,
}

impl Point {
    /// Returns the branch of its contact: without a direction that of approach.
    pub(crate) fn branch(&self) -> Branch {
        match self.direction {
            Some(Direction::Retract) => Branch::Receding,
            _ => Branch::Advancing,
        }
    }
}

/// The points of one experiment, in the order in which they were measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Names the measurement in messages: the path of its file, for instance.
    pub name: String,
    /// The two quantities.
    pub kind: Kind,
    /// What the numbers of the points count.
    pub numbering: Numbering,
    /// The points.
    pub points: Vec<Point>,
}

#[cfg(test)]
mod tests {
    use super::Numbering;

    #[test]
    fn neighbouring_numbers_are_one_group() {
        let lines = |numbers: &[u64]| Numbering::Lines.names(numbers);
        assert_eq!(lines(&[7]), "line 7");
        assert_eq!(lines(&[3, 4, 8, 9, 10, 20]), "lines 3, 4, 8 to 10, 20");
        let apart: Vec<u64> = (1..=11).map(|i| 2 * i).collect();
        assert!(lines(&apart).ends_with("18, 20, ..."));
        assert_eq!(Numbering::Points.names(&[0, 1, 2]), "points 0 to 2");
    }
}
