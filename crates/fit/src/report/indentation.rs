//! What a report says of a contact stiffness beside what it says of every fit.

use std::borrow::Cow;

use crate::{ContactDepth, Experiment, Fit, FittedExperiment, Kind};

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

/// Returns the loss tangent of each measurement of a contact stiffness that has one.
pub(super) fn lines(fit: &Fit) -> Vec<String> {
    let line = |fitted: &FittedExperiment| {
        let loss = fitted.loss?;
        Some(format!(
            "{}: loss tangent {:.4} +- {:.4}; the modulus of the film is the absolute value, {:.4} of which is the storage \
             modulus and {:.4} the loss modulus",
            fitted.name,
            loss.tangent(),
            loss.tangent_error(),
            loss.angle.cos(),
            loss.angle.sin()
        ))
    };
    fit.experiments.iter().filter_map(line).collect()
}
