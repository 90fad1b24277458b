//! The likelihood of parameters, for samplers.

use fit::Likelihood;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::Output;
use crate::contacts_on_layers::Solvers;
use crate::error::OrRaise as _;
use crate::experiment::{Given, all};
use crate::model::of_names;
use crate::parameter::{GivenFree, frees, name};
use crate::table::Table;

/// A likelihood with its table.
#[pyclass(frozen, module = "coated_contact._core")]
pub struct NativeLikelihood {
    likelihood: Likelihood,
    table: Table,
}

#[pymethods]
impl NativeLikelihood {
    #[new]
    fn new(
        py: Python<'_>,
        table: &Bound<'_, Table>,
        experiments: Vec<Given<'_>>,
        free: Vec<GivenFree>,
        branches: Option<Vec<Vec<String>>>,
    ) -> PyResult<Self> {
        let table = table.get().clone();
        let solvers = Solvers::new(table.layered_solver(py)?);
        let experiments = all(py, &experiments, &solvers)?;
        let free = frees(py, free)?;
        let branches = branches.map(|all| all.iter().map(|names| of_names(names)).collect());
        let branches: Option<Vec<_>> = branches.transpose()?;
        let likelihood =
            py.detach(|| Likelihood::new(table.get(), &experiments, &free, branches.as_deref()));
        let likelihood = likelihood.or_raise(py)?;
        Ok(Self { likelihood, table })
    }

    /// Returns the names of the parameters, each with the number of its experiment.
    #[getter]
    fn parameters(&self) -> Vec<(String, Option<usize>)> {
        let parameters = self.likelihood.parameters();
        parameters.map(|(one, own)| (name(one), own)).collect()
    }

    /// Returns the logarithms of the likelihood at the rows of values, one row after the other.
    fn values<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Output<'py>> {
        let (table, values) = (self.table.get(), values.as_slice()?);
        let rows = values.chunks_exact(self.width());
        let at = |row| self.likelihood.value(table, row);
        let found: Result<Vec<f64>, _> = py.detach(|| rows.map(at).collect());
        Ok(PyArray1::from_vec(py, found.or_raise(py)?))
    }

    /// Returns the logarithms of the likelihood at the rows of values, and their gradients, one row
    /// after the other.
    fn values_and_gradients<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<[Output<'py>; 2]> {
        let (table, values) = (self.table.get(), values.as_slice()?);
        let rows = values.chunks_exact(self.width());
        let at = |row| self.likelihood.value_and_gradient(table, row);
        let found: Result<Vec<(f64, Vec<f64>)>, _> = py.detach(|| rows.map(at).collect());
        let (values, gradients): (Vec<f64>, Vec<Vec<f64>>) =
            found.or_raise(py)?.into_iter().unzip();
        Ok([values, gradients.concat()].map(|column| PyArray1::from_vec(py, column)))
    }
}

impl NativeLikelihood {
    /// Returns the number of parameters.
    fn width(&self) -> usize {
        self.likelihood.parameters().count()
    }
}
