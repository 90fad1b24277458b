//! The tables of a scene without one effect after another: the rows of `tabulate cost effects`.

use std::iter;

use cost::clock::{Times, Timing};
use cost::deviation::median_and_largest;
use cost::effects::{Effect, Row, STRENGTHS, errors};
use interp::Quantity;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use solve::parallel::try_map;

use super::Made;
use crate::Error;
use crate::table::{Extent, Observer, Scene};

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
        .filter(|&effect| is_in(effect, scene))
        .collect();
    let errors = errors_over(scene, &effects, points, observer)?;
    let others = effects.iter().filter(|effect| !effect.needs_no_table());
    let scenes: Vec<Option<Scene>> = [Some(scene.clone())]
        .into_iter()
        .chain(others.map(|effect| scene_without(*effect, scene)))
        .collect();
    let costs = costs(&scenes, timing, observer)?;
    let whole = &costs[0];
    // The effects that need no table are the last. Their table is that of the whole scene.
    let costs = costs.iter().chain(iter::repeat(whole));
    let without = iter::once(None).chain(effects.into_iter().map(Some));
    let errors = iter::once([0.0; 2]).chain(errors);
    let row = |((without, cost), errors): ((Option<Effect>, &Cost), [f64; 2])| {
        let [median_error, worst_error] = errors;
        Ok::<_, Error>(Row {
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
            time_ratio: without.map_or(Ok(None), |effect| effect.time_ratio(timing))?,
        })
    };
    without.zip(costs).zip(errors).map(row).collect()
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
        if is_in(Effect::Adhesion, scene) {
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
        let found = errors(effects, a_over_t, &scene.material([e1, nu1, e0])?, strength)?;
        observer.advance(1);
        Ok::<_, Error>(found)
    })?;
    Ok((0..effects.len())
        .map(|i| median_and_largest(found.iter().map(|errors| errors[i]).collect()))
        .collect())
}

/// Whether a scene has the effect and can do without it. A film between rigid bodies cannot be
/// left out.
fn is_in(effect: Effect, scene: &Scene) -> bool {
    let [_, e1, nu1, e0] = scene.extents;
    let held = |quantity| scene.quantities.contains(&quantity);
    match effect {
        Effect::Film => e1 != Extent::Fixed(0.0) || e0 != Extent::Fixed(f64::INFINITY),
        Effect::SphereCompliance => e1 != Extent::Fixed(0.0),
        Effect::SubstrateCompliance => e0 != Extent::Fixed(f64::INFINITY),
        Effect::FilmCompressibility => nu1 != Extent::Fixed(0.5),
        // The range needs what adhesion needs.
        Effect::Adhesion | Effect::FiniteRange => held(Quantity::Eeq) && held(Quantity::Gamma),
        Effect::Penetration => held(Quantity::Delta0),
        // The curve of a shape needs all quantities.
        Effect::Shape => Quantity::ALL.into_iter().all(held),
        Effect::Interface => true,
        Effect::Friction => true,
        // The radii of a history come from the penetration.
        Effect::Relaxation => held(Quantity::Delta0),
    }
}

/// Returns the scene without the effect; none if a closed form replaces the table.
fn scene_without(effect: Effect, scene: &Scene) -> Option<Scene> {
    let mut variant = scene.clone();
    let [_, e1, nu1, e0] = &mut variant.extents;
    match effect {
        Effect::Film => return None,
        Effect::SphereCompliance => {
            // E0/E1 of the same films on the same substrates.
            let ([softest, stiffest], [from, to]) = (e1.ends(), e0.ends());
            let [from, to] = [from / stiffest, to / softest];
            *e0 = if from < to {
                Extent::Range { from, to }
            } else {
                Extent::Fixed(from)
            };
            *e1 = Extent::Fixed(0.0);
        }
        Effect::SubstrateCompliance => *e0 = Extent::Fixed(f64::INFINITY),
        Effect::FilmCompressibility => *nu1 = Extent::Fixed(0.5),
        Effect::Adhesion => variant
            .quantities
            .retain(|quantity| matches!(quantity, Quantity::Pi0 | Quantity::Delta0)),
        Effect::Penetration => variant
            .quantities
            .retain(|&quantity| quantity != Quantity::Delta0),
        Effect::Shape
        | Effect::FiniteRange
        | Effect::Interface
        | Effect::Friction
        | Effect::Relaxation => {}
    }
    Some(variant)
}
