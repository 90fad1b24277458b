//! The certificate of a table: the largest error at sampled points, measured by direct solves.

use serde::{Deserialize, Serialize};

use crate::{Error, Quantity};

/// The certificate of a table: the largest error at sampled points, with its statistics.
///
/// The errors are those of the interpolated quantities at points off the nodes, relative to direct
/// solves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The largest relative error of all quantities at all points.
    pub max_error: f64,
    /// The relative error that 99.9 % of the points do not exceed.
    pub p999_error: f64,
    /// The median over the points of the largest relative error at a point.
    pub median_error: f64,
    /// The number of sampled points.
    pub points: u64,
    /// The seed of the random points.
    pub seed: u64,
    /// The quantity with the largest error.
    pub worst_quantity: Quantity,
    /// The point with the largest error: `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`.
    pub worst_point: [f64; 4],
    /// The largest errors of four identities on the interpolant, each relative to the
    /// sizes of its terms;
    /// `None` where it was not measured, a quantity is missing or `a/t` is fixed:
    ///
    /// ```text
    /// Gamma^2 = es (Eeq + x Eeq')
    /// 3 Pi0 + x Pi0' = 4 Eeq (2 Delta0 + x Delta0')
    /// 2 Delta0 + x Delta0' = 2 es Eeq/Gamma^2
    /// 3 Pi0 + x Pi0' = 8 es Eeq^2/Gamma^2
    /// ```
    pub identity_errors: [Option<f64>; 4],
}

impl Certificate {
    /// The certificate of a table that has not yet been compared with solves: its errors are NaN,
    /// and [`Curve::error`](crate::Curve::error) is an error.
    pub const UNMEASURED: Self = Self {
        max_error: f64::NAN,
        p999_error: f64::NAN,
        median_error: f64::NAN,
        points: 0,
        seed: 0,
        worst_quantity: Quantity::Pi0,
        worst_point: [f64::NAN; 4],
        identity_errors: [None; 4],
    };

    /// Accepts the certificate of a table that is read from a file: one that was measured, or
    /// [`Self::UNMEASURED`].
    ///
    /// # Errors
    /// [`Error::Malformed`] for errors that are negative, infinite or no numbers, or not in order.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let Self {
            max_error,
            p999_error,
            median_error,
            points,
            worst_point,
            ..
        } = *self;
        let in_order = 0.0 <= median_error && median_error <= p999_error && p999_error <= max_error;
        let identities: Vec<f64> = self.identity_errors.iter().copied().flatten().collect();
        let measured = points > 0
            && max_error < f64::INFINITY
            && in_order
            && !worst_point.iter().any(|value| value.is_nan())
            && identities
                .iter()
                .all(|error| (0.0..f64::INFINITY).contains(error));
        let unmeasured = points == 0
            && [max_error, p999_error, median_error]
                .iter()
                .all(|error| error.is_nan());
        if measured || unmeasured {
            return Ok(());
        }
        Err(Error::Malformed(format!(
            "its certificate has median_error = {median_error:?}, p999_error = {p999_error:?}, max_error = \
             {max_error:?}, points = {points}, worst_point = {worst_point:?}, identity_errors = {identities:?}: \
             if it was measured, 0 <= median_error <= p999_error <= max_error must hold, and all errors be finite"
        )))
    }
}
