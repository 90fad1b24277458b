//! The border between Rust and C: pointers are checked, panics are caught, errors leave a text.

use std::cell::RefCell;
use std::error::Error;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr;

thread_local! {
    /// Why the last call of this thread failed.
    static LAST: RefCell<CString> = RefCell::default();
}

/// The status that a function returns.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CcStatus {
    /// The results are written.
    Ok = 0,
    /// A pointer is null, or a number is not one of those that an enumeration has.
    Argument = 1,
    /// The contact cannot be computed: a value out of range, a table that cannot be read.
    Contact = 2,
    /// A fault of the library.
    Fault = 3,
}

/// A failed call: its status and its text.
pub(crate) struct Failure {
    status: CcStatus,
    text: String,
}

impl Failure {
    /// An argument that C got wrong.
    pub(crate) fn argument(text: impl Into<String>) -> Self {
        Self {
            status: CcStatus::Argument,
            text: text.into(),
        }
    }

    /// An error of the contact, with its sources.
    pub(crate) fn of(error: &dyn Error) -> Self {
        let mut text = error.to_string();
        let mut source = error.source();
        while let Some(error) = source {
            text = format!("{text}: {error}");
            source = error.source();
        }
        Self {
            status: CcStatus::Contact,
            text,
        }
    }
}

/// Runs the body of a function of C. An error or a panic becomes a status, and a text for this thread.
pub(crate) fn guarded(body: impl FnOnce() -> Result<(), Failure>) -> CcStatus {
    let outcome = catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|_| {
        Err(Failure {
            status: CcStatus::Fault,
            text: "a fault of the library: please report the arguments".into(),
        })
    });
    let Err(Failure { status, text }) = outcome else {
        return CcStatus::Ok;
    };
    let text = CString::new(text.replace('\0', " ")).unwrap_or_default();
    LAST.with(|last| last.replace(text));
    status
}

/// Returns why the last failed call of this thread failed, as UTF-8 that ends with a zero byte.
///
/// The text is valid until the next call of this thread fails. Before any failure it is empty.
#[unsafe(no_mangle)]
pub extern "C" fn cc_error() -> *const c_char {
    LAST.with(|last| last.borrow().as_ptr())
}

/// Returns what a pointer points at, unless it is null.
///
/// # Safety
/// The pointer is null, or points at a `T` that nobody changes for the time of `'a`.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T, name: &str) -> Result<&'a T, Failure> {
    // SAFETY: as stated above.
    unsafe { pointer.as_ref() }
        .ok_or_else(|| Failure::argument(format!("{name} is a null pointer: give an object")))
}

/// Returns the `count` numbers at a pointer, which may be null for none.
///
/// # Safety
/// The pointer is null, or points at `count` numbers that nobody changes for the time of `'a`.
pub(crate) unsafe fn numbers<'a>(
    pointer: *const f64,
    count: usize,
    name: &str,
) -> Result<&'a [f64], Failure> {
    check(pointer, count, name)?;
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: it is not null, as checked, and points at `count` numbers, as stated above.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Writes numbers to a pointer, which may be null for none.
///
/// # Safety
/// The pointer is null, or points at room for as many numbers, that nothing else uses meanwhile.
pub(crate) unsafe fn write(found: &[f64], pointer: *mut f64, name: &str) -> Result<(), Failure> {
    check(pointer, found.len(), name)?;
    // SAFETY: it is not null where there are numbers, as checked, and has room, as stated above.
    unsafe { ptr::copy(found.as_ptr(), pointer, found.len()) };
    Ok(())
}

/// Accepts a pointer to `count` numbers.
fn check(pointer: *const f64, count: usize, name: &str) -> Result<(), Failure> {
    let largest = isize::MAX as usize / size_of::<f64>();
    if count > largest {
        return Err(Failure::argument(format!(
            "{name} cannot have {count} numbers: at most {largest} fit in memory"
        )));
    }
    if pointer.is_null() && count > 0 {
        return Err(Failure::argument(format!(
            "{name} is a null pointer: give {count} numbers"
        )));
    }
    Ok(())
}

/// Puts an object on the heap, and its address where C asks for it.
///
/// # Safety
/// The pointer is null, or points at room for a pointer.
pub(crate) unsafe fn give<T>(object: T, to: *mut *mut T) -> Result<(), Failure> {
    if to.is_null() {
        return Err(Failure::argument(
            "the result is a null pointer: give the address of a pointer",
        ));
    }
    // SAFETY: it is not null, and has room for a pointer.
    unsafe { to.write(Box::into_raw(Box::new(object))) };
    Ok(())
}

/// Frees an object that [`give`] made; a null pointer is ignored.
///
/// # Safety
/// The pointer is null, or was made by [`give`] and has not been freed.
pub(crate) unsafe fn free<T>(object: *mut T) {
    if !object.is_null() {
        // SAFETY: as stated above. Dropping it cannot panic.
        drop(unsafe { Box::from_raw(object) });
    }
}
