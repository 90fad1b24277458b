//! Derivatives of the quantities, of load and penetration, against differences of direct solves and
//! of the interpolant.

mod load;
mod quantities;
mod wanted;

/// The largest error of a derivative of the logarithm of a quantity, in tolerances of the table, in
/// the order `a/t`, `E1`, `nu1`, `E0`, `nu0`. The derivatives are with respect to the logarithm of
/// `a/t` or of a modulus, or to a Poisson ratio. The unit of `nu1` is the range on which the
/// quantities change, `(1 - 2 nu1) + 1/(1 + (a/t)^2)`.
const SHARES: [f64; 5] = [20.0, 20.0, 100.0, 20.0, 20.0];
