//! The flags that follow from the warnings of a fit.

use ::fit::{Fit, WarningKind};

/// Returns the warnings that may tell why a value is impossible, and what follows, a line each.
pub fn further_doubts(fit: &Fit, timed: bool) -> String {
    let others = fit.warnings.iter();
    let others = others.filter(|warning| warning.kind != WarningKind::Implausible);
    let texts: String = others
        .map(|warning| format!("\nwarning: {}", warning.text))
        .collect();
    format!("{texts}\n{}", next_steps(fit, timed))
        .trim_end()
        .to_owned()
}

/// Returns the flags that follow from the warnings, a line each.
pub fn next_steps(fit: &Fit, timed: bool) -> String {
    let steps = [
        (
            WarningKind::Saturated,
            "points of a saturated detector: let their lines begin with #",
        ),
        (
            WarningKind::NoiseNotSeen,
            "the noise of the ordinates: --noise 2uN, or a column of it",
        ),
        (
            WarningKind::UnequalNoise,
            "errors of the abscissae: --abscissa-noise 5nm, beside --noise or without it; a noise that differs from \
             point to point: a column of it, such as `load error [mN]`",
        ),
        (
            WarningKind::Hysteresis,
            "loops: --free ...,work-of-adhesion-receding, or --only approach, or --only retract \
             (points without a direction: --segments split)",
        ),
        (
            WarningKind::Plasticity,
            "what remains after unloading: keep the rows of unloading above half of the largest \
             load, and --only retract --free film-modulus,contact-point",
        ),
    ];
    let in_time = (
        WarningKind::Hysteresis,
        "a film that relaxes: --relaxation power-law, or sls, prony:2, modified-power-law, \
         fractional-zener (see `tabulate fit --help`)",
    );
    // A film that relaxes makes loops, and its law is named in the warning.
    let relaxes = fit.experiments.iter().any(|one| one.relaxation.is_some());
    let steps = steps.iter().chain(timed.then_some(&in_time));
    let steps = steps.filter(|(kind, _)| fit.warns_of(*kind));
    let steps = steps.filter(|(kind, _)| !relaxes || *kind != WarningKind::Hysteresis);
    steps.map(|(_, step)| format!("{step}\n")).collect()
}
