//! The flags of a contact stiffness: the indenter, its contact depth, and a reference sample.

use std::path::PathBuf;

use ::fit::{
    AreaFunction, Bodies, ContactDepth, Experiment, Fixed, Free, Indentation, Kind, Measurement,
    Parameter, Scope,
};
use anyhow::{Context, bail, ensure};
use clap::ValueHint;
use interp::{Elastic, Probe};
use units::{Dimension, Quantity};

use super::one_of;
use crate::cli::probe::Shape;
use crate::cli::quantity::{any, length, modulus, number, read};
use crate::cli::system::{SystemArguments, Value};

/// The heading of these flags in the help.
const HEADING: &str = "Contact stiffness";

/// The flags of an indenter.
#[derive(clap::Args)]
#[group(skip)]
pub struct IndentationArguments {
    /// Factor of a contact stiffness, S = beta 2 a E2* Eeq: 1 of spheres and cones, 1.034 of a
    /// Berkovich pyramid, 1.012 of Vickers' pyramid [default: 1]
    #[arg(long, help_heading = HEADING, value_name = "BETA", value_parser = number)]
    pub beta: Option<f64>,
    /// Factor of the contact depth h - epsilon P/S + h0: 0.75 of paraboloids and pyramids, 0.72 of
    /// cones, 1 of flat punches [default: 0.75]
    #[arg(long, help_heading = HEADING, value_name = "EPSILON", value_parser = number)]
    epsilon: Option<f64>,
    /// Area function of the indenter, with the contact depth h in nm and the area in nm^2:
    /// C0 h^2 + C1 h + C2 h^(1/2) + .. + C8 h^(1/128) [default: 24.56]
    #[arg(
        long,
        help_heading = HEADING,
        value_name = "C0,C1,...",
        value_delimiter = ',',
        value_parser = number
    )]
    area: Vec<f64>,
    /// Contact depth: h - epsilon P/S + h0 (oliver-pharr), or 1.2 (h - P/S + h0) (loubet), for metals
    /// that pile up [default: oliver-pharr]
    #[arg(long, help_heading = HEADING, value_parser = one_of(ContactDepth::ALL.map(|one| (one.name(), one))))]
    contact_depth: Option<ContactDepth>,
    /// Part K of the contact depth by which the film or the top layer is thinner under the tip,
    /// t - K h_c: 0.333 (Mencik) [default: 0]
    #[arg(long, help_heading = HEADING, value_name = "K", value_parser = number)]
    thinning: Option<f64>,
    /// Hardness H, Pa: the contact radius at a load P is (P/(pi H))^(1/2). Without it, and with no
    /// free hardness, the contact at a load is elastic
    #[arg(long, help_heading = HEADING, value_name = "PA", value_parser = modulus)]
    hardness: Option<f64>,
    /// Depth h0, m, by which the tip is blunter than its area function [default: 0]
    #[arg(long, help_heading = HEADING, value_name = "M", value_parser = length)]
    tip_rounding: Option<f64>,
    /// Compliance Cf of the frame, m/N or such as 0.2nm/mN: 1/S is read too large by Cf, the depth by
    /// Cf P [default: 0]
    #[arg(long, help_heading = HEADING, value_name = "M/N", value_parser = compliance)]
    frame_compliance: Option<f64>,
}

/// Reads the compliance of a frame.
fn compliance(text: &str) -> Result<f64, String> {
    read(text, Some(Dimension::Compliance))
}

impl IndentationArguments {
    /// Tells whether the film is thinner under the tip.
    pub fn thins(&self) -> bool {
        self.thinning.is_some_and(|part| part != 0.0)
    }

    /// Names a flag that a kind does not use, with why.
    fn unused(&self, kind: Kind) -> Option<String> {
        // Each flag, whether it is given, and whether it is of contact depths alone.
        let flags = [
            ("--beta", self.beta.is_some(), false),
            ("--epsilon", self.epsilon.is_some(), true),
            ("--area", !self.area.is_empty(), true),
            ("--contact-depth", self.contact_depth.is_some(), true),
            ("--thinning", self.thinning.is_some(), true),
            ("--hardness", self.hardness.is_some(), false),
            ("--tip-rounding", self.tip_rounding.is_some(), true),
            ("--frame-compliance", self.frame_compliance.is_some(), false),
        ];
        let mut given = flags.into_iter().filter(|(_, is_given, _)| *is_given);
        if !kind.is_stiffness() {
            let (flag, ..) = given.next()?;
            if flag == "--frame-compliance" && kind == Kind::LoadPenetration {
                return Some(
                    "--frame-compliance is for a contact stiffness. Displacements that hold the deflection of a frame or load \
                     cell of 1 kN/m, say, are heights, which grow away from the sample: --kind force-height --stiffness 1kN/m \
                     --column \"height=-HEADING [UNIT]\", and --free ...,contact-point"
                        .into(),
                );
            }
            return Some(format!(
                "{flag} is for a contact stiffness, and {} is measured: leave it out, or give --kind \
                 stiffness-radius, stiffness-load or stiffness-depth",
                kind.name()
            ));
        }
        if kind == Kind::StiffnessRadius && self.hardness.is_some() {
            return Some(
                "--hardness tells contact radii, and stiffness-radius measures them: leave it out"
                    .into(),
            );
        }
        if self.contact_depth == Some(ContactDepth::Loubet) && self.epsilon.is_some() {
            return Some("--epsilon is for --contact-depth oliver-pharr: leave it out".into());
        }
        let (flag, ..) =
            given.find(|(_, _, is_of_depths)| *is_of_depths && kind != Kind::StiffnessDepth)?;
        Some(format!(
            "{flag} is for contact depths, and {} is measured: leave it out, or give --kind \
             stiffness-depth",
            kind.name()
        ))
    }

    /// Returns what is known of the measurement.
    pub fn of(&self, kind: Kind) -> anyhow::Result<Indentation> {
        if let Some(unused) = self.unused(kind) {
            bail!(unused);
        }
        let new = Indentation::NEW;
        Ok(Indentation {
            beta: self.beta.unwrap_or(new.beta),
            epsilon: self.epsilon.unwrap_or(new.epsilon),
            area: if self.area.is_empty() {
                new.area
            } else {
                AreaFunction::new(&self.area).context("--area")?
            },
            contact_depth: self.contact_depth.unwrap_or(new.contact_depth),
            thinning: self.thinning.unwrap_or(new.thinning),
            hardness: self.hardness,
            tip_rounding: self.tip_rounding.unwrap_or(new.tip_rounding),
            frame_compliance: self.frame_compliance.unwrap_or(new.frame_compliance),
            ..new
        })
    }
}

/// Why a shape of the probe has no effect on stiffnesses at depths.
const WHY: &str =
    "at depths the area function tells the contact radii, and not the shape of the probe";

/// Tells whether all measurements are of stiffnesses at depths.
pub fn are_at_depths(experiments: &[Experiment]) -> bool {
    let mut kinds = experiments.iter().map(|one| one.measurement.kind);
    kinds.all(|kind| kind == Kind::StiffnessDepth)
}

/// Refuses a radius of the probe among the quantities that a flag gives to measurements at depths.
pub fn accept_no_radius(
    flag: &str,
    mut quantities: impl Iterator<Item = Fixed>,
) -> anyhow::Result<()> {
    let has_radius = quantities.any(|quantity| quantity == Fixed::SphereRadius);
    ensure!(!has_radius, "{flag} sphere-radius: {WHY}: leave it out");
    Ok(())
}

/// Refuses a shape of the probe at depths.
pub fn accept_no_shape(system: &SystemArguments) -> anyhow::Result<()> {
    if let Some(half_angle) = system.shape.half_angle {
        let area = std::f64::consts::PI * half_angle.to_radians().tan().powi(2);
        bail!(
            "--half-angle {half_angle:?}: {WHY}: leave out --probe and --half-angle, and give --area {area:.6} for \
             a cone of this angle"
        );
    }
    ensure!(
        system.shape.probe == Shape::Paraboloid && system.given(Value::SphereRadius).is_none(),
        "--{}: {WHY}: leave it out, and give --area, such as --area -3.14159,6283.19 for a sphere of R = 1 um \
         (-pi h^2 + 2 pi R h, with h and R in nm)",
        if system.given(Value::SphereRadius).is_some() {
            "sphere-radius"
        } else {
            "probe"
        }
    );
    Ok(())
}

/// Takes a probe whose radius limits no contact.
pub fn forget_shape(experiment: &mut Experiment) {
    /// The radius of the largest lens, m.
    const RADIUS: f64 = 0.1;
    experiment.bodies.probe = Probe::Paraboloid { radius: RADIUS };
    experiment.work_of_adhesion = 0.0;
}

/// The flags of a reference sample.
#[derive(clap::Args)]
#[group(skip)]
pub struct ReferenceArguments {
    /// A measurement of the same indenter on a bare sample of known modulus, of the same kind and
    /// with the same columns: it determines what is common to all files and free, the tip rounding or the
    /// compliance of the frame: --free film-modulus,tip-rounding
    #[arg(long, help_heading = HEADING, value_name = "DATA", value_hint = ValueHint::FilePath)]
    pub reference: Option<PathBuf>,
    /// Young's modulus of the reference sample, Pa [default: that of the substrate]
    #[arg(long, help_heading = HEADING, value_name = "PA", requires = "reference", value_parser = modulus)]
    reference_modulus: Option<f64>,
    /// Poisson ratio of the reference sample [default: that of the substrate]
    #[arg(long, help_heading = HEADING, value_name = "NU", requires = "reference", value_parser = number)]
    reference_poisson_ratio: Option<f64>,
}

impl ReferenceArguments {
    /// Returns the values of its own that the sample may have.
    pub const fn own(&self) -> [(Fixed, Option<f64>); 2] {
        [
            (Fixed::ReferenceModulus, self.reference_modulus),
            (Fixed::ReferencePoissonRatio, self.reference_poisson_ratio),
        ]
    }

    /// Tells whether a value is one of other bodies than those of a file, which `is_reference` or holds data.
    pub const fn is_apart(&self, quantity: Fixed, is_reference: bool) -> bool {
        match quantity {
            Fixed::SubstrateModulus => is_reference && self.reference_modulus.is_some(),
            Fixed::SubstratePoissonRatio => is_reference && self.reference_poisson_ratio.is_some(),
            Fixed::ReferenceModulus | Fixed::ReferencePoissonRatio => {
                !is_reference && self.reference.is_some()
            }
            _ => false,
        }
    }

    /// Refuses a reference sample that tells nothing: it has no film, and its own values are of no use.
    pub fn check(&self, free: &[Free]) -> anyhow::Result<()> {
        let is_common = |one: &Free| {
            let of_film = one.parameter.is_of_bodies() && one.parameter != Parameter::SphereModulus;
            one.scope == Scope::Shared && !of_film
        };
        ensure!(
            self.reference.is_none() || free.iter().any(is_common),
            "--reference: the reference sample tells nothing, as no free parameter has one value for it and the other \
             files; add tip-rounding, frame-compliance or sphere-modulus, such as --free film-modulus,tip-rounding, or \
             leave out the reference"
        );
        Ok(())
    }

    /// Returns the experiment on the reference sample, with the indenter of the experiment on the
    /// film.
    pub fn experiment(
        &self,
        measurement: Measurement,
        film: &Experiment,
    ) -> anyhow::Result<Experiment> {
        ensure!(
            measurement.kind.is_stiffness() && film.measurement.kind == measurement.kind,
            "--reference: a reference sample is for a contact stiffness, of the kind of the first \
             file: {} is {}",
            measurement.name,
            measurement.kind.name()
        );
        let substrate = film.bodies.base;
        let young = self.reference_modulus.unwrap_or(substrate.young());
        let poisson = self.reference_poisson_ratio.unwrap_or(substrate.poisson());
        let solid = Elastic::new(young, poisson).context("--reference-modulus")?;
        let bare = Bodies::bare(&measurement, film.bodies.on(solid));
        let mut experiment = Experiment::new(measurement, bare);
        experiment.indentation = film.indentation.clone();
        // A film is thinned, and a bare sample is not; its hardness is its own.
        experiment.indentation.thinning = 0.0;
        experiment.work_of_adhesion = film.work_of_adhesion;
        Ok(experiment)
    }
}

/// The standard deviation of ordinates, as the command line gives it.
#[derive(Clone, Debug)]
pub enum Noise {
    /// Relative: `1%`.
    Percent(f64),
    /// In the unit of the ordinate.
    Quantity(Quantity),
}

/// Reads a standard deviation.
pub fn noise(text: &str) -> Result<Noise, String> {
    match text.trim().strip_suffix('%') {
        Some(percent) => Ok(Noise::Percent(number(percent.trim())?)),
        None => any(text).map(Noise::Quantity),
    }
}

/// Returns the standard deviation of the abscissae of a kind.
pub fn abscissa_noise(given: &Quantity, kind: Kind) -> anyhow::Result<f64> {
    let dimension = ::fit::data::roles(kind)[0].dimension();
    given.of(Some(dimension)).context("--abscissa-noise")
}

impl Noise {
    /// Returns the standard deviation of the ordinates of a kind: relative for a contact stiffness,
    /// else in SI units.
    pub fn of(&self, kind: Kind) -> anyhow::Result<f64> {
        let value = match (self, kind.is_stiffness()) {
            (Self::Percent(percent), true) => percent / 100.0,
            (Self::Quantity(quantity), false) => {
                let dimension = ::fit::data::roles(kind)[1].dimension();
                quantity.of(Some(dimension)).context("--noise")?
            }
            (Self::Percent(percent), false) => anyhow::bail!(
                "--noise {percent}%: only the noise of a contact stiffness is in per cent; give that \
                 of {} in its unit",
                kind.names()[1]
            ),
            (Self::Quantity(_), true) => anyhow::bail!(
                "--noise: the noise of a contact stiffness is in per cent, because it spans decades: \
                 write --noise 1%"
            ),
        };
        ensure!(
            value >= 0.0,
            "--noise {value:?}: the standard deviation of a noise is a number of at least 0"
        );
        Ok(value)
    }
}

/// Reads two ends of a range, `LEAST..MOST`, in the unit of the abscissae.
pub fn range(text: &str) -> Result<[Quantity; 2], String> {
    let how = "LEAST..MOST, such as 60nm..250nm";
    let ends = text.split_once("..");
    let (least, most) = ends.ok_or_else(|| format!("{text:?} has no ..: write {how}"))?;
    let ends = [any(least)?, any(most)?];
    for dimension in [Dimension::Length, Dimension::Force] {
        if let [Ok(least), Ok(most)] = ends.each_ref().map(|end| end.of(Some(dimension)))
            && least >= most
        {
            return Err(format!("{text:?}: the first end must be below the second"));
        }
    }
    Ok(ends)
}
