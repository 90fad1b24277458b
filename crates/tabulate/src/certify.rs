//! The measured accuracy of a table: direct solves off the nodes.

use interp::schema::Parameter;
use interp::{Certificate, Material, Quantity, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use crate::Error;
use crate::answer::Wanted;
use crate::sweep::solve_for_table;

/// Compares the table with direct solves at `points` random points, evenly distributed in the axes' coordinates but for one in five, which
/// lies on a face, edge or corner of the box.
///
/// The error at a point is the largest relative error of the quantities that the table holds.
///
/// # Errors
/// Those of the solve.
///
/// # Panics
/// If `points` is 0.
pub fn certify(table: &Table, points: usize, seed: u64, progress: &(dyn Fn(usize) + Sync)) -> Result<Certificate, Error> {
    assert!(points > 0, "a certificate needs points");
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let places: Vec<[f64; 4]> = (0..points).map(|_| Parameter::ALL.map(|parameter| place(table, parameter, &mut random))).collect();
    let mut errors: Vec<f64> = places
        .par_iter()
        .map(|&point| {
            let error = error_at(table, point)?;
            progress(1);
            Ok(error)
        })
        .collect::<Result<_, Error>>()?;
    errors.sort_by(f64::total_cmp);
    Ok(Certificate { max_error: errors[points - 1], median_error: errors[points / 2], points: points as u64, seed })
}

/// With four axes, a fifth of the points is on the surface of the box: `1 - (1 + 2 * 0.03)^-4 = 0.2`.
const OVERSHOOT: f64 = 0.03;

/// A random value on an axis, or its fixed value.
fn place(table: &Table, parameter: Parameter, random: &mut Pcg64Mcg) -> f64 {
    let nodes = table.axis(parameter);
    let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
    if nodes.len() == 1 {
        return first;
    }
    let (from, to) = (parameter.coordinate(first), parameter.coordinate(last));
    // A little beyond both ends, and back onto them.
    let share = random.random_range(-OVERSHOOT..1.0 + OVERSHOOT).clamp(0.0, 1.0);
    parameter.value(from + (to - from) * share).clamp(first, last)
}

/// The largest relative error of the interpolated quantities at one point.
fn error_at(table: &Table, [a_over_t, e1, nu1, e0]: [f64; 4]) -> Result<f64, Error> {
    let material = Material::new(e1, nu1, e0, table.description().nu0)?;
    let held = || Quantity::ALL.into_iter().filter(|&quantity| table.values(quantity).is_some());
    let solved = solve_for_table(a_over_t, &material, table.description().tolerance, Wanted::of(held()))?;
    let curve = table.curve(&material)?;
    let mut errors = held().map(|quantity| Ok((curve.quantity(quantity, a_over_t)? / solved.get(quantity) - 1.0).abs()));
    errors.try_fold(0.0, |worst, error: Result<f64, Error>| {
        error.map(|error| if error >= worst || error.is_nan() { error } else { worst })
    })
}
