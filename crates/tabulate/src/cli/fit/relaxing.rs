//! The flags of bodies that relax, for measurements.

use ::fit::{Experiment, Fixed, Kind, Measurement, Parameter, Relaxing};
use anyhow::{bail, ensure};
use contact::{LawParameter, Relaxation};

use super::setting::Values;
use crate::cli::quantity::{number, time};

/// The flags of bodies that relax.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct RelaxingArguments {
    /// How the modulus of the film falls in time after a step of the strain: sls (the standard linear
    /// solid, relaxed-fraction + (1 - relaxed-fraction) exp(-t/relaxation-time)), prony:M with M
    /// relaxation times, power-law ((t/reference-time)^-relaxation-exponent), modified-power-law
    /// (relaxed-fraction + (1 - relaxed-fraction) (1 + t/relaxation-time)^-relaxation-exponent) or
    /// fractional-zener. The moduli are then the instantaneous ones, and under a power law those at
    /// the reference time. Points need a time, and begin before the contact
    #[arg(long, value_name = "LAW", value_parser = law)]
    relaxation: Option<Relaxation>,
    /// Exponent of the law, from 1e-9 to below 1; of fractional-zener from 0.001 to 0.99
    #[arg(long, requires = "relaxation", value_parser = number)]
    relaxation_exponent: Option<f64>,
    /// Part of the modulus that is left in the end, from 0 to below 1
    #[arg(long, requires = "relaxation", value_parser = number)]
    relaxed_fraction: Option<f64>,
    /// Relaxation times, s, separated by commas
    #[arg(long, requires = "relaxation", value_name = "S,...", value_delimiter = ',', value_parser = time)]
    relaxation_time: Vec<f64>,
    /// Weights of the relaxation times of prony:M from the second one on; the first one has what they
    /// and the relaxed fraction leave
    #[arg(long, requires = "relaxation", value_name = "W,...", value_delimiter = ',', value_parser = number)]
    relaxation_weight: Vec<f64>,
    /// Time at which the modulus of a power law is that of the film, s [default: 1]
    #[arg(long, requires = "relaxation", value_name = "S", value_parser = time)]
    reference_time: Option<f64>,
    /// Take sphere and substrate to relax like the film
    #[arg(long, requires = "relaxation")]
    all_relax: bool,
    /// Time between points, s, of measurements without a column of times, or with times that start again in a segment
    #[arg(long, value_name = "S", value_parser = time)]
    pub sample_interval: Option<f64>,
}

/// The most relaxation times of `prony:M`.
const MOST_TERMS: usize = 20;

/// Parses the name of a law, whose numbers are any that it takes until they are given or fitted.
fn law(text: &str) -> Result<Relaxation, String> {
    let [relaxed, exponent, time] = [0.2; 3];
    let prony = |terms: usize| Relaxation::Prony {
        relaxed,
        terms: vec![[(1.0 - relaxed) / terms as f64, time]; terms],
    };
    Ok(match text {
        "sls" | "prony" => prony(1),
        "power-law" => Relaxation::PowerLaw {
            exponent,
            time: 1.0,
        },
        "modified-power-law" => Relaxation::ModifiedPowerLaw {
            relaxed: 0.0,
            exponent,
            time,
        },
        "fractional-zener" => Relaxation::FractionalZener {
            relaxed,
            exponent,
            time,
        },
        _ => match text.strip_prefix("prony:").map(str::parse) {
            Some(Ok(terms)) if (1..=MOST_TERMS).contains(&terms) => prony(terms),
            Some(_) => {
                return Err(format!(
                    "{text:?}: prony:M has M from 1 to {MOST_TERMS}, such as prony:2"
                ));
            }
            None => {
                return Err(format!(
                    "{text:?} is not a law: give sls, prony:M, power-law, modified-power-law or \
                     fractional-zener"
                ));
            }
        },
    })
}

impl RelaxingArguments {
    /// Tells whether a law is given.
    pub const fn is_given(&self) -> bool {
        self.relaxation.is_some()
    }

    /// Returns the law, of whose numbers the reference time is the one that is given.
    fn law(&self) -> Option<Relaxing> {
        let mut law = self.relaxation.clone()?;
        if let (Relaxation::PowerLaw { time, .. }, Some(given)) = (&mut law, self.reference_time) {
            *time = given;
        }
        Some(Relaxing {
            law,
            all_bodies: self.all_relax,
        })
    }

    /// Returns the numbers of the law that are given, with their flags.
    pub fn values(&self) -> anyhow::Result<Vec<Values>> {
        ensure!(
            matches!(self.relaxation, Some(Relaxation::PowerLaw { .. }))
                || self.reference_time.is_none(),
            "--reference-time is that of --relaxation power-law: leave it out"
        );
        let exponent = (self.relaxation_exponent).map(|value| (LawParameter::Exponent, value));
        let fraction = (self.relaxed_fraction).map(|value| (LawParameter::RelaxedFraction, value));
        let times = (0..)
            .map(LawParameter::Time)
            .zip(self.relaxation_time.clone());
        let weights = (1..)
            .map(LawParameter::Weight)
            .zip(self.relaxation_weight.clone());
        let given = exponent
            .into_iter()
            .chain(fraction)
            .chain(times)
            .chain(weights);
        let own = self.law().map(|relaxing| relaxing.parameters());
        let one = |(number, value): (LawParameter, f64)| {
            let parameter = Parameter::Law(number);
            if let Some(own) = own.as_ref().filter(|own| !own.contains(&parameter)) {
                // A flag takes all times, or all weights.
                let name = parameter.name();
                let flag = name.split('.').next().unwrap_or_default();
                bail!(
                    "--{flag}: the law has no {parameter}, which would be {value:?}; it has {}",
                    Parameter::names(own.iter().copied())
                );
            }
            Ok(Values {
                quantity: Fixed::Parameter(parameter),
                values: vec![value],
            })
        };
        given.map(one).collect()
    }

    /// Gives an experiment the law, and times where none were measured.
    pub fn complete(&self, experiment: &mut Experiment) -> anyhow::Result<()> {
        if let Some(interval) = self.sample_interval {
            let name = &experiment.measurement.name;
            let rise = experiment.times.windows(2).all(|pair| pair[1] > pair[0]);
            ensure!(
                experiment.times.is_empty() || !rise,
                "{name} has a column of times: leave out --sample-interval"
            );
            let count = experiment.measurement.points.len();
            experiment.times = (0..count).map(|i| i as f64 * interval).collect();
        }
        if let Some(relaxing) = self.law() {
            let Measurement { name, kind, .. } = &experiment.measurement;
            ensure!(
                kind.at_positions(),
                "{name}: a relaxation is found from loads at penetrations or heights in time, and {} is measured: \
                 leave out --relaxation",
                kind.name()
            );
            // That of the example.
            experiment.work_of_adhesion = 0.0;
            experiment.relaxing = Some(relaxing);
            for Values { quantity, values } in self.values()? {
                experiment.set_fixed(quantity, values[0])?;
            }
        }
        Ok(())
    }

    /// Asks for the numbers of the law that are neither given nor free.
    pub fn ask(&self, experiment: &Experiment, free: &[Parameter]) -> anyhow::Result<()> {
        let given = self.values()?;
        let is_known = |parameter: &Parameter| {
            given
                .iter()
                .any(|own| own.quantity.parameter() == Some(*parameter))
                || free.contains(parameter)
                || (matches!(self.relaxation, Some(Relaxation::ModifiedPowerLaw { .. }))
                    && *parameter == Parameter::Law(LawParameter::RelaxedFraction))
        };
        let mut own = experiment
            .relaxing
            .as_ref()
            .map_or_else(Vec::new, Relaxing::parameters);
        own.retain(|parameter| !is_known(parameter));
        if own.is_empty() {
            return Ok(());
        }
        bail!(
            "--relaxation needs {}: give {}, or free them",
            Parameter::names(own.iter().copied()),
            own.iter()
                .map(|parameter| format!("--value {parameter}=..."))
                .collect::<Vec<_>>()
                .join(" ")
        )
    }
}

/// Returns the parameters that are free by default where bodies relax.
pub fn usual(experiments: &[Experiment], modulus: Parameter) -> Option<Vec<Parameter>> {
    let relaxing = experiments.first()?.relaxing.as_ref()?;
    let mut free = vec![modulus];
    free.extend(relaxing.parameters());
    if matches!(relaxing.law, Relaxation::ModifiedPowerLaw { .. }) {
        free.retain(|&parameter| parameter != Parameter::Law(LawParameter::RelaxedFraction));
    }
    free.push(Parameter::ContactPoint);
    let heights = |one: &Experiment| one.measurement.kind == Kind::ForceHeight;
    if experiments.iter().any(heights) {
        free.push(Parameter::Baseline);
    }
    Some(free)
}
