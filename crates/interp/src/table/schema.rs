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
    /// Root: the largest relative errors of the two exact identities on the interpolant, NaN where
    /// not measured.
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
