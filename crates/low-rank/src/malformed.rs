//! The error of a train whose parts contradict each other.

use thiserror::Error;

/// The parts of a train contradict each other or are out of bounds: the text says which and how.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Malformed(pub String);
