//! JKR in closed form.

use std::f64::consts::PI;

use contact::{Contact, State};

/// JKR with radius `R`, compound modulus `E*` and work of adhesion `w`.
#[derive(Clone, Copy)]
pub struct Jkr {
    pub r: f64,
    pub e: f64,
    pub w: f64,
}

impl Jkr {
    /// Returns JKR for the bodies of a contact.
    pub fn of(contact: &Contact, w: f64) -> Self {
        let mechanics = contact.mechanics();
        let (r, e) = (mechanics.sphere_radius(), mechanics.sphere_film_modulus());
        Self { r, e, w }
    }

    /// Returns load and penetration, each as its adhesionless and its flat-punch term.
    pub fn terms(&self, a: f64) -> [[f64; 2]; 2] {
        let Self { r, e, w } = *self;
        [
            [
                4.0 * e * a.powi(3) / (3.0 * r),
                (8.0 * PI * w * e * a.powi(3)).sqrt(),
            ],
            [a * a / r, (2.0 * PI * a * w / e).sqrt()],
        ]
    }

    /// Returns the radii of the stable and the unstable contact at `load`, from `F = A y^2 - B y`
    /// with `y = a^{3/2}`.
    pub fn radii(&self, load: f64) -> [f64; 2] {
        let Self { r, e, w } = *self;
        let (a, b) = (4.0 * e / (3.0 * r), (8.0 * PI * w * e).sqrt());
        let sum = b + (b * b + 4.0 * a * load).sqrt();
        [sum / (2.0 * a), -2.0 * load / sum].map(|y| y.powf(2.0 / 3.0))
    }

    /// Returns the radius of least penetration.
    pub fn least_penetration(&self) -> f64 {
        (PI * self.w * self.r * self.r / (8.0 * self.e)).cbrt()
    }

    pub fn penetration(&self, a: f64) -> f64 {
        let [_, [hertz, punch]] = self.terms(a);
        hertz - punch
    }

    /// Returns the energy release rate at `penetration`.
    pub fn rate(&self, a: f64, penetration: f64) -> f64 {
        let punch = a * a / self.r - penetration;
        self.e * punch * punch.abs() / (2.0 * PI * a)
    }

    /// Returns the elastic energy.
    pub fn energy(&self, state: &State) -> f64 {
        let (a, delta, r) = (state.contact_radius, state.penetration, self.r);
        self.e
            * (delta * delta * a - 2.0 * delta * a.powi(3) / (3.0 * r) + a.powi(5) / (5.0 * r * r))
    }
}
