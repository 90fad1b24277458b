//! The low-rank form of a finished table, small enough to embed.
//!
//! `truncation` compresses the logarithms of a table into a tensor train. `low_rank` tries
//! truncations until the form, compared with direct solves, keeps its tolerance.

mod low_rank;
mod truncation;

pub use low_rank::low_rank;
pub use truncation::compress;
