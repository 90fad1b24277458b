//! From a scene to the file of its certified table, whatever happens on the way.
//!
//! ```text
//! plan -> sweep, a piece at a time into the journal -> certify -> refine the plan and sweep again, or write the file
//! ```

use std::path::Path;
use std::time::{Duration, Instant};

use interp::Parameter;
use interp::{Certificate, Description, Table};

use crate::parallel::try_map;
use crate::table::archive;
use crate::table::certify::{Sample, certificate, measure, sample};
use crate::table::journal::{Header, Journal, beside};
use crate::table::plan::Plan;
use crate::table::scene::Scene;
use crate::table::sweep::Sweep;
use crate::{Error, output};

/// How a table is generated.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// How many points the certificate rests on, one or more.
    pub certificate_points: usize,
    /// The seed of its random points.
    pub seed: u64,
    /// Go on from the finished pieces of a generation that was interrupted.
    pub resume: bool,
    /// Stop when this time is over, with what is finished.
    pub budget: Option<Duration>,
}

/// Told what a generation does.
pub trait Observer: Sync {
    /// Something with so many points begins, of which so many are finished already.
    fn begin(&self, what: &'static str, points: usize, finished: usize);
    /// So many points more are finished; called from any thread.
    fn advance(&self, points: usize);
    /// Something that the user should know.
    fn note(&self, text: &str);
}

/// A table, and how it came about.
#[derive(Debug)]
pub struct Generated {
    /// The table with its certificate, as it is written in the file.
    pub table: Table,
    /// The certificates of the tables before, which exceeded the tolerance, and the nodes they had.
    pub refined: Vec<([usize; 4], Certificate)>,
    /// Points solved for the nodes, refined away ones included.
    pub points: usize,
    /// How many of them an interrupted generation had solved.
    pub resumed: usize,
    /// Time until the table was solved, without the certificate, since the start of this process's
    /// share.
    pub solved: Duration,
}

/// The ending of the table until it is complete. It is shorter than the journal's, so that a name
/// too long for the one is too long for the other.
const UNFINISHED: &str = "partial";

/// More rounds than this mean that refining does not help.
const MOST_ROUNDS: usize = 5;

/// The part of the tolerance that a refined axis is to leave of its error; and the part of the
/// largest share from which on an axis is refined.
const AIM: f64 = 0.5;

/// The errors of splines of degree 9 fall like `n^-10` with the nodes; nodes for a little less are
/// enough more.
const ORDER: f64 = 8.0;

/// How many of the worst points say which axes hold the error.
const SUSPECTS: usize = 24;

/// Solves every node of a scene, measures the accuracy, refines the axes that hold the error until
/// it is within the tolerance, and writes the file.
///
/// The file is a function of the scene, the certificate's points and seed, and this program alone:
/// not of the number of threads, nor of how often the generation was killed and resumed. Until it
/// is complete, `path` is not touched.
///
/// A table whose error exceeds the tolerance, because its nodes are stated or the budget does not
/// allow another round, is written too: compare its certificate with the tolerance.
///
/// # Errors
/// [`Error::Busy`] if another process generates the same file; [`Error::OtherRun`] if the finished
/// pieces belong to another scene, or a refined plan to another certificate; [`Error::Budget`] if
/// the budget ends before all is solved; [`Error::Write`] for a file that cannot be written; those
/// of the solve and of [`Plan::new`]. Finished pieces are kept.
///
/// # Panics
/// If the certificate is to rest on no point.
pub fn generate(
    scene: &Scene,
    path: &Path,
    options: &Options,
    observer: &dyn Observer,
) -> Result<Generated, Error> {
    assert!(options.certificate_points > 0, "a certificate needs points");
    // Two links to one file are one output, and a file is not renamed from one disk to another.
    let path = &output::behind_links(path)?;
    if std::path::absolute(path).is_ok_and(|path| path.to_str().is_none()) {
        let source = std::io::Error::other("its name or folder is no UTF-8, which HDF5 needs");
        return Err(Error::Write {
            path: path.clone(),
            source,
        });
    }
    let mut journal = Journal::open(path)?;
    let outcome = run(scene, path, options, observer, &mut journal);
    match &outcome {
        // It is another run's, or what is finished is of use to `--resume`.
        Err(Error::OtherRun { .. }) => {}
        Err(_) if journal.finished() > 0 => {}
        _ => journal.remove()?,
    }
    outcome
}

fn run(
    scene: &Scene,
    path: &Path,
    options: &Options,
    observer: &dyn Observer,
    journal: &mut Journal,
) -> Result<Generated, Error> {
    let start = Instant::now();
    let deadline = options.budget.map(|budget| start + budget);
    let mut resumed = 0;
    if options.resume && journal.is_unreadable() {
        return Err(Error::OtherRun {
            journal: Journal::path(path),
            what: "with a header that cannot be read".into(),
        });
    }
    let (mut round, mut plan) = match journal.header().filter(|_| options.resume).cloned() {
        Some(header) => {
            same_run(&header, scene, path, options)?;
            let pieces = header.plan.shape()[0];
            let points = header.plan.points() / pieces;
            journal.keep(pieces, points * scene.quantities.len());
            resumed = journal.finished() * points;
            (header.round, header.plan)
        }
        None => {
            if journal.finished() > 0 {
                observer.note("the finished pieces of an interrupted run are dropped: it would have gone on with --resume");
            }
            let plan = Plan::until(scene, deadline)?;
            journal.begin(header(scene, 0, &plan, options))?;
            (0, plan)
        }
    };
    let (mut refined, mut points) = (Vec::new(), 0);
    loop {
        let began = Instant::now();
        let axes = plan.axes();
        let sweep = Sweep::new(scene, &axes)?;
        solve(&sweep, journal, observer, deadline)?;
        points += plan.points();
        let solved = start.elapsed();
        let mut values = sweep.blank();
        for piece in 0..sweep.pieces() {
            sweep.place(&mut values, piece, &journal.values(piece, sweep.values())?);
        }
        let mut table = Table::new(description(scene, &axes)?, axes.clone(), values)?;
        observer.begin("checking", options.certificate_points, 0);
        let samples = measure(&table, options.certificate_points, options.seed, &|count| {
            observer.advance(count)
        })?;
        let certificate = certificate(&samples, options.seed);
        let next = if certificate.max_error <= scene.tolerance || round == MOST_ROUNDS {
            None
        } else {
            match plan.refined(factors(&table, samples)?, scene) {
                // The table that there is, is better than none.
                Err(error @ (Error::TooLarge { .. } | Error::Unresolved { .. })) => {
                    observer.note(&error.to_string());
                    None
                }
                refined => refined?,
            }
        };
        // The next round takes longer than this one by its points.
        let longer = |next: &Plan| {
            began
                .elapsed()
                .mul_f64(next.points() as f64 / plan.points() as f64)
        };
        match next.filter(|next| {
            deadline.is_none_or(|deadline| Instant::now() + longer(next) <= deadline)
        }) {
            Some(next) => {
                refined.push((plan.shape(), certificate));
                round += 1;
                plan = next;
                journal.go_on(header(scene, round, &plan, options))?;
            }
            None => {
                table.set_certificate(certificate);
                archive::write_through(&table, path, &beside(path, UNFINISHED))?;
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

/// Solves the pieces that the journal does not hold.
fn solve(
    sweep: &Sweep,
    journal: &mut Journal,
    observer: &dyn Observer,
    deadline: Option<Instant>,
) -> Result<(), Error> {
    let total = sweep.pieces() * sweep.points();
    observer.begin("solving", total, journal.finished() * sweep.points());
    for piece in 0..sweep.pieces() {
        if journal.holds(piece) {
            continue;
        }
        let solved = sweep.solve(piece, &|count| observer.advance(count))?;
        journal.add(piece, &solved)?;
        // After a piece, so that the smallest budget gets further.
        let finished = journal.finished();
        if finished < sweep.pieces() && deadline.is_some_and(|deadline| Instant::now() >= deadline)
        {
            let finished = finished * sweep.points();
            let spent = format!(
                "with {finished} of {total} points solved; they are kept, and --resume goes on from there"
            );
            return Err(Error::Budget { spent });
        }
    }
    Ok(())
}

/// How many times as many nodes each axis wants, to judge by the worst points.
///
/// At each of them the table is compared with the solve once more where all parameters but one
/// stand on a node: what error is left is that axis's.
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
    let mut shares = [0.0_f64; 4];
    for parameter in Parameter::ALL
        .into_iter()
        .filter(|&parameter| table.axis(parameter).len() > 1)
    {
        let error = |suspect: &Sample| -> Result<f64, Error> {
            let mut point = Parameter::ALL.map(|other| snap(other, suspect.point[other as usize]));
            point[parameter as usize] = suspect.point[parameter as usize];
            Ok(sample(table, point)?.error)
        };
        shares[parameter as usize] = try_map(&samples, error)?.into_iter().fold(0.0, f64::max);
    }
    let largest = shares.into_iter().fold(0.0, f64::max);
    let factor = (samples[0].error / (AIM * tolerance)).powf(1.0 / ORDER);
    Ok(shares.map(|share| if share >= AIM * largest { factor } else { 1.0 }))
}

fn header(scene: &Scene, round: usize, plan: &Plan, options: &Options) -> Header {
    Header {
        created_by: created_by(),
        scene: scene.text.clone(),
        tolerance: scene.tolerance,
        certificate_points: options.certificate_points,
        seed: options.seed.cast_signed(),
        round,
        plan: plan.clone(),
    }
}

/// Accepts the header of an unfinished generation if it is of this scene by this program and, once
/// refined, for the same certificate.
fn same_run(header: &Header, scene: &Scene, path: &Path, options: &Options) -> Result<(), Error> {
    let what = if header.created_by != created_by() {
        format!("by {}, and this is {}", header.created_by, created_by())
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
            "and refined with --certificate-points {points} --seed {seed}, and this is {} and {}",
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

fn created_by() -> String {
    format!("tabulate {}", env!("CARGO_PKG_VERSION"))
}

/// The description of a table before its certificate is measured.
fn description(scene: &Scene, axes: &[Vec<f64>; 4]) -> Result<Description, Error> {
    Ok(Description {
        title: scene.title.clone(),
        scene: scene.text.clone(),
        nu0: scene.nu0,
        normalisation: scene
            .material([axes[1][0], axes[2][0], axes[3][0]])?
            .normalisation(),
        tolerance: scene.tolerance,
        created_by: created_by(),
        certificate: Certificate::UNMEASURED,
    })
}
