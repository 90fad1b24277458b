//! Adhesion that depends on the speed of the contact line: the speeds, from contact radii in time, and the work of
//! adhesion at them.

use std::borrow::Cow;

use contact::{Contact, RateDependent};
use nalgebra::{Matrix4, Vector4};

use super::assign::noise_of;
use super::differences::ContactOf;
use super::{Branch, Experiment, Kind, Parameter, Point, Solver};
use crate::Error;
use crate::statistics::{differences_of, median, range};

/// The fewest points on each side of one whose speed is read.
const FEWEST: usize = 3;
/// The change of the radius, in its standard deviations, over which a speed is read.
const SPAN: f64 = 20.0;
/// A speed is read from at most one in `PART` of the points of its way on each side, and from at most `MOST`.
const PART: usize = 4;
const MOST: usize = 1000;
/// The share of neighbouring radii that are equal above which radii count as rounded, as to the pixels of an image, and
/// the standard deviation of rounding over its step, `1/sqrt(12)`.
const ROUNDED: f64 = 0.25;
const OF_ROUNDING: f64 = 0.289;
/// The rate of a load or penetration from a point to the next, over the largest other one within [`FEWEST`] points, from which
/// on the change is a sudden step.
const SUDDEN: f64 = 5.0;
/// The speed of the line over such steps, over that just before them, from which on it has changed by them.
const FASTER: f64 = 1.5;
/// The steps of a speed, in its standard deviations, over which the change of the model is taken.
const STEPS: [f64; 2] = [1.0, 3.0];
/// What a fit needs of the two numbers of the law.
const BOTH: &str = "positive and finite: a work of adhesion that depends on the speed of the contact line has a doubling-speed \
     and a speed-exponent, each given or free";

/// The speed of a contact line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineSpeed {
    /// The speed, m/s, positive where the line recedes.
    pub speed: f64,
    /// Its standard deviation, m/s; 0 is exact, and infinity one that is not known. A fit leaves such points out.
    pub deviation: f64,
    /// The factor by which the variance of the speed is larger because the course of the radii is no cubic. Up to 1, as the
    /// default 0, it stands for none.
    pub misfit: f64,
    /// The factor by which the variance of a mean over neighbouring points is larger than with independent errors of
    /// their speeds, which are read from the same radii. Up to 1, as the default 0, it stands for independent errors.
    pub alike: f64,
}

impl LineSpeed {
    /// Returns the standard deviation with which a mean over neighbours whose errors are alike has its true error.
    fn deviation_of_mean(&self) -> f64 {
        self.deviation * (self.misfit.max(1.0) * self.alike.max(1.0)).sqrt()
    }
}

impl Experiment {
    /// Tells whether the work of adhesion depends on the speed of the contact line.
    pub(crate) const fn has_line_law(&self) -> bool {
        self.doubling_speed.is_some() || self.speed_exponent.is_some()
    }

    /// Tells whether such a law could be fitted, and none is: loads or penetrations at contact radii in time.
    pub fn may_have_line_law(&self) -> bool {
        !self.times.is_empty() && !self.has_line_law() && self.why_without_line_speed().is_none()
    }

    /// Returns why a number of the law has no effect on this experiment, if it has none.
    pub(super) fn why_without_line_speed(&self) -> Option<&'static str> {
        let kind = self.measurement.kind;
        if !matches!(kind, Kind::LoadRadius | Kind::PenetrationRadius) {
            return Some(
                "the speed of the contact line is read from contact radii in time, with loads or penetrations",
            );
        }
        matches!(self.bodies.solver, Solver::Stick { .. }).then_some(
            "with full friction the contact depends on its history, and adhesion that depends on the speed is fitted without \
             friction only",
        )
    }

    /// Accepts the law and what tells the speeds.
    pub(super) fn accept_line_law(&self) -> Result<(), Error> {
        if !self.has_line_law() {
            return Ok(());
        }
        for parameter in Parameter::OF_LINE {
            if let Some(reason) = self.why_without_line_speed() {
                return Err(self.not_applicable(parameter, reason));
            }
            let value = self.get(parameter).unwrap_or(f64::NAN);
            if !(value > 0.0 && value.is_finite()) {
                return Err(self.wrong_setting(parameter, value, BOTH));
            }
        }
        let count = self.measurement.points.len();
        if self.line_speeds.is_empty() {
            self.accept_times()?;
        } else if self.line_speeds.len() != count {
            let allowed = format!("0, or that of the points, {count}");
            let what = "the number of speeds of the contact line";
            return Err(self.wrong_setting(what, self.line_speeds.len() as f64, allowed));
        }
        let points = self.measurement.points.iter();
        for (point, one) in points.zip(&self.line_speeds) {
            let (line, name) = (point.line, "speed of the contact line");
            if !one.speed.is_finite() {
                return Err(self.refused(line, name, one.speed, "finite"));
            }
            if one.deviation.is_nan() || one.deviation < 0.0 {
                let allowed = "a standard deviation that is >= 0";
                return Err(self.refused(line, name, one.deviation, allowed));
            }
        }
        Ok(())
    }

    /// Returns the speed of the contact line at each point: those of
    /// [`Experiment::line_speeds`], or those that the radii and the times show.
    ///
    /// Each is the slope of a cubic through the radii of neighbours in time: so many on each side that the radius
    /// changes by 20 of its standard deviations, but at most a quarter of the points of the way (successive points in contact
    /// with one direction, up to a sudden step of the load or penetration), and at most 1000. So its standard error is some
    /// 10 % where the line moves. The standard deviation of a radius is the known one, or the one that neighbours show; where
    /// the radii are no cubic, [`LineSpeed::misfit`] tells their residuals. At the first and last three points of a way a
    /// slope would depend on how the radii bend: the standard deviation of the speed is infinite there.
    pub(crate) fn speeds_of_line(&self) -> Cow<'_, [LineSpeed]> {
        let points = &self.measurement.points;
        if self.line_speeds.len() == points.len() || self.times.len() != points.len() {
            return Cow::Borrowed(&self.line_speeds);
        }
        let mut speeds = vec![LineSpeed::default(); points.len()];
        let in_contact: Vec<usize> = (0..points.len())
            .filter(|&i| points[i].abscissa > 0.0)
            .collect();
        // A line that has vanished between two points begins anew.
        let same =
            |i: &usize, j: &usize| *j == i + 1 && points[*i].direction == points[*j].direction;
        for way in in_contact.chunk_by(same) {
            for part in self.between_steps(way) {
                self.read_speeds(part, &mut speeds);
            }
        }
        Cow::Owned(speeds)
    }

    /// Keeps the speeds that the radii show as they were read, wherever a fit then takes the points to lie.
    pub(crate) fn keep_line_speeds(&mut self) {
        if self.has_line_law() {
            self.line_speeds = self.speeds_of_line().into_owned();
        }
    }

    /// Returns the parts of a way between sudden steps of the load or penetration, after which the line moves much faster
    /// than before: no cubic describes both sides of one. Where it does not, as where loads are rounded, they are no steps.
    fn between_steps<'a>(&self, way: &'a [usize]) -> Vec<&'a [usize]> {
        let points = &self.measurement.points;
        let rates = |value: fn(&Point) -> f64| -> Vec<f64> {
            let change = |i: usize, j: usize| value(&points[j]) - value(&points[i]);
            let rate = |i, j| change(i, j) / (self.times[j] - self.times[i]);
            way.windows(2)
                .map(|pair| rate(pair[0], pair[1]).abs())
                .collect()
        };
        // A pause of the camera while the load changes steadily is no step, because its rate is no other.
        let [imposed, radius] = [rates(|point| point.ordinate), rates(|point| point.abscissa)];
        let largest = |rates: &[f64]| rates.iter().copied().fold(0.0, f64::max);
        let is_sudden = |&k: &usize| {
            let before = &imposed[k.saturating_sub(FEWEST)..k];
            let after = &imposed[k + 1..(k + 1 + FEWEST).min(imposed.len())];
            imposed[k] > SUDDEN * largest(before).max(largest(after))
        };
        let sudden: Vec<usize> = (1..imposed.len()).filter(is_sudden).collect();
        let sum = |back: usize| sudden.iter().map(|k| radius[k - back]).sum::<f64>();
        if sum(0) <= FASTER * sum(1) {
            return vec![way];
        }
        let mut parts = Vec::new();
        let mut rest = way;
        for k in sudden {
            let (part, next) = rest.split_at(k + 1 - (way.len() - rest.len()));
            parts.push(part);
            rest = next;
        }
        parts.push(rest);
        parts
    }

    /// Reads the speeds of the points of one way.
    fn read_speeds(&self, way: &[usize], speeds: &mut [LineSpeed]) {
        let radii: Vec<f64> = way
            .iter()
            .map(|&i| self.measurement.points[i].abscissa)
            .collect();
        let times: Vec<f64> = way.iter().map(|&i| self.times[i]).collect();
        let deviation = self.radius_deviation(&radii);
        let span = SPAN * deviation;
        let most = (way.len() / PART).clamp(FEWEST, MOST);
        let sides: Vec<usize> = (FEWEST..most).collect();
        for (place, &i) in way.iter().enumerate() {
            // As many at the ends, where not as many are on each side.
            let around = |side: usize| {
                let begin = way.len().saturating_sub(2 * side + 1);
                let begin = place.saturating_sub(side).min(begin);
                begin..(begin + 2 * side + 1).min(way.len())
            };
            let is_narrow = |side: &usize| range(radii[around(*side)].iter().copied()) < span;
            let wide = sides.get(sides.partition_point(is_narrow));
            let around = around(wide.copied().unwrap_or(most));
            speeds[i] = speed(
                &times[around.clone()],
                &radii[around],
                times[place],
                deviation,
            );
            if place < FEWEST || place + FEWEST >= way.len() {
                speeds[i].deviation = f64::INFINITY;
            }
        }
    }

    /// Returns the standard deviation of radii in order.
    fn radius_deviation(&self, radii: &[f64]) -> f64 {
        let known = self.usual_abscissa_noise();
        if known > 0.0 {
            return known;
        }
        let steps: Vec<f64> = differences_of(radii).into_iter().map(f64::abs).collect();
        let moved: Vec<f64> = steps.iter().copied().filter(|step| *step > 0.0).collect();
        let alike = steps.len() - moved.len();
        let rounding = if alike as f64 > ROUNDED * steps.len() as f64 && !moved.is_empty() {
            OF_ROUNDING * median(moved)
        } else {
            0.0
        };
        noise_of(radii).unwrap_or(0.0).max(rounding)
    }

    /// Returns the factor of the work of adhesion at a `speed` of the contact line, and its derivatives with respect to
    /// the numbers of the law.
    fn line_factor(&self, speed: f64) -> Result<(f64, [f64; 2]), contact::Error> {
        let (Some(v0), Some(n)) = (self.doubling_speed, self.speed_exponent) else {
            return Ok((1.0, [0.0; 2]));
        };
        let factor = RateDependent::new(1.0, v0, n)?.energy_release_rate(speed)?;
        if speed == 0.0 {
            return Ok((factor, [0.0; 2]));
        }
        // Of the larger one of the factor and its inverse, 1 + (|v|/v0)^n.
        let by_logarithm = 1.0 - factor.min(factor.recip());
        let change = factor * by_logarithm * speed.signum();
        Ok((factor, [-n / v0 * change, (speed.abs() / v0).ln() * change]))
    }

    /// Tells whether adhesion depends on the speed at a point, and the speed is not known.
    pub(crate) fn is_speed_unknown(&self, i: usize) -> bool {
        let speed = self.line_speeds.get(i);
        self.has_line_law() && speed.is_some_and(|one| one.deviation.is_infinite())
    }

    /// Leaves out points in contact at which the speed of the line is not known, and is needed.
    pub(crate) fn leave_out_unknown_speeds(&self, branches: &mut [Branch]) {
        if self.has_line_law() {
            for (one, branch) in self.speeds_of_line().iter().zip(branches) {
                if one.deviation.is_infinite() && branch.is_contact() {
                    *branch = Branch::LeftOut;
                }
            }
        }
    }

    /// Returns what the error of its speed does to each ordinate of the model, which is `here`: as that of a point alone,
    /// and so that means over neighbours, whose errors are alike, have their true errors. The first number of each is the
    /// part of the standard deviation of the ordinate that is due to it, and the second the change of the ordinate over one
    /// standard deviation of the speed.
    ///
    /// The part is the change of the model per standard deviation of the speed, over steps of one or of three of them,
    /// whichever is larger: the law is steepest at rest, and a line that seems to move may rest.
    pub(super) fn errors_of_line_speeds(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
        order: &[usize],
        here: &[f64],
    ) -> Result<[Vec<[f64; 2]>; 2], Error> {
        let predicted = |by: f64, deviation: fn(&LineSpeed) -> f64| {
            let mut moved = self.clone();
            for one in &mut moved.line_speeds {
                if one.deviation.is_finite() {
                    one.speed += by * deviation(one);
                }
            }
            let predicted = moved.predict_with(contact_of, branches, order, &[])?;
            Ok::<_, Error>(predicted.values)
        };
        let changes = |deviation| {
            let mut changes = vec![[0.0_f64; 2]; here.len()];
            for step in STEPS {
                let (above, below) = (predicted(step, deviation)?, predicted(-step, deviation)?);
                for (i, [part, change]) in changes.iter_mut().enumerate() {
                    let size = (above[i] - here[i]).hypot(below[i] - here[i]);
                    *part = part.max(size / (step * std::f64::consts::SQRT_2));
                    if step == STEPS[0] {
                        *change = 0.5 * (above[i] - below[i]);
                    }
                }
            }
            Ok::<_, Error>(changes)
        };
        let alone = changes(|line| line.deviation)?;
        Ok([alone, changes(LineSpeed::deviation_of_mean)?])
    }

    /// Returns the energy release rate that a measured load or penetration at a contact radius tells, J/m^2.
    pub(crate) fn measured_energy(
        &self,
        contact: &Contact,
        point: &Point,
    ) -> Result<f64, contact::Error> {
        let (a, reading) = (
            point.abscissa,
            point.ordinate - self.baseline_at(point.abscissa),
        );
        if self.measurement.kind == Kind::PenetrationRadius {
            contact.energy_release_rate_at_penetration(a, reading)
        } else {
            contact.energy_release_rate_at_load(a, reading)
        }
    }

    /// Returns the work of adhesion of a branch at a `speed` of the contact line, and its derivative with respect to a
    /// parameter that moves it.
    pub(super) fn work_at(
        &self,
        branch: Branch,
        speed: f64,
    ) -> Result<(f64, impl Fn(Parameter) -> f64 + use<>), contact::Error> {
        let work = self.work_of(branch);
        let (factor, by_law) = self.line_factor(speed)?;
        let by = move |parameter| match parameter {
            Parameter::DoublingSpeed => work * by_law[0],
            Parameter::SpeedExponent => work * by_law[1],
            _ => factor,
        };
        Ok((work * factor, by))
    }
}

/// Returns the speed of the line at the time `at`, by the cubic of least squares through radii that have a standard
/// `deviation`; 0, and not known, of too few radii.
fn speed(times: &[f64], radii: &[f64], at: f64, deviation: f64) -> LineSpeed {
    let scale = range(times.iter().copied());
    // Less the first one, so that large radii are not rounded.
    let pair = |(time, radius): (&f64, &f64)| {
        let u = (time - at) / scale;
        (Vector4::new(1.0, u, u * u, u * u * u), radius - radii[0])
    };
    let pairs = times.iter().zip(radii).map(pair);
    let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
    for (row, radius) in pairs.clone() {
        normal += row * row.transpose();
        right += row * radius;
    }
    let count = times.len() as f64;
    let Some(inverse) = normal.try_inverse().filter(|_| times.len() > right.len()) else {
        return LineSpeed {
            speed: 0.0,
            deviation: f64::INFINITY,
            ..LineSpeed::default()
        };
    };
    let cubic = inverse * right;
    let squares = pairs.map(|(row, radius)| (radius - row.dot(&cubic)).powi(2));
    let residual = squares.sum::<f64>() / (count - right.len() as f64);
    let noise = deviation * deviation;
    // A course that is no cubic gives all points of the window nearly one error. It is told apart, because where
    // the speed most likely is follows from the noise of the radii.
    let variance = noise + count * (residual - noise).max(0.0);
    let own = if noise > 0.0 { noise } else { variance };
    LineSpeed {
        speed: -cubic[1] / scale,
        deviation: (own * inverse[(1, 1)]).sqrt() / scale,
        misfit: if own > 0.0 { variance / own } else { 1.0 },
        alike: count / (2 * FEWEST + 1) as f64,
    }
}
