//! One solve: the error asked for against the error achieved and the time it takes, beside the solver that people would write.

use serde::{Deserialize, Serialize};

/// One solve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The contact's name.
    pub contact: String,
}

/// Measures all rows, in order.
pub fn measure() -> Vec<Row> {
    Vec::new()
}

/// The rows in short, as Markdown.
pub fn markdown(_rows: &[Row]) -> String {
    String::new()
}
