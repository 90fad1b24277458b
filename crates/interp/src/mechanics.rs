//! The arithmetic of eqs. 2 to 9 in SI units.

use std::f64::consts::PI;

use crate::check::{finite_result, positive, work_of_adhesion};
use crate::{Error, HalfSpace, Normalisation, Quantities, System};

/// Load and penetration at one contact radius, or two derivatives of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadAndPenetration {
    /// Load, N.
    pub load: f64,
    /// Penetration, m.
    pub penetration: f64,
}

impl LoadAndPenetration {
    /// Both are 0.
    pub const ZERO: Self = Self {
        load: 0.0,
        penetration: 0.0,
    };

    /// Returns both times a factor.
    #[must_use]
    pub const fn times(self, factor: f64) -> Self {
        Self {
            load: self.load * factor,
            penetration: self.penetration * factor,
        }
    }

    /// Returns the sums with another pair.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self {
            load: self.load + other.load,
            penetration: self.penetration + other.penetration,
        }
    }

    /// Returns the differences from another pair.
    #[must_use]
    pub const fn minus(self, other: Self) -> Self {
        Self {
            load: self.load - other.load,
            penetration: self.penetration - other.penetration,
        }
    }
}

/// The arithmetic of eqs. 2 to 9 for one system, from given values of the four quantities at the
/// contact's `a/t`.
///
/// Load and penetration without adhesion are those of the paraboloid, for which `Pi0` and `Delta0`
/// are defined. Under another probe use the crate `contact`; here the
/// loads and penetrations of a sphere are those of its paraboloid, and those of a probe without a
/// radius of curvature are NaN. Everything else does not depend on the shape.
///
/// A function that returns no `Result` is plain arithmetic without checks: NaN gives NaN, and a
/// result too large for an f64 is infinite. The functions of [`ForceCurve`](crate::ForceCurve) check.
#[derive(Clone, Copy, Debug)]
pub struct Mechanics {
    /// The radius of curvature at the tip, m; NaN without one.
    sphere_radius: f64,
    /// The name of the probe's shape.
    probe: &'static str,
    /// The smallest and the largest contact radius that the shape has, m. The contact radius of a
    /// probe with a tip is larger than 0, and the largest one is excluded.
    radii: [f64; 2],
    /// The modulus `E*` that normalises the quantities, Pa.
    modulus: f64,
    sphere_film_modulus: f64,
    sphere_substrate_modulus: f64,
}

impl Mechanics {
    /// Takes the geometry and the moduli of a system.
    ///
    /// # Errors
    /// As [`System::material`].
    pub fn new(system: &System) -> Result<Self, Error> {
        let material = system.material()?;
        let modulus = match material.normalisation() {
            Normalisation::Sphere => system.sphere_modulus,
            Normalisation::Film => system.film.reduced(),
        };
        Ok(Self {
            sphere_radius: system.probe.tip_radius(),
            probe: system.probe.name(),
            radii: system.probe.contact_radii(),
            modulus,
            sphere_film_modulus: modulus * material.sphere_film_modulus(),
            sphere_substrate_modulus: modulus * material.sphere_substrate_modulus(),
        })
    }

    /// Takes the geometry and the moduli of a probe on a half-space.
    ///
    /// The compound modulus normalises: the quantities are [`Quantities::homogeneous`] of 1.
    ///
    /// # Errors
    /// As [`HalfSpace::compound_modulus`].
    pub fn half_space(system: &HalfSpace) -> Result<Self, Error> {
        let modulus = system.compound_modulus()?;
        Ok(Self {
            sphere_radius: system.probe.tip_radius(),
            probe: system.probe.name(),
            radii: system.probe.contact_radii(),
            modulus,
            sphere_film_modulus: modulus,
            sphere_substrate_modulus: modulus,
        })
    }

    /// Returns the radius `R` of the sphere or paraboloid, or that of the end of a rounded cone, m;
    /// NaN for a probe without a radius of curvature.
    pub const fn sphere_radius(&self) -> f64 {
        self.sphere_radius
    }

    /// Returns the name of the probe's shape.
    pub const fn probe(&self) -> &'static str {
        self.probe
    }

    /// Returns the smallest and the largest contact radius that the shape of the probe has, m.
    pub const fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// Returns the same arithmetic with contact radii up to `most` (m) only.
    pub fn with_largest_radius(mut self, most: f64) -> Self {
        self.radii[1] = self.radii[1].min(most);
        self
    }

    /// Returns the compound modulus `Es*` of sphere and film (Pa, eq. 7), on a half-space that of
    /// sphere and solid. It is the modulus of the crack tip.
    pub const fn sphere_film_modulus(&self) -> f64 {
        self.sphere_film_modulus
    }

    /// Returns the compound modulus `Einf*` of sphere and substrate (Pa), that of the contact
    /// without the film. It is infinite if both are rigid.
    pub const fn sphere_substrate_modulus(&self) -> f64 {
        self.sphere_substrate_modulus
    }

    /// Accepts a contact radius `a` (m) that the shape of the probe has: positive and below the
    /// radius of a sphere, not below the radius of a flat end, that of a flat punch.
    ///
    /// # Errors
    /// [`Error::BeyondSphere`], [`Error::BeyondProbe`], and [`Error::Unphysical`] unless `a` is
    /// positive and finite.
    #[inline]
    pub fn check_radius(&self, a: f64) -> Result<(), Error> {
        let [from, to] = self.radii;
        if a > 0.0 && a >= from && a < to {
            Ok(())
        } else {
            Err(self.wrong_radius(a))
        }
    }

    /// Makes the error of a contact radius that the shape of the probe does not have.
    #[cold]
    fn wrong_radius(&self, a: f64) -> Error {
        if let Err(error) = positive("contact radius", a) {
            return error;
        }
        let [from, to] = self.radii;
        if to == self.sphere_radius {
            return Error::BeyondSphere {
                contact_radius: a,
                sphere_radius: to,
            };
        }
        let (allowed, limit) = if from > 0.0 && to < 1.01 * from {
            ("that of the punch,", 0.5 * (from + to))
        } else if a < from {
            ("at least the radius of the flat end,", from)
        } else {
            (
                "below the largest one for which the shape is known or computed,",
                to,
            )
        };
        Error::BeyondProbe {
            probe: self.probe,
            contact_radius: a,
            allowed,
            limit,
        }
    }

    /// Returns the amplitude `g(a)` (N/m) of the edge singularity at contact radius `a` (m) and
    /// work of adhesion `w` (J/m^2), from `2 g^2 / (pi a Es*) = w` (eq. 8).
    ///
    /// Another crack-tip law would replace this equation alone.
    ///
    /// # Errors
    /// [`Error::BeyondSphere`] for an `a` that is not below the radius of the sphere;
    /// [`Error::BeyondProbe`] for one that another shape does not have; [`Error::Unphysical`] for an
    /// `a` that is not positive, a negative `w`, infinity, NaN, or an amplitude that overflows an
    /// f64.
    #[inline]
    pub fn edge_singularity(&self, a: f64, w: f64) -> Result<f64, Error> {
        self.check_radius(a)?;
        work_of_adhesion(w)?;
        finite_result(a, (0.5 * PI * a * w * self.sphere_film_modulus).sqrt())
    }

    /// Returns the stress intensity `K_I = 2 g / sqrt(pi a)` (Pa m^{1/2}) of the edge singularity
    /// `edge`, `g` (N/m), at contact radius `a` (m).
    ///
    /// Just inside the edge the tensile normal stress is `K_I / sqrt(2 pi (a - r))`. In terms of
    /// `K_I`, eq. 8 is Irwin's relation for a crack between two solids of the compound modulus
    /// `Es*`, `G = K_I^2 / (2 Es*)` (Maugis, *Contact, Adhesion and Rupture of Elastic Solids*,
    /// 2000).
    pub fn stress_intensity(&self, a: f64, edge: f64) -> f64 {
        2.0 * edge / (PI * a).sqrt()
    }

    /// Returns the energy release rate `G = 2 g |g| / (pi a Es*)` (J/m^2, eq. 8) of the edge
    /// singularity `edge`, `g` (N/m), at contact radius `a` (m).
    ///
    /// It is negative where the stress at the edge is compressive.
    pub fn energy_release_rate(&self, a: f64, edge: f64) -> f64 {
        2.0 * edge * edge.abs() / (PI * a * self.sphere_film_modulus)
    }

    /// Returns the load `F = a^3 E* Pi0 / (2R) - 4 a g Eeq/Gamma` (N) at contact radius `a` (m)
    /// with the edge singularity `edge`, `g` (N/m).
    ///
    /// It follows from eqs. 2, 4, 5 and 6, and is another form of eq. 9.
    pub fn load(&self, a: f64, edge: f64, pi0: f64, eeq_over_gamma: f64) -> f64 {
        self.adhesionless_load(a, self.sphere_radius, pi0)
            - Self::load_lowered_by(a, edge, eeq_over_gamma)
    }

    /// Returns load (N) and penetration (m, positive when the sphere moves in) at contact radius
    /// `a` (m) with the edge singularity `edge`, `g` (N/m), and the quantities `q`.
    ///
    /// The load is [`Mechanics::load`], the penetration is
    /// `delta = a^2 Delta0 / R - 2 g / (E* Gamma)`.
    pub fn load_and_penetration(&self, a: f64, edge: f64, q: &Quantities) -> (f64, f64) {
        let without = self.adhesionless(a, self.sphere_radius, q.pi0, q.delta0);
        let of = without.minus(self.lowered_by(a, edge, q.eeq, q.gamma));
        (of.load, of.penetration)
    }

    /// Returns the adhesionless load `F0 = a^3 E* Pi0 / (2R)` (N), eq. 4, under a paraboloid of
    /// `radius` `R` (m).
    pub fn adhesionless_load(&self, a: f64, radius: f64, pi0: f64) -> f64 {
        a * a * a * self.modulus * pi0 / (2.0 * radius)
    }

    /// Returns load (N), and penetration `delta0 = a^2 Delta0 / R` (m), without adhesion under a
    /// paraboloid of `radius` `R` (m).
    pub fn adhesionless(&self, a: f64, radius: f64, pi0: f64, delta0: f64) -> LoadAndPenetration {
        LoadAndPenetration {
            load: self.adhesionless_load(a, radius, pi0),
            penetration: a * a * delta0 / radius,
        }
    }

    /// Returns the load `4 a g Eeq/Gamma` (N) and the penetration `2 g/(E* Gamma)` (m) by which the
    /// edge singularity `edge`, `g` (N/m), lowers those without adhesion.
    pub fn lowered_by(&self, a: f64, edge: f64, eeq: f64, gamma: f64) -> LoadAndPenetration {
        LoadAndPenetration {
            load: Self::load_lowered_by(a, edge, eeq / gamma),
            penetration: 2.0 * edge / (self.modulus * gamma),
        }
    }

    /// Returns the load `4 a g Eeq/Gamma` (N) by which the edge singularity `edge`, `g` (N/m),
    /// lowers that without adhesion.
    pub fn load_lowered_by(a: f64, edge: f64, eeq_over_gamma: f64) -> f64 {
        4.0 * a * edge * eeq_over_gamma
    }

    /// Returns the stiffness `S = 2 a E* Eeq` (N/m), eq. 5.
    pub fn stiffness(&self, a: f64, eeq: f64) -> f64 {
        2.0 * a * self.modulus * eeq
    }

    /// Returns the edge singularity `g = delta_fp E* Gamma / 2` (N/m) of a flat-punch penetration
    /// (m), eq. 6.
    pub fn edge_of_flat_punch(&self, penetration: f64, gamma: f64) -> f64 {
        0.5 * penetration * self.modulus * gamma
    }
}
