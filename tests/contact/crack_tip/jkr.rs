//! JKR in closed form.

use std::f64::consts::PI;

use contact::{Contact, State};

/// Work of adhesion, J/m^2.
pub const W: f64 = 0.04;
/// Radius of the sphere, m.
pub const R: f64 = 1e-3;

/// JKR in closed form.
pub struct Jkr {
    /// The reduced modulus, Pa.
    pub e: f64,
}

impl Jkr {
    pub fn of(contact: &Contact) -> Self {
        Self {
            e: contact.mechanics().sphere_film_modulus(),
        }
    }

    pub fn penetration(&self, a: f64, w: f64) -> f64 {
        a * a / R - (2.0 * PI * a * w / self.e).sqrt()
    }

    /// Returns the stable contact radius at `load`.
    pub fn radius(&self, load: f64, w: f64) -> f64 {
        let unit = 3.0 * PI * w * R;
        (3.0 * R / (4.0 * self.e) * (load + unit + (2.0 * unit * load + unit * unit).sqrt())).cbrt()
    }

    /// Returns the energy release rate at `penetration`.
    pub fn rate(&self, a: f64, penetration: f64) -> f64 {
        let punch = a * a / R - penetration;
        self.e * punch * punch.abs() / (2.0 * PI * a)
    }

    /// Returns the elastic energy.
    pub fn energy(&self, state: &State) -> f64 {
        let State {
            contact_radius: a,
            penetration: delta,
            ..
        } = *state;
        self.e
            * (delta * delta * a - 2.0 * delta * a.powi(3) / (3.0 * R) + a.powi(5) / (5.0 * R * R))
    }

    /// Returns radius and penetration at pull-off under displacement control.
    pub fn pull_off(&self, w: f64) -> (f64, f64) {
        let a = (PI * w * R * R / (8.0 * self.e)).cbrt();
        (a, self.penetration(a, w))
    }
}
