//! The arithmetic of eqs. 2 to 9 in SI units.

use std::f64::consts::PI;

use crate::contact::contact::finite;
use crate::material::system::positive;
use crate::{Error, HalfSpace, Normalisation, Quantities, System};

/// A point of the reduced "JKR plot" of eq. 9, a straight line for a homogeneous system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JkrPoint {
    /// `a^{3/2} / (sqrt(pi) R)`, m^{1/2}.
    pub abscissa: f64,
    /// `F / (sqrt(6 pi) a^{3/2})`, N m^{-3/2}.
    pub ordinate: f64,
}

impl JkrPoint {
    /// From a measured contact radius `a` (m) and load `F` (N) under a sphere of radius `R` (m).
    /// Nothing is checked: without a positive `a` and `R` the coordinates are not finite, which
    /// [`JkrFit::through`](crate::JkrFit::through) refuses.
    pub fn new(a: f64, load: f64, sphere_radius: f64) -> Self {
        let power = a * a.sqrt();
        Self {
            abscissa: power / (PI.sqrt() * sphere_radius),
            ordinate: load / ((6.0 * PI).sqrt() * power),
        }
    }
}

/// The arithmetic of eqs. 2 to 9 for one system, from the four quantities at the contact's `a/t`,
/// wherever they come from.
///
/// What returns no `Result` is plain arithmetic without checks: NaN gives NaN, and what overflows
/// is infinite. The functions of [`Contact`](crate::Contact) check.
#[derive(Clone, Copy, Debug)]
pub struct Mechanics {
    radius: f64,
    /// The modulus that normalises the quantities, Pa.
    modulus: f64,
    sphere_film_modulus: f64,
    sphere_substrate_modulus: f64,
}

impl Mechanics {
    /// For the geometry and the moduli of a system.
    ///
    /// # Errors
    /// Those of [`System::material`].
    pub fn new(system: &System) -> Result<Self, Error> {
        let material = system.material()?;
        let modulus = match material.normalisation() {
            Normalisation::Sphere => system.sphere_modulus,
            Normalisation::Film => system.film.reduced(),
        };
        Ok(Self {
            radius: system.sphere_radius,
            modulus,
            sphere_film_modulus: modulus * material.sphere_film_modulus(),
            sphere_substrate_modulus: modulus * material.sphere_substrate_modulus(),
        })
    }

    /// For a sphere on a half-space. The compound modulus normalises: the quantities are
    /// [`Quantities::homogeneous`] of 1.
    ///
    /// # Errors
    /// Those of [`HalfSpace::compound_modulus`].
    pub fn half_space(system: &HalfSpace) -> Result<Self, Error> {
        let modulus = system.compound_modulus()?;
        Ok(Self {
            radius: system.sphere_radius,
            modulus,
            sphere_film_modulus: modulus,
            sphere_substrate_modulus: modulus,
        })
    }

    /// Radius `R` of the sphere, m.
    pub const fn sphere_radius(&self) -> f64 {
        self.radius
    }

    /// The compound modulus of sphere and film, `Es*` (Pa, eq. 7), which is the crack tip's; on a
    /// half-space that of sphere and solid.
    pub const fn sphere_film_modulus(&self) -> f64 {
        self.sphere_film_modulus
    }

    /// The compound modulus of sphere and substrate, `Einf*` (Pa): what there would be without the
    /// film. Infinite between rigid bodies.
    pub const fn sphere_substrate_modulus(&self) -> f64 {
        self.sphere_substrate_modulus
    }

    /// Amplitude `g(a)` (N/m) of the edge singularity at contact radius `a` (m) and work of
    /// adhesion `w` (J/m^2), `2 g^2 / (pi a Es*) = w` (eq. 8). Other crack-tip laws would replace
    /// this line alone.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for an `a` that is not positive, a negative or infinite `w`, NaN, or
    /// an amplitude too large for f64.
    pub fn edge_singularity(&self, a: f64, w: f64) -> Result<f64, Error> {
        positive("contact radius", a)?;
        work_of_adhesion(w)?;
        finite(a, (0.5 * PI * a * w * self.sphere_film_modulus).sqrt())
    }

    /// Stress intensity `K_I = 2 g / sqrt(pi a)` (Pa m^{1/2}) of the edge singularity `g` (N/m) at
    /// contact radius `a` (m): just inside the edge the normal stress pulls with
    /// `K_I / sqrt(2 pi (a - r))`. With it eq. 8 is Irwin's relation for a crack between two solids
    /// of the compound modulus `Es*`, `G = K_I^2 / (2 Es*)` (Maugis, *Contact, Adhesion and Rupture
    /// of Elastic Solids*, 2000).
    pub fn stress_intensity(&self, a: f64, edge: f64) -> f64 {
        2.0 * edge / (PI * a).sqrt()
    }

    /// Energy release rate (J/m^2) of the edge singularity `g` (N/m) at contact radius `a` (m),
    /// `G = 2 g |g| / (pi a Es*)` (eq. 8): negative where the edge presses instead of pulling.
    pub fn energy_release_rate(&self, a: f64, edge: f64) -> f64 {
        2.0 * edge * edge.abs() / (PI * a * self.sphere_film_modulus)
    }

    /// Load (N) at contact radius `a` (m) with the edge singularity `g` (N/m):
    /// `F = a^3 E* Pi0 / (2R) - 4 a g Eeq/Gamma` (eqs. 2, 4, 5, 6, in another form eq. 9).
    pub fn load(&self, a: f64, edge: f64, pi0: f64, eeq_over_gamma: f64) -> f64 {
        self.adhesionless_load(a, pi0) - 4.0 * a * edge * eeq_over_gamma
    }

    /// Load (N) and penetration (m, positive when the sphere moves in), the latter
    /// `delta = a^2 Delta0 / R - 2 g / (E* Gamma)`.
    pub fn load_and_penetration(&self, a: f64, edge: f64, q: &Quantities) -> (f64, f64) {
        let load = self.load(a, edge, q.pi0, q.eeq / q.gamma);
        (
            load,
            self.adhesionless_penetration(a, q.delta0) - 2.0 * edge / (self.modulus * q.gamma),
        )
    }

    /// `F0 = a^3 E* Pi0 / (2R)` (N), eq. 4.
    pub(crate) fn adhesionless_load(&self, a: f64, pi0: f64) -> f64 {
        a * a * a * self.modulus * pi0 / (2.0 * self.radius)
    }

    /// `delta0 = a^2 Delta0 / R` (m).
    pub(crate) fn adhesionless_penetration(&self, a: f64, delta0: f64) -> f64 {
        a * a * delta0 / self.radius
    }

    /// `S = 2 a E* Eeq` (N/m), eq. 5.
    pub(crate) fn stiffness(&self, a: f64, eeq: f64) -> f64 {
        2.0 * a * self.modulus * eeq
    }

    /// The edge singularity `g = delta_fp E* Gamma / 2` (N/m) of a flat-punch penetration (m), eq.
    /// 6.
    pub(crate) fn edge_of_flat_punch(&self, penetration: f64, gamma: f64) -> f64 {
        0.5 * penetration * self.modulus * gamma
    }

    /// The point of the reduced JKR plot for a load `F` (N) at contact radius `a` (m).
    pub fn jkr_point(&self, a: f64, load: f64) -> JkrPoint {
        JkrPoint::new(a, load, self.radius)
    }
}

/// Accepts a work of adhesion.
pub(crate) fn work_of_adhesion(w: f64) -> Result<(), Error> {
    Error::unless(
        (0.0..f64::INFINITY).contains(&w),
        "work of adhesion",
        w,
        ">= 0 and finite",
    )
}
