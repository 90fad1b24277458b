//! Writes the HDF5 file of a table. `interp::Table::open` reads it without a C library.
//!
//! `datasets` lays the table out in the file, with the C calls that `bindings` adds to the Rust
//! bindings. Both need the feature `hdf5`. Without it every function here returns an error.

#[cfg(feature = "hdf5")]
mod bindings;
#[cfg(feature = "hdf5")]
mod datasets;
mod writing;

pub(crate) use self::writing::check;
pub use self::writing::{WRITES_HDF5, write};
