//! The effects of a scene: the cost of each, and the error of the load without it.
//!
//! `effect` names the effects and makes the scene without one, `load` computes the error of the
//! load, `shape` that of the paraboloid and the time that the sphere itself takes, `finite_range` that
//! of JKR's pull-off and the time of its correction, `interface` a film that slides, `friction` full
//! friction, `summary` prints the rows.

mod effect;
mod finite_range;
mod friction;
mod interface;
mod load;
mod shape;
mod summary;

use std::iter;

use interp::Quantity;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};

pub use self::effect::Effect;
pub use self::finite_range::TABOR;
pub use self::friction::WIDEST;
pub use self::load::{STRENGTHS, errors};
pub use self::shape::A_OVER_R;
pub use self::summary::markdown;
use super::clock::{Times, Timing};
use super::deviation::median_and_largest;
use super::table::Made;
use crate::Error;
use crate::cost::rows::{COUNT, ERROR, Measurement, TOLERANCE};
use crate::table::{Observer, Scene};
use solve::parallel::try_map;

/// The table of a scene without one effect, the cost that this saves, and the error of the load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The effect that is left out; none in the first row.
    pub without: Option<Effect>,
    /// Relative tolerance of the tables.
    pub tolerance: f64,
    /// Number of axes of the table without the effect.
    pub axes: u64,
    /// Contacts solved for its nodes.
    pub solves: u64,
    /// Number of threads that made the table.
    pub threads: u64,
    /// Time to make the HDF5 file, including planning and certificate (s): the fastest of several
    /// runs.
    pub seconds: f64,
    /// Size of the HDF5 file.
    pub bytes: u64,
    /// Solves of the whole scene less `solves`.
    pub saved_solves: i64,
    /// Time of the whole scene less `seconds`; none if the difference is not above the noise of the
    /// two times.
    pub saved_seconds: Option<f64>,
    /// Size of the whole scene's file less `bytes`.
    pub saved_bytes: i64,
    /// Median over the scene of the error of the load, see [`errors`].
    pub median_error: f64,
    /// Largest error of the load over the scene.
    pub worst_error: f64,
    /// Time of what the effect slows down, with it over without it: to make the contact of a new
    /// material for the shape and the interface, to find a pull-off for the finite range, to solve a
    /// curve for friction. None for the effects that make the table larger instead.
    #[serde(default)]
    pub time_ratio: Option<f64>,
}

impl Measurement for Row {
    const RANGES: &'static [(&'static str, [f64; 2])] = &[
        ("tolerance", TOLERANCE),
        ("axes", [0.0, 4.0]),
        ("solves", COUNT),
        ("threads", [1.0, 1e6]),
        ("seconds", [0.0, 1e9]),
        ("bytes", COUNT),
        ("saved_solves", [-1e15, 1e15]),
        ("saved_seconds", [-1e9, 1e9]),
        ("saved_bytes", [-1e15, 1e15]),
        ("median_error", ERROR),
        ("worst_error", ERROR),
        ("time_ratio", [0.0, 1e9]),
    ];
}

/// The number of times that each table is made, in turns with the others. The fastest time counts.
const ROUNDS: usize = 3;
/// The seed of the points at which errors are measured.
const SEED: u64 = 6;

/// Makes the tables of a scene with all effects and without each of them, and compares the loads.
///
/// Loads are compared at `points` random points, evenly distributed in the axes' coordinates. The
/// strength of adhesion is evenly distributed in its logarithm, see [`STRENGTHS`]; it is 0 in a
/// scene without adhesion.
///
/// # Errors
/// [`Error::Table`] for a scene without `pi0`, which has no load; those of
/// [`generate`](crate::table::generate) and of the solve.
///
/// # Panics
/// If `points` is 0.
pub fn measure(
    scene: &Scene,
    points: usize,
    timing: Timing,
    observer: &dyn Observer,
) -> Result<Vec<Row>, Error> {
    if !scene.quantities.contains(&Quantity::Pi0) {
        return Err(interp::Error::MissingQuantity(Quantity::Pi0.name()).into());
    }
    let effects: Vec<Effect> = Effect::ALL
        .into_iter()
        .filter(|effect| effect.is_in(scene))
        .collect();
    let errors = errors_over(scene, &effects, points, observer)?;
    let others = effects.iter().filter(|effect| !effect.needs_no_table());
    let scenes: Vec<Option<Scene>> = [Some(scene.clone())]
        .into_iter()
        .chain(others.map(|effect| effect.scene_without(scene)))
        .collect();
    let costs = costs(&scenes, timing, observer)?;
    let whole = &costs[0];
    let ratio = |without: Option<Effect>| {
        Ok(match without {
            Some(Effect::Shape) => Some(shape::time_ratio(timing)?),
            Some(Effect::FiniteRange) => Some(finite_range::time_ratio(timing)?),
            Some(Effect::Interface) => Some(interface::time_ratio(timing)?),
            Some(Effect::Friction) => Some(friction::time_ratio(timing)?),
            _ => None,
        })
    };
    let without: Vec<Option<Effect>> = [None]
        .into_iter()
        .chain(effects.into_iter().map(Some))
        .collect();
    let ratios: Vec<Option<f64>> = without
        .iter()
        .map(|&without| ratio(without))
        .collect::<Result<_, Error>>()?;
    let errors = [[0.0; 2]].into_iter().chain(errors);
    // The effects that need no table are the last. Their table is that of the whole scene.
    let costs = costs.iter().chain(iter::repeat(whole));
    type Found<'a> = (((&'a Cost, Option<Effect>), [f64; 2]), Option<f64>);
    let row = |(((cost, without), [median_error, worst_error]), time_ratio): Found<'_>| Row {
        without,
        tolerance: scene.tolerance,
        axes: cost.axes,
        solves: cost.solves,
        threads: rayon::current_num_threads() as u64,
        seconds: cost.times.fastest(),
        bytes: cost.bytes,
        saved_solves: whole.solves.cast_signed() - cost.solves.cast_signed(),
        saved_seconds: match without {
            None => Some(0.0),
            Some(effect) if effect.needs_no_table() => Some(0.0),
            Some(_) if cost.bytes == 0 => Some(whole.times.fastest()),
            Some(_) => whole.times.longer_than(&cost.times),
        },
        saved_bytes: whole.bytes.cast_signed() - cost.bytes.cast_signed(),
        median_error,
        worst_error,
        time_ratio,
    };
    Ok(costs
        .zip(without)
        .zip(errors)
        .zip(ratios)
        .map(row)
        .collect())
}

/// The cost of a table.
#[derive(Default)]
struct Cost {
    axes: u64,
    solves: u64,
    bytes: u64,
    times: Times,
}

/// Returns the costs of the tables of some scenes, which are made in turns. A closed form in place
/// of a table costs nothing.
fn costs(
    scenes: &[Option<Scene>],
    timing: Timing,
    observer: &dyn Observer,
) -> Result<Vec<Cost>, Error> {
    let mut costs: Vec<Cost> = scenes.iter().map(|_| Cost::default()).collect();
    for _ in 0..timing.rounds(ROUNDS) {
        for (scene, cost) in scenes.iter().zip(&mut costs) {
            let Some(scene) = scene else {
                cost.times.add(0.0);
                continue;
            };
            let made = Made::new(scene, None, observer)?;
            cost.axes = scene.axes() as u64;
            (cost.solves, cost.bytes) = (made.solves, made.bytes);
            cost.times.add(made.seconds);
        }
    }
    Ok(costs)
}

/// Returns the median and the largest error of each effect over a scene.
fn errors_over(
    scene: &Scene,
    effects: &[Effect],
    points: usize,
    observer: &dyn Observer,
) -> Result<Vec<[f64; 2]>, Error> {
    let [weak, strong] = STRENGTHS.map(f64::ln);
    let mut random = Pcg64Mcg::seed_from_u64(SEED);
    let mut strength = || {
        if Effect::Adhesion.is_in(scene) {
            random.random_range(weak..strong).exp()
        } else {
            0.0
        }
    };
    let places: Vec<([f64; 4], f64)> = scene
        .random_points(points, SEED)
        .into_iter()
        .map(|point| (point, strength()))
        .collect();
    observer.begin("comparing", points, 0);
    let found = try_map(places, |([a_over_t, e1, nu1, e0], strength)| {
        let found = errors(effects, a_over_t, &scene.material([e1, nu1, e0])?, strength);
        observer.advance(1);
        found
    })?;
    Ok((0..effects.len())
        .map(|i| median_and_largest(found.iter().map(|errors| errors[i]).collect()))
        .collect())
}
