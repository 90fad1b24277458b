//! The table: quantities at nodes of four parameters, its files, and the lookup of the curve of one
//! material.
//!
//! A [`Table`] holds `axes`, a `description` with its `certificate`, and values or `tiles` in
//! `low_rank` form, made of the polynomials of `chebyshev`. Their first lookup may need as much as
//! `demand` allows. `packed` and `hdf5` read it from
//! files ([`schema`] has the names of the parts; `hdf5_source` limits what a forged file can make
//! `hdf5` do, and `hdf5_chunks` reads the numbers; `entropy` codes the integers of packed low-rank
//! forms, which `stored_tiles` keeps until they are needed), `embedded` from the program. For the first lookup
//! it becomes a `tensor_spline`, either dense or a `tensor_train`; their sums are those of
//! `weighted_sum` and of `mixed_precision` (with `blocks`, the rows in one precision, and
//! `vectors`). `lookup` makes the [`Curve`](crate::Curve) of a material
//! from it, with the help of `incompressible` for its derivatives.

mod axes;
mod blocks;
mod certificate;
pub mod chebyshev;
mod demand;
mod description;
#[cfg(feature = "embedded")]
mod embedded;
mod entropy;
#[cfg(feature = "hdf5")]
mod hdf5;
#[cfg(feature = "hdf5")]
mod hdf5_chunks;
#[cfg(feature = "hdf5")]
mod hdf5_source;
mod incompressible;
mod lookup;
mod low_rank;
mod mixed_precision;
mod packed;
pub mod schema;
mod stored_tiles;
mod table;
mod tensor_spline;
mod tensor_train;
mod tiles;
mod vectors;
mod weighted_sum;

pub use certificate::Certificate;
pub use description::Description;
pub use low_rank::LowRank;
pub use packed::is_packed;
pub use table::Table;
pub use tiles::Tile;
