//! Sphere, film and substrate from the numbers of the Python classes.

use interp::{Elastic, Error, HalfSpace, Probe, System};
use pyo3::prelude::*;

use crate::error::Failure;

/// Sphere radius, sphere modulus, film modulus, film Poisson ratio, film thickness, substrate
/// modulus, substrate Poisson ratio.
pub type SystemNumbers = [f64; 7];
/// Sphere radius, sphere modulus, modulus and Poisson ratio of the solid.
pub type HalfSpaceNumbers = [f64; 4];

/// Makes a system.
pub fn system(numbers: SystemNumbers) -> Result<System, Error> {
    let [radius, modulus, film, nu1, thickness, substrate, nu0] = numbers;
    Ok(System {
        probe: Probe::Paraboloid { radius },
        sphere_modulus: modulus,
        film: Elastic::new(film, nu1)?,
        film_thickness: thickness,
        substrate: Elastic::new(substrate, nu0)?,
    })
}

/// Makes a half-space.
pub fn half_space(numbers: HalfSpaceNumbers) -> Result<HalfSpace, Error> {
    let [radius, modulus, solid, nu] = numbers;
    Ok(HalfSpace {
        probe: Probe::Paraboloid { radius },
        sphere_modulus: modulus,
        solid: Elastic::new(solid, nu)?,
    })
}

/// Accepts Young's modulus and Poisson ratio; returns the reduced modulus.
#[pyfunction]
pub fn check_elastic(py: Python<'_>, young: f64, poisson: f64) -> PyResult<f64> {
    Elastic::new(young, poisson)
        .map(|solid| solid.reduced())
        .map_err(|error| Failure::from(error).raise(py))
}

/// Accepts the numbers of a system.
#[pyfunction]
pub fn check_system(py: Python<'_>, numbers: SystemNumbers) -> PyResult<()> {
    system(numbers)
        .and_then(|system| system.material())
        .map(drop)
        .map_err(|error| Failure::from(error).raise(py))
}

/// Accepts the numbers of a half-space; returns the compound modulus.
#[pyfunction]
pub fn check_half_space(py: Python<'_>, numbers: HalfSpaceNumbers) -> PyResult<f64> {
    half_space(numbers)
        .and_then(|system| system.compound_modulus())
        .map_err(|error| Failure::from(error).raise(py))
}
