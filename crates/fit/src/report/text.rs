//! The report of a fit, of a plan and of how a file was read.

use std::borrow::Cow;

use interp::{Elastic, Probe};

use super::agreement::agreement;
use super::name::{NAME, name};
use super::unit::{UnitOf, given, scaled, value};
use super::{contact_radii, fixed_values, indentation, line_speed, relaxing};
use crate::data::{Marks, Notes, Source};
use crate::estimate::left_out_text;
use crate::{
    Bodies, Combination, Direction, Estimate, Experiment, Fit, Fixed, Forecast, LayerQuantity,
    Measurement, ModulusBias, NamedLayer, Parameter, Point, Solver, Warning,
};

/// The rise of chi^2 that tells a worse fit: five standard deviations.
const WORSE: f64 = 25.0;

/// Returns the report of a fit: how the data were read, what is fixed, what was found, whether the
/// film matters, and the warnings.
///
/// `notes` are those of the `experiments`, in their order: [`Notes::default`] for points that come
/// from no file. Parameters without a unit in `units` get a prefix with which their number is at
/// least 1.
///
/// # Panics
/// If the `experiments` are fewer than those of the fit.
pub fn report(fit: &Fit, experiments: &[Experiment], notes: &[Notes], units: &[UnitOf]) -> String {
    let mut out = String::new();
    for (experiment, notes) in experiments.iter().zip(notes) {
        out += &format!("{}\n", reading(&experiment.measurement, notes));
    }
    out += "\nfixed\n";
    for (name, value) in fixed_of_all(fit, experiments) {
        out += &format!("  {name:<NAME$} {value}\n");
    }
    out += if fit.converged {
        "\nfound\n"
    } else {
        "\nnot converged; the last step\n"
    };
    let files: Vec<&str> = fit.experiments.iter().map(|one| &*one.name).collect();
    estimates(&mut out, &fit.estimates, &fit.correlation, &files, units);
    if let Some(young) = young_of_sphere(fit, &experiments[0], units) {
        out += &format!("\n{:<1$} {young}\n", "sphere", NAME + 2);
    }
    out += &format!("\n{}\n", agreement(fit, experiments));
    for (one, experiment) in fit.experiments.iter().zip(experiments) {
        if !one.left_out.is_empty() {
            let groups = left_out_text(&one.left_out, experiment.measurement.numbering);
            out += &format!("{}: left out {groups}\n", one.name);
        }
    }
    let radii = contact_radii::lines(fit, experiments);
    for text in radii
        .into_iter()
        .chain(indentation::lines(fit))
        .chain(relaxing::lines(fit, experiments))
        .chain(line_speed::lines(fit))
    {
        out += &format!("{text}\n");
    }
    if let Some(text) = film(fit, &experiments[0].bodies) {
        out += &format!("{text}\n");
    }
    let found = (&*fit.estimates, &*fit.fixed_values);
    fixed_values::write(&mut out, found, experiments, &files);
    undetermined(&mut out, &fit.undetermined);
    // A wrong sign explains other warnings.
    for (experiment, notes) in experiments.iter().zip(notes) {
        for doubt in &notes.doubts {
            out += &format!("warning: {}: {}\n", experiment.measurement.name, doubt.text);
        }
    }
    warned(&mut out, &fit.warnings);
    out
}

/// Returns the errors expected of planned `experiments`.
pub fn expected(forecast: &Forecast, experiments: &[Experiment], units: &[UnitOf]) -> String {
    let mut out = String::from("expected\n");
    let correlation = &forecast.correlation;
    estimates(&mut out, &forecast.estimates, correlation, &[], units);
    let found = (&*forecast.estimates, &*forecast.fixed_values);
    fixed_values::write(&mut out, found, experiments, &[]);
    undetermined(&mut out, &forecast.undetermined);
    warned(&mut out, &forecast.warnings);
    out
}

/// Returns how a file was read, in one line.
pub fn reading(measurement: &Measurement, notes: &Notes) -> String {
    let mut columns: Vec<String> = notes.columns.iter().map(column).collect();
    columns.dedup();
    let mut text = format!(
        "{}: {} points, {}{}",
        measurement.name,
        measurement.points.len(),
        measurement.kind.name(),
        directions(&measurement.points),
    );
    if !columns.is_empty() {
        text += &format!("; {}", columns.join(", "));
    }
    if let Some(line) = notes.untimed {
        text += &format!("; times are not used: line {line} has none");
    }
    if !notes.unused.is_empty() {
        text += &format!("; not read: {}", unused(&notes.unused));
    }
    if notes.blocks > 1 {
        text += &format!("; {} times headings with rows below them", notes.blocks);
    }
    if let Some(split) = notes.split {
        text += &format!("; split {split}");
    }
    if matches!(notes.marks, Marks::Commas | Marks::UnclearCommas) {
        text += "; commas are decimal";
    }
    for value in notes.from_head() {
        text += &format!("; {value}");
    }
    for (count, what) in [
        (notes.missing, "without values"),
        (notes.pauses, "of a pause"),
        (notes.other_segments, "of another segment"),
        (notes.outside, "outside the range asked for"),
    ] {
        if count > 0 {
            text += &format!("; {count} rows {what} left out");
        }
    }
    text
}

/// Returns the first of the headings of columns that are not read, and the number of the others.
fn unused(headings: &[String]) -> String {
    const SHOWN: usize = 6;
    let shown = headings.iter().take(SHOWN).map(|one| format!("{one:?}"));
    let shown = shown.collect::<Vec<_>>().join(", ");
    match headings.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Returns the number of points of each direction, if one is known.
fn directions(points: &[Point]) -> String {
    let count = |direction| {
        let of = |point: &&Point| point.direction == Some(direction);
        points.iter().filter(of).count()
    };
    match Direction::ALL.map(count) {
        [0, 0] => String::new(),
        [approach, retract] => format!(", {approach} of approach and {retract} of retract"),
    }
}

fn column(source: &Source) -> String {
    let unit = if source.assumed_si {
        " in SI units"
    } else {
        ""
    };
    let sign = if source.factor < 0.0 {
        " with a minus"
    } else {
        ""
    };
    // A column that was named by its number may have no heading.
    let heading = if source.heading.is_empty() {
        format!("column {}", source.index + 1)
    } else {
        format!("{:?}", source.heading)
    };
    format!("{} from {heading}{unit}{sign}", source.role.name())
}

/// Lists the values that are not fitted: one, or that of each file if they differ.
fn fixed_of_all(fit: &Fit, experiments: &[Experiment]) -> Vec<(Cow<'static, str>, String)> {
    let mut coated = experiments.iter().filter(|one| !one.bodies.are_bare());
    let substrate = coated.find_map(|one| one.bodies.base());
    let of = |experiment| fixed(fit, experiment, substrate);
    let all: Vec<Vec<(Cow<'static, str>, String)>> = experiments.iter().map(of).collect();
    // A sample without a film has a modulus without a symbol.
    let value = |text: &str| text.trim_end_matches(" E0").to_owned();
    let mut rows: Vec<(Cow<'static, str>, String)> = Vec::new();
    for (name, _) in all.iter().flatten() {
        if rows.iter().any(|row| row.0 == *name) {
            continue;
        }
        let is_zero = Parameter::ZEROS.iter().any(|zero| zero.name() == *name);
        let texts: Vec<&str> = all
            .iter()
            .filter_map(|rows| {
                let own = rows.iter().find(|row| row.0 == *name);
                // Zeros that are 0 have no row.
                own.map(|row| &*row.1).or(is_zero.then_some("0"))
            })
            .collect();
        let differ = texts.iter().any(|text| value(text) != value(texts[0]));
        rows.push((
            name.clone(),
            texts[..if differ { texts.len() } else { 1 }].join(", "),
        ));
    }
    rows
}

/// Returns the name of a probe with the numbers of its shape but the radius.
fn shape(probe: &Probe) -> String {
    let name = probe.name();
    match *probe {
        Probe::Cone { half_angle }
        | Probe::RoundedCone { half_angle, .. }
        | Probe::FlatEndedCone { half_angle, .. } => {
            let degrees = (half_angle.to_degrees() * 1e9).round() / 1e9;
            format!("{name}, half angle {degrees} degrees")
        }
        Probe::PowerLaw {
            coefficient,
            exponent,
        } => format!("{name} {coefficient:e} r^{exponent}, in m"),
        Probe::Profile(ref profile) => format!("{name} up to r = {:e} m", profile.end()),
        Probe::Paraboloid { .. } | Probe::Sphere { .. } | Probe::FlatPunch { .. } => {
            name.to_owned()
        }
    }
}

/// Returns the values that are not fitted. Zeros of the instrument that are 0 are left out. A bare sample is a reference
/// beside a `substrate` of another material.
fn fixed(
    fit: &Fit,
    experiment: &Experiment,
    substrate: Option<Elastic>,
) -> Vec<(Cow<'static, str>, String)> {
    let text = |value: f64, si: &str| {
        let (unit, size) = scaled(si, value);
        // Without the rounding of the division.
        let number = (value / size * 1e12).round() / 1e12;
        format!("{number} {unit}").trim_end().to_owned()
    };
    let probe = &experiment.bodies.probe;
    let mut rows: Vec<(Cow<'static, str>, String)> = Vec::new();
    let kind = experiment.measurement.kind;
    if !probe.is_paraboloid() {
        rows.push(("probe".into(), shape(probe)));
    }
    if experiment.bodies.are_half_space() {
        rows.push(("bodies".into(), "half-space".to_owned()));
    }
    if let Solver::Stick { advancing, .. } = experiment.bodies.solver
        && advancing < 1.0
    {
        let part = (advancing * 1e4).round() / 1e4;
        let text = format!(
            "stick; work-of-adhesion is that of the receding line, and {part} times it that of the advancing line"
        );
        rows.push(("friction".into(), text));
    }
    // Where elasticity does not tell the contact radius, the probe and the adhesion do not matter.
    let has_hardness = fit.estimate(Parameter::Hardness).is_some();
    let has_shape = experiment.has_shape(has_hardness);
    let bodies = &experiment.bodies;
    let is_reference = bodies.are_bare() && substrate.is_some_and(|other| other != bodies.base);
    let is_listed = |one: Fixed, value: f64| match one {
        Fixed::SphereRadius => has_shape,
        Fixed::ReferenceModulus | Fixed::ReferencePoissonRatio => is_reference,
        Fixed::SubstrateModulus | Fixed::SubstratePoissonRatio => !is_reference,
        Fixed::Parameter(parameter) => {
            fit.estimate(parameter).is_none()
                && (value != 0.0 || parameter.is_positive())
                && (experiment.relaxing.is_none() || parameter != Parameter::WorkOfAdhesion)
                && (!kind.is_stiffness() || experiment.why_without_effect(parameter).is_none())
                && (has_shape || parameter != Parameter::WorkOfAdhesion)
        }
        _ => true,
    };
    let row = |one: Fixed| {
        let value = experiment
            .value_of(one)
            .filter(|&value| is_listed(one, value))?;
        let label = match one {
            Fixed::SubstrateModulus if experiment.bodies.are_coated() => ", Young's modulus E0",
            Fixed::SubstrateModulus
            | Fixed::ReferenceModulus
            | Fixed::Layer(_, LayerQuantity::Modulus) => ", Young's modulus",
            Fixed::Parameter(parameter) => which_modulus(parameter),
            _ => "",
        };
        Some((one.name(), format!("{}{label}", text(value, one.unit()))))
    };
    let quantities = experiment.quantities().into_iter();
    let (parameters, of_bodies): (Vec<Fixed>, Vec<Fixed>) =
        quantities.partition(|one| one.parameter().is_some());
    rows.extend(of_bodies.into_iter().filter_map(row));
    for (i, named) in experiment.bodies.layers.iter().enumerate() {
        if let Some(interface) = interface(named, |stiffness| text(stiffness, "Pa/m")) {
            let name = named.name.map(|name| name.to_string());
            let name = name.unwrap_or_else(|| format!("layer-{}", i + 1));
            rows.push((format!("{name}.interface").into(), interface));
        }
    }
    rows.extend(relaxing::fixed(experiment));
    rows.extend(parameters.into_iter().filter_map(row));
    if kind.is_stiffness() {
        rows.extend(indentation::fixed(experiment));
    }
    rows
}

/// Says what joins a layer to what lies below it, as far as its `interface-stiffness` does not; `None`
/// if it is bonded.
fn interface(named: &NamedLayer, text: impl Fn(f64) -> String) -> Option<String> {
    let [tangential, normal] = named.layer.interface.stiffnesses();
    let sideways = match named.interface_stiffness() {
        _ if named.layer.interface.is_bonded() => return None,
        None if tangential == 0.0 => Some("sliding".to_owned()),
        Some(stiffness) if named.name.is_none() => {
            Some(format!("tangential stiffness {}", text(stiffness)))
        }
        _ => None,
    };
    let normal = normal
        .is_finite()
        .then(|| format!("normal stiffness {}", text(normal)));
    let parts: Vec<String> = sideways.into_iter().chain(normal).collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// Says which modulus a parameter is.
const fn which_modulus(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::SphereModulus => ", reduced modulus E2*",
        Parameter::FilmModulus => ", Young's modulus E1",
        Parameter::Layer(_, LayerQuantity::Modulus) => ", Young's modulus",
        _ => "",
    }
}

/// Returns Young's modulus of the sphere, if its Poisson ratio is known and its reduced modulus
/// was found.
fn young_of_sphere(fit: &Fit, experiment: &Experiment, asked: &[UnitOf]) -> Option<String> {
    let poisson = experiment.sphere_poisson_ratio?;
    let found = fit.estimate(Parameter::SphereModulus)?;
    let young = found.young_of_sphere(poisson);
    Some(format!(
        "{}, Young's modulus E2 = E2* (1 - nu2^2), nu2 = {poisson}",
        value(&young, asked)
    ))
}

/// Writes estimates, each with its file if it is one file's own of several, and their correlation.
fn estimates(
    out: &mut String,
    estimates: &[Estimate],
    correlation: &[Vec<f64>],
    files: &[&str],
    asked: &[UnitOf],
) {
    let name = |estimate: &Estimate| name(estimate, files);
    for estimate in estimates {
        let (value, modulus) = (value(estimate, asked), which_modulus(estimate.parameter));
        let given = given(estimate, asked);
        *out += &format!("  {:<NAME$} {value}{modulus}{given}\n", name(estimate));
    }
    if estimates.len() > 1 {
        *out += "\ncorrelation\n";
        for (i, (estimate, row)) in estimates.iter().zip(correlation).enumerate() {
            let row = row[..=i].iter().map(|value| format!("{value:>7.3}"));
            let row: String = row.collect();
            *out += &format!("  {:<NAME$} {row}\n", name(estimate));
        }
    }
}

/// Writes the combinations that data do not determine.
fn undetermined(out: &mut String, combinations: &[Combination]) {
    for text in Combination::texts(combinations) {
        *out += &format!("the data do not determine {text}\n");
    }
}

/// Adds the warnings, a line each.
fn warned(out: &mut String, warnings: &[Warning]) {
    for warning in warnings {
        *out += &format!("warning: {}\n", warning.text);
    }
}

/// Says whether the film matters, or the layers.
fn film(fit: &Fit, bodies: &Bodies) -> Option<String> {
    let without = fit.without_film.as_ref()?;
    let layered = bodies.are_layered();
    let [what, it] = if layered {
        ["layers", "them"]
    } else {
        ["film", "it"]
    };
    let Some(bias) = without.modulus else {
        let number = |chi_squared: f64| {
            if (0.1..1e7).contains(&chi_squared) {
                format!("{chi_squared:.1}")
            } else {
                format!("{chi_squared:.1e}")
            }
        };
        return Some(format!(
            "chi^2 is {} without the {what}, and {} with {it}",
            number(without.chi_squared),
            number(fit.chi_squared)
        ));
    };
    let ModulusBias {
        parameter,
        relative,
        standard_errors,
    } = bias;
    let errors = standard_errors.abs();
    let errors = if errors < 9.95 {
        format!("{errors:.1}")
    } else {
        format!("{errors:.0}")
    };
    let verdict = match (bias.matters(), layered) {
        (true, true) => "matter",
        (true, false) => "matters",
        (false, true) => "do not matter",
        (false, false) => "does not matter",
    };
    let mut text = format!(
        "the {what} {verdict}: {parameter} is off by {:+.1} % ({errors} standard errors) without {it}",
        100.0 * relative
    );
    // The modulus may be right by chance, as between films of different thickness.
    if !bias.matters() && without.chi_squared - fit.chi_squared > WORSE {
        text += &format!(
            ", but chi^2 is then {:.0} instead of {:.0}",
            without.chi_squared, fit.chi_squared
        );
    }
    Some(text)
}
