//! The generation of tables, with progress, signals, and pieces that are solved elsewhere.
//!
//! The generation runs in a thread of its own. The caller's thread, which alone may run Python,
//! waits for its events: it looks at signals, tells the progress, and solves pieces elsewhere.

use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;

use interp::Parameter;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use tabulate::Error;
use tabulate::table::{
    Keep, Observer, Options, Scene, Sweep, build_name, default_points, generate_with, here,
};

use crate::arrays::Output;
use crate::error::OrRaise as _;
use crate::interruption::TICK;
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

/// What the thread of the generation tells that of the caller.
enum Event {
    /// A stage begins, with its points and those that are finished already. It waits for an answer.
    Begin(&'static str, usize, usize, Sender<()>),
    /// A sentence for the user.
    Note(String),
    /// The pieces of a sweep are to be solved elsewhere.
    Pieces(Pieces),
    /// The generation has ended.
    End,
}

/// The pieces of a sweep that are to be solved elsewhere. Dropping `reply` tells that there are no
/// more.
struct Pieces {
    axes: [(Parameter, Vec<f64>); 4],
    missing: Vec<usize>,
    reply: Sender<(usize, Vec<f64>)>,
}

/// The side of the generation.
struct Told {
    events: Mutex<Sender<Event>>,
    advanced: AtomicUsize,
    interrupted: AtomicBool,
}

impl Told {
    fn tell(&self, event: Event) {
        // The caller listens until the end of the generation.
        let _ = self
            .events
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .send(event);
    }

    /// Solves the pieces `missing` by the caller's thread.
    fn solve(
        &self,
        sweep: &Sweep<'_>,
        missing: &[usize],
        observer: &dyn Observer,
        keep: Keep<'_>,
    ) -> Result<(), Error> {
        let (reply, solved) = channel();
        let missing = missing.to_vec();
        let mut left = missing.len();
        self.tell(Event::Pieces(Pieces {
            axes: sweep.axes().clone(),
            missing,
            reply,
        }));
        for (piece, values) in solved {
            observer.advance(sweep.points());
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

/// Tells the end of the generation when it is dropped, after a panic too.
struct End<'a>(&'a Told);

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.0.tell(Event::End);
    }
}

impl Observer for Told {
    fn begin(&self, what: &'static str, points: usize, finished: usize) {
        let (go, told) = channel();
        self.tell(Event::Begin(what, points, finished, go));
        // Nothing advances until the caller has taken the stage. Without an answer it has an
        // exception, and has interrupted the generation.
        let _ = told.recv();
    }

    fn advance(&self, points: usize) {
        self.advanced.fetch_add(points, Ordering::Relaxed);
    }

    fn note(&self, text: &str) {
        self.tell(Event::Note(text.to_owned()));
    }

    fn is_interrupted(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed)
    }
}

/// The side of the caller.
struct Listener<'a> {
    told: &'a Told,
    events: Mutex<Receiver<Event>>,
    /// Called with the stage, the number of its points, and that of the finished ones.
    progress: Option<&'a Bound<'a, PyAny>>,
    /// Called with a sentence.
    note: &'a Bound<'a, PyAny>,
    /// Called with the names and the nodes of the axes, and the numbers of the pieces. Returns an
    /// iterator over pairs of a number and its values.
    pieces: Option<&'a Bound<'a, PyAny>>,
    stage: Option<(&'static str, usize)>,
    finished: usize,
}

impl Listener<'_> {
    /// Waits for the end of the generation, which an exception interrupts.
    fn listen(&mut self, py: Python<'_>) -> PyResult<()> {
        let heard = self.attend(py);
        if heard.is_err() {
            // The piece that is being solved is finished and kept.
            while !matches!(self.next(py), Some(Event::End)) {}
        }
        heard
    }

    /// Handles events until the end, or until Python raises.
    fn attend(&mut self, py: Python<'_>) -> PyResult<()> {
        loop {
            py.check_signals().inspect_err(|_| self.interrupt())?;
            let event = self.next(py);
            let heard = self.report().and_then(|()| match &event {
                Some(Event::Pieces(pieces)) => self.solve(py, pieces),
                Some(event) => self.hear(event),
                None => Ok(()),
            });
            // Before the event is dropped, which lets the generation go on.
            heard.inspect_err(|_| self.interrupt())?;
            if matches!(event, Some(Event::End)) {
                return Ok(());
            }
        }
    }

    /// Lets the generation end after the piece that is being solved.
    fn interrupt(&self) {
        self.told.interrupted.store(true, Ordering::Relaxed);
    }

    /// Returns the next event; none within a [`TICK`].
    fn next(&self, py: Python<'_>) -> Option<Event> {
        let events = &self.events;
        py.detach(|| {
            let events = events.lock().unwrap_or_else(PoisonError::into_inner);
            events.recv_timeout(TICK).ok()
        })
    }

    /// Takes a stage or a sentence.
    fn hear(&mut self, event: &Event) -> PyResult<()> {
        match event {
            Event::Begin(stage, points, finished, go) => {
                (self.stage, self.finished) = (Some((*stage, *points)), *finished);
                self.tell_progress()?;
                // The generation listens, unless it has panicked.
                let _ = go.send(());
                Ok(())
            }
            Event::Note(text) => self.note.call1((text,)).map(drop),
            Event::Pieces(_) | Event::End => Ok(()),
        }
    }

    /// Tells the progress if there is any.
    fn report(&mut self) -> PyResult<()> {
        let advanced = self.told.advanced.swap(0, Ordering::Relaxed);
        if advanced == 0 {
            return Ok(());
        }
        self.finished += advanced;
        self.tell_progress()
    }

    fn tell_progress(&self) -> PyResult<()> {
        if let (Some(progress), Some((stage, points))) = (self.progress, self.stage) {
            progress.call1((stage, points, self.finished.min(points)))?;
        }
        Ok(())
    }

    /// Lets Python solve pieces.
    fn solve(&mut self, py: Python<'_>, pieces: &Pieces) -> PyResult<()> {
        let Some(call) = self.pieces else {
            return Ok(());
        };
        let axes = nodes(&pieces.axes);
        for solved in call.call1((axes, pieces.missing.clone()))?.try_iter()? {
            let (piece, values): (usize, PyReadonlyArray1<'_, f64>) = solved?.extract()?;
            if pieces
                .reply
                .send((piece, values.as_slice()?.to_vec()))
                .is_err()
            {
                // The generation has ended by an error, which it tells next.
                break;
            }
            py.check_signals()?;
            self.report()?;
        }
        Ok(())
    }
}

/// Returns the names and the nodes of axes.
fn nodes(axes: &[(Parameter, Vec<f64>); 4]) -> Vec<(&'static str, Vec<f64>)> {
    axes.iter()
        .map(|(parameter, nodes)| (parameter.name(), nodes.clone()))
        .collect()
}

/// Generates the table of a scene and writes its file.
#[pyfunction]
pub fn generate(
    py: Python<'_>,
    given: &Bound<'_, PyAny>,
    progress: Option<&Bound<'_, PyAny>>,
    note: &Bound<'_, PyAny>,
    pieces: Option<&Bound<'_, PyAny>>,
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
    let (sender, receiver) = channel();
    let told = Told {
        events: Mutex::new(sender),
        advanced: AtomicUsize::new(0),
        interrupted: AtomicBool::new(false),
    };
    let mut listener = Listener {
        told: &told,
        events: Mutex::new(receiver),
        progress,
        note,
        pieces,
        stage: None,
        finished: 0,
    };
    let is_elsewhere = pieces.is_some();
    let outcome = thread::scope(|scope| {
        let (told, scene, path) = (&told, &scene, &given.path);
        let generation = scope.spawn(move || {
            let _end = End(told);
            if is_elsewhere {
                let elsewhere = |sweep: &Sweep<'_>,
                                 missing: &[usize],
                                 observer: &dyn Observer,
                                 keep: Keep<'_>| {
                    told.solve(sweep, missing, observer, keep)
                };
                generate_with(scene, path, &options, told, &elsewhere)
            } else {
                generate_with(scene, path, &options, told, &here)
            }
        });
        listener.listen(py)?;
        Ok::<_, PyErr>(
            generation
                .join()
                .unwrap_or_else(|panic| resume_unwind(panic)),
        )
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
