//! Dundurs' equivalence: replaces a material by one on a substrate with another Poisson ratio that
//! makes an identical contact.

use crate::Error;
use crate::material::{Material, Normalisation, one_minus_square, poisson_ratio};

impl Material {
    /// Returns the material with substrate Poisson ratio `nu0` whose `Pi0`, `Eeq`, `Gamma` and
    /// `Delta0` equal those of `self` at every `a/t`.
    ///
    /// The surface compliance depends on the film and the substrate only through Dundurs' two
    /// parameters, that is, through `r = E1*/E0*` and `k1 - r k0` with `k = (1-2nu)/(1-nu)`.
    /// Therefore `E1*` and `E0*` are kept. The film's Poisson ratio becomes `(1 - k)/(2 - k)` with
    /// `k = k1 + r (k(nu0) - k0)`.
    ///
    /// # Errors
    /// [`Error::Unphysical`] if `nu0` is outside `(-1, 0.5]`, or if the equivalent film would need
    /// a Poisson ratio outside `(-1, 0.5]` or an infinite modulus.
    pub fn with_substrate_poisson_ratio(&self, nu0: f64) -> Result<Self, Error> {
        poisson_ratio("nu0", nu0)?;
        if nu0 == self.nu0() {
            return Ok(*self);
        }
        let film_over_substrate = self.film_modulus() / self.substrate_modulus();
        let mut k1 =
            dundurs_k(self.nu1()) + film_over_substrate * (dundurs_k(nu0) - dundurs_k(self.nu0()));
        if (-8.0 * f64::EPSILON * (1.0 + film_over_substrate)..0.0).contains(&k1) {
            // The film is incompressible except for rounding.
            k1 = 0.0;
        }
        let nu1 = (1.0 - k1) / (2.0 - k1);
        let allowed =
            "in (-1, 0.5] for the equivalent film on a substrate with another Poisson ratio";
        Error::unless((0.0..1.5).contains(&k1), "nu1", nu1, allowed)?;
        let film_ratio = one_minus_square(nu1) / one_minus_square(self.nu1());
        let substrate_ratio = one_minus_square(nu0) / one_minus_square(self.nu0());
        match self.normalisation() {
            Normalisation::Sphere => Self::new(
                self.e1_over_e2() * film_ratio,
                nu1,
                self.e0_over_e2() * substrate_ratio,
                nu0,
            ),
            Normalisation::Film => Self::new(
                0.0,
                nu1,
                self.e0_over_e2() * substrate_ratio / film_ratio,
                nu0,
            ),
        }
    }
}

/// The equivalent of a material on a substrate with another Poisson ratio, with its derivatives
/// with respect to the material.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Equivalence {
    /// The equivalent material.
    pub(crate) equivalent: Material,
    /// The derivatives of `ln e1_over_e2`, `nu1` and `ln e0_over_e2` of the equivalent (a row each)
    /// with respect to `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and `nu0` of the material.
    pub(crate) jacobian: Jacobian,
}

/// The derivatives of three parameters (a row each) with respect to four.
pub(crate) type Jacobian = [[f64; 4]; 3];

impl Equivalence {
    /// Finds the equivalent of `material` on a substrate with Poisson ratio `nu0`.
    ///
    /// # Errors
    /// Those of [`Material::with_substrate_poisson_ratio`].
    pub(crate) fn new(material: &Material, nu0: f64) -> Result<Self, Error> {
        let equivalent = material.with_substrate_poisson_ratio(nu0)?;
        let r = material.film_modulus() / material.substrate_modulus();
        let shift = r * (dundurs_k(nu0) - dundurs_k(material.nu0()));
        // The derivatives of `ln(1 - nu^2)` and of `k`.
        let slope = |nu: f64| -2.0 * nu / one_minus_square(nu);
        let k_slope = |nu: f64| -1.0 / ((1.0 - nu) * (1.0 - nu));
        // `r = (e1/e0) (1 - nu0^2)/(1 - nu1^2)`; under a rigid sphere `e1 = 1` is fixed.
        let sphere = material.sphere_compliance();
        let r_row = [sphere, -slope(material.nu1()), -1.0, slope(material.nu0())];
        let mut k_row = r_row.map(|derivative| shift * derivative);
        k_row[1] += k_slope(material.nu1());
        k_row[3] -= r * k_slope(material.nu0());
        // The slope of the inverse function of `k` is one over that of `k`.
        let nu_row = k_row.map(|derivative| derivative / k_slope(equivalent.nu1()));
        // `E1 = E1* (1 - nu1^2)` and `E0 = E0* (1 - nu0^2)`. Under a rigid sphere the unit of `E0`
        // is `E1`.
        let mut film_row = nu_row.map(|derivative| slope(equivalent.nu1()) * derivative);
        film_row[1] -= slope(material.nu1());
        let mut substrate_row = film_row.map(|derivative| (sphere - 1.0) * derivative);
        film_row[0] += 1.0;
        substrate_row[2] += 1.0;
        substrate_row[3] -= slope(material.nu0());
        Ok(Self {
            equivalent,
            jacobian: [
                film_row.map(|derivative| sphere * derivative),
                nu_row,
                substrate_row,
            ],
        })
    }
}

/// Returns `k = (1 - 2 nu)/(1 - nu)`, in which Dundurs' second parameter is linear.
fn dundurs_k(nu: f64) -> f64 {
    (1.0 - 2.0 * nu) / (1.0 - nu)
}
