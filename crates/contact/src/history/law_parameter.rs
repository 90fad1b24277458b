//! The numbers of a relaxation function, one by one.

use super::Relaxation;

/// A number of a relaxation function, which other numbers do not follow from.
///
/// The weight of the first term of a Prony series is what the relaxed fraction and the other weights
/// leave. The reference time of a power law tells when its modulus is `E_ref`, and is none of its
/// numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
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
        self.clone().place(of).copied()
    }

    /// Returns where one of the numbers is; `None` for one that the law does not have.
    fn place(&mut self, of: LawParameter) -> Option<&mut f64> {
        use LawParameter::{Exponent, RelaxedFraction, Time, Weight};
        Some(match (self, of) {
            (Self::Prony { terms, .. }, Time(k)) => &mut terms.get_mut(k)?[1],
            (Self::Prony { terms, .. }, Weight(k @ 1..)) => &mut terms.get_mut(k)?[0],
            (
                Self::Prony { relaxed, .. }
                | Self::ModifiedPowerLaw { relaxed, .. }
                | Self::FractionalZener { relaxed, .. },
                RelaxedFraction,
            ) => relaxed,
            (
                Self::PowerLaw { exponent, .. }
                | Self::ModifiedPowerLaw { exponent, .. }
                | Self::FractionalZener { exponent, .. },
                Exponent,
            ) => exponent,
            (Self::ModifiedPowerLaw { time, .. } | Self::FractionalZener { time, .. }, Time(0)) => {
                time
            }
            _ => return None,
        })
    }

    /// Returns this law with another value of one of its numbers, which is not checked; of a number
    /// that it does not have, this law. The weight of the first term of a Prony series follows.
    #[must_use]
    pub fn with(&self, of: LawParameter, value: f64) -> Self {
        let mut own = self.clone();
        if let Some(place) = own.place(of) {
            *place = value;
        }
        if let Self::Prony { relaxed, terms } = &mut own
            && !matches!(of, LawParameter::Time(_))
            && let Some((first, others)) = terms.split_first_mut()
        {
            first[0] = 1.0 - *relaxed - others.iter().map(|[weight, _]| weight).sum::<f64>();
        }
        own
    }
}
