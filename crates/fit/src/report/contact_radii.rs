//! What a report says of the size of the contacts.

use super::unit::three_digits;
use crate::statistics::extremes;
use crate::{Experiment, Fit, FittedExperiment, LayerQuantity, Parameter};

/// Returns the smallest and the largest contact radius of each measurement, alone and over the thickness of the film or top
/// layer.
pub(super) fn lines(fit: &Fit, experiments: &[Experiment]) -> Vec<String> {
    let line = |(fitted, ratios): (&FittedExperiment, Option<[f64; 2]>)| {
        let [least, most] = radii(fitted)?.map(|radius| three_digits(radius, "m"));
        let beside_film = ratios.map_or_else(String::new, |ends| {
            let [least, most] = ends.map(over_thickness);
            format!(", over the thickness from {least} to {most}")
        });
        let name = &fitted.name;
        Some(format!(
            "{name}: contact radii from {least} to {most}{beside_film}"
        ))
    };
    let all = fit.experiments.iter().zip(a_over_t(fit, experiments));
    all.filter_map(line).collect()
}

/// Writes a contact radius over a thickness, of which three decimals may show nothing.
fn over_thickness(ratio: f64) -> String {
    if ratio < 0.01 {
        format!("{ratio:.2e}")
    } else {
        format!("{ratio:.3}")
    }
}

/// Returns the smallest and the largest contact radius of the points of each experiment over the thickness of its film or top
/// layer; `None` on a half-space, or where no point is in contact.
pub fn a_over_t(fit: &Fit, experiments: &[Experiment]) -> Vec<Option<[f64; 2]>> {
    let ratios = |(number, (fitted, experiment)): (usize, (&FittedExperiment, &Experiment))| {
        let free = match experiment.bodies.top_name() {
            Some(top) => Parameter::Layer(top, LayerQuantity::Thickness),
            None => Parameter::FilmThickness,
        };
        let found = Fit::value_of(&fit.estimates, free, number);
        let thickness = found.or(experiment.bodies.top_thickness())?;
        Some(radii(fitted)?.map(|radius| radius / thickness))
    };
    let all = fit.experiments.iter().zip(experiments);
    all.enumerate().map(ratios).collect()
}

/// Returns the smallest and the largest contact radius of an experiment (m); `None` where no point is in contact.
fn radii(fitted: &FittedExperiment) -> Option<[f64; 2]> {
    let [least, most] = extremes(fitted.points.iter().filter_map(|one| one.contact_radius));
    (most > 0.0).then_some([least, most])
}
