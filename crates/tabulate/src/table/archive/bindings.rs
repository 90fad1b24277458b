//! Calls of the C library that the Rust bindings of HDF5 do not cover: groups without time stamps,
//! and dimension scales. The only `unsafe` code besides the C interface.
//!
//! The feature `hl` of `hdf5-sys` links the high-level library, which has the `H5DS` functions.

#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_int, c_uint};

use hdf5::{Dataset, File, Group, sync::sync};
use hdf5_sys::h5g::{H5Gclose, H5Gcreate2};
use hdf5_sys::h5i::hid_t;
use hdf5_sys::h5p::{
    H5P_CLS_GROUP_CREATE, H5P_DEFAULT, H5Pclose, H5Pcreate, H5Pset_obj_track_times,
};

unsafe extern "C" {
    fn H5DSset_scale(dataset: hid_t, name: *const c_char) -> c_int;
    fn H5DSattach_scale(dataset: hid_t, scale: hid_t, dimension: c_uint) -> c_int;
}

/// Creates a group without time stamps, so that equal tables are equal files.
pub fn create_group(file: &File, name: &str) -> hdf5::Result<Group> {
    let c_name = terminated(name)?;
    // SAFETY: the file outlives the calls and so keeps its identifier valid; `c_name` is
    // NUL-terminated and only read; every identifier that is made here is closed here, also after a
    // failure, where closing an invalid one is refused harmlessly; `sync` holds the library's lock.
    let status = sync(|| unsafe {
        let properties = H5Pcreate(*H5P_CLS_GROUP_CREATE);
        let set = H5Pset_obj_track_times(properties, 0);
        let group = H5Gcreate2(
            file.id(),
            c_name.as_ptr(),
            H5P_DEFAULT,
            properties,
            H5P_DEFAULT,
        );
        H5Pclose(properties);
        let closed = H5Gclose(group);
        set.min(closed)
    });
    check(status, "H5Gcreate2")?;
    file.group(name)
}

/// Makes the one-dimensional dataset `axis` a dimension scale called `name`.
pub fn make_scale(axis: &Dataset, name: &str) -> hdf5::Result<()> {
    let name = terminated(name)?;
    // SAFETY: the dataset outlives the call and so keeps its identifier valid; `name` is
    // NUL-terminated and only read; `sync` holds the library's lock.
    check(
        sync(|| unsafe { H5DSset_scale(axis.id(), name.as_ptr()) }),
        "H5DSset_scale",
    )
}

/// Attaches the scale `axis` to one dimension of the dataset `values`.
pub fn attach_scale(values: &Dataset, axis: &Dataset, dimension: u8) -> hdf5::Result<()> {
    // SAFETY: both datasets outlive the call and so keep their identifiers valid; `sync` holds the
    // library's lock.
    check(
        sync(|| unsafe { H5DSattach_scale(values.id(), axis.id(), c_uint::from(dimension)) }),
        "H5DSattach_scale",
    )
}

fn check(status: c_int, function: &str) -> hdf5::Result<()> {
    if status < 0 {
        Err(format!("{function} failed").into())
    } else {
        Ok(())
    }
}

fn terminated(name: &str) -> hdf5::Result<CString> {
    CString::new(name).map_err(|e| e.to_string().into())
}
