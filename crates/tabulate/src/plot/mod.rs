//! Draws figures as SVG or PNG, with the font in the program.
//!
//! Each figure is a module of its own: `data` computes its data and `figure` describes it as panels
//! of [`chart`], with the axes of [`axis`]. `draw` draws the panels: `clip` cuts their lines, and
//! `labels` finds places for their labels. [`picture`] turns the drawing into the bytes of a file.
//! [`paper`] holds the system that several figures show.

pub mod axis;
pub mod chart;
mod clip;
mod draw;
pub mod effects;
pub mod error_map;
pub mod fig2;
pub mod fig3;
pub mod fig4;
pub mod fit;
pub mod force_displacement;
mod labels;
pub mod lookup_cost;
pub mod paper;
pub mod picture;
pub mod table_cost;
pub mod work_precision;

use plotters::drawing::DrawingAreaErrorKind;

use crate::Error;

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for Error {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self::Picture(error.to_string())
    }
}
