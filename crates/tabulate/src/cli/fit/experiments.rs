//! The experiments, from the arguments and the measurements.

use std::sync::Arc;

use ::fit::{
    Bodies, Direction, Experiment, Fixed, Free, Kind, Measurement, NamedLayer, Parameter, Point,
    Solver, starts_from_data,
};
use anyhow::{Context, bail, ensure};

use super::indentation::{
    IndentationArguments, accept_no_radius, accept_no_shape, are_at_depths, forget_shape,
};
use super::relaxing::RelaxingArguments;
use super::setting::{Given, Values};
use super::value::{fixed, questions};
use crate::cli::bodies::{self, BodiesArguments};
use crate::cli::friction::HistoryArguments;
use crate::cli::quantity::force_per_length;
use crate::cli::stack_file::Layers;
use crate::cli::system::{self, Value};

/// The flags of known values.
#[derive(clap::Args)]
pub struct KnownArguments {
    #[command(flatten)]
    pub bodies: BodiesArguments,
    #[command(flatten)]
    pub history: HistoryArguments,
    /// Stiffness of the cantilever, N/m
    #[arg(long, value_name = "N/m", value_parser = force_per_length)]
    pub stiffness: Option<f64>,
    /// Value of a parameter, of sphere-radius, half-angle, substrate-modulus or substrate-poisson-ratio, in SI units or with
    /// its unit: the fixed value, or where the fit starts if the parameter is free. NAME=VALUE,VALUE,... gives each
    /// file its own. It counts in place of the flag of the same name, wherever it stands
    #[arg(long = "value", value_name = "NAME=VALUE")]
    pub values: Vec<Values>,
    #[command(flatten)]
    pub indentation: IndentationArguments,
    #[command(flatten)]
    pub relaxing: RelaxingArguments,
}

impl KnownArguments {
    /// Lists the values of the bodies that neither a flag nor a --value gives, and that are needed.
    fn missing(&self) -> Vec<Value> {
        let mut missing = self.bodies.missing();
        let values = |quantity| self.values.iter().find(|set| set.quantity == quantity);
        // A substrate that is rigid needs no Poisson ratio.
        if let Some(moduli) = values(Fixed::SubstrateModulus) {
            let ratio = Value::SubstratePoissonRatio;
            missing.retain(|value| *value != ratio);
            let is_rigid = moduli.values.iter().all(|modulus| modulus.is_infinite());
            let has_substrate = !self.bodies.half_space && self.bodies.stack.is_none();
            if has_substrate && !is_rigid && self.bodies.system.given(ratio).is_none() {
                missing.push(ratio);
            }
        }
        let given = |quantity| values(quantity).is_some();
        missing.retain(|value| !given(self.fixed(*value)));
        if self.relaxing.is_given() {
            missing.retain(|value| *value != Value::WorkOfAdhesion);
        }
        missing
    }

    /// Names the values that the paper's example stands in for in an experiment, in a comment line.
    pub fn name_example(&self, experiment: &Experiment) {
        if self.bodies.system.specimen.is_none() {
            let mut missing = self.missing();
            if !experiment.has_shape(false) {
                missing.retain(|value| !is_of_shape(*value));
            }
            system::name_example(&missing);
        }
    }

    /// Returns the values given by --value and by the flags of the law.
    pub fn all_values(&self) -> anyhow::Result<Vec<Values>> {
        Ok([&self.values[..], &self.relaxing.values()?].concat())
    }

    /// Returns the value of a fit that one of the bodies is.
    pub fn fixed(&self, value: Value) -> Fixed {
        fixed(value, self.bodies.interface.is_layer())
    }

    /// Asks for all that a fit of experiments needs and nobody gives. The values of free parameters
    /// are needed only where the data do not tell where to start.
    pub fn ask(
        &self,
        experiments: &[Experiment],
        free: &[Free],
        given: &[Given],
    ) -> anyhow::Result<()> {
        let is_free = |value: Value| {
            let free = |parameter| free.iter().any(|one| one.parameter == parameter);
            self.fixed(value).parameter().is_some_and(free)
        };
        let is_known = |value: &Value| {
            let starts = |parameter| starts_from_data(parameter, experiments, free);
            self.bodies.system.specimen.is_some()
                || self.fixed(*value).parameter().is_some_and(starts)
                || given
                    .iter()
                    .any(|one| one.value.is_some() && one.quantity == self.fixed(*value))
        };
        let mut missing = self.missing();
        missing.retain(|value| !is_known(value));
        let hardness = frees_hardness(free);
        if !experiments.iter().any(|one| one.has_shape(hardness)) {
            missing.retain(|value| !is_of_shape(*value));
        }
        let mut lines = Vec::new();
        let needs_stiffness = |one: &&Experiment| {
            one.measurement.kind == Kind::ForceHeight && one.stiffness.is_none()
        };
        if let Some(one) = experiments.iter().find(needs_stiffness) {
            lines.push(format!(
                "{}: heights need the stiffness of the cantilever; give it: --stiffness N/m",
                one.measurement.name
            ));
        }
        lines.extend(questions(
            &missing,
            self.bodies.interface.is_layer(),
            is_free,
            self.bodies.half_space,
        ));
        ensure!(lines.is_empty(), lines.join("\n"));
        Ok(())
    }

    /// Accepts the works of adhesion of a contact that sticks and recedes with a work of its own: both
    /// are flags, because the ratio of the two belongs to the contact.
    fn accept_two_works(&self) -> anyhow::Result<()> {
        let system = &self.bodies.system;
        let mut parameters = self
            .values
            .iter()
            .filter_map(|one| one.quantity.parameter());
        if let Some(parameter) = parameters.find(|one| one.is_work_of_adhesion()) {
            bail!("--value {parameter}: {TWO_WORKS}");
        }
        ensure!(
            system.given(Value::WorkOfAdhesion).is_some() || system.specimen.is_some(),
            "--work-of-adhesion is missing: {TWO_WORKS}"
        );
        Ok(())
    }

    /// Refuses a free work of adhesion of the receding line beside full friction, under which it is the work of adhesion.
    pub fn accept_free(&self, free: &[Parameter]) -> anyhow::Result<()> {
        let receding = Parameter::WorkOfAdhesionReceding;
        ensure!(
            !self.history.is_stuck() || !free.contains(&receding),
            "--free {receding}: {TWO_WORKS}: free work-of-adhesion, and keep the retract (--only retract)"
        );
        Ok(())
    }

    /// Joins measurements with what is known about them. `times` are those of the points, where they
    /// are known.
    pub fn experiments(
        &self,
        measurements: Vec<Measurement>,
        times: &[Vec<f64>],
    ) -> anyhow::Result<Vec<Experiment>> {
        self.accept_values(measurements.len())?;
        let bodies::Bodies {
            system,
            stack,
            mut work_of_adhesion,
            ..
        } = self.bodies.read()?;
        ensure!(
            !(self.bodies.half_space && self.indentation.thins()),
            "--thinning makes a film thinner under the tip, and a half-space has none: leave it out, or leave out \
             --half-space"
        );
        let is_at_radii =
            |one: &Measurement| matches!(one.kind, Kind::LoadRadius | Kind::PenetrationRadius);
        ensure!(
            !system.probe.is_flat_punch() || !measurements.iter().any(is_at_radii),
            "--probe flat-punch: the contact radius under a punch is that of the punch, and contact radii tell nothing of \
             it: give penetrations and loads"
        );
        let mut layers = stack.as_ref().map(layers).transpose()?;
        if let Some(nu2) = self.history.sticks(self.bodies.half_space)? {
            if self.history.work_of_adhesion_receding.is_some() {
                self.accept_two_works()?;
            }
            let advancing;
            (work_of_adhesion, advancing) = self.history.works(work_of_adhesion)?;
            if advancing < 1.0 {
                measurements.iter().try_for_each(recedes)?;
            }
            let solver = Solver::Stick {
                sphere_poisson_ratio: nu2,
                advancing,
            };
            let film = || NamedLayer::of_film(&system);
            layers = Some((layers.map_or_else(film, |(layers, _)| layers), solver));
        }
        let bodies = |measurement: &Measurement| match &layers {
            Some((layers, solver)) => Bodies {
                layers: layers.clone(),
                solver: solver.clone(),
                ..Bodies::bare(measurement, system.without_film())
            },
            None if self.bodies.half_space => Bodies::half_space(bodies::half_space(&system)),
            None => Bodies::coated(&system),
        };
        let experiment = |(i, measurement): (usize, Measurement)| {
            let bodies = bodies(&measurement);
            let mut experiment = Experiment::new(measurement, bodies);
            experiment.work_of_adhesion = work_of_adhesion;
            experiment.stiffness = self.stiffness;
            let kind = experiment.measurement.kind;
            experiment.indentation = self.indentation.of(kind)?;
            experiment.times = times.get(i).cloned().unwrap_or_default();
            self.relaxing.complete(&mut experiment)?;
            // A work of adhesion that was given is refused by the fit, and not forgotten.
            if self.relaxing.is_given()
                && let Some(work) = self.bodies.system.given(Value::WorkOfAdhesion)
            {
                experiment.work_of_adhesion = work;
            }
            for Values { quantity, values } in &self.values {
                let value = values.get(i).unwrap_or(&values[0]);
                experiment
                    .set_fixed(*quantity, *value)
                    .with_context(|| format!("--value {}={value:?}", quantity.name()))?;
            }
            Ok(experiment)
        };
        let experiments: Vec<Experiment> = measurements
            .into_iter()
            .enumerate()
            .map(experiment)
            .collect::<anyhow::Result<_>>()?;
        if are_at_depths(&experiments) {
            accept_no_shape(&self.bodies.system)?;
            accept_no_radius("--value", self.values.iter().map(|one| one.quantity))?;
        }
        self.accept_effects(&experiments)?;
        Ok(experiments)
    }

    /// Refuses a value that is given twice, or neither once nor once for each file.
    fn accept_values(&self, files: usize) -> anyhow::Result<()> {
        for (i, one) in self.values.iter().enumerate() {
            ensure!(
                self.values[..i]
                    .iter()
                    .all(|before| before.quantity != one.quantity),
                "--value {} is given twice: leave one out, or give one value for each file, \
                 NAME=VALUE,VALUE",
                one.quantity.name()
            );
        }
        for Values { quantity, values } in &self.values {
            ensure!(
                values.len() == 1 || values.len() == files,
                "--value {}: {} values for {files} files; give one, or one for each file",
                quantity.name(),
                values.len()
            );
        }
        Ok(())
    }

    /// Refuses a value without effect.
    fn accept_effects(&self, experiments: &[Experiment]) -> anyhow::Result<()> {
        for one in &self.values {
            let Some(parameter) = one.quantity.parameter() else {
                continue;
            };
            let mut reasons = experiments
                .iter()
                .map(|one| one.why_without_effect(parameter));
            // An infinite modulus is a value, though no parameter that can be found.
            if one.values.iter().all(|value| value.is_finite())
                && let Some(reason) = reasons.next().flatten()
                && reasons.all(|reason| reason.is_some())
            {
                bail!("--value {parameter} has no effect: {reason}; leave it out");
            }
        }
        Ok(())
    }
}

/// What holds of the works of adhesion of a contact that sticks and recedes with a work of its own.
pub const TWO_WORKS: &str = "with --friction stick and --work-of-adhesion-receding give --work-of-adhesion, with which the \
    contact has grown, as a flag: the ratio of both belongs to the contact. The work of adhesion that is found or \
    known is the receding one";

/// Refuses points of approach, which a contact that recedes with a work of adhesion of its own does
/// not describe.
fn recedes(measurement: &Measurement) -> anyhow::Result<()> {
    let advances = |point: &Point| point.direction == Some(Direction::Approach);
    ensure!(
        !measurement.points.iter().any(advances),
        "{}: with --friction stick, --work-of-adhesion-receding describes the retract only, and there \
         are points of approach: keep the retract (`tabulate fit --only retract`, `tabulate simulate \
         --segments retract`), or leave out --work-of-adhesion-receding",
        measurement.name
    );
    Ok(())
}

/// Tells whether a value is the shape of the probe or the adhesion, which a contact stiffness at a
/// measured contact radius does not depend on.
fn is_of_shape(value: Value) -> bool {
    matches!(value, Value::SphereRadius | Value::WorkOfAdhesion)
}

/// Returns the layers of a stack for fits, with what makes their contacts.
fn layers(layers: &Layers) -> anyhow::Result<(Vec<NamedLayer>, Solver)> {
    let solver = match &layers.table {
        None => Solver::Direct,
        Some(table) => Solver::Table {
            stack: layers.stack().clone(),
            table: Arc::clone(table),
        },
    };
    let named = &layers.named;
    let layers = NamedLayer::all(&named.stack, &named.names).context("--stack")?;
    Ok((layers, solver))
}

/// Leaves the shape of the probe and the adhesion out of experiments in which they do not matter.
pub fn forget_shapes(experiments: &mut [Experiment], free: &[Free]) {
    let hardness = frees_hardness(free);
    for experiment in experiments {
        if !experiment.has_shape(hardness) {
            forget_shape(experiment);
        }
    }
}

fn frees_hardness(free: &[Free]) -> bool {
    free.iter().any(|one| one.parameter == Parameter::Hardness)
}
