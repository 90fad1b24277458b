//! The solves of all nodes of a scene, on all cores, one `a_over_t` at a time.

use interp::{Material, Quantities};

use crate::Error;
use crate::solve::batch::Batch;
use crate::solve::{TOLERANCE, solve};
use crate::table::scene::Scene;

/// Returns the relative tolerance of the solves for a table: a hundredth of the table's own, within
/// the range of the solve and 1e-6 at most.
pub fn solve_tolerance(table_tolerance: f64) -> f64 {
    (0.01 * table_tolerance).clamp(TOLERANCE[0], 1e-6)
}

/// Solves one contact to [`solve_tolerance`]; to a fifth of the table's tolerance in the corners
/// where double precision does not allow more.
///
/// # Errors
/// Those of [`solve`].
pub(crate) fn solve_for_table(
    a_over_t: f64,
    material: &Material,
    table_tolerance: f64,
) -> Result<Quantities, Error> {
    let solve = |tolerance| solve(a_over_t, material, tolerance);
    Ok(solve(solve_tolerance(table_tolerance))
        .or_else(|_| solve((0.2 * table_tolerance).min(TOLERANCE[1])))?
        .quantities)
}

/// The values of each quantity of a scene, row-major, with `a_over_t` the slowest index; none for
/// the other quantities.
pub type Values = [Option<Vec<f64>>; 4];

/// Solves every node of the scene on the given axes.
///
/// Calls `progress` with the number of points finished since the last call, from any thread. The
/// result does not depend on the number of threads.
///
/// # Errors
/// [`Error::NotConverged`] with the point where double precision does not allow the tolerance.
pub fn sweep(
    scene: &Scene,
    axes: &[Vec<f64>; 4],
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Values, Error> {
    let sweep = Sweep::new(scene, axes)?;
    let mut values = sweep.blank();
    for piece in 0..sweep.pieces() {
        sweep.place(&mut values, piece, &sweep.solve(piece, progress)?);
    }
    Ok(values)
}

/// The nodes of a scene, to be solved piece by piece. A piece is all nodes at one `a_over_t`.
pub struct Sweep<'a> {
    scene: &'a Scene,
    a_over_t: &'a [f64],
    batch: Batch,
}

impl<'a> Sweep<'a> {
    /// Groups the materials of the scene on the given axes.
    ///
    /// # Errors
    /// [`Error::Table`] for axes that are not those of the scene.
    pub fn new(
        scene: &'a Scene,
        [a_over_t, e1, nu1, e0]: &'a [Vec<f64>; 4],
    ) -> Result<Self, Error> {
        let mut materials = Vec::with_capacity(e1.len() * nu1.len() * e0.len());
        for &e1 in e1 {
            for &nu1 in nu1 {
                for &e0 in e0 {
                    materials.push(scene.material([e1, nu1, e0])?);
                }
            }
        }
        Ok(Self {
            scene,
            a_over_t,
            batch: Batch::new(materials),
        })
    }

    /// Returns the number of pieces.
    pub fn pieces(&self) -> usize {
        self.a_over_t.len()
    }

    /// Returns the number of points in a piece.
    pub fn points(&self) -> usize {
        self.batch.materials().len()
    }

    /// Returns the number of values in a piece: one for each point and quantity.
    pub fn values(&self) -> usize {
        self.points() * self.scene.quantities.len()
    }

    /// Returns room for the values of the whole table.
    pub fn blank(&self) -> Values {
        let mut values = [const { None }; 4];
        for &quantity in &self.scene.quantities {
            values[quantity as usize] = Some(vec![0.0; self.pieces() * self.points()]);
        }
        values
    }

    /// Copies the values of a piece to their place in `values`.
    pub fn place(&self, values: &mut Values, piece: usize, solved: &[f64]) {
        let points = self.points();
        for (values, solved) in values.iter_mut().flatten().zip(solved.chunks_exact(points)) {
            values[piece * points..][..points].copy_from_slice(solved);
        }
    }

    /// Solves a piece and returns its values: those of every material for the first quantity of the
    /// scene, then for the next. See [`sweep`].
    ///
    /// # Errors
    /// Those of [`sweep`].
    pub fn solve(
        &self,
        piece: usize,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<f64>, Error> {
        let (a_over_t, tolerance) = (self.a_over_t[piece], self.scene.tolerance);
        let alone = |material: &Material| solve_for_table(a_over_t, material, tolerance);
        let solved = self
            .batch
            .solve(a_over_t, solve_tolerance(tolerance), &alone, progress)?;
        let of = |quantity| {
            solved
                .iter()
                .map(move |quantities| quantities.get(quantity))
        };
        Ok(self
            .scene
            .quantities
            .iter()
            .flat_map(|&quantity| of(quantity))
            .collect())
    }
}
