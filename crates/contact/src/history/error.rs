//! What can be wrong with a history.

use crate::Error;

/// A failure of a contact in time.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HistoryError {
    /// A time that is negative or not finite.
    #[error("time = {value:?} s cannot be used: it must be >= 0 and finite")]
    Time {
        /// The time, s.
        value: f64,
    },
    /// A frequency that is not positive and finite.
    #[error("angular frequency = {value:?} rad/s cannot be used: it must be > 0 and finite")]
    Frequency {
        /// The angular frequency, rad/s.
        value: f64,
    },
    /// A tolerance out of range.
    #[error("tolerance = {value:?} cannot be used: it must be from 1e-10 to 1e-2")]
    Tolerance {
        /// The tolerance.
        value: f64,
    },
    /// A program, times, a law of the line or rigid bodies that a history cannot take, in a sentence with the numbers.
    #[error("{0}")]
    Refused(String),
    /// A history whose first point is in contact.
    #[error(
        "the program begins in contact, at {name} = {value:?}: the history before its first point is not \
         known, and the forces depend on it; begin at {name} <= 0"
    )]
    BeginsInContact {
        /// The quantity imposed.
        name: &'static str,
        /// Its first value.
        value: f64,
    },
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
    /// An adhesion that acts on a contact that grows.
    #[error(
        "the advancing energy is {advancing:?} J/m^2 and must be 0: how much a growing contact gains from adhesion while \
         the bodies relax depends on the process at the crack tip, for which no law is known here; give the \
         energy of the receding line alone, `Hysteresis::new(0.0, w)`"
    )]
    GrowingAdhesion {
        /// The energy of the advancing line, J/m^2.
        advancing: f64,
    },
    /// Adhesion together with a program that is not served.
    #[error(
        "adhesion is computed for a penetration that grows, may be held, and falls: {reason}; \
         use such a program, or a contact without adhesion"
    )]
    AdhesiveProgram {
        /// What is different.
        reason: &'static str,
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
