//! Many materials at one `a/t`, with all that they share.
//!
//! The Bessel values of one `a/t` serve every material, and the matrices of one (`a/t`, `nu1`,
//! `E0/E1`) serve every sphere. Where `E1/E2*` and `E0/E2*` are even grids with a common spacing,
//! the ratios `E0/E1` repeat along diagonals, and a grid of `n x n` materials has `2n - 1` pairs of
//! matrices only.

use interp::{Material, Quantities};
use rayon::prelude::*;

use crate::Error;
use crate::solve::compliance::Compliance;
use crate::solve::galerkin::{self, Abscissae, Block, Operator};
use crate::solve::quadrature::Panels;
use crate::solve::solve::prefers_axis;
use crate::solve::symbol::Symbol;

/// Materials, grouped by film and substrate.
pub(crate) struct Batch {
    materials: Vec<Material>,
    layers: Vec<Layer>,
}

/// One film on one substrate, with the indices of the materials that differ by the sphere only.
struct Layer {
    compliance: Compliance,
    members: Vec<usize>,
}

impl Batch {
    /// Groups materials by `nu1` and `E1/E0`. Ratios that differ by rounding count as equal.
    pub(crate) fn new(materials: Vec<Material>) -> Self {
        const ROUNDING: f64 = 1e-14;
        let key = |&i: &usize| (materials[i].nu1(), materials[i].film_over_substrate());
        let mut order: Vec<usize> = (0..materials.len()).collect();
        order.sort_by(|a, b| key(a).partial_cmp(&key(b)).expect("materials hold no NaN"));
        let same = |a: &usize, b: &usize| {
            let ((nu_a, ratio_a), (nu_b, ratio_b)) = (key(a), key(b));
            nu_a == nu_b && (ratio_a - ratio_b).abs() <= ROUNDING * ratio_a
        };
        let group = |members: &[usize]| Layer {
            compliance: Compliance::new(&materials[members[0]]),
            members: members.to_vec(),
        };
        let layers = order.chunk_by(same).map(group).collect();
        Self { materials, layers }
    }

    /// The materials, in the order in which they were given.
    pub(crate) fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Solves every material at `x = a/t`, on all cores, and returns the quantities in the order of
    /// the materials.
    ///
    /// Shared matrices are used where they reach `tolerance`; every other material is left to
    /// `alone`. `progress` is called with the number of materials finished since the last call,
    /// from any thread. The result does not depend on the number of threads.
    ///
    /// # Errors
    /// The first of those of `alone`, in the order of the groups.
    pub(crate) fn solve(
        &self,
        x: f64,
        tolerance: f64,
        alone: &(dyn Fn(&Material) -> Result<Quantities, Error> + Sync),
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<Quantities>, Error> {
        let shared = Shared::new(x, &self.layers, tolerance);
        let solved = self.layers.par_iter().map(|layer| {
            let solved = shared.solve(layer, &self.materials, alone)?;
            progress(solved.len());
            Ok(solved)
        });
        // In two steps: of several errors, the first one is returned.
        let solved: Vec<Result<Vec<Quantities>, Error>> = solved.collect();
        let mut quantities = vec![Quantities::from_array([f64::NAN; 4]); self.materials.len()];
        for (layer, solved) in self.layers.iter().zip(solved) {
            for (&member, solved) in layer.members.iter().zip(solved?) {
                quantities[member] = solved;
            }
        }
        Ok(quantities)
    }
}

/// What all materials share at one `a/t`.
struct Shared {
    x: f64,
    tolerance: f64,
    /// The Bessel values of Galerkin's method, as far as that is used.
    galerkin: Option<(Abscissae, Vec<Block>)>,
}

impl Shared {
    /// Up to this `a/t`, matrices that are shared cost less than a contour of one's own.
    const REACH: f64 = 60.0;

    fn new(x: f64, layers: &[Layer], tolerance: f64) -> Self {
        let galerkin = (x <= Self::REACH).then(|| {
            let smallest_scale = layers
                .iter()
                .map(|layer| layer.compliance.smallest_scale())
                .fold(1.0, f64::min);
            let panels = Panels::new(x, smallest_scale, tolerance);
            let abscissae = Abscissae::new(x, galerkin::modes(x, tolerance), panels);
            let blocks = abscissae.blocks().collect();
            (abscissae, blocks)
        });
        Self {
            x,
            tolerance,
            galerkin,
        }
    }

    /// The quantities of every member of a layer.
    fn solve(
        &self,
        layer: &Layer,
        materials: &[Material],
        alone: &(dyn Fn(&Material) -> Result<Quantities, Error> + Sync),
    ) -> Result<Vec<Quantities>, Error> {
        let members = layer.members.iter().map(|&member| &materials[member]);
        let mut operator = None;
        let solve_member = |material: &Material| {
            if let Some((abscissae, blocks)) = &self.galerkin
                && !layer.compliance.is_homogeneous()
                && !prefers_axis(self.x, &Symbol::new(material), self.tolerance)
            {
                let operator = operator.get_or_insert_with(|| {
                    Operator::assemble(&layer.compliance, abscissae, blocks)
                });
                if let Some(solved) = operator
                    .solve(material)
                    .filter(|solved| solved.error() <= self.tolerance)
                {
                    return Ok(solved.quantities);
                }
            }
            // Thin films, and the rare material that needs more modes or panels of its own.
            alone(material)
        };
        members.map(solve_member).collect()
    }
}
