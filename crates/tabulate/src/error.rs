//! The errors of scenes, of the generation of tables and of files. Each holds the numbers that
//! explain it.

use std::io;
use std::path::PathBuf;

use crate::printable;

/// Any failure of a scene, of the generation of a table, or of a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A probe whose force curve the page of a table does not compute.
    #[error(
        "the page of this table computes no {probe}: {reason}; `tabulate curve` prints the force curve of every probe"
    )]
    PageProbe {
        /// The name of the shape.
        probe: &'static str,
        /// What the page computes, or what the table lacks.
        reason: &'static str,
    },
    /// A low-rank form whose error is larger than allowed, because of rounding.
    #[error(
        "rounding keeps the low-rank form from an error of {error:.1e}: it has {reached:.1e}; ask for a larger tolerance"
    )]
    Truncation {
        /// The largest relative error allowed at the nodes.
        error: f64,
        /// The smallest error that was reached.
        reached: f64,
    },
    /// A tolerance of a packed table outside the allowed range.
    #[error(
        "tolerance = {tolerance:?} of a packed table is outside {least:e} to {most:e}: give one inside, or pack without a tolerance"
    )]
    PackedTolerance {
        /// The tolerance.
        tolerance: f64,
        /// The smallest allowed.
        least: f64,
        /// The largest allowed.
        most: f64,
    },
    /// A table that is not accurate enough to be packed to the tolerance.
    #[error(
        "its certified error {own:.1e} leaves no room below the tolerance {tolerance:e}; generate the table with a smaller \
         tolerance, or ask for a larger one"
    )]
    NoRoom {
        /// The table's own certified error.
        own: f64,
        /// The tolerance.
        tolerance: f64,
    },
    /// A low-rank form whose error between the nodes is larger than the tolerance.
    #[error(
        "its low-rank form has a measured error of {measured:.1e}, more than the tolerance {tolerance:e}, though truncation adds no more than \
         {truncation:.1e} at its nodes; its own certified error is {own:.1e}; generate the table with a smaller tolerance"
    )]
    Packed {
        /// The measured error.
        measured: f64,
        /// The tolerance.
        tolerance: f64,
        /// The largest error of truncation at the nodes.
        truncation: f64,
        /// The table's own certified error.
        own: f64,
    },
    /// A scene with a wrong key or value.
    #[error("{}: {what}", printable::path(path))]
    Scene {
        /// The scene file.
        path: PathBuf,
        /// A sentence with key, value and range.
        what: String,
    },
    /// A stack file with a wrong key or value.
    #[error("{}: {what}", printable::path(path))]
    StackFile {
        /// The stack file.
        path: PathBuf,
        /// A sentence with layer, value and range.
        what: String,
    },
    /// A table that would need too many nodes.
    #[error(
        "the table would have {} nodes and {values} values, where at most {} nodes on an axis and {most} values are allowed; ask for a larger \
         tolerance, a smaller box or fewer nodes",
        shape.map(|nodes| nodes.to_string()).join(" x "), crate::table::extent::MOST_NODES
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
    #[error(
        "{} is being made by another process; wait for it, or choose another output",
        printable::path(path)
    )]
    Busy {
        /// The table.
        path: PathBuf,
    },
    /// Finished pieces that belong to another generation than the one to be resumed.
    #[error(
        "cannot resume: {} was begun {what}; remove this file to begin anew",
        printable::path(journal)
    )]
    OtherRun {
        /// The journal of the pieces.
        journal: PathBuf,
        /// The difference, as the end of a sentence.
        what: String,
    },
    /// Finished pieces that a generation which is not resumed would drop.
    #[error(
        "{} keeps {what} of an interrupted generation: resume it, or remove this file to begin anew",
        printable::path(journal)
    )]
    Kept {
        /// The journal of the pieces.
        journal: PathBuf,
        /// What it keeps, in words.
        what: String,
    },
    /// A range along which the quantities are too steep to be tabulated.
    #[error(
        "{axis} would take {nodes} nodes or more for the tolerance {tolerance:e}; ask for a larger tolerance, or for a smaller range"
    )]
    Unresolved {
        /// The parameter.
        axis: &'static str,
        /// A number of nodes that f64 cannot tell apart, or that is too small for the tolerance.
        nodes: usize,
        /// The table's tolerance.
        tolerance: f64,
    },
    /// Nodes that are too close to each other for splines.
    #[error(
        "{axis} has {nodes} nodes from {from:?} to {to:?}, which are too close to each other for splines; ask for a \
         wider range, fewer nodes or one number"
    )]
    TooClose {
        /// The parameter.
        axis: &'static str,
        /// The number of its nodes.
        nodes: usize,
        /// The first node.
        from: f64,
        /// The last node.
        to: f64,
    },
    /// A budget that is spent before the work is done.
    #[error("the budget is spent {spent}")]
    Budget {
        /// The state of the work, as the end of a sentence.
        spent: String,
    },
    /// A generation that its observer has ended.
    #[error(
        "the generation was interrupted with {finished} of {total} points solved; they are kept, and a resumed generation goes on from them"
    )]
    Interrupted {
        /// The number of points solved.
        finished: usize,
        /// The number of points of the sweep.
        total: usize,
    },
    /// A piece of a sweep that was solved elsewhere and does not fit.
    #[error(
        "piece {piece} of the sweep came back with {values} values instead of {expected}: solve the pieces by the same version of this program"
    )]
    Piece {
        /// The number of the piece.
        piece: usize,
        /// The number of its values.
        values: usize,
        /// The number of values that it must have.
        expected: usize,
    },
    /// A file that cannot be read.
    #[error("cannot read {}", printable::path(path))]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A file that cannot be written.
    #[error("cannot write {}", printable::path(path))]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A picture that cannot be drawn.
    #[cfg(feature = "figures")]
    #[error(transparent)]
    Picture(#[from] figures::Error),
    /// An error of a solve.
    #[error(transparent)]
    Solve(solve::Error),
    /// An error of a contact in time.
    #[error(transparent)]
    History(#[from] contact::HistoryError),
    /// An error of a contact.
    #[error(transparent)]
    Contact(contact::Error),
    /// An error of a table or of its parameters.
    #[error(transparent)]
    Table(#[from] interp::Error),
}

impl From<contact::Error> for Error {
    fn from(error: contact::Error) -> Self {
        match error {
            contact::Error::Table(error) => Self::Table(error),
            error => Self::Contact(error),
        }
    }
}

impl From<solve::Error> for Error {
    fn from(error: solve::Error) -> Self {
        match error {
            solve::Error::Contact(error) => error.into(),
            error => Self::Solve(error),
        }
    }
}
