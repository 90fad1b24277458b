//! What a report says of a contact stiffness beside what it says of every fit.

use std::borrow::Cow;

use crate::statistics::extremes;
use crate::{ContactDepth, Experiment, Fit, FittedExperiment, Kind, LayerQuantity, Parameter};

/// Returns what is known of the indenter.
pub(super) fn fixed(experiment: &Experiment) -> Vec<(Cow<'static, str>, String)> {
    let of = &experiment.indentation;
    let mut rows: Vec<(Cow<'static, str>, String)> = Vec::new();
    if experiment.measurement.kind == Kind::StiffnessDepth {
        let depth = match of.contact_depth {
            ContactDepth::OliverPharr => format!("oliver-pharr, epsilon {}", of.epsilon),
            ContactDepth::Loubet => "loubet".into(),
        };
        rows.push(("contact-depth".into(), depth));
        let numbers: Vec<String> = of.area.coefficients().iter().map(f64::to_string).collect();
        rows.push(("area".into(), format!("{} nm^2", numbers.join(", "))));
        if of.thinning > 0.0 {
            rows.push(("thinning".into(), of.thinning.to_string()));
        }
    }
    rows
}

/// Returns the range of the contact radii of each measurement of a contact stiffness, over the
/// thickness of its film or top layer, and the loss tangent.
pub(super) fn lines(fit: &Fit, experiments: &[Experiment]) -> Vec<String> {
    let mut lines = Vec::new();
    for (fitted, experiment) in fit.experiments.iter().zip(experiments) {
        if !experiment.measurement.kind.is_stiffness() {
            continue;
        }
        let name = &fitted.name;
        if let Some([least, most]) = a_over_t(fit, fitted, experiment) {
            lines.push(format!(
                "{name}: contact radius over thickness from {least:.3} to {most:.3}"
            ));
        }
        if let Some(loss) = fitted.loss {
            lines.push(format!(
                "{name}: loss tangent {:.4} +- {:.4}; the modulus of the film is the absolute value, \
                 {:.4} of which is the storage modulus and {:.4} the loss modulus",
                loss.tangent(),
                loss.tangent_error(),
                loss.angle.cos(),
                loss.angle.sin()
            ));
        }
    }
    lines
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
    let [least, most] = extremes(fitted.points.iter().filter_map(|one| one.contact_radius));
    (most > 0.0).then(|| [least, most].map(|radius| radius / thickness))
}
