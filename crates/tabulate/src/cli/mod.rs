//! The command line: one module for each subcommand.
//!
//! `command` lists them. Each has `Arguments`, which clap fills and whose comments are the help, and `run`. A table is
//! named by a `table_name`, or is the `default_table`; points come from CSV (`points`); the
//! `bodies` in contact are a `system` under a `probe`, or a stack of layers from TOML
//! (`stack_file`); results go to an `output`, which knows the inputs, or are printed, as text or as
//! one object of `json`; notes go to standard error.

mod advice;
mod allow;
mod bodies;
mod check;
mod command;
#[cfg(feature = "figures")]
mod command_line;
mod completions;
#[cfg(feature = "figures")]
mod cost;
mod curve;
#[cfg(feature = "figures")]
mod default_table;
#[cfg(feature = "figures")]
mod fit;
mod friction;
mod generate;
mod heading;
mod history;
mod info;
mod interface;
mod json;
mod man;
mod output;
#[cfg(feature = "compress")]
mod pack;
mod plan;
#[cfg(feature = "figures")]
mod plot;
mod points;
mod probe;
mod progress;
mod pull_off;
mod quantity;
mod query;
#[cfg(feature = "figures")]
mod report;
#[cfg(feature = "figures")]
mod simulate;
#[cfg(feature = "figures")]
mod sized_probe;
mod solve;
mod stack_file;
mod streams;
mod system;
mod table_name;
mod unpack;

pub use self::command::run;
use self::streams::{NAME, examples, note, print};
