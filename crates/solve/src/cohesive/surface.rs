//! The surface of a film on its substrate, or of a stack of layers, as one type.

use crate::compliance::Compliance;
use crate::layered::LayeredCompliance;
use crate::surface::{AllSamples, SurfaceCompliance};

/// The compliance of a film or of a stack.
#[derive(Clone, Debug)]
pub enum Surface {
    /// One film on its substrate.
    Film(Compliance),
    /// A stack of layers on its base.
    Layers(LayeredCompliance),
}

impl Surface {
    /// Returns `X(q) - 1` at all `q`.
    pub fn excesses(&self, q: &[f64]) -> Vec<f64> {
        self.sample_all(q).excess
    }

    fn get(&self) -> &dyn SurfaceCompliance {
        match self {
            Self::Film(film) => film,
            Self::Layers(layers) => layers,
        }
    }
}

impl SurfaceCompliance for Surface {
    /// The number for layers serves films, too.
    fn points(tolerance: f64, oscillates: bool) -> usize {
        LayeredCompliance::points(tolerance, oscillates)
    }

    fn sample_all(&self, q: &[f64]) -> AllSamples {
        self.get().sample_all(q)
    }

    fn smallest_scale(&self) -> f64 {
        self.get().smallest_scale()
    }

    fn largest_excess(&self) -> f64 {
        self.get().largest_excess()
    }
}
