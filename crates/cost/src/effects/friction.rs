//! Friction: the error of the load without it, and the cost of full friction.

use interp::Material;
use solve::stick::{StickCurves, Sticking};
use solve::{Error, curve};

use crate::clock::Timing;

/// The largest `a/t` at which friction is judged; at larger ones the effect is taken to be that at
/// this one.
pub const WIDEST: f64 = 100.0;

/// The Poisson ratio of the sphere.
const NU2: f64 = 0.5;
/// The relative tolerance of the punches.
const TOLERANCE: f64 = 1e-5;

/// Returns the part by which the load of a flat punch without friction is below that with full
/// friction at the same penetration.
pub(super) fn error_without(a_over_t: f64, material: &Material) -> Result<f64, Error> {
    let sticking = Sticking::on_film(material, NU2)?;
    Ok((1.0 - 1.0 / sticking.stiffening(a_over_t.min(WIDEST), TOLERANCE)?).abs())
}

/// Returns the time of a curve of a sphere with full friction, over that of one without, of
/// incompressible films under a rigid sphere up to an `a/t` of 3.
pub(super) fn time_ratio(timing: Timing) -> Result<f64, Error> {
    const RANGE: [f64; 2] = [1e-2, 3.0];
    const TOLERANCE: f64 = 1e-8;
    let material = Material::new(0.0, 0.5, 1e3, 0.25)?;
    let sticking = Sticking::on_film(&material, NU2)?;
    let sticks = |(): &()| StickCurves::new(&sticking, RANGE, TOLERANCE)?.receding(1.0);
    let slides = |(): &()| curve(&material, RANGE, TOLERANCE);
    timing.ratio(&[()], sticks, slides)
}
