//! What can go wrong, with the numbers that say why.

use std::io;
use std::path::PathBuf;

use crate::Material;

/// Any failure of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A value that no physical system has.
    #[error("{name} = {value:?} is not physical: it must be {allowed}")]
    Unphysical {
        /// The parameter's name.
        name: &'static str,
        /// The value given.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// An argument that no computation takes: a wrong length, count or order.
    #[error("{name} = {value:?} cannot be used: it must be {allowed}")]
    InvalidArgument {
        /// The argument.
        name: &'static str,
        /// The value given.
        value: f64,
        /// The values allowed, in words.
        allowed: &'static str,
    },
    /// A query outside the box that the table covers, or the range of the curve.
    #[error("{axis} = {value:?} is outside the range of the table or curve, {from:?} to {to:?}")]
    OutsideTable {
        /// The axis that does not hold the value.
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
        "a_over_t = {value:?} is beyond the table, which ends at {edge:?}: \
         the expansion about the limit is accurate to {estimate:.1e} there, and the table to {tolerance:.1e}"
    )]
    Extrapolation {
        /// The `a/t` asked for.
        value: f64,
        /// The end of the nodes that it is beyond.
        edge: f64,
        /// The estimated relative error of the expansion.
        estimate: f64,
        /// The tolerance of the table.
        tolerance: f64,
    },
    /// A state whose contact radius is out of the range of the table or curve.
    #[error(
        "{name} = {value:?} takes a contact radius outside the range of the table or curve, {from:?} m to {to:?} m"
    )]
    OutsideRadii {
        /// What was imposed or measured.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The smallest contact radius, m.
        from: f64,
        /// The largest contact radius, m.
        to: f64,
    },
    /// A load, penetration or position of the spring at which there is no contact.
    #[error("there is no contact at {name} = {value:?}: it is {least:?} at least")]
    NoContact {
        /// What was imposed.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least value there is.
        least: f64,
    },
    /// A material on a substrate with another Poisson ratio than the table's, whose equivalent the
    /// table does not cover.
    #[error(
        "nu1 = {nu1:?} with nu0 = {nu0:?} has no equivalent in a table made for nu0 = {table_nu0:?}"
    )]
    Equivalent {
        /// The film's Poisson ratio.
        nu1: f64,
        /// The substrate's Poisson ratio.
        nu0: f64,
        /// The Poisson ratio of the table's substrate.
        table_nu0: f64,
        /// What is wrong with the equivalent.
        source: Box<Error>,
    },
    /// A rigid sphere asked of a table for compliant ones, or the other way round.
    #[error("the table is normalised by {table}, the query needs one normalised by {query}")]
    Normalisation {
        /// The modulus that normalises the table.
        table: &'static str,
        /// The modulus that would normalise the query's result.
        query: &'static str,
    },
    /// A curve made for another material than the system's.
    #[error(
        "the curve was made for {}, the system has {}",
        parameters(curve),
        parameters(system)
    )]
    OtherMaterial {
        /// The material of the curve.
        curve: Material,
        /// The system's, on a substrate with the Poisson ratio of the curve's.
        system: Material,
    },
    /// A quantity that the scene of the table did not ask for.
    #[error("the table does not hold {0}: its scene did not ask for it")]
    MissingQuantity(&'static str),
    /// A motion of the contact line that cannot be integrated to the tolerance.
    #[cfg(feature = "dynamics")]
    #[error("the contact line cannot be followed beyond {time:?} s: {reason}")]
    Motion {
        /// How far it was followed, s from the beginning of the ramp.
        time: f64,
        /// What stopped the solver.
        reason: String,
    },
    /// A derivative that is not known, in most cases because the scene of the table fixes the
    /// parameter.
    #[error(
        "there is no derivative with respect to {0}: it is no axis of the table, or needs a parameter that is none"
    )]
    FixedParameter(&'static str),
    /// A gradient of a curve that was made without one.
    #[error(
        "the curve has no derivatives with respect to the material: make it with `curve_with_gradient`"
    )]
    NoGradient,
    /// Bytes that are no table of this project.
    #[error("not a coated-contact table: {0}")]
    Foreign(String),
    /// A table in another version of the format.
    #[error("the table has format version {found}, this program reads version {supported}")]
    Version {
        /// The version in the file.
        found: u32,
        /// The only version that is read.
        supported: u32,
    },
    /// Bytes that are missing or too many.
    #[error(
        "the table is truncated or has trailing bytes: {expected} bytes expected, {found} found"
    )]
    Length {
        /// The length that the header states.
        expected: u64,
        /// The length there is.
        found: u64,
    },
    /// Bytes that changed after they were written.
    #[error("the table is corrupt: checksum {found:08x}, stored {stored:08x}")]
    Checksum {
        /// The checksum in the file.
        stored: u32,
        /// The checksum of the bytes.
        found: u32,
    },
    /// A table whose parts contradict each other or the schema.
    #[error("the table is malformed: {0}")]
    Malformed(String),
    /// A file that cannot be read.
    #[error("cannot read {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
}

/// A material in words.
fn parameters(material: &Material) -> String {
    let [e1, nu1, e0, nu0] = [
        material.e1_over_e2(),
        material.nu1(),
        material.e0_over_e2(),
        material.nu0(),
    ];
    format!("e1_over_e2 = {e1:?}, nu1 = {nu1:?}, e0_over_e2 = {e0:?}, nu0 = {nu0:?}")
}

impl Error {
    /// Accepts a value of which `holds` is true; comparisons with NaN are not.
    pub(crate) const fn unless(
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

    /// Accepts an argument of which `holds` is true.
    pub(crate) const fn argument(
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
                allowed,
            })
        }
    }
}
