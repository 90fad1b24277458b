//! The doubt about penetrations from which the deflection of a cantilever was taken off, and its noise with it.
//!
//! The penetration is `z - F/k`, so that an error `e` of the force makes one of `-e/k` of the penetration. Least squares
//! of `F` against it find a slope `S` that is too small by the part `(1 + k/S) var(e/k)/var(delta)`, however many
//! points there are (attenuation: Fuller, Measurement Error Models, 1987). Against the height `z` there is none.

use super::assigned::Assigned;
use super::doubts::{BEYOND_CHANCE, Warnings};
use crate::model::{Predicted, noise_of};
use crate::{Estimate, Kind, WarningKind};

/// The number of second differences with the information of one that is independent of the others: `1 + 2 sum(r^2)`
/// with their correlations -2/3 and 1/6.
const OVERLAP: f64 = 1.94;

/// Warns if the noise of the penetrations is that of the loads with the opposite sign, and the modulus is too small for
/// it by more than its standard error. Returns whether it does.
pub(super) fn add(
    warnings: &mut Warnings,
    estimates: &[Estimate],
    assigned: &Assigned,
    predicted: &Predicted,
) -> bool {
    let measurement = &assigned.experiment.measurement;
    if measurement.kind != Kind::LoadPenetration {
        return false;
    }
    let points = &measurement.points;
    let penetrations: Vec<f64> = points.iter().map(|point| point.abscissa).collect();
    let bends = points.windows(3).map(|three| {
        let bend = |of: [f64; 3]| of[0] - 2.0 * of[1] + of[2];
        let three = [&three[0], &three[1], &three[2]];
        [
            bend(three.map(|one| one.abscissa)),
            bend(three.map(|one| one.ordinate)),
        ]
    });
    let sums = bends.fold([0.0; 3], |[xx, xy, yy], [x, y]| {
        [xx + x * x, xy + x * y, yy + y * y]
    });
    let [xx, xy, yy] = sums;
    // Fisher's transform of the correlation has a variance of one over the number of independent pairs less 3.
    let pairs = points.len().saturating_sub(2) as f64 / OVERLAP - 3.0;
    let correlation = (xy / (xx * yy).sqrt()).clamp(-1.0 + f64::EPSILON, 1.0);
    let is_shared = -correlation.atanh() * pairs.max(0.0).sqrt() > BEYOND_CHANCE;
    let Some(noise) = noise_of(&penetrations).filter(|_| is_shared) else {
        return false;
    };
    let in_contact = assigned
        .counting_points()
        .filter(|&i| predicted.radii[i] > 0.0);
    let in_contact: Vec<f64> = in_contact.map(|i| penetrations[i]).collect();
    let count = in_contact.len() as f64;
    let mean = in_contact.iter().sum::<f64>() / count;
    let spread = in_contact
        .iter()
        .map(|one| (one - mean).powi(2))
        .sum::<f64>()
        / count;
    let part = noise * noise / spread;
    let moduli = estimates.iter().filter(|one| one.parameter.is_positive());
    let error = moduli.map(|one| one.standard_error / one.value);
    if part.is_nan() || part <= error.fold(f64::INFINITY, f64::min) {
        return false;
    }
    warnings.add(
        WarningKind::SharedNoise,
        format!(
            "{}: the penetrations have the noise of the loads with the opposite sign, as where the deflection of a cantilever \
             of {:.3e} N/m was taken off the heights. This makes the modulus too small, here by {:.0} % or more, whatever \
             errors are given. Fit the loads against the heights instead, which are -(penetration + load/stiffness), with \
             this stiffness",
            measurement.name,
            -xy / xx,
            100.0 * part
        ),
    );
    true
}
