//! The error of a picture that cannot be drawn.

use plotters::drawing::DrawingAreaErrorKind;

/// A picture that cannot be drawn, with the reason.
#[derive(Debug, thiserror::Error)]
#[error("cannot draw: {0}")]
pub struct Error(pub String);

impl<E: std::error::Error + Send + Sync> From<DrawingAreaErrorKind<E>> for Error {
    fn from(error: DrawingAreaErrorKind<E>) -> Self {
        Self(error.to_string())
    }
}
