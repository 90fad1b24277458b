//! The names of the parts of an HDF5 table, shared by its writer and its reader.

use crate::{Quantity, SubstratePoissonRatio, Table};

/// The value of the root attribute [`attribute::FORMAT`].
pub const FORMAT: &str = "coated-contact-table";
/// The only version of the HDF5 format that is written and read. The packed form has its own
/// version.
pub const FORMAT_VERSION: u32 = 3;

/// The names of the attributes.
pub mod attribute {
    /// Root: the kind of the file, [`FORMAT`](super::FORMAT).
    pub const FORMAT: &str = "format";
    /// Root: the version of the format, [`FORMAT_VERSION`](super::FORMAT_VERSION).
    pub const FORMAT_VERSION: &str = "format_version";
    /// Root: the scene's title.
    pub const TITLE: &str = "title";
    /// Root: the scene as it was given, TOML. Its tolerance may differ from [`TOLERANCE`], which
    /// was used.
    pub const SCENE: &str = "scene";
    /// Root: the substrate's Poisson ratio, a number or the text `paired`
    /// ([`SubstratePoissonRatio`](crate::SubstratePoissonRatio)).
    pub const NU0: &str = "nu0";
    /// Root: the symbol of the modulus that normalises, `E2*`, `E1*` or `Es*`
    /// ([`Table::unit`](crate::Table::unit)).
    pub const NORMALISED_BY: &str = "normalised_by";
    /// Root: the relative tolerance of the table.
    pub const TOLERANCE: &str = "tolerance";
    /// Root: the program that made the table, with its version.
    pub const CREATED_BY: &str = "created_by";
    /// Root: the certificate, which is the largest relative error at sampled points.
    pub const CERTIFIED_MAX_ERROR: &str = "certified_max_error";
    /// Root: the median over these points of the largest relative error at a point.
    pub const CERTIFIED_MEDIAN_ERROR: &str = "certified_median_error";
    /// Root: the number of points of the certificate.
    pub const CERTIFIED_POINTS: &str = "certified_points";
    /// Root: the seed of the random points of the certificate.
    pub const CERTIFIED_SEED: &str = "certified_seed";
    /// Root: the relative error that 99.9 % of the points do not exceed.
    pub const CERTIFIED_P999_ERROR: &str = "certified_p999_error";
    /// Root: the name of the quantity with the largest error.
    pub const CERTIFIED_WORST_QUANTITY: &str = "certified_worst_quantity";
    /// Root: the four parameters of the point with the largest error.
    pub const CERTIFIED_WORST_POINT: &str = "certified_worst_point";
    /// Root: the largest relative errors of the four exact identities on the interpolant; NaN where
    /// not measured.
    pub const CERTIFIED_IDENTITY_ERRORS: &str = "certified_identity_errors";
    /// Root: the [`checksum`](super::checksum) of the scene and of all numbers. The checksums of HDF5 do not
    /// notice a chunk or an attribute that is missing, or another one in its place.
    pub const CHECKSUM: &str = "checksum";
    /// Dataset: the unit.
    pub const UNITS: &str = "units";
    /// Dataset: the meaning in words.
    pub const LONG_NAME: &str = "long_name";
    /// Axis: the coordinate in which the nodes are placed and interpolated.
    pub const SCALE: &str = "scale";
    /// Values: the defining equation.
    pub const EQUATION: &str = "equation";
}

/// The group of the four axes.
pub const AXES: &str = "axes";
/// The group of the tabulated quantities.
pub const VALUES: &str = "values";

/// Returns the CRC-32 (that of zip) of a dense table: the UTF-8 of its scene, which holds the layers of a
/// stack, then the numbers as little-endian f64, those of the attributes but not this one, of the axes, and
/// of the quantities, each of the three in the order of the alphabet.
pub fn checksum(table: &Table) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(table.description().scene.as_bytes());
    let mut add = |numbers: &[f64]| {
        for part in numbers.chunks(512) {
            let bytes: Vec<u8> = part
                .iter()
                .flat_map(|number| number.to_le_bytes())
                .collect();
            hasher.update(&bytes);
        }
    };
    let description = table.description();
    let certificate = &description.certificate;
    add(&certificate
        .identity_errors
        .map(|error| error.unwrap_or(f64::NAN)));
    add(&[
        certificate.max_error,
        certificate.median_error,
        certificate.p999_error,
        certificate.points as f64,
        certificate.seed as f64,
    ]);
    add(&certificate.worst_point);
    add(&[f64::from(FORMAT_VERSION)]);
    if let SubstratePoissonRatio::Fixed(nu0) = description.nu0 {
        add(&[nu0]);
    }
    add(&[description.tolerance]);
    let mut parameters = table.parameters();
    parameters.sort_unstable_by_key(|parameter| parameter.name());
    for parameter in parameters {
        add(table.axis(parameter));
    }
    let mut quantities = Quantity::ALL;
    quantities.sort_unstable_by_key(|quantity| quantity.name());
    for quantity in quantities {
        add(table.values(quantity).unwrap_or_default());
    }
    hasher.finalize()
}
