//! A table: its tolerance against nodes, solves, time, bytes and certified error, and from how many
//! evaluations on it is worth its making.

use std::hint::black_box;
use std::time::{Duration, Instant};

use interp::{Curve, LowRank, Material, Quantities, Quantity, Table};
use serde::{Deserialize, Serialize};

use super::clock;
use crate::Error;
use crate::solve;
use crate::table::Plan;
use crate::table::Scene;
use crate::table::low_rank;
use crate::table::{Budget, Observer, Options, generate};
use crate::table::{default_points, points_for};

/// The tolerances of the rows, as far as the budget allows them.
pub const TOLERANCES: [f64; 7] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// One table of a scene, and what it is compared with. Times of single evaluations are means over
/// random points of the scene, on one thread.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Relative tolerance of the table, of its packed form and of the direct solves.
    pub tolerance: f64,
    /// Nodes of `a_over_t`.
    pub a_over_t_nodes: u64,
    /// Nodes of `e1_over_e2`.
    pub e1_over_e2_nodes: u64,
    /// Nodes of `nu1`.
    pub nu1_nodes: u64,
    /// Nodes of `e0_over_e2`.
    pub e0_over_e2_nodes: u64,
    /// Contacts solved for the nodes, refined away ones included.
    pub solves: u64,
    /// Threads that made the table and packed it.
    pub threads: u64,
    /// Time until the HDF5 file was there, planning and certificate included.
    pub seconds: f64,
    /// Size of the HDF5 file.
    pub dense_bytes: u64,
    /// Its certified error.
    pub dense_error: f64,
    /// Time to pack it, certificate included.
    pub pack_seconds: f64,
    /// Size of the low-rank form.
    pub packed_bytes: u64,
    /// Its certified error.
    pub packed_error: f64,
    /// The first of the low-rank form's ranks.
    pub rank_1: u64,
    /// The second one.
    pub rank_2: u64,
    /// The third one.
    pub rank_3: u64,
    /// Time of a direct solve to the tolerance.
    pub solve_seconds: f64,
    /// Time to look up the curve of a material in the packed table.
    pub curve_seconds: f64,
    /// Time to look up a point on such a curve.
    pub point_seconds: f64,
    /// [`break_even`] if each evaluation is of a material of its own.
    pub break_even_alone: f64,
    /// [`break_even`] if each evaluation is a further point of a material whose curve has been
    /// looked up.
    pub break_even_along: f64,
}

impl Row {
    /// The number of nodes on each axis.
    pub const fn nodes(&self) -> [u64; 4] {
        [
            self.a_over_t_nodes,
            self.e1_over_e2_nodes,
            self.nu1_nodes,
            self.e0_over_e2_nodes,
        ]
    }

    /// The most processor time that making and packing can have taken (s): that of threads that are
    /// never idle.
    pub const fn making(&self) -> f64 {
        self.threads as f64 * (self.seconds + self.pack_seconds)
    }
}

/// From how many evaluations on a table has taken less processor time than direct solves:
/// `making / (solve - lookup)`, all in seconds; infinite where a solve takes no longer than a
/// lookup.
pub fn break_even(making: f64, solve: f64, lookup: f64) -> f64 {
    if solve > lookup {
        making / (solve - lookup)
    } else {
        f64::INFINITY
    }
}

/// The rows that were measured, and why there are no more.
#[derive(Clone, Debug)]
pub struct Measured {
    /// From the loosest tolerance on.
    pub rows: Vec<Row>,
    /// The first of the [`TOLERANCES`] that has no row, and why.
    pub left_out: Option<(f64, String)>,
}

/// Makes the tables of a scene, whose own tolerance plays no part, one after the other as long as
/// they fit in the budget.
///
/// How long the next one takes is predicted by its planned nodes, the points of its two
/// certificates, and what each of these took in the last one. One that is still solving when the
/// budget ends is given up.
///
/// # Errors
/// Where not even the first table can be made, those of [`generate`] and [`low_rank`];
/// [`Error::Write`] for temporary files that cannot be written.
pub fn measure(
    scene: &Scene,
    budget: Duration,
    observer: &dyn Observer,
) -> Result<Measured, Error> {
    let deadline = Instant::now() + budget;
    let mut rows = Vec::new();
    let mut seconds_per_point = 0.0;
    for tolerance in TOLERANCES {
        let scene = Scene {
            tolerance,
            ..scene.clone()
        };
        let began = Instant::now();
        match row_before(deadline, &scene, seconds_per_point, observer) {
            Ok(row) => {
                seconds_per_point =
                    began.elapsed().as_secs_f64() / points(&scene, row.nodes().iter().product());
                rows.push(row);
            }
            Err(Error::Budget { spent }) => {
                let budget = budget.as_secs_f64();
                let why = format!("the budget of {budget:?} s is spent {spent}");
                if rows.is_empty() {
                    return Err(Error::Budget {
                        spent: format!("{spent}: it was {budget:?} s"),
                    });
                }
                return Ok(Measured {
                    rows,
                    left_out: Some((tolerance, why)),
                });
            }
            Err(error) if !rows.is_empty() && is_limit(&error) => {
                return Ok(Measured {
                    rows,
                    left_out: Some((tolerance, error.to_string())),
                });
            }
            Err(error) => return Err(error),
        }
    }
    Ok(Measured {
        rows,
        left_out: None,
    })
}

/// Whether an error says that a tolerance is out of reach, rather than that something is broken.
const fn is_limit(error: &Error) -> bool {
    use Error::{NoRoom, NotConverged, Packed, TooLarge, Truncation, Unresolved};
    matches!(
        error,
        NoRoom { .. }
            | NotConverged { .. }
            | Packed { .. }
            | TooLarge { .. }
            | Truncation { .. }
            | Unresolved { .. }
    )
}

/// The row of a scene with its tolerance, if it is likely to be there before the deadline.
fn row_before(
    deadline: Instant,
    scene: &Scene,
    seconds_per_point: f64,
    observer: &dyn Observer,
) -> Result<Row, Error> {
    let left = deadline.saturating_duration_since(Instant::now());
    let plan = Plan::within(scene, Some(Budget::of(left)))?;
    let takes = seconds_per_point * points(scene, plan.points() as u64);
    let left = deadline.saturating_duration_since(Instant::now());
    if takes > left.as_secs_f64() {
        let spent = format!(
            "but for {}, and this would take some {}",
            clock::human(left.as_secs_f64()),
            clock::human(takes)
        );
        return Err(Error::Budget { spent });
    }
    row(scene, left, observer)
}

/// How many points are solved for a table with so many nodes: two certificates have theirs.
fn points(scene: &Scene, nodes: u64) -> f64 {
    nodes as f64 + 2.0 * default_points(scene.axes()) as f64
}

fn row(scene: &Scene, budget: Duration, observer: &dyn Observer) -> Result<Row, Error> {
    let Made {
        table,
        solves,
        seconds,
        bytes,
    } = Made::new(scene, Some(budget), observer)?;
    let certificate = table.description().certificate;
    let began = Instant::now();
    let packed = low_rank(
        &table,
        scene.tolerance,
        points_for(&table),
        certificate.seed + 1,
        observer,
    )?;
    let packed_bytes = packed.to_packed()?.len() as u64;
    let pack_seconds = began.elapsed().as_secs_f64();
    let [solve_seconds, curve_seconds, point_seconds] = evaluations(scene, &packed)?;
    let [
        a_over_t_nodes,
        e1_over_e2_nodes,
        nu1_nodes,
        e0_over_e2_nodes,
    ] = table.shape().map(|nodes| nodes as u64);
    let [rank_1, rank_2, rank_3] = packed
        .low_rank()
        .map_or([0; 3], LowRank::ranks)
        .map(|rank| rank as u64);
    let mut row = Row {
        tolerance: scene.tolerance,
        a_over_t_nodes,
        e1_over_e2_nodes,
        nu1_nodes,
        e0_over_e2_nodes,
        solves,
        threads: rayon::current_num_threads() as u64,
        seconds,
        dense_bytes: bytes,
        dense_error: certificate.max_error,
        pack_seconds,
        packed_bytes,
        packed_error: packed.description().certificate.max_error,
        rank_1,
        rank_2,
        rank_3,
        solve_seconds,
        curve_seconds,
        point_seconds,
        break_even_alone: f64::NAN,
        break_even_along: f64::NAN,
    };
    row.break_even_alone = break_even(row.making(), solve_seconds, curve_seconds + point_seconds);
    row.break_even_along = break_even(row.making(), solve_seconds, point_seconds);
    Ok(row)
}

/// A table that has been made, and what that took.
pub(super) struct Made {
    table: Table,
    /// Contacts solved for the nodes, refined away ones included.
    pub solves: u64,
    /// Planning and certificate included.
    pub seconds: f64,
    /// Of the HDF5 file.
    pub bytes: u64,
}

impl Made {
    /// Generates the table of a scene in a temporary file.
    pub fn new(
        scene: &Scene,
        budget: Option<Duration>,
        observer: &dyn Observer,
    ) -> Result<Self, Error> {
        let unwritable = |source| Error::Write {
            path: std::env::temp_dir(),
            source,
        };
        let folder = tempfile::tempdir().map_err(unwritable)?;
        let path = folder.path().join("table.h5");
        let options = Options {
            certificate_points: default_points(scene.axes()),
            seed: 1,
            resume: false,
            budget: budget.map(Budget::of),
        };
        let began = Instant::now();
        let generated =
            generate(scene, &path, &options, observer).map_err(|error| match error {
                Error::Budget { .. } => Error::Budget {
                    spent: format!("before the table to {:e} is finished", scene.tolerance),
                },
                error => error,
            })?;
        let seconds = began.elapsed().as_secs_f64();
        let bytes = path.metadata().map_err(unwritable)?.len();
        Ok(Self {
            table: generated.table,
            solves: generated.points as u64,
            seconds,
            bytes,
        })
    }
}

/// Random points of the scene that single evaluations are timed at.
const POINTS: usize = 300;
const SEED: u64 = 6;
/// Time spent on each kind of evaluation, but for one pass over all points, in seconds.
const PATIENCE: f64 = 0.1;

/// The mean times (s) of a direct solve to the scene's tolerance, of making the curve of a
/// material, and of a point on a curve.
fn evaluations(scene: &Scene, table: &Table) -> Result<[f64; 3], Error> {
    let points: Vec<(f64, Material)> = scene
        .random_points(POINTS, SEED)
        .into_iter()
        .map(|[a_over_t, e1, nu1, e0]| Ok((a_over_t, scene.material([e1, nu1, e0])?)))
        .collect::<Result<_, Error>>()?;
    let solve = |&(a_over_t, material): &(f64, Material)| {
        solve::solve(a_over_t, &material, scene.tolerance)
    };
    points.iter().try_for_each(|point| solve(point).map(drop))?;
    let curve = table.curve(&points[0].1)?;
    let point = |&(a_over_t, _): &(f64, Material)| look_up(&curve, &scene.quantities, a_over_t);
    points.iter().try_for_each(|at| point(at).map(drop))?;

    let each = POINTS as f64;
    Ok([
        clock::seconds(PATIENCE, || {
            points.iter().for_each(|at| drop(black_box(solve(at))))
        }) / each,
        clock::seconds(PATIENCE, || {
            points
                .iter()
                .for_each(|(_, material)| drop(black_box(table.curve(material))))
        }) / each,
        clock::seconds(PATIENCE, || {
            points.iter().for_each(|at| drop(black_box(point(at))))
        }) / each,
    ])
}

/// What a scene asks for, on a curve of its table; the values of others mean nothing.
fn look_up(curve: &Curve, wanted: &[Quantity], a_over_t: f64) -> Result<Quantities, Error> {
    if wanted == Quantity::ALL {
        return Ok(curve.quantities(a_over_t)?);
    }
    let mut values = [f64::NAN; 4];
    for &quantity in wanted {
        values[quantity as usize] = curve.quantity(quantity, a_over_t)?;
    }
    Ok(Quantities::from_array(values))
}

/// The rows as two tables of the README: what is made, and when it pays.
pub fn markdown(rows: &[Row]) -> String {
    let threads = rows.first().map_or(0, |row| row.threads);
    let mut text = format!(
        "| tolerance | nodes | solves | time, {threads} threads | .h5 | certified error | ranks | packed | certified error |\n"
    );
    text += "|---|---|---|---|---|---|---|---|---|\n";
    for row in rows {
        let joined = |numbers: &[u64], between| {
            numbers
                .iter()
                .map(u64::to_string)
                .collect::<Vec<_>>()
                .join(between)
        };
        let (nodes, ranks) = (
            joined(&row.nodes(), " × "),
            joined(&[row.rank_1, row.rank_2, row.rank_3], ", "),
        );
        let (solves, seconds) = (grouped(row.solves), clock::human(row.seconds));
        let [dense, packed] = [row.dense_bytes, row.packed_bytes].map(human_bytes);
        let Row {
            tolerance,
            dense_error,
            packed_error,
            ..
        } = row;
        text += &format!(
            "| {tolerance:e} | {nodes} | {solves} | {seconds} | {dense} | {dense_error:.1e} | {ranks} | {packed} | \
             {packed_error:.1e} |\n"
        );
    }
    text += "\n| tolerance | direct solve | curve of a new material | further point | pays from, new materials | further points |\n";
    text += "|---|---|---|---|---|---|\n";
    for row in rows {
        let [solve, curve, point] =
            [row.solve_seconds, row.curve_seconds, row.point_seconds].map(clock::human);
        let [alone, along] = [row.break_even_alone, row.break_even_along].map(human_count);
        text += &format!(
            "| {:e} | {solve} | {curve} | {point} | {alone} | {along} |\n",
            row.tolerance
        );
    }
    text += &format!(
        "\nOne solve or lookup is a mean over {POINTS} random points of the scene on one thread, lookups in the packed \
         table. A table pays from so many evaluations on, in processor time: {threads} threads making and packing it \
         against one thread solving.\n"
    );
    text
}

/// A number of evaluations, rounded.
pub(crate) fn human_count(count: f64) -> String {
    match count {
        f64::INFINITY => "never".into(),
        1e6.. => format!("{:.1} million", 1e-6 * count),
        1e3.. => grouped((1e-3 * count).round() as u64 * 1000),
        _ => format!("{count:.0}"),
    }
}

/// A number of bytes with its unit.
pub(crate) fn human_bytes(bytes: u64) -> String {
    match bytes as f64 {
        bytes @ ..1e3 => format!("{bytes} bytes"),
        bytes @ ..1e4 => format!("{:.1} kB", 1e-3 * bytes),
        bytes @ ..1e6 => format!("{:.0} kB", 1e-3 * bytes),
        bytes => format!("{:.1} MB", 1e-6 * bytes),
    }
}

/// A whole number in groups of three digits.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or_default())
        .collect();
    groups.join(",")
}
