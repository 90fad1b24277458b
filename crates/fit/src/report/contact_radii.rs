//! What a report says of the size of the contacts.

use super::unit::three_digits;
use crate::statistics::extremes;
use crate::{Experiment, Fit, FittedExperiment, LayerQuantity, Parameter};

/// Returns the smallest and the largest contact radius of each measurement, alone and over the thickness of the film or top
/// layer.
pub(super) fn lines(fit: &Fit, experiments: &[Experiment]) -> Vec<String> {
    let line = |(fitted, experiment): (&FittedExperiment, &Experiment)| {
        let [least, most] = radii(fitted)?.map(|radius| three_digits(radius, "m"));
        let over_thickness = match a_over_t(fit, fitted, experiment) {
            Some([least, most]) => format!(", over the thickness from {least:.3} to {most:.3}"),
            None => String::new(),
        };
        let name = &fitted.name;
        Some(format!(
            "{name}: contact radii from {least} to {most}{over_thickness}"
        ))
    };
    let all = fit.experiments.iter().zip(experiments);
    all.filter_map(line).collect()
}

/// Returns the smallest and the largest contact radius of the points of an experiment over the
/// thickness of its film or top layer; `None` on a half-space, or where no point is in contact.
pub fn a_over_t(fit: &Fit, fitted: &FittedExperiment, experiment: &Experiment) -> Option<[f64; 2]> {
    let free = match experiment.bodies.top_name() {
        Some(top) => Parameter::Layer(top, LayerQuantity::Thickness),
        None => Parameter::FilmThickness,
    };
    let found = fit.estimate(free).map(|one| one.value);
    let thickness = found.or(experiment.bodies.top_thickness())?;
    Some(radii(fitted)?.map(|radius| radius / thickness))
}

/// Returns the smallest and the largest contact radius of an experiment (m); `None` where no point is in contact.
fn radii(fitted: &FittedExperiment) -> Option<[f64; 2]> {
    let [least, most] = extremes(fitted.points.iter().filter_map(|one| one.contact_radius));
    (most > 0.0).then_some([least, most])
}
