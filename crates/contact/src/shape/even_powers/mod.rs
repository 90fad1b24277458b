//! Other shapes than the paraboloid from `Gamma` and `Eeq` of a curve: even powers of `r`, and the
//! sphere as a sum of them.
//!
//! `weights` holds the sum, `beginning` the thick film with which the integrals begin, `ladder` the
//! integrals over the pieces of the curve, and `thick_films` what comes before its first node.
//!
//! # The ladder
//!
//! For the shape `f = c r^n` with `b = c kappa_n s^n` (see `transform`) let `delta0 = c kappa_n a^n Delta_n`, and let `mu_n` be the moment of order `n` of
//! the transform `g1` of the flat punch's stress on the unit interval, so that `mu_0 = Eeq`. With
//! `x = a/t`, for even `n`,
//!
//! ```text
//! (x^n Delta_n)'     = n (n - 1) es x^(n-1) mu_(n-2)/Gamma^2
//! (x^(n+1) mu_n)'    = x^n Gamma^2 Delta_n/es
//! ```
//!
//! The proof goes on from that of the page `interp/src/curve/derived.rs` of the source, in its notation. Without adhesion
//! `dg/da = delta0' g1` for every shape. Two derivatives with respect to `r` commute with `A` but
//! for terms of the edges, `A d2g/dr2 = -b'' + edges`. As there, the equation at the edge gives
//! `(delta0' g1(a)^2)'` of a shape with a constant `b''`; for any other it gives
//!
//! ```text
//! delta0' = (es/Gamma^2) [b'(0) g1(0) + int_0^a b''(s) g1(s; a) ds]
//! ```
//!
//! because `b''` takes the place of the right-hand side 1, and the flux `Gamma^2 delta0'/es`
//! through the edge is the product of both right-hand sides, `int b'' g1`. With `b'' ~ s^(n-2)` it
//! is the first line. The second line is step 1 of `derived.rs` for the right-hand sides 1 and
//! `r^n`. As `Delta_2 = Delta0`, both lines in turn give `mu_2`, `Delta_4`, `mu_4`, and so on. All
//! integrands are positive: nothing cancels.
//!
//! # The sphere
//!
//! With `b'' = sum_k beta_k s^(2k)` the first line is `delta0' = (es/Gamma^2) sum_k beta_k a^(2k+1)
//! mu_2k`, and `F0' = S delta0'`. So only these two sums are integrated, and `delta0` and `F0` are
//! continuous although the `beta_k` are others on every piece. For small `a/R` they are the
//! first terms of the series of `b = s artanh(s/R)`; above, those of the polynomial in `s^2` that
//! equals `b'/s` at seven Chebyshev points of the contact.
//!
//! The results are stored as `Pi0` and `Delta0` of the paraboloid that would have this load and this
//! penetration, so that a lookup takes the same time.

mod beginning;
mod even_powers;
mod ladder;
mod thick_films;
mod weights;

pub(crate) use self::even_powers::EvenPowers;
pub(super) use self::weights::{EvenShape, LARGEST_A_OVER_R};
