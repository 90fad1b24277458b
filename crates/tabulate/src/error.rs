//! The errors of solving, of scenes and of files. Each holds the numbers that explain it.

use std::io;
use std::path::PathBuf;

use interp::Material;

use crate::printable;

/// Any failure of the solve, of a scene, or of a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A parameter outside the domain of the solve.
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
    /// A tolerance that the solve has not reached.
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
        /// The tolerance.
        tolerance: f64,
        /// The estimated relative error that was reached; infinite where every method failed.
        reached: f64,
    },
    /// A tolerance that the solve of a stack of layers has not reached.
    #[error(
        "tolerance {tolerance:.1e} is not reached at a_over_t = {a_over_t:?} of this stack of layers: the estimated error is {reached:.1e}; \
         ask for a larger tolerance"
    )]
    StackNotConverged {
        /// The contact radius over the thickness of the stack.
        a_over_t: f64,
        /// The tolerance.
        tolerance: f64,
        /// The estimated relative error that was reached; infinite where the method failed.
        reached: f64,
    },
    /// A contact that is too wide beside the top layer of a stack.
    #[error(
        "a_over_t = {a_over_t:?} is out of reach of this stack of {}: its thickness is {thickness_over_top:?} times that \
         of its top layer, and the contact radius may be at most {most} times that of the top layer; use an a_over_t up to {reach:?}, or \
         leave out a top layer that is too thin to matter",
        if *layers == 1 {
            "one layer that is not like its base".to_owned()
        } else {
            format!("{layers} different layers")
        }
    )]
    StackReach {
        /// The contact radius over the thickness of the stack.
        a_over_t: f64,
        /// The largest contact radius within reach, over the thickness of the stack.
        reach: f64,
        /// The largest contact radius within reach, over the thickness of the top layer.
        most: f64,
        /// The thickness of the stack over that of its top layer.
        thickness_over_top: f64,
        /// The number of layers, of which neighbours of one material count as one.
        layers: usize,
    },
    /// A stack without layers.
    #[error(
        "a stack needs at least one layer on its base; a sphere on the bare base is `interp::HalfSpace`"
    )]
    NoLayers,
    /// A layer that a stack cannot have.
    #[error("layer {layer} of {layers}, counted from the base: {what}")]
    Layer {
        /// The number of the layer, from 1 at the base.
        layer: usize,
        /// The number of all layers.
        layers: usize,
        /// A sentence with the value and the allowed range.
        what: String,
    },
    /// An attraction of finite range that has no solution at a contact radius.
    #[error(
        "there is no contact of radius {contact_radius:?} m with this attraction: {what}; take a larger contact radius or a shorter interaction range"
    )]
    NotAContact {
        /// The contact radius, m.
        contact_radius: f64,
        /// The condition that is not fulfilled.
        what: &'static str,
    },
    /// An attraction of finite range under a probe that is no paraboloid.
    #[error(
        "an attraction of finite range is solved for a paraboloid only, not for a {probe}; use the paraboloid with the radius of curvature of the tip, or no interaction range"
    )]
    OnlyParaboloid {
        /// The name of the shape.
        probe: &'static str,
    },
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
    /// An attraction that reaches farther than is solved.
    #[error(
        "at the contact radius {contact_radius:?} m the attraction acts beyond the radius {reach:?} m, up to which it is solved; take a smaller contact radius or a shorter interaction range"
    )]
    AnnulusReach {
        /// The contact radius, m.
        contact_radius: f64,
        /// The largest outer radius, m.
        reach: f64,
    },
    /// A pull-off with an attraction of finite range at a contact wider than is solved.
    #[error(
        "at the pull-off the contact, or the attraction around it, is wider than {reach:?} m, up to which an attraction of finite range is \
         solved on a top layer of {thickness:?} m; take a smaller sphere or a thicker layer, or leave out the range of the attraction: \
         JKR, the limit of short ranges, is solved on thinner layers"
    )]
    PullOffReach {
        /// The largest radius that is solved, m.
        reach: f64,
        /// The thickness of the top layer, m.
        thickness: f64,
    },
    /// A measurement that differs from a recorded one.
    #[error("row {row}: {column} was {before} and is {now}")]
    Changed {
        /// The number of the row, from 1.
        row: usize,
        /// The column.
        column: String,
        /// The recorded value.
        before: String,
        /// The new value.
        now: String,
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
    #[error("cannot draw: {0}")]
    Picture(String),
    /// An error of a table or of its parameters.
    #[error(transparent)]
    Table(#[from] interp::Error),
}

impl Error {
    /// Accepts a value in `[from, to]`.
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
