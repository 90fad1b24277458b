//! The solve over all nodes of a scene, on all cores.
//!
//! Work is shared as far as it reaches: the Bessel values of one `a/t` serve every material, and the matrices of one (`a/t`, `nu1`,
//! `E0/E1`) serve every sphere. Where the nodes of `E1/E2` and `E0/E2` are even and have a common spacing, the ratios `E0/E1`
//! repeat along diagonals, and a grid of `n x n` materials has `2n - 1` pairs of matrices only. Thin films are solved one by one,
//! on contours that all contacts share.

use interp::{Material, Quantities};
use rayon::prelude::*;

use crate::Error;
use crate::answer::Wanted;
use crate::compliance::Compliance;
use crate::galerkin::{self, Abscissae, Block, Operator};
use crate::quadrature::Panels;
use crate::scene::Scene;
use crate::solve::{TOLERANCE, prefers_axis, solve_wanted};
use crate::symbol::Symbol;

/// The relative tolerance of the solves behind a table: a hundredth of the table's, too little to show in its error.
pub fn solve_tolerance(table_tolerance: f64) -> f64 {
    (0.01 * table_tolerance).clamp(TOLERANCE[0], 1e-6)
}

/// Solves one contact as accurately as a table of the given tolerance needs it: to a hundredth of that, or, in the corners where
/// double precision does not allow this, to a fifth.
///
/// # Errors
/// Those of [`solve`](crate::solve::solve).
pub(crate) fn solve_for_table(
    a_over_t: f64,
    material: &Material,
    table_tolerance: f64,
    wanted: Wanted,
) -> Result<Quantities, Error> {
    let solve = |tolerance| solve_wanted(a_over_t, material, tolerance, wanted);
    Ok(solve(solve_tolerance(table_tolerance)).or_else(|_| solve((0.2 * table_tolerance).min(TOLERANCE[1])))?.quantities)
}

/// The values of each quantity asked for, row-major with `a_over_t` slowest.
pub type Values = [Option<Vec<f64>>; 4];

/// Solves every node of the scene on the given axes.
///
/// `progress` is called with the number of points finished since the last call, from any thread. The result does not depend on the
/// number of threads.
///
/// # Errors
/// [`Error::NotConverged`] with the point where double precision does not allow the tolerance.
pub fn sweep(scene: &Scene, axes: &[Vec<f64>; 4], progress: &(dyn Fn(usize) + Sync)) -> Result<Values, Error> {
    let sweep = Sweep::new(scene, axes)?;
    let mut values = sweep.blank();
    for piece in 0..sweep.pieces() {
        sweep.place(&mut values, piece, &sweep.solve(piece, progress)?);
    }
    Ok(values)
}

/// The nodes of a scene, to be solved piece by piece. A piece is everything at one `a_over_t`.
pub struct Sweep<'a> {
    scene: &'a Scene,
    a_over_t: &'a [f64],
    materials: Vec<Material>,
    layers: Vec<Layer>,
}

impl<'a> Sweep<'a> {
    /// Groups the materials of the scene on the given axes.
    ///
    /// # Errors
    /// [`Error::Table`] for axes that are not the scene's.
    pub fn new(scene: &'a Scene, [a_over_t, e1, nu1, e0]: &'a [Vec<f64>; 4]) -> Result<Self, Error> {
        let mut materials = Vec::with_capacity(e1.len() * nu1.len() * e0.len());
        for &e1 in e1 {
            for &nu1 in nu1 {
                for &e0 in e0 {
                    materials.push(scene.material([e1, nu1, e0])?);
                }
            }
        }
        let layers = layers(&materials);
        Ok(Self { scene, a_over_t, materials, layers })
    }

    /// The number of pieces.
    pub fn pieces(&self) -> usize {
        self.a_over_t.len()
    }

    /// The number of points in a piece.
    pub fn points(&self) -> usize {
        self.materials.len()
    }

    /// The number of values in a piece: one for each point and quantity.
    pub fn values(&self) -> usize {
        self.points() * self.scene.quantities.len()
    }

    /// Room for the values of the whole table.
    pub fn blank(&self) -> Values {
        let mut values = [const { None }; 4];
        for &quantity in &self.scene.quantities {
            values[quantity as usize] = Some(vec![0.0; self.pieces() * self.points()]);
        }
        values
    }

    /// Puts the values of a piece in their place.
    pub fn place(&self, values: &mut Values, piece: usize, solved: &[f64]) {
        let points = self.points();
        for (values, solved) in values.iter_mut().flatten().zip(solved.chunks_exact(points)) {
            values[piece * points..][..points].copy_from_slice(solved);
        }
    }

    /// Puts the logarithms of a piece, which a table splines, in their place: that of [`interp::Table::from_logarithms`].
    pub fn place_logarithms(&self, logarithms: &mut [f64], piece: usize, solved: &[f64]) {
        let held = self.scene.quantities.len();
        let rows = logarithms.chunks_exact_mut(held * self.pieces());
        for (member, (row, material)) in rows.zip(&self.materials).enumerate() {
            let es = material.sphere_film_modulus();
            for (i, &quantity) in self.scene.quantities.iter().enumerate() {
                row[held * piece + i] = quantity.logarithm(solved[i * self.points() + member], es);
            }
        }
    }

    /// Solves a piece: the values of every material, one quantity that was asked for after the other. See [`sweep`].
    ///
    /// # Errors
    /// Those of [`sweep`].
    pub fn solve(&self, piece: usize, progress: &(dyn Fn(usize) + Sync)) -> Result<Vec<f64>, Error> {
        let shared = Shared::new(self.a_over_t[piece], &self.layers, self.scene);
        let solved = self.layers.par_iter().map(|layer| {
            let solved = shared.solve(layer, &self.materials)?;
            progress(solved.len());
            Ok(solved)
        });
        // In two steps: of several errors, the first one is returned.
        let solved: Vec<Result<Vec<[f64; 4]>, Error>> = solved.collect();
        let mut values = vec![0.0; self.values()];
        for (layer, solved) in self.layers.iter().zip(solved) {
            for (&member, solved) in layer.members.iter().zip(solved?) {
                for (i, &quantity) in self.scene.quantities.iter().enumerate() {
                    values[i * self.points() + member] = solved[quantity as usize];
                }
            }
        }
        Ok(values)
    }
}

/// One film on one substrate, with the indices of the materials that differ by the sphere only.
struct Layer {
    compliance: Compliance,
    members: Vec<usize>,
}

/// Groups the materials by `nu1` and `E1/E0`. Ratios that differ by rounding count as equal.
fn layers(materials: &[Material]) -> Vec<Layer> {
    const ROUNDING: f64 = 1e-14;
    let key = |&i: &usize| (materials[i].nu1(), materials[i].film_over_substrate());
    let mut order: Vec<usize> = (0..materials.len()).collect();
    order.sort_by(|a, b| key(a).partial_cmp(&key(b)).expect("materials hold no NaN"));
    let same = |a: &usize, b: &usize| {
        let ((nu_a, ratio_a), (nu_b, ratio_b)) = (key(a), key(b));
        nu_a == nu_b && (ratio_a - ratio_b).abs() <= ROUNDING * ratio_a
    };
    let group = |members: &[usize]| Layer { compliance: Compliance::new(&materials[members[0]]), members: members.to_vec() };
    order.chunk_by(same).map(group).collect()
}

/// What all materials share at one `a/t`.
struct Shared {
    x: f64,
    table_tolerance: f64,
    wanted: Wanted,
    /// The Bessel values of Galerkin's method, as far as that is used.
    galerkin: Option<(Abscissae, Vec<Block>)>,
}

impl Shared {
    /// Up to this `a/t`, matrices that are shared cost less than a contour of one's own.
    const REACH: f64 = 60.0;

    fn new(x: f64, layers: &[Layer], scene: &Scene) -> Self {
        let table_tolerance = scene.tolerance;
        let tolerance = solve_tolerance(table_tolerance);
        let galerkin = (x <= Self::REACH).then(|| {
            let smallest_scale = layers.iter().map(|layer| layer.compliance.smallest_scale()).fold(1.0, f64::min);
            let abscissae = Abscissae::new(x, galerkin::modes(x, tolerance), Panels::new(x, smallest_scale, tolerance));
            let blocks = abscissae.blocks().collect();
            (abscissae, blocks)
        });
        Self { x, table_tolerance, wanted: Wanted::of(scene.quantities.iter().copied()), galerkin }
    }

    /// The quantities of every member of a layer.
    fn solve(&self, layer: &Layer, materials: &[Material]) -> Result<Vec<[f64; 4]>, Error> {
        let members = layer.members.iter().map(|&member| &materials[member]);
        let tolerance = solve_tolerance(self.table_tolerance);
        let mut operator = None;
        let solve_member = |material: &Material| {
            if let Some((abscissae, blocks)) = &self.galerkin
                && !layer.compliance.is_homogeneous()
                && !prefers_axis(self.x, &Symbol::new(material), tolerance)
            {
                let operator =
                    operator.get_or_insert_with(|| Operator::assemble(&layer.compliance, abscissae, blocks, self.wanted));
                if let Some(solved) = operator.solve(material).filter(|solved| solved.error() <= tolerance) {
                    return Ok(solved.quantities.to_array());
                }
            }
            // Thin films, and the rare material that needs more modes or panels of its own.
            solve_for_table(self.x, material, self.table_tolerance, self.wanted).map(|quantities| quantities.to_array())
        };
        members.map(solve_member).collect()
    }
}
