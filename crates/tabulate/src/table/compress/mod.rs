//! The low-rank form of a finished table, small enough to embed.
//!
//! `tiles` divides a table, `coefficients` expands the logarithms of each part in polynomials, and
//! `truncation` compresses the coefficients into a tensor train of integers. `low_rank` tries
//! truncations until the form, compared with direct solves, keeps its tolerance.

mod coefficients;
mod low_rank;
mod matrices;
mod tiles;
mod truncation;

pub use low_rank::low_rank;
pub use tiles::compress;
