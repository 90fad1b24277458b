//! The solves of all nodes of a scene, on all cores, one `a_over_t` at a time.

use interp::{Material, Parameter, Quantities, Quantity};

use crate::Error;
use crate::stack::NamedStack;
use crate::table::scene::Scene;
use solve::stack::Stack;
use solve::{Batch, TOLERANCE, solve, solve_stack, solve_stack_under_spheres};

/// Returns the relative tolerance of the solves for a table: a hundredth of the table's own, within
/// the range of the solve and 1e-6 at most.
pub fn solve_tolerance(table_tolerance: f64) -> f64 {
    (0.01 * table_tolerance).clamp(TOLERANCE[0], 1e-6)
}

/// Solves one contact of a film, or of the `stack` under the sphere of the `material`, to
/// [`solve_tolerance`]; to a fifth of the table's tolerance in the corners where double precision
/// does not allow more.
pub(crate) fn solve_for_table(
    a_over_t: f64,
    material: &Material,
    stack: Option<&Stack>,
    table_tolerance: f64,
) -> Result<Quantities, solve::Error> {
    let solved = |tolerance| match stack {
        None => solve(a_over_t, material, tolerance),
        Some(stack) => solve_stack(a_over_t, stack, sphere_modulus(stack, material), tolerance),
    };
    let solution = solved(solve_tolerance(table_tolerance))
        .or_else(|_| solved((0.2 * table_tolerance).min(TOLERANCE[1])))?;
    Ok(solution.quantities)
}

/// Solves the contacts of a `stack` at one `a_over_t` under the spheres of the `materials`, each as
/// [`solve_for_table`], with matrices that the spheres share. Returns the quantities in the order
/// of the materials.
pub(crate) fn solve_stack_for_table(
    a_over_t: f64,
    materials: &[Material],
    stack: &Stack,
    table_tolerance: f64,
) -> Result<Vec<Quantities>, solve::Error> {
    let modulus = |material| sphere_modulus(stack, material);
    let moduli: Vec<f64> = materials.iter().map(modulus).collect();
    solve_stack_under_spheres(
        a_over_t,
        stack,
        &moduli,
        solve_tolerance(table_tolerance),
        &|i| solve_for_table(a_over_t, &materials[i], Some(stack), table_tolerance),
    )
}

/// Returns the reduced modulus of the sphere of a `material` on a `stack`, Pa.
fn sphere_modulus(stack: &Stack, material: &Material) -> f64 {
    stack.surface().young() / material.e1_over_e2()
}

/// The values of each of [`Quantity::ALL`], row-major, with `a_over_t` the slowest index;
/// none for those that the scene does not ask for.
pub type Values = [Option<Vec<f64>>; 4];

/// Solves every node of the scene on the given axes.
///
/// Calls `progress` with the number of points finished since the last call, from any thread. The
/// result does not depend on the number of threads.
///
/// # Errors
/// [`solve::Error::NotConverged`] with the point where double precision does not allow the tolerance.
pub fn sweep(
    scene: &Scene,
    axes: &[(Parameter, Vec<f64>); 4],
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
    axes: &'a [(Parameter, Vec<f64>); 4],
    /// Whether the values of the table are in units of `Es*`.
    reduced: bool,
    batch: Batch,
}

impl<'a> Sweep<'a> {
    /// Groups the materials of the scene on the given axes.
    ///
    /// # Errors
    /// [`Error::Table`] for axes that are not those of the scene.
    pub fn new(scene: &'a Scene, axes: &'a [(Parameter, Vec<f64>); 4]) -> Result<Self, Error> {
        let [_, film, nu1, substrate] = axes.each_ref().map(|(_, nodes)| nodes);
        let mut materials = Vec::with_capacity(film.len() * nu1.len() * substrate.len());
        for &film in film {
            for &nu1 in nu1 {
                for &substrate in substrate {
                    materials.push(scene.material([film, nu1, substrate])?);
                }
            }
        }
        let reduced = scene.parameters == Parameter::REDUCED;
        Ok(Self {
            scene,
            axes,
            reduced,
            batch: Batch::new(materials),
        })
    }

    /// Returns the axes.
    pub const fn axes(&self) -> &'a [(Parameter, Vec<f64>); 4] {
        self.axes
    }

    /// Returns the number of pieces.
    pub fn pieces(&self) -> usize {
        self.axes[0].1.len()
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
        let (a_over_t, tolerance) = (self.axes[0].1[piece], self.scene.tolerance);
        let materials = self.batch.materials();
        let solved = if let Some(NamedStack { stack, .. }) = &self.scene.stack {
            // The batch knows the compliance of films.
            let solved = solve_stack_for_table(a_over_t, materials, stack, tolerance)?;
            progress(materials.len());
            solved
        } else {
            let alone = |material: &Material| solve_for_table(a_over_t, material, None, tolerance);
            let tolerance = solve_tolerance(tolerance);
            self.batch.solve(a_over_t, tolerance, &alone, progress)?
        };
        let of = |quantity: Quantity| {
            solved.iter().zip(materials).map(move |(solved, material)| {
                let value = solved.get(quantity);
                if self.reduced {
                    value / quantity.scale(material.sphere_film_modulus())
                } else {
                    value
                }
            })
        };
        Ok(self
            .scene
            .quantities
            .iter()
            .flat_map(|&quantity| of(quantity))
            .collect())
    }
}
