//! The flags of a relaxation function.

use anyhow::{bail, ensure};
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
    /// Exponent of a power law, from 1e-9 to below 1, or of the fractional Zener solid, from 0.001 to 0.99
    #[arg(short = 'n', long, value_parser = number)]
    relaxation_exponent: Option<f64>,
    /// Time at which the modulus of a power law is that of the film, s [default: 1]
    #[arg(long, value_name = "S", value_parser = time)]
    reference_time: Option<f64>,
    /// Part of the modulus that is left in the end, from 0 to below 1
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
        let law = self.relaxation;
        let word = law.to_possible_value().expect("no law is hidden");
        let word = word.get_name();
        let (prony, power) = (law == Law::Prony, law == Law::PowerLaw);
        let (times, weights) = (&self.relaxation_time, &self.relaxation_weight);
        let example = match prony {
            true => "a time in seconds or several, for example 0.02,0.5",
            false => "a time in seconds, for example 0.5",
        };
        // Each flag, whether it is given, whether the law has it, and what it takes where the law needs it.
        let flags = [
            (
                "--relaxed-fraction",
                self.relaxed_fraction.is_some(),
                !power,
                Some("the part of the modulus that is left in the end, for example 0.3"),
            ),
            (
                "--relaxation-exponent",
                self.relaxation_exponent.is_some(),
                !prony,
                Some("a number above 0 and below 1, for example 0.2"),
            ),
            (
                "--relaxation-time",
                !times.is_empty(),
                !power,
                Some(example),
            ),
            ("--relaxation-weight", !weights.is_empty(), prony, None),
            (
                "--reference-time",
                self.reference_time.is_some(),
                power,
                None,
            ),
        ];
        for (flag, is_given, is_there, what) in flags {
            let own = if power && flag == "--relaxation-time" {
                " (its time is --reference-time)"
            } else {
                ""
            };
            ensure!(
                is_there || !is_given,
                "--relaxation {word} has no {flag}{own}: leave it out"
            );
            if let Some(what) = what.filter(|_| is_there && !is_given) {
                bail!("--relaxation {word} needs {flag}: {what}");
            }
        }
        ensure!(
            times.len() <= 1 || prony,
            "--relaxation {word} has one --relaxation-time, and {} are given",
            times.len()
        );
        let relaxed = self.relaxed_fraction.unwrap_or_default();
        let exponent = self.relaxation_exponent.unwrap_or_default();
        let time = times.first().copied().unwrap_or_default();
        let own = match law {
            Law::Prony => {
                ensure!(
                    relaxed < 1.0,
                    "--relaxed-fraction {relaxed:?}: give the part of the modulus that does not relax, from 0 to below 1; of 1 \
                     nothing relaxes, and `tabulate curve` answers"
                );
                let weights = if weights.is_empty() && times.len() == 1 {
                    &vec![1.0 - relaxed]
                } else {
                    weights
                };
                ensure!(
                    weights.len() == times.len(),
                    "--relaxation-time has {} values and --relaxation-weight {}: give one weight for each time",
                    times.len(),
                    weights.len()
                );
                let terms = weights.iter().zip(times);
                let terms = terms.map(|(&weight, &time)| [weight, time]).collect();
                Relaxation::Prony { relaxed, terms }
            }
            Law::PowerLaw => Relaxation::PowerLaw {
                exponent,
                time: self.reference_time.unwrap_or(1.0),
            },
            Law::ModifiedPowerLaw => Relaxation::ModifiedPowerLaw {
                relaxed,
                exponent,
                time,
            },
            Law::FractionalZener => Relaxation::FractionalZener {
                relaxed,
                exponent,
                time,
            },
        };
        own.check()?;
        Ok(own)
    }
}
