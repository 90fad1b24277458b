//! The range of the attraction: the error of JKR's pull-off, and the cost of the correction.

use std::f64::consts::PI;

use contact::{CohesiveZone, Contact, Control, ZoneSize};
use interp::{Material, Probe, Quantities, Table};

use super::films::films_on_glass;
use crate::clock::Timing;
use solve::{A_OVER_T, Error, solve};

/// Tabor's parameter at which the range is judged: the smallest at which a contact counts as JKR's.
pub const TABOR: f64 = ZoneSize::JKR;

/// Returns the part by which JKR's pull-off load under a sphere that pulls off at the contact radius
/// `a` is too small, at Tabor's parameter [`TABOR`] and to first order in the length of the zone of
/// attraction, see [`ZoneSize::pull_off_error`].
///
/// The load is `A/R - B w^{1/2}` with `A = a^3 Pi0/2` and `B = 4 a (Eeq/Gamma) (pi a Es*/2)^{1/2}` in
/// units of the thickness and of the modulus that normalises the quantities. It is stationary where
/// `w^{1/2} R = A'/B'`, and the zone has the length `(pi/4) (w R^2/Es*)^{1/3}/mu^2`. The slope of
/// `A` is exact, `A' = 4 a^2 Eeq^2 es/Gamma^2`; that of `B` is a difference of two solves.
pub(super) fn error_of_jkr(
    a_over_t: f64,
    material: &Material,
    tolerance: f64,
) -> Result<f64, Error> {
    const STEP: f64 = 0.01;
    let at = |a_over_t: f64| Ok::<_, Error>(solve(a_over_t, material, tolerance)?.quantities);
    let opening = |quantities: &Quantities| quantities.eeq / quantities.gamma;
    let here = at(a_over_t)?;
    let opening_at = |a_over_t: f64| Ok::<_, Error>(opening(&at(a_over_t)?).ln());
    let [least, most] = A_OVER_T;
    let ends = [
        (a_over_t * (-STEP).exp()).max(least),
        (a_over_t * STEP.exp()).min(most),
    ];
    let change = opening_at(ends[1])? - opening_at(ends[0])?;
    let es = material.sphere_film_modulus();
    let opening = opening(&here);
    // The logarithmic slopes of `A` and `B`.
    let pressed = 8.0 * opening * opening * es / here.pi0;
    let adhesive = 1.5 + change / (ends[1] / ends[0]).ln();
    let a = a_over_t;
    let ratio = 0.5 * a.powi(3) * here.pi0 / (4.0 * a * opening * (0.5 * PI * a * es).sqrt());
    let root = ratio * pressed / adhesive;
    let zone = 0.25 * PI * (root * root / es).cbrt() / (TABOR * TABOR);
    Ok(0.5 / (1.0 - adhesive / pressed) * zone / (6.0 * a))
}

/// Returns the time of a pull-off load with the correction for a finite range, over that without.
pub(super) fn time_ratio(timing: Timing) -> Result<f64, Error> {
    const WORK: f64 = 0.02;
    let films = films_on_glass(64, [1e6, 1e9], &Probe::Paraboloid { radius: 1e-5 })?;
    let contacts = films
        .iter()
        .map(|film| Contact::in_table(Table::embedded(), film))
        .collect::<Result<Vec<Contact>, _>>()?;
    let range = CohesiveZone { stress: 1e9 };
    let jkr = |contact: &Contact| {
        contact
            .pull_off(WORK, Control::Load)
            .map(|state| state.load)
    };
    let corrected = |contact: &Contact| {
        let attraction = contact.cohesive_zone(WORK, range)?;
        attraction.pull_off(Control::Load).map(|state| state.load)
    };
    timing.ratio(&contacts, corrected, jkr)
}
