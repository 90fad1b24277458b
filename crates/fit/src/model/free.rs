//! What is to be found, and how.

use super::{Fixed, Parameter};

/// A parameter to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Free {
    /// The parameter.
    pub parameter: Parameter,
    /// Where the fit starts. `None`: a modulus, works of adhesion, offsets, contact points and
    /// baselines start from the data themselves, all else from the value of the
    /// [`Experiment`](crate::Experiment): see [`starts_from_data`](crate::starts_from_data).
    pub start: Option<f64>,
    /// The smallest and the largest value allowed. A Poisson ratio has the bounds 0 and 0.5 unless
    /// others are given. Other parameters have none, but moduli, thickness, works of adhesion and
    /// stiffness stay positive.
    ///
    /// Within bounds `[l, u]` the fit varies an angle `y` with `x = l + (u - l) (1 + sin y)/2`,
    /// where `x` is the parameter or, if it is positive, its logarithm. The standard errors are
    /// those of the parameter itself.
    pub bounds: Option<[f64; 2]>,
    /// What is known of the value from elsewhere.
    pub prior: Option<Prior>,
    /// Whether several experiments have one value in common.
    pub scope: Scope,
}

/// A value known from elsewhere, with its standard error. It counts as one more measured point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prior {
    /// The expected value.
    pub mean: f64,
    /// Its standard error.
    pub width: f64,
}

/// Whether several experiments have one value in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// All experiments have one value.
    Shared,
    /// Each experiment has its own value.
    Own,
}

impl Free {
    /// Frees a parameter: without bounds, without a prior, and from a start that the data give.
    ///
    /// Offsets, contact points and baselines are each experiment's own, all else is shared.
    pub fn new(parameter: Parameter) -> Self {
        let is_own = Parameter::ZEROS.contains(&parameter);
        Self {
            parameter,
            start: None,
            bounds: None,
            prior: None,
            scope: if is_own { Scope::Own } else { Scope::Shared },
        }
    }

    /// Starts from a value.
    #[must_use]
    pub const fn starting_from(self, start: f64) -> Self {
        Self {
            start: Some(start),
            ..self
        }
    }

    /// Keeps the parameter within bounds.
    #[must_use]
    pub const fn within(self, least: f64, most: f64) -> Self {
        Self {
            bounds: Some([least, most]),
            ..self
        }
    }

    /// Adds what is known of the value from elsewhere.
    #[must_use]
    pub const fn with_prior(self, mean: f64, width: f64) -> Self {
        Self {
            prior: Some(Prior { mean, width }),
            ..self
        }
    }

    /// Gives each experiment its own value, or all experiments one.
    #[must_use]
    pub const fn with_scope(self, scope: Scope) -> Self {
        Self { scope, ..self }
    }
}

/// What a residual `r` (in units of the noise) adds to the sum that is made least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// `r^2`: least squares.
    Squares,
    /// Huber's loss: `r^2` below the threshold `c`, `2 c |r| - c^2` above it.
    Huber {
        /// The threshold `c`, in units of the noise.
        threshold: f64,
    },
    /// The soft L1 loss: `2 c^2 (sqrt(1 + (r/c)^2) - 1)`.
    SoftL1 {
        /// The threshold `c`, in units of the noise.
        threshold: f64,
    },
}

impl Loss {
    /// Huber's loss with the threshold 1.345, at which it is 95 % as efficient as least squares on
    /// normal noise (Huber, *Robust Statistics*, 1981).
    pub const HUBER: Self = Self::Huber { threshold: 1.345 };
    /// The soft L1 loss with the threshold 1.
    pub const SOFT_L1: Self = Self::SoftL1 { threshold: 1.0 };
}

/// The standard error of a value that the fit takes as given. Where measurements have different values, it is that of
/// the first, and the others err in proportion, as by one factor of an ellipsometer; Poisson ratios and zeros are off by
/// the same number.
///
/// The fit keeps the value, and its error passes on to the standard errors and the correlation of
/// the values found: to the first order, independent of the noise and of other known values. A
/// [`Prior`] instead frees the value and lets the data move it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The value.
    pub quantity: Fixed,
    /// Its standard error, in SI units.
    pub error: f64,
}

/// How to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The loss.
    pub loss: Loss,
    /// The level, such as 0.95, of profile-likelihood intervals; `None` does without them. An
    /// interval takes some twenty further fits for each parameter. Where the noise of an experiment is
    /// not given, the interval has the quantile of Student's distribution, as the noise estimated has
    /// an error.
    pub profile_level: Option<f64>,
    /// The range `z0` of the attraction (m) in the warning that it is not short; 3e-10 unless another is given.
    pub interaction_range: f64,
    /// The values taken as given of which a standard error is known.
    pub known: Vec<Known>,
    /// Whether [`Fit::fixed_values`](crate::Fit::fixed_values) lists all values taken as given.
    pub fixed_values: bool,
    /// Whether the same data are fitted without the film, for
    /// [`Fit::without_film`](crate::Fit::without_film). It takes up to a third of the time of a fit:
    /// `false` saves it where the parameters alone are wanted, as of a map.
    pub without_film: bool,
    /// Whether more than a third of the points in contact may be left out.
    pub allow_left_out: bool,
}

impl Default for Options {
    /// Least squares, no profiles, an attraction over 0.3 nm, given values without errors, no list of
    /// what they do, and the fit without the film.
    fn default() -> Self {
        Self {
            loss: Loss::Squares,
            profile_level: None,
            interaction_range: 3e-10,
            known: Vec::new(),
            fixed_values: false,
            without_film: true,
            allow_left_out: false,
        }
    }
}

/// Tells of a parameter whether it is free and no start is given.
pub(crate) fn has_no_start(free: &[Free]) -> impl Fn(Parameter) -> bool {
    let unknown = |parameter| move |one: &Free| one.parameter == parameter && one.start.is_none();
    move |parameter| free.iter().any(unknown(parameter))
}
