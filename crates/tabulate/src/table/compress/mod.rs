//! The low-rank form of a finished table, small enough to embed.
//!
//! `truncation` cuts the logarithms of a table down to a tensor train; `end_slope` watches their
//! derivatives at `nu1 = 0.5` meanwhile. `compress` tries truncations until the form, compared with
//! direct solves, keeps its tolerance.

mod compress;
mod end_slope;
mod truncation;

pub use compress::low_rank;
pub use truncation::compress;
