//! The low-rank form of a finished table, small enough to embed.
//!
//! `truncation` compresses the logarithms of a table into a tensor train. Meanwhile `end_slope`
//! measures the error of their derivatives at `nu1 = 0.5`. `low_rank` tries truncations until the
//! form, compared with direct solves, keeps its tolerance.

mod end_slope;
mod low_rank;
mod truncation;

pub use low_rank::low_rank;
pub use truncation::{compress, compress_with_derivatives};
