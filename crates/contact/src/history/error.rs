//! What can be wrong with a history.

use crate::Error;

/// A failure of a contact in time.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HistoryError {
    /// A program, times, adhesion or rigid bodies that a history cannot take, in a sentence with the numbers.
    #[error("{0}")]
    Refused(String),
    /// A contact that is not one disc.
    #[error(
        "at {time:?} s the contact is not one disc: a ring of radius {radius:?} m touches outside a \
         gap, because a dent has not recovered there; histories are computed for contacts that are one disc"
    )]
    NotOneDisc {
        /// The time, s.
        time: f64,
        /// The radius of the ring, m.
        radius: f64,
    },
    /// A measured contact that grows after its first retract.
    #[error(
        "at {time:?} s the contact grows again after its first retract: measured histories are followed over one \
         approach, which may be held, and one retract; give the points of one cycle that begins before the contact, and where \
         the instrument has overshot before a hold the values that were set in place of those measured"
    )]
    GrowsAgain {
        /// The time, s.
        time: f64,
    },
    /// A tolerance that is not reached.
    #[error(
        "the tolerance {tolerance:?} is not reached; {}",
        if reached.is_finite() {
            format!("give one above {reached:.1e}, in parts of the largest load and contact radius")
        } else {
            "no error can be stated for this program: give one with fewer turns, or with longer steps".to_owned()
        }
    )]
    Unreached {
        /// The tolerance asked for.
        tolerance: f64,
        /// The error that was reached.
        reached: f64,
    },
    /// Bodies that relax differently by too much.
    #[error(
        "the bodies that do not relax carry too much of the deformation: the {what} may be wrong by {bound:.1e} of the largest \
         {what}, and at most 2e-2 is accepted; at the largest penetration the elastic load rises by {chi:.1e} of itself when these \
         bodies are made rigid; no reduction to the elastic contact exists for them"
    )]
    UnlikeBodies {
        /// What may be wrong, in words.
        what: &'static str,
        /// The bound of the error, in parts of the largest one.
        bound: f64,
        /// The relative rise of the elastic load when the elastic bodies are made rigid.
        chi: f64,
    },
    /// An error of the elastic contact.
    #[error(transparent)]
    Contact(#[from] Error),
}

impl From<interp::Error> for HistoryError {
    fn from(error: interp::Error) -> Self {
        Self::Contact(error.into())
    }
}

impl HistoryError {
    /// The error of something that a history cannot take.
    pub(super) fn refused<T>(what: impl Into<String>) -> Result<T, Self> {
        Err(Self::Refused(what.into()))
    }

    /// Returns the error of a contact whose times were counted from `origin` (s).
    pub(super) fn later_by(mut self, origin: f64) -> Self {
        if let Self::NotOneDisc { time, .. } | Self::GrowsAgain { time } = &mut self {
            *time += origin;
        }
        self
    }
}
