//! The case that the paper calculates, Tables 1 and 2 of Barthel, *Adhesive contact of a compliant
//! sphere to an elastic coated substrate: the thin film limit*: an elastomer lens on an
//! incompressible film on silicon.

use interp::{Contact, Curve, Elastic, System};

use crate::Error;
use crate::solve::curve;

/// Work of adhesion, J/m^2 (Table 2).
pub const WORK_OF_ADHESION: f64 = 0.04;

/// The `a/t` of Figs. 2 and 3.
pub const A_OVER_T: [f64; 2] = [1e-3, 1e3];

/// Relative tolerance of the curves that are drawn, far below the width of a line.
const TOLERANCE: f64 = 1e-8;

/// Table 1 and the radius of Table 2, with a film of this thickness (m).
///
/// # Errors
/// None for a thickness: the rest is physical.
pub fn system(film_thickness: f64) -> Result<System, Error> {
    let [film, substrate] = [Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?];
    Ok(System {
        sphere_radius: 1e-3,
        sphere_modulus: 2e6,
        film,
        film_thickness,
        substrate,
    })
}

/// The quantities of Table 1 as functions of `a/t`, from direct solves.
///
/// # Errors
/// Those of [`curve`].
pub fn quantities() -> Result<Curve, Error> {
    curve(&system(1e-6)?.material()?, A_OVER_T, TOLERANCE)
}

/// The contact with a film of this thickness (m), from direct solves.
///
/// # Errors
/// Those of [`curve`]; [`interp::Error::Unphysical`] for a thickness that is none.
pub fn contact(film_thickness: f64) -> Result<Contact, Error> {
    Ok(Contact::new(&system(film_thickness)?, quantities()?)?)
}

/// `count` values of `a/t`, evenly spaced in its logarithm, both ends of [`A_OVER_T`] included.
pub(super) fn a_over_t(count: usize) -> impl Iterator<Item = f64> {
    let [from, to] = A_OVER_T;
    (0..count)
        .map(move |i| (from * (to / from).powf(i as f64 / (count - 1) as f64)).clamp(from, to))
}
