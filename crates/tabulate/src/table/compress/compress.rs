//! The low-rank form of a table that keeps a tolerance, measured.

use interp::Parameter;
use interp::{Description, Table};

use crate::Error;
use crate::table::certify::certify;
use crate::table::compress::truncation;
use crate::table::generate::Observer;
use crate::table::scene::TOLERANCE;

/// How much of the room below the tolerance truncation may take at the nodes: the splines through
/// its errors there are larger between them. Measured: 1.35 times as large.
const SHARE: f64 = 0.6;
/// How often the truncation error is halved before the tolerance is given up.
const HALVINGS: u32 = 3;

/// The range of what may be added to derivatives. Rounding allows no less.
const DERIVATIVE_TOLERANCE: [f64; 2] = [1e-9, 1e3];

/// The low-rank form of a table that keeps the tolerance, with the certificate from `points` direct
/// solves that says so.
///
/// If a tolerance is given for them, it also keeps the table's derivatives with respect to `nu1` at
/// 0.5: those of the logarithms of quantities, times `1/(1 + (a/t)^2)`, at the nodes of the other
/// axes; between these nodes they may be a little farther. The certificate does not speak of
/// derivatives.
///
/// # Errors
/// [`Error::PackedTolerance`] for a tolerance outside 1e-10 to 1e-1, [`Error::DerivativeTolerance`]
/// for one outside 1e-9 to 1e3; [`Error::NoRoom`] if the table's own certified error is no less;
/// [`Error::Packed`] if no low-rank form keeps the tolerance; those of [`truncation::compress`] and
/// of the solve.
///
/// # Panics
/// If the certificate is to rest on no point.
pub fn low_rank(
    table: &Table,
    tolerance: f64,
    derivative_tolerance: Option<f64>,
    points: usize,
    seed: u64,
    observer: &dyn Observer,
) -> Result<Table, Error> {
    let [least, most] = TOLERANCE;
    if !(least..=most).contains(&tolerance) {
        return Err(Error::PackedTolerance {
            tolerance,
            least,
            most,
        });
    }
    let [least, most] = DERIVATIVE_TOLERANCE;
    if let Some(tolerance) =
        derivative_tolerance.filter(|tolerance| !(least..=most).contains(tolerance))
    {
        return Err(Error::DerivativeTolerance {
            tolerance,
            least,
            most,
        });
    }
    let description = Description {
        tolerance,
        ..table.description().clone()
    };
    let own = description.certificate.max_error;
    // Not an ordered comparison the other way round: NaN must not pass.
    let has_room = own < tolerance;
    if !has_room {
        return Err(Error::NoRoom { own, tolerance });
    }
    let (mut truncation, mut measured) = (SHARE * (tolerance - own), f64::NAN);
    for _ in 0..=HALVINGS {
        let axes = Parameter::ALL.map(|parameter| table.axis(parameter).to_vec());
        let mut packed = Table::from_low_rank(
            description.clone(),
            axes,
            truncation::compress(table, truncation, derivative_tolerance)?,
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
    Err(Error::Packed {
        measured,
        tolerance,
        truncation: 2.0 * truncation,
        own,
    })
}
