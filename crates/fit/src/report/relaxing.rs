//! What a report says of bodies that relax beside what it says of every fit.

use std::borrow::Cow;

use contact::Relaxation;

use super::unit::three_digits;
use crate::{Experiment, Fit};

/// Returns the law, and when its modulus is that of the bodies.
pub(super) fn fixed(experiment: &Experiment) -> Vec<(Cow<'static, str>, String)> {
    let Some(relaxing) = &experiment.relaxing else {
        return Vec::new();
    };
    let modulus = match relaxing.law {
        Relaxation::PowerLaw { time, .. } => format!("moduli after {}", three_digits(time, "s")),
        _ => "instantaneous moduli".to_owned(),
    };
    let bodies = if relaxing.all_bodies {
        ", of all bodies"
    } else {
        ""
    };
    let law = format!("{}{bodies}, {modulus}", relaxing.law.name());
    vec![("relaxation".into(), law)]
}

/// Returns the modulus at three times of each measurement, and what was changed and left out.
pub(super) fn lines(fit: &Fit, experiments: &[Experiment]) -> Vec<String> {
    let mut lines = Vec::new();
    for (fitted, experiment) in fit.experiments.iter().zip(experiments) {
        let Some(found) = fitted.relaxation else {
            continue;
        };
        let [first, middle, last] = found.moduli.map(|[time, modulus]| {
            format!(
                "{} after {}",
                three_digits(modulus, "Pa"),
                three_digits(time, "s")
            )
        });
        lines.push(format!(
            "{}: Young's modulus {first}, {middle}, {last}",
            fitted.name
        ));
        if found.made_monotone > 0.0 {
            lines.push(format!(
                "{}: the {} was changed by up to {}: it is taken without its noise, as straight lines that rise to the \
                 largest value and fall from there; its noise, if you state it, enters the standard errors",
                fitted.name,
                experiment.measurement.kind.names()[0],
                three_digits(found.made_monotone, "m")
            ));
        }
    }
    lines
}
