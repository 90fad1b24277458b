//! The names of the parts of an HDF5 table, shared by its writer and its reader.

use crate::{Quantity, SubstratePoissonRatio, Table};

/// The value of the root attribute [`attribute::FORMAT`].
pub const FORMAT: &str = "coated-contact-table";
/// The only version of the HDF5 format that is written and read. The packed form has its own
/// version.
pub const FORMAT_VERSION: u32 = 3;

/// The value of the root attribute [`attribute::COMMENT`], so that a reader of the file needs no other page.
pub const COMMENT: &str = "A sphere of radius R touches a film of thickness t without friction. The film is bonded to a substrate; where \
     the scene has a [stack], it is its top layer, t the thickness of all layers, the substrate their base, and \
     layers may slide. a is the contact radius, F the load, positive in compression, and E* the modulus that \
     normalised_by names: E2* of the sphere, E1* of the film, or Es* with 1/Es* = 1/E1* + 1/E2*. Reduced moduli are \
     Ei* = Ei/(1 - nui^2). Without adhesion the load is F0 and the penetration d0 = a^2 delta0/R. With the work of \
     adhesion w the edge of the contact has 2 g^2/(pi a Es*) = w, and F = F0 - S |dfp|, d = d0 - |dfp|, |dfp| = 2 \
     g/(E* gamma). nu0 is the Poisson ratio of the substrate; where it is 'paired', nu1 = b/(1 + b) and nu0 = (1 - \
     b)/(2 - b), and another film and substrate are those of b = p nu1/(1 - nu1) + (1 - p) (1 - 2 nu0)/(1 - nu0) with \
     p = E0*/(E0* + E1*) at the same E1* and E0*. The certified errors are those of splines, an axis at a time, of \
     degree 9 or of one less than the nodes, through the logarithms of pi0, eeq and gamma over Es*/E* and of delta0, \
     in the coordinates of 'scale'.";
/// The value of the root attribute [`attribute::REFERENCES`].
pub const REFERENCES: &str = "E. Barthel and A. Perriot, J. Phys. D: Appl. Phys. 40 (2007) 1059-1067; E. Barthel, \
     arXiv:cond-mat/0703616 (2007)";
/// The value of the root attribute [`attribute::LICENSE`].
pub const LICENSE: &str = env!("CARGO_PKG_LICENSE");

/// The names of the attributes.
pub mod attribute {
    /// Root: the kind of the file, [`FORMAT`](super::FORMAT).
    pub const FORMAT: &str = "format";
    /// Root: the version of the format, [`FORMAT_VERSION`](super::FORMAT_VERSION).
    pub const FORMAT_VERSION: &str = "format_version";
    /// Root: the meaning of the symbols and the relations between the quantities, [`COMMENT`](super::COMMENT).
    pub const COMMENT: &str = "comment";
    /// Root: where the model is described, [`REFERENCES`](super::REFERENCES).
    pub const REFERENCES: &str = "references";
    /// Root: the licence, [`LICENSE`](super::LICENSE).
    pub const LICENSE: &str = "license";
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
    let axes = table
        .parameters()
        .map(|axis| (axis.name(), table.axis(axis)));
    let values = Quantity::ALL.map(|of| (of.name(), table.values(of).unwrap_or_default()));
    for mut sets in [axes, values] {
        sets.sort_unstable_by_key(|&(name, _)| name);
        for (_, numbers) in sets {
            add(numbers);
        }
    }
    hasher.finalize()
}
