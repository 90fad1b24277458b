//! The doubt about penetrations from which the deflection of a cantilever was taken off, and its noise with it.
//!
//! The penetration is `z - F/k`, so that an error `e` of the force makes one of `-e/k` of the penetration. Least squares
//! of `F` against it find a slope `S` that is too small by the part `(1 + k/S) var(e/k)/var(delta)`, however many
//! points there are (attenuation: Fuller, Measurement Error Models, 1987). Against the height `z` there is none.

use crate::estimate::problem::Problem;
use crate::model::noise_of;
use crate::statistics::{BEYOND_CHANCE, differences_of, median};
use crate::{Estimate, Kind, Warning, WarningKind};

/// The order of the differences of neighbours that are noise: a curve of few points has none of this order.
const ORDER: u32 = 4;
/// The number of such differences with the information of one that is independent of the others: `1 + 2 sum(r^2)` with their
/// correlations -56/70, 28/70, -8/70 and 1/70.
const OVERLAP: f64 = 2.63;
/// Differences beyond this factor of their median size are jumps or spikes: 3.4 standard deviations.
const FAR: f64 = 5.0;

/// Warns if the noise of the penetrations of experiment `e` is that of the loads with the opposite sign, and makes a modulus
/// too small by more than its standard error.
pub(crate) fn doubt(problem: &Problem<'_>, e: usize, estimates: &[Estimate]) -> Option<Warning> {
    let (assigned, found) = (&problem.assigned[e], problem.parameters_of(e));
    let measurement = &assigned.experiment.measurement;
    if measurement.kind != Kind::LoadPenetration {
        return None;
    }
    let points = || measurement.points.iter();
    let penetrations: Vec<f64> = points().map(|point| point.abscissa).collect();
    let loads: Vec<f64> = points().map(|point| point.ordinate).collect();
    let [x, y] = [&penetrations, &loads]
        .map(|own| (0..ORDER).fold(own.clone(), |own, _| differences_of(&own)));
    let [far_x, far_y] = [&x, &y].map(|own| FAR * median(own.iter().map(|d| d.abs()).collect()));
    let near = x.iter().zip(&y);
    let near = near.filter(|(x, y)| x.abs() <= far_x && y.abs() <= far_y);
    let [mut xx, mut xy, mut yy, mut count] = [0.0; 4];
    for (x, y) in near {
        xx += x * x;
        xy += x * y;
        yy += y * y;
        count += 1.0;
    }
    let correlation = (xy / (xx * yy).sqrt()).clamp(-1.0 + f64::EPSILON, 1.0);
    // Fisher's transform of the correlation has a variance of one over the number of independent pairs less 3.
    let pairs = (count / OVERLAP - 3.0).max(0.0);
    let is_shared = -correlation.atanh() * pairs.sqrt() > BEYOND_CHANCE;
    let noise = noise_of(&penetrations).filter(|_| is_shared)?;
    let predicted = &problem.predicted.as_ref()?[e];
    let in_contact = assigned.counting_points();
    let in_contact = in_contact.filter(|&i| predicted.radii[i] > 0.0);
    let in_contact: Vec<f64> = in_contact.map(|i| penetrations[i]).collect();
    let count = in_contact.len() as f64;
    let mean = in_contact.iter().sum::<f64>() / count;
    let squares = in_contact.iter().map(|one| (one - mean).powi(2));
    let spread = squares.sum::<f64>() / count;
    let part = (correlation * noise).powi(2) / spread;
    let own = estimates
        .iter()
        .filter(|one| found.contains(&one.parameter));
    let moduli = own.filter(|one| one.parameter.is_modulus());
    let error = moduli.map(|one| one.standard_error / one.value);
    if !part.is_finite() || part <= error.fold(f64::INFINITY, f64::min) {
        return None;
    }
    Some(WarningKind::SharedNoise.with(format!(
        "{}: the penetrations have the noise of the loads with the opposite sign, as where the deflection of a cantilever \
         of {:.3e} N/m was taken off the heights. This makes the modulus too small, here by {:.1} % or more, whatever \
         errors are given. Fit the loads against the heights instead, which are -(penetration + load/stiffness), with \
         this stiffness",
        measurement.name,
        -yy / xy,
        100.0 * part
    )))
}
