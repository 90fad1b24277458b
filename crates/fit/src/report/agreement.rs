//! How well a fit agrees with the data: chi^2 and the noise.

use super::unit::three_digits;
use crate::{Experiment, Fit, Loss};

/// Says how well the fit agrees with the data.
pub(super) fn agreement(fit: &Fit, experiments: &[Experiment]) -> String {
    let noises = fit.experiments.iter().zip(experiments);
    let noises = noises.map(|(experiment, of)| {
        let kind = of.measurement.kind;
        let [unit, ordinate_unit] = kind.units();
        let ordinate = if experiment.noise_is_estimated {
            ", from the residuals"
        } else {
            ""
        };
        let abscissa = match experiment.abscissa_noise {
            0.0 => String::new(),
            noise => format!(", of the abscissa {}", three_digits(noise, unit)),
        };
        let noise = if kind.is_stiffness() {
            format!("{:.2} %", 1e2 * experiment.noise)
        } else {
            three_digits(experiment.noise, ordinate_unit)
        };
        format!("{noise}{ordinate}{abscissa}")
    });
    let noise = noises.collect::<Vec<_>>().join("; ");
    let loss = match fit.loss {
        Loss::Squares => String::new(),
        Loss::Huber { threshold } => format!("; robust: Huber's loss, threshold {threshold}"),
        Loss::SoftL1 { threshold } => format!("; robust: soft L1 loss, threshold {threshold}"),
    };
    let freedom = fit.degrees_of_freedom;
    let plural = if freedom == 1 { "" } else { "s" };
    let freedom = format!("{freedom} degree{plural} of freedom");
    match fit.reduced_chi_squared {
        Some(reduced) => format!("reduced chi^2 {reduced:.2} with {freedom}; noise {noise}{loss}"),
        None => format!("noise {noise}; {freedom}{loss}"),
    }
}
