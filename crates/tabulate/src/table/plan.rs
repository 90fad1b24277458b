//! Where the nodes of a scene go, so that the splines between them keep the tolerance at the least
//! number of solves.
//!
//! Each axis is planned by itself, on lines through the box that run along it: what the table will
//! spline is solved on every line until a Chebyshev interpolant has converged, and the smallest
//! number of nodes is sought with which the splines of the table follow those interpolants
//! everywhere. The error of a tensor spline is, to first order, the sum of those of its axes.

use std::f64::consts::PI;
use std::time::Instant;

use interp::Parameter;
use interp::bspline::Basis;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::parallel::try_map;
use crate::solve::estimate::larger;
use crate::table::scene::{Extent, MOST_NODES, Scene};
use crate::table::sweep::solve_for_table;

/// The nodes of one axis, as a rule that gives them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Placement {
    /// A fixed parameter.
    Fixed(f64),
    /// `nodes` nodes at `asin(evenness z)/asin(evenness)`, with the Chebyshev points `z` of the
    /// second kind, in the parameter's coordinate; at an end where the quantities are
    /// [flat](Parameter::is_flat_at), without two more next to it.
    Nodes {
        /// The first node.
        from: f64,
        /// The last node.
        to: f64,
        /// How many there are, two or more.
        nodes: usize,
        /// 0 for Chebyshev points, 1 for even spacing.
        evenness: f64,
        /// Whether the number may be changed: it was not stated by the scene.
        free: bool,
    },
}

impl Placement {
    /// The nodes, ascending, with exact ends.
    ///
    /// # Panics
    /// As [`places`].
    pub fn nodes(&self, parameter: Parameter) -> Vec<f64> {
        match *self {
            Self::Fixed(value) => vec![value],
            Self::Nodes {
                from,
                to,
                nodes,
                evenness,
                ..
            } => {
                let (first, last) = (parameter.coordinate(from), parameter.coordinate(to));
                let node = |place: f64| parameter.value(first + (last - first) * place);
                let mut values: Vec<f64> = places_to(parameter.is_flat_at(to), nodes, evenness)
                    .into_iter()
                    .map(node)
                    .collect();
                values[0] = from;
                values[nodes - 1] = to;
                values
            }
        }
    }
}

/// `count` places from 0 to 1, see [`Placement::Nodes`].
///
/// # Panics
/// If `count` is below 2 or `evenness` is not in `[0, 1]`.
pub fn places(count: usize, evenness: f64) -> Vec<f64> {
    assert!(
        count >= 2 && (0.0..=1.0).contains(&evenness),
        "{count} nodes, evenness {evenness}"
    );
    let intervals = (count - 1) as f64;
    let place = |i: usize| {
        let even = i as f64 / intervals;
        // The sine keeps the places symmetric.
        let chebyshev = (PI * (even - 0.5)).sin();
        match evenness {
            0.0 => 0.5 + 0.5 * chebyshev,
            1.0 => even,
            _ => 0.5 + 0.5 * (evenness * chebyshev).asin() / evenness.asin(),
        }
    };
    (0..count).map(place).collect()
}

/// The places of as many nodes, of which two fewer crowd towards a flat end: there a spline knows
/// two derivatives in their stead. (The nodes that are left out would be so close to it that the
/// solves' own error spoils the derivative with respect to `nu1`, which divides by the cube of the
/// distance.)
fn places_to(flat_end: bool, count: usize, evenness: f64) -> Vec<f64> {
    if !flat_end || evenness == 1.0 {
        return places(count, evenness);
    }
    let mut places = places(count + 2, evenness);
    places.drain(count - 1..=count);
    places
}

/// The nodes of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The rule of each parameter, in the order of [`Parameter::ALL`].
    pub placements: [Placement; 4],
}

/// A larger table than this is taken for a mistake: 1.6 GB.
const MOST_VALUES: usize = 200_000_000;

/// How much of the tolerance the error on the lines of each axis may be. The errors of the axes are
/// largest in different places, so that those of the table are hardly larger: 0.4 to 0.7 of the
/// tolerance for the shipped scenes, and at most 0.83 for 90 random ones.
const SHARE: f64 = 0.5;

/// What the nodes may be like: the fewest win. Boxes whose quantities are smooth up to their ends
/// want even nodes, those that end in a steep region crowded ones.
pub const EVENNESS: [f64; 4] = [0.0, 0.9, 0.95, 0.98];

impl Plan {
    /// Plans the table of a scene. Stated numbers of nodes are obeyed. The plan does not depend on
    /// the number of threads.
    ///
    /// # Errors
    /// Those of the solve; [`Error::Unresolved`] where an axis would take thousands of nodes, or
    /// more than can be told apart; [`Error::TooLarge`] where more than 2e8 values would be needed.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        Self::until(scene, None)
    }

    /// [`Plan::new`], given up with [`Error::Budget`] at the deadline.
    pub(crate) fn until(scene: &Scene, deadline: Option<Instant>) -> Result<Self, Error> {
        let mut placements = scene
            .extents
            .map(|extent| Placement::Fixed(extent.ends()[0]));
        for (parameter, placement) in Parameter::ALL.into_iter().zip(&mut placements) {
            match scene.extents[parameter as usize] {
                Extent::Fixed(_) => {}
                Extent::Even { from, to, nodes } => {
                    *placement = Placement::Nodes {
                        from,
                        to,
                        nodes,
                        evenness: 1.0,
                        free: false,
                    }
                }
                Extent::Range { from, to } => {
                    let lines = Lines::solve(scene, parameter, [from, to], deadline)?;
                    let unresolved = || Error::Unresolved {
                        axis: parameter.name(),
                        nodes: lines.most(),
                        tolerance: scene.tolerance,
                    };
                    let (nodes, evenness) = lines
                        .fewest(SHARE * scene.tolerance)
                        .ok_or_else(unresolved)?;
                    *placement = Placement::Nodes {
                        from,
                        to,
                        nodes,
                        evenness,
                        free: true,
                    };
                }
            }
        }
        let plan = Self { placements };
        plan.check(scene)?;
        Ok(plan)
    }

    /// The nodes of the four parameters.
    ///
    /// # Panics
    /// As [`places`]: for a plan that [`Plan::new`] has not made.
    pub fn axes(&self) -> [Vec<f64>; 4] {
        Parameter::ALL.map(|parameter| self.placements[parameter as usize].nodes(parameter))
    }

    /// The number of nodes on each axis.
    pub fn shape(&self) -> [usize; 4] {
        self.placements.map(|placement| match placement {
            Placement::Fixed(_) => 1,
            Placement::Nodes { nodes, .. } => nodes,
        })
    }

    /// The number of points to solve.
    pub fn points(&self) -> usize {
        self.shape().iter().product()
    }

    /// The plan with more nodes on some axes: `factors[parameter]` times as many, and two more at
    /// least where the factor is above
    /// 1. Stated numbers of nodes stay. None if nothing changes.
    ///
    /// # Errors
    /// [`Error::TooLarge`].
    pub(crate) fn refined(&self, factors: [f64; 4], scene: &Scene) -> Result<Option<Self>, Error> {
        let mut plan = self.clone();
        for (placement, factor) in plan.placements.iter_mut().zip(factors) {
            if let Placement::Nodes {
                nodes, free: true, ..
            } = placement
                && factor > 1.0
            {
                *nodes = ((*nodes as f64 * factor).ceil() as usize).max(*nodes + 2);
            }
        }
        if plan == *self {
            return Ok(None);
        }
        plan.check(scene)?;
        Ok(Some(plan))
    }

    /// Whether this can be the plan of a scene, refined or not.
    pub(crate) fn fits(&self, scene: &Scene) -> bool {
        let fits = |(placement, extent): (&Placement, &Extent)| match (*placement, *extent) {
            (Placement::Fixed(value), Extent::Fixed(settled)) => value == settled,
            (
                Placement::Nodes {
                    from,
                    to,
                    nodes,
                    evenness,
                    free: true,
                },
                Extent::Range { .. },
            ) => [from, to] == extent.ends() && nodes >= 2 && EVENNESS.contains(&evenness),
            (
                Placement::Nodes {
                    from,
                    to,
                    nodes,
                    evenness,
                    free: false,
                },
                Extent::Even { nodes: stated, .. },
            ) => [from, to] == extent.ends() && nodes == stated && evenness == 1.0,
            _ => false,
        };
        self.placements.iter().zip(&scene.extents).all(fits) && self.check(scene).is_ok()
    }

    fn check(&self, scene: &Scene) -> Result<(), Error> {
        let shape = self.shape();
        let values = shape
            .iter()
            .fold(scene.quantities.len(), |product, &nodes| {
                product.saturating_mul(nodes)
            });
        if values > MOST_VALUES || shape.iter().any(|&nodes| nodes > MOST_NODES) {
            return Err(Error::TooLarge {
                shape,
                values,
                most: MOST_VALUES,
            });
        }
        for (parameter, nodes) in Parameter::ALL.into_iter().zip(self.axes()) {
            // Near incompressibility, f64 does not hold more than some hundred nodes apart.
            if !nodes.is_sorted_by(|a, b| a < b) {
                return Err(Error::Unresolved {
                    axis: parameter.name(),
                    nodes: nodes.len(),
                    tolerance: scene.tolerance,
                });
            }
        }
        Ok(())
    }
}

/// What a table splines, on lines along one of its axes.
struct Lines {
    /// The number of Chebyshev points on each line, two or more.
    points: usize,
    /// One row for each point, with the logarithms of the quantities on every line.
    rows: Vec<f64>,
    /// The length of a row.
    width: usize,
    /// Whether the lines end where splines have a [flat end](Parameter::is_flat_at).
    flat: bool,
}

impl Lines {
    /// Intervals of the first Chebyshev points; doubled until the interpolant has converged.
    const FIRST: usize = 32;
    /// More would be too many nodes in any case: twelve decades of `a/t` take 512 to 1e-9.
    const MOST: usize = 2048;
    /// How well the interpolant has converged, in parts of the tolerance.
    const CONVERGED: f64 = 0.02;
    /// An error below this that falls no more is the solve's own, in a corner that double precision
    /// does not resolve better.
    const NOISE: f64 = 0.25;

    fn solve(
        scene: &Scene,
        along: Parameter,
        [from, to]: [f64; 2],
        deadline: Option<Instant>,
    ) -> Result<Self, Error> {
        let (first, last) = (along.coordinate(from), along.coordinate(to));
        let value = |place: f64| along.value(first + (last - first) * place).clamp(from, to);
        let lines = lines(scene, along);
        let width = lines.len() * scene.quantities.len();
        let solve = |places: &[f64]| -> Result<Vec<f64>, Error> {
            let points: Vec<[f64; 4]> = places
                .iter()
                .flat_map(|&place| lines.iter().map(move |line| (place, line)))
                .map(|(place, line)| {
                    let mut point = *line;
                    point[along as usize] = value(place);
                    point
                })
                .collect();
            Ok(try_map(points, |point| logarithms(scene, point))?.concat())
        };
        let mut intervals = Self::FIRST;
        let mut lines = Self {
            points: intervals + 1,
            rows: solve(&places(intervals + 1, 0.0))?,
            width,
            flat: along.is_flat_at(to),
        };
        let mut former_error = f64::INFINITY;
        loop {
            if deadline.is_some_and(|deadline| Instant::now() >= deadline) {
                return Err(Error::Budget {
                    spent: "before the nodes are chosen".into(),
                });
            }
            let finer = places(2 * intervals + 1, 0.0);
            let between: Vec<f64> = finer.iter().copied().skip(1).step_by(2).collect();
            let solved = solve(&between)?;
            let error = largest_difference(&lines.interpolated(&between), &solved);
            // The points between are those of the doubled number that the former ones are not.
            let (former, fresh) = (lines.rows.chunks_exact(width), solved.chunks_exact(width));
            let mut rows = Vec::with_capacity(lines.rows.len() + solved.len());
            for (former, fresh) in former.zip(fresh.map(Some).chain([None])) {
                rows.extend(former);
                rows.extend(fresh.into_iter().flatten());
            }
            intervals *= 2;
            lines = Self {
                points: intervals + 1,
                rows,
                ..lines
            };
            let noise = error <= Self::NOISE * scene.tolerance && error >= 0.5 * former_error;
            if error <= Self::CONVERGED * scene.tolerance || noise || intervals >= Self::MOST {
                return Ok(lines);
            }
            former_error = error;
        }
    }

    /// The rows at other places, by the barycentric formula.
    fn interpolated(&self, at: &[f64]) -> Vec<f64> {
        let nodes = places(self.points, 0.0);
        let mut rows = vec![0.0; at.len() * self.width];
        rows.par_chunks_exact_mut(self.width)
            .zip(at)
            .for_each(|(row, &place)| {
                let last = self.points - 1;
                let weight = |i: usize| {
                    let size = if i == 0 || i == last { 0.5 } else { 1.0 };
                    let signed = if i.is_multiple_of(2) { size } else { -size };
                    signed / (place - nodes[i])
                };
                let mut weights: Vec<f64> = (0..=last).map(weight).collect();
                if let Some(node) = weights.iter().position(|weight| weight.is_infinite()) {
                    weights.fill(0.0);
                    weights[node] = 1.0;
                }
                let sum: f64 = weights.iter().sum();
                for (weight, values) in weights.iter().zip(self.rows.chunks_exact(self.width)) {
                    let weight = weight / sum;
                    row.iter_mut()
                        .zip(values)
                        .for_each(|(row, value)| *row += weight * value);
                }
            });
        rows
    }

    /// The most nodes that are tried: splines that still do not follow the interpolants never will.
    fn most(&self) -> usize {
        2 * self.points
    }

    /// The least number of nodes, with their evenness, from which splines follow every line to
    /// `tolerance`; none if there are too many.
    fn fewest(&self, tolerance: f64) -> Option<(usize, f64)> {
        let mut best = (self.most() + 1, EVENNESS[0]);
        for evenness in EVENNESS {
            let keeps = |nodes: usize| self.error(nodes, evenness) <= tolerance;
            // The error falls with the nodes, but for some up and down.
            let (mut too_few, mut enough) = (1, 16);
            while enough < best.0 && !keeps(enough) {
                (too_few, enough) = (enough, 2 * enough);
            }
            enough = enough.min(best.0);
            while enough - too_few > 1 {
                let middle = too_few.midpoint(enough);
                *if keeps(middle) {
                    &mut enough
                } else {
                    &mut too_few
                } = middle;
            }
            if enough < best.0 {
                best = (enough, evenness);
            }
        }
        (best.0 <= self.most()).then_some(best)
    }

    /// The largest error of the splines through so many nodes: in the middles of their cells, where
    /// it is largest.
    fn error(&self, count: usize, evenness: f64) -> f64 {
        let nodes = places_to(self.flat, count, evenness);
        let middles: Vec<f64> = nodes
            .windows(2)
            .map(|pair| pair[0].midpoint(pair[1]))
            .collect();
        let basis = Basis::of_table(&nodes, self.flat);
        let mut coefficients = self.interpolated(&nodes);
        basis.interpolate(&mut coefficients, self.width);
        let truth = self.interpolated(&middles);
        let errors = middles
            .par_iter()
            .zip(truth.par_chunks_exact(self.width))
            .map(|(&middle, truth)| {
                let weights = basis.weights(middle);
                let mut splines = vec![0.0; self.width];
                let rows = coefficients[weights.first * self.width..].chunks_exact(self.width);
                for (weight, row) in weights.values[..weights.count].iter().zip(rows) {
                    splines
                        .iter_mut()
                        .zip(row)
                        .for_each(|(spline, coefficient)| *spline += weight * coefficient);
                }
                largest_difference(&splines, truth)
            });
        errors.reduce(|| 0.0, larger)
    }
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, larger)
}

/// Lines along an axis: every edge of the box, and others that are drawn at random, each parameter
/// at one of its ends in half of them. Their number grows with the number of directions in which
/// they can differ. The points have the first value of the range along the axis itself.
pub fn lines(scene: &Scene, along: Parameter) -> Vec<[f64; 4]> {
    const RANDOM: usize = 40;
    const OVERSHOOT: f64 = 0.5;
    const SEED: u64 = 4;
    let across: Vec<Parameter> = Parameter::ALL
        .into_iter()
        .filter(|&parameter| {
            parameter != along && !matches!(scene.extents[parameter as usize], Extent::Fixed(_))
        })
        .collect();
    let mut random = Pcg64Mcg::seed_from_u64(SEED);
    let edges = 1_usize << across.len();
    let line = |i: usize| {
        let mut line = scene.extents.map(|extent| extent.ends()[0]);
        for (bit, &parameter) in across.iter().enumerate() {
            let [from, to] = scene.extents[parameter as usize].ends();
            let share: f64 = if i < edges {
                (i >> bit & 1) as f64
            } else {
                random.random_range(-OVERSHOOT..1.0 + OVERSHOOT)
            };
            let (first, last) = (parameter.coordinate(from), parameter.coordinate(to));
            line[parameter as usize] = parameter
                .value(first + (last - first) * share.clamp(0.0, 1.0))
                .clamp(from, to);
        }
        line
    };
    (0..edges + RANDOM * across.len()).map(line).collect()
}

/// What the table splines at one point, for the quantities that the scene asks for.
///
/// # Errors
/// Those of the solve.
pub fn logarithms(scene: &Scene, [a_over_t, e1, nu1, e0]: [f64; 4]) -> Result<Vec<f64>, Error> {
    let material = scene.material([e1, nu1, e0])?;
    let solved = solve_for_table(a_over_t, &material, scene.tolerance)?;
    let es = material.sphere_film_modulus();
    Ok(scene
        .quantities
        .iter()
        .map(|&quantity| quantity.logarithm(solved.get(quantity), es))
        .collect())
}
