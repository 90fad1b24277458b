//! The errors of contacts. Each message names the value and the values allowed.

/// Any failure of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A state whose contact radius is outside the range of a search:
    /// [`Contact::contact_radius_range`](crate::Contact::contact_radius_range).
    #[error(
        "{name} = {value:?}{} needs a contact radius that {}",
        unit(name),
        if *at_end_of_probe { end_of_probe(*to) } else { of_the_table(*from, *to) }
    )]
    OutsideRadii {
        /// The name of the quantity imposed or measured.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The smallest contact radius, m.
        from: f64,
        /// The largest contact radius, m.
        to: f64,
        /// Whether the range ends where the shape of the probe does, beyond which no table helps.
        at_end_of_probe: bool,
    },
    /// A load, penetration or position of the spring at which there is no contact.
    #[error("there is no contact at {name} = {value:?}{unit}: give {least:?}{unit} or more", unit = unit(name))]
    NoContact {
        /// The name of the quantity imposed.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The smallest value with a contact.
        least: f64,
    },
    /// A measured pull-off load that no work of adhesion has.
    #[error(
        "no work of adhesion has the pull-off load {load:?} N: at {work_of_adhesion:.4e} J/m^2 the last stable state \
         changes to another one, and its load from {above:.4e} N to {below:.4e} N; check the load, the bodies, and what the \
         machine imposes"
    )]
    NoWorkOfAdhesion {
        /// The load, N.
        load: f64,
        /// The work of adhesion at which the pull-off load jumps over it, J/m^2.
        work_of_adhesion: f64,
        /// The pull-off load with a smaller work of adhesion, N.
        above: f64,
        /// The pull-off load with a larger work of adhesion, N.
        below: f64,
    },
    /// A curve made for another material than the system's.
    #[error(
        "the curve was made for {}, the system has {}: make the curve for the material of the system",
        material(curve),
        material(system)
    )]
    OtherMaterial {
        /// The material of the curve: `e1_over_e2`, `nu1`, `e0_over_e2`, `nu0`.
        curve: [f64; 4],
        /// The material of the system: `e1_over_e2`, `nu1`, `e0_over_e2`, `nu0`.
        system: [f64; 4],
    },
    /// A cohesive zone that is not short.
    #[error(
        "the cohesive zone is {zone:?} m long, more than {most} times the {what}, {length:?} m, and \
         the correction for a short zone does not hold: give a larger stress of the attraction, or under a \
         paraboloid solve a zone of any length by a direct solve"
    )]
    LongZone {
        /// The length of the zone, m.
        zone: f64,
        /// What it is compared with, in words.
        what: &'static str,
        /// The radius or thickness, m.
        length: f64,
        /// The largest length of the zone over this length.
        most: f64,
    },
    /// A contact under more tension than the attraction bears.
    #[error(
        "the mean tension in the contact is {tension:?} Pa, more than {most} times the stress of the attraction, {stress:?} \
         Pa: the contact opens inside, and the correction for a short zone does not hold: give a larger stress of the \
         attraction, or under a paraboloid solve a zone of any length by a direct solve"
    )]
    Tension {
        /// The mean tension, Pa.
        tension: f64,
        /// The stress of the attraction, Pa.
        stress: f64,
        /// The largest mean tension over this stress.
        most: f64,
    },
    /// A question that a contact with full friction does not answer.
    #[error("{question} cannot be told of a contact with full friction: {reason}")]
    Sticks {
        /// The question.
        question: &'static str,
        /// The reason, and what to do instead.
        reason: &'static str,
    },
    /// A motion of the contact line that takes too many steps, or steps that vanish.
    #[error(
        "the contact line has been followed to {time:?} s of the ramp in {steps} steps, and no further; divide the ramp \
         into several, give a larger tolerance, or take a law whose speed rises less steeply"
    )]
    Motion {
        /// The time from the beginning of the ramp up to which it was followed, s.
        time: f64,
        /// The number of steps.
        steps: usize,
    },
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
    /// An error of the table, of the curve, or of the system.
    #[error(transparent)]
    Table(#[from] interp::Error),
}

impl Error {
    /// The error of something that a history cannot take.
    pub(crate) fn refused<T>(what: impl Into<String>) -> Result<T, Self> {
        Err(Self::Refused(what.into()))
    }

    /// Returns the error of a contact whose times were counted from `origin` (s).
    pub(crate) fn later_by(mut self, origin: f64) -> Self {
        if let Self::NotOneDisc { time, .. } | Self::GrowsAgain { time } = &mut self {
            *time += origin;
        }
        self
    }
}

/// Returns the unit of an imposed quantity, with a space before it.
fn unit(name: &str) -> &'static str {
    match name {
        "load" => " N",
        "penetration" | "position of the spring" => " m",
        _ => "",
    }
}

/// Says that no contact of the probe is as wide.
fn end_of_probe(to: f64) -> String {
    // The search ends just below the radius.
    let radius = format!("{to:.6e}").parse().unwrap_or(to);
    format!(
        "is above {radius:?} m, the widest contact of this probe that is computed; give a smaller value, \
         or check its unit and those of the probe"
    )
}

/// Says between which contact radii a search on a table or a curve is.
fn of_the_table(from: f64, to: f64) -> String {
    /// Below this radius (m) a search stands for one from 0.
    const ZERO: f64 = 1e-50;
    let from = if from < ZERO {
        format!("0 (more exactly {from:?} m)")
    } else {
        format!("{from:?} m")
    };
    format!(
        "is outside the search, which is from {from} to {to:?} m and ends where the nodes of the table or curve do; give another value, \
         or make the table or the curve over a larger range of a_over_t"
    )
}

/// Formats the four parameters of a material.
fn material([e1, nu1, e0, nu0]: &[f64; 4]) -> String {
    format!("e1_over_e2 = {e1:?}, nu1 = {nu1:?}, e0_over_e2 = {e0:?}, nu0 = {nu0:?}")
}
