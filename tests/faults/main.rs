//! Generations that are killed, interrupted or starved of space and time.

#![forbid(unsafe_code)]
#![cfg(unix)]

mod generation;
