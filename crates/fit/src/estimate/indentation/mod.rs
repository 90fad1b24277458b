//! Fits of contact stiffness: where they start, and the doubts about their results.

mod start;
mod warnings;

pub(super) use start::give;
pub(super) use warnings::add;
