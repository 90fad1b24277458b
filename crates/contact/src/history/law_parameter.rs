//! The numbers of a relaxation function, one by one.

use super::Relaxation;

/// A number of a relaxation function, which other numbers do not follow from.
///
/// The weight of the first term of a Prony series is what the relaxed fraction and the other weights
/// leave. The reference time of a power law tells when its modulus is `E_ref`, and is none of its
/// numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawParameter {
    /// The part of the modulus that is left in the end.
    RelaxedFraction,
    /// The exponent.
    Exponent,
    /// The relaxation time of a term by its number, from 0; laws with one time have the number 0.
    Time(usize),
    /// The weight of a term of a Prony series by its number, from 1.
    Weight(usize),
}

impl Relaxation {
    /// Returns the name of the law, as on the command line.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Prony { .. } => "prony",
            Self::PowerLaw { .. } => "power-law",
            Self::ModifiedPowerLaw { .. } => "modified-power-law",
            Self::FractionalZener { .. } => "fractional-zener",
        }
    }

    /// Lists the numbers of this law.
    pub fn parameters(&self) -> Vec<LawParameter> {
        use LawParameter::{Exponent, RelaxedFraction, Time, Weight};
        match self {
            Self::Prony { terms, .. } => std::iter::once(RelaxedFraction)
                .chain((0..terms.len()).map(Time))
                .chain((1..terms.len()).map(Weight))
                .collect(),
            Self::PowerLaw { .. } => vec![Exponent],
            Self::ModifiedPowerLaw { .. } | Self::FractionalZener { .. } => {
                vec![RelaxedFraction, Exponent, Time(0)]
            }
        }
    }

    /// Returns one of the numbers; `None` for one that the law does not have. Times are in s.
    pub fn parameter(&self, of: LawParameter) -> Option<f64> {
        use LawParameter::{Exponent, RelaxedFraction, Time, Weight};
        Some(match (self, of) {
            (Self::Prony { relaxed, .. }, RelaxedFraction) => *relaxed,
            (Self::Prony { terms, .. }, Time(k)) => terms.get(k)?[1],
            (Self::Prony { terms, .. }, Weight(k)) if k > 0 => terms.get(k)?[0],
            (Self::PowerLaw { exponent, .. }, Exponent) => *exponent,
            (
                Self::ModifiedPowerLaw {
                    relaxed,
                    exponent,
                    time,
                }
                | Self::FractionalZener {
                    relaxed,
                    exponent,
                    time,
                },
                of,
            ) => match of {
                RelaxedFraction => *relaxed,
                Exponent => *exponent,
                Time(0) => *time,
                _ => return None,
            },
            _ => return None,
        })
    }

    /// Returns this law with another value of one of its numbers, which is not checked; of a number
    /// that it does not have, this law. The weight of the first term of a Prony series follows.
    #[must_use]
    pub fn with(&self, of: LawParameter, value: f64) -> Self {
        use LawParameter::{Exponent, RelaxedFraction, Time, Weight};
        let mut own = self.clone();
        match (&mut own, of) {
            (Self::Prony { relaxed, .. }, RelaxedFraction) => *relaxed = value,
            (Self::Prony { terms, .. }, Time(k)) if k < terms.len() => terms[k][1] = value,
            (Self::Prony { terms, .. }, Weight(k)) if k > 0 && k < terms.len() => {
                terms[k][0] = value;
            }
            (
                Self::PowerLaw { exponent, .. }
                | Self::ModifiedPowerLaw { exponent, .. }
                | Self::FractionalZener { exponent, .. },
                Exponent,
            ) => *exponent = value,
            (
                Self::ModifiedPowerLaw { relaxed, .. } | Self::FractionalZener { relaxed, .. },
                RelaxedFraction,
            ) => *relaxed = value,
            (Self::ModifiedPowerLaw { time, .. } | Self::FractionalZener { time, .. }, Time(0)) => {
                *time = value;
            }
            _ => {}
        }
        if let Self::Prony { relaxed, terms } = &mut own
            && !matches!(of, Time(_))
            && let Some((first, others)) = terms.split_first_mut()
        {
            first[0] = 1.0 - *relaxed - others.iter().map(|[weight, _]| weight).sum::<f64>();
        }
        own
    }
}
