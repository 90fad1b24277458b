//! The HTML report, in a browser where there is one.

#![forbid(unsafe_code)]

mod page;
