//! The program `tabulate`, as its own crate builds it.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    tabulate::cli::run()
}
