//! The command line program, its figures, and what it measures of its own cost.

#![forbid(unsafe_code)]

mod cost;
mod cost_effects;
mod cost_lookup;
mod cost_solve;
mod cost_table;
mod plot;
mod readme;
mod subcommands;
