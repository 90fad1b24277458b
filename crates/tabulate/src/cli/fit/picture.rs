//! The picture of a fit.

use std::path::{Path, PathBuf};

use ::fit::{Experiment, Fit};
use anyhow::Context;
use clap::Args;

use super::one_of;
use crate::cli::plot::{format, picture};
use crate::plot::fit::{figure, jkr_figure};
use crate::plot::line_speed;

/// The flags of the picture.
#[derive(Args)]
pub struct PictureArguments {
    /// Draw data, fit, residuals and the curve without the film: SVG or PNG by the ending
    #[arg(long, value_name = "FILE.svg|FILE.png", value_parser = picture)]
    plot: Option<PathBuf>,
    /// What --plot draws: the data as they were measured with their residuals, or the reduced JKR
    /// plot of loads at contact radii, load/(sqrt(6 pi) a^(3/2)) against a^(3/2)/(sqrt(pi) R), in
    /// which a contact without a film is a straight line; or, with a doubling-speed, the energy release rate over the speed of
    /// the contact line
    #[arg(long, value_name = "KIND", default_value = "data", requires = "plot", value_parser = one_of([
        ("data", PlotKind::Data),
        ("jkr", PlotKind::Jkr),
        ("speed", PlotKind::Speed),
    ]))]
    plot_kind: PlotKind,
}

/// What a picture of a fit shows.
#[derive(Clone, Copy, Debug)]
enum PlotKind {
    Data,
    Jkr,
    Speed,
}

impl PictureArguments {
    /// Returns the file of the picture.
    pub fn path(&self) -> Option<&Path> {
        self.plot.as_deref()
    }

    /// Draws the picture, if one is wanted.
    pub fn drawn(&self, fit: &Fit, experiments: &[Experiment]) -> anyhow::Result<Option<Vec<u8>>> {
        let Some(path) = self.path() else {
            return Ok(None);
        };
        let figure = match self.plot_kind {
            PlotKind::Data => figure(fit, experiments),
            PlotKind::Jkr => jkr_figure(fit, experiments).context("--plot-kind jkr")?,
            PlotKind::Speed => line_speed::figure(fit, experiments).context("--plot-kind speed")?,
        };
        Ok(Some(figure.picture()?.encode(format(path)?)?))
    }
}
