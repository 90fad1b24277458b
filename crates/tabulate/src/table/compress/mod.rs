//! The low-rank form of a finished table, small enough to embed.
//!
//! `tiles` divides a table, and `truncation` compresses the logarithms of each part into a tensor
//! train. `low_rank` tries truncations until the form, compared with direct solves, keeps its
//! tolerance.

mod low_rank;
mod tiles;
mod truncation;

pub use low_rank::low_rank;
pub use tiles::compress;
