//! Tables from files.

use std::ffi::{CStr, c_char};
use std::fs::File;
use std::io::Read;

use interp::{Table, is_packed};

use crate::guard::{CcStatus, Failure, free, give, guarded};

/// A table of contacts.
pub struct CcTable(pub(crate) Table);

/// Reads a table, in HDF5 or packed, from the file of a `path` in UTF-8.
///
/// Free the table by `cc_table_free` after the last contact in it is made. A contact keeps no table.
///
/// # Safety
/// `path` is null or a text that ends with a zero byte; `table` is null or has room for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_table_read(path: *const c_char, table: *mut *mut CcTable) -> CcStatus {
    guarded(|| {
        if path.is_null() {
            return Err(Failure::argument("path is a null pointer: give a text"));
        }
        // SAFETY: it is not null, and ends with a zero byte.
        let path = unsafe { CStr::from_ptr(path) }.to_str();
        let path = path.map_err(|_| Failure::argument("path is not in UTF-8"))?;
        let mut head = [0; 8];
        let packed = File::open(path).and_then(|mut file| file.read_exact(&mut head));
        let read = if packed.is_ok() && is_packed(&head) {
            Table::read(path)
        } else {
            Table::open(path)
        };
        // SAFETY: `table` is as stated above.
        unsafe { give(CcTable(read?), table) }
    })
}

/// Frees a table. A null pointer is ignored.
///
/// # Safety
/// `table` is null, or comes from `cc_table_read` and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cc_table_free(table: *mut CcTable) {
    // SAFETY: as stated above.
    unsafe { free(table) };
}
