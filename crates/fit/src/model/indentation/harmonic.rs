//! The phase of a complex stiffness, and the loss tangent of the film.
//!
//! At one frequency the stiffness `S* = S' + i S''` is the stiffness at the complex modulus
//! `E1 = |E| exp(i phi)` of the film, with a real Poisson ratio. It is an analytic function of
//! `ln E1`, so that `ln S*` at `ln |E| + i phi` is the Taylor series of `ln S` at real moduli:
//! `ln|S*| = ln S - s2 phi^2/2 + s4 phi^4/24`, `arg S* = s1 phi - s3 phi^3/6`, with the derivatives
//! `s_n` of `ln S` by `ln E1`.

use super::sample::Sample;
use crate::model::differences::ContactOf;
use crate::model::predicted::Predicted;
use crate::{Branch, Error, Experiment};

/// The step of `ln E1` by which the derivatives of `ln S` are found, from five moduli.
const STEP: f64 = 0.25;
/// The most steps to the loss angle, and the change (rad) at which they end.
const MOST_STEPS: usize = 30;
const ACCURACY: f64 = 1e-12;
/// The largest loss tangent: 1, up to which the expansion is within 1 %, and this 1 %. And the largest
/// one that is accepted where noise alone, two standard errors, may bring a tangent of 1 there.
const LARGEST_TANGENT: f64 = 1.01;
const LARGEST_BY_NOISE: f64 = 1.1;

/// The angle `phi` of the complex modulus `|E| exp(i phi)` of a film or top layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LossAngle {
    /// The angle, rad.
    pub angle: f64,
    /// Its standard error, rad, from the scatter of the phases; NaN for a single point.
    pub standard_error: f64,
}

impl LossAngle {
    /// Returns the loss tangent `tan phi = E''/E'`.
    pub fn tangent(self) -> f64 {
        self.angle.tan()
    }

    /// Returns the standard error of the loss tangent.
    pub fn tangent_error(self) -> f64 {
        self.standard_error / self.angle.cos().powi(2)
    }
}

/// `ln S*` at a complex modulus, by the derivatives of `ln S` at a real one.
struct Series {
    value: f64,
    by_modulus: [f64; 4],
}

impl Series {
    /// Takes `ln S` at the moduli `|E| exp(k STEP)`, `k` from -2 to 2.
    fn new([a, b, c, d, e]: [f64; 5]) -> Self {
        let h = STEP;
        Self {
            value: c,
            by_modulus: [
                (a - 8.0 * b + 8.0 * d - e) / (12.0 * h),
                (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / (12.0 * h * h),
                (-a + 2.0 * b - 2.0 * d + e) / (2.0 * h.powi(3)),
                (a - 4.0 * b + 6.0 * c - 4.0 * d + e) / h.powi(4),
            ],
        }
    }

    /// Returns `ln|S*|` and `arg S*` of what is read with the compliance of a frame (m/N) in series.
    fn at(&self, phi: f64, compliance: f64) -> [f64; 2] {
        let [s1, s2, s3, s4] = self.by_modulus;
        let size = self.value - s2 * phi.powi(2) / 2.0 + s4 * phi.powi(4) / 24.0;
        let angle = s1 * phi - s3 * phi.powi(3) / 6.0;
        if compliance == 0.0 {
            return [size, angle];
        }
        let [real, imaginary] = [angle.cos(), -angle.sin()].map(|part| (-size).exp() * part);
        let real = real + compliance;
        [-real.hypot(imaginary).ln(), -imaginary.atan2(real)]
    }
}

impl Experiment {
    /// Returns the experiment at the moduli of the series: of the film, the half-space or the top layer.
    fn at_moduli(&self) -> Result<[Self; 5], Error> {
        let parameter = self.bodies.modulus_of_top();
        let reason = "phases are those of the top layer of the stack, which has no name: name it";
        let modulus = self.get(parameter);
        let modulus = modulus.ok_or_else(|| self.not_fitted(reason))?;
        let mut moved = std::array::from_fn(|_| self.clone());
        for (k, moved) in moved.iter_mut().enumerate() {
            moved.replace(parameter, modulus * ((k as f64 - 2.0) * STEP).exp())?;
        }
        Ok(moved)
    }

    /// Returns the series of each point that counts; `None` of the others.
    fn series(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
    ) -> Result<Vec<Option<Series>>, Error> {
        let mut logarithms = vec![[f64::NAN; 5]; branches.len()];
        for (k, moved) in self.at_moduli()?.into_iter().enumerate() {
            let sample = moved.sample(contact_of, branches)?;
            for (i, logarithms) in logarithms.iter_mut().enumerate() {
                if branches[i] != Branch::LeftOut {
                    let (_, stiffness) = self.stiffness_at(i, self.compared(i), &sample)?;
                    logarithms[k] = stiffness.ln();
                }
            }
        }
        let series = logarithms.into_iter().zip(branches);
        let series = series
            .map(|(values, branch)| (*branch != Branch::LeftOut).then(|| Series::new(values)));
        Ok(series.collect())
    }

    /// Returns the samples of which [`Self::read_at`] makes a complex stiffness: at the moduli of the
    /// series, or one sample without a loss tangent. The film is thinner by up to `most` (m).
    pub(super) fn samples(
        &self,
        contact_of: &ContactOf<'_>,
        most: f64,
    ) -> Result<Vec<Sample>, Error> {
        if self.indentation.loss_tangent == 0.0 {
            return Ok(vec![Sample::new(&self.bodies, contact_of, most)?]);
        }
        let of = |moved: &Self| Sample::new(&moved.bodies, contact_of, most);
        self.at_moduli()?.iter().map(of).collect()
    }

    /// Returns the storage part (N/m) of the stiffness that is read at a contact radius (m), where the
    /// film is thinner by a depth (m), and its phase (rad).
    pub(super) fn read_at(
        &self,
        samples: &[Sample],
        radius: f64,
        thinner: f64,
    ) -> Result<[f64; 2], Error> {
        let of = &self.indentation;
        let mut values = [0.0; 5];
        for (value, sample) in values.iter_mut().zip(samples) {
            *value = of.beta * sample.stiffness(radius, thinner)?;
        }
        if let [_] = samples {
            return Ok([1.0 / (1.0 / values[0] + of.frame_compliance), 0.0]);
        }
        let series = Series::new(values.map(f64::ln));
        let [size, phase] = series.at(of.loss_tangent.atan(), of.frame_compliance);
        Ok([size.exp() * phase.cos(), phase])
    }

    /// Makes the points those of a film with a loss tangent, at radii or loads: the ordinates the
    /// storage part, and the phases.
    pub(super) fn make_phases(
        &mut self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
    ) -> Result<(), Error> {
        let of = &self.indentation;
        let (phi, compliance) = (of.loss_tangent.atan(), of.frame_compliance);
        let series = self.series(contact_of, branches)?;
        let read = series.iter().flatten().map(|one| one.at(phi, compliance));
        for (point, [size, phase]) in self.measurement.points.iter_mut().zip(read) {
            point.ordinate = size.exp() * phase.cos();
            self.indentation.phases.push(phase);
        }
        Ok(())
    }

    /// Returns the loss angle of least squares of the phases.
    fn angle_of(&self, series: &[Option<Series>]) -> LossAngle {
        let compliance = self.indentation.frame_compliance;
        let of_points = || {
            let phases = self.indentation.phases.iter();
            series
                .iter()
                .zip(phases)
                .filter_map(|(one, phase)| Some((one.as_ref()?, *phase)))
        };
        // The derivative by differences is exact enough: the residuals tell when to stop.
        let sums = |phi: f64| {
            let mut sums = [0.0; 3];
            for (one, phase) in of_points() {
                let at = |phi| one.at(phi, compliance)[1];
                let residual = phase - at(phi);
                let slope = (at(phi + 1e-5) - at(phi - 1e-5)) / 2e-5;
                for (sum, term) in
                    sums.iter_mut()
                        .zip([slope * residual, slope * slope, residual * residual])
                {
                    *sum += term;
                }
            }
            sums
        };
        let mut phi = 0.0;
        for _ in 0..MOST_STEPS {
            let [residuals, slopes, _] = sums(phi);
            let step = residuals / slopes;
            phi += step;
            if step.is_nan() || step.abs() <= ACCURACY {
                break;
            }
        }
        let [_, slopes, squares] = sums(phi);
        let freedom = of_points().count() as f64 - 1.0;
        let standard_error = if freedom > 0.0 {
            (squares / freedom / slopes).sqrt()
        } else {
            f64::NAN
        };
        LossAngle {
            angle: phi,
            standard_error,
        }
    }

    /// Returns the phases of points in their `order` with those of a film of the loss angle `phi` (rad), rad; without the
    /// points that are left out.
    pub(crate) fn phases_beside(
        &self,
        contact_of: &ContactOf<'_>,
        (branches, order): (&[Branch], &[usize]),
        phi: f64,
    ) -> Result<Vec<[f64; 2]>, Error> {
        let (series, of) = (self.series(contact_of, branches)?, &self.indentation);
        let both = |&i: &usize| {
            let [_, angle] = series[i].as_ref()?.at(phi, of.frame_compliance);
            Some([of.phases[i], angle])
        };
        Ok(order.iter().filter_map(both).collect())
    }

    /// Replaces the predictions by the logarithms of the storage part of the complex stiffness.
    pub(super) fn predict_storage(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
        predicted: &mut Predicted,
    ) -> Result<(), Error> {
        let series = self.series(contact_of, branches)?;
        let phi = self.angle_of(&series).angle;
        for (value, one) in predicted.values.iter_mut().zip(&series) {
            if let Some(one) = one {
                let [size, angle] = one.at(phi, self.indentation.frame_compliance);
                *value = size + angle.cos().ln();
            }
        }
        Ok(())
    }

    /// Returns the loss angle of the film or top layer, the modulus of which is the absolute value of
    /// the complex one; `None` where no phase is measured.
    ///
    /// # Errors
    /// [`Error::NotFitted`] for a loss tangent above 1.01 by more than two standard errors, or above 1.1, where
    /// the expansion is not within 1 %.
    pub(crate) fn loss_angle(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
    ) -> Result<Option<LossAngle>, Error> {
        if !self.measurement.kind.is_stiffness() || self.indentation.phases.is_empty() {
            return Ok(None);
        }
        let found = self.angle_of(&self.series(contact_of, branches)?);
        let tangent = found.tangent();
        let least = tangent.abs() - (2.0 * found.tangent_error()).max(0.0);
        if found.angle.abs() < std::f64::consts::FRAC_PI_2
            && least <= LARGEST_TANGENT
            && tangent.abs() <= LARGEST_BY_NOISE
        {
            return Ok(Some(found));
        }
        let reason = format!(
            "the loss tangent of the film is {tangent:.3}, and the expansion that finds it holds up to 1: fit the \
             absolute value of the stiffness without phases, or measure where the film is less viscous"
        );
        Err(self.not_fitted(reason))
    }
}
