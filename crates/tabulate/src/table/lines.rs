//! Lines through the box of a scene, on which an axis of its table is planned.
//!
//! The quantities are solved on every line until a Chebyshev interpolant has converged. Then the
//! smallest number of nodes is sought with which the splines of the table follow those interpolants
//! everywhere.

use interp::{Material, Parameter, Quantities};
use low_rank::add_rows;
use piecewise::bspline::Basis;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use crate::Error;
use crate::stack::NamedStack;
use crate::table::budget::Budget;
use crate::table::extent::Extent;
use crate::table::placement::{EVENNESS, between, places};
use crate::table::scene::Scene;
use crate::table::sweep::{solve_for_table, solve_stack_for_table};
use solve::larger;
use solve::parallel::{on_all_cores, try_map};

/// The logarithms that a table splines, solved on lines along one of its axes.
pub(super) struct Lines {
    /// The number of Chebyshev points on each line, two or more.
    points: usize,
    /// A row for each point, with the logarithms of the quantities on every line.
    rows: Vec<f64>,
    /// The length of a row.
    width: usize,
}

impl Lines {
    /// The number of intervals between the first Chebyshev points. It is doubled until the
    /// interpolant has converged.
    const FIRST: usize = 32;
    /// The largest number of intervals: twelve decades of `a/t` need 512 to 1e-9.
    const MOST: usize = 2048;
    /// The largest error of a converged interpolant, in parts of the tolerance.
    const CONVERGED: f64 = 0.02;
    /// The largest error that is taken for the solve's own, in parts of the tolerance, where more
    /// points do not halve it: some corners are not resolved better in double precision.
    const NOISE: f64 = 0.25;

    /// Solves the lines of a scene along one parameter, until the Chebyshev interpolants have
    /// converged.
    ///
    /// # Errors
    /// [`Error::Budget`] when the budget is spent before; those of the solve.
    pub(super) fn solve(
        scene: &Scene,
        along: Parameter,
        range: [f64; 2],
        budget: Option<Budget<'_>>,
    ) -> Result<Self, Error> {
        let lines = lines(scene, along);
        let width = lines.len() * scene.quantities.len();
        let solve = |places: &[f64]| -> Result<Vec<f64>, Error> {
            let points: Vec<[f64; 4]> = places
                .iter()
                .flat_map(|&place| lines.iter().map(move |line| (place, line)))
                .map(|(place, line)| {
                    let mut point = *line;
                    point[along.dimension()] = between(along, range, place);
                    point
                })
                .collect();
            logarithms_of_all(scene, &points)
        };
        let mut intervals = Self::FIRST;
        let mut lines = Self {
            points: intervals + 1,
            rows: solve(&places(intervals + 1, 0.0))?,
            width,
        };
        let mut former_error = f64::INFINITY;
        loop {
            if budget.is_some_and(|budget| budget.is_spent()) {
                return Err(Error::Budget {
                    spent: "before the nodes are chosen; allow more time".into(),
                });
            }
            let finer = places(2 * intervals + 1, 0.0);
            let between: Vec<f64> = finer.iter().copied().skip(1).step_by(2).collect();
            let solved = solve(&between)?;
            let error = largest_difference(&lines.interpolated(&between), &solved);
            // The points between the former ones complete the doubled number.
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

    /// Returns the rows at other places, by the barycentric formula.
    fn interpolated(&self, at: &[f64]) -> Vec<f64> {
        let nodes = places(self.points, 0.0);
        let mut rows = vec![0.0; at.len() * self.width];
        let rows_at = rows.par_chunks_exact_mut(self.width).zip(at);
        on_all_cores(|| {
            rows_at.for_each(|(row, &place)| {
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
                weights.iter_mut().for_each(|weight| *weight /= sum);
                add_rows(row, &weights, &self.rows, self.width);
            });
        });
        rows
    }

    /// Returns the largest number of nodes that is tried, twice the number of points. Splines that
    /// do not follow the interpolants with these would not with more.
    pub(super) fn most(&self) -> usize {
        2 * self.points
    }

    /// Returns the smallest number of nodes, with their evenness, from which splines follow every
    /// line to `tolerance`; none if it is above [`Lines::most`].
    pub(super) fn fewest(&self, tolerance: f64) -> Option<(usize, f64)> {
        let mut best = (self.most() + 1, EVENNESS[0]);
        for evenness in EVENNESS {
            let keeps = |nodes: usize| self.error(nodes, evenness) <= tolerance;
            // Lines that have not converged at the most points may have no such number.
            if self.points > Self::MOST && !keeps(self.most()) {
                continue;
            }
            // The error falls with the number of nodes, apart from small variations.
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

    /// Returns the largest error of the splines through `count` nodes in the middles of their
    /// cells, where it is largest.
    fn error(&self, count: usize, evenness: f64) -> f64 {
        let nodes = places(count, evenness);
        let middles: Vec<f64> = nodes
            .windows(2)
            .map(|pair| pair[0].midpoint(pair[1]))
            .collect();
        let basis = Basis::of_table(&nodes);
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
        on_all_cores(|| errors.reduce(|| 0.0, larger))
    }
}

/// Returns the largest difference of two lists; NaN if one is NaN.
fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, larger)
}

/// Returns a point of each line along an axis on which the axis is planned.
///
/// The lines are all edges of the box, and 40 random ones for each of the other axes. A random line
/// has each of the other parameters at an end of its range with a probability of one half. The
/// points have the first value of the range of `along`.
fn lines(scene: &Scene, along: Parameter) -> Vec<[f64; 4]> {
    const RANDOM: usize = 40;
    const OVERSHOOT: f64 = 0.5;
    const SEED: u64 = 4;
    let across: Vec<Parameter> = scene
        .parameters
        .into_iter()
        .filter(|&parameter| {
            parameter != along && !matches!(scene.extents[parameter.dimension()], Extent::Fixed(_))
        })
        .collect();
    let mut random = Pcg64Mcg::seed_from_u64(SEED);
    let edges = 1_usize << across.len();
    let line = |i: usize| {
        let mut line = scene.extents.map(|extent| extent.ends()[0]);
        for (bit, &parameter) in across.iter().enumerate() {
            let range = scene.extents[parameter.dimension()].ends();
            let share: f64 = if i < edges {
                (i >> bit & 1) as f64
            } else {
                random.random_range(-OVERSHOOT..1.0 + OVERSHOOT)
            };
            line[parameter.dimension()] = between(parameter, range, share.clamp(0.0, 1.0));
        }
        line
    };
    (0..edges + RANDOM * across.len()).map(line).collect()
}

/// Solves points on all cores, and returns the logarithms of one after the other. The spheres on a
/// stack share their matrices at each `a_over_t`.
fn logarithms_of_all(scene: &Scene, points: &[[f64; 4]]) -> Result<Vec<f64>, Error> {
    let Some(NamedStack { stack, .. }) = &scene.stack else {
        let solve_point = |&[a_over_t, values @ ..]: &[f64; 4]| -> Result<Vec<f64>, Error> {
            let material = scene.material(values)?;
            let solved = solve_for_table(a_over_t, &material, None, scene.tolerance)?;
            Ok(logarithms_of(scene, &material, &solved))
        };
        return Ok(try_map(points, solve_point)?.concat());
    };
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&i, &j| points[i][0].total_cmp(&points[j][0]));
    let groups: Vec<&[usize]> = order
        .chunk_by(|&i, &j| points[i][0] == points[j][0])
        .collect();
    let solve_group = |group: &&[usize]| -> Result<Vec<Vec<f64>>, Error> {
        let material = |&i: &usize| {
            let [_, values @ ..] = points[i];
            scene.material(values)
        };
        let materials = group.iter().map(material).collect::<Result<Vec<_>, _>>()?;
        let a_over_t = points[group[0]][0];
        let solved = solve_stack_for_table(a_over_t, &materials, stack, scene.tolerance)?;
        Ok(materials
            .iter()
            .zip(&solved)
            .map(|(material, solved)| logarithms_of(scene, material, solved))
            .collect())
    };
    let mut logarithms = vec![Vec::new(); points.len()];
    let solved = try_map(&groups, solve_group)?;
    for (i, solved) in order.iter().zip(solved.into_iter().flatten()) {
        logarithms[*i] = solved;
    }
    Ok(logarithms.concat())
}

fn logarithms_of(scene: &Scene, material: &Material, solved: &Quantities) -> Vec<f64> {
    let es = material.sphere_film_modulus();
    scene
        .quantities
        .iter()
        .map(|&quantity| quantity.logarithm(solved.get(quantity), es))
        .collect()
}
