//! The dimensionless material of sphere (2), film (1) and substrate (0): ratios, reduced moduli and
//! exact limits.

use crate::material::equivalence::Invariants;
use crate::{Error, Quantities};
use serde::{Deserialize, Serialize};

/// The largest relative rounding of a ratio of SI values.
pub(crate) const ROUNDING: f64 = 1e-12;

/// The modulus in whose units the tabulated quantities are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Normalisation {
    /// The sphere's reduced modulus `E2* = E2 / (1 - nu2^2)`: the usual case.
    Sphere,
    /// The film's reduced modulus `E1* = E1 / (1 - nu1^2)`: the sphere is rigid.
    Film,
}

impl Normalisation {
    /// The symbol, as stored in the table's attribute `normalised_by`.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Sphere => "E2*",
            Self::Film => "E1*",
        }
    }
}

/// The dimensionless material parameters of a coated contact.
///
/// `e1_over_e2` and `e0_over_e2` are *Young's* moduli of film and substrate over the sphere's
/// *reduced* modulus `E2*`, as Barthel's Table 1 normalises them. `e0_over_e2 = inf` is a rigid
/// substrate. `e1_over_e2 = 0` is a rigid sphere: then every quantity is normalised by the film's
/// reduced modulus `E1*` and `e0_over_e2` is read as `E0/E1`.
///
/// ```
/// # fn main() -> Result<(), interp::Error> {
/// let paper = interp::Material::new(1.75, 0.5, 1e5, 0.25)?;
/// assert!((paper.sphere_film_modulus() - 0.7).abs() < 1e-15); // eq. 7: es = 1/(1 + 3/7)
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    e1_over_e2: f64,
    nu1: f64,
    e0_over_e2: f64,
    nu0: f64,
}

impl Material {
    /// Makes a material from its four ratios.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless `0 <= e1_over_e2 < inf`, `0 < e0_over_e2 <= inf` and both
    /// Poisson ratios are in `(-1, 0.5]`.
    pub fn new(e1_over_e2: f64, nu1: f64, e0_over_e2: f64, nu0: f64) -> Result<Self, Error> {
        let finite = (0.0..f64::INFINITY).contains(&e1_over_e2);
        Error::unless(
            finite,
            "e1_over_e2",
            e1_over_e2,
            "finite and >= 0 (0 is a rigid sphere)",
        )?;
        Error::unless(
            e0_over_e2 > 0.0,
            "e0_over_e2",
            e0_over_e2,
            "> 0 (inf is a rigid substrate)",
        )?;
        poisson_ratio("nu1", nu1)?;
        poisson_ratio("nu0", nu0)?;
        Ok(Self {
            e1_over_e2,
            nu1,
            e0_over_e2,
            nu0,
        })
    }

    /// Returns the four ratios in the order of the arguments of [`Material::new`].
    pub const fn to_array(self) -> [f64; 4] {
        [self.e1_over_e2, self.nu1, self.e0_over_e2, self.nu0]
    }

    /// Returns whether two materials differ by no more than the rounding of ratios of SI values.
    pub fn is_close_to(&self, other: &Self) -> bool {
        let close = |a: f64, b: f64, size: f64| a == b || (a - b).abs() <= ROUNDING * size;
        close(self.e1_over_e2, other.e1_over_e2, other.e1_over_e2)
            && close(self.nu1, other.nu1, 1.0)
            && close(self.e0_over_e2, other.e0_over_e2, other.e0_over_e2)
            && close(self.nu0, other.nu0, 1.0)
    }

    /// Returns whether two materials make the same contact, except for the rounding of ratios of SI
    /// values.
    pub fn is_equivalent_to(&self, other: &Self) -> bool {
        Invariants::of(self).are_close(&Invariants::of(other))
    }

    /// Returns `E1/E2*`, or 0 for a rigid sphere.
    pub const fn e1_over_e2(&self) -> f64 {
        self.e1_over_e2
    }

    /// Returns the Poisson ratio of the film.
    pub const fn nu1(&self) -> f64 {
        self.nu1
    }

    /// Returns `E0/E2*`, or `E0/E1` under a rigid sphere.
    pub const fn e0_over_e2(&self) -> f64 {
        self.e0_over_e2
    }

    /// Returns the Poisson ratio of the substrate.
    pub const fn nu0(&self) -> f64 {
        self.nu0
    }

    /// Returns the modulus in whose units all quantities of this material are given.
    pub const fn normalisation(&self) -> Normalisation {
        if self.e1_over_e2 == 0.0 {
            Normalisation::Film
        } else {
            Normalisation::Sphere
        }
    }

    /// Returns the compliance of the sphere in the normalising unit: 1, or 0 for a rigid sphere.
    pub const fn sphere_compliance(&self) -> f64 {
        match self.normalisation() {
            Normalisation::Sphere => 1.0,
            Normalisation::Film => 0.0,
        }
    }

    /// Returns the reduced modulus of the film, `e1 = E1*/E2*` (1 under a rigid sphere, where `E1*`
    /// is the unit).
    pub const fn film_modulus(&self) -> f64 {
        match self.normalisation() {
            Normalisation::Sphere => self.e1_over_e2 / one_minus_square(self.nu1),
            Normalisation::Film => 1.0,
        }
    }

    /// Returns the reduced modulus of the substrate, `e0 = E0*/E2*` (`E0*/E1*` under a rigid
    /// sphere).
    pub const fn substrate_modulus(&self) -> f64 {
        let young = self.e0_over_e2 / one_minus_square(self.nu0);
        match self.normalisation() {
            Normalisation::Sphere => young,
            Normalisation::Film => young * one_minus_square(self.nu1),
        }
    }

    /// Returns `E1/E0`, exactly 0 on a rigid substrate.
    pub const fn film_over_substrate(&self) -> f64 {
        match self.normalisation() {
            Normalisation::Sphere => self.e1_over_e2 / self.e0_over_e2,
            Normalisation::Film => 1.0 / self.e0_over_e2,
        }
    }

    /// Returns the compound sphere-film modulus `es = 1/(1 + 1/e1)` (Barthel, eq. 7).
    ///
    /// It is the modulus at the crack tip, and that of the whole contact as `a/t -> 0`.
    pub const fn sphere_film_modulus(&self) -> f64 {
        compound(self.sphere_compliance(), self.film_modulus())
    }

    /// Returns the compound sphere-substrate modulus `einf = 1/(1 + 1/e0)`, that of the contact as
    /// `a/t -> inf`. It is infinite between rigid bodies.
    pub const fn sphere_substrate_modulus(&self) -> f64 {
        compound(self.sphere_compliance(), self.substrate_modulus())
    }

    /// Returns the numbers `c0` to `c4` of the compliance `X = N/D` of film and substrate at the wave
    /// number `q = kt`, divided by the larger of 1 and `m`, so that `m^2` cannot overflow. With
    /// `m = G1/G0` and `g = 3 - 4 nu`,
    ///
    /// ```text
    /// N = c0/2 cosh 2q + c1/2 (sinh 2q - 2q)        + c2 q
    /// D = c3/2         + c1/2 (cosh 2q - 1 - 2q^2)  + c0/2 sinh 2q + c4 q^2
    ///
    /// c0 = m (1+g1)(1+g0)            c3 = (1+g1)^2
    /// c1 = 2 m^2 g0 + m (g0-1)(g1-1) + 2 g1
    /// c2 = 4 m^2 g0 - 8 m nu1 (1-2 nu0) + 4 (1-2 nu1)
    /// c4 = (1+g1) (m (g0-1) + 2)
    /// ```
    pub const fn compliance_coefficients(&self) -> [f64; 5] {
        let (nu1, nu0) = (self.nu1, self.nu0);
        let (g1, g0) = (3.0 - 4.0 * nu1, 3.0 - 4.0 * nu0);
        let m = self.film_over_substrate() * ((1.0 + nu0) / (1.0 + nu1));
        let (unit, share) = (1.0 / m.max(1.0), m.min(1.0));
        [
            share * (1.0 + g1) * (1.0 + g0),
            2.0 * m * share * g0 + share * (g0 - 1.0) * (g1 - 1.0) + 2.0 * g1 * unit,
            4.0 * m * share * g0 - 8.0 * share * nu1 * (1.0 - 2.0 * nu0)
                + 4.0 * (1.0 - 2.0 * nu1) * unit,
            (1.0 + g1) * (1.0 + g1) * unit,
            (1.0 + g1) * (share * (g0 - 1.0) + 2.0 * unit),
        ]
    }

    /// Returns `(1/e1) X'(0)`: the slope of the compliance of film and substrate at wave number 0,
    /// `X'(0) = 2 (c2 c3 - c0^2)/c3^2`.
    pub(crate) fn compliance_slope(&self) -> f64 {
        let [c0, _, c2, c3, _] = self.compliance_coefficients();
        2.0 * (c2 - c0 * (c0 / c3)) / c3 / self.film_modulus()
    }

    /// Returns how far the logarithm of the compliance at wave number `q = kt`, of 2 at most, is
    /// from the line through its value and slope at 0: `|ln[einf S(q)] - einf X'(0)/e1 q|`, with
    /// the compliance `S = 1 + X/e1` (`S = X` under a rigid sphere).
    pub(crate) fn compliance_beyond_slope(&self, q: f64) -> f64 {
        let [c0, c1, c2, c3, c4] = self.compliance_coefficients();
        // The series of `sinh t - t` and `cosh t - 1 - t^2/2`, without cancellation.
        let t = 2.0 * q;
        let (mut sinh, mut cosh, mut term) = (0.0, 0.0, 0.5 * t * t);
        for n in (3..30).step_by(2) {
            term *= t / f64::from(n);
            sinh += term;
            term *= t / f64::from(n + 1);
            cosh += term;
        }
        let n = 0.5 * c0 * (1.0 + 0.5 * t * t + cosh) + 0.5 * c1 * sinh + c2 * q;
        let d = 0.5 * c3 + 0.5 * c1 * cosh + 0.5 * c0 * (t + sinh) + c4 * q * q;
        let einf = self.sphere_substrate_modulus();
        let compliance = self.sphere_compliance() + n / d / self.film_modulus();
        ((einf * compliance).ln() - einf * self.compliance_slope() * q).abs()
    }

    /// Returns the quantities in the exact limit `a/t -> 0`: a sphere on a half-space of film.
    pub const fn thick_film_limit(&self) -> Quantities {
        Quantities::homogeneous(self.sphere_film_modulus())
    }

    /// Returns the quantities in the exact limit `a/t -> inf`: a sphere on the bare substrate. Only
    /// the edge differs, `Gamma = sqrt(es einf)`.
    pub fn thin_film_limit(&self) -> Quantities {
        let einf = self.sphere_substrate_modulus();
        let gamma = (self.sphere_film_modulus() * einf).sqrt();
        Quantities {
            gamma,
            ..Quantities::homogeneous(einf)
        }
    }
}

/// Returns `1/(compliance + 1/modulus)`, without overflow for a modulus from the smallest positive
/// number to infinity.
const fn compound(compliance: f64, modulus: f64) -> f64 {
    if modulus < 1.0 {
        modulus / (1.0 + compliance * modulus)
    } else {
        1.0 / (compliance + 1.0 / modulus)
    }
}

/// Returns `1 - nu^2`, accurate near `nu = -1`.
pub(crate) const fn one_minus_square(nu: f64) -> f64 {
    (1.0 - nu) * (1.0 + nu)
}

/// Accepts a Poisson ratio in `(-1, 0.5]`.
pub(crate) fn poisson_ratio(name: &'static str, nu: f64) -> Result<(), Error> {
    Error::unless(nu > -1.0 && nu <= 0.5, name, nu, "in (-1, 0.5]")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The textbook form of `X` has differences of exponentials, accurate at `q` near 1.
    #[test]
    fn the_compliance_is_that_of_the_textbook() {
        for [e1, nu1, e0, nu0] in [
            [1.75, 0.5, 1e5, 0.25],
            [0.02, 0.3, f64::INFINITY, 0.25],
            [30.0, 0.1, 0.5, 0.45],
            [0.0, 0.4, 3.0, 0.2],
        ] {
            let material = Material::new(e1, nu1, e0, nu0).expect("physical");
            let (g1, g0) = (3.0 - 4.0 * nu1, 3.0 - 4.0 * nu0);
            let m = material.film_over_substrate() * (1.0 + nu0) / (1.0 + nu1);
            let (a, b) = ((m * g0 - g1) / (1.0 + m * g0), (m - 1.0) / (m + g1));
            for q in [0.5_f64, 1.0, 2.0] {
                let e = (-2.0 * q).exp();
                let x = (1.0 + 4.0 * b * q * e - a * b * e * e)
                    / (1.0 - (a + b + 4.0 * b * q * q) * e + a * b * e * e);
                let einf = material.sphere_substrate_modulus();
                let s = material.sphere_compliance() + x / material.film_modulus();
                let expected = ((einf * s).ln() - einf * material.compliance_slope() * q).abs();
                let found = material.compliance_beyond_slope(q);
                assert!(
                    (found - expected).abs() <= 1e-13 * (1.0 + expected),
                    "{material:?} at {q}: {found}, not {expected}"
                );
            }
        }
    }
}
