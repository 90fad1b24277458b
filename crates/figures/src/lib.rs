//! Charts as SVG and PNG with an embedded font, and the interactive page about a table. Everything is made from plain numbers and
//! texts: nothing here knows mechanics.
//!
//! A figure is described as panels of [`chart`], with the axes of [`axis`]. `draw` draws the panels: `clip` cuts their lines,
//! `labels` finds places for their labels, and [`picture`] turns the drawing into the bytes of a file. [`page`] makes the page.

#![forbid(unsafe_code)]

pub mod axis;
pub mod chart;
mod clip;
mod draw;
mod error;
mod labels;
pub mod page;
pub mod picture;

pub use error::Error;
