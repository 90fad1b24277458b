//! Flat arrays of f64, evaluated point by point with the interpreter's lock released.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use ::solve::parallel;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;

use crate::error::Failure;
use crate::interruption::{TICK, interruptible};

/// An input: one value for each point, or one value for all.
pub type Input<'py> = PyReadonlyArray1<'py, f64>;
/// A result: one value for each point.
pub type Output<'py> = Bound<'py, PyArray1<f64>>;

/// The results of an evaluation, or an exception.
pub type Outputs<'py, const N: usize> = PyResult<[Output<'py>; N]>;

/// The points of an evaluation.
#[derive(Clone, Copy)]
pub struct Points<'py> {
    py: Python<'py>,
    count: usize,
    /// Whether a point with an error gives NaN instead of an exception.
    nan: bool,
}

impl<'py> FromPyObject<'_, 'py> for Points<'py> {
    type Error = PyErr;

    fn extract(given: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let (count, nan) = given.extract()?;
        let py = given.py();
        Ok(Self { py, count, nan })
    }
}

/// The values of the inputs.
#[derive(Clone, Copy)]
struct Values<'a, const K: usize>([&'a [f64]; K]);

impl<const K: usize> Values<'_, K> {
    /// Returns the inputs of one point.
    fn at(self, index: usize) -> [f64; K] {
        self.0
            .map(|values| values[if values.len() == 1 { 0 } else { index }])
    }
}

impl<'py> Points<'py> {
    /// Evaluates `function` at every point, in the thread of the caller.
    pub fn evaluate<const K: usize, const N: usize, E>(
        self,
        inputs: [&Input<'_>; K],
        function: impl Fn([f64; K]) -> Result<[f64; N], E> + Sync,
    ) -> Outputs<'py, N>
    where
        E: Send,
        Failure: From<E>,
    {
        let mut columns = self.columns()?;
        self.for_each(inputs, function, |numbers| add(&mut columns, numbers))?;
        Ok(columns.map(|column| PyArray1::from_vec(self.py, column)))
    }

    /// Evaluates `function` at every point, in the thread of the caller, and gives the results to `take`
    /// one after the other: none for a point with an error that is no exception.
    pub fn for_each<const K: usize, T, E>(
        self,
        inputs: [&Input<'_>; K],
        function: impl Fn([f64; K]) -> Result<T, E> + Sync,
        take: impl FnMut(Option<T>) + Send,
    ) -> PyResult<()>
    where
        E: Send,
        Failure: From<E>,
    {
        let function = &function;
        let lengths = [1, 1 << 16];
        self.in_blocks(
            inputs,
            lengths,
            None,
            |values, block| block.map(move |index| function(values.at(index))),
            take,
        )
    }

    /// Returns empty columns with memory for all points.
    pub fn columns<T, const N: usize>(self) -> PyResult<[Vec<T>; N]> {
        let mut columns = [const { Vec::new() }; N];
        for column in &mut columns {
            let reserved = column.try_reserve_exact(self.count);
            reserved.map_err(|error| PyMemoryError::new_err(error.to_string()))?;
        }
        Ok(columns)
    }

    /// Evaluates `function` at every point, on all cores. The results do not depend on their number.
    pub fn evaluate_on_all_cores<const K: usize, const N: usize, E>(
        self,
        inputs: [&Input<'_>; K],
        function: impl Fn([f64; K]) -> Result<[f64; N], E> + Sync,
    ) -> Outputs<'py, N>
    where
        E: Send,
        Failure: From<E>,
    {
        let interrupted = AtomicBool::new(false);
        let lengths = [1 << 12; 2];
        let evaluate = |values: Values<'_, K>, block: Range<usize>| {
            let one = |index| {
                let goes_on = !interrupted.load(Ordering::Relaxed);
                goes_on.then(|| function(values.at(index))).ok_or(())
            };
            parallel::try_map(block, one).into_iter().flatten()
        };
        let mut columns = self.columns()?;
        let take = |numbers| add(&mut columns, numbers);
        self.in_blocks(inputs, lengths, Some(&interrupted), evaluate, take)?;
        Ok(columns.map(|column| PyArray1::from_vec(self.py, column)))
    }

    /// Evaluates blocks of points one after the other. Between them a signal, such as Ctrl-C, ends
    /// the evaluation; within them, too, if `evaluate` reads that it is `interrupted`. Their
    /// length doubles from the `least` up to the `most` while they take little time.
    fn in_blocks<'a, const K: usize, T, E, I>(
        self,
        inputs: [&'a Input<'_>; K],
        [least, most]: [usize; 2],
        interrupted: Option<&AtomicBool>,
        evaluate: impl Fn(Values<'a, K>, Range<usize>) -> I + Sync,
        mut take: impl FnMut(Option<T>) + Send,
    ) -> PyResult<()>
    where
        E: Send,
        Failure: From<E>,
        I: Iterator<Item = Result<T, E>>,
    {
        let Self { py, count, nan } = self;
        let mut values = Values([&[]; K]);
        for (values, input) in values.0.iter_mut().zip(inputs) {
            *values = input.as_slice()?;
            if values.len() != 1 && values.len() != count {
                return Err(PyValueError::new_err(format!(
                    "an input has {} values, there are {count} points",
                    values.len()
                )));
            }
        }
        let (mut start, mut length) = (0, least);
        while start < count {
            let block = start..count.min(start + length);
            start = block.end;
            let begun = Instant::now();
            let work = || {
                for (index, result) in block.clone().zip(evaluate(values, block)) {
                    take(match result {
                        Ok(result) => Some(result),
                        Err(_) if nan => None,
                        Err(error) => return Err((index, error)),
                    });
                }
                Ok(())
            };
            let done = match interrupted {
                Some(interrupted) => interruptible(py, interrupted, work)?,
                None => py.detach(work),
            };
            done.map_err(|(index, error)| Failure::from(error).at(index).raise(py))?;
            py.check_signals()?;
            length = if begun.elapsed() < TICK {
                most.min(2 * length)
            } else {
                least.max(length / 2)
            };
        }
        Ok(())
    }
}

/// Adds the numbers of a point to columns, NaN without any.
pub fn add<const N: usize>(columns: &mut [Vec<f64>; N], numbers: Option<[f64; N]>) {
    for (column, number) in columns.iter_mut().zip(numbers.unwrap_or([f64::NAN; N])) {
        column.push(number);
    }
}

/// Returns the columns of rows as arrays.
pub fn columns<'py, const N: usize>(py: Python<'py>, rows: &[[f64; N]]) -> [Output<'py>; N] {
    std::array::from_fn(|i| PyArray1::from_iter(py, rows.iter().map(|row| row[i])))
}
