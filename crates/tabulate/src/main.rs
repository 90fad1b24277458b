//! The command line program `tabulate`.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    tabulate::cli::run()
}
