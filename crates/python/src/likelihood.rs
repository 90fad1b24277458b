//! The likelihood of parameters, for samplers.

use fit::Likelihood;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::Output;
use crate::error::OrRaise as _;
use crate::experiment::{Given, all};
use crate::model::of_names;
use crate::parameter::{GivenFree, frees};
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
        let experiments = all(py, &experiments, &table.solver(py)?)?;
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
        parameters
            .map(|(one, own)| (one.identifier(), own))
            .collect()
    }

    /// Returns the logarithms of the likelihood at the rows of values, one row after the other.
    fn values<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Output<'py>> {
        let (table, values) = (self.table.get(), values.as_slice()?);
        let found = self.rows(py, values, |row| self.likelihood.value(table, row))?;
        Ok(PyArray1::from_vec(py, found))
    }

    /// Returns the logarithms of the likelihood at the rows of values, and their gradients, one row
    /// after the other.
    fn values_and_gradients<'py>(
        &self,
        py: Python<'py>,
        values: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<[Output<'py>; 2]> {
        let (table, values) = (self.table.get(), values.as_slice()?);
        let at = |row: &[f64]| self.likelihood.value_and_gradient(table, row);
        let found = self.rows(py, values, at)?;
        let (values, gradients): (Vec<f64>, Vec<Vec<f64>>) = found.into_iter().unzip();
        Ok([values, gradients.concat()].map(|column| PyArray1::from_vec(py, column)))
    }
}

impl NativeLikelihood {
    /// Evaluates a function of each row of values. A signal, such as Ctrl-C, ends it between some rows.
    fn rows<T: Send>(
        &self,
        py: Python<'_>,
        values: &[f64],
        at: impl Fn(&[f64]) -> Result<T, fit::Error> + Sync,
    ) -> PyResult<Vec<T>> {
        /// The number of rows between two looks at signals.
        const BLOCK: usize = 64;
        let width = self.likelihood.parameters().count();
        let mut found = Vec::with_capacity(values.len() / width);
        for block in values.chunks(BLOCK * width) {
            let rows = block.chunks_exact(width);
            let some: Result<Vec<T>, _> = py.detach(|| rows.map(&at).collect());
            found.extend(some.or_raise(py)?);
            py.check_signals()?;
        }
        Ok(found)
    }
}
