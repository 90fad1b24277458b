//! The shape of the probe: the error of the paraboloid beside the sphere itself, and the cost of the
//! sphere.

use contact::{Contact, Validity};
use interp::{Material, Probe, System, Table};

use super::films::films_on_glass;
use crate::clock::Timing;
use solve::{Error, solve_power_laws};

/// The contact radius over that of the sphere at which the shape is judged: the one above which
/// [`Validity`] warns.
pub const A_OVER_R: f64 = Validity::WARNING_A_OVER_R;

/// Returns the relative error of the adhesionless load under a paraboloid, beside that under the
/// sphere of its radius `R`, at one contact radius `a` with `a/R` of [`A_OVER_R`].
///
/// With `alpha = a/R` the loads are as `Pi_2` and `sum_k alpha^(2k-2)/(2k-1) Pi_2k`. Of this sum the
/// terms to the eighth power of `r` are solved. The last one stands for all after it, whose `Pi_2k`
/// are nearly equal; that is an error of less than 1e-6.
pub(super) fn error_of_paraboloid(
    a_over_t: f64,
    material: &Material,
    tolerance: f64,
) -> Result<f64, Error> {
    const EXPONENTS: [f64; 3] = [4.0, 6.0, 8.0];
    let (solution, powers) = solve_power_laws(a_over_t, material, &EXPONENTS, tolerance)?;
    let (mut sum, mut rest, mut power) = (solution.quantities.pi0, A_OVER_R.atanh(), A_OVER_R);
    rest -= power;
    for (k, law) in (2_u32..).zip(&powers) {
        power *= A_OVER_R * A_OVER_R;
        let own = power / f64::from(2 * k - 1);
        let coefficient = if law.exponent == EXPONENTS[2] {
            rest
        } else {
            own
        };
        rest -= own;
        sum += coefficient / A_OVER_R * law.pi;
    }
    Ok((solution.quantities.pi0 / sum - 1.0).abs())
}

/// Returns the time in which the embedded table makes the contact of a new film under the sphere
/// itself, over that under a paraboloid.
pub(super) fn time_ratio(timing: Timing) -> Result<f64, Error> {
    let radius = 1e-5;
    let [spheres, paraboloids] = [Probe::Sphere { radius }, Probe::Paraboloid { radius }]
        .map(|probe| films_on_glass(64, [1e5, 1e9], &probe));
    let pairs: Vec<(System, System)> = spheres?.into_iter().zip(paraboloids?).collect();
    let table = Table::embedded();
    timing.ratio(
        &pairs,
        |(sphere, _)| Contact::in_table(table, sphere),
        |(_, paraboloid)| Contact::in_table(table, paraboloid),
    )
}
