//! The flags of a relaxation function.

use anyhow::{Context, bail, ensure};
use clap::ValueEnum;
use contact::Relaxation;

use super::super::quantity::{number, time};

/// The flags of a relaxation function.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct RelaxationArguments {
    /// How the modulus falls in time after a step of the strain
    #[arg(long, value_enum, value_name = "LAW")]
    relaxation: Law,
    /// Exponent of a power law or of the fractional Zener solid, above 0 and below 1
    #[arg(short = 'n', long, value_parser = number)]
    relaxation_exponent: Option<f64>,
    /// Time at which the modulus of a power law is that of the film, s [default: 1]
    #[arg(long, value_name = "S", value_parser = time)]
    reference_time: Option<f64>,
    /// Part of the modulus that is left in the end, from 0 to 1
    #[arg(long, value_parser = number)]
    relaxed_fraction: Option<f64>,
    /// Relaxation times, s, separated by commas
    #[arg(long, value_name = "S,...", value_delimiter = ',', value_parser = time)]
    relaxation_time: Vec<f64>,
    /// Weights of the relaxation times; with the relaxed fraction they sum to 1 [default for one
    /// time: 1 less the relaxed fraction]
    #[arg(long, value_name = "W,...", value_delimiter = ',', value_parser = number)]
    relaxation_weight: Vec<f64>,
}

/// The relaxation functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[expect(clippy::enum_variant_names, reason = "these are the names of the laws")]
pub enum Law {
    /// relaxed-fraction + sum weight exp(-t/time): the generalised Maxwell solid; with one time the
    /// standard linear solid
    Prony,
    /// (t/reference-time)^-exponent
    PowerLaw,
    /// relaxed-fraction + (1 - relaxed-fraction) (1 + t/time)^-exponent
    ModifiedPowerLaw,
    /// relaxed-fraction + (1 - relaxed-fraction) E(-(t/time)^exponent), with the Mittag-Leffler
    /// function
    FractionalZener,
}

impl RelaxationArguments {
    /// Returns the law. An error names the flag that is missing, or that the law does not have.
    pub fn law(&self) -> anyhow::Result<Relaxation> {
        let Self {
            relaxation: law,
            relaxation_exponent: exponent,
            reference_time,
            relaxed_fraction: relaxed,
            ref relaxation_time,
            ref relaxation_weight,
        } = *self;
        let word = law.to_possible_value().expect("no law is hidden");
        let word = word.get_name();
        let needs = |flag: &str, what: &str| format!("--relaxation {word} needs {flag}: {what}");
        let refuse = |given: bool, flag: &str| {
            ensure!(!given, "--relaxation {word} has no {flag}: leave it out");
            Ok(())
        };
        let prony = law == Law::Prony;
        refuse(prony && exponent.is_some(), "--relaxation-exponent")?;
        refuse(
            !prony && !relaxation_weight.is_empty(),
            "--relaxation-weight",
        )?;
        refuse(
            law != Law::PowerLaw && reference_time.is_some(),
            "--reference-time",
        )?;
        if law == Law::PowerLaw {
            refuse(relaxed.is_some(), "--relaxed-fraction")?;
            refuse(
                !relaxation_time.is_empty(),
                "--relaxation-time (its time is --reference-time)",
            )?;
        }
        let exponent = || {
            exponent.with_context(|| {
                needs(
                    "--relaxation-exponent",
                    "a number above 0 and below 1, for example 0.2",
                )
            })
        };
        let relaxed = || {
            relaxed.with_context(|| {
                needs(
                    "--relaxed-fraction",
                    "the part of the modulus that is left in the end, for example 0.3",
                )
            })
        };
        let time = || match relaxation_time[..] {
            [time] => Ok(time),
            [] => bail!(needs(
                "--relaxation-time",
                "a time in seconds, for example 0.5"
            )),
            _ => bail!(
                "--relaxation {word} has one --relaxation-time, and {} are given",
                relaxation_time.len()
            ),
        };
        let own = match law {
            Law::Prony => {
                let relaxed = relaxed()?;
                ensure!(
                    !relaxation_time.is_empty(),
                    needs(
                        "--relaxation-time",
                        "a time in seconds or several, for example 0.02,0.5"
                    )
                );
                ensure!(
                    relaxed < 1.0,
                    "--relaxed-fraction {relaxed:?}: give the part of the modulus that does not relax, from 0 to below 1; of 1 \
                     nothing relaxes, and `tabulate curve` answers"
                );
                let weights = if relaxation_weight.is_empty() && relaxation_time.len() == 1 {
                    vec![1.0 - relaxed]
                } else {
                    relaxation_weight.clone()
                };
                ensure!(
                    weights.len() == relaxation_time.len(),
                    "--relaxation-time has {} values and --relaxation-weight {}: give one weight for each time",
                    relaxation_time.len(),
                    weights.len()
                );
                let terms = weights.iter().zip(relaxation_time);
                let terms = terms.map(|(&weight, &time)| [weight, time]).collect();
                Relaxation::Prony { relaxed, terms }
            }
            Law::PowerLaw => Relaxation::PowerLaw {
                exponent: exponent()?,
                time: reference_time.unwrap_or(1.0),
            },
            Law::ModifiedPowerLaw => Relaxation::ModifiedPowerLaw {
                relaxed: relaxed()?,
                exponent: exponent()?,
                time: time()?,
            },
            Law::FractionalZener => Relaxation::FractionalZener {
                relaxed: relaxed()?,
                exponent: exponent()?,
                time: time()?,
            },
        };
        own.check()?;
        Ok(own)
    }
}
