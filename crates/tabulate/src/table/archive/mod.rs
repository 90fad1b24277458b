//! The HDF5 file of a table. `interp::Table::open` reads it without a C library.
//!
//! `datasets` lays the table out in the file, with the C calls that `bindings` adds to the Rust
//! bindings.

mod bindings;
mod datasets;

pub(super) use self::datasets::fill;
