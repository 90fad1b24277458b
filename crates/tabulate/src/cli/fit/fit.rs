//! `tabulate fit`

use std::path::{Path, PathBuf};

use ::fit::data::{Cantilever, Column, Doubt, DoubtKind, Format, Notes, SENSITIVITIES, Segments};
use ::fit::report::{UnitOf, report};
use ::fit::{Direction, Experiment, Fixed, Kind, Loss, Options, Parameter, Scope};
use anyhow::{Context, anyhow, bail, ensure};
use clap::ValueHint;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use interp::Table;
use units::{Dimension, Quantity};

use super::elapsed_time::elapsed_time;
use super::experiments::{KnownArguments, TWO_WORKS};
use super::free::FreeArguments;
use super::indentation::{
    Noise, ReferenceArguments, abscissa_noise, accept_no_radius, are_at_depths,
};
use super::next_steps::{further_doubts, next_steps};
use super::picture::PictureArguments;
use super::reading::{doubted, measured, typed, with_doubts};
use super::setting::{Given, Values, check_units, unit_of};
use super::{experiments, indentation, object, table};
use crate::cli::allow::{self, Allowed};
use crate::cli::output::Output;
use crate::cli::quantity::{any, number, read};
use crate::cli::table_name::{self, TableName};
use crate::cli::{json, note, print};
use crate::printable;

/// The number of files above which a note says that a fit of all together is slow.
const MANY_FILES: usize = 100;

/// Find moduli and work of adhesion from measured contacts, with their errors
///
/// Each DATA file is a table of text: cells between tabs, semicolons, commas or spaces, a decimal
/// point or comma, comment lines (#, % or //) and other lines before the headings. Columns are
/// recognised by headings with a unit, such as `Force [mN]`, `Radius (um)`, `height_nm`,
/// `Piezo/nm`; --column names others. Without a unit, the names contact_radius, penetration, load,
/// force, time, height, `height (measured)`, `height (piezo)`, contact_stiffness, contact_area, phase_shift
/// and loss_stiffness are in SI units, all others an error.
/// A heading of one of these with error, std, sd, sigma or uncertainty, such as `load error [mN]`
/// and `radius_std`, is the column of its standard deviations. Each curve has a file of its own; its
/// segments may have headings of their own. The stiffness and the sensitivity of the cantilever are
/// those that the head of the file names, unless flags give others.
///
/// A contact stiffness (--kind stiffness-radius, stiffness-load, stiffness-depth) is that of a pinned
/// contact line, as nanoindenters (CSM) and dynamic AFMs measure it. With a column of its phase or of
/// its loss part, the modulus of the film is the absolute value of a complex one, and the report gives
/// the loss tangent.
///
/// Loads are positive in compression; heights are smaller when the cantilever is closer to the
/// sample: contact point - height = penetration + force/stiffness.
///
/// A film is looked up in the table. A stack of layers (--stack) is solved directly, which takes
/// some tenths of a second, and the modulus and the thickness of its layers can be free; or it is
/// looked up where --stack names a table of the stack.
///
/// Values that the fit needs and that are not given are an error that lists them. A value of the bodies
/// is fixed unless it is free (--free). A free modulus of sphere or film, if the other
/// is known, and a free work of adhesion need no value: the fit takes its start from the data.
///
/// With --relaxation the film relaxes in time. The points of a file are an approach, a hold and a
/// retract without adhesion; they give the modulus of the film and its relaxation function. The effect
/// of the film thickness is exact. A gel also relaxes by flow of its solvent, and that is no law of the
/// material: its time grows like the square of the contact radius. Fit curves of two radii: a material
/// has the same relaxation times at both.
///
/// Where adhesion depends on the speed v of the contact line, as under a lens of an elastomer, contact radii in time tell the
/// law: --free ...,doubling-speed,speed-exponent. The work of adhesion is then that of a line at rest, and the energy release
/// rate is w (1 + (v/v0)^n) where the line recedes and w / (1 + (v/v0)^n) where it advances, with the doubling-speed v0 and
/// the speed-exponent n. The speeds are read from the radii and a column of times.
///
/// With --friction stick, surfaces that have touched never slide, and each contact is solved directly;
/// without it, a warning says where full friction would change the modulus by more than its standard
/// error.
///
/// Which points are in contact is read from the data: points up to the jump of pull-off are in
/// contact, those after it are the baseline. With several files, the parameters are common to all
/// files unless they are the file's own: a global fit of films of several thicknesses is
/// --value film-thickness=1um,10um, and one of several spheres --value sphere-radius=1mm,3mm.
///
/// The exit status is 0 only if the fit has converged, all values have finite errors, and at most a
/// third of the points in contact is left out.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate fit crates/fit/data/lens.csv --specimen paper --film-thickness 30um",
    "tabulate fit crates/fit/data/lens.csv --specimen paper --film-thickness 30um --noise 2uN --json",
    "tabulate fit crates/fit/data/primer.csv --specimen paper --stack tables/stacks/primer.toml",
))]
pub struct Arguments {
    /// The measurements: tables of text
    #[arg(required = true, value_name = "DATA", value_hint = ValueHint::FilePath)]
    data: Vec<PathBuf>,
    /// The two quantities that were measured [default: the only ones that the columns fit]
    #[arg(long, value_parser = kinds())]
    kind: Option<Kind>,
    /// A column that is not recognised: NAME=HEADING [UNIT]. NAME is one of contact_radius, load,
    /// penetration, height, deflection, separation, segment, time, contact_stiffness, contact_area, phase_shift and
    /// loss_stiffness, or with _error a column of standard deviations: load_error. The number of the column may stand for the heading, with `extend` or `retract`
    /// after it for one direction; a minus before it turns the sign
    #[arg(long = "column", value_name = "NAME=HEADING [UNIT]")]
    columns: Vec<Column>,
    /// Sensitivity, m of deflection for each V, of a deflection in volts [default: that of the file]
    #[arg(long, value_name = "m/V", value_parser = sensitivity)]
    sensitivity: Option<f64>,
    /// Where the directions of points come from: a column segment, phase or direction, comments
    /// `segment: retract` or headings of the file (file), or the turn of the height, penetration or load
    /// that is the abscissa, and at contact radii the largest ordinate (split). auto: from the file, and
    /// heights without a direction are split
    #[arg(long, default_value = "auto", value_parser = one_of(Segments::ALL.map(|one| (one.name(), one))))]
    segments: Segments,
    /// Keep the points of one direction only
    #[arg(long, value_parser = one_of(Direction::ALL.map(|one| (one.name(), one))))]
    only: Option<Direction>,
    /// Keep the points whose radius, penetration, height or load lies in a range: 60nm..250nm
    #[arg(long, value_name = "LEAST..MOST", value_parser = indentation::range)]
    between: Option<[Quantity; 2]>,
    #[command(flatten)]
    known: KnownArguments,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    reference: ReferenceArguments,
    /// Value and standard error of a quantity that is not free, in SI units or with units:
    /// film-thickness=2e-6+-1e-7, also sphere-radius, half-angle=+-2deg, substrate-modulus, substrate-poisson-ratio,
    /// reference-modulus, reference-poisson-ratio, beta. A value that is given elsewhere is left out: film-thickness=+-3%, a part by which the values of all files err
    /// together. The calibration of an instrument, by which all its readings err together, is one of contact-radius,
    /// penetration, height, load (also by the sensitivity of a deflection), contact-stiffness: load=+-2%. Can be given several times. The fit keeps the value, and its error adds to the standard errors:
    /// to the first order, as one of several independent errors. --prior instead lets the data move
    /// a free value
    #[arg(long = "known", value_name = "NAME=[VALUE]+-ERROR")]
    given: Vec<Given>,
    /// Standard deviation of a load (N) or penetration (m), or of a contact stiffness in per cent (1%): one number, or one for each file, separated by commas [default: that
    /// of a column of standard deviations, such as `load error [mN]`, or estimated from the
    /// residuals]
    #[arg(
        long,
        value_name = "S",
        value_delimiter = ',',
        value_parser = indentation::noise,
        allow_hyphen_values = true
    )]
    noise: Vec<Noise>,
    /// Standard deviation of a contact radius, penetration or height, m, or of a contact stiffness at loads a load, N:
    /// one number, or one for each file, separated by commas
    /// [default: that of a column such as `radius_error [um]`, or exact]. It counts by the slope of
    /// the model: the variance of a point is that of its load plus (slope x S)^2
    #[arg(
        long,
        visible_alias = "radius-noise",
        value_name = "S",
        value_delimiter = ',',
        value_parser = any
    )]
    abscissa_noise: Vec<Quantity>,
    /// Robust loss, for data with outliers: Huber's with the threshold 1.345, or the soft L1 loss
    #[arg(long, value_parser = one_of([("huber", Loss::HUBER), ("soft-l1", Loss::SOFT_L1)]))]
    robust: Option<Loss>,
    /// Intervals from the profile of the likelihood, at a level such as 0.95
    #[arg(long, value_name = "LEVEL", value_parser = number)]
    intervals: Option<f64>,
    #[arg(
        long,
        default_value = "embedded",
        help = table_name::HELP,
        value_hint = ValueHint::FilePath
    )]
    table: TableName,
    /// Units of the report: film-modulus=MPa [default: such that numbers are above 1]
    #[arg(
        long,
        value_name = "NAME=UNIT,...",
        value_parser = unit_of,
        value_delimiter = ',',
        conflicts_with = "json"
    )]
    units: Vec<UnitOf>,
    /// Print a JSON object in SI units instead of the report
    ///
    /// {"created_by": program and version, "command", "read": [how each file was read], "converged": bool, "parameters": {"film_modulus": {"value", "stderr", "unit"}, ...},
    /// "sphere_young_modulus" with --sphere-poisson-ratio, "correlation": [[...]],
    /// "reduced_chi_squared", "noise", "abscissa_noise", "a_over_t": [least, most], "left_out", "line_speed": [least, most] in m/s with a doubling-speed, "loss": {"angle", "tangent", "stderr"} where
    /// phases are measured, "relaxation": {"law", "moduli": [{"time", "modulus"}, ...], "made_monotone",
    /// "unlike_bodies", "steps_error"} with --relaxation, "without_film": {...},
    /// "fixed_values": [{"name", "value", "unit", "step", "changes", "error"}], "warnings":
    /// [{"kind", "text"}]}. A parameter of which each file has its
    /// own is a list, with null, which has no row of the correlation, for a file that has none. With --intervals each parameter has an "interval". An infinite number is the text
    /// "inf" or "-inf", and one that is not known null.
    #[arg(long)]
    json: bool,
    /// Write data, fit, residual and branch of every point here
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    picture: PictureArguments,
}

/// Returns a path from the root, as far as its text tells.
fn absolute(path: Option<&Path>) -> Option<PathBuf> {
    std::path::absolute(path?).ok()
}

/// Parses the name of a kind.
pub fn kinds() -> impl TypedValueParser<Value = Kind> {
    one_of(Kind::ALL.map(|kind| (kind.name(), kind)))
}

/// Parses one of several names.
pub fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    choices: [(&'static str, T); N],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(choices.map(|(name, _)| name)).map(move |given| {
        let chosen = choices.iter().find(|(name, _)| *name == given);
        chosen.expect("clap accepts these names only").1
    })
}

/// Reads the sensitivity of a deflection.
fn sensitivity(text: &str) -> Result<f64, String> {
    let value = read(text, Some(Dimension::LengthPerVoltage))?;
    let [least, most] = SENSITIVITIES;
    if !(least..=most).contains(&value.abs()) {
        return Err(format!(
            "{value:?} m/V is no sensitivity, which is from {least:e} to {most:e} m/V: write its unit, such as 50nm/V"
        ));
    }
    Ok(value)
}

impl Arguments {
    /// Returns the stiffness of the cantilever of a file, by its number, as a flag gives it.
    fn stiffness(&self, values: &[Values], file: usize) -> Option<f64> {
        const STIFFNESS: Fixed = Fixed::Parameter(Parameter::Stiffness);
        let known = self.given.iter().find(|one| one.quantity == STIFFNESS);
        let own = values.iter().find(|one| one.quantity == STIFFNESS);
        let own = own.and_then(|one| one.values.get(file).or(one.values.first()));
        let said = known.and_then(|one| one.value).or(own.copied());
        said.or(self.known.stiffness)
    }

    /// Returns what is known of the files before they are read.
    fn format(&self) -> Format {
        Format {
            between: self.between.clone(),
            kind: self.kind,
            columns: self.columns.clone(),
            cantilever: Cantilever {
                stiffness: self.known.stiffness,
                sensitivity: self.sensitivity,
            },
            segments: self.segments,
            only: self.only,
            keep_pauses: self.known.relaxing.is_given(),
        }
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let data = arguments.data.iter().map(|path| Some(path.as_path()));
    let inputs: Vec<Option<&Path>> = data
        .chain(arguments.known.bodies.files())
        .chain([
            arguments.table.path(),
            arguments.reference.reference.as_deref(),
        ])
        .collect();
    ensure!(
        arguments.csv.is_none()
            || absolute(arguments.csv.as_deref()) != absolute(arguments.picture.path()),
        "--csv and --plot name the same file; choose two names"
    );
    ensure!(
        arguments.between.is_none() || !arguments.known.relaxing.is_given(),
        "--between cuts a piece out of the course, and the forces of bodies that relax depend on all that was before: leave \
         it out"
    );
    let csv = arguments.csv.as_deref();
    let csv = csv.map(|_| Output::of_text(csv, &inputs)).transpose()?;
    let plot = arguments.picture.path();
    let plot = plot.map(|_| Output::of_text(plot, &inputs)).transpose()?;
    let files = arguments.data.len() + usize::from(arguments.reference.reference.is_some());
    for (flag, noises) in [
        ("--noise", arguments.noise.len()),
        ("--abscissa-noise", arguments.abscissa_noise.len()),
    ] {
        ensure!(
            noises <= 1 || noises == files,
            "{flag}: {noises} values for {files} files; give one, or one for each file"
        );
    }
    let values = arguments.known.all_values()?;
    let mut format = arguments.format();
    let (mut measurements, mut beside, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    let mut times = Vec::new();
    let paths = arguments.data.iter().chain(&arguments.reference.reference);
    for (i, path) in paths.enumerate() {
        format.cantilever.stiffness = arguments.stiffness(&values, i);
        let reading = measured(path, &format)?;
        measurements.push(reading.measurement);
        beside.push((reading.errors, reading.loads, reading.phases));
        times.push(reading.times);
        notes.push(reading.notes);
    }
    let mut abscissae: Vec<&str> = measurements.iter().map(|one| one.kind.names()[0]).collect();
    abscissae.dedup();
    ensure!(
        arguments.abscissa_noise.len() != 1 || abscissae.len() == 1,
        "--abscissa-noise is one number, and the abscissae of the files are {}: give a number for each file, separated by \
         commas, and 0 for those that are exact",
        abscissae.join(", ")
    );
    let reference = measurements.split_off(arguments.data.len()).pop();
    let mut experiments = arguments.known.experiments(measurements, &times)?;
    if let Some(measurement) = reference {
        let reference = &arguments.reference;
        experiments.push(reference.experiment(measurement, &experiments[0])?);
    }
    for ((i, experiment), (errors, loads, phases)) in experiments.iter_mut().enumerate().zip(beside)
    {
        let kind = experiment.measurement.kind;
        experiment.indentation.loads = loads;
        experiment.indentation.phases = phases;
        if kind == Kind::ForceHeight {
            let of_file = notes[i].cantilever.stiffness;
            // That with which the file was read: of several flags --known counts.
            experiment.stiffness = of_file.or(experiment.stiffness);
            experiment.from_deflection = notes[i].has_deflection();
        }
        for Given {
            quantity, value, ..
        } in &arguments.given
        {
            if let Some(parameter) = quantity.parameter()
                && parameter.is_work_of_adhesion()
                && arguments.known.history.work_of_adhesion_receding.is_some()
            {
                bail!("--known {parameter}: {TWO_WORKS}");
            }
            let Some(value) = *value else { continue };
            let is_reference = i >= arguments.data.len();
            if arguments.reference.is_apart(*quantity, is_reference) {
                continue;
            }
            let set = experiment.set_fixed(*quantity, value);
            if is_reference && set.is_err() {
                // A reference sample has no film.
                continue;
            }
            set.with_context(|| format!("--known {}={value:?}", quantity.name()))?;
        }
        // A flag stands for a column.
        experiment.errors = errors;
        if let Some(noise) = arguments.noise.get(i).or(arguments.noise.first()) {
            experiment.noise = Some(noise.of(kind)?);
            experiment.errors.ordinate.clear();
        }
        let of_file = arguments.abscissa_noise.get(i);
        if let Some(noise) = of_file.or(arguments.abscissa_noise.first()) {
            experiment.abscissa_noise = abscissa_noise(noise, kind)?;
            experiment.errors.abscissa.clear();
        }
        experiment.sphere_poisson_ratio = arguments.known.history.sphere_poisson_ratio;
    }
    if are_at_depths(&experiments) {
        accept_no_radius("--known", arguments.given.iter().map(|one| one.quantity))?;
    }
    let system = &arguments.known.bodies.system;
    for given in &arguments.given {
        given.accept_once(&arguments.known, &arguments.reference, &values)?;
    }
    let free = arguments.free.of(&experiments, &values, system)?;
    let parameters: Vec<Parameter> = free.iter().map(|one| one.parameter).collect();
    arguments.known.accept_free(&parameters)?;
    if arguments.data.len() > MANY_FILES && free.iter().any(|one| one.scope == Scope::Own) {
        note(&format!(
            "{} files are fitted together, and some parameters are each file's own: the time grows with more than the square of \
             the number of files. Files that have no parameter in common can be fitted one by one, by a loop in the shell.",
            arguments.data.len()
        ));
    }
    arguments.reference.check(&free)?;
    let quantities = values.iter().map(|set| set.quantity);
    let quantities = quantities.chain(arguments.given.iter().map(|one| one.quantity));
    let set: Vec<Parameter> = quantities.filter_map(Fixed::parameter).collect();
    // A tilt that is fitted is none to doubt, and cycles in time are one course of the contact line.
    let speed = Parameter::DoublingSpeed;
    let answered = [
        (
            parameters.contains(&Parameter::BaselineSlope),
            DoubtKind::Tilt,
        ),
        (
            parameters.contains(&speed) || set.contains(&speed),
            DoubtKind::Curves,
        ),
    ];
    for (_, kind) in answered.into_iter().filter(|(is_answered, _)| *is_answered) {
        let lists = notes.iter_mut().map(|notes| &mut notes.doubts);
        lists.for_each(|doubts| doubts.retain(|doubt: &Doubt| doubt.kind != kind));
    }
    arguments
        .known
        .relaxing
        .ask(&experiments[0], &[parameters, set].concat())?;
    experiments::forget_shapes(&mut experiments, &free);
    ensure!(
        arguments.known.history.sphere_poisson_ratio.is_none()
            || arguments.known.history.is_stuck()
            || free
                .iter()
                .any(|free| free.parameter == Parameter::SphereModulus),
        "--sphere-poisson-ratio: Young's modulus of the sphere follows from its reduced modulus, \
         which is not free; free it, --free sphere-modulus, or let the surfaces stick, --friction \
         stick, or leave the Poisson ratio out"
    );
    let in_heights = |one: &Experiment| one.measurement.kind == Kind::ForceHeight;
    ensure!(
        notes.iter().any(Notes::has_deflection)
            || experiments.iter().any(in_heights)
            || arguments.known.stiffness.is_none(),
        "--stiffness is that of a cantilever, and no file has heights or deflections: leave it out, or name the \
         columns, --column height=.."
    );
    ensure!(
        arguments.sensitivity.is_none() || notes.iter().any(Notes::has_volts),
        "--sensitivity is that of deflections in V, and no file has them: leave it out, or give the unit of the \
         column, --column \"deflection=HEADING [V]\""
    );
    check_units(&arguments.units, &free)?;
    arguments.known.ask(&experiments, &free, &arguments.given)?;
    let allowed = &arguments.known.bodies.allow;
    for experiment in &experiments {
        allow::magnitudes(&experiment.magnitudes(), allowed)
            .with_context(|| experiment.measurement.name.clone())
            .map_err(|error| with_doubts(error, &experiments, &notes))?;
    }
    let table = arguments.table.read_for_contacts()?;
    let table: &Table = &table;
    let (data, sample) = experiments.split_at(arguments.data.len());
    let known = arguments.given.iter().map(|one| one.known(data, sample));
    let options = Options {
        loss: arguments.robust.unwrap_or(Loss::Squares),
        profile_level: arguments.intervals,
        known: known.collect::<Result<_, _>>()?,
        fixed_values: true,
        allow_left_out: allowed.contains(&Allowed::LeftOut),
        ..Options::default()
    };
    let shown = elapsed_time();
    let fit = ::fit::fit(table, &experiments, &free, &options)
        .map_err(|error| doubted(error, &experiments, &notes))?;
    drop(shown);
    if fit.found_values() {
        allow::magnitudes(&fit.magnitudes(), allowed)
            .map_err(|error| anyhow!("{error}{}", further_doubts(&fit, &experiments)))
            .map_err(|error| with_doubts(error, &experiments, &notes))?;
    }
    // A picture that cannot be drawn is told before anything is written.
    let drawn = arguments.picture.drawn(&fit, &experiments)?;
    if arguments.json {
        json::print(&object::fit(&fit, &experiments, &notes))?;
    } else {
        let mut report = report(&fit, &experiments, &notes, &arguments.units);
        for doubt in notes.iter().flat_map(|notes| &notes.doubts) {
            let Some(remedy) = &doubt.remedy else {
                continue;
            };
            let cause = match doubt.kind {
                DoubtKind::Sign => "sign is wrong",
                DoubtKind::Tilt => "baseline is tilted",
                _ => "directions are wrong",
            };
            let step = format!("if the {cause}, {}\n", typed(remedy));
            if !report.ends_with(&step) {
                report += &step;
            }
        }
        report += &next_steps(&fit, &experiments);
        print(printable::lines(&report).as_bytes())?;
    }
    // The result is printed even if a file cannot be written.
    if let Some(csv) = csv {
        csv.write(&table::csv(&fit, &experiments)?)?;
    }
    if let (Some(plot), Some(drawn)) = (plot, drawn) {
        plot.write(&drawn)?;
    }
    ensure!(
        fit.converged,
        "the fit did not converge; free fewer parameters, or give starts (--value) and bounds"
    );
    Ok(())
}
