//! What makes the contacts of experiments on layers, and of films to which the sphere sticks.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use fit::{Interruptible, LayeredSolver, StickSolver};
use pyo3::prelude::*;

use crate::error::unknown;

/// Returns what makes contacts with a word for friction; `None` without friction.
pub fn stick(
    friction: &str,
    sphere_poisson_ratio: f64,
    advancing: f64,
) -> PyResult<Option<StickSolver>> {
    match friction {
        "none" => Ok(None),
        "stick" => Ok(Some(StickSolver {
            sphere_poisson_ratio,
            advancing,
        })),
        other => Err(unknown("friction", other)),
    }
}

/// Makes the contacts on layers until a flag is set.
#[derive(Clone)]
pub struct Solvers {
    frictionless: Arc<dyn LayeredSolver>,
    /// Whether no further contact is made.
    pub interrupted: Arc<AtomicBool>,
}

impl Solvers {
    /// Makes contacts without friction by a solver.
    pub fn new(frictionless: Arc<dyn LayeredSolver>) -> Self {
        Self {
            frictionless,
            interrupted: Arc::default(),
        }
    }

    /// Returns the solver of an experiment.
    pub fn of(&self, stick: Option<StickSolver>) -> Arc<dyn LayeredSolver> {
        let solver = stick.map_or_else(
            || Arc::clone(&self.frictionless),
            |stick| Arc::new(stick) as Arc<dyn LayeredSolver>,
        );
        Arc::new(Interruptible {
            solver,
            interrupted: Arc::clone(&self.interrupted),
        })
    }
}
