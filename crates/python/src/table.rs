//! Tables: the embedded one, packed ones and HDF5 ones.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use fit::Solver;
use interp::{Curve, Error, Material, SubstratePoissonRatio};
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use tabulate::table::stack_of;

use crate::arrays::{Input, Outputs, Points};
use crate::bodies::{GivenLayer, Solid, parts};
use crate::error::OrRaise as _;

/// A table, shared with the contacts made from it.
#[pyclass(frozen, module = "coated_contact._core")]
#[derive(Clone)]
pub struct Table(Source);

#[derive(Clone)]
enum Source {
    Embedded,
    Own(Arc<interp::Table>),
}

impl Table {
    /// Returns the table in Rust.
    pub fn get(&self) -> &interp::Table {
        match &self.0 {
            Source::Embedded => interp::Table::embedded(),
            Source::Own(table) => table,
        }
    }

    /// Returns what makes contacts on layers: lookups in a table of a stack, solves beside a table of
    /// films.
    pub fn solver(&self, py: Python<'_>) -> PyResult<Solver> {
        let Source::Own(table) = &self.0 else {
            return Ok(Solver::Direct);
        };
        let named = stack_of(table).or_raise(py)?;
        Ok(named.map_or(Solver::Direct, |named| Solver::Table {
            stack: named.stack,
            table: Arc::clone(table),
        }))
    }

    /// Takes a table.
    pub fn of(table: interp::Table) -> Self {
        Self(Source::Own(Arc::new(table)))
    }

    /// Takes a table that was read, or raises.
    fn own(py: Python<'_>, read: Result<interp::Table, Error>) -> PyResult<Self> {
        read.map(Self::of).or_raise(py)
    }
}

#[pymethods]
impl Table {
    #[staticmethod]
    fn embedded() -> Self {
        Self(Source::Embedded)
    }

    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::own(py, py.detach(|| interp::Table::read(path)))
    }

    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::own(py, py.detach(|| interp::Table::open(path)))
    }

    #[staticmethod]
    fn from_packed(py: Python<'_>, bytes: &[u8]) -> PyResult<Self> {
        Self::own(py, interp::Table::from_packed(bytes))
    }

    fn to_packed<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        py.detach(|| self.get().to_packed())
            .map(|bytes| PyBytes::new(py, &bytes))
            .or_raise(py)
    }

    #[getter]
    fn is_embedded(&self) -> bool {
        matches!(self.0, Source::Embedded)
    }

    /// Returns the description with its certificate.
    fn description<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let description = self.get().description();
        let certificate = &description.certificate;
        let fields = PyDict::new(py);
        fields.set_item("title", &description.title)?;
        fields.set_item("scene", &description.scene)?;
        match description.nu0 {
            SubstratePoissonRatio::Fixed(nu0) => fields.set_item("nu0", nu0)?,
            SubstratePoissonRatio::Paired => {
                fields.set_item("nu0", SubstratePoissonRatio::PAIRED)?;
            }
        }
        fields.set_item("tolerance", description.tolerance)?;
        fields.set_item("created_by", &description.created_by)?;
        fields.set_item("max_error", certificate.max_error)?;
        fields.set_item("median_error", certificate.median_error)?;
        fields.set_item("points", certificate.points)?;
        Ok(fields)
    }

    /// Returns the nodes of each axis by its name.
    fn axes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let axes = PyDict::new(py);
        for (parameter, nodes) in self.get().axes() {
            axes.set_item(parameter.name(), PyArray1::from_vec(py, nodes))?;
        }
        Ok(axes)
    }

    /// Returns the values of each quantity at the nodes, row-major, by its name.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let expanded = py.detach(|| self.get().expand()).or_raise(py)?;
        let values = PyDict::new(py);
        for quantity in expanded.quantities() {
            if let Some(held) = expanded.values(quantity) {
                let array = PyArray1::from_slice(py, held).reshape(expanded.shape())?;
                values.set_item(quantity.name(), array)?;
            }
        }
        Ok(values)
    }

    /// Returns the modulus in whose unit the quantities are.
    fn unit(&self) -> &'static str {
        self.get().unit()
    }

    /// Returns the names of the quantities held.
    fn quantities(&self) -> Vec<&'static str> {
        let held = self.get().quantities();
        held.into_iter().map(interp::Quantity::name).collect()
    }

    /// Looks up every point: `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`, `nu0`. Returns `pi0`,
    /// `eeq`, `gamma`, `delta0` and the relative error.
    #[pyo3(signature = (points, *inputs))]
    fn look_up<'py>(&self, points: Points<'py>, inputs: [Input<'_>; 5]) -> Outputs<'py, 5> {
        // Neighbouring points often have one material.
        let last: Mutex<Option<([f64; 4], Arc<Curve>)>> = Mutex::new(None);
        let kept = || last.lock().unwrap_or_else(PoisonError::into_inner);
        let curve = |of: [f64; 4]| {
            if let Some((material, curve)) = &*kept()
                && *material == of
            {
                return Ok(Arc::clone(curve));
            }
            let [e1_over_e2, nu1, e0_over_e2, nu0] = of;
            let material = Material::new(e1_over_e2, nu1, e0_over_e2, nu0)?;
            let curve = Arc::new(self.get().curve(&material)?);
            *kept() = Some((of, Arc::clone(&curve)));
            Ok::<_, Error>(curve)
        };
        let one = |[x, material @ ..]: [f64; 5]| {
            let curve = curve(material)?;
            let [pi0, eeq, gamma, delta0] = curve.quantities(x)?.to_array();
            Ok::<_, Error>([pi0, eeq, gamma, delta0, curve.error(x)?])
        };
        points.evaluate_on_all_cores(inputs.each_ref(), one)
    }

    /// Returns the base and the layers of the stack that the table is of, if it is of one.
    fn stack(&self, py: Python<'_>) -> PyResult<Option<(Solid, Vec<GivenLayer>)>> {
        Ok(stack_of(self.get()).or_raise(py)?.as_ref().map(parts))
    }
}
