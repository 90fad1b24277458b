//! Generations that are killed, interrupted, or short of space or time.

#![forbid(unsafe_code)]
#![cfg(unix)]

mod disks;
mod generation;
mod journal;
mod kept;
