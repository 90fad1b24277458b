//! The table: quantities at nodes of four parameters, its files, and the lookup of the curve of one
//! material.
//!
//! A [`Table`] holds `axes`, a `description` with its `certificate`, and values or `tiles`, whose trains
//! of small integers are those of the crate `low_rank`. Their first lookup may need as much as `demand`
//! allows. `packed` and `hdf5` read a table from files ([`schema`] has the names of the parts;
//! `hdf5_source` limits what a forged file can make `hdf5` do, and `hdf5_chunks` reads the numbers;
//! `stored_tiles` keeps the integers of a packed table in code until they are needed), `embedded` from
//! the program. For the first lookup it becomes a `tensor_spline`, dense or of tiles. `lookup` makes the
//! [`Curve`](crate::Curve) of a material from it, with the help of `incompressible` for its
//! derivatives.

mod axes;
mod certificate;
mod demand;
mod description;
#[cfg(feature = "embedded")]
mod embedded;
#[cfg(feature = "hdf5")]
mod hdf5;
#[cfg(feature = "hdf5")]
mod hdf5_chunks;
#[cfg(feature = "hdf5")]
mod hdf5_source;
mod incompressible;
mod lookup;
mod packed;
pub mod schema;
mod stored_tiles;
mod table;
mod tensor_spline;
mod tiles;

pub use certificate::Certificate;
pub use description::Description;
pub use packed::is_packed;
pub use table::Table;
pub use tiles::Tile;
