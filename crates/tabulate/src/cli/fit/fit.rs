//! What `tabulate fit` is given.

use std::path::PathBuf;

use ::fit::data::{Cantilever, Column, Format, SENSITIVITIES, Segments};
use ::fit::report::UnitOf;
use ::fit::{Direction, Fixed, Kind, Loss, Parameter};
use clap::ValueHint;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use units::{Dimension, Quantity};

use super::experiments::KnownArguments;
use super::free::FreeArguments;
use super::indentation::{self, Noise, ReferenceArguments};
use super::picture::PictureArguments;
use super::setting::{Given, Values, unit_of};
use crate::cli::quantity::{any, number, read};
use crate::cli::table_name::{self, TableName};

/// Find moduli and work of adhesion from measured contacts, with their errors
///
/// Each DATA file is a table of text: cells between tabs, semicolons, commas or spaces, a decimal
/// point or comma, comment lines (#, % or //) and other lines before the headings. Columns are
/// recognised by headings with a unit, such as `Force [mN]`, `Radius (um)`, `height_nm`,
/// `Piezo/nm`; --column names others. Without a unit, the names contact_radius, penetration, load,
/// force, time, height, `height (measured)`, `height (piezo)`, contact_stiffness, contact_area, phase_shift
/// and loss_stiffness are in SI units, all others an error.
/// A heading of one of these with error, std, sd, sigma or uncertainty, such as `load error [mN]`
/// and `radius_std`, is the column of its standard deviations. Each curve has a file of its own; its
/// segments may have headings of their own. The stiffness and the sensitivity of the cantilever are
/// those that the head of the file names, unless flags give others.
///
/// A contact stiffness (--kind stiffness-radius, stiffness-load, stiffness-depth) is that of a pinned
/// contact line, as nanoindenters (CSM) and dynamic AFMs measure it. With a column of its phase or of
/// its loss part, the modulus of the film is the absolute value of a complex one, and the report gives
/// the loss tangent.
///
/// Loads are positive in compression; heights are smaller when the cantilever is closer to the
/// sample: contact point - height = penetration + force/stiffness.
///
/// A film is looked up in the table. A stack of layers (--stack) is solved directly, which takes
/// some tenths of a second, and the modulus and the thickness of its layers can be free; or it is
/// looked up where --stack names a table of the stack.
///
/// Values that the fit needs and that are not given are an error that lists them. A value of the bodies
/// is fixed unless it is free (--free). A free modulus of sphere or film, if the other
/// is known, and a free work of adhesion need no value: the fit takes its start from the data.
///
/// With --relaxation the film relaxes in time. The points of a file are an approach, a hold and a
/// retract without adhesion; they give the modulus of the film and its relaxation function. The effect
/// of the film thickness is exact. A gel also relaxes by flow of its solvent, and that is no law of the
/// material: its time grows like the square of the contact radius. Fit curves of two radii: a material
/// has the same relaxation times at both.
///
/// Where adhesion depends on the speed v of the contact line, as under a lens of an elastomer, contact radii in time tell the
/// law: --free ...,doubling-speed,speed-exponent. The work of adhesion is then that of a line at rest, and the energy release
/// rate is w (1 + (v/v0)^n) where the line recedes and w / (1 + (v/v0)^n) where it advances, with the doubling-speed v0 and
/// the speed-exponent n. The speeds are read from the radii and a column of times.
///
/// With --friction stick, surfaces that have touched never slide, and each contact is solved directly;
/// without it, a warning says where full friction would change the modulus by more than its standard
/// error.
///
/// Which points are in contact is read from the data: points up to the jump of pull-off are in
/// contact, those after it are the baseline. With several files, the parameters are common to all
/// files unless they are the file's own: a global fit of films of several thicknesses is
/// --value film-thickness=1um,10um, and one of several spheres --value sphere-radius=1mm,3mm.
///
/// The exit status is 0 only if the fit has converged, all values have finite errors, and at most a
/// third of the points in contact is left out.
#[derive(clap::Args)]
#[command(after_help = crate::cli::examples!(
    "tabulate fit crates/fit/data/lens.csv --specimen paper --film-thickness 30um",
    "tabulate fit crates/fit/data/lens.csv --specimen paper --film-thickness 30um --noise 2uN --json",
    "tabulate fit crates/fit/data/primer.csv --specimen paper --stack tables/stacks/primer.toml",
))]
pub struct Arguments {
    /// The measurements: tables of text
    #[arg(required = true, value_name = "DATA", value_hint = ValueHint::FilePath)]
    pub(super) data: Vec<PathBuf>,
    /// The two quantities that were measured [default: the only ones that the columns fit]
    #[arg(long, value_parser = kinds())]
    pub(super) kind: Option<Kind>,
    /// A column that is not recognised: NAME=HEADING [UNIT]. NAME is one of contact_radius, load,
    /// penetration, height, deflection, separation, segment, time, contact_stiffness, contact_area, phase_shift and
    /// loss_stiffness, or with _error a column of standard deviations: load_error. The number of the column may stand for the heading, with `extend` or `retract`
    /// after it for one direction; a minus before it turns the sign
    #[arg(long = "column", value_name = "NAME=HEADING [UNIT]")]
    pub(super) columns: Vec<Column>,
    /// Sensitivity, m of deflection for each V, of a deflection in volts [default: that of the file]
    #[arg(long, value_name = "m/V", value_parser = sensitivity)]
    pub(super) sensitivity: Option<f64>,
    /// Where the directions of points come from: a column segment, phase or direction, comments
    /// `segment: retract` or headings of the file (file), or the turn of the height, penetration or load
    /// that is the abscissa, and at contact radii the largest ordinate (split). auto: from the file, and
    /// heights without a direction are split
    #[arg(long, default_value = "auto", value_parser = one_of(Segments::ALL.map(|one| (one.name(), one))))]
    pub(super) segments: Segments,
    /// Keep the points of one direction only
    #[arg(long, value_parser = one_of(Direction::ALL.map(|one| (one.name(), one))))]
    pub(super) only: Option<Direction>,
    /// Keep the points whose radius, penetration, height or load lies in a range: 60nm..250nm
    #[arg(long, value_name = "LEAST..MOST", value_parser = indentation::range)]
    pub(super) between: Option<[Quantity; 2]>,
    #[command(flatten)]
    pub(super) known: KnownArguments,
    #[command(flatten)]
    pub(super) free: FreeArguments,
    #[command(flatten)]
    pub(super) reference: ReferenceArguments,
    /// Value and standard error of a quantity that is not free, in SI units or with units:
    /// film-thickness=2e-6+-1e-7, also sphere-radius, half-angle=+-2deg, substrate-modulus, substrate-poisson-ratio,
    /// reference-modulus, reference-poisson-ratio, beta. A value that is given elsewhere is left out: film-thickness=+-3%, a part by which the values of all files err
    /// together. The calibration of an instrument, by which all its readings err together, is one of contact-radius,
    /// penetration, height, load (also by the sensitivity of a deflection), contact-stiffness: load=+-2%; that of a threshold by
    /// which all contact radii are read too large is contact-radius-zero=+-1um, and that of a drift of penetrations or heights
    /// with times position-drift=+-0.05nm/s. Can be given several times. The fit keeps the value, and its error adds to the standard errors:
    /// to the first order, as one of several independent errors. --prior instead lets the data move
    /// a free value
    #[arg(long = "known", value_name = "NAME=[VALUE]+-ERROR")]
    pub(super) given: Vec<Given>,
    /// Standard deviation of a load (N) or penetration (m), or of a contact stiffness in per cent (1%): one number, or one for each file, separated by commas [default: that
    /// of a column of standard deviations, such as `load error [mN]`, or estimated from the
    /// residuals]
    #[arg(
        long,
        value_name = "S",
        value_delimiter = ',',
        value_parser = indentation::noise,
        allow_hyphen_values = true
    )]
    pub(super) noise: Vec<Noise>,
    /// Standard deviation of a contact radius, penetration or height, m, or of a contact stiffness at loads a load, N:
    /// one number, or one for each file, separated by commas
    /// [default: that of a column such as `radius_error [um]`, or exact]. It counts by the slope of
    /// the model: the variance of a point is that of its load plus (slope x S)^2
    #[arg(
        long,
        visible_alias = "radius-noise",
        value_name = "S",
        value_delimiter = ',',
        value_parser = any
    )]
    pub(super) abscissa_noise: Vec<Quantity>,
    /// Robust loss, for data with outliers: Huber's with the threshold 1.345, or the soft L1 loss
    #[arg(long, value_parser = one_of([("huber", Loss::HUBER), ("soft-l1", Loss::SOFT_L1)]))]
    pub(super) robust: Option<Loss>,
    /// Intervals from the profile of the likelihood, at a level such as 0.95
    #[arg(long, value_name = "LEVEL", value_parser = number)]
    pub(super) intervals: Option<f64>,
    #[arg(
        long,
        default_value = "embedded",
        help = table_name::HELP,
        value_hint = ValueHint::FilePath
    )]
    pub(super) table: TableName,
    /// Units of the report: film-modulus=MPa [default: such that numbers are above 1]
    #[arg(
        long,
        value_name = "NAME=UNIT,...",
        value_parser = unit_of,
        value_delimiter = ',',
        conflicts_with = "json"
    )]
    pub(super) units: Vec<UnitOf>,
    /// Print a JSON object in SI units instead of the report
    ///
    /// {"created_by": program and version, "command", "read": [how each file was read], "converged": bool, "parameters": {"film_modulus": {"value", "stderr", "unit"}, ...},
    /// "sphere_young_modulus" with --sphere-poisson-ratio, "correlation": [[...]],
    /// "reduced_chi_squared", "noise", "abscissa_noise", "a_over_t": [least, most], "left_out", "line_speed": [least, most] in m/s with a doubling-speed, "loss": {"angle", "tangent", "stderr"} where
    /// phases are measured, "relaxation": {"law", "moduli": [{"time", "modulus"}, ...], "made_monotone",
    /// "unlike_bodies", "steps_error"} with --relaxation, "without_film": {...},
    /// "fixed_values": [{"name", "value", "unit", "step", "changes", "error"}], "warnings":
    /// [{"kind", "text"}]}. A parameter of which each file has its
    /// own is a list, with null, which has no row of the correlation, for a file that has none. With --intervals each parameter has an "interval". An infinite number is the text
    /// "inf" or "-inf", and one that is not known null.
    #[arg(long)]
    pub(super) json: bool,
    /// Write data, fit, residual and branch of every point here
    #[arg(long, value_name = "FILE.csv")]
    pub(super) csv: Option<PathBuf>,
    #[command(flatten)]
    pub(super) picture: PictureArguments,
}

/// Parses the name of a kind.
pub fn kinds() -> impl TypedValueParser<Value = Kind> {
    one_of(Kind::ALL.map(|kind| (kind.name(), kind)))
}

/// Parses one of several names.
pub fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    choices: [(&'static str, T); N],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(choices.map(|(name, _)| name)).map(move |given| {
        let chosen = choices.iter().find(|(name, _)| *name == given);
        chosen.expect("clap accepts these names only").1
    })
}

/// Reads the sensitivity of a deflection.
fn sensitivity(text: &str) -> Result<f64, String> {
    let value = read(text, Some(Dimension::LengthPerVoltage))?;
    let [least, most] = SENSITIVITIES;
    if !(least..=most).contains(&value.abs()) {
        return Err(format!(
            "{value:?} m/V is no sensitivity, which is from {least:e} to {most:e} m/V: write its unit, such as 50nm/V"
        ));
    }
    Ok(value)
}

impl Arguments {
    /// Returns the stiffness of the cantilever of a file, by its number, as a flag gives it.
    pub(super) fn stiffness(&self, values: &[Values], file: usize) -> Option<f64> {
        const STIFFNESS: Fixed = Fixed::Parameter(Parameter::Stiffness);
        let known = self.given.iter().find(|one| one.quantity == STIFFNESS);
        let own = values.iter().find(|one| one.quantity == STIFFNESS);
        let own = own.and_then(|one| one.values.get(file).or(one.values.first()));
        let said = known.and_then(|one| one.value).or(own.copied());
        said.or(self.known.stiffness)
    }

    /// Returns what is known of the files before they are read.
    pub(super) fn format(&self) -> Format {
        Format {
            between: self.between.clone(),
            kind: self.kind,
            columns: self.columns.clone(),
            cantilever: Cantilever {
                stiffness: self.known.stiffness,
                sensitivity: self.sensitivity,
            },
            segments: self.segments,
            only: self.only,
            keep_pauses: self.known.relaxing.is_given(),
        }
    }
}
