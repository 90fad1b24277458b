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
    /// A measurement that is not what it was.
    #[error("row {row}: {column} was {before} and is {now}")]
    Changed {
        /// The number of the row, from 1.
        row: usize,
        /// The column.
        column: String,
        /// What it was.
        before: String,
        /// What it is.
        now: String,
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
    /// A low-rank form that rounding keeps from the derivatives that were asked for.
    #[error(
        "a low-rank form whose derivatives with respect to nu1 at 0.5 are off by {allowed:.1e} is not within rounding: they are by \
         {reached:.1e}; ask for a larger derivative tolerance, or for a smaller tolerance"
    )]
    DerivativeTruncation {
        /// The error of the derivatives that was asked for.
        allowed: f64,
        /// The smallest that was reached.
        reached: f64,
    },
    /// A tolerance that no packed table is asked for.
    #[error("tolerance = {tolerance:?} is outside {least:e} to {most:e}")]
    PackedTolerance {
        /// What was asked for.
        tolerance: f64,
        /// The smallest allowed.
        least: f64,
        /// The largest allowed.
        most: f64,
    },
    /// An error of derivatives that no packed table is asked for.
    #[error("derivative tolerance = {tolerance:?} is outside {least:e} to {most:e}")]
    DerivativeTolerance {
        /// What was asked for.
        tolerance: f64,
        /// The smallest allowed.
        least: f64,
        /// The largest allowed.
        most: f64,
    },
    /// Derivatives of incompressible films, from a table that does not hold them.
    #[error(
        "a derivative tolerance is of films with nu1 = 0.5, at the end of an axis of {least} nodes or more; this table has {nodes} to {last:?}"
    )]
    NoIncompressibleEnd {
        /// The fewest that it takes.
        least: usize,
        /// How many there are.
        nodes: usize,
        /// The last `nu1`.
        last: f64,
    },
    /// A table that is not accurate enough to be packed to the tolerance.
    #[error(
        "its certified error {own:.1e} leaves no room below the tolerance {tolerance:e}: make it with a smaller tolerance"
    )]
    NoRoom {
        /// The table's own certified error.
        own: f64,
        /// What was asked for.
        tolerance: f64,
    },
    /// A low-rank form that misses its tolerance between the nodes.
    #[error(
        "its low-rank form has a measured error of {measured:.1e}, more than the tolerance {tolerance:e}, though truncation adds no more than \
         {truncation:.1e} at its nodes; its own certified error is {own:.1e}: make it with a smaller tolerance"
    )]
    Packed {
        /// The error measured.
        measured: f64,
        /// What was asked for.
        tolerance: f64,
        /// The largest error of truncation at the nodes.
        truncation: f64,
        /// The table's own certified error.
        own: f64,
    },
    /// A scene that says something impossible.
    #[error("{}: {what}", path.display())]
    Scene {
        /// The scene file.
        path: PathBuf,
        /// What is wrong: key, value and range.
        what: String,
    },
    /// A table that would need more nodes than any is made with.
    #[error(
        "the tolerance takes a table of {} nodes, {values} values, where at most {} nodes on an axis and {most} values are made; ask for a larger \
         tolerance, a smaller box or fewer nodes",
        shape.map(|nodes| nodes.to_string()).join(" x "), crate::table::scene::MOST_NODES
    )]
    TooLarge {
        /// The nodes on each axis.
        shape: [usize; 4],
        /// The number of values.
        values: usize,
        /// The largest number of values.
        most: usize,
    },
    /// A table that another process is making.
    #[error("{} is being made by another process", path.display())]
    Busy {
        /// The table.
        path: PathBuf,
    },
    /// Finished pieces that belong to something else than is to be resumed.
    #[error("cannot resume: {} was begun {what}; without --resume everything begins anew", journal.display())]
    OtherRun {
        /// The journal of the pieces.
        journal: PathBuf,
        /// What differs.
        what: String,
    },
    /// A range along which the quantities are too steep.
    #[error(
        "{axis} would take {nodes} nodes or more for the tolerance {tolerance:e}; ask for a larger one, or for a smaller range"
    )]
    Unresolved {
        /// The parameter.
        axis: &'static str,
        /// A number of nodes that is too large to be told apart, or too small.
        nodes: usize,
        /// The table's tolerance.
        tolerance: f64,
    },
    /// Not enough time.
    #[error("the budget is spent {spent}")]
    Budget {
        /// On what.
        spent: String,
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
    /// A picture that cannot be drawn.
    #[error("cannot draw: {0}")]
    Picture(String),
    /// A failure of the table or of its parameters.
    #[error(transparent)]
    Table(#[from] interp::Error),
}

impl Error {
    /// Accepts a value of `[from, to]`.
    pub(crate) fn check(name: &'static str, value: f64, [from, to]: [f64; 2]) -> Result<(), Self> {
        if value >= from && value <= to {
            Ok(())
        } else {
            Err(Self::Domain {
                name,
                value,
                from,
                to,
            })
        }
    }
}
