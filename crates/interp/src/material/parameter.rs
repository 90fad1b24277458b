//! The four parameters of the quantities, and the coordinates in which the quantities are smooth.

/// One of the four parameters of a table.
///
/// The order of the variants is that of the dimensions of a table (row-major, the first varies
/// slowest).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Parameter {
    /// Contact radius over film thickness.
    AOverT,
    /// `E1/E2*`: Young's modulus of the film over the sphere's reduced modulus.
    E1OverE2,
    /// Poisson ratio of the film.
    Nu1,
    /// `E0/E2*`: Young's modulus of the substrate over the sphere's reduced modulus.
    E0OverE2,
}

impl Parameter {
    /// All four parameters, in the order of the dimensions of a table.
    pub const ALL: [Self; 4] = [Self::AOverT, Self::E1OverE2, Self::Nu1, Self::E0OverE2];

    /// Returns the name used in the API, on the command line, in CSV, TOML and HDF5.
    pub const fn name(self) -> &'static str {
        match self {
            Self::AOverT => "a_over_t",
            Self::E1OverE2 => "e1_over_e2",
            Self::Nu1 => "nu1",
            Self::E0OverE2 => "e0_over_e2",
        }
    }

    /// Returns the definition in words, as stored in the table's attribute `long_name`.
    pub const fn long_name(self) -> &'static str {
        match self {
            Self::AOverT => "contact radius over film thickness",
            Self::E1OverE2 => {
                "Young's modulus of the film over the sphere's reduced modulus E2* (0: rigid sphere)"
            }
            Self::Nu1 => "Poisson ratio of the film",
            Self::E0OverE2 => {
                "Young's modulus of the substrate over the sphere's reduced modulus E2* \
                 (over the film's Young's modulus if the sphere is rigid)"
            }
        }
    }

    /// Returns the name of the [coordinate](Parameter::coordinate), as stored in the table's
    /// attribute `scale`.
    pub const fn scale(self) -> &'static str {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => "logarithmic",
            Self::Nu1 => "c, with 1 - 2 nu1 = (1 - 2 c)^3",
        }
    }

    /// Returns the coordinate in which nodes are placed and splines are smooth.
    ///
    /// It is the logarithm of `value`; for `nu1` it is the `c` with `1 - 2 nu1 = (1 - 2c)^3`,
    /// because a nearly incompressible film changes its behaviour where `(1 - 2 nu1) (a/t)^2 ~ 1`.
    pub fn coordinate(self, value: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => value.ln(),
            Self::Nu1 => 0.5 * (1.0 - (1.0 - 2.0 * value).cbrt()),
        }
    }

    /// Returns whether the first and second derivatives of the quantities with respect to the
    /// coordinate vanish at `value`.
    ///
    /// They do for an incompressible film, `nu1 = 0.5`, because the quantities are smooth functions
    /// of `1 - 2 nu1`, which is the cube of `1 - 2c`. The derivatives of splines that end there are
    /// made to vanish, too.
    pub fn is_flat_at(self, value: f64) -> bool {
        self == Self::Nu1 && value == 0.5
    }

    /// Returns the derivative of the coordinate with respect to the value, at the value with this
    /// `coordinate`. It is infinite at `nu1 = 0.5`.
    pub fn speed(self, coordinate: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => (-coordinate).exp(),
            Self::Nu1 => 1.0 / (3.0 * (1.0 - 2.0 * coordinate).powi(2)),
        }
    }

    /// Returns the value with this `coordinate`: the inverse of [`Parameter::coordinate`].
    pub fn value(self, coordinate: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => coordinate.exp(),
            Self::Nu1 => 0.5 * (1.0 - (1.0 - 2.0 * coordinate).powi(3)),
        }
    }
}
