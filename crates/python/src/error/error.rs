//! An error on its way to Python.

use std::io;
use std::path::Path;

use fit::Fixed;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// An error on its way to Python.
#[derive(Default)]
pub struct Failure {
    pub(super) class: &'static str,
    pub(super) message: String,
    pub(super) axis: Option<String>,
    pub(super) value: Option<f64>,
    pub(super) range: Option<(f64, f64)>,
    pub(super) allowed: Option<String>,
    /// The number of the point that failed, where there are many.
    pub(super) index: Option<usize>,
    pub(super) cause: Option<Box<Failure>>,
    /// The arguments of Python's `OSError`: the number, the reason and the path.
    pub(super) file: Option<(i32, String, String)>,
}

impl Failure {
    /// An error of the class `class` with the message of `error` and of its sources.
    pub fn new(class: &'static str, error: &dyn std::error::Error) -> Self {
        let mut message = error.to_string();
        let mut source = error.source();
        while let Some(error) = source {
            message = format!("{message}: {error}");
            source = error.source();
        }
        Self::of_words(class, &in_python(&message))
    }

    /// An error of the class `class` with a message.
    pub fn of_words(class: &'static str, message: &str) -> Self {
        Self {
            class,
            message: message.to_owned(),
            ..Self::default()
        }
    }

    /// The error of numbers that no experiment has; `None` without any.
    pub fn magnitudes(name: &str, found: &[contact::magnitude::Magnitude]) -> Option<Self> {
        let first = found.first()?;
        let texts: Vec<String> = found.iter().map(ToString::to_string).collect();
        let message = format!(
            "{name}: {}; give SI units, or if these numbers are meant, allow=(\"magnitudes\",)",
            texts.join("; ")
        );
        Some(Self::of_words("FitError", &message).about(&first.what, first.value))
    }

    /// Adds a sentence to the message.
    pub fn with(self, sentence: &str) -> Self {
        let message = format!("{}; {sentence}", self.message);
        self.saying(&message)
    }

    /// Replaces the message by one in the words of this package.
    pub(super) fn saying(mut self, message: &str) -> Self {
        message.clone_into(&mut self.message);
        self
    }

    /// Adds the name and the value of what is refused.
    pub fn about(mut self, axis: &str, value: f64) -> Self {
        (self.axis, self.value) = (Some(axis.to_owned()), Some(value));
        self
    }

    /// Adds the range of the values allowed.
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from, to));
        self
    }

    /// Adds the values allowed in words.
    pub fn allowed(mut self, words: &str) -> Self {
        self.allowed = Some(in_python(words));
        self
    }

    /// Adds the number of the point that failed.
    pub fn at(mut self, index: usize) -> Self {
        self.index = Some(index);
        self
    }

    /// Makes it an `OSError` about a file, with the class that Python chooses by its number.
    pub fn about_file(self, path: &Path, source: &io::Error) -> Self {
        let number = source.raw_os_error();
        let file = number.map(|number| (number, reason(source), path.display().to_string()));
        Self {
            class: "OSError",
            file,
            ..self
        }
    }

    /// Makes the exception.
    pub fn raise(self, py: Python<'_>) -> PyErr {
        if let Some(arguments) = self.file {
            return PyOSError::new_err(arguments);
        }
        if self.class == "OSError" {
            return PyOSError::new_err(self.message);
        }
        let make = || -> PyResult<PyErr> {
            let fields = PyDict::new(py);
            fields.set_item("axis", self.axis.as_deref().map(with_identifiers))?;
            fields.set_item("value", self.value)?;
            fields.set_item("range", self.range)?;
            fields.set_item("allowed", self.allowed.as_deref().map(with_identifiers))?;
            fields.set_item("index", self.index)?;
            let class = py.import("coated_contact._errors")?.getattr(self.class)?;
            let message = with_identifiers(&self.message);
            let made = PyErr::from_value(class.call((message,), Some(&fields))?);
            made.set_cause(py, self.cause.map(|cause| cause.raise(py)));
            Ok(made)
        };
        make().unwrap_or_else(|error| error)
    }
}

/// A result whose error becomes an exception.
pub trait OrRaise<T> {
    /// Makes the exception of an error.
    fn or_raise(self, py: Python<'_>) -> PyResult<T>;
}

impl<T, E> OrRaise<T> for Result<T, E>
where
    Failure: From<E>,
{
    fn or_raise(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| Failure::from(error).raise(py))
    }
}

/// Returns a message whose code, between backticks, is that of this package: `Contact.pull_off` for
/// `Contact::pull_off`.
fn in_python(message: &str) -> String {
    let parts = message.split('`').enumerate();
    let parts = parts.map(|(i, part)| {
        if i % 2 == 1 {
            code(part)
        } else {
            part.to_owned()
        }
    });
    parts.collect::<Vec<_>>().join("`")
}

/// Returns words with the names of parameters as this package has them: `contact_point` for `contact-point`. Parts of
/// longer words, such as names of files, stay as they are.
pub fn with_identifiers(words: &str) -> String {
    let is_part = |c: char| c.is_alphanumeric() || "-_./".contains(c);
    let identified = |word: &str| {
        let name = word.trim_end_matches(|c| !is_part(c)).trim_end_matches('.');
        let parameter = name.parse().map(Fixed::Parameter).ok();
        match parameter.or_else(|| Fixed::parse(name)) {
            Some(one) if name.contains('-') => word.replacen(name, &one.identifier(), 1),
            _ => word.to_owned(),
        }
    };
    let words = words.split_inclusive(|c| !is_part(c));
    words.map(identified).collect()
}

/// Returns a name of a Rust crate as this package calls it.
fn code(name: &str) -> String {
    // The modules of Rust, and the enum of the shapes, are no names here.
    let is_here = |part: &&str| part.starts_with(|c: char| c.is_uppercase()) && *part != "Probe";
    match name.rsplit_once("::") {
        Some((path, last)) => {
            let classes = path.split("::").filter(is_here).chain([last]);
            classes.collect::<Vec<_>>().join(".")
        }
        None => name.to_owned(),
    }
}

/// Returns the words of the operating system without the number that Rust adds.
fn reason(source: &io::Error) -> String {
    let text = source.to_string();
    match text.find(" (os error") {
        Some(end) => text[..end].to_owned(),
        None => text,
    }
}

/// The error of a stack that is not that of a table.
pub fn other_stack() -> Failure {
    Failure::of_words(
        "OutsideTableError",
        "the table is of another stack of layers than the system: take that of the table, \
         `table.stack`, make the table of this one with `generate`, or solve it with `Stack.contact`",
    )
}

/// Returns the exception of a word that the Python layer should have refused.
pub fn unknown(what: &str, word: &str) -> PyErr {
    PyValueError::new_err(format!("{word:?} is not a {what}"))
}
