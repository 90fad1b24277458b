//! The shape of the probe, as the command line gives it.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow, bail, ensure};
use clap::{ValueEnum, ValueHint};
use interp::{Probe, Profile};
use units::Dimension;

use super::heading;
use super::quantity::{degrees, number};
use crate::input;

/// The shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Shape {
    /// r^2/(2R), the sphere of JKR and of Barthel's model
    Paraboloid,
    /// The sphere itself, R - sqrt(R^2 - r^2)
    Sphere,
    /// r cot(half angle)
    Cone,
    /// A cone with a round end, the paraboloid r^2/(2R) with R = --sphere-radius up to r = R cot(half
    /// angle). A spherical end differs from it, clearly at half angles below 60 degrees: give it by
    /// --profile
    RoundedCone,
    /// A flat cylinder of radius --sphere-radius
    FlatPunch,
    /// A cone with a flat end of radius --sphere-radius
    FlatEndedCone,
    /// coefficient r^exponent
    PowerLaw,
    /// The points of --profile
    Profile,
    /// Refused, with the cone in its place
    #[value(hide = true, alias = "berkovich", alias = "vickers")]
    Pyramid,
}

/// The flags of the shape.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct ProbeArguments {
    /// Shape of the probe
    #[arg(long, value_enum, default_value = "paraboloid")]
    pub probe: Shape,
    /// Angle between the axis and the flank of a cone, in DEGREES, or with a unit (1.2rad), below 90.
    /// Up to 1.57 it was probably meant in radians, and is refused. A four-sided pyramid whose faces make the angle A
    /// with the axis has the load of the cone with tan(angle) = 1.171 tan A
    #[arg(long, value_name = "DEGREES", value_parser = degrees)]
    pub half_angle: Option<f64>,
    /// Exponent n of the power law c r^n, from 1 to 20
    #[arg(long, value_name = "N", value_parser = number)]
    pub exponent: Option<f64>,
    /// Coefficient c of the power law c r^n, with r and c r^n in m
    #[arg(long, value_name = "C", value_parser = number)]
    pub coefficient: Option<f64>,
    /// CSV of a measured shape: distance r from the axis and height z above the lowest point, in
    /// the units of the headings, such as `r [um],z [nm]` or `r_um,z_nm`, or in m
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub profile: Option<PathBuf>,
}

impl ProbeArguments {
    /// Tells whether the shape has a radius.
    pub const fn has_radius(&self) -> bool {
        !matches!(self.probe, Shape::Cone | Shape::PowerLaw | Shape::Profile)
    }

    /// Returns the shape; `radius` is --sphere-radius, or a usual one where that is not given. A flag that
    /// the shape does not have, or that is missing, is an error.
    pub fn probe(&self, given_radius: Option<f64>, radius: f64) -> anyhow::Result<Probe> {
        let name = self
            .probe
            .to_possible_value()
            .map_or_else(String::new, |value| value.get_name().to_owned());
        let conical = matches!(
            self.probe,
            Shape::Cone | Shape::RoundedCone | Shape::FlatEndedCone
        );
        let pyramid = self.probe == Shape::Pyramid && self.half_angle.is_some();
        let (power, measured) = (self.probe == Shape::PowerLaw, self.probe == Shape::Profile);
        let flags = [
            (
                "--half-angle",
                self.half_angle.is_some(),
                conical || pyramid,
            ),
            ("--exponent", self.exponent.is_some(), power),
            ("--coefficient", self.coefficient.is_some(), power),
            ("--profile", self.profile.is_some(), measured),
        ];
        ensure!(
            self.has_radius() || given_radius.is_none(),
            "--probe {name} has no --sphere-radius: leave it out, or choose another --probe, such as \
             rounded-cone for a cone with a round end"
        );
        for (flag, given, needed) in flags {
            ensure!(given || !needed, "--probe {name} needs {flag}");
            ensure!(
                needed || !given,
                "--probe {name} has no {flag}: leave it out, or choose another --probe"
            );
        }
        let half_angle = match self.half_angle {
            Some(degrees) => {
                ensure!(
                    degrees > 0.0 && degrees < 90.0,
                    "--half-angle {degrees:?}: it must be between 0 and 90 degrees, the angle \
                     between the axis and the flank"
                );
                degrees.to_radians()
            }
            None => 0.0,
        };
        Ok(match self.probe {
            Shape::Paraboloid => Probe::Paraboloid { radius },
            Shape::Sphere => Probe::Sphere { radius },
            Shape::Cone => Probe::Cone { half_angle },
            Shape::RoundedCone => Probe::RoundedCone { radius, half_angle },
            Shape::FlatPunch => Probe::FlatPunch { radius },
            Shape::FlatEndedCone => Probe::FlatEndedCone { radius, half_angle },
            Shape::PowerLaw => Probe::PowerLaw {
                coefficient: self.coefficient.unwrap_or_default(),
                exponent: self.exponent.unwrap_or_default(),
            },
            Shape::Pyramid => bail!(cone_of_pyramid(self.half_angle.unwrap_or(17.5))),
            Shape::Profile => {
                let path = self.profile.as_deref().unwrap_or_else(|| Path::new(""));
                let profile = profile(path).with_context(|| path.display().to_string())?;
                Probe::Profile(profile)
            }
        })
    }
}

/// Says which cone has the load of a pyramid on a half-space (Bilodeau, J. Appl. Mech. 59, 519, 1992), whose faces make an
/// angle (degrees) with the axis.
fn cone_of_pyramid(face: f64) -> String {
    const WIDER: f64 = 1.171;
    let cone = (WIDER * face.to_radians().tan()).atan().to_degrees();
    // Enough digits to tell it from a right angle.
    let digits = (1.0 - (90.0 - cone).log10()).ceil().clamp(2.0, 15.0) as usize;
    format!(
        "a pyramid is taken for a cone: --probe cone --half-angle {cone:.digits$} for four faces that make {face} degrees with the axis (the same load), \
         and --probe cone --half-angle 70.3 for a Berkovich or Vickers indenter (the same area at a depth)"
    )
}

/// The first words of the headings of a measured shape: of distances from the axis, and of heights.
const HEADINGS: [&[&str]; 2] = [
    &["r", "x", "radius", "radial", "distance"],
    &["z", "h", "height", "depth"],
];

/// Reads a measured shape: two columns, r and z, with or without a line of headings. Lines that
/// begin with # are comments.
fn profile(path: &Path) -> anyhow::Result<Profile> {
    let text = String::from_utf8(fs::read(path)?).map_err(|_| input::not_utf8())?;
    let cells = |line: &str| -> Vec<String> {
        let cells = line.split([',', ';', '\t']).map(str::trim);
        cells
            .map(|cell| cell.trim_matches('"').to_owned())
            .collect()
    };
    let is_data = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let lines = text
        .trim_start_matches('\u{feff}')
        .lines()
        .enumerate()
        .filter(|(_, line)| is_data(line));
    let mut units: Option<[f64; 2]> = None;
    let mut points = Vec::new();
    let mut numbers = Vec::new();
    for (i, line) in lines {
        let cells = cells(line);
        let [r, z] = cells.as_slice() else {
            bail!(
                "line {}: {} cells; give two, r and z, with a comma, semicolon or tab between them",
                i + 1,
                cells.len()
            );
        };
        match (r.parse::<f64>(), z.parse::<f64>()) {
            (Ok(r), Ok(z)) => {
                let units = units.unwrap_or([1.0; 2]);
                points.push([r * units[0], z * units[1]]);
                numbers.push(i + 1);
            }
            _ if units.is_none() && points.is_empty() => {
                let [(of_r, unit_of_r), (of_z, unit_of_z)] = [
                    heading::named(r, Dimension::Length)?,
                    heading::named(z, Dimension::Length)?,
                ];
                let [is_distance, is_height] = HEADINGS.map(|names| {
                    [&of_r, &of_z].map(|heading| {
                        let word = heading.split([' ', '_', '-', '/']).next();
                        word.is_some_and(|word| names.contains(&word))
                    })
                });
                ensure!(
                    !(is_height[0] && is_distance[1]),
                    "line {}: the columns are {r:?} and {z:?}, height and distance: exchange them, the distance r comes first",
                    i + 1
                );
                ensure!(
                    is_distance[0] && is_height[1],
                    "line {}: the columns are {r:?} and {z:?}: give the distance r from the axis, which is half of a diameter or \
                     width, and the height z above the lowest point, with headings such as r [um],z [um]",
                    i + 1
                );
                units = Some([unit_of_r, unit_of_z]);
            }
            _ => bail!(
                "line {}: {line:?} is not two numbers with decimal points; units are in a line of headings before them, \
                 such as r [um],z [um]",
                i + 1
            ),
        }
    }
    let off_axis = points.first().is_some_and(|point| point[0] > 0.0);
    let before = if off_axis {
        " (the point r = 0, z = 0 is put before the first one: heights count from the lowest point of the probe)"
    } else {
        ""
    };
    Profile::new(&points).map_err(|error| match error {
        interp::Error::Profile { row, reason } => match numbers.get(row.wrapping_sub(1)) {
            Some(line) if row <= 2 => anyhow!("line {line}: {reason}{before}"),
            Some(line) => anyhow!("line {line}: {reason}"),
            None => anyhow!("{reason}"),
        },
        other => other.into(),
    })
}
