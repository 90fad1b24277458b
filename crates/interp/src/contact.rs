//! The adhesive contact in SI units: the arithmetic of eqs. 2, 8 and 9.

use std::f64::consts::PI;

use crate::material::{one_minus_square, poisson_ratio};
use crate::{Curve, Error, Material, Normalisation, Quantities, Quantity, Table};

/// An isotropic elastic solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    young: f64,
    poisson: f64,
}

impl Elastic {
    /// From Young's modulus (Pa; infinity is rigid) and Poisson ratio.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless `young > 0` and `poisson` is in `(-1, 0.5]`.
    pub fn new(young: f64, poisson: f64) -> Result<Self, Error> {
        Error::unless(young > 0.0, "Young's modulus", young, "> 0 (inf is rigid)")?;
        poisson_ratio("Poisson ratio", poisson)?;
        Ok(Self { young, poisson })
    }

    /// Young's modulus, Pa.
    pub const fn young(&self) -> f64 {
        self.young
    }

    /// Poisson ratio.
    pub const fn poisson(&self) -> f64 {
        self.poisson
    }

    /// The reduced modulus `E/(1 - nu^2)`, Pa.
    pub const fn reduced(&self) -> f64 {
        self.young / one_minus_square(self.poisson)
    }
}

/// Sphere, film and substrate in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct System {
    /// Radius `R` of the sphere, m.
    pub sphere_radius: f64,
    /// Reduced modulus `E2* = E2/(1 - nu2^2)` of the sphere, Pa; infinity is a rigid sphere.
    pub sphere_modulus: f64,
    /// The film (body 1).
    pub film: Elastic,
    /// Thickness `t` of the film, m.
    pub film_thickness: f64,
    /// The substrate (body 0).
    pub substrate: Elastic,
}

impl System {
    /// The dimensionless material of the system.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for a length or modulus that is not positive, or a rigid film.
    pub fn material(&self) -> Result<Material, Error> {
        positive("sphere_radius", self.sphere_radius)?;
        positive("film_thickness", self.film_thickness)?;
        positive("film modulus", self.film.young)?;
        Error::unless(self.sphere_modulus > 0.0, "sphere_modulus", self.sphere_modulus, "> 0 (inf is a rigid sphere)")?;
        let rigid = self.sphere_modulus == f64::INFINITY;
        let unit = if rigid { self.film.young } else { self.sphere_modulus };
        let e1_over_e2 = if rigid { 0.0 } else { self.film.young / unit };
        Material::new(e1_over_e2, self.film.poisson, self.substrate.young / unit, self.substrate.poisson)
    }
}

/// A point of the reduced "JKR plot" of eq. 9, a straight line for a homogeneous system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JkrPoint {
    /// `a^{3/2} / (sqrt(pi) R)`, m^{1/2}.
    pub abscissa: f64,
    /// `F / (sqrt(6 pi) a^{3/2})`, N m^{-3/2}.
    pub ordinate: f64,
}

/// The arithmetic of eqs. 2 to 9 for one system, from the four quantities at the contact's `a/t`, wherever they come from.
#[derive(Clone, Copy, Debug)]
pub struct Mechanics {
    radius: f64,
    /// The modulus that normalises the quantities, Pa.
    modulus: f64,
    /// The compound sphere-film modulus `Es*`, Pa.
    sphere_film_modulus: f64,
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
        let sphere_film_modulus = modulus * material.sphere_film_modulus();
        Ok(Self { radius: system.sphere_radius, modulus, sphere_film_modulus })
    }

    /// Amplitude `g(a)` (N/m) of the edge singularity at contact radius `a` (m) and work of adhesion `w` (J/m^2),
    /// `2 g^2 / (pi a Es*) = w` (eq. 8). Other crack-tip laws would replace this line alone.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for an `a` that is not positive, a negative or infinite `w`, or NaN.
    pub fn edge_singularity(&self, a: f64, w: f64) -> Result<f64, Error> {
        positive("contact radius", a)?;
        Error::unless((0.0..f64::INFINITY).contains(&w), "work of adhesion", w, ">= 0 and finite")?;
        Ok((0.5 * PI * a * w * self.sphere_film_modulus).sqrt())
    }

    /// Load (N) at contact radius `a` (m) with the edge singularity `g` (N/m):
    /// `F = a^3 E* Pi0 / (2R) - 4 a g Eeq/Gamma` (eqs. 2, 4, 5, 6, in another form eq. 9).
    pub fn load(&self, a: f64, edge: f64, pi0: f64, eeq_over_gamma: f64) -> f64 {
        a * a * a * self.modulus * pi0 / (2.0 * self.radius) - 4.0 * a * edge * eeq_over_gamma
    }

    /// Load (N) and penetration (m, positive when the sphere moves in), the latter `delta = a^2 Delta0 / R - 2 g / (E* Gamma)`.
    pub fn load_and_penetration(&self, a: f64, edge: f64, q: &Quantities) -> (f64, f64) {
        let load = self.load(a, edge, q.pi0, q.eeq / q.gamma);
        (load, a * a * q.delta0 / self.radius - 2.0 * edge / (self.modulus * q.gamma))
    }

    /// Energy release rate (J/m^2) of the edge singularity `g` (N/m) at contact radius `a` (m), `G = 2 g |g| / (pi a Es*)` (eq. 8): negative where
    /// the edge presses instead of pulling.
    pub fn energy_release_rate(&self, a: f64, edge: f64) -> f64 {
        2.0 * edge * edge.abs() / (PI * a * self.sphere_film_modulus)
    }

    /// The point of the reduced JKR plot for a load `F` (N) at contact radius `a` (m).
    pub fn jkr_point(&self, a: f64, load: f64) -> JkrPoint {
        let power = a * a.sqrt();
        JkrPoint { abscissa: power / (PI.sqrt() * self.radius), ordinate: load / ((6.0 * PI).sqrt() * power) }
    }
}

/// A system with the curve of its material, from a table or a solve: force curves are now arithmetic.
#[derive(Clone, Debug)]
pub struct Contact {
    film_thickness: f64,
    curve: Curve,
    mechanics: Mechanics,
}

impl Table {
    /// Looks up the material of a system.
    ///
    /// # Errors
    /// Those of [`System::material`] and [`Table::curve`].
    pub fn contact(&self, system: &System) -> Result<Contact, Error> {
        Contact::new(system, self.curve(&system.material()?)?)
    }
}

impl Contact {
    /// A system with a curve made for its material, or for the [equivalent](Material::with_substrate_poisson_ratio) on a substrate with
    /// another Poisson ratio.
    ///
    /// # Errors
    /// Those of [`System::material`]; [`Error::OtherMaterial`] if the curve was made for another one, by more than rounding (`1e-12`).
    pub fn new(system: &System, curve: Curve) -> Result<Self, Error> {
        let (mechanics, made_for) = (Mechanics::new(system)?, curve.material());
        let material = system.material()?.with_substrate_poisson_ratio(made_for.nu0())?;
        if !material.is_close_to(made_for) {
            return Err(Error::OtherMaterial { curve: *made_for, system: material });
        }
        Ok(Self { film_thickness: system.film_thickness, curve, mechanics })
    }

    /// The dimensionless quantities as functions of `a/t`.
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// The smallest and the largest contact radius (m) that the curve covers.
    pub fn contact_radius_range(&self) -> [f64; 2] {
        self.curve.range().map(|a_over_t| a_over_t * self.film_thickness)
    }

    /// The arithmetic, for quantities from elsewhere.
    pub fn mechanics(&self) -> &Mechanics {
        &self.mechanics
    }

    /// Load `F` (N, positive in compression) at contact radius `a` (m) and work of adhesion `w` (J/m^2): eq. 9.
    ///
    /// Each of its two terms has the relative error of the curve.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] where the curve does not cover `a/t`; [`Error::Unphysical`] for `a <= 0`, `w < 0` or NaN;
    /// [`Error::MissingQuantity`] without `pi0`, `eeq` and `gamma`.
    pub fn load(&self, a: f64, w: f64) -> Result<f64, Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let (pi0, eeq_over_gamma) = self.curve.load_factors(a / self.film_thickness)?;
        Ok(self.mechanics.load(a, edge, pi0, eeq_over_gamma))
    }

    /// Load (N) and penetration (m, positive when the sphere moves in) at contact radius `a` (m) and work of adhesion `w` (J/m^2).
    ///
    /// # Errors
    /// As [`Contact::load`], and [`Error::MissingQuantity`] without `delta0`.
    pub fn load_and_penetration(&self, a: f64, w: f64) -> Result<(f64, f64), Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        Ok(self.mechanics.load_and_penetration(a, edge, &self.curve.quantities(a / self.film_thickness)?))
    }

    /// Energy release rate `G` (J/m^2) from a measured contact radius `a` (m) and load (N): that of the edge which takes the load from the
    /// adhesionless `F0(a)` to `load`. Negative for a load above `F0`, which only a contact that grows can bear.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] where the curve does not cover `a/t`; [`Error::Unphysical`] for `a <= 0`, or numbers that are not finite;
    /// [`Error::MissingQuantity`] without `pi0`, `eeq` and `gamma`.
    pub fn energy_release_rate_at_load(&self, a: f64, load: f64) -> Result<f64, Error> {
        positive("contact radius", a)?;
        Error::unless(load.is_finite(), "load", load, "finite")?;
        let (pi0, eeq_over_gamma) = self.curve.load_factors(a / self.film_thickness)?;
        let edge = (self.mechanics.load(a, 0.0, pi0, eeq_over_gamma) - load) / (4.0 * a * eeq_over_gamma);
        Ok(self.mechanics.energy_release_rate(a, edge))
    }

    /// Energy release rate `G` (J/m^2) from a measured contact radius `a` (m) and penetration (m): that of the edge which takes the
    /// penetration from the adhesionless `delta0(a)` to `penetration`. Negative for a penetration above `delta0`, which only a contact that grows can
    /// have.
    ///
    /// # Errors
    /// As [`Contact::energy_release_rate_at_load`], but [`Error::MissingQuantity`] without `gamma` and `delta0`.
    pub fn energy_release_rate_at_penetration(&self, a: f64, penetration: f64) -> Result<f64, Error> {
        positive("contact radius", a)?;
        Error::unless(penetration.is_finite(), "penetration", penetration, "finite")?;
        let x = a / self.film_thickness;
        let (gamma, delta0) = (self.curve.quantity(Quantity::Gamma, x)?, self.curve.quantity(Quantity::Delta0, x)?);
        let flat_punch = a * a * delta0 / self.mechanics.radius - penetration;
        Ok(self.mechanics.energy_release_rate(a, 0.5 * flat_punch * self.mechanics.modulus * gamma))
    }

    /// Contact stiffness `S = 2 a E* Eeq` (N/m) at contact radius `a` (m), eq. 5.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] where the curve does not cover `a/t`, [`Error::MissingQuantity`] without `eeq`.
    pub fn stiffness(&self, a: f64) -> Result<f64, Error> {
        Ok(2.0 * a * self.mechanics.modulus * self.curve.quantity(Quantity::Eeq, a / self.film_thickness)?)
    }
}

/// Accepts a positive finite value.
fn positive(name: &'static str, value: f64) -> Result<(), Error> {
    Error::unless(value > 0.0 && value.is_finite(), name, value, "> 0 and finite")
}
