//! Figures, as SVG or PNG, with the font in the program.
//!
//! [`chart`] draws panels with axes, lines and labels, [`picture`] writes them. Each figure is a
//! module of its own, with the data that it draws apart from the drawing.

pub mod axis;
pub mod chart;
pub mod effects;
pub mod error_map;
pub mod fig2;
pub mod fig3;
pub mod fig4;
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
