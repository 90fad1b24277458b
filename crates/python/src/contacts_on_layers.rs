//! What makes the contacts of experiments on layers, and of films to which the sphere sticks.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use fit::{Interrupt, Solver};
use pyo3::prelude::*;

use crate::error::unknown;

/// Returns what makes contacts with a word for friction; `None` without friction.
pub fn stick(
    friction: &str,
    sphere_poisson_ratio: f64,
    advancing: f64,
) -> PyResult<Option<Solver>> {
    match friction {
        "none" => Ok(None),
        "stick" => Ok(Some(Solver::Stick {
            sphere_poisson_ratio,
            advancing,
        })),
        other => Err(unknown("friction", other)),
    }
}

/// Makes the contacts on layers until a flag is set.
pub struct ContactsOnLayers {
    /// What makes contacts without friction.
    pub frictionless: Solver,
    /// Whether no further contact is made.
    pub interrupted: Arc<AtomicBool>,
}

impl ContactsOnLayers {
    /// Makes contacts without friction by a solver.
    pub fn new(frictionless: Solver) -> Self {
        Self {
            frictionless,
            interrupted: Arc::default(),
        }
    }

    /// Returns what tells whether no further contact is made.
    pub fn interrupt(&self) -> Interrupt {
        let interrupted = Arc::clone(&self.interrupted);
        Interrupt::when(move || interrupted.load(Ordering::Relaxed))
    }
}
