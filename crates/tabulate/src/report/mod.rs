//! The page about a table, with its texts and numbers from the table.
//!
//! [`report`] collects what the page of the crate `figures` shows: the range of the table, its
//! certificate (the largest error at sampled points), the figures of [`figures()`], and the numbers
//! with which the page computes. `numbers` takes these from the table, and `settings` says what
//! the user of the page can set, `symbols` writes parameters.

mod contents;
mod illustrations;
mod numbers;
mod settings;
mod symbols;

pub use self::contents::report;
pub use illustrations::{figures, steps};
pub use numbers::{Coarse, coarse};
