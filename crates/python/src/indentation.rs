//! What is known of a measurement of contact stiffness, from Python.

use fit::{AreaFunction, Bodies, ContactDepth, Error, Experiment, Indentation};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::OrRaise as _;

/// What is known of the indenter, as the attributes of a Python class.
#[derive(FromPyObject)]
pub struct GivenIndentation {
    beta: f64,
    epsilon: f64,
    area: Vec<f64>,
    contact_depth: String,
    thinning: f64,
    hardness: Option<f64>,
    tip_rounding: f64,
    frame_compliance: f64,
    loads: Option<Vec<f64>>,
    phases: Option<Vec<f64>>,
    loss_tangent: f64,
    reference: bool,
}

impl GivenIndentation {
    /// Gives an experiment what is known. The sample of a reference keeps its modulus: it is a base
    /// without layers.
    pub fn complete(&self, py: Python<'_>, experiment: &mut Experiment) -> PyResult<()> {
        let depth = ContactDepth::of_name(&self.contact_depth);
        experiment.indentation = Indentation {
            beta: self.beta,
            epsilon: self.epsilon,
            area: AreaFunction::new(&self.area).or_raise(py)?,
            contact_depth: depth.unwrap_or(ContactDepth::OliverPharr),
            thinning: self.thinning,
            hardness: self.hardness,
            tip_rounding: self.tip_rounding,
            frame_compliance: self.frame_compliance,
            loads: self.loads.clone().unwrap_or_default(),
            phases: self.phases.clone().unwrap_or_default(),
            loss_tangent: self.loss_tangent,
        };
        if !self.reference {
            return Ok(());
        }
        let bodies = &experiment.bodies;
        if !bodies.are_half_space() {
            let refused = Err::<(), _>(Error::Setting {
                name: format!("reference of {}", experiment.measurement.name),
                value: 1.0,
                allowed: "false, unless the system is a HalfSpace".into(),
            });
            return refused.or_raise(py);
        }
        experiment.bodies = Bodies::bare(&experiment.measurement, bodies.on(bodies.base));
        Ok(())
    }
}

/// Returns angle, tangent and standard error of the tangent of a loss angle.
pub fn loss<'py>(
    py: Python<'py>,
    found: Option<fit::LossAngle>,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(found) = found else { return Ok(None) };
    let fields = PyDict::new(py);
    fields.set_item("angle", found.angle)?;
    fields.set_item("tangent", found.tangent())?;
    fields.set_item("standard_error", found.tangent_error())?;
    Ok(Some(fields))
}
