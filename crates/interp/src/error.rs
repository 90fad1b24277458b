//! The errors of this crate. Each message names the value and the values allowed. A program adds the
//! next step in its own words.

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

use crate::{Quantity, SubstratePoissonRatio};

/// Any failure of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A value that no physical system has.
    #[error("{name} = {value:?} is not physical: it must be {allowed}")]
    Unphysical {
        /// The name of the parameter.
        name: &'static str,
        /// The value given.
        value: f64,
        /// The values allowed, in words.
        allowed: &'static str,
    },
    /// An argument with a length, a count, an order or a range that the computation does not
    /// accept.
    #[error("{name} = {value:?} cannot be used: it must be {allowed}")]
    InvalidArgument {
        /// The name of the argument.
        name: &'static str,
        /// The value given.
        value: f64,
        /// The values allowed, in words.
        allowed: Cow<'static, str>,
    },
    /// A contact radius that is not below the radius of the sphere.
    #[error(
        "contact radius = {contact_radius:?} m cannot be used: it must be below the sphere's radius \
         R = {sphere_radius:?} m; check its unit, and whether the arguments are in the right order"
    )]
    BeyondSphere {
        /// The contact radius given, m.
        contact_radius: f64,
        /// The radius of the sphere, m.
        sphere_radius: f64,
    },
    /// A contact radius that the shape of the probe does not have.
    #[error(
        "contact radius = {contact_radius:?} m cannot be used under a {probe}: it must be {allowed} \
         {limit:?} m"
    )]
    BeyondProbe {
        /// The name of the shape.
        probe: &'static str,
        /// The contact radius given, m.
        contact_radius: f64,
        /// The radii allowed, in words that a radius follows.
        allowed: &'static str,
        /// That radius, m.
        limit: f64,
    },
    /// A question that makes no sense for the shape of the probe.
    #[error("{question} makes no sense for a {probe}: {reason}")]
    OtherProbe {
        /// The question.
        question: &'static str,
        /// The name of the shape.
        probe: &'static str,
        /// The reason, and what to ask instead.
        reason: &'static str,
    },
    /// Points of a measured probe that are no convex shape.
    #[error("row {row} of the profile of the probe cannot be used: {reason}")]
    Profile {
        /// The number of the row, from 1.
        row: usize,
        /// The reason.
        reason: &'static str,
    },
    /// A query outside the box of the table or outside the `a/t` of the curve.
    #[error(
        "{axis} = {value:?} is outside the table or curve, which {}; ask for a value inside, make the \
         table or the curve over a wider range, or solve the contact without a table",
        extent(*from, *to)
    )]
    OutsideTable {
        /// The axis whose range does not include the value.
        axis: &'static str,
        /// The value asked for.
        value: f64,
        /// The smallest value of the axis.
        from: f64,
        /// The largest value of the axis.
        to: f64,
    },
    /// A query beyond the nodes in `a/t`, where the expansion about the limit is not accurate
    /// enough.
    #[error(
        "a_over_t = {value:?} is beyond the table, which ends at {edge:?}: the expansion about the \
         limit is accurate to {estimate:.1e} there, and the table to {tolerance:.1e}; make a table \
         whose scene extends a_over_t to this value, or solve the contact without a table"
    )]
    Extrapolation {
        /// The `a/t` asked for.
        value: f64,
        /// The first or the last node in `a/t`, whichever is nearer to the value.
        edge: f64,
        /// The estimated relative error of the expansion.
        estimate: f64,
        /// The relative tolerance of the table.
        tolerance: f64,
    },
    /// A material on a substrate with another Poisson ratio than the table's, whose equivalent does
    /// not exist or is outside the table.
    #[error(
        "nu1 = {nu1:?} with nu0 = {nu0:?} has no equivalent in a table made for nu0 = {table_nu0}; \
         make a table with nu0 = {nu0:?} in its scene, which needs no equivalent, or solve the contact \
         without a table; the cause: {cause}"
    )]
    Equivalent {
        /// The Poisson ratio of the film.
        nu1: f64,
        /// The Poisson ratio of the substrate.
        nu0: f64,
        /// The Poisson ratio of the table's substrates.
        table_nu0: SubstratePoissonRatio,
        /// The error of the equivalent material. The message includes it; therefore it is not the
        /// [source](std::error::Error::source), which many programs print after the message.
        cause: Box<Error>,
    },
    /// A rigid sphere in a table for compliant spheres, or the other way round.
    #[error(
        "the sphere is {}, and the table is made for {} spheres, in units of {table}: use a table with {} in its \
         scene, or, for one film, the embedded table, which holds both",
        sphere(query)[0],
        sphere(table)[0],
        sphere(query)[1]
    )]
    Normalisation {
        /// The modulus that normalises the table.
        table: &'static str,
        /// The modulus that would normalise the result of the query.
        query: &'static str,
    },
    /// A lookup of one film in a table of one stack of layers.
    #[error(
        "the table is of one stack of layers under spheres of any modulus, and the question is about one \
         film on a substrate: look it up as the table of a stack, or use a table of films, such as the \
         embedded one"
    )]
    OfStack,
    /// A lookup of a stack of layers in a table of films.
    #[error(
        "the table is of films on substrates, and the question is about a stack of layers: make the \
         table of a scene with a [stack], or solve the stack without a table"
    )]
    NotOfStack,
    /// A quantity that the table does not hold, because its scene did not ask for it.
    #[error(
        "the table does not hold {0}: add it to `quantities` in the scene and make the table again"
    )]
    MissingQuantity(&'static str),
    /// A quantity that a table of `gamma` alone does not answer, because it begins at too large an
    /// `a/t`: the other quantities are integrals over `a/t` that begin there.
    #[error(
        "{quantity} does not follow from gamma alone in a table or curve that begins at a_over_t = {from:?}: \
         the estimated error is {estimate:.1e} there, and the tolerance {tolerance:.1e}; \
         begin it at a smaller a_over_t, and extend it to four times that{}",
        or_hold(quantity)
    )]
    BeginsTooLate {
        /// The name of the quantity.
        quantity: &'static str,
        /// The first node in `a/t`.
        from: f64,
        /// The estimated relative error; infinite if there is no estimate, because the table begins
        /// beyond 0.4 or ends before four times its first `a/t`.
        estimate: f64,
        /// The relative tolerance of the table.
        tolerance: f64,
    },
    /// A derivative that is unknown, because the scene of the table fixes the parameter or because the
    /// curve was made without it.
    #[error(
        "there is no derivative with respect to {0}: the contact does not depend on it, it is at \
         the end of its domain, the curve was made without it (make it with all derivatives), or the table \
         fixes a parameter that the derivative needs (make a table whose scene gives a_over_t, e1_over_e2, \
         nu1 and e0_over_e2 as ranges)"
    )]
    FixedParameter(&'static str),
    /// The gradient of a curve that was made without one.
    #[error(
        "the curve has no derivatives with respect to the material: make it, \
         or the contact, with its gradient"
    )]
    NoGradient,
    /// Bytes that are no table of this project, or a table in another form than the one read.
    #[error("not a coated-contact table of the form read here: {0}")]
    Foreign(String),
    /// A table in another version of the format.
    #[error(
        "the table has format version {found}, this program reads version {supported}: make the \
         table again, or convert it to the other form by the program that made it and back by this one"
    )]
    Version {
        /// The version in the file.
        found: u32,
        /// The only version that is read.
        supported: u32,
    },
    /// Missing or trailing bytes.
    #[error(
        "the table is truncated or has trailing bytes: {expected} bytes expected, {found} found; \
         copy or download the file again"
    )]
    Length {
        /// The length that the header states.
        expected: u64,
        /// The length found.
        found: u64,
    },
    /// Bytes that changed after they were written.
    #[error(
        "the table is corrupt: checksum {found:08x}, stored {stored:08x}; copy or download the file \
         again"
    )]
    Checksum {
        /// The checksum in the file.
        stored: u32,
        /// The checksum of the bytes found.
        found: u32,
    },
    /// A table whose parts contradict each other or the schema.
    #[error("the table is malformed: {0}; make the table again, or copy the file again")]
    Malformed(String),
    /// A low-rank form whose first lookup would need too much memory or time.
    #[error(
        "a low-rank form with the ranks {ranks:?} and {nodes:?} nodes is too large: its first lookup \
         would need {needed} {what}, and at most {most} are allowed; pack the table with a larger \
         tolerance, make it for a smaller box or with fewer nodes, or \
         use it as HDF5 or packed without a tolerance"
    )]
    LowRankTooLarge {
        /// The ranks of the form of each tile.
        ranks: Vec<[usize; 3]>,
        /// The numbers of nodes of the axes.
        nodes: [usize; 4],
        /// What it needs too many of, numbers in memory or products.
        what: &'static str,
        /// The number that it needs.
        needed: u64,
        /// The largest number allowed for a form of its size.
        most: u64,
    },
    /// A file that is no table, or not a sound one.
    #[error("{}: {error}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong with its content. It is part of the message, and therefore no source.
        error: Box<Self>,
    },
    /// A file that cannot be read.
    #[error("cannot read {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}

/// Formats the range of an axis, or its only value.
fn extent(from: f64, to: f64) -> String {
    if from == to {
        format!("has only {from:?}")
    } else {
        format!("covers {from:?} to {to:?}")
    }
}

/// Returns how a table answers a quantity that it now derives; nothing for the contact of a probe.
fn or_hold(name: &str) -> String {
    match Quantity::ALL.iter().any(|quantity| quantity.name() == name) {
        true => format!(", or add {name} to `quantities` in the scene of the table"),
        false => String::new(),
    }
}

/// Returns the kind of a sphere whose contact is normalised by this modulus, and the `e1_over_e2` of a
/// scene for it.
fn sphere(normalisation: &str) -> [&'static str; 2] {
    match normalisation {
        "E1*" => ["rigid", "e1_over_e2 = 0"],
        _ => ["compliant", "e1_over_e2 > 0"],
    }
}

impl Error {
    /// Adds the file whose content is wrong.
    pub(crate) fn in_file(self, path: &Path) -> Self {
        match self {
            Self::Io { .. } => self,
            error => Self::InFile {
                path: path.to_owned(),
                error: Box::new(error),
            },
        }
    }

    /// Returns what is wrong with the content of a file, without the path of the file: the error
    /// within [`Error::InFile`], and every other error as it is.
    #[must_use]
    pub fn without_file(self) -> Self {
        match self {
            Self::InFile { error, .. } => *error,
            error => error,
        }
    }

    /// Returns [`Error::Unphysical`] unless `holds`. A condition that compares with NaN must be
    /// false.
    ///
    /// # Errors
    /// [`Error::Unphysical`].
    pub const fn unless(
        holds: bool,
        name: &'static str,
        value: f64,
        allowed: &'static str,
    ) -> Result<(), Self> {
        if holds {
            Ok(())
        } else {
            Err(Self::Unphysical {
                name,
                value,
                allowed,
            })
        }
    }

    /// Returns [`Error::InvalidArgument`] unless `holds`.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`].
    pub const fn argument(
        holds: bool,
        name: &'static str,
        value: f64,
        allowed: &'static str,
    ) -> Result<(), Self> {
        if holds {
            Ok(())
        } else {
            Err(Self::InvalidArgument {
                name,
                value,
                allowed: Cow::Borrowed(allowed),
            })
        }
    }

    /// Returns [`Error::InvalidArgument`] unless there are as many values to write as points.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`].
    pub fn same_length<P, V>(points: &[P], values: &[V]) -> Result<(), Self> {
        if points.len() == values.len() {
            return Ok(());
        }
        Err(Self::InvalidArgument {
            name: "the number of values to write",
            value: values.len() as f64,
            allowed: Cow::Owned(format!("{}, one for each point", points.len())),
        })
    }
}
