//! An attraction of finite range: states at contact radii, fields in one contact, and the pull-off.

use std::sync::atomic::{AtomicBool, Ordering};

use ::contact::CohesiveState;
use ::solve::{cohesive, parallel};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::{Input, Output, Outputs, Points, columns};
use crate::bodies::NativeCoated;
use crate::contact::{Imposed, control};
use crate::error::OrRaise as _;
use crate::interruption::interruptible;

/// A probe with an attraction of finite range.
#[pyclass(frozen, module = "coated_contact._core")]
pub struct Cohesive(cohesive::Cohesive);

/// Contact radius, outer radius, load and penetration.
pub type CohesiveNumbers = [f64; 4];

/// Returns the four numbers of a state.
pub fn numbers(state: CohesiveState) -> CohesiveNumbers {
    [
        state.contact_radius,
        state.outer_radius,
        state.load,
        state.penetration,
    ]
}

#[pymethods]
impl Cohesive {
    #[new]
    fn new(py: Python<'_>, bodies: &Bound<'_, NativeCoated>, w: f64, range: f64) -> PyResult<Self> {
        let bodies = bodies.get();
        let made = cohesive::Cohesive::new(&bodies.system, bodies.stack(), w, range);
        made.map(Self).or_raise(py)
    }

    fn state<'py>(&self, points: Points<'py>, a: Input<'_>) -> Outputs<'py, 4> {
        points.evaluate_on_all_cores([&a], |[a]| self.0.state(a).map(numbers))
    }

    fn without_contact<'py>(&self, points: Points<'py>, c: Input<'_>) -> Outputs<'py, 4> {
        points.evaluate_on_all_cores([&c], |[c]| self.0.without_contact(c).map(numbers))
    }

    fn pressure<'py>(&self, py: Python<'py>, a: f64, radii: Input<'_>) -> PyResult<Output<'py>> {
        let radii = radii.as_slice()?;
        let values = py.detach(|| self.0.pressure(a, radii)).or_raise(py)?;
        Ok(PyArray1::from_vec(py, values))
    }

    fn gap<'py>(&self, py: Python<'py>, a: f64, radii: Input<'_>) -> PyResult<Output<'py>> {
        let radii = radii.as_slice()?;
        let values = py.detach(|| self.0.gap(a, radii)).or_raise(py)?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// Returns the states of a branch, one array for each of their numbers.
    fn branch<'py>(
        &self,
        py: Python<'py>,
        contact_radii: [f64; 2],
        count: usize,
    ) -> PyResult<[Output<'py>; 4]> {
        let radii = cohesive::Cohesive::branch_radii(contact_radii, count).or_raise(py)?;
        let interrupted = AtomicBool::new(false);
        let state = |&a: &f64| {
            let goes_on = !interrupted.load(Ordering::Relaxed);
            goes_on.then(|| self.0.state(a).map(numbers)).ok_or(())
        };
        let states = interruptible(py, &interrupted, || parallel::try_map(&radii, state))?;
        let rows: Result<Vec<_>, _> = states.into_iter().flatten().collect();
        Ok(columns(py, &rows.or_raise(py)?))
    }

    fn pull_off(&self, py: Python<'_>, imposed: Imposed<'_>) -> PyResult<CohesiveNumbers> {
        let control = control(imposed)?;
        py.detach(|| self.0.pull_off(control))
            .map(numbers)
            .or_raise(py)
    }
}
