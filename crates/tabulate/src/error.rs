//! The errors of scenes, of the generation of tables and of files. The text of each has the
//! numbers that explain it.

use std::io;
use std::path::PathBuf;

use crate::printable;

/// Any failure of a scene, of the generation of a table, or of a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A probe that the page of a table does not compute, or a tolerance that no packed table has, in a sentence.
    #[error("{0}")]
    Refused(String),
    /// A low-rank form out of reach, by rounding or by the error of the table itself, in a sentence with the errors.
    #[error("{0}")]
    NoLowRank(String),
    /// A low-rank form whose error between the nodes is larger than the tolerance, in a sentence with the errors.
    #[error("{0}")]
    Packed(String),
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
    /// Nodes that are too many or too close to each other, in a sentence with their numbers.
    #[error("{0}")]
    Nodes(String),
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
    /// A piece of a sweep that was solved elsewhere and does not fit, in a sentence with its numbers.
    #[error("{0}")]
    Piece(String),
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
    Solve(#[from] solve::Error),
    /// An error of a contact.
    #[error(transparent)]
    Contact(#[from] contact::Error),
    /// An error of a table or of its parameters.
    #[error(transparent)]
    Table(#[from] interp::Error),
}
