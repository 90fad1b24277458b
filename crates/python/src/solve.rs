//! Direct solves on all cores.

use ::solve::Solution;
use ::solve::stick::Sticking;
use interp::Material;
use pyo3::prelude::*;

use crate::arrays::{Input, Outputs, Points};
use crate::bodies::{NativeCoated, NativeStack};

/// Solves every point: `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`, `nu0`, `tolerance`. Returns
/// `pi0`, `eeq`, `gamma`, `delta0` and the estimated error.
#[pyfunction]
#[pyo3(signature = (points, *inputs))]
pub fn solve<'py>(points: Points<'py>, inputs: [Input<'_>; 6]) -> Outputs<'py, 5> {
    let one = |[a_over_t, e1_over_e2, nu1, e0_over_e2, nu0, tolerance]: [f64; 6]| {
        let material = Material::new(e1_over_e2, nu1, e0_over_e2, nu0)?;
        ::solve::solve(a_over_t, &material, tolerance).map(numbers)
    };
    points.evaluate_on_all_cores(inputs.each_ref(), one)
}

/// Solves a stack of layers at every point: `a_over_t`, the reduced modulus of the sphere,
/// `tolerance`. Returns what [`solve`] returns.
#[pyfunction]
pub fn solve_stack<'py>(
    stack: &Bound<'py, NativeStack>,
    points: Points<'py>,
    a_over_t: Input<'_>,
    sphere_modulus: Input<'_>,
    tolerance: Input<'_>,
) -> Outputs<'py, 5> {
    let stack = &stack.get().0.stack;
    let one = |[a_over_t, sphere_modulus, tolerance]: [f64; 3]| {
        ::solve::solve_stack(a_over_t, stack, sphere_modulus, tolerance).map(numbers)
    };
    points.evaluate_on_all_cores([&a_over_t, &sphere_modulus, &tolerance], one)
}

/// Solves the flat punch that sticks at every point: `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`,
/// `nu0`, `nu2`, `tolerance`. Returns `eeq_s`, `gamma_s`, `gamma_t`, `gamma_eff` and the estimated
/// error; `gamma_s` and `gamma_t` are NaN where Dundurs' beta is not 0.
#[pyfunction]
#[pyo3(signature = (points, *inputs))]
pub fn solve_stick_punch<'py>(points: Points<'py>, inputs: [Input<'_>; 7]) -> Outputs<'py, 5> {
    let one = |[a_over_t, e1_over_e2, nu1, e0_over_e2, nu0, nu2, tolerance]: [f64; 7]| {
        let material = Material::new(e1_over_e2, nu1, e0_over_e2, nu0)?;
        let punch = Sticking::on_film(&material, nu2)?.punch(a_over_t, tolerance)?;
        let [gamma_s, gamma_t] = punch.edge.unwrap_or([f64::NAN; 2]);
        Ok::<_, ::solve::Error>([punch.eeq_s, gamma_s, gamma_t, punch.gamma_eff, punch.error])
    };
    points.evaluate_on_all_cores(inputs.each_ref(), one)
}

/// Returns the stiffness with full friction over that without, of flat punches of the contact radii
/// `a`, of the Poisson ratio `nu2`, to a `tolerance`.
#[pyfunction]
pub fn stick_stiffening<'py>(
    bodies: &Bound<'py, NativeCoated>,
    points: Points<'py>,
    a: Input<'_>,
    nu2: Input<'_>,
    tolerance: Input<'_>,
) -> Outputs<'py, 1> {
    let bodies = bodies.get();
    let film_thickness = bodies.system.film_thickness;
    let one = |[a, nu2, tolerance]: [f64; 3]| {
        let ratio = bodies
            .sticking(nu2)?
            .stiffening(a / film_thickness, tolerance)?;
        Ok::<_, ::solve::Error>([ratio])
    };
    points.evaluate_on_all_cores([&a, &nu2, &tolerance], one)
}

/// Returns `pi0`, `eeq`, `gamma`, `delta0` and the estimated error.
fn numbers(solution: Solution) -> [f64; 5] {
    let [pi0, eeq, gamma, delta0] = solution.quantities.to_array();
    [pi0, eeq, gamma, delta0, solution.error]
}
