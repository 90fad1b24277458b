//! The four quantities that a table holds.

use serde::{Deserialize, Serialize};

/// One of the dimensionless quantities, functions of (`a_over_t`, `e1_over_e2`, `nu1`,
/// `e0_over_e2`).
///
/// The order of the variants is the order of columns and of arrays of values everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// Adhesionless load, `F0 = a^3 E2* Pi0 / (2 R)` (Barthel, eq. 4).
    Pi0,
    /// Contact stiffness, `S = 2 a E2* Eeq` (Barthel, eq. 5).
    Eeq,
    /// Edge singularity per flat-punch penetration, `g(a) = delta_fp E2* Gamma / 2` (Barthel, eq.
    /// 6).
    Gamma,
    /// Adhesionless penetration, `delta0 = a^2 Delta0 / R`.
    Delta0,
}

impl Quantity {
    /// All quantities, in their fixed order: that of [`Quantities`].
    pub const ALL: [Self; 4] = [Self::Pi0, Self::Eeq, Self::Gamma, Self::Delta0];

    /// Returns the name used in the API, on the command line, in CSV, TOML and HDF5.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Pi0 => "pi0",
            Self::Eeq => "eeq",
            Self::Gamma => "gamma",
            Self::Delta0 => "delta0",
        }
    }

    /// Returns the meaning in words, as stored in the table's attribute `long_name`.
    pub const fn long_name(self) -> &'static str {
        match self {
            Self::Pi0 => "adhesionless load",
            Self::Eeq => "contact stiffness",
            Self::Gamma => "edge singularity per flat-punch penetration",
            Self::Delta0 => "adhesionless penetration",
        }
    }

    /// Returns the defining equation, as stored in the table's attribute `equation`. `E*` stands
    /// for the normalising modulus: the sphere's, or the film's under a rigid sphere.
    pub const fn equation(self) -> &'static str {
        match self {
            Self::Pi0 => "F0 = a^3 E* pi0 / (2 R), Barthel eq. 4",
            Self::Eeq => "S = 2 a E* eeq, Barthel eq. 5",
            Self::Gamma => "g(a) = delta_fp E* gamma / 2, Barthel eq. 6",
            Self::Delta0 => "penetration = a^2 delta0 / R",
        }
    }

    /// Returns the scale by which the quantity is divided before its logarithm is interpolated: its
    /// order of magnitude on thick films. `es` is the sphere-film modulus.
    pub const fn scale(self, es: f64) -> f64 {
        match self {
            Self::Pi0 | Self::Eeq | Self::Gamma => es,
            Self::Delta0 => 1.0,
        }
    }

    /// Returns the logarithm of `value` over its [scale](Quantity::scale), which the splines
    /// interpolate. `es` is the sphere-film modulus.
    pub fn logarithm(self, value: f64, es: f64) -> f64 {
        (value / self.scale(es)).ln()
    }
}

/// The values of the four quantities at one point, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quantities {
    /// See [`Quantity::Pi0`].
    pub pi0: f64,
    /// See [`Quantity::Eeq`].
    pub eeq: f64,
    /// See [`Quantity::Gamma`].
    pub gamma: f64,
    /// See [`Quantity::Delta0`].
    pub delta0: f64,
}

impl Quantities {
    /// Returns the values in the order of [`Quantity::ALL`].
    pub const fn to_array(self) -> [f64; 4] {
        [self.pi0, self.eeq, self.gamma, self.delta0]
    }

    /// Makes the quantities from values in the order of [`Quantity::ALL`].
    pub const fn from_array([pi0, eeq, gamma, delta0]: [f64; 4]) -> Self {
        Self {
            pi0,
            eeq,
            gamma,
            delta0,
        }
    }

    /// Returns the value of `quantity`.
    pub const fn get(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Pi0 => self.pi0,
            Quantity::Eeq => self.eeq,
            Quantity::Gamma => self.gamma,
            Quantity::Delta0 => self.delta0,
        }
    }

    /// Returns the quantities of a sphere on a half-space with compound reduced modulus `modulus`,
    /// in units of the normalising modulus.
    ///
    /// They are those of Hertz and of the flat punch, `Pi0 = 8/3 E*`, `Eeq = Gamma = E*`,
    /// `Delta0 = 1`.
    pub const fn homogeneous(modulus: f64) -> Self {
        Self {
            pi0: 8.0 / 3.0 * modulus,
            eeq: modulus,
            gamma: modulus,
            delta0: 1.0,
        }
    }
}
