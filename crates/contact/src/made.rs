//! Values that are made at their first use, and may fail to be made.

use std::sync::OnceLock;

/// Returns the value of a cell, which `make` makes at the first use.
///
/// Several threads may make it at a time: `make` must return the same value in each of them.
pub(crate) fn made<T, E>(cell: &OnceLock<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if let Some(value) = cell.get() {
        return Ok(value);
    }
    let value = make()?;
    Ok(cell.get_or_init(|| value))
}
