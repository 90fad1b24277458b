//! A measured shape of a probe.

use std::sync::Arc;

use crate::Error;

/// The largest number of points of a profile.
const MOST_POINTS: usize = 200;
/// The largest distance of a point above the convex hull, for the rounding of text: over the height of the profile, and
/// over that of the point.
const OF_HEIGHT: f64 = 1e-3;
const OF_POINT: f64 = 0.05;

/// The measured shape of a probe with rotational symmetry, as points `(r, z)`.
///
/// The points are smoothed by this rule: the slope `dz/dr` is 0 on the axis, it is that of the straight
/// line between two points midway between them, and it is a linear function of `r` in between. Beyond the last middle it continues linearly to the
/// last point. So the slope is continuous, the shape is convex if the points are, and evenly
/// spaced points of a paraboloid give the paraboloid. Let `d` be half the distance
/// from the edge of a flat end to the nearer of the points beside it: the slope begins to rise `d` before the edge and has
/// risen `d` behind it. Points that lie above the convex hull of all by at most 1e-3 of the height of the profile and 5 % of
/// their own are lowered to it: rounded numbers of a straight flank are not convex.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The radii (m) at which the slope bends, ascending from 0, and the slopes there.
    slopes: Arc<[[f64; 2]]>,
    /// The radius of the last point, m.
    end: f64,
}

impl Profile {
    /// Takes points `(r, z)` (m): the distance from the axis, ascending, and the height of the
    /// surface of the probe above its lowest point. A first point off the axis is preceded by
    /// `(0, 0)`.
    ///
    /// # Errors
    /// [`Error::Profile`] with the number of the row, from 1, for a number that is not finite, an
    /// `r` that is negative or not larger than the one before, a `z` that falls, or a slope smaller
    /// than the one before at points that are not lowered, because a contact is one disc under a convex
    /// shape only; and for fewer than 2 or more than 200 points.
    pub fn new(points: &[[f64; 2]]) -> Result<Self, Error> {
        let refuse = |row: usize, reason: &'static str| Err(Error::Profile { row, reason });
        if points.len() > MOST_POINTS {
            return refuse(
                MOST_POINTS + 1,
                "a profile has at most 200 points: give fewer, such as means over several rows",
            );
        }
        let on_axis = points.first().is_some_and(|point| point[0] == 0.0);
        let origin = if on_axis { points[0] } else { [0.0, 0.0] };
        let rest = &points[usize::from(on_axis)..];
        if rest.is_empty() {
            return refuse(points.len(), "a profile needs points at two radii at least");
        }
        let mut before = origin;
        // The corners of the convex hull.
        let mut hull = vec![origin];
        for (i, &[r, z]) in rest.iter().enumerate() {
            let row = i + 1 + usize::from(on_axis);
            if !(r.is_finite() && z.is_finite() && origin[1].is_finite()) {
                return refuse(row, "r and z must be finite");
            }
            if r <= before[0] {
                return refuse(row, "r must be positive and larger than in the row before");
            }
            if !(0.0..f64::INFINITY).contains(&chord(before, [r, z])) {
                return refuse(
                    row,
                    "z must not fall from the axis to the edge: smooth the profile, or leave out points",
                );
            }
            while let [.., first, last] = hull[..]
                && chord(last, [r, z]) < chord(first, last)
            {
                hull.pop();
            }
            before = [r, z];
            hull.push(before);
        }
        let height = before[1] - origin[1];
        if height <= 0.0 {
            return refuse(points.len(), "z must rise from the axis to the edge");
        }
        let mut chords: Vec<[f64; 2]> = Vec::with_capacity(rest.len());
        let (mut corner, mut before) = (0, origin);
        for (i, &[r, z]) in rest.iter().enumerate() {
            let (from, to) = (hull[corner], hull[corner + 1]);
            let slope = chord(from, to);
            let allowed = (OF_HEIGHT * height).min(OF_POINT * (z - origin[1]));
            if z - from[1] - slope * (r - from[0]) > allowed {
                let falls =
                    |three: &[[f64; 2]]| chord(three[1], three[2]) < chord(three[0], three[1]);
                let all: Vec<[f64; 2]> = [origin].into_iter().chain(rest.iter().copied()).collect();
                let after = all[i..].windows(3).position(falls);
                return refuse(
                    i + after.map_or(1, |after| after + 2) + usize::from(on_axis),
                    "the slope is smaller than before: the profile must be convex; smooth it, or \
                     leave out points",
                );
            }
            chords.push([0.5 * (before[0] + r), slope]);
            corner += usize::from(r >= to[0]);
            before = [r, z];
        }
        let flat = chords.partition_point(|chord| chord[1] == 0.0);
        if flat > 0 {
            let edge = rest[flat - 1][0];
            let rounded = (edge - chords[flat - 1][0]).min(chords[flat][0] - edge);
            chords[flat - 1][0] = edge - rounded;
            if edge + rounded < chords[flat][0] {
                chords.insert(flat, [edge + rounded, chords[flat][1]]);
            }
        }
        let mut slopes = vec![[0.0, 0.0]];
        slopes.append(&mut chords);
        Ok(Self {
            slopes: slopes.into(),
            end: before[0],
        })
    }

    /// Returns the radius of the last point, m. A contact must be smaller.
    pub const fn end(&self) -> f64 {
        self.end
    }

    /// Returns the radius of the flat end, m, at which the slope begins to rise; 0 for a shape that rises from the axis.
    pub fn flat_end(&self) -> f64 {
        let flat = self.slopes.partition_point(|bend| bend[1] == 0.0);
        self.slopes[flat - 1][0]
    }

    /// Returns the slope at a radius (m).
    pub fn slope(&self, r: f64) -> f64 {
        let last = self.slopes.len() - 1;
        let i = self
            .slopes
            .partition_point(|bend| bend[0] <= r)
            .clamp(1, last);
        let [before, after] = [self.slopes[i - 1], self.slopes[i]];
        before[1] + (after[1] - before[1]) * (r - before[0]) / (after[0] - before[0])
    }

    /// Returns the radii (m) at which the slope bends, ascending from 0, and the slopes there.
    pub fn slopes(&self) -> &[[f64; 2]] {
        &self.slopes
    }
}

/// Returns the slope of the straight line between two points.
fn chord([r0, z0]: [f64; 2], [r, z]: [f64; 2]) -> f64 {
    (z - z0) / (r - r0)
}
