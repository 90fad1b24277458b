//! A measured shape of a probe.

use std::sync::Arc;

use crate::Error;

/// The largest number of points of a profile.
const MOST_POINTS: usize = 200;
/// The part by which a slope may fall below the slope before it, for the rounding of text.
const ROUNDING: f64 = 1e-9;

/// The measured shape of a probe with rotational symmetry, as points `(r, z)`.
///
/// The points are smoothed by this rule: the slope `dz/dr` is 0 on the axis, it is that of the straight
/// line between two points midway between them, and it is a linear function of `r` in between. Beyond the last middle it continues linearly to the
/// last point. So the slope is continuous, the shape is convex if the points are, and evenly
/// spaced points of a paraboloid give the paraboloid.
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
    /// than the one before, because a contact is one disc under a convex shape only; and for fewer
    /// than 2 or more than 200 points.
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
        let mut chords: Vec<[f64; 2]> = Vec::with_capacity(rest.len());
        let mut before = origin;
        for (i, &[r, z]) in rest.iter().enumerate() {
            let row = i + 1 + usize::from(on_axis);
            if !(r.is_finite() && z.is_finite() && origin[1].is_finite()) {
                return refuse(row, "r and z must be finite");
            }
            if r <= before[0] {
                return refuse(row, "r must be positive and larger than in the row before");
            }
            let slope = (z - before[1]) / (r - before[0]);
            if !(slope >= 0.0 && slope.is_finite()) {
                return refuse(row, "z must not fall from the axis to the edge");
            }
            let steepest = chords.last().map_or(0.0, |chord| chord[1]);
            if slope < steepest * (1.0 - ROUNDING) {
                return refuse(
                    row,
                    "the slope is smaller than before: the profile must be convex; smooth it, or \
                     leave out points",
                );
            }
            chords.push([0.5 * (before[0] + r), slope.max(steepest)]);
            before = [r, z];
        }
        if before[1] <= origin[1] {
            return refuse(points.len(), "z must rise from the axis to the edge");
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evenly_spaced_points_of_a_paraboloid_give_the_paraboloid() {
        let points: Vec<[f64; 2]> = (0..20)
            .map(|i| 1e-7 * f64::from(i))
            .map(|r| [r, r * r / 2e-6])
            .collect();
        let profile = Profile::new(&points).expect("convex");
        for &[r, slope] in profile.slopes() {
            assert!((slope - r / 1e-6).abs() < 1e-12, "{r}: {slope}");
        }
        assert_eq!(profile.end(), points[19][0]);
        let without_origin = Profile::new(&points[1..]).expect("convex");
        assert_eq!(without_origin, profile);
    }

    #[test]
    fn errors_name_the_row() {
        let row = |points: &[[f64; 2]]| match Profile::new(points) {
            Err(Error::Profile { row, .. }) => row,
            other => panic!("{other:?}"),
        };
        assert_eq!(row(&[]), 0);
        assert_eq!(row(&[[0.0, 0.0]]), 1);
        assert_eq!(row(&[[0.0, 0.0], [1.0, 1.0], [2.0, 1.5]]), 3);
        assert_eq!(row(&[[0.0, 0.0], [1.0, 1.0], [1.0, 2.5]]), 3);
        assert_eq!(row(&[[1.0, 1.0], [2.0, f64::NAN]]), 2);
        assert_eq!(row(&[[0.0, 0.0], [1.0, -1.0]]), 2);
        assert_eq!(row(&[[0.0, 1.0], [1.0, 1.0]]), 2);
        assert_eq!(row(&[[-1.0, 1.0], [1.0, 2.0]]), 1);
        let many: Vec<[f64; 2]> = (0..201)
            .map(|i| [f64::from(i), f64::from(i).powi(2)])
            .collect();
        assert_eq!(row(&many), 201);
    }
}
