//! The errors of fits. Each names the measurement, and the line or the parameter. A program adds the
//! next step in its own words.

use crate::{LayerName, Numbering, Parameter};

/// A fit that cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Measurements, parameters or settings that cannot be used together, in a sentence that names them, with the next
    /// step.
    #[error("{0}")]
    NotFitted(String),
    /// A measured point that cannot be.
    #[error("{measurement}, {numbering} {line}: {name} = {value:?} must be {allowed}")]
    Point {
        /// The name of the measurement.
        measurement: String,
        /// What the number of the point counts.
        numbering: Numbering,
        /// The number of the point.
        line: u64,
        /// The name of the quantity.
        name: &'static str,
        /// The measured value.
        value: f64,
        /// The values allowed, in words, with the next step.
        allowed: &'static str,
    },
    /// Points that are all at one place, or that all read one value.
    #[error("{measurement}: {name} is {value:?} at every point, which determines nothing")]
    Constant {
        /// The name of the measurement.
        measurement: String,
        /// The name of the quantity.
        name: &'static str,
        /// Its only value.
        value: f64,
    },
    /// A start, a bound, a prior, a noise or an option that is not allowed.
    #[error(
        "{name} {}: it must be {allowed}",
        if value.is_nan() { "is not given, or is NaN".into() } else { format!("= {value:?} cannot be used") }
    )]
    Setting {
        /// The name of the parameter or option.
        name: String,
        /// Its value.
        value: f64,
        /// The values allowed, in words.
        allowed: String,
    },
    /// A name that is not one of a parameter.
    #[error(
        "{0:?} is not a parameter; the parameters are {all}, and LAYER.modulus and LAYER.thickness of \
         the layer LAYER of a stack",
        all = Parameter::names(Parameter::ALL)
    )]
    UnknownParameter(String),
    /// A fit that leaves out more than a third of the points in contact, in a sentence with the reasons.
    #[error("{0}")]
    LeftOut(String),
    /// Parameters without a finite standard error.
    #[error(
        "the data do not determine {parameters}: no standard error is finite there. {}",
        why.next(parameters)
    )]
    NotDetermined {
        /// The parameters, between "and".
        parameters: String,
        /// Why it may be so.
        why: Undetermined,
    },
    /// A model that cannot be evaluated where the fit starts.
    #[error("{experiment}, where the fit starts: {cause}{}", other_start(cause))]
    Start {
        /// The name of the measurement.
        experiment: String,
        /// The error of the contact.
        cause: Box<Self>,
    },
    /// Points without times, which the forces need.
    #[error(
        "{0}: its points have no times, on which the forces of bodies that relax, and adhesion that depends on the speed of \
         the contact line, depend: give each point its time"
    )]
    NoTimes(String),
    /// A stack that relaxes, between bodies that deform and do not.
    #[error(
        "{0}: the layers of a stack relax all by one law, and so must probe and base: state that \
         all bodies relax, take probe and base as rigid, or use one film"
    )]
    DifferentBodies(String),
    /// Times that do not rise.
    #[error(
        "{measurement}, {numbering} {line}: time = {time:?} s follows {before:?} s, and times must rise: keep one point of each time, in \
         the order measured; times go on from approach to retract"
    )]
    Times {
        /// The name of the measurement.
        measurement: String,
        /// What the number of the point counts.
        numbering: Numbering,
        /// The number of the point.
        line: u64,
        /// Its time, s.
        time: f64,
        /// The time of the point before it, s.
        before: f64,
    },
    /// A contact on a stack of layers that cannot be computed.
    #[error(transparent)]
    Layers(#[from] solve::Error),
    /// A layer with a name that a stack cannot have.
    #[error("layer {name}: {what}")]
    Layer {
        /// The name.
        name: LayerName,
        /// A sentence with the value and the allowed range.
        what: String,
    },
    /// Other layers than those of the table.
    #[error("the layers are not those of the table: {0}")]
    OtherLayers(&'static str),
    /// A contact that nobody waits for: see [`Interrupt`](crate::Interrupt).
    #[error("the fit is interrupted")]
    Interrupted,
    /// A contact that cannot be computed.
    #[error(transparent)]
    Contact(#[from] contact::Error),
}

impl Error {
    /// The error of an experiment, a parameter or a relaxation function that is missing.
    pub(crate) fn nothing(what: &str) -> Self {
        Self::NotFitted(format!("there is no {what}: give at least one"))
    }

    /// The error of fewer points that count than values to be found, or as many. Some may be left out because the speed of
    /// the contact line is `unknown` there.
    pub(crate) fn too_few_points(points: usize, parameters: usize, unknown: usize) -> Self {
        let remedy = match unknown {
            0 => ": measure more points or free fewer parameters".to_owned(),
            _ => format!(
                "; {unknown} more lie at the ends of ways or at sudden steps of the load, where the speed of the contact line is \
                 not known: take more images, at least some 30 of each way and 15 of each step, or fit without doubling-speed and speed-exponent"
            ),
        };
        Self::NotFitted(format!(
            "{points} usable points do not determine {parameters} parameters and their errors{remedy}"
        ))
    }

    /// The error of a model that cannot be evaluated where the fit starts.
    pub(crate) fn at_start(experiment: String, cause: Self) -> Self {
        let cause = Box::new(cause);
        Self::Start { experiment, cause }
    }

    /// The error of a setting whose value is not allowed.
    pub(crate) fn setting(name: impl Into<String>, value: f64, allowed: impl Into<String>) -> Self {
        Self::Setting {
            name: name.into(),
            value,
            allowed: allowed.into(),
        }
    }

    /// Tells whether a contact was refused because a table ends before it.
    pub(crate) const fn is_beyond_table(&self) -> bool {
        use interp::Error::{Equivalent, Extrapolation, OutsideTable};
        matches!(
            self,
            Self::Contact(contact::Error::Table(
                OutsideTable { .. } | Extrapolation { .. } | Equivalent { .. }
            ))
        )
    }
}

impl From<interp::Error> for Error {
    fn from(error: interp::Error) -> Self {
        Self::Contact(error.into())
    }
}

/// Why data do not determine parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undetermined {
    /// They are works of adhesion of flat punches, which change the load of pull-off only.
    PullOffOnly,
    /// It is the work of adhesion of a receding line, and no point recedes.
    NothingRecedes,
    /// Nothing else is known.
    Insensitive,
}

impl Undetermined {
    /// Returns what to do about the parameters.
    fn next(self, parameters: &str) -> String {
        match self {
            Self::PullOffOnly => {
                "The load on a flat punch does not depend on the work of adhesion, until it pulls off: fix it at a value \
                 that is surely large enough, which changes no other value, and find it afterwards from the load of \
                 pull-off and the modulus found"
                    .into()
            }
            Self::NothingRecedes => {
                "No point is stated to be measured at unloading: give the points their directions".into()
            }
            Self::Insensitive => {
                let which = if parameters.contains(" and ") {
                    "all but one of them"
                } else {
                    "it"
                };
                format!("Fix {which}, give a prior, or measure where {which} changes the ordinates")
            }
        }
    }
}

/// Returns the next step after an error of the contact where a fit starts: another start, unless the error names the
/// step itself, or no start helps.
fn other_start(cause: &Error) -> &'static str {
    use interp::Error::{Normalisation, NotOfStack, OfStack};
    match cause {
        Error::Contact(
            contact::Error::Table(OfStack | NotOfStack | Normalisation { .. })
            | contact::Error::Sticks { .. },
        )
        | Error::NotFitted(_)
        | Error::Layers(solve::Error::Coupled { .. }) => "",
        _ => "; give another start",
    }
}
