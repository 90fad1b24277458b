//! The abscissae of Galerkin's method and the Bessel values there, which do not depend on the
//! material.

use std::f64::consts::FRAC_2_PI;
use std::ops::Range;

use crate::compliance::surface::SurfaceCompliance;
use crate::galerkin::bessel::{EvenBessel, LANES};
use crate::galerkin::quadrature::Panels;

/// The number of abscissae handled at once: the Bessel values of a block stay in the processor's
/// cache.
const BLOCK: usize = 512;

/// The root of 5.
pub const SQRT_5: f64 = 2.236_067_977_499_79;

/// The abscissae and weights for one `a/t`, and the number of modes. They do not depend on the
/// material.
#[derive(Clone, Debug)]
pub struct Abscissae {
    /// `a/t`.
    pub x: f64,
    /// The number of modes.
    pub modes: usize,
    /// The panels.
    pub panels: Panels,
    /// `q`, panel by panel, padded to a multiple of [`LANES`].
    pub q: Vec<f64>,
    /// The weight `(2/pi) x w` of every abscissa, zero for the padding.
    pub weights: Vec<f64>,
}

/// The waves that are longer than the contact: the panels below `z = 1`.
///
/// `M_00 + C_00 = (2/pi) int (q )' J_0^2 dz`. Long waves of a stiff film on a soft base make
/// `X` huge and move the contact as a whole: they cancel in this sum, which is therefore integrated
/// by parts there, with `z (J_0^2)' = -2/3 z^2 J_0 (J_0 - J_1/sqrt5)`.
#[derive(Clone, Copy, Debug)]
pub struct LongWaves {
    /// The upper end in `q`.
    end: f64,
    /// The number of abscissae.
    count: usize,
}

impl LongWaves {
    /// Returns the boundary term `(2/pi) z J_0^2` at the upper end.
    pub fn boundary(&self, x: f64, compliance: &dyn SurfaceCompliance) -> f64 {
        let z = x * self.end;
        // `z J_0^2 = sin^2 z/z`, and 0 at 0.
        if z == 0.0 {
            return 0.0;
        }
        FRAC_2_PI * compliance.sample(self.end).excess * z.sin().powi(2) / z
    }
}

/// The Bessel values at all abscissae, and what follows from them.
#[derive(Clone, Debug)]
pub struct BesselValues {
    modes: usize,
    /// Block after block. They are one piece of memory, so that the allocator keeps it from one
    /// contact to the next.
    values: Vec<f64>,
    /// The factors of `X - 1` and of `q X'` in `M_00 + C_00`.
    pub translation: [Vec<f64>; 2],
}

/// The Bessel values at up to [`BLOCK`] consecutive abscissae.
#[derive(Clone, Copy, Debug)]
pub struct Block<'a> {
    /// Index of the first abscissa.
    pub first: usize,
    /// The number of abscissae.
    pub rows: usize,
    /// `rows x modes`, one column after the other.
    pub values: &'a [f64],
}

impl Block<'_> {
    /// Returns the indices of the abscissae.
    pub fn range(&self) -> Range<usize> {
        self.first..self.first + self.rows
    }
}

impl BesselValues {
    /// Returns the blocks.
    pub fn blocks(&self) -> impl Iterator<Item = Block<'_>> {
        self.values
            .chunks(BLOCK * self.modes)
            .enumerate()
            .map(|(i, values)| Block {
                first: i * BLOCK,
                rows: values.len() / self.modes,
                values,
            })
    }
}

impl Abscissae {
    /// Places abscissae on `panels`, for `modes` modes at `x = a/t`.
    pub fn new(x: f64, modes: usize, panels: Panels) -> Self {
        let count = (panels.edges.len() - 1) * panels.rule.abscissae.len();
        let [mut q, mut weights] = [0; 2].map(|_| Vec::with_capacity(count + LANES));
        for ends in panels.edges.windows(2) {
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            q.extend(panels.rule.abscissae.iter().map(|t| middle + half * t));
            weights.extend(panels.rule.weights.iter().map(|w| FRAC_2_PI * x * half * w));
        }
        let padded = q.len().next_multiple_of(LANES);
        q.resize(padded, q[q.len() - 1]);
        weights.resize(padded, 0.0);
        Self {
            x,
            modes,
            panels,
            q,
            weights,
        }
    }

    /// Returns the panels below `z = 1`.
    pub fn long_waves(&self) -> LongWaves {
        let edges = &self.panels.edges;
        let panels = edges.partition_point(|edge| edge * self.x <= 1.0) - 1;
        LongWaves {
            end: edges[panels],
            count: panels * self.panels.rule.abscissae.len(),
        }
    }

    /// Evaluates the Bessel functions.
    pub fn bessel_values(&self) -> BesselValues {
        let bessel = EvenBessel::new(self.modes);
        let mut values = vec![0.0; self.q.len() * self.modes];
        for (q, values) in self
            .q
            .chunks(BLOCK)
            .zip(values.chunks_mut(BLOCK * self.modes))
        {
            for (j, group) in q.chunks_exact(LANES).enumerate() {
                let z = std::array::from_fn(|l| group[l] * self.x);
                bessel.fill(&z, values, q.len(), j * LANES);
            }
        }
        let mut bessel = BesselValues {
            modes: self.modes,
            values,
            translation: [Vec::new(), Vec::new()],
        };
        bessel.translation = self.translation(&bessel);
        bessel
    }

    /// Returns the factors of `X - 1` and of `q X'` in `M_00 + C_00`, see [`LongWaves`].
    fn translation(&self, bessel: &BesselValues) -> [Vec<f64>; 2] {
        let long = self.long_waves().count;
        let [mut of_excess, mut of_slope] = [0; 2].map(|_| Vec::with_capacity(self.q.len()));
        for block in bessel.blocks() {
            let (j0, rest) = block.values.split_at(block.rows);
            for ((i, j0), j1) in block.range().zip(j0).zip(rest) {
                let z = self.q[i] * self.x;
                let [excess, slope] = if i < long {
                    [2.0 / 3.0 * z * z * j0 * (j0 - j1 / SQRT_5), 0.0]
                } else {
                    [j0 * j0; 2]
                };
                of_excess.push(excess);
                of_slope.push(slope);
            }
        }
        [of_excess, of_slope]
    }
}
