//! What can go wrong in making a table, with the numbers that say why.

use std::io;
use std::path::PathBuf;

use interp::Material;

/// Any failure of the solve, of a scene, or of a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A parameter that the solve is not made for.
    #[error("{name} = {value:?} is outside the domain of the solve, {from:?} to {to:?}")]
    Domain {
        /// The parameter's name.
        name: &'static str,
        /// The value given.
        value: f64,
        /// The smallest value allowed.
        from: f64,
        /// The largest value allowed.
        to: f64,
    },
    /// A tolerance that was not reached.
    #[error(
        "tolerance {tolerance:.1e} is not reached at a_over_t = {a_over_t:?}, e1_over_e2 = {:?}, nu1 = {:?}, e0_over_e2 = {:?}, nu0 = {:?}: \
         the estimated error is {reached:.1e}; ask for a larger tolerance",
        material.e1_over_e2(), material.nu1(), material.e0_over_e2(), material.nu0()
    )]
    NotConverged {
        /// The contact radius over the film thickness.
        a_over_t: f64,
        /// The material.
        material: Material,
        /// What was asked for.
        tolerance: f64,
        /// The estimated relative error that was reached; infinite where there is no answer at all.
        reached: f64,
    },
    /// A low-rank form that rounding keeps from its error.
    #[error(
        "a low-rank form with an error of {error:.1e} is not within rounding: it has {reached:.1e}; ask for a larger tolerance"
    )]
    Truncation {
        /// The relative error at the nodes that was asked for.
        error: f64,
        /// The smallest that was reached.
        reached: f64,
    },
    /// A scene that says something impossible.
    #[error("{}: {what}", path.display())]
    Scene {
        /// The scene file.
        path: PathBuf,
        /// What is wrong: key, value and range.
        what: String,
    },
    /// A file that cannot be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A file that cannot be written.
    #[error("cannot write {}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A failure of the table or of its parameters.
    #[error(transparent)]
    Table(#[from] interp::Error),
}

impl Error {
    /// Accepts a value of `[from, to]`.
    pub(crate) fn check(name: &'static str, value: f64, [from, to]: [f64; 2]) -> Result<(), Self> {
        if value >= from && value <= to { Ok(()) } else { Err(Self::Domain { name, value, from, to }) }
    }
}
