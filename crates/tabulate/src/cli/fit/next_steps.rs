//! The flags that follow from the warnings of a fit.

use ::fit::{Estimate, Experiment, Fit, Kind, Parameter, WarningKind};

/// What helps where loading and unloading differ, and where the work of adhesion of the receding line is free already.
const WAYS: [&str; 2] = [
    "loading and unloading that differ: --free ...,work-of-adhesion-receding, or --only approach, or --only retract \
     (points without a direction: --segments split); each way tells the work of adhesion of its own contact line, which may \
     also depend on its speed",
    "loading and unloading that differ: --only approach, or --only retract (points without a direction: --segments split); \
     each way tells the work of adhesion of its own contact line, which may also depend on its speed",
];

/// Returns the warnings that may tell why a value is impossible, and what follows, a line each.
pub fn further_doubts(fit: &Fit, experiments: &[Experiment]) -> String {
    let others = fit.warnings.iter();
    // What the model leaves out of all data explains no impossible value.
    let others = others
        .filter(|warning| warning.kind != WarningKind::Implausible && !warning.kind.is_of_model());
    let texts: String = others
        .map(|warning| format!("\nwarning: {}", warning.text))
        .collect();
    format!("{texts}\n{}", next_steps(fit, experiments))
        .trim_end()
        .to_owned()
}

/// Returns the flags that follow from the warnings, a line each.
pub fn next_steps(fit: &Fit, experiments: &[Experiment]) -> String {
    let is_receding_free = fit.estimate(Parameter::WorkOfAdhesionReceding).is_some();
    let ways = WAYS[usize::from(is_receding_free)];
    let of_penetrations = |one: &Experiment| one.measurement.kind == Kind::LoadPenetration;
    let spring = if experiments.iter().any(of_penetrations) {
        "positions of a stage beside a load cell or frame: --kind force-height --stiffness 1kN/m, its stiffness, --column \
         \"height=-HEADING [UNIT]\", and --free ...,contact-point; a stiffness that is not known: --free ...,stiffness"
    } else if experiments.iter().any(|one| one.from_deflection) {
        "the sensitivity of a deflection in volts: --sensitivity 50nm/V; its error: --known load=+-3%"
    } else {
        "a stiffness that is not known: --free ...,stiffness"
    };
    let steps = [
        (
            WarningKind::Saturated,
            "points of a saturated detector: let their lines begin with #",
        ),
        (
            WarningKind::NoiseNotSeen,
            "the noise of the ordinates: --noise SIZE, or a column of it",
        ),
        (
            WarningKind::UnequalNoise,
            "errors of the abscissae: --abscissa-noise SIZE, beside --noise or without it; a noise that differs from \
             point to point: a column of it, such as `load error [mN]`",
        ),
        (
            WarningKind::RadiusNoise,
            "errors of the contact radii: --radius-noise SIZE, or a column of them, such as `radius error [um]`",
        ),
        (
            WarningKind::SharedNoise,
            "heights in place of penetrations: a column of them, --kind force-height --stiffness 0.02N/m",
        ),
        (
            WarningKind::ZeroNotSeen,
            "the zero of the load: --known load-offset=0+-ERROR, or --free ...,load-offset with points off contact",
        ),
        (
            WarningKind::Calibration,
            "the error of a given value or of a calibration: --known NAME=+-1%, of a Poisson ratio --known NAME=+-0.01, of contact \
             radii that are all too large or small --known contact-radius-zero=+-1um",
        ),
        (WarningKind::SpringWanted, spring),
        (
            WarningKind::PullNotSeen,
            "without adhesion: --work-of-adhesion 0",
        ),
        (WarningKind::Hysteresis, ways),
        (WarningKind::MixedBranches, ways),
        (
            WarningKind::PinnedLine,
            "a contact line that stays: --only retract --between 0um..LARGEST keeps the radii from where it recedes, or with \
             both directions --free ...,work-of-adhesion-receding",
        ),
        (
            WarningKind::Plasticity,
            "what remains after unloading: keep the rows of unloading above half of the largest \
             load, and --only retract --free film-modulus,contact-point",
        ),
    ];
    let found = Estimate::parameters(&fit.estimates);
    // A film that relaxes makes loops, and its law is named in the warning.
    let relaxes = fit.experiments.iter().any(|one| one.relaxation.is_some());
    let is_loop = |kind: WarningKind| kind == WarningKind::Hysteresis;
    let applies = |kind: WarningKind| fit.warns_of(kind) && !(relaxes && is_loop(kind));
    let laws = "a film that relaxes: --relaxation power-law, or sls, prony:2, modified-power-law, \
         fractional-zener (see `tabulate fit --help`)";
    let timed = || experiments.iter().any(Experiment::may_relax);
    let may_relax = applies(WarningKind::Relaxes) || applies(WarningKind::Hysteresis) && timed();
    let kinds = [WarningKind::Hysteresis, WarningKind::MixedBranches];
    let has_loop = kinds.into_iter().any(applies);
    let depends = has_loop
        && !found.contains(&Parameter::DoublingSpeed)
        && experiments.iter().any(Experiment::may_have_line_law);
    let steps = steps.into_iter().filter(|(kind, _)| applies(*kind));
    let mut steps: Vec<&str> = steps.map(|(_, step)| step).collect();
    steps.extend(may_relax.then_some(laws));
    steps.extend(depends.then_some(
        "adhesion that depends on the speed of the contact line: --free ...,doubling-speed,speed-exponent",
    ));
    let mut kinds = experiments.iter().map(|one| one.measurement.kind);
    let may_begin_early = applies(WarningKind::PoorFit) && kinds.any(Kind::at_positions);
    steps.extend(may_begin_early.then_some(
        "a force that acts before the contact (a brush, charges, the liquid): --between keeps the positions where it is small \
         beside the load; with contact-point and baseline free, does the modulus change?",
    ));
    let wanted = format!(
        "to fit a zero that a warning names, write its name in place of NAME: --free {},NAME",
        Parameter::names(found).replace(", ", ",")
    );
    let wants = applies(WarningKind::OffsetWanted) || applies(WarningKind::OffsetHinted);
    steps.extend(wants.then_some(&*wanted));
    let is_exact = |one: &Experiment| !one.bodies.are_layered() && one.bodies.probe.is_paraboloid();
    let exact = applies(WarningKind::LargeContact) && experiments.iter().any(is_exact);
    steps.extend(exact.then_some("the exact sphere: --probe sphere"));
    steps.dedup();
    steps.into_iter().map(|step| format!("{step}\n")).collect()
}
