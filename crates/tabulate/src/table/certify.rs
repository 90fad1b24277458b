//! The certificate of a table: the largest error at sampled points off the nodes, measured against
//! direct solves, and the largest errors of four exact identities.

use interp::{Certificate, Curve, Parameter, Quantity, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::Error;
use crate::table::of_stack::stack_of;
use crate::table::placement::between;
use crate::table::scene::material;
use crate::table::sweep::solve_for_table;
use solve::parallel::try_map;
use solve::stack::Stack;

/// The error of a table at one point, measured against a direct solve.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The values of the table's parameters.
    pub point: [f64; 4],
    /// The largest relative error of the quantities that the table answers: those that it holds, or
    /// all four if it holds `Gamma` alone and begins at a small `a/t`.
    pub error: f64,
    /// The quantity that has it.
    pub quantity: Quantity,
    /// The relative error of each of [`Quantity::ALL`], none of a quantity that the table does
    /// not answer.
    pub errors: [Option<f64>; 4],
    /// The relative errors of the interpolant in the four exact identities, see
    /// [`Certificate::identity_errors`]; none where a quantity is missing or `a/t` is fixed.
    pub identity_errors: [Option<f64>; 4],
}

/// Returns the default number of points of the certificate of a table with this number of axes.
pub const fn default_points(axes: usize) -> usize {
    2500 * if axes == 0 { 1 } else { axes }
}

/// Returns the default number of points of the certificate of `table`.
pub fn points_for(table: &Table) -> usize {
    default_points(table.shape().iter().filter(|&&nodes| nodes > 1).count())
}

/// Compares the table with direct solves at `points` points, see [`measure`], and returns the
/// certificate.
///
/// # Errors
/// Those of the solve.
///
/// # Panics
/// If `points` is 0.
pub fn certify(
    table: &Table,
    points: usize,
    seed: u64,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Certificate, Error> {
    Ok(certificate(&measure(table, points, seed, progress)?, seed))
}

/// Returns the certificate that the samples of one seed make.
///
/// # Panics
/// If `samples` is empty.
pub fn certificate(samples: &[Sample], seed: u64) -> Certificate {
    let mut errors: Vec<f64> = samples.iter().map(|sample| sample.error).collect();
    errors.sort_by(f64::total_cmp);
    let largest = |a: &&Sample, b: &&Sample| a.error.total_cmp(&b.error);
    let worst = samples
        .iter()
        .max_by(largest)
        .expect("a certificate needs points");
    let identity = |i: usize| {
        samples
            .iter()
            .filter_map(|sample| sample.identity_errors[i])
            .max_by(f64::total_cmp)
    };
    let count = errors.len();
    Certificate {
        max_error: worst.error,
        // A thousandth of the errors is larger.
        p999_error: errors[count - 1 - count / 1000],
        median_error: errors[count / 2],
        points: count as u64,
        seed,
        worst_quantity: worst.quantity,
        worst_point: worst.point,
        identity_errors: [0, 1, 2, 3].map(identity),
    }
}

/// Returns the largest and the median error of each quantity that the table answers at any of the
/// `samples`.
pub fn errors_by_quantity(samples: &[Sample]) -> Vec<(Quantity, [f64; 2])> {
    let of = |quantity: Quantity| {
        let errors = samples
            .iter()
            .filter_map(|sample| sample.errors[quantity as usize]);
        let mut errors: Vec<f64> = errors.collect();
        errors.sort_by(f64::total_cmp);
        Some((quantity, [*errors.last()?, errors[errors.len() / 2]]))
    };
    Quantity::ALL.into_iter().filter_map(of).collect()
}

/// Compares the table with direct solves at `points` points.
///
/// - The corners of the box come first, a tenth of the points at most, because they are nodes.
/// - A tenth lies on edges of the box.
/// - A tenth lies in the middles of the widest cells.
/// - The others are random and evenly distributed in the axes' coordinates. In four axes, one in
///   five of them lies on a face, an edge or a corner.
///
/// # Errors
/// Those of the solve: of several, the error of the first point.
pub fn measure(
    table: &Table,
    points: usize,
    seed: u64,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Sample>, Error> {
    let stack = stack_of(table)?.map(|named| named.stack);
    try_map(places(table, points, seed), |point| {
        let sample = sample_of(table, stack.as_ref(), point)?;
        progress(1);
        Ok(sample)
    })
}

/// The most places that are tried for each point.
const MOST_TRIED: usize = 100;

/// Returns the points of [`measure`].
fn places(table: &Table, count: usize, seed: u64) -> Vec<[f64; 4]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let axes = table
        .parameters()
        .map(|parameter| Axis::new(parameter, table.axis(parameter)));
    let free: Vec<usize> = (0..4).filter(|&k| axes[k].cells() > 0).collect();
    let corners = 1_usize << free.len();
    let corner = |index: usize| {
        std::array::from_fn(|k| {
            axes[k].end(
                free.iter()
                    .position(|&f| f == k)
                    .map_or(0, |bit| index >> bit & 1),
            )
        })
    };
    let is_answered = |&[_, values @ ..]: &[f64; 4]| {
        let material = material(table.parameters(), table.description().nu0, values);
        material.map_or(true, |material| {
            material.sphere_film_modulus() >= Table::SOFTEST
        })
    };
    let mut places: Vec<[f64; 4]> = (0..corners.min(count / 10)).map(corner).collect();
    for _ in 0..MOST_TRIED * count {
        if places.len() == count {
            break;
        }
        let place = match places.len() % 10 {
            0 if !free.is_empty() => {
                let mut place = corner(random.random_range(0..corners));
                let along = free[random.random_range(0..free.len())];
                place[along] = axes[along].at(random.random_range(0.0..1.0));
                place
            }
            1 => axes
                .each_ref()
                .map(|axis| axis.middle_of_a_wide_cell(&mut random)),
            _ => axes.each_ref().map(|axis| axis.anywhere(&mut random)),
        };
        // Two moduli that go to 0 and to infinity make films so soft that the table does not answer.
        if is_answered(&place) {
            places.push(place);
        }
    }
    places
}

/// The part of an axis by which random places overshoot each end before they are moved to the end.
/// In four axes, a fifth of the random points is on the surface of the box:
/// `1 - (1 + 2 * 0.03)^-4 = 0.2`.
const OVERSHOOT: f64 = 0.03;

/// An axis of the table, for placing points on it.
pub(crate) struct Axis<'a> {
    parameter: Parameter,
    nodes: &'a [f64],
    /// The cells, the widest first.
    widest: Vec<usize>,
}

impl<'a> Axis<'a> {
    pub(crate) fn new(parameter: Parameter, nodes: &'a [f64]) -> Self {
        let width =
            |&i: &usize| parameter.coordinate(nodes[i]) - parameter.coordinate(nodes[i + 1]);
        let mut widest: Vec<usize> = (0..nodes.len() - 1).collect();
        widest.sort_by(|a, b| width(a).total_cmp(&width(b)));
        Self {
            parameter,
            nodes,
            widest,
        }
    }

    fn cells(&self) -> usize {
        self.nodes.len() - 1
    }

    /// Returns the first node for `which = 0`, the last node for `which = 1`.
    fn end(&self, which: usize) -> f64 {
        self.nodes[which * self.cells()]
    }

    /// Returns the value at the part `share` of the axis, in its coordinate.
    pub(crate) fn at(&self, share: f64) -> f64 {
        if self.cells() == 0 {
            self.nodes[0]
        } else {
            between(self.parameter, [self.end(0), self.end(1)], share)
        }
    }

    /// Returns a random value. The ends, which are nodes, are more likely than other values.
    pub(crate) fn anywhere(&self, random: &mut Pcg64Mcg) -> f64 {
        self.at(random
            .random_range(-OVERSHOOT..1.0 + OVERSHOOT)
            .clamp(0.0, 1.0))
    }

    /// Returns the middle of a random one of the widest cells, an eighth of all.
    fn middle_of_a_wide_cell(&self, random: &mut Pcg64Mcg) -> f64 {
        if self.cells() == 0 {
            return self.nodes[0];
        }
        let cell = self.widest[random.random_range(0..self.cells().div_ceil(8))];
        let ends = [self.nodes[cell], self.nodes[cell + 1]];
        between(self.parameter, ends, 0.5)
    }
}

/// Compares the table with the direct solve at one point.
///
/// # Errors
/// Those of the solve; [`Error::Table`] for a point outside the table.
pub fn sample(table: &Table, point: [f64; 4]) -> Result<Sample, Error> {
    let stack = stack_of(table)?.map(|named| named.stack);
    sample_of(table, stack.as_ref(), point)
}

/// Compares a table, that of a `stack` if one is given, with the direct solve at one point.
fn sample_of(table: &Table, stack: Option<&Stack>, point: [f64; 4]) -> Result<Sample, Error> {
    let [a_over_t, values @ ..] = point;
    let description = table.description();
    let material = material(table.parameters(), description.nu0, values)?;
    let tolerance = description.tolerance;
    let solved = solve_for_table(a_over_t, &material, stack, tolerance)?;
    let curve = match stack {
        None => table.curve(&material)?,
        Some(stack) => stack.curve_in(table, stack.surface().young() / material.e1_over_e2())?,
    };
    let mut errors = [None; 4];
    for candidate in Quantity::ALL {
        if let Some(value) = answered(curve.quantity(candidate, a_over_t))? {
            errors[candidate as usize] = Some((value / solved.get(candidate) - 1.0).abs());
        }
    }
    let of_quantities = errors.into_iter().zip(Quantity::ALL);
    let (error, quantity) = of_quantities
        .filter_map(|(error, quantity)| Some((error?, quantity)))
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .expect("a table answers what it holds");
    Ok(Sample {
        point,
        error,
        quantity,
        errors,
        identity_errors: identity_errors(&curve, a_over_t),
    })
}

/// Returns what a curve answers; none where the table does not hold what it needs, or begins at too
/// large an `a/t`.
fn answered<T>(answer: Result<T, interp::Error>) -> Result<Option<T>, interp::Error> {
    match answer {
        Err(interp::Error::MissingQuantity(_) | interp::Error::BeginsTooLate { .. }) => Ok(None),
        answer => answer.map(Some),
    }
}

/// Returns the errors of the four [identities](Certificate::identity_errors) on a curve, relative
/// to the sizes of their terms; none where the curve does not answer a quantity of the identity.
fn identity_errors(curve: &Curve, a_over_t: f64) -> [Option<f64>; 4] {
    if curve.range()[0] == curve.range()[1] {
        // A single a/t has no slope.
        return [None; 4];
    }
    let value = |quantity| curve.quantity(quantity, a_over_t).ok();
    let (eeq, gamma) = (value(Quantity::Eeq), value(Quantity::Gamma));
    // `n Q + x Q'`, the derivative of `x^n Q` over `x^(n-1)`, and the sum of the sizes of its
    // terms. Where a film much stiffer than its substrate moves as a whole, `x Eeq` hardly changes
    // and the sum is far smaller than its terms.
    let rate = |n: f64, quantity| {
        let (value, slope) = (n * value(quantity)?, curve.slope(quantity, a_over_t).ok()?);
        Some([value + slope, value.abs() + slope.abs()])
    };
    let es = curve.material().sphere_film_modulus();
    let error = |[left, size]: [f64; 2], right: f64| (left - right).abs() / size;
    let energy = || Some(error(rate(1.0, Quantity::Eeq)?, gamma?.powi(2) / es));
    let stiffness = || {
        let [right, _] = rate(2.0, Quantity::Delta0)?;
        Some(error(rate(3.0, Quantity::Pi0)?, 4.0 * eeq? * right))
    };
    let penetration = || {
        let right = 2.0 * es * eeq? / gamma?.powi(2);
        Some(error(rate(2.0, Quantity::Delta0)?, right))
    };
    let load = || {
        let right = 8.0 * es * (eeq? / gamma?).powi(2);
        Some(error(rate(3.0, Quantity::Pi0)?, right))
    };
    [energy(), stiffness(), penetration(), load()]
}
