//! The standard deviations of measured points, in both quantities.
//!
//! An error of the abscissa counts as one of the ordinate, by the slope of the model there: the
//! effective variance is `sigma_y^2 + (dy/dx)^2 sigma_x^2` (Orear, Am. J. Phys. 50, 912, 1982).

use super::differences::ContactOf;
use super::{Branch, Experiment};
use crate::Error;
use crate::statistics::{extremes, median};

/// The step of an abscissa by which the slope of the model is found, relative to a contact radius,
/// or to the range of penetrations or heights.
const STEP: f64 = 1e-4;

/// Standard deviations that differ from point to point, in the order of the points. An empty list
/// leaves those of the [`Experiment`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointErrors {
    /// Those of the abscissae, m; 0 is exact.
    pub abscissa: Vec<f64>,
    /// Those of the ordinates, in N or m; of a contact stiffness in N/m.
    pub ordinate: Vec<f64>,
}

impl Experiment {
    /// Returns the standard deviation of a usual ordinate, if it is known.
    pub(crate) fn usual_noise(&self) -> Option<f64> {
        if self.errors.ordinate.is_empty() {
            return self.noise;
        }
        let own = (0..self.errors.ordinate.len()).filter_map(|i| self.own_deviation(i));
        Some(median(own.collect()))
    }

    /// Returns the standard deviation of a usual ordinate, which must be known.
    pub(crate) fn known_noise(&self) -> Result<f64, Error> {
        let allowed = "given, positive and finite";
        self.usual_noise()
            .ok_or_else(|| self.wrong_setting("the noise", f64::NAN, allowed))
    }

    /// Returns the standard deviation of a usual abscissa; 0 if they are exact.
    pub(crate) fn usual_abscissa_noise(&self) -> f64 {
        if self.errors.abscissa.is_empty() {
            return self.abscissa_noise;
        }
        median(self.errors.abscissa.clone())
    }

    /// Accepts the standard deviations.
    pub(crate) fn accept_errors(&self) -> Result<(), Error> {
        let [abscissa, ordinate] = self.measurement.kind.names();
        let is_positive = |noise: f64| noise > 0.0 && noise.is_finite();
        let is_possible = |noise: f64| noise >= 0.0 && noise.is_finite();
        if let Some(noise) = self.noise.filter(|noise| !is_positive(*noise)) {
            return Err(self.wrong_setting("the noise", noise, "positive and finite"));
        }
        if !is_possible(self.abscissa_noise) {
            let what = format!("the noise of the {abscissa}");
            return Err(self.wrong_setting(what, self.abscissa_noise, ">= 0 and finite"));
        }
        let points = &self.measurement.points;
        let lists = [
            (&self.errors.abscissa, abscissa, true),
            (&self.errors.ordinate, ordinate, false),
        ];
        for (list, quantity, may_be_exact) in lists {
            if list.is_empty() {
                continue;
            }
            if list.len() != points.len() {
                let what = format!("the number of errors of the {quantity}");
                let allowed = format!("0, or that of the points, {}", points.len());
                return Err(self.wrong_setting(what, list.len() as f64, allowed));
            }
            for (&error, point) in list.iter().zip(points) {
                if !(is_positive(error) || may_be_exact && error == 0.0) {
                    let allowed = "a standard deviation: finite, positive for an ordinate, 0 or \
                                   positive for an abscissa";
                    let what = "the error of the point";
                    return Err(self.refused(point.line, what, error, allowed));
                }
            }
        }
        Ok(())
    }

    /// Returns what the errors of the abscissae add to the standard deviation of each ordinate,
    /// `|dy/dx| sigma_x`; an empty list where the abscissae are exact.
    ///
    /// The slope is a central difference of the model: its points are moved, and their branches
    /// kept.
    pub(crate) fn abscissa_parts(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
        order: &[usize],
    ) -> Result<Vec<f64>, Error> {
        if self.abscissa_noise == 0.0 && self.errors.abscissa.is_empty() {
            return Ok(Vec::new());
        }
        let points = &self.measurement.points;
        let at_radii = self.measurement.kind.at_radii();
        let is_relative = at_radii || self.measurement.kind.is_stiffness();
        let [least, most] = extremes(points.iter().map(|point| point.abscissa));
        let step = |i: usize| {
            STEP * if is_relative {
                points[i].abscissa
            } else {
                most - least
            }
        };
        let here = || {
            let here = self.predict_with(contact_of, branches, order, None)?;
            Ok::<_, Error>(here.values)
        };
        // The contact at the turn is that of the point of the largest imposed value, and the others
        // do not move it. Its own slope is that of its neighbour.
        let turn = order.first().copied().filter(|_| !is_relative);
        let moved = |by: f64| {
            let mut moved = self.clone();
            for (i, point) in moved.measurement.points.iter_mut().enumerate() {
                if Some(i) != turn {
                    point.abscissa += by * step(i);
                }
            }
            moved.predict_with(contact_of, branches, order, None)
        };
        // At the end of a table one side has no contact.
        let (above, below, steps) = match (moved(1.0), moved(-1.0)) {
            (Ok(above), Ok(below)) => (above.values, below.values, 2.0),
            (Ok(above), Err(_)) => (above.values, here()?, 1.0),
            (Err(_), Ok(below)) => (here()?, below.values, 1.0),
            (Err(error), Err(_)) => return Err(error),
        };
        let slope = |i: usize| {
            let neighbour = order.get(1).filter(|_| Some(i) == turn);
            let i = neighbour.copied().unwrap_or(i);
            let width = steps * step(i);
            if width > 0.0 {
                ((above[i] - below[i]) / width).abs()
            } else {
                0.0
            }
        };
        let errors = &self.errors.abscissa;
        let deviation = |i: usize| errors.get(i).copied().unwrap_or(self.abscissa_noise);
        Ok((0..points.len()).map(|i| slope(i) * deviation(i)).collect())
    }
}
