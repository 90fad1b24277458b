//! The generation of tables, with progress, signals, and pieces that are solved elsewhere.
//!
//! The generation runs in a thread of its own. The caller's thread, which alone may run Python, looks at signals,
//! tells the progress, and makes the calls that the generation asks for.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use tabulate::Error;
use tabulate::table::{
    Keep, Observer, Options, Scene, Sweep, build_name, default_points, generate_with, here,
};

use crate::arrays::Output;
use crate::error::OrRaise as _;
use crate::interruption::{Calls, attended};
use crate::table::Table;

/// What to generate, as a Python dict.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Given {
    scene: GivenScene,
    path: PathBuf,
    certificate_points: Option<usize>,
    seed: u64,
    resume: bool,
}

/// A scene, as a Python dict: a file, or its text.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct GivenScene {
    file: Option<PathBuf>,
    text: String,
    tolerance: Option<f64>,
}

impl GivenScene {
    /// Reads the scene.
    fn read(&self) -> Result<Scene, Error> {
        match &self.file {
            Some(file) => Scene::read(file, self.tolerance),
            None => Scene::parse(&self.text, self.tolerance).map_err(|what| Error::Scene {
                path: "the scene".into(),
                what: without_listing(&what).unwrap_or(what),
            }),
        }
    }
}

/// Returns an error about the text of a scene that Python wrote, a line for each key, without the listing of its line.
/// An error within the value of a key begins with the key; every other names its key.
fn without_listing(what: &str) -> Option<String> {
    let (listing, reason) = what.rsplit_once("^\n")?;
    let (place, lines) = listing.split_once('\n')?;
    let line = lines.lines().find_map(|line| line.split_once(" | "));
    Some(match line.and_then(|(_, line)| line.split_once(" = ")) {
        Some((key, _)) if !place.ends_with("column 1") => format!("{key}: {reason}"),
        _ => reason.to_owned(),
    })
}

/// A stage with the number of its points and that of the finished ones.
type Progress = (&'static str, usize, usize);

/// The side of the generation.
struct Told<'a> {
    calls: Calls<'a>,
    progress: &'a Mutex<Progress>,
    interrupted: &'a AtomicBool,
    /// Called with a sentence.
    note: &'a Py<PyAny>,
}

/// Returns the progress, whoever panicked while it was told.
fn locked(progress: &Mutex<Progress>) -> MutexGuard<'_, Progress> {
    progress.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'a> Told<'a> {
    /// Solves the pieces `missing` by `pieces`, which is called with the names and the nodes of the axes, and the
    /// numbers of the pieces. It returns an iterator over pairs of a number and its values.
    fn solve(
        &self,
        pieces: &'a Py<PyAny>,
        sweep: &Sweep<'_>,
        missing: &[usize],
        keep: Keep<'_>,
    ) -> Result<(), Error> {
        let axes = sweep.axes().clone();
        let axes = axes.map(|(parameter, nodes)| (parameter.name(), nodes));
        let numbers = missing.to_vec();
        let solved = self.calls.ask(move |py| {
            let solved = pieces.call1(py, (axes, numbers))?;
            Ok(solved.bind(py).try_iter()?.unbind())
        });
        let solved = solved.map(Arc::new);
        let next = || {
            let solved = Arc::clone(solved.as_ref()?);
            self.calls.ask(move |py| {
                let Some(one) = solved.bind(py).clone().next() else {
                    return Ok(None);
                };
                let (piece, values): (usize, PyReadonlyArray1<'_, f64>) = one?.extract()?;
                Ok(Some((piece, values.as_slice()?.to_vec())))
            })?
        };
        let mut left = missing.len();
        while let Some((piece, values)) = next() {
            self.advance(sweep.points());
            keep(piece, &values)?;
            left -= 1;
        }
        if left > 0 {
            // The caller has an exception, which it raises in place of this error.
            let total = sweep.pieces() * sweep.points();
            let finished = total - left * sweep.points();
            return Err(Error::Interrupted { finished, total });
        }
        Ok(())
    }
}

impl Observer for Told<'_> {
    fn begin(&self, what: &'static str, points: usize, finished: usize) {
        *locked(self.progress) = (what, points, finished);
        // Nothing advances until the caller has told the stage.
        self.calls.ask(|_| Ok(()));
    }

    fn advance(&self, points: usize) {
        locked(self.progress).2 += points;
    }

    fn note(&self, text: &str) {
        let (note, text) = (self.note, text.to_owned());
        self.calls.ask(move |py| note.call1(py, (text,)).map(drop));
    }

    fn is_interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }
}

/// Generates the table of a scene and writes its file. `progress` is called with the stage, the number of its points,
/// and that of the finished ones, and `note` with a sentence. `pieces` solves the pieces of the sweep elsewhere.
#[pyfunction]
pub fn generate(
    py: Python<'_>,
    given: &Bound<'_, PyAny>,
    progress: Option<Bound<'_, PyAny>>,
    note: Py<PyAny>,
    pieces: Option<Py<PyAny>>,
) -> PyResult<Table> {
    let given: Given = given.extract()?;
    let scene = given.scene.read().or_raise(py)?;
    let options = Options {
        certificate_points: given
            .certificate_points
            .unwrap_or_else(|| default_points(scene.axes())),
        seed: given.seed,
        resume: given.resume,
        budget: None,
    };
    let (interrupted, begun) = (AtomicBool::new(false), ("", 0, 0));
    let (current, mut last) = (Mutex::new(begun), begun);
    let look = || {
        let now = *locked(&current);
        match &progress {
            Some(progress) if now != last => {
                last = now;
                let (stage, points, finished) = now;
                progress
                    .call1((stage, points, finished.min(points)))
                    .map(drop)
            }
            _ => Ok(()),
        }
    };
    let outcome = attended(py, &interrupted, look, |calls| {
        let told = Told {
            calls,
            progress: &current,
            interrupted: &interrupted,
            note: &note,
        };
        match &pieces {
            Some(pieces) => {
                let elsewhere =
                    |sweep: &Sweep<'_>, missing: &[usize], _: &dyn Observer, keep: Keep<'_>| {
                        told.solve(pieces, sweep, missing, keep)
                    };
                generate_with(&scene, &given.path, &options, &told, &elsewhere)
            }
            None => generate_with(&scene, &given.path, &options, &told, &here),
        }
    })?;
    Ok(Table::of(outcome.or_raise(py)?.table))
}

/// Solves a piece of the sweep of a scene on the given axes, on all cores. Returns the name of this
/// build and the values.
#[pyfunction]
pub fn solve_piece<'py>(
    py: Python<'py>,
    scene: GivenScene,
    axes: Vec<Vec<f64>>,
    piece: usize,
) -> PyResult<(String, Output<'py>)> {
    let solved = py.detach(|| {
        let scene = scene.read()?;
        let mut nodes = axes.into_iter();
        let axes = scene
            .parameters
            .map(|parameter| (parameter, nodes.next().unwrap_or_default()));
        Sweep::new(&scene, &axes)?.solve(piece, &|_| ())
    });
    let values = solved.or_raise(py)?;
    Ok((build_name(), PyArray1::from_vec(py, values)))
}

/// Returns the name of this build, on which the last digits of solves depend.
#[pyfunction]
pub fn build() -> String {
    build_name()
}
