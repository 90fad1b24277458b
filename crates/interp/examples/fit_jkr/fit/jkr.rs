//! The fit of JKR, without a film, whose parameters follow from straight lines. It gives the start
//! values of the fit with a film.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::data::{Against, Data};

/// The homogeneous contact that describes the data best.
#[derive(Clone, Copy, Debug)]
pub struct Homogeneous {
    /// The compound modulus `E*`, Pa.
    pub modulus: f64,
    /// The work of adhesion, J/m^2.
    pub work_of_adhesion: f64,
    /// The offset of the load (N) if it was measured against the contact radius, else of the
    /// penetration (m). It is 0 unless it is fitted.
    pub offset: f64,
}

impl Homogeneous {
    /// Fits by least squares in the JKR plot or, without contact radii, in the penetration.
    pub fn fit(data: &Data, radius: f64, offset: bool) -> Result<Self, String> {
        let found = match data.against {
            Against::ContactRadius => Self::of_radii(data, radius, offset),
            Against::Penetration => Self::of_penetrations(data, radius, offset),
        };
        found
            .filter(|found| found.modulus > 0.0 && found.modulus.is_finite())
            .ok_or_else(|| {
                "JKR finds no positive modulus in these data: check their units and signs".into()
            })
    }

    /// Fits the straight line of eq. 1. With an offset of the load it is
    /// `F = 4 E*/(3 R) a^3 - sqrt(8 pi w E*) a^{3/2} + F0`, weighted as in the JKR plot.
    fn of_radii(data: &Data, radius: f64, offset: bool) -> Option<Self> {
        let rows = data.points.iter().map(|(a, load)| {
            let power = a * a.sqrt();
            ([power, 1.0, 1.0 / power], load / power)
        });
        let [slope, intercept, offset] = least_squares(rows, if offset { 3 } else { 2 })?.0;
        let modulus = 0.75 * radius * slope;
        Some(Self {
            modulus,
            work_of_adhesion: intercept * intercept / (8.0 * PI * modulus),
            offset,
        })
    }

    /// Fits a straight line for each `w`, and searches for the best `w`.
    ///
    /// For a given `w`, JKR's contact radius and penetration at a load are `E*^{-1/3} b` and
    /// `E*^{-2/3} (b^2/R - sqrt(2 pi b w))`, with a `b` that does not depend on `E*`.
    fn of_penetrations(data: &Data, radius: f64, offset: bool) -> Option<Self> {
        let fit = |work: f64| {
            let pull = 3.0 * PI * work * radius;
            let rows = data.points.iter().map(|&(penetration, load)| {
                let b = (0.75 * radius * (load + pull + (2.0 * pull * load + pull * pull).sqrt()))
                    .cbrt();
                (
                    [b * b / radius - (2.0 * PI * b * work).sqrt(), 1.0, 0.0],
                    penetration,
                )
            });
            least_squares(rows, if offset { 2 } else { 1 })
        };
        let misfit = |logarithm: f64| fit(logarithm.exp()).map_or(f64::INFINITY, |(_, sum)| sum);
        let extreme = |sign: f64| {
            data.points
                .iter()
                .map(|point| sign * point.1)
                .fold(0.0, f64::max)
        };
        // No load is below the pull-off load, -3/2 pi w R.
        let least = (extreme(-1.0) / (1.5 * PI * radius)).max(1e-6 * extreme(1.0) / (PI * radius));
        let step = 0.1;
        let at = |i: i32| least.ln() + step * f64::from(i);
        let best = (0..140).min_by(|&i, &j| misfit(at(i)).total_cmp(&misfit(at(j))))?;
        let work_of_adhesion = minimum(at(best) - step, at(best) + step, misfit).exp();
        let [power, offset, _] = fit(work_of_adhesion)?.0;
        Some(Self {
            modulus: power.powf(-1.5),
            work_of_adhesion,
            offset,
        })
    }
}

/// Returns the least-squares solution with the first `count` columns, 0 for the other columns, and
/// the sum of the squares; `None` if a row is not finite.
fn least_squares(
    rows: impl Iterator<Item = ([f64; 3], f64)>,
    count: usize,
) -> Option<([f64; 3], f64)> {
    let (rows, right): (Vec<[f64; 3]>, Vec<f64>) = rows.unzip();
    let mut matrix = DMatrix::from_fn(rows.len(), count, |i, j| rows[i][j]);
    let right = DVector::from_vec(right);
    if !matrix
        .iter()
        .chain(right.iter())
        .all(|value| value.is_finite())
    {
        return None;
    }
    // The columns are scaled to length 1, because their units are very different.
    let units: Vec<f64> = matrix
        .column_iter()
        .map(|column| column.norm().max(f64::MIN_POSITIVE))
        .collect();
    matrix
        .column_iter_mut()
        .zip(&units)
        .for_each(|(mut column, unit)| column /= *unit);
    let solution = matrix
        .clone()
        .svd(true, true)
        .solve(&right, f64::EPSILON)
        .ok()?;
    let sum = (&matrix * &solution - right).norm_squared();
    let mut values = [0.0; 3];
    values
        .iter_mut()
        .zip(solution.iter().zip(&units))
        .for_each(|(value, (solution, unit))| *value = solution / unit);
    Some((values, sum))
}

/// Returns the point at which a function has its minimum, by golden section.
fn minimum(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    for _ in 0..40 {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if f(left) < f(right) {
            high = right
        } else {
            low = left
        }
    }
    0.5 * (low + high)
}
