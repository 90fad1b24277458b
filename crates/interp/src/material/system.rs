//! The bodies in contact, in SI units.

use crate::check::positive;
use crate::material::{one_minus_square, poisson_ratio};
use crate::{Error, Material, Normalisation, Probe};

/// An isotropic elastic solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    young: f64,
    poisson: f64,
}

impl Elastic {
    /// Makes a solid from Young's modulus (Pa; infinity is rigid) and Poisson ratio.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless `young > 0` and `poisson` is in `(-1, 0.5]`.
    pub fn new(young: f64, poisson: f64) -> Result<Self, Error> {
        Error::unless(young > 0.0, "Young's modulus", young, "> 0 (inf is rigid)")?;
        poisson_ratio("Poisson ratio", poisson)?;
        Ok(Self { young, poisson })
    }

    /// Returns Young's modulus, Pa.
    pub const fn young(&self) -> f64 {
        self.young
    }

    /// Returns the Poisson ratio.
    pub const fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Returns the reduced modulus `E/(1 - nu^2)`, Pa.
    pub const fn reduced(&self) -> f64 {
        self.young / one_minus_square(self.poisson)
    }
}

/// Probe, film and substrate in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// The shape of the probe. [`Probe::Paraboloid`] is the sphere of JKR and of Barthel's model.
    pub probe: Probe,
    /// Reduced modulus `E2* = E2/(1 - nu2^2)` of the sphere, or of any other probe, Pa, at most 1e25;
    /// infinity is a rigid one.
    pub sphere_modulus: f64,
    /// The film (body 1).
    pub film: Elastic,
    /// Thickness `t` of the film, m.
    pub film_thickness: f64,
    /// The substrate (body 0).
    pub substrate: Elastic,
}

impl System {
    /// Makes a system of a material, the inverse of [`System::material`]: a film of 1 m under a `probe` of
    /// 1 Pa. Under a rigid probe the film has a Young's modulus of 1 Pa.
    pub const fn of_material(material: &Material, probe: Probe) -> Self {
        let (young, sphere_modulus) = match material.normalisation() {
            Normalisation::Sphere => (material.e1_over_e2(), 1.0),
            Normalisation::Film => (1.0, f64::INFINITY),
        };
        Self {
            probe,
            sphere_modulus,
            film: Elastic {
                young,
                poisson: material.nu1(),
            },
            film_thickness: 1.0,
            substrate: Elastic {
                young: material.e0_over_e2(),
                poisson: material.nu0(),
            },
        }
    }

    /// Returns the dimensionless material of the system.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for a length or modulus that is not positive, an impossible angle or
    /// exponent of the probe, or a rigid film.
    pub fn material(&self) -> Result<Material, Error> {
        self.probe.check()?;
        positive("film_thickness", self.film_thickness)?;
        positive("film modulus", self.film.young)?;
        sphere_modulus(self.sphere_modulus)?;
        let rigid = self.sphere_modulus == f64::INFINITY;
        let unit = if rigid {
            self.film.young
        } else {
            self.sphere_modulus
        };
        let e1_over_e2 = if rigid { 0.0 } else { self.film.young / unit };
        Material::new(
            e1_over_e2,
            self.film.poisson,
            self.substrate.young / unit,
            self.substrate.poisson,
        )
    }

    /// Returns the probe of this system on the bare substrate.
    pub fn without_film(&self) -> HalfSpace {
        HalfSpace {
            probe: self.probe.clone(),
            sphere_modulus: self.sphere_modulus,
            solid: self.substrate,
        }
    }
}

/// A probe on a half-space without a film, in SI units: the system of JKR, which needs no table.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfSpace {
    /// The shape of the probe. [`Probe::Paraboloid`] is the sphere of JKR.
    pub probe: Probe,
    /// Reduced modulus `E2* = E2/(1 - nu2^2)` of the sphere, or of any other probe, Pa, at most 1e25;
    /// infinity is a rigid one.
    pub sphere_modulus: f64,
    /// The solid that fills the half-space.
    pub solid: Elastic,
}

impl HalfSpace {
    /// Returns the compound modulus `E*` of sphere and solid (Pa),
    /// `1/E* = (1 - nu2^2)/E2 + (1 - nu^2)/E`.
    ///
    /// The contact depends on the two bodies only through it.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for a length or modulus that is not positive, an impossible angle or
    /// exponent of the probe, or a rigid sphere on a rigid solid.
    pub fn compound_modulus(&self) -> Result<f64, Error> {
        self.probe.check()?;
        sphere_modulus(self.sphere_modulus)?;
        let (sphere, solid) = (self.sphere_modulus, self.solid.reduced());
        let softer = sphere.min(solid);
        Error::unless(
            softer < f64::INFINITY,
            "sphere_modulus",
            sphere,
            "finite on a rigid half-space",
        )?;
        Ok(softer / (1.0 + softer / sphere.max(solid)))
    }
}

/// Accepts a positive modulus, infinity included. Quantities in units of a larger one underflow.
fn sphere_modulus(value: f64) -> Result<(), Error> {
    Error::unless(
        (value > 0.0 && value <= 1e25) || value == f64::INFINITY,
        "sphere_modulus",
        value,
        "> 0 and at most 1e25 Pa (inf is a rigid sphere)",
    )
}
