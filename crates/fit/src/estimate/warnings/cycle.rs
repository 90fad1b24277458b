//! A cycle of loading and unloading, beside the one that the fitted model makes.
//!
//! Against penetrations or heights the area between the two curves of load and penetration is the
//! energy lost in the cycle. Against contact radii it is that between the two curves of the energy
//! release rate `G` and the area of contact `pi a^2`, because a contact that moves by equilibria
//! loses `G dA`. An elastic contact with one work of adhesion loses nothing where both curves are
//! in contact; with two it loses their difference.

use std::f64::consts::PI;

use contact::Contact;

use super::hold;
use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::statistics::{BEYOND_CHANCE, extremes, normal_of_t, scatter_of_differences};
use crate::{Branch, Experiment, Kind, Warning, WarningKind};

/// The load at which the penetrations of loading and unloading are compared for what remains, over
/// the largest load: the smallest that both reach, at least the first and at most the second.
const LOW_LOAD: [f64; 2] = [1e-3, 0.25];
/// That load is clear of the noise by this factor.
const CLEAR: f64 = 4.0;
/// The depth that remains, over the largest penetration, from which it is named.
const REMAINS: f64 = 0.05;
/// The tension of the unloading, over the largest load, from which the contact counts as adhesive.
const ADHESIVE: f64 = 0.05;
/// The fewest points of each way that are compared.
const FEWEST: usize = 5;

/// One measured point of a way.
#[derive(Clone, Copy)]
struct Sample {
    /// The penetration, m, or the area of contact, m^2.
    x: f64,
    /// What the data exceed the model by: a load, N, or an energy release rate, J/m^2. NaN where the
    /// model has no contact.
    excess: f64,
    /// The load, N.
    load: f64,
    /// The penetration, m.
    penetration: f64,
    /// What is compared at one load: the penetration or the contact radius, m.
    position: f64,
}

/// Warns of a loop that the fitted model does not make, and of a depth that remains.
pub(crate) fn doubts(problem: &Problem<'_>, e: usize) -> Option<Vec<Warning>> {
    let assigned = &problem.assigned[e];
    let experiment = &assigned.experiment;
    // A law of the speed makes a loop of its own, and has a doubt of its own.
    if experiment.bodies.probe.is_flat_punch() || experiment.has_line_law() {
        return None;
    }
    let Some(ways) = experiment.ways() else {
        return hold::doubt(assigned).map(|one| vec![one]);
    };
    let levels = assigned.baselines_apart();
    let ways = samples(problem, e, &ways, levels.unwrap_or_default())?;
    let cycle = Cycle::between(&ways)?;
    let name = &experiment.measurement.name;
    let at_half = match cycle.apart {
        Some(apart) => format!("; at half of the largest load they are {apart:.2e} m apart"),
        None => String::new(),
    };
    // Adhesion may pull all the way in.
    let part = if cycle.work > 0.0 {
        let part = 1e2 * cycle.energy.abs() / cycle.work;
        format!(", {part:.1} % of the work of loading")
    } else {
        String::new()
    };
    let size = format!("{:.2e} J{part}{at_half}", cycle.energy.abs());
    let two_works = experiment.work_of_adhesion_receding.is_some();
    let loop_of_model = if experiment.relaxing.is_some() {
        Some(("the fitted relaxation function", "fit another one"))
    } else if two_works && cycle.energy < 0.0 {
        Some((
            "the two works of adhesion",
            "the adhesion of one way differs from point to point, as where it depends on the speed of the contact line \
             (doubling-speed, speed-exponent), or the zeros are wrong",
        ))
    } else {
        None
    };
    if let Some((model, step)) = loop_of_model {
        let which = if cycle.energy < 0.0 { "less" } else { "more" };
        return Some(vec![WarningKind::Hysteresis.with(format!(
            "{name}: between loading and unloading the data lose {which} energy than {model}, by {size}: {step}"
        ))]);
    }
    if cycle.energy < 0.0 {
        return Some(vec![WarningKind::Hysteresis.with(format!(
            "{name}: unloading gives back more energy than loading took, by {size}: check the \
             directions of the points, and whether the position drifts"
        ))]);
    }
    let has_directions = experiment.measurement.points[0].direction.is_some();
    let is_below = |receding: f64| receding < experiment.work_of_adhesion;
    let cause = if let Some([one, other]) = levels {
        format!(
            "the baselines of the two ways are {:.2e} N apart, as drag of the liquid or drift makes them",
            (one - other).abs()
        )
    } else if experiment.work_of_adhesion_receding.is_some_and(is_below) {
        // The loop is that beside a model that gains energy.
        "the fitted model gains energy on unloading, as a zero of the load or a position that drifts makes it".to_owned()
    } else {
        "hysteresis: viscous, of the adhesion, or plastic; or a position that drifts".to_owned()
    };
    let step = match (has_directions, two_works || levels.is_some()) {
        (_, true) => "",
        (true, false) => {
            "free the work of adhesion of retract (work-of-adhesion-receding) where adhesion is the reason, or "
        }
        (false, false) => {
            "give the points their directions, then free the work of adhesion of retract (work-of-adhesion-receding) where \
             adhesion is the reason, or "
        }
    };
    let mut doubts = vec![WarningKind::Hysteresis.with(format!(
        "{name}: between loading and unloading lies a loop that the fitted model does not \
         make, of {size} ({cause}); {step}fit one direction alone{}",
        if experiment.may_relax() {
            "; the points have times: if the film relaxes, fit a relaxation function with them"
        } else if experiment.may_have_line_law() {
            "; the points have times: if adhesion depends on the speed of the contact line, free doubling-speed and \
             speed-exponent"
        } else {
            ""
        }
    ))];
    if let Some([depth, largest]) = remaining(assigned, &ways) {
        doubts.push(WarningKind::Plasticity.with(format!(
            "{name}: after unloading a depth of {depth:.2e} m remains, {:.0} % of the largest \
             penetration: the sample has deformed plastically, or recovers more slowly than it \
             was unloaded, and the loading tells no elastic modulus; fit the upper part of \
             the unloading alone (loads above half of the largest) with a free contact point. A position that \
             drifts leaves such a depth, too, and both ways then tell a wrong modulus: take the drift off first",
            1e2 * depth / largest
        )));
    }
    Some(doubts)
}

/// Returns the samples of loading and of unloading, by ascending `x`. Drag of a liquid lifts one way and lowers the other:
/// the loads are those above the `levels` of the baselines of both.
fn samples(
    problem: &Problem<'_>,
    e: usize,
    ways: &[Vec<usize>; 2],
    levels: [f64; 2],
) -> Option<[Vec<Sample>; 2]> {
    let assigned = &problem.assigned[e];
    let experiment = &assigned.experiment;
    let points = &experiment.measurement.points;
    let contact = problem.contact(&experiment.bodies, false).ok()?;
    let at_radii = experiment.measurement.kind.at_radii();
    // Points that the fit leaves out are compared, too: all above the contact point.
    let mut branches = vec![Branch::LeftOut; points.len()];
    for &i in ways.iter().flatten() {
        let in_contact = at_radii || experiment.imposed(points[i].abscissa) > 0.0;
        if in_contact && points[i].abscissa != 0.0 {
            branches[i] = points[i].branch();
        }
    }
    let predicted = if at_radii {
        Vec::new()
    } else {
        let predicted =
            experiment.predict_with(&problem.contact_of(), &branches, &assigned.order, &[]);
        predicted.ok()?.values
    };
    let sample = |i: usize, level: f64| {
        if at_radii && branches[i] == Branch::LeftOut {
            None
        } else if at_radii {
            at_radius(experiment, &contact, i, branches[i])
        } else {
            let point = &points[i];
            let load = point.ordinate - experiment.baseline_at(point.abscissa) - level;
            let spring = match experiment.measurement.kind {
                Kind::ForceHeight => experiment.stiffness.unwrap_or(f64::INFINITY),
                _ => f64::INFINITY,
            };
            let penetration = experiment.imposed(point.abscissa) - load / spring;
            Some(Sample {
                x: penetration,
                excess: if branches[i] == Branch::LeftOut {
                    f64::NAN
                } else {
                    point.ordinate - predicted[i]
                },
                load,
                penetration,
                position: penetration,
            })
        }
    };
    let of_way = |k: usize| {
        let samples = ways[k].iter().filter_map(|&i| sample(i, levels[k]));
        let mut samples: Vec<Sample> = samples.collect();
        samples.sort_by(|one, other| one.x.total_cmp(&other.x));
        samples
    };
    let ways = [0, 1].map(of_way);
    ways.iter().all(|way| way.len() >= FEWEST).then_some(ways)
}

/// Returns the sample of a measured contact radius. The energy of a contact that grows counts
/// negative, because what an approach gains by adhesion is not lost.
fn at_radius(
    experiment: &Experiment,
    contact: &Contact,
    i: usize,
    branch: Branch,
) -> Option<Sample> {
    let point = &experiment.measurement.points[i];
    let a = point.abscissa;
    let (load0, penetration0) = contact.load_and_penetration(a, 0.0).ok()?;
    let stiffness = contact.stiffness(a).ok()?;
    let reading = point.ordinate - experiment.baseline_at(a);
    let (load, penetration) = if experiment.measurement.kind == Kind::LoadRadius {
        (reading, penetration0 - (load0 - reading) / stiffness)
    } else {
        (load0 - stiffness * (penetration0 - reading), reading)
    };
    Some(Sample {
        x: PI * a * a,
        excess: experiment.work_of(branch) - experiment.measured_energy(contact, point).ok()?,
        load,
        penetration,
        position: a,
    })
}

/// The loop between loading and unloading, less that of the model.
struct Cycle {
    /// Its energy, J.
    energy: f64,
    /// The work of loading, J.
    work: f64,
    /// The distance of the two curves at half of the largest load, m.
    apart: Option<f64>,
}

impl Cycle {
    /// Returns the loop if it is larger than chance makes it.
    fn between(all: &[Vec<Sample>; 2]) -> Option<Self> {
        let in_contact = |way: &Vec<Sample>| -> Vec<Sample> {
            let samples = way.iter().filter(|sample| sample.excess.is_finite());
            samples.copied().collect()
        };
        let ways = &[in_contact(&all[0]), in_contact(&all[1])];
        let ends =
            |pick: fn(&Sample) -> f64| ways.iter().map(move |way| extremes(way.iter().map(pick)));
        let largest = ends(|sample| sample.x).map(|[_, most]| most);
        let to = largest.fold(f64::INFINITY, f64::min);
        let smallest = ends(|sample| sample.x).map(|[least, _]| least);
        let from = smallest.fold(0.0, f64::max);
        let (mut energies, mut variance, mut freedom) = ([0.0; 2], 0.0, 0.0);
        for (way, energy) in ways.iter().zip(&mut energies) {
            let positions: Vec<f64> = way.iter().map(|sample| sample.x).collect();
            let weights = weights(&positions, [from, to]);
            let weighted = way.iter().zip(&weights);
            let weighted = weighted.map(|(sample, weight)| (sample.excess, *weight));
            *energy = weighted
                .clone()
                .map(|(excess, weight)| excess * weight)
                .sum();
            let inside: Vec<(f64, f64)> = weighted.filter(|(_, weight)| *weight > 0.0).collect();
            if inside.len() < FEWEST {
                return None;
            }
            variance += scatter_of_differences(&inside);
            freedom += (inside.len() - 1) as f64 / 1.5;
        }
        let energy = energies[0] - energies[1];
        let deviations = normal_of_t(energy.abs() / variance.sqrt(), freedom);
        if deviations.is_nan() || deviations <= BEYOND_CHANCE {
            return None;
        }
        let loading = &ways[0];
        let depths: Vec<f64> = loading.iter().map(|sample| sample.penetration).collect();
        let weights = weights(&depths, [f64::NEG_INFINITY, f64::INFINITY]);
        let parts = loading.iter().zip(weights);
        let work = parts.map(|(sample, weight)| sample.load * weight).sum();
        let largest = ends(|sample| sample.load).map(|[_, most]| most);
        let load = 0.5 * largest.fold(f64::INFINITY, f64::min);
        let [one, other] = [0, 1].map(|way| crossing(&ways[way], load));
        Some(Self {
            energy,
            work,
            apart: one.zip(other).map(|(one, other)| (one - other).abs()),
        })
    }
}

/// Returns the weights of values at ascending positions in the integral of their straight lines
/// between two ends.
fn weights(positions: &[f64], [from, to]: [f64; 2]) -> Vec<f64> {
    let mut weights = vec![0.0; positions.len()];
    for i in 1..positions.len() {
        let [left, right] = [positions[i - 1], positions[i]];
        let (begin, end) = (left.max(from), right.min(to));
        if end > begin {
            let part = (0.5 * (begin + end) - left) / (right - left);
            weights[i - 1] += (end - begin) * (1.0 - part);
            weights[i] += (end - begin) * part;
        }
    }
    weights
}

/// Returns where the load of a way falls below a value, seen from its largest contact.
fn crossing(way: &[Sample], load: f64) -> Option<f64> {
    let above = way.iter().rposition(|sample| sample.load >= load)?;
    let below = way[..above].iter().rposition(|sample| sample.load < load)?;
    let (low, high) = (&way[below], &way[below + 1]);
    let part = (load - low.load) / (high.load - low.load);
    Some(low.position + part * (high.position - low.position))
}

/// Returns the depth that remains after unloading, and the largest penetration, if the depth is
/// large: the distance of the two ways at a low load. An adhesive contact that lasts to the contact
/// point of loading, and beyond, leaves none.
fn remaining(assigned: &Assigned, ways: &[Vec<Sample>; 2]) -> Option<[f64; 2]> {
    if assigned.experiment.measurement.kind.at_radii() {
        return None;
    }
    let loads = |way: &[Sample]| extremes(way.iter().map(|sample| sample.load));
    let [[least, largest], [tension, most]] = [loads(&ways[0]), loads(&ways[1])];
    let largest = largest.min(most);
    let low = least.max(tension).max(CLEAR * assigned.seen_noise());
    let low = low.max(LOW_LOAD[0] * largest) * (1.0 + 1e-9);
    if !(largest > 0.0 && low <= LOW_LOAD[1] * largest) {
        return None;
    }
    let touches = crossing(&ways[0], low)?;
    let deepest = ways[0].last()?.penetration - touches;
    let mut ends = crossing(&ways[1], low)?;
    if tension < -ADHESIVE * largest {
        // The contact ends where it pulls most.
        let last = ways[1]
            .iter()
            .min_by(|one, other| one.load.total_cmp(&other.load));
        ends = ends.min(last?.penetration);
    }
    let depth = ends - touches;
    (depth > REMAINS * deepest).then_some([depth, deepest])
}
