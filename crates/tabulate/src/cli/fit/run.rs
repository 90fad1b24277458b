//! The steps of `tabulate fit`: reads the files, takes what is given, checks it, fits and prints.

use std::path::{Path, PathBuf};

use ::fit::data::{Doubt, DoubtKind, Notes};
use ::fit::report::report;
use ::fit::{Experiment, Fit, Fixed, Free, Kind, Loss, Options, Parameter, Scope};
use anyhow::{Context, anyhow, bail, ensure};
use interp::Table;

use super::elapsed_time::elapsed_time;
use super::experiments::TWO_WORKS;
use super::fit::Arguments;
use super::indentation::{abscissa_noise, accept_no_radius, are_at_depths};
use super::next_steps::{further_doubts, next_steps};
use super::reading::{doubted, measured, typed, with_doubts};
use super::setting::{Given, Values, check_units};
use super::{experiments, object, table};
use crate::cli::allow::{self, Allowed};
use crate::cli::output::Output;
use crate::cli::{json, note, print};
use crate::printable;

/// The number of files above which a note says that a fit of all together is slow.
const MANY_FILES: usize = 100;

/// The measurements with what the command line gives, that of a reference sample last, and how each file was read.
struct Data {
    experiments: Vec<Experiment>,
    notes: Vec<Notes>,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    ensure!(
        arguments.between.is_none() || !arguments.known.relaxing.is_given(),
        "--between cuts a piece out of the course, and the forces of bodies that relax depend on all that was before: leave \
         it out"
    );
    let [csv, plot] = outputs(arguments)?;
    let values = arguments.known.all_values()?;
    let mut data = data(arguments, &values)?;
    let free = free(arguments, &mut data, &values)?;
    check(arguments, &data, &free)?;
    let fit = fitted(arguments, &data, &free)?;
    // A picture that cannot be drawn is told before anything is written.
    let drawn = arguments.picture.drawn(&fit, &data.experiments)?;
    if arguments.json {
        json::print(&object::fit(&fit, &data.experiments, &data.notes))?;
    } else {
        print(printable::lines(&text(arguments, &fit, &data)).as_bytes())?;
    }
    // The result is printed even if a file cannot be written.
    if let Some(csv) = csv {
        csv.write(&table::csv(&fit, &data.experiments)?)?;
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

/// Opens the files that the fit writes: points and picture.
fn outputs(arguments: &Arguments) -> anyhow::Result<[Option<Output<'_>>; 2]> {
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
    let csv = arguments.csv.as_deref();
    let csv = csv.map(|_| Output::of_text(csv, &inputs)).transpose()?;
    let plot = arguments.picture.path();
    let plot = plot.map(|_| Output::of_text(plot, &inputs)).transpose()?;
    Ok([csv, plot])
}

/// Returns a path from the root, as far as its text tells.
fn absolute(path: Option<&Path>) -> Option<PathBuf> {
    std::path::absolute(path?).ok()
}

/// Reads the files and gives them the values of the command line.
fn data(arguments: &Arguments, values: &[Values]) -> anyhow::Result<Data> {
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
    let mut format = arguments.format();
    let (mut measurements, mut beside, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    let mut times = Vec::new();
    let paths = arguments.data.iter().chain(&arguments.reference.reference);
    for (i, path) in paths.enumerate() {
        format.cantilever.stiffness = arguments.stiffness(values, i);
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
        take_given(arguments, experiment, i)?;
        experiment.errors = errors;
        take_noises(arguments, experiment, i)?;
        experiment.sphere_poisson_ratio = arguments.known.history.sphere_poisson_ratio;
    }
    Ok(Data { experiments, notes })
}

/// Gives the experiment of a file, by its number, the values of `--known`.
fn take_given(
    arguments: &Arguments,
    experiment: &mut Experiment,
    file: usize,
) -> anyhow::Result<()> {
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
        let is_reference = file >= arguments.data.len();
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
    Ok(())
}

/// Gives the experiment of a file, by its number, the noises of the command line, which stand for columns.
fn take_noises(
    arguments: &Arguments,
    experiment: &mut Experiment,
    file: usize,
) -> anyhow::Result<()> {
    let kind = experiment.measurement.kind;
    if let Some(noise) = arguments.noise.get(file).or(arguments.noise.first()) {
        experiment.noise = Some(noise.of(kind)?);
        experiment.errors.ordinate.clear();
    }
    let of_file = arguments.abscissa_noise.get(file);
    if let Some(noise) = of_file.or(arguments.abscissa_noise.first()) {
        experiment.abscissa_noise = abscissa_noise(noise, kind)?;
        experiment.errors.abscissa.clear();
    }
    Ok(())
}

/// Returns the free parameters, and takes doubts that they answer from the notes.
fn free(arguments: &Arguments, data: &mut Data, values: &[Values]) -> anyhow::Result<Vec<Free>> {
    let Data { experiments, notes } = data;
    if are_at_depths(experiments) {
        accept_no_radius("--known", arguments.given.iter().map(|one| one.quantity))?;
    }
    let system = &arguments.known.bodies.system;
    for given in &arguments.given {
        given.accept_once(&arguments.known, &arguments.reference, values)?;
    }
    let free = arguments.free.of(experiments, values, system)?;
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
    experiments::forget_shapes(experiments, &free);
    Ok(free)
}

/// Refuses flags that nothing uses, values that are missing, and magnitudes that no contact has.
fn check(arguments: &Arguments, data: &Data, free: &[Free]) -> anyhow::Result<()> {
    let Data { experiments, notes } = data;
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
    check_units(&arguments.units, free)?;
    arguments.known.ask(experiments, free, &arguments.given)?;
    let allowed = &arguments.known.bodies.allow;
    for experiment in experiments {
        allow::magnitudes(&experiment.magnitudes(), allowed)
            .with_context(|| experiment.measurement.name.clone())
            .map_err(|error| with_doubts(error, experiments, notes))?;
    }
    Ok(())
}

fn fitted(arguments: &Arguments, data: &Data, free: &[Free]) -> anyhow::Result<Fit> {
    let Data { experiments, notes } = data;
    let allowed = &arguments.known.bodies.allow;
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
    let fit = ::fit::fit(table, experiments, free, &options)
        .map_err(|error| doubted(error, experiments, notes))?;
    drop(shown);
    if fit.found_values() {
        allow::magnitudes(&fit.magnitudes(), allowed)
            .map_err(|error| anyhow!("{error}{}", further_doubts(&fit, experiments)))
            .map_err(|error| with_doubts(error, experiments, notes))?;
    }
    Ok(fit)
}

/// Returns the report, with what to type next.
fn text(arguments: &Arguments, fit: &Fit, data: &Data) -> String {
    let Data { experiments, notes } = data;
    let mut report = report(fit, experiments, notes, &arguments.units);
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
    report + &next_steps(fit, experiments)
}
