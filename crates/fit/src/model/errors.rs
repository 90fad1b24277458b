//! The standard deviations of measured points, in both quantities.
//!
//! An error of the abscissa counts as one of the ordinate, by the change of the model: the effective
//! variance is `sigma_y^2 + (dy/dx)^2 sigma_x^2` (Orear, Am. J. Phys. 50, 912, 1982) with the mean square of
//! the change in place of `(dy/dx)^2 sigma_x^2`, so that a point at which the model has no slope is not
//! taken for exact. The slope is that where the point most likely lies. At the abscissa read, weight and error would go
//! together: where an abscissa is read too small on a curve that steepens, the slope is too small and the weight too large.

use super::differences::ContactOf;
use super::{Branch, Experiment};
use crate::Error;
use crate::statistics::median;

/// The step of an abscissa over its standard deviation, at which Hermite's and Gauss' rule of three nodes
/// takes the change of the model; the square of the change at each side has a sixth of the weight.
const STEP: f64 = 1.732_050_807_568_877_2;

/// The largest distance, in standard deviations of the abscissa, at which a point is taken to lie from where it was read. If
/// the model asks for a larger one, it is taken to lie the nearer, the larger that is.
const FARTHEST: f64 = 3.0;

/// What the error of an abscissa does to a point.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct AbscissaError {
    /// What it adds to the standard deviation of the ordinate. Where errors of neighbours are alike it is larger than that of
    /// the point alone, so that means over neighbours have their true errors.
    pub part: f64,
    /// What it adds to the standard deviation of the ordinate of the point alone.
    pub alone: f64,
    /// From its abscissa to where the point most likely lies, in the unit of the abscissa.
    pub shift: f64,
    /// The slope of the model there.
    pub slope: f64,
    /// The speed of the contact line where it most likely is less the one that was read, m/s.
    pub speed_shift: f64,
    /// The slope of the model over the speed.
    pub speed_slope: f64,
}

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

    /// Tells whether no abscissa has an error that is known.
    pub(crate) fn has_exact_abscissae(&self) -> bool {
        self.abscissa_noise == 0.0 && self.errors.abscissa.is_empty()
    }

    /// Returns the standard deviation of the abscissa of a point.
    pub(crate) fn abscissa_deviation(&self, i: usize) -> f64 {
        self.errors
            .abscissa
            .get(i)
            .copied()
            .unwrap_or(self.abscissa_noise)
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

    /// Returns what the errors of the abscissa and of the speed of the contact line do to each point; an empty list where
    /// adhesion does not depend on the speed and the abscissae are exact.
    ///
    /// With the change `c` of the model over one standard deviation `sigma_v` of the speed and the reading `r` above the
    /// model, the speed most likely is the one read plus
    ///
    /// ```text
    /// r c sigma_v/(sigma_y^2 + part_v^2 + part_a^2)
    /// ```
    ///
    /// where `part_v` and `part_a` are what the errors of speed and abscissa add to the standard deviation `sigma_y` of the
    /// ordinate. The shift is at most half of the speed.
    pub(crate) fn abscissa_errors(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
        order: &[usize],
        noise: impl Fn(usize) -> f64,
    ) -> Result<Vec<AbscissaError>, Error> {
        if !self.has_line_law() {
            return self.errors_of_abscissae(contact_of, branches, order, noise);
        }
        let here = self.predict_with(contact_of, branches, order, &[])?.values;
        let [alone, together] = self.errors_of_line_speeds(contact_of, branches, order, &here)?;
        let beside_speeds = |i: usize| noise(i).hypot(alone[i][0]);
        let mut errors = self.errors_of_abscissae(contact_of, branches, order, beside_speeds)?;
        errors.resize(here.len(), AbscissaError::default());
        for (i, error) in errors.iter_mut().enumerate() {
            let line = self.line_speeds[i];
            let ([part_alone, by_speed], [part_of_mean, _]) = (alone[i], together[i]);
            // At the speed that was read, slopes and derivatives would be correlated with its error, as at a radius.
            let variance = beside_speeds(i).powi(2) + error.part.powi(2);
            let shift = (self.compared(i) - here[i]) * by_speed / variance;
            if line.deviation > 0.0 && line.deviation.is_finite() && shift.is_finite() {
                let far = (shift.abs() / FARTHEST).max(1.0);
                // The direction of the line does not change.
                let most = 0.5 * line.speed.abs();
                error.speed_shift = (shift / (far * far) * line.deviation).clamp(-most, most);
                error.speed_slope = by_speed / line.deviation;
            }
            let of_point = (part_alone * line.misfit.max(1.0).sqrt()).min(part_of_mean);
            error.alone = error.part.hypot(of_point);
            error.part = error.part.hypot(part_of_mean);
        }
        Ok(errors)
    }

    /// Returns what the error of the abscissa does to each point; an empty list where the abscissae are exact. The part of
    /// the standard deviation is the root mean square of the change of the model: of a straight line it is
    /// `|dy/dx| sigma_x`, and of a parabola it is exact, too. `noise` returns the standard deviation of an ordinate
    /// without it.
    ///
    /// The points are moved, and their branches kept. With the slope `b` and half the curvature `c` at the abscissa `x`,
    /// and the reading `r` above the model there, the point most likely lies at `x + d`:
    ///
    /// ```text
    /// d = r b sigma_x^2/(sigma_y^2 + b^2 sigma_x^2)        part^2 = sigma_x^2 ((b + 2 c d)^2 + 3 c^2 sigma_x^2)
    /// ```
    fn errors_of_abscissae(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
        order: &[usize],
        noise: impl Fn(usize) -> f64,
    ) -> Result<Vec<AbscissaError>, Error> {
        if self.has_exact_abscissae() {
            return Ok(Vec::new());
        }
        let points = &self.measurement.points;
        let is_relative = !self.measurement.kind.at_positions();
        let deviation = |i: usize| self.abscissa_deviation(i);
        // No radius, load or depth changes its sign.
        let most = |i: usize| {
            if is_relative {
                0.5 * points[i].abscissa
            } else {
                f64::INFINITY
            }
        };
        let step = |i: usize| (STEP * deviation(i)).min(most(i));
        let here = self.predict_with(contact_of, branches, order, &[])?.values;
        // The contact at the turn is that of the point of the largest imposed value, and the others
        // do not move it. Its own change is that of its neighbour.
        let turn = order.first().copied().filter(|_| !is_relative);
        let moved = |by: f64| {
            let mut moved = self.clone();
            for (i, point) in moved.measurement.points.iter_mut().enumerate() {
                if Some(i) != turn {
                    point.abscissa += by * step(i);
                }
            }
            moved.predict_with(contact_of, branches, order, &[])
        };
        // At the end of a table one side has no contact, and the other one stands for both.
        let sides = match (moved(1.0), moved(-1.0)) {
            (Ok(above), Ok(below)) => [above.values, below.values],
            (Ok(one), Err(_)) | (Err(_), Ok(one)) => [one.values.clone(), one.values],
            (Err(error), Err(_)) => return Err(error),
        };
        let error = |i: usize| {
            let neighbour = order.get(1).filter(|_| Some(i) == turn);
            let k = neighbour.copied().unwrap_or(i);
            let width = step(k);
            if width == 0.0 {
                return AbscissaError::default();
            }
            let [above, below] = sides.each_ref().map(|side| side[k] - here[k]);
            let [odd, even] = [0.5 * (above - below), 0.5 * (above + below)];
            let (by_error, read) = (odd / width * deviation(k), self.compared(k) - here[k]);
            let shift = read * by_error / (noise(k).powi(2) + by_error * by_error);
            // There is none without a reading, and without noise and slope.
            let shift = if shift.is_nan() { 0.0 } else { shift };
            // A reading that is far from the model does not tell where the point lies: the model is wrong, or the reading.
            let far = (shift.abs() / FARTHEST).max(1.0);
            let shift = (shift / (far * far) * deviation(k)).clamp(-most(k), most(k));
            let change = odd + 2.0 * even * shift / width;
            let part = change.hypot(even) / width * deviation(i);
            AbscissaError {
                part,
                alone: part,
                shift,
                slope: change / width,
                ..AbscissaError::default()
            }
        };
        Ok((0..points.len()).map(error).collect())
    }
}
