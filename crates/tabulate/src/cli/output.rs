//! The results of a command: a file, or standard output.

use std::ffi::OsStr;
use std::fs::OpenOptions;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use anyhow::{Context, bail};
use same_file::Handle;

use super::note;
use crate::output::{self, Unfinished};
use crate::printable;

/// The endings of the names of tables.
const ENDINGS_OF_TABLES: [&str; 3] = ["h5", "hdf5", "bin"];

/// The place of a command's results: a file, which is complete or not there, or standard output.
pub struct Output<'a>(Option<&'a Path>);

impl<'a> Output<'a> {
    /// Accepts the output of a command before any work. `inputs` are all files that the command
    /// reads. Unfinished files of this output that killed processes have left are removed and
    /// named.
    pub fn new(path: Option<&'a Path>, inputs: &[Option<&Path>]) -> anyhow::Result<Self> {
        let inputs: Vec<&Path> = inputs.iter().copied().flatten().collect();
        if let Some(path) = path {
            output::check(path, &inputs)?;
            for removed in output::tidy(path) {
                note(&output::removed(&removed));
            }
        } else if let Some(input) = inputs.iter().find(|input| is_standard_output(input)) {
            bail!(
                "{} is both input and standard output; write to another file",
                printable::path(input)
            );
        }
        Ok(Self(path))
    }

    /// As [`Output::new`], for a text: a name that ends like that of a table is refused.
    pub fn of_text(path: Option<&'a Path>, inputs: &[Option<&Path>]) -> anyhow::Result<Self> {
        let output = Self::new(path, inputs)?;
        if let Some(path) = path
            && has_ending(path, &ENDINGS_OF_TABLES)
        {
            bail!(
                "{} is the name of a table, and this command writes a text; choose another name",
                printable::path(path)
            );
        }
        Ok(output)
    }

    /// Writes the whole text.
    pub fn write(&self, text: &[u8]) -> anyhow::Result<()> {
        self.stream(|out| Ok(out.write_all(text)?))
    }

    /// Writes a text in parts. A file is there when `fill` has succeeded. What `fill` writes to
    /// standard output before it fails is printed.
    ///
    /// A reader that has closed standard output has read enough: this is no error, and `fill` ends
    /// early.
    pub fn stream(
        &self,
        fill: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let Some(path) = self.0 else {
            let mut out =
                Watched::new(standard_output().context("cannot write to standard output")?);
            let outcome = fill(&mut out).and_then(|()| Ok(out.flush()?));
            return match out.failure {
                Some(io::ErrorKind::BrokenPipe) => Ok(()),
                Some(_) => outcome.context("cannot write to standard output"),
                None => outcome,
            };
        };
        let unfinished = Unfinished::new(path)?;
        let mut out = Watched::new(OpenOptions::new().write(true).open(unfinished.path())?);
        let outcome = fill(&mut out).and_then(|()| Ok(out.flush()?));
        if out.failure.is_some() {
            return outcome.with_context(|| format!("cannot write {}", printable::path(path)));
        }
        outcome?;
        Ok(unfinished.complete()?)
    }
}

/// Tells whether a name has one of these endings, in upper or lower case.
pub fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let is = |found: &OsStr| endings.iter().any(|one| found.eq_ignore_ascii_case(one));
    path.extension().is_some_and(is)
}

/// Returns standard output as a file: the one of the standard library takes writes to a descriptor
/// that cannot be written to for successful.
#[cfg(unix)]
fn standard_output() -> io::Result<impl Write> {
    use std::os::fd::AsFd;
    Ok(std::fs::File::from(
        io::stdout().as_fd().try_clone_to_owned()?,
    ))
}

#[cfg(not(unix))]
fn standard_output() -> io::Result<impl Write> {
    Ok(io::stdout().lock())
}

/// Returns true if standard output appends to a file.
fn is_standard_output(file: &Path) -> bool {
    // A terminal may be both.
    file.is_file()
        && Handle::stdout().is_ok_and(|out| Handle::from_path(file).is_ok_and(|file| file == out))
}

/// Remembers why writing has failed: an error of `fill` may have another cause.
struct Watched<W: Write> {
    out: BufWriter<W>,
    failure: Option<io::ErrorKind>,
}

impl<W: Write> Watched<W> {
    fn new(out: W) -> Self {
        Self {
            out: BufWriter::new(out),
            failure: None,
        }
    }

    fn watch<T>(&mut self, outcome: io::Result<T>) -> io::Result<T> {
        if let Err(error) = &outcome {
            self.failure = Some(error.kind());
        }
        outcome
    }
}

impl<W: Write> Write for Watched<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let outcome = self.out.write(bytes);
        self.watch(outcome)
    }

    fn flush(&mut self) -> io::Result<()> {
        let outcome = self.out.flush();
        self.watch(outcome)
    }
}
