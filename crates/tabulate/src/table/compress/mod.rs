//! The low-rank form of a finished table, small enough to embed.
//!
//! `tiles` divides a table, and has each part compressed into a tensor train of integers by the crate
//! `low_rank`. `packing` tries errors of compression until the form, compared with direct solves,
//! keeps its tolerance.

mod packing;
mod tiles;

pub use packing::low_rank;
pub use tiles::compress;
