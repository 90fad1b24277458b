//! Names of the table's parts, once, for writer and reader.

/// Value of the root attribute [`attribute::FORMAT`].
pub const FORMAT: &str = "coated-contact-table";
/// The one version of the HDF5 format that is written and read. The packed form counts its own.
pub const FORMAT_VERSION: u32 = 1;

/// Attributes of the HDF5 file.
pub mod attribute {
    /// Root: what kind of file this is.
    pub const FORMAT: &str = "format";
    /// Root: the version of the format.
    pub const FORMAT_VERSION: &str = "format_version";
    /// Root: the scene's title.
    pub const TITLE: &str = "title";
    /// Root: the scene, as TOML, as it was given; [`TOLERANCE`] is the one that was used.
    pub const SCENE: &str = "scene";
    /// Root: the substrate's Poisson ratio.
    pub const NU0: &str = "nu0";
    /// Root: the symbol of the modulus that normalises, `E2*` or `E1*`.
    pub const NORMALISED_BY: &str = "normalised_by";
    /// Root: the relative tolerance that the scene asks for.
    pub const TOLERANCE: &str = "tolerance";
    /// Root: program and version.
    pub const CREATED_BY: &str = "created_by";
    /// Root: the certificate's largest relative error.
    pub const CERTIFIED_MAX_ERROR: &str = "certified_max_error";
    /// Root: the certificate's median relative error.
    pub const CERTIFIED_MEDIAN_ERROR: &str = "certified_median_error";
    /// Root: how many points the certificate rests on.
    pub const CERTIFIED_POINTS: &str = "certified_points";
    /// Root: the seed of the certificate's points.
    pub const CERTIFIED_SEED: &str = "certified_seed";
    /// Root: the certificate's relative error that 99.9 % of the points keep.
    pub const CERTIFIED_P999_ERROR: &str = "certified_p999_error";
    /// Root: the name of the quantity with the largest error.
    pub const CERTIFIED_WORST_QUANTITY: &str = "certified_worst_quantity";
    /// Root: the four parameters of the point with the largest error.
    pub const CERTIFIED_WORST_POINT: &str = "certified_worst_point";
    /// Root: the largest relative errors of the two exact identities on the interpolant, NaN where not measured.
    pub const CERTIFIED_IDENTITY_ERRORS: &str = "certified_identity_errors";
    /// Dataset: the unit.
    pub const UNITS: &str = "units";
    /// Dataset: what it is, in words.
    pub const LONG_NAME: &str = "long_name";
    /// Axis: the coordinate in which the nodes are placed and splined.
    pub const SCALE: &str = "scale";
    /// Values: the definition.
    pub const EQUATION: &str = "equation";
}

/// Group of the four axes.
pub const AXES: &str = "axes";
/// Group of the tabulated quantities.
pub const VALUES: &str = "values";

/// One of the table's four parameters, in the order of the table's dimensions (row-major, the first varies slowest).
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
            Self::E1OverE2 => "Young's modulus of the film over the sphere's reduced modulus E2* (0: rigid sphere)",
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

    /// The coordinate in which nodes are placed and splines are smooth: the logarithm, and for `nu1` the `c` with
    /// `1 - 2 nu1 = (1 - 2c)^3`, because a film near incompressibility changes its behaviour where `(1 - 2 nu1) (a/t)^2 ~ 1`.
    pub fn coordinate(self, value: f64) -> f64 {
        match self {
            Self::AOverT | Self::E1OverE2 | Self::E0OverE2 => value.ln(),
            Self::Nu1 => 0.5 * (1.0 - (1.0 - 2.0 * value).cbrt()),
        }
    }

    /// True where the quantities have no first and second derivative with respect to the coordinate: for an incompressible film,
    /// because they are smooth functions of `1 - 2 nu1`, the cube of `1 - 2c`. Splines through nodes that end there have none
    /// either.
    pub fn is_flat_at(self, value: f64) -> bool {
        self == Self::Nu1 && value == 0.5
    }

    /// How fast the coordinate grows with the value: its derivative at a value with this coordinate, infinite at `nu1 = 0.5`.
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
