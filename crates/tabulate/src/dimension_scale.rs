//! HDF5 dimension scales, by the C library's own functions: the one place with `unsafe`.
//!
//! The Rust bindings do not cover `H5DS`; the library is linked through `hdf5-sys` with its feature `hl`.

#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_int, c_uint};

use hdf5::{Dataset, sync::sync};
use hdf5_sys::h5i::hid_t;

unsafe extern "C" {
    fn H5DSset_scale(dataset: hid_t, name: *const c_char) -> c_int;
    fn H5DSattach_scale(dataset: hid_t, scale: hid_t, dimension: c_uint) -> c_int;
}

/// Makes a one-dimensional dataset a dimension scale of the given name.
pub fn make_scale(axis: &Dataset, name: &str) -> hdf5::Result<()> {
    let name = CString::new(name).map_err(|e| hdf5::Error::from(e.to_string()))?;
    // SAFETY: the dataset outlives the call and so keeps its identifier valid; `name` is NUL-terminated and only read; `sync` holds the
    // library's lock.
    check(sync(|| unsafe { H5DSset_scale(axis.id(), name.as_ptr()) }), "H5DSset_scale")
}

/// Attaches a scale to one dimension of a dataset.
pub fn attach_scale(values: &Dataset, axis: &Dataset, dimension: u8) -> hdf5::Result<()> {
    // SAFETY: both datasets outlive the call and so keep their identifiers valid; `sync` holds the library's lock.
    check(sync(|| unsafe { H5DSattach_scale(values.id(), axis.id(), c_uint::from(dimension)) }), "H5DSattach_scale")
}

fn check(status: c_int, function: &str) -> hdf5::Result<()> {
    if status < 0 { Err(format!("{function} failed").into()) } else { Ok(()) }
}
