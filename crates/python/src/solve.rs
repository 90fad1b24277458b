//! Direct solves on all cores.

use interp::Material;
use pyo3::prelude::*;
use tabulate::Error;

use crate::arrays::{Input, Output, Points};

/// Solves every point: `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`, `nu0`, `tolerance`. Returns
/// `pi0`, `eeq`, `gamma`, `delta0` and the estimated error.
#[pyfunction]
#[pyo3(signature = (points, *inputs))]
pub fn solve<'py>(
    py: Python<'py>,
    points: Points,
    inputs: [Input<'_>; 6],
) -> PyResult<[Output<'py>; 5]> {
    let one = |[a_over_t, e1_over_e2, nu1, e0_over_e2, nu0, tolerance]: [f64; 6]| {
        let material = Material::new(e1_over_e2, nu1, e0_over_e2, nu0)?;
        let solution = tabulate::solve(a_over_t, &material, tolerance)?;
        let [pi0, eeq, gamma, delta0] = solution.quantities.to_array();
        Ok::<_, Error>([pi0, eeq, gamma, delta0, solution.error])
    };
    points.evaluate_on_all_cores(py, inputs.each_ref(), one)
}
