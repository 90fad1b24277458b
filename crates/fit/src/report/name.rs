//! The names of estimates, in a column.

use crate::Estimate;

/// The width of the names of parameters.
pub(super) const NAME: usize = 25;

/// Returns the name of an estimate, with its file if it is one file's own of several.
pub(super) fn name(estimate: &Estimate, files: &[&str]) -> String {
    match estimate.experiment {
        Some(i) if files.len() > 1 => format!("{} ({})", estimate.parameter, files[i]),
        _ => estimate.parameter.to_string(),
    }
}
