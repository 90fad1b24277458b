//! The low-rank form of a table that keeps a tolerance, with its certificate.

use interp::{Description, Table};

use crate::Error;
use crate::table::certify::{certify, points_for};
use crate::table::compress::tiles::compress;
use crate::table::generate::Observer;
use crate::table::scene::TOLERANCE;

/// The error that truncation may add at the nodes, in parts of the room below the tolerance. The
/// polynomials are about as accurate between the nodes.
const SHARE: f64 = 0.9;
/// The number of times that the error of truncation is halved before packing is given up.
const HALVINGS: u32 = 3;

/// Returns the low-rank form of a table that keeps the tolerance, with the certificate from
/// `points` direct solves, those of [`points_for`] if none are given, and another seed than the table's, if none is given.
///
/// The certificate does not cover derivatives.
///
/// # Errors
/// [`Error::Refused`] for a tolerance outside 1e-10 to 1e-1; [`Error::NoLowRank`] if the
/// table's own certified error is not below it; [`Error::Packed`] if no low-rank form keeps the
/// tolerance; those of [`compress`](super::compress()) and of the solve.
///
/// # Panics
/// If `points` is 0.
pub fn low_rank(
    table: &Table,
    tolerance: f64,
    points: Option<usize>,
    seed: Option<u64>,
    observer: &dyn Observer,
) -> Result<Table, Error> {
    let [least, most] = TOLERANCE;
    if !(least..=most).contains(&tolerance) {
        return Err(Error::Refused(format!(
            "tolerance = {tolerance:?} of a packed table is outside {least:e} to {most:e}: give one inside, or pack without a tolerance"
        )));
    }
    let description = Description {
        tolerance,
        ..table.description().clone()
    };
    let own = description.certificate.max_error;
    let points = points.unwrap_or_else(|| points_for(table));
    let seed = seed.unwrap_or(description.certificate.seed.wrapping_add(1));
    // Not `own >= tolerance`: NaN must not pass.
    let has_room = own < tolerance;
    if !has_room {
        return Err(Error::NoLowRank(format!(
            "its certified error {own:.1e} leaves no room below the tolerance {tolerance:e}; generate the table with a smaller \
             tolerance, or ask for a larger one"
        )));
    }
    let (mut truncation, mut measured) = (SHARE * (tolerance - own), f64::NAN);
    for _ in 0..=HALVINGS {
        let mut packed = Table::from_low_rank(
            description.clone(),
            table.axes(),
            table.quantities(),
            compress(table, truncation)?,
        )?;
        observer.begin("checking", points, 0);
        packed.set_certificate(certify(&packed, points, seed, &|count| {
            observer.advance(count)
        })?);
        measured = packed.description().certificate.max_error;
        if measured <= tolerance {
            return Ok(packed);
        }
        truncation *= 0.5;
    }
    Err(Error::Packed(format!(
        "its low-rank form has a measured error of {measured:.1e}, more than the tolerance {tolerance:e}, though truncation adds no more than \
         {:.1e} at its nodes; its own certified error is {own:.1e}; generate the table with a smaller tolerance",
        2.0 * truncation
    )))
}
