//! The border between Rust and C: null pointers are refused, panics are caught, errors leave a text.

use std::cell::RefCell;
use std::error::Error;
use std::ffi::{CString, c_char};
use std::iter::successors;
use std::panic::{AssertUnwindSafe, catch_unwind};

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
pub(crate) struct Failure(CcStatus, String);

impl Failure {
    /// An argument that C got wrong.
    pub(crate) fn argument(text: impl Into<String>) -> Self {
        Self(CcStatus::Argument, text.into())
    }

    /// The same failure with what it is about.
    pub(crate) fn of(self, what: &str) -> Self {
        Self(self.0, format!("{what}: {}", self.1))
    }
}

impl From<interp::Error> for Failure {
    /// An error of the table or of the system.
    fn from(error: interp::Error) -> Self {
        contact::Error::from(error).into()
    }
}

impl From<contact::Error> for Failure {
    /// An error of the contact, with its sources.
    fn from(error: contact::Error) -> Self {
        let chain = successors(Some(&error as &dyn Error), |&error| error.source());
        let texts: Vec<String> = chain.map(ToString::to_string).collect();
        Self(CcStatus::Contact, texts.join(": "))
    }
}

/// Runs the body of a function of C. An error or a panic becomes a status, and a text for this thread.
pub(crate) fn guarded(body: impl FnOnce() -> Result<(), Failure>) -> CcStatus {
    let outcome = catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|_| {
        let text = "a fault of the library: please report the arguments";
        Err(Failure(CcStatus::Fault, text.into()))
    });
    let Err(Failure(status, text)) = outcome else {
        return CcStatus::Ok;
    };
    let text = CString::new(text.replace('\0', " ")).unwrap_or_default();
    LAST.set(text);
    status
}

/// Returns why the last failed call of this thread failed, as UTF-8 that ends with a zero byte.
///
/// The text is valid until the next call of this thread fails. Before any failure it is empty.
#[unsafe(no_mangle)]
pub extern "C" fn cc_error() -> *const c_char {
    LAST.with_borrow(|last| last.as_ptr())
}

/// Returns what a pointer points at, unless it is null.
pub(crate) fn given<T>(pointer: Option<T>, name: &str) -> Result<T, Failure> {
    pointer.ok_or_else(|| Failure::argument(format!("{name} is a null pointer: give its address")))
}

/// Refuses a null pointer to an array, unless the array is empty, and a count that no array has.
pub(crate) fn array(pointer: *const f64, count: usize, name: &str) -> Result<(), Failure> {
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
