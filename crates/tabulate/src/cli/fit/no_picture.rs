//! The flags of a picture in a program that draws none.

use std::path::Path;

use ::fit::{Experiment, Fit};
use clap::Args;

/// No flags.
#[derive(Args)]
pub struct PictureArguments {}

#[expect(
    clippy::unused_self,
    reason = "the methods are called as those of the arguments with a picture"
)]
impl PictureArguments {
    /// Returns no file.
    pub const fn path(&self) -> Option<&Path> {
        None
    }

    /// Draws nothing.
    #[expect(
        clippy::unnecessary_wraps,
        reason = "a program with figures may fail here"
    )]
    pub const fn drawn(&self, _: &Fit, _: &[Experiment]) -> anyhow::Result<Option<Vec<u8>>> {
        Ok(None)
    }
}
