//! From a scene to the file of its certified table, also through interruptions.
//!
//! ```text
//! plan -> sweep, a piece at a time into the journal -> certify -> refine the plan and sweep again, or write the file
//! ```

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use interp::{Certificate, Parameter, Table};

use crate::table::budget::Budget;
use crate::table::certify::{Sample, certificate, measure, sample};
use crate::table::journal::{Header, Journal};
use crate::table::plan::Plan;
use crate::table::scene::{Scene, created_by};
use crate::table::sweep::Sweep;
use crate::table::{build, file};
use crate::{Error, output};
use solve::larger;
use solve::parallel::try_map;

/// The settings of a generation.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// The number of points of the certificate, one or more.
    pub certificate_points: usize,
    /// The seed of the random points of the certificate.
    pub seed: u64,
    /// Whether to go on from the finished pieces of an interrupted generation.
    pub resume: bool,
    /// When to stop, with the pieces that are finished.
    pub budget: Option<Budget<'a>>,
}

/// Follows the progress of a generation.
pub trait Observer: Sync {
    /// Tells that the stage `what` begins, with `points` points, of which `finished` are finished
    /// already.
    fn begin(&self, what: &'static str, points: usize, finished: usize);
    /// Tells that `points` more points are finished. Called from any thread.
    fn advance(&self, points: usize);
    /// Tells that `kept` of the `points` points of the nodes are on the disk, from where a resumed
    /// generation goes on.
    fn kept(&self, _kept: usize, _points: usize) {}
    /// Tells the user something in words.
    fn note(&self, text: &str);
    /// Returns whether the generation is to end with [`Error::Interrupted`], with the finished
    /// pieces kept. Asked after each piece, and before a table is written.
    fn is_interrupted(&self) -> bool {
        false
    }
}

/// Keeps the values of a finished piece, given by its number.
pub type Keep<'a> = &'a mut dyn FnMut(usize, &[f64]) -> Result<(), Error>;

/// Solves the given pieces of a sweep in any order, [`here`] or elsewhere: tells the observer of finished points, and hands
/// the values of each piece to [`Keep`], as [`Sweep::solve`] returns them. The first error ends the work.
pub type Solver<'a> =
    &'a dyn Fn(&Sweep<'_>, &[usize], &dyn Observer, Keep<'_>) -> Result<(), Error>;

/// Solves the pieces `missing` one after the other, each on all cores of this machine.
///
/// # Errors
/// The first of a solve or of `keep`.
pub fn here(
    sweep: &Sweep<'_>,
    missing: &[usize],
    observer: &dyn Observer,
    keep: Keep<'_>,
) -> Result<(), Error> {
    for &piece in missing {
        let solved = sweep.solve(piece, &|count| observer.advance(count))?;
        keep(piece, &solved)?;
    }
    Ok(())
}

/// A finished table and the numbers of its generation.
#[derive(Debug)]
pub struct Generated {
    /// The table with its certificate, as in the file.
    pub table: Table,
    /// The numbers of nodes and the certificate of each earlier round, whose error exceeded the
    /// tolerance.
    pub refined: Vec<([usize; 4], Certificate)>,
    /// The number of points solved for the nodes, in all rounds.
    pub points: usize,
    /// The number of them that an interrupted generation had solved.
    pub resumed: usize,
    /// The time until the table was solved, without the last certificate, in this process.
    pub solved: Duration,
}

/// The largest number of refinements. More of them would not help.
const MOST_ROUNDS: usize = 5;

/// The error that a refined axis is to leave, in parts of the tolerance; and the error from which
/// on an axis is refined, in parts of the largest error of an axis.
const AIM: f64 = 0.5;

/// The order at which the error is taken to fall with the number `n` of nodes. Errors of splines of
/// degree 9 fall like `n^-10`; a smaller order adds a few nodes more than needed.
const ORDER: f64 = 8.0;

/// The number of the worst points at which the error of each axis is measured.
const SUSPECTS: usize = 24;

/// Solves every node of a scene, measures the accuracy, refines the axes that hold the error until
/// it is within the tolerance, and writes the file: packed to a name that ends in `.bin`, else
/// HDF5.
///
/// The file depends on the scene, the certificate's points and seed, and this build of the program
/// on this kind of processor alone. It does not depend on the number of threads, or on
/// interruptions. Until the new file is complete, an existing one at `path` is not touched.
///
/// A table whose error exceeds the tolerance, because the scene states its nodes or the budget does
/// not allow another round, is written too: compare its certificate with the tolerance.
///
/// # Errors
/// [`Error::Busy`] if another process generates the same file; [`Error::Kept`] if it would drop the
/// finished pieces of an interrupted generation that is not resumed; [`Error::OtherRun`] if the finished
/// pieces belong to another scene, build or processor, or a refined plan to another certificate;
/// [`Error::Budget`] if the budget is spent before all is solved; [`Error::Interrupted`] if the
/// observer ends it; [`Error::Write`] for a file that cannot be written, or an HDF5 file from a
/// program that was built without the feature `hdf5`; those of the solve and of [`Plan::new`].
/// Finished pieces are kept.
///
/// # Panics
/// If `certificate_points` is 0.
pub fn generate(
    scene: &Scene,
    path: &Path,
    options: &Options<'_>,
    observer: &dyn Observer,
) -> Result<Generated, Error> {
    generate_with(scene, path, options, observer, &here)
}

/// Generates like [`generate`], with the pieces of each sweep solved by `solver`. The certificate
/// is measured in this process.
///
/// # Errors
/// Those of [`generate`] and of the solver; [`Error::Piece`] for a piece with a wrong number of
/// values.
///
/// # Panics
/// If `certificate_points` is 0.
pub fn generate_with(
    scene: &Scene,
    path: &Path,
    options: &Options<'_>,
    observer: &dyn Observer,
    solver: Solver<'_>,
) -> Result<Generated, Error> {
    assert!(options.certificate_points > 0, "a certificate needs points");
    // Two links to one file are one output. A file cannot be renamed from one disk to another.
    let path = &output::behind_links(path)?;
    file::check(path)?;
    for removed in output::tidy(path) {
        observer.note(&output::removed(&removed));
    }
    let mut journal = Journal::open(path)?;
    let outcome = run(scene, path, options, (observer, solver), &mut journal);
    match &outcome {
        // The journal belongs to another run, or its pieces are of use to a resumed one.
        Err(Error::OtherRun { .. } | Error::Kept { .. }) => {}
        Err(_) if journal.finished() > 0 => {}
        _ => journal.remove()?,
    }
    outcome
}

fn run(
    scene: &Scene,
    path: &Path,
    options: &Options<'_>,
    (observer, solver): (&dyn Observer, Solver<'_>),
    journal: &mut Journal,
) -> Result<Generated, Error> {
    let start = Instant::now();
    let budget = options.budget;
    let (mut round, mut plan) = match resumed_plan(scene, path, options, journal)? {
        Some(resumed) => resumed,
        None => {
            refuse_to_drop(journal, path)?;
            let plan = Plan::within(scene, budget)?;
            journal.begin(header(scene, 0, &plan, options))?;
            (0, plan)
        }
    };
    let resumed = journal.finished() * (plan.points() / plan.nodes[0]);
    let (mut refined, mut points) = (Vec::new(), 0);
    loop {
        let began = budget.map(|budget| budget.now());
        let mut table = table(scene, &plan, journal, (observer, solver), budget)?;
        points += plan.points();
        let solved = start.elapsed();
        observer.begin("checking", options.certificate_points, 0);
        let samples = measure(&table, options.certificate_points, options.seed, &|count| {
            observer.advance(count)
        })?;
        let certificate = certificate(&samples, options.seed);
        interruption(observer, plan.points(), plan.points())?;
        let next = if certificate.max_error <= scene.tolerance || round == MOST_ROUNDS {
            None
        } else {
            match plan.refined(factors(&table, samples)?, scene) {
                // This table is better than none.
                Err(error @ Error::Nodes(_)) => {
                    observer.note(&error.to_string());
                    None
                }
                refined => refined?,
            }
        };
        // The next round takes longer than this one in proportion to its points.
        let is_affordable = |next: &Plan| {
            budget.zip(began).is_none_or(|(budget, began)| {
                let longer = next.points() as f64 / plan.points() as f64;
                budget.now().saturating_sub(began).mul_f64(longer) <= budget.left()
            })
        };
        match next.filter(is_affordable) {
            Some(next) => {
                refined.push((plan.nodes, certificate));
                round += 1;
                plan = next;
                journal.go_on(header(scene, round, &plan, options))?;
            }
            None => {
                table.set_certificate(certificate);
                file::write(&table, path)?;
                return Ok(Generated {
                    table,
                    refined,
                    points,
                    resumed,
                    solved,
                });
            }
        }
    }
}

/// Returns the round and the plan of the interrupted generation to go on from, and drops records of
/// the journal that are no pieces of it; none if the generation begins anew.
fn resumed_plan(
    scene: &Scene,
    path: &Path,
    options: &Options<'_>,
    journal: &mut Journal,
) -> Result<Option<(usize, Plan)>, Error> {
    if !options.resume {
        return Ok(None);
    }
    if journal.is_unreadable() {
        return Err(Error::OtherRun {
            journal: Journal::path(path),
            what: "with a header that cannot be read".into(),
        });
    }
    let Some(header) = journal.header().cloned() else {
        return Ok(None);
    };
    same_run(&header, scene, path, options)?;
    let pieces = header.plan.nodes[0];
    let values = header.plan.points() / pieces * scene.quantities.len();
    journal.keep(pieces, values);
    Ok(Some((header.round, header.plan)))
}

/// Returns the file that keeps the finished pieces of a table until it is complete.
///
/// # Errors
/// [`Error::Write`] if the table is something other than a file, or a link to nothing.
pub fn journal_of(table: &Path) -> Result<PathBuf, Error> {
    Ok(Journal::path(&output::behind_links(table)?))
}

/// Accepts a journal without pieces. Those of an interrupted generation may have taken days.
fn refuse_to_drop(journal: &Journal, path: &Path) -> Result<(), Error> {
    let what = if journal.is_unreadable() {
        "pieces with a header that cannot be read".to_owned()
    } else if journal.finished() > 0 {
        format!("{} finished pieces", journal.finished())
    } else {
        return Ok(());
    };
    Err(Error::Kept {
        journal: Journal::path(path),
        what,
    })
}

/// Solves the nodes of a plan and returns their table, without a certificate.
fn table(
    scene: &Scene,
    plan: &Plan,
    journal: &mut Journal,
    by: (&dyn Observer, Solver<'_>),
    budget: Option<Budget<'_>>,
) -> Result<Table, Error> {
    let axes = plan.axes(scene);
    let sweep = Sweep::new(scene, &axes)?;
    solve(&sweep, journal, by, budget)?;
    let mut values = sweep.blank();
    for piece in 0..sweep.pieces() {
        sweep.place(&mut values, piece, &journal.values(piece, sweep.values())?);
    }
    Ok(Table::new(scene.description(), axes.clone(), values)?)
}

/// Solves the pieces that the journal does not hold yet.
fn solve(
    sweep: &Sweep<'_>,
    journal: &mut Journal,
    (observer, solver): (&dyn Observer, Solver<'_>),
    budget: Option<Budget<'_>>,
) -> Result<(), Error> {
    let total = sweep.pieces() * sweep.points();
    let kept = journal.finished() * sweep.points();
    observer.begin("solving", total, kept);
    observer.kept(kept, total);
    let missing: Vec<usize> = (0..sweep.pieces())
        .filter(|&piece| !journal.holds(piece))
        .collect();
    solver(sweep, &missing, observer, &mut |piece, solved| {
        if solved.len() != sweep.values() {
            return Err(Error::Piece(format!(
                "piece {piece} of the sweep came back with {} values instead of {}: solve the pieces by the same version of this program",
                solved.len(),
                sweep.values()
            )));
        }
        journal.add(piece, solved)?;
        // After a piece, so that the smallest budget finishes one.
        let finished = journal.finished() * sweep.points();
        observer.kept(finished, total);
        interruption(observer, finished, total)?;
        if finished < total && budget.is_some_and(|budget| budget.is_spent()) {
            let spent = format!(
                "with {finished} of {total} points solved; they are kept, and a resumed generation goes on from them"
            );
            return Err(Error::Budget { spent });
        }
        Ok(())
    })
}

/// Returns an error if the observer ends the generation.
fn interruption(observer: &dyn Observer, finished: usize, total: usize) -> Result<(), Error> {
    if observer.is_interrupted() {
        Err(Error::Interrupted { finished, total })
    } else {
        Ok(())
    }
}

/// Returns the factors by which each axis needs more nodes, judged by the worst points.
///
/// At each of these points the table is compared with the solve once more where all parameters but
/// one stand on a node. The error that is left there belongs to the axis of that one.
fn factors(table: &Table, mut samples: Vec<Sample>) -> Result<[f64; 4], Error> {
    samples.sort_by(|a, b| b.error.total_cmp(&a.error));
    samples.truncate(SUSPECTS);
    let snap = |parameter: Parameter, value: f64| {
        let nodes = table.axis(parameter);
        let distance =
            |node: &&f64| (parameter.coordinate(**node) - parameter.coordinate(value)).abs();
        nodes
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .copied()
            .unwrap_or(value)
    };
    let tolerance = table.description().tolerance;
    let mut shares = [0.0; 4];
    for parameter in table
        .parameters()
        .into_iter()
        .filter(|&parameter| table.axis(parameter).len() > 1)
    {
        let errors = try_map(&samples, |suspect| {
            let mut point = table
                .parameters()
                .map(|other| snap(other, suspect.point[other.dimension()]));
            point[parameter.dimension()] = suspect.point[parameter.dimension()];
            Ok::<f64, Error>(sample(table, point)?.error)
        })?;
        shares[parameter.dimension()] = errors.into_iter().fold(0.0, larger);
    }
    let largest = shares.into_iter().fold(0.0, larger);
    let factor = (samples[0].error / (AIM * tolerance)).powf(1.0 / ORDER);
    Ok(shares.map(|share| if share >= AIM * largest { factor } else { 1.0 }))
}

fn header(scene: &Scene, round: usize, plan: &Plan, options: &Options<'_>) -> Header {
    Header {
        created_by: created_by(),
        build: build::name(),
        scene: scene.text.clone(),
        tolerance: scene.tolerance,
        certificate_points: options.certificate_points,
        seed: options.seed.cast_signed(),
        round,
        plan: plan.clone(),
    }
}

/// Accepts the header of an unfinished generation if it is of this scene and program and, when the
/// plan is refined, of a certificate with this number of points and seed.
fn same_run(
    header: &Header,
    scene: &Scene,
    path: &Path,
    options: &Options<'_>,
) -> Result<(), Error> {
    let what = if header.created_by != created_by() {
        format!("by {}, and this is {}", header.created_by, created_by())
    } else if header.build != build::name() {
        format!(
            "by another build or on another processor, {}, and this is {}, whose last digits may differ",
            header.build,
            build::name()
        )
    } else if header.tolerance != scene.tolerance {
        format!(
            "with tolerance = {:?}, and this is {:?}",
            header.tolerance, scene.tolerance
        )
    } else if header.scene != scene.text {
        "from another text of the scene".into()
    } else if !header.plan.fits(scene) {
        "with nodes that are not the scene's".into()
    } else if header.round > 0
        && (header.certificate_points, header.seed.cast_unsigned())
            != (options.certificate_points, options.seed)
    {
        let (points, seed) = (header.certificate_points, header.seed.cast_unsigned());
        format!(
            "and refined with certificate_points = {points} and seed = {seed}, and these are {} and {}",
            options.certificate_points, options.seed
        )
    } else {
        return Ok(());
    };
    Err(Error::OtherRun {
        journal: Journal::path(path),
        what,
    })
}
