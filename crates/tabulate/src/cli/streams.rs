//! What every command writes: texts on standard output, notes on standard error, and examples in its help.

use std::io::{self, Write};

use super::output::Output;
use crate::printable;

/// The section of a help text that shows commands, one to a line.
macro_rules! examples {
    ($($line:literal),+ $(,)?) => {
        concat!("Examples, run at the root of the repository:", $("\n  ", $line),+)
    };
}
pub(crate) use examples;

/// The name of the program.
pub(super) const NAME: &str = "tabulate";

/// Prints a text on standard output.
pub(super) fn print(text: &[u8]) -> anyhow::Result<()> {
    Output::new(None, &[])?.write(text)
}

/// Writes a line to standard error if that is open: `eprintln` panics where it is closed.
pub(super) fn note(text: &str) {
    let _ = writeln!(io::stderr(), "{NAME}: {}", printable::lines(text));
}
