//! Dundurs' equivalence: replaces a material by one on a substrate with another Poisson ratio that
//! makes an identical contact.
//!
//! The surface compliance of film and substrate depends on `E1*`, `E0*` and one number more. With
//! `k = (1 - 2 nu)/(1 - nu)` and `p = E0*/(E0* + E1*)`, that number is `k1 - k0 E1*/E0*`, or
//!
//! ```text
//! b = p (1 - k1) + (1 - p) k0 = p nu1/(1 - nu1) + (1 - p) (1 - 2 nu0)/(1 - nu0)
//! ```
//!
//! which is between 0 and 1 for all Poisson ratios from 0 to 1/2. Any two materials with equal
//! `E1*/E2*`, `E0*/E1*` and `b` make the same contact.

use std::{array, fmt};

use serde::{Deserialize, Serialize};

use crate::material::{Material, Normalisation, ROUNDING, one_minus_square, poisson_ratio};
use crate::{Error, Parameter};

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

    /// Returns the material with the paired Poisson ratios `nu1 = b/(1 + b)` and
    /// `nu0 = (1 - b)/(2 - b)` whose `Pi0`, `Eeq`, `Gamma` and `Delta0` equal those of `self` at
    /// every `a/t`.
    ///
    /// `E1*` and `E0*` are kept, and so is the third number on which a contact depends,
    ///
    /// ```text
    /// b = p nu1/(1 - nu1) + (1 - p) (1 - 2 nu0)/(1 - nu0),   p = E0*/(E0* + E1*)
    /// ```
    ///
    /// Every pair of Poisson ratios from 0 to 1/2 has its point in this family of one parameter:
    /// `b = 1` is an incompressible film on a substrate with `nu0 = 0`, `b = 0` a film with
    /// `nu1 = 0` on an incompressible substrate.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for a `b` outside 0 to 1, which only a negative Poisson ratio gives.
    pub fn with_paired_poisson_ratios(&self) -> Result<Self, Error> {
        let Invariants {
            e1s_over_e2s,
            e0s_over_e1s,
            b,
            one_minus_b,
        } = Invariants::of(self);
        let allowed = "in 0 to 1, as it is for Poisson ratios from 0 to 0.5: a negative Poisson ratio \
                       needs a direct solve, or a table made for the nu0 of this substrate";
        Error::unless(b >= 0.0 && one_minus_b >= 0.0, "b", b, allowed)?;
        // `b/(1 + b)` and `(1 - b)/(2 - b)`, at most 1/2 whatever the rounding.
        let (nu1, nu0) = (
            b / (b + b + one_minus_b),
            one_minus_b / (one_minus_b + one_minus_b + b),
        );
        // The unit is `E2*`, or `E1` under a rigid sphere.
        let (e1_over_e2, unit) = match self.normalisation() {
            Normalisation::Sphere => (e1s_over_e2s * one_minus_square(nu1), e1s_over_e2s),
            Normalisation::Film => (0.0, 1.0 / one_minus_square(nu1)),
        };
        let e0_over_e2 = e0s_over_e1s * unit * one_minus_square(nu0);
        Self::new(e1_over_e2, nu1, e0_over_e2, nu0)
    }

    /// Returns the material with these ratios of reduced moduli, `E1*/Einf*` with
    /// `1/Einf* = 1/E2* + 1/E0*`, and `E0*/E2*`.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless `0 <= e1s_over_einfs < inf` and `e0s_over_e2s >= 0`; as
    /// [`Material::new`].
    pub fn of_reduced_moduli(
        e1s_over_einfs: f64,
        nu1: f64,
        e0s_over_e2s: f64,
        nu0: f64,
    ) -> Result<Self, Error> {
        poisson_ratio("nu1", nu1)?;
        poisson_ratio("nu0", nu0)?;
        let finite = (0.0..f64::INFINITY).contains(&e1s_over_einfs);
        let allowed = "finite and >= 0 (0 is a rigid sphere on a rigid substrate)";
        Error::unless(finite, "e1s_over_einfs", e1s_over_einfs, allowed)?;
        let allowed = ">= 0 (0 is a rigid sphere, inf a rigid substrate)";
        Error::unless(e0s_over_e2s >= 0.0, "e0s_over_e2s", e0s_over_e2s, allowed)?;
        // `E1*/E2*`, and under a rigid sphere `E0*/E1*`.
        let film = e1s_over_einfs / (1.0 + 1.0 / e0s_over_e2s);
        if film == 0.0 {
            let substrate = (1.0 + e0s_over_e2s) / e1s_over_einfs;
            let young = substrate * one_minus_square(nu0) / one_minus_square(nu1);
            return Self::new(0.0, nu1, young, nu0);
        }
        Self::new(
            film * one_minus_square(nu1),
            nu1,
            e0s_over_e2s * one_minus_square(nu0),
            nu0,
        )
    }
}

/// The Poisson ratio of the substrates of a table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SubstratePoissonRatio {
    /// One number. Some films on substrates with another Poisson ratio have no equivalent on these
    /// substrates.
    Fixed(f64),
    /// The pair of the film's: `nu0 = (1 - b)/(2 - b)` under a film with `nu1 = b/(1 + b)`, see
    /// [`Material::with_paired_poisson_ratios`]. Every film and substrate with Poisson ratios from
    /// 0 to 1/2 has an equivalent.
    Paired,
}

impl SubstratePoissonRatio {
    /// The word for [`SubstratePoissonRatio::Paired`] in scenes and files.
    pub const PAIRED: &'static str = "paired";

    /// Returns the Poisson ratio of the substrate under a film with Poisson ratio `nu1`.
    ///
    /// The pair of `nu1 = b/(1 + b)` is `(1 - b)/(2 - b) = (1 - 2 nu1)/(2 - 3 nu1)`.
    pub fn under(self, nu1: f64) -> f64 {
        match self {
            Self::Fixed(nu0) => nu0,
            Self::Paired => (1.0 - 2.0 * nu1) / (2.0 - 3.0 * nu1),
        }
    }

    /// Returns the equivalent of a material on such a substrate.
    ///
    /// # Errors
    /// [`Error::Unphysical`] if there is none.
    pub(crate) fn equivalent(self, material: &Material) -> Result<Material, Error> {
        match self {
            Self::Fixed(nu0) => material.with_substrate_poisson_ratio(nu0),
            Self::Paired => material.with_paired_poisson_ratios(),
        }
    }
}

impl fmt::Display for SubstratePoissonRatio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(nu0) => nu0.fmt(f),
            Self::Paired => f.write_str(Self::PAIRED),
        }
    }
}

/// The three numbers of film, substrate and sphere on which a contact depends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Invariants {
    /// `E1*/E2*`, 0 under a rigid sphere.
    pub(crate) e1s_over_e2s: f64,
    /// `E0*/E1*`, infinite on a rigid substrate.
    pub(crate) e0s_over_e1s: f64,
    /// `b`, see [`Material::with_paired_poisson_ratios`].
    b: f64,
    /// `1 - b`, without the cancellation near `b = 1`.
    one_minus_b: f64,
}

impl Invariants {
    /// Returns those of a material.
    pub(crate) fn of(material: &Material) -> Self {
        let (film, substrate) = (material.film_modulus(), material.substrate_modulus());
        let (p, rest) = shares(film, substrate);
        let (nu1, nu0) = (material.nu1(), material.nu0());
        Self {
            e1s_over_e2s: match material.normalisation() {
                Normalisation::Sphere => film,
                Normalisation::Film => 0.0,
            },
            e0s_over_e1s: substrate / film,
            b: p * nu1 / (1.0 - nu1) + rest * dundurs_k(nu0),
            one_minus_b: p * dundurs_k(nu1) + rest * nu0 / (1.0 - nu0),
        }
    }

    /// Returns `E1*/Einf* = E1*/E2* + E1*/E0*`.
    pub(crate) fn e1s_over_einfs(&self) -> f64 {
        self.e1s_over_e2s + 1.0 / self.e0s_over_e1s
    }

    /// Returns `E0*/E2*`: 0 under a rigid sphere, infinity on a rigid substrate. Between both it
    /// does not matter, and is 1.
    pub(crate) fn e0s_over_e2s(&self) -> f64 {
        if self.e1s_over_einfs() == 0.0 {
            1.0
        } else {
            self.e1s_over_e2s * self.e0s_over_e1s
        }
    }

    /// Returns `p = E0*/(E0* + E1*)`, 1 on a rigid substrate.
    pub(crate) fn stiffer_substrate(&self) -> f64 {
        1.0 / (1.0 + 1.0 / self.e0s_over_e1s)
    }

    /// Returns the substrate's share of the compliance of sphere and substrate, `Einf*/E0*`.
    fn substrate_share(&self) -> f64 {
        1.0 / (1.0 + self.e0s_over_e2s())
    }

    /// Returns whether two materials make the same contact, except for the rounding of ratios of SI
    /// values.
    pub(crate) fn are_close(&self, other: &Self) -> bool {
        let close = |a: f64, b: f64, size: f64| a == b || (a - b).abs() <= ROUNDING * size;
        close(self.e1s_over_e2s, other.e1s_over_e2s, other.e1s_over_e2s)
            && close(self.e0s_over_e1s, other.e0s_over_e1s, other.e0s_over_e1s)
            && close(self.b, other.b, 1.0)
    }
}

/// Returns `E0*/(E0* + E1*)` and `E1*/(E0* + E1*)`.
fn shares(film: f64, substrate: f64) -> (f64, f64) {
    (
        1.0 / (1.0 + film / substrate),
        1.0 / (1.0 + substrate / film),
    )
}

/// The equivalent of a material in a table, with its derivatives with respect to the material.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Equivalence {
    /// The equivalent material.
    pub(crate) equivalent: Material,
    /// The derivatives of `ln E1/E2*`, `nu1`, `ln E0/E2*`, and of `ln E1*/Einf*` and `ln E0*/E2*`
    /// of the equivalent (a row each), with respect to `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and
    /// `nu0` of the material.
    rows: [[f64; 4]; 5],
}

/// The derivatives of three parameters (a row each) with respect to four.
pub(crate) type Jacobian = [[f64; 4]; 3];

impl Equivalence {
    /// Finds the equivalent of `material` on substrates with Poisson ratio `nu0`.
    ///
    /// # Errors
    /// Those of [`SubstratePoissonRatio::equivalent`].
    pub(crate) fn new(material: &Material, nu0: SubstratePoissonRatio) -> Result<Self, Error> {
        let equivalent = nu0.equivalent(material)?;
        let (own, its) = (
            [material.nu1(), material.nu0()],
            [equivalent.nu1(), equivalent.nu0()],
        );
        let times = |factor: f64, row: [f64; 4]| row.map(|derivative| factor * derivative);
        let plus = |a: [f64; 4], b: [f64; 4]| array::from_fn(|i| a[i] + b[i]);
        // The derivatives of `-ln(1 - nu^2)` and of `nu/(1 - nu)`.
        let reduced = |nu: f64| 2.0 * nu / one_minus_square(nu);
        let slope = |nu: f64| 1.0 / ((1.0 - nu) * (1.0 - nu));
        // Under a rigid sphere `E1*` is the unit, and the material's `e0_over_e2` is `E0/E1`.
        let sphere = material.sphere_compliance();
        let film = [sphere, sphere * reduced(own[0]), 0.0, 0.0];
        let substrate = [-sphere, -reduced(own[0]), 1.0, reduced(own[1])];

        let (p, rest) = shares(material.film_modulus(), material.substrate_modulus());
        let beta = |nu: f64| nu / (1.0 - nu);
        let [nu1, nu0] = match nu0 {
            // `nu1/(1 - nu1)` grows by the change of `(1 - 2 nu0)/(1 - nu0)` times `E1*/E0*`.
            SubstratePoissonRatio::Fixed(_) => {
                let r = material.film_modulus() / material.substrate_modulus();
                let mut row = times(r * (beta(own[1]) - beta(its[1])), substrate);
                row[1] += slope(own[0]);
                row[3] -= r * slope(own[1]);
                [times(1.0 / slope(its[0]), row), [0.0; 4]]
            }
            SubstratePoissonRatio::Paired => {
                let mut row = times(p * rest * (beta(own[0]) - dundurs_k(own[1])), substrate);
                row[1] += p * slope(own[0]);
                row[3] -= rest * slope(own[1]);
                // `nu1 = b/(1 + b)` and `nu0 = (1 - b)/(2 - b)`.
                let (nu1, nu0) = (1.0 - its[0], 1.0 - its[1]);
                [times(nu1 * nu1, row), times(-nu0 * nu0, row)]
            }
        };
        // `E1 = E1* (1 - nu1^2)` and `E0 = E0* (1 - nu0^2)`, in units of `E2*` or of `E1`.
        let film_young = plus(film, times(-sphere * reduced(its[0]), nu1));
        let unit = plus(
            times(sphere, film),
            times((1.0 - sphere) * reduced(its[0]), nu1),
        );
        let substrate_young = plus(plus(substrate, unit), times(-reduced(its[1]), nu0));
        // `E1*/Einf* = E1*/E2* + E1*/E0*`, and `E0*/E2*` is the product of `film` and `substrate`.
        let share = Invariants::of(material).substrate_share();
        let film_infinite = plus(times(1.0 - share, film), times(-share, substrate));
        let substrate_sphere = plus(film, substrate);
        Ok(Self {
            equivalent,
            rows: [
                film_young,
                nu1,
                substrate_young,
                film_infinite,
                substrate_sphere,
            ],
        })
    }

    /// Returns the derivatives of three parameters of the equivalent: `nu1`, and the logarithms of
    /// ratios of moduli.
    pub(crate) fn jacobian(&self, parameters: [Parameter; 3]) -> Jacobian {
        parameters.map(|parameter| match parameter {
            // The second is an axis of stacks alone, which have no derivatives.
            Parameter::AOverT | Parameter::E0OverE1 => [0.0; 4],
            Parameter::E1OverE2 => self.rows[0],
            Parameter::Nu1 => self.rows[1],
            Parameter::E0OverE2 => self.rows[2],
            Parameter::E1sOverEinfs => self.rows[3],
            Parameter::E0sOverE2s => self.rows[4],
        })
    }
}

/// Returns `k = (1 - 2 nu)/(1 - nu)`, in which Dundurs' second parameter is linear.
fn dundurs_k(nu: f64) -> f64 {
    (1.0 - 2.0 * nu) / (1.0 - nu)
}
