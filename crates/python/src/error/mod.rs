//! Python's exceptions for the errors of the Rust crates.
//!
//! The classes are Python's own, in `coated_contact._errors`, so that they are documented and
//! annotated there. Files that cannot be read are `OSError`s. `classes` chooses the class of each error.

mod classes;
mod error;

pub use self::error::{Failure, OrRaise, other_stack, unknown, with_identifiers};
