//! Times of single evaluations: a direct solve, the curve of a material, a point on a curve.

use std::hint::black_box;

use interp::{Curve, Material, Quantities, Quantity, Table};

use crate::clock::Timing;
use solve::{Error, solve};

/// The number of random points of a scene at which evaluations are timed.
pub const POINTS: usize = 300;
/// The seed of these points.
pub const SEED: u64 = 6;
/// The seconds spent on timing each kind of evaluation; all points are evaluated once at least.
const BUDGET: f64 = 0.1;

/// Mean times in seconds, on one thread.
pub struct Evaluation {
    /// A direct solve to the tolerance.
    pub solve: f64,
    /// The curve of a material.
    pub curve: f64,
    /// A point on a curve.
    pub point: f64,
}

impl Evaluation {
    /// Times direct solves of these quantities at `points`, which are `a/t` and material, and lookups in a table.
    ///
    /// # Errors
    /// Those of the solve and of the lookup.
    pub fn measure(
        points: &[(f64, Material)],
        quantities: &[Quantity],
        tolerance: f64,
        table: &Table,
        timing: Timing,
    ) -> Result<Self, Error> {
        let solve = |&(a_over_t, material): &(f64, Material)| solve(a_over_t, &material, tolerance);
        points.iter().try_for_each(|point| solve(point).map(drop))?;
        let curve = table.curve(&points[0].1)?;
        let point = |&(a_over_t, _): &(f64, Material)| look_up(&curve, quantities, a_over_t);
        points.iter().try_for_each(|at| point(at).map(drop))?;

        let mean = |all: &dyn Fn()| timing.seconds(BUDGET, all) / points.len() as f64;
        Ok(Self {
            solve: mean(&|| points.iter().for_each(|at| drop(black_box(solve(at))))),
            curve: mean(&|| {
                points
                    .iter()
                    .for_each(|(_, material)| drop(black_box(table.curve(material))))
            }),
            point: mean(&|| points.iter().for_each(|at| drop(black_box(point(at))))),
        })
    }
}

/// Returns the quantities of a sphere, of those of a scene, on a curve of its table. The others are
/// NaN.
fn look_up(curve: &Curve, quantities: &[Quantity], a_over_t: f64) -> Result<Quantities, Error> {
    if quantities == Quantity::ALL {
        return Ok(curve.quantities(a_over_t)?);
    }
    let mut values = [f64::NAN; 4];
    for (quantity, value) in Quantity::ALL.into_iter().zip(&mut values) {
        if quantities.contains(&quantity) {
            *value = curve.quantity(quantity, a_over_t)?;
        }
    }
    Ok(Quantities::from_array(values))
}
