//! The four parameters that the quantities are functions of, and the coordinates in which they are
//! smooth.

/// One of the table's four parameters, in the order of the table's dimensions (row-major, the first
/// varies slowest).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Parameter {
    /// Contact radius over film thickness.
    AOverT,
    /// Young's modulus of the film over the sphere's reduced modulus.
    E1OverE2,
    /// The film's Poisson ratio.
    Nu1,
    /// Young's modulus of the substrate over the sphere's reduced modulus.
    E0OverE2,
}

impl Parameter {
    /// All four, in the order of the table's dimensions.
    pub const ALL: [Self; 4] = [Self::AOverT, Self::E1OverE2, Self::Nu1, Self::E0OverE2];

    /// The name used in the API, on the command line, in CSV, TOML and HDF5.
    pub const fn name(self) -> &'static str {
        match self {
            Self::AOverT => "a_over_t",
            Self::E1OverE2 => "e1_over_e2",
            Self::Nu1 => "nu1",
            Self::E0OverE2 => "e0_over_e2",
        }
    }

    /// What it is, in words.
    pub const fn long_name(self) -> &'static str {
        match self {
            Self::AOverT => "contact radius over film thickness",
            Self::E1OverE2 => {
                "Young's modulus of the film over the sphere's reduced modulus E2* (0: rigid sphere)"
            }
            Self::Nu1 => "Poisson ratio of the film",
            Self::E0OverE2 => {
                "Young's modulus of the substrate over the sphere's reduced modulus E2* (over the film's Young's modulus if the sphere is rigid)"
            }
        }
    }

    /// The coordinate of [`Parameter::coordinate`], in words.
    pub const fn scale(self) -> &'static str {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => "logarithmic",
            Self::Nu1 => "c, with 1 - 2 nu1 = (1 - 2 c)^3",
        }
    }

    /// The coordinate in which nodes are placed and splines are smooth: the logarithm, and for
    /// `nu1` the `c` with `1 - 2 nu1 = (1 - 2c)^3`, because a film near incompressibility changes
    /// its behaviour where `(1 - 2 nu1) (a/t)^2 ~ 1`.
    pub fn coordinate(self, value: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => value.ln(),
            Self::Nu1 => 0.5 * (1.0 - (1.0 - 2.0 * value).cbrt()),
        }
    }

    /// True where the quantities have no first and second derivative with respect to the
    /// coordinate: for an incompressible film, because they are smooth functions of `1 - 2 nu1`,
    /// the cube of `1 - 2c`. Splines through nodes that end there have none either.
    pub fn is_flat_at(self, value: f64) -> bool {
        self == Self::Nu1 && value == 0.5
    }

    /// How fast the coordinate grows with the value: its derivative at a value with this
    /// coordinate, infinite at `nu1 = 0.5`.
    pub fn speed(self, coordinate: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => (-coordinate).exp(),
            Self::Nu1 => 1.0 / (3.0 * (1.0 - 2.0 * coordinate).powi(2)),
        }
    }

    /// The inverse of [`Parameter::coordinate`].
    pub fn value(self, coordinate: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => coordinate.exp(),
            Self::Nu1 => 0.5 * (1.0 - (1.0 - 2.0 * coordinate).powi(3)),
        }
    }
}
