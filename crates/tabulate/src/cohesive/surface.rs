//! The surface of a film on its substrate, or of a stack of layers, as one type.

use crate::solve::compliance::Compliance;
use crate::solve::layered::LayeredCompliance;
use crate::solve::surface::{Sample, SurfaceCompliance};

/// The compliance of a film or of a stack.
#[derive(Clone, Debug)]
pub enum Surface {
    /// One film on its substrate.
    Film(Compliance),
    /// A stack of layers on its base.
    Layers(LayeredCompliance),
}

impl Surface {
    /// Returns `X(q) - 1`.
    pub fn excess(&self, q: f64) -> f64 {
        self.sample(q).excess
    }
}

impl SurfaceCompliance for Surface {
    const GROWTH: f64 = LayeredCompliance::GROWTH;

    fn sample(&self, q: f64) -> Sample {
        match self {
            Self::Film(film) => film.sample(q),
            Self::Layers(layers) => layers.sample(q),
        }
    }

    fn smallest_scale(&self) -> f64 {
        match self {
            Self::Film(film) => film.smallest_scale(),
            Self::Layers(layers) => layers.smallest_scale(),
        }
    }

    fn largest_excess(&self) -> f64 {
        match self {
            Self::Film(film) => film.largest_excess(),
            Self::Layers(layers) => layers.largest_excess(),
        }
    }
}
