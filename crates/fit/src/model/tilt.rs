//! The slope of a baseline that is free, read from the data: without it, contact and baseline cannot be told apart.

use super::Experiment;
use super::split::{FEWEST, KnownBaseline, tail};
use crate::statistics::{median, robust_deviation};

/// The most points of an end: the lines through all pairs of them are compared.
const MOST: usize = 60;
/// The noise up to which the end of a way departs from a straight line.
const STRAIGHT: f64 = 6.0;
/// The part of the slope at the largest contacts up to which a straight end is a baseline, and no contact.
const SMALL: f64 = 0.3;

impl Experiment {
    /// Returns the slope of the baseline: first from the ends of the ways, and from there from all points that they have
    /// on the baseline. Where the ends are not straight it is that of the experiment.
    pub(super) fn tilt(&self, ways: &[Vec<usize>], baseline: KnownBaseline) -> f64 {
        let all = ways.iter().filter(|way| way.len() >= FEWEST);
        let ends = all.clone().map(|way| way.len() - tail(way.len()));
        let middle = |begins: &mut dyn Iterator<Item = usize>| {
            let pairs = all.clone().zip(begins);
            let slopes =
                pairs.filter_map(|(way, begin)| self.slope_of_end(way, begin, baseline.noise));
            let slopes: Vec<f64> = slopes.collect();
            (!slopes.is_empty()).then(|| median(slopes))
        };
        let Some(first) = middle(&mut ends.clone()) else {
            return self.baseline_slope;
        };
        let mut begins = all
            .clone()
            .map(|way| baseline.split(&self.readings(way, first))[1]);
        middle(&mut begins).unwrap_or(first)
    }

    /// Returns the slope of the points of a way from the number `begin` on, if they may be a baseline.
    fn slope_of_end(&self, way: &[usize], begin: usize, noise: f64) -> Option<f64> {
        let slope = self.slope(&way[begin..])?;
        let rest = self.readings(&way[begin..], slope);
        let level = median(rest.clone());
        let scatter = robust_deviation(rest.iter().map(|y| y - level));
        let of_contact = self.slope(&way[..tail(way.len())])?;
        (scatter <= STRAIGHT * noise && slope.abs() <= SMALL * of_contact.abs()).then_some(slope)
    }

    /// Returns the median of the slopes through all pairs of points (Theil and Sen), which bears outliers.
    fn slope(&self, numbers: &[usize]) -> Option<f64> {
        let points = &self.measurement.points;
        let stride = numbers.len().div_ceil(MOST).max(1);
        let few: Vec<usize> = numbers.iter().copied().step_by(stride).collect();
        let mut slopes = Vec::new();
        for (n, &i) in few.iter().enumerate() {
            for &j in &few[n + 1..] {
                let distance = points[j].abscissa - points[i].abscissa;
                if distance != 0.0 {
                    slopes.push((points[j].ordinate - points[i].ordinate) / distance);
                }
            }
        }
        (few.len() >= FEWEST && !slopes.is_empty()).then(|| median(slopes))
    }
}
