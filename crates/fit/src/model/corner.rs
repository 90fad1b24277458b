//! The corner between a contact and a baseline that is shorter than the end which is looked at first.

use nalgebra::{SMatrix, SVector};

use super::split::FEWEST;
use crate::statistics::{BEYOND_CHANCE, excess, median, range};

/// The terms of a smooth course, and of a contact with its level.
const TERMS: usize = 5;
/// The fewest readings that can be told from a smooth course, and the most means of neighbours that are compared.
const SHORTEST: usize = 4 * FEWEST;
const MOST: usize = 96;
/// The fall of the sum of squares, over the variance of the noise, by which a corner describes readings better than a
/// smooth course: far more than chance makes of the best one of all places.
const CLEAR: f64 = 25.0;

/// The distance from the baseline, over the range of all readings, up to which a reading is near it.
const NEAR: f64 = 0.05;
/// The part of the readings of a contact that are near its baseline is smaller. Drifts and waves of a long baseline have
/// corners, too, and what lies before these stays near.
const STAYING: f64 = 0.3;

/// Returns how many of the last `readings` are level, if a cubic that begins there, at a corner or a step, describes the
/// readings before them to their `noise`, and a polynomial through all of them does not. A contact that ends smoothly, as
/// at its largest tension, has no corner.
pub(super) fn level_after_corner(readings: &[f64], noise: f64) -> Option<usize> {
    if noise <= 0.0 {
        return None;
    }
    let leaves = |level: usize| {
        let (contact, baseline) = readings.split_at(readings.len() - level);
        let [middle, near] = [
            median(baseline.to_vec()),
            NEAR * range(readings.iter().copied()),
        ];
        let staying = contact
            .iter()
            .filter(|reading| (*reading - middle).abs() < near);
        (staying.count() as f64) < STAYING * contact.len() as f64
    };
    let halves = std::iter::successors(Some(readings.len()), |length| Some(length / 2));
    let mut lengths = halves.take_while(|length| *length >= SHORTEST);
    lengths.find_map(|length| {
        let block = length.div_ceil(MOST);
        let mean = |block: &[f64]| block.iter().sum::<f64>() / block.len() as f64;
        // From the last one on, in standard deviations.
        let means = readings.rchunks_exact(block).take(length / block);
        let deviation = noise / (block as f64).sqrt();
        let means: Vec<f64> = means.map(|block| mean(block) / deviation).collect();
        let smooth = squares(&means, |u| [1.0, u, u.powi(2), u.powi(3), u.powi(4)])?;
        let behind = |level: usize| {
            let begins = (level as f64 - 0.5) / means.len() as f64;
            let contact = |s: f64| [1.0, 1.0, s, s.powi(2), s.powi(3)];
            let terms = |u| {
                if u < begins {
                    [1.0, 0.0, 0.0, 0.0, 0.0]
                } else {
                    contact(u - begins)
                }
            };
            Some((level, squares(&means, terms)?))
        };
        let levels = (FEWEST..=means.len() / 2).filter_map(behind);
        let (level, least) = levels.min_by(|(_, one), (_, other)| one.total_cmp(other))?;
        let is_described = excess(least, (means.len() - TERMS) as f64) < BEYOND_CHANCE;
        let is_corner = is_described && smooth - least > CLEAR;
        (is_corner && leaves(level * block)).then_some(level * block)
    })
}

/// Returns the least sum of squared residuals of a sum of `terms`, which are functions of the number of a reading over the
/// count of them.
fn squares(readings: &[f64], terms: impl Fn(f64) -> [f64; TERMS]) -> Option<f64> {
    // Less the first one, so that large readings are not rounded.
    let first = *readings.first()?;
    let rows = readings.iter().enumerate().map(|(i, reading)| {
        let row = SVector::from(terms(i as f64 / readings.len() as f64));
        (row, reading - first)
    });
    let mut normal = SMatrix::<f64, TERMS, TERMS>::zeros();
    let mut right = SVector::<f64, TERMS>::zeros();
    for (row, reading) in rows.clone() {
        normal += row * row.transpose();
        right += row * reading;
    }
    let found = normal.cholesky()?.solve(&right);
    let residuals = rows.map(|(row, reading)| reading - row.dot(&found));
    Some(residuals.map(|residual| residual * residual).sum())
}

#[cfg(test)]
mod tests {
    use super::level_after_corner;

    /// Returns Hertz's contact, 10,000 noises high, and the readings behind it.
    fn readings(behind: impl Iterator<Item = f64>) -> Vec<f64> {
        let contact = (1..=400)
            .rev()
            .map(|i| 1e4 * (f64::from(i) / 400.0).powf(1.5));
        contact.chain(behind).collect()
    }

    #[test]
    fn a_short_level_behind_a_contact_is_found() {
        let level = level_after_corner(&readings([0.0; 60].into_iter()), 1.0).expect("a corner");
        assert!((50..70).contains(&level), "{level}");
        assert_eq!(
            level_after_corner(&readings([0.0; 60].into_iter()), 0.0),
            None
        );
    }

    /// A long baseline that drifts by 200 noises and comes to rest has a corner, too.
    #[test]
    fn where_a_drift_ends_is_no_contact() {
        let drift = (0..600).map(|i| 200.0 * (f64::from(540 - i) / 200.0).clamp(0.0, 1.0));
        assert_eq!(level_after_corner(&readings(drift), 1.0), None);
    }
}
