//! Loads of a form of lookup against the true loads.

use interp::Quantities;

use super::{Family, Point, Row};
use crate::deviation::median_and_largest;
use crate::load::Load;

/// Returns the loads at these points.
pub fn loads(points: &[Point], quantities: &[Quantities]) -> Vec<Load> {
    points
        .iter()
        .zip(quantities)
        .map(|((_, material), quantities)| Load::new(quantities, material, 1.0))
        .collect()
}

/// The errors of a form, summed up over all points.
pub struct Errors {
    points: usize,
    median: f64,
    largest: f64,
    factor: f64,
    /// Median and largest, with adhesion that halves the load.
    adhesive: Option<[f64; 2]>,
}

impl Errors {
    /// Sums up the ratios of loads to the true loads.
    pub fn of_ratios(ratios: Vec<f64>) -> Self {
        let factor = largest(
            ratios
                .iter()
                .map(|&ratio| if ratio < 1.0 { 1.0 / ratio } else { ratio }),
        );
        let [median, largest] = sizes(ratios.iter().map(|ratio| ratio - 1.0));
        Self {
            points: ratios.len(),
            median,
            largest,
            factor,
            adhesive: None,
        }
    }

    /// Sums up the errors of the loads found.
    pub fn of_loads(found: &[Load], truth: &[Load]) -> Self {
        let ratios: Vec<[f64; 2]> = found
            .iter()
            .zip(truth)
            .map(|(f, t)| [f.press / t.press, f.pull / t.pull])
            .collect();
        // `(press - pull/2)/(1 - 1/2)`: with this work of adhesion, the adhesive part is half of
        // the true load without adhesion.
        let adhesive = sizes(ratios.iter().map(|[press, pull]| 2.0 * press - pull - 1.0));
        Self {
            adhesive: Some(adhesive),
            ..Self::of_ratios(ratios.into_iter().map(|[press, _]| press).collect())
        }
    }

    /// Returns the row of a form with these errors.
    pub fn row(
        &self,
        family: Family,
        form: &str,
        what: &str,
        seconds: f64,
        scope: &str,
        at: &str,
    ) -> Row {
        Row {
            family,
            form: form.to_owned(),
            what: what.to_owned(),
            seconds,
            scope: scope.to_owned(),
            points: self.points as u64,
            at: at.to_owned(),
            median_error: self.median,
            max_error: self.largest,
            max_factor: self.factor,
            adhesive_median_error: self.adhesive.map(|errors| errors[0]),
            adhesive_max_error: self.adhesive.map(|errors| errors[1]),
        }
    }
}

/// Returns the median and the largest absolute value. Values below half a unit of rounding count as
/// that.
fn sizes(errors: impl Iterator<Item = f64>) -> [f64; 2] {
    let size = |error: f64| {
        if error.abs() < 0.5 * f64::EPSILON {
            0.5 * f64::EPSILON
        } else {
            error.abs()
        }
    };
    median_and_largest(errors.map(size).collect())
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.max_by(f64::total_cmp).expect("there are points")
}
