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
    /// A program with too few points.
    #[error(
        "a program needs two points or more, and has {points}: give the times and values at which it bends"
    )]
    Program {
        /// The number of points.
        points: usize,
    },
    /// A number of a program that is not finite.
    #[error("point {number} of the program is ({time:?} s, {value:?}): both must be finite")]
    NotFinite {
        /// The number of the point, from 1.
        number: usize,
        /// Its time, s.
        time: f64,
        /// Its value.
        value: f64,
    },
    /// Times that do not rise.
    #[error(
        "point {number} of the program is at {time:?} s and the one before it at {before:?} s: times \
         must rise; for a sudden change give two times that are close together"
    )]
    Order {
        /// The number of the point, from 1.
        number: usize,
        /// Its time, s.
        time: f64,
        /// The time of the point before it, s.
        before: f64,
    },
    /// Times asked for that fall.
    #[error(
        "time {number} of those asked for is {time:?} s and the one before it {before:?} s: give them in ascending order"
    )]
    Times {
        /// The number of the time, from 1.
        number: usize,
        /// The time, s.
        time: f64,
        /// The time before it, s.
        before: f64,
    },
    /// A program that is too short or too long.
    #[error(
        "the program takes {value:?} s, and programs from 1e-50 to 1e50 s are followed: give its times in seconds"
    )]
    Duration {
        /// The duration, s.
        value: f64,
    },
    /// A time that is asked for and lies before the program.
    #[error("the state at {time:?} s is not known: the program begins at {begin:?} s")]
    BeforeProgram {
        /// The time asked for, s.
        time: f64,
        /// The first time of the program, s.
        begin: f64,
    },
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
    /// Loads that are imposed, where a penetration or a position is measured.
    #[error(
        "the loads are imposed: measured histories follow a penetration or the position of a spring"
    )]
    MeasuredLoad,
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
    /// An energy of the receding line that depends on its speed.
    #[error(
        "the energy of the receding line depends on its speed, and a history takes one energy for all \
         speeds: give `Hysteresis::new(0.0, w)`"
    )]
    SpeedOfLine,
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
    /// Rigid bodies beside others than those of the history.
    #[error(
        "the contact between rigid bodies is not that of this history: it must have the same film, thickness and probe, with a \
         rigid sphere and a rigid base; the layers of a stack relax all by one law, and so must the other bodies"
    )]
    OtherBodies,
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
    /// Returns the error of a contact whose times were counted from `origin` (s).
    pub(super) fn later_by(mut self, origin: f64) -> Self {
        if let Self::NotOneDisc { time, .. } | Self::GrowsAgain { time } = &mut self {
            *time += origin;
        }
        self
    }
}
