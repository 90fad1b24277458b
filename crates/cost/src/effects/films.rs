//! The films for which effects are measured.

use interp::{Elastic, Probe, System};

/// Returns so many films on glass under a rigid probe, whose Young's moduli (Pa) grow by equal factors
/// from the first of two, which the last of them stays below.
pub(super) fn films_on_glass(
    count: i32,
    [first, beyond]: [f64; 2],
    probe: &Probe,
) -> Result<Vec<System>, interp::Error> {
    let film = |i: i32| {
        let part = f64::from(i) / f64::from(count);
        Ok(System {
            probe: probe.clone(),
            sphere_modulus: f64::INFINITY,
            film: Elastic::new(first * (beyond / first).powf(part), 0.45)?,
            film_thickness: 1e-6,
            substrate: Elastic::new(7e10, 0.22)?,
        })
    };
    (0..count).map(film).collect()
}
