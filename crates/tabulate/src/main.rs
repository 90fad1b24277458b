//! The command line program `tabulate`.

#![forbid(unsafe_code)]

fn main() {}
