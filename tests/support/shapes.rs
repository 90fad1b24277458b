//! Shapes of probes, and laws of relaxation, of their numbers.

use contact::Relaxation;
use interp::Probe;

/// Returns the probe `z = coefficient r^exponent`.
pub const fn power_law(coefficient: f64, exponent: f64) -> Probe {
    Probe::PowerLaw {
        coefficient,
        exponent,
    }
}

/// Returns a cone whose tip is a sphere.
pub const fn rounded_cone(radius: f64, half_angle: f64) -> Probe {
    Probe::RoundedCone { radius, half_angle }
}

/// Returns a cone with a flat end.
pub const fn flat_ended_cone(radius: f64, half_angle: f64) -> Probe {
    Probe::FlatEndedCone { radius, half_angle }
}

/// Returns the law of exponentials whose `terms` are pairs of part and time.
pub const fn prony(relaxed: f64, terms: Vec<[f64; 2]>) -> Relaxation {
    Relaxation::Prony { relaxed, terms }
}

/// Returns the law `relaxed + (1 - relaxed) (1 + t/time)^-exponent`.
pub const fn modified_power_law(relaxed: f64, exponent: f64, time: f64) -> Relaxation {
    Relaxation::ModifiedPowerLaw {
        relaxed,
        exponent,
        time,
    }
}
