//! Whether numbers have the magnitudes of a contact experiment.
//!
//! A wrong unit is wrong by a factor of a thousand or more. These checks name what no experiment has,
//! and the likely mistake. They are wide: what may be, if seldom, is not named.

use std::borrow::Cow;
use std::fmt;

use interp::{HalfSpace, Probe, Profile, System};

/// The Young's moduli of solids, Pa: from the softest gels to beyond diamond (some 1200 GPa).
pub const MODULI: [f64; 2] = [1.0, 2e12];
/// The lengths of the bodies of a contact, m: from an atom to the largest lens.
pub const LENGTHS: [f64; 2] = [1e-10, 0.1];
/// The largest work of adhesion (J/m^2): twice the surface energy of diamond is 12 J/m^2.
pub const LARGEST_WORK: f64 = 20.0;

/// The stiffnesses of cantilevers and load cells, N/m.
pub const STIFFNESSES: [f64; 2] = [1e-6, 1e9];

/// The radii of the narrowest and of the widest contact, m.
const CONTACTS: [f64; 2] = [1e-9, 1e-2];
/// The smallest slope at the edge of the widest contact: that of a sphere of 0.2 m, or of a cone with a half angle of 87
/// degrees.
const FLATTEST: f64 = 0.05;
/// The height of a measured profile over its largest radius, and the slope at the edge of the narrowest contact, above
/// which one of their units is probably wrong: that of a cone with a half angle of 1 degree.
const STEEPEST: f64 = 57.0;

/// A number that a contact experiment does not have, or hardly has.
#[derive(Clone, Debug, PartialEq)]
pub struct Magnitude {
    /// What it is, in words.
    pub what: Cow<'static, str>,
    /// The number, in SI units.
    pub value: f64,
    /// The SI unit.
    pub unit: &'static str,
    /// What is wrong with it, and the likely mistake.
    pub reason: Cow<'static, str>,
}

impl fmt::Display for Magnitude {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            what,
            value,
            unit,
            reason,
        } = self;
        write!(f, "{what} = {} {unit} {reason}", short(*value))
    }
}

impl Magnitude {
    /// Names what no contact has of the radius, the thickness and the moduli of a system, and of the
    /// work of adhesion (J/m^2) between its bodies.
    pub fn of_system(system: &System, work_of_adhesion: f64) -> Vec<Self> {
        let coating = [
            Self::length("the film thickness", system.film_thickness),
            Self::modulus("the film's modulus", system.film.young()),
            Self::modulus("the substrate's modulus", system.substrate.young()),
        ];
        let coating = coating.into_iter().flatten();
        Self::of_probe(&system.probe, system.sphere_modulus, work_of_adhesion)
            .chain(coating)
            .collect()
    }

    /// Names what no contact has of a probe of a reduced modulus (Pa), of layers with their
    /// thicknesses (m) and moduli (Pa) on a base of the modulus `base` (Pa), and of the work of
    /// adhesion (J/m^2) between probe and layers.
    pub fn of_layered(
        probe: &Probe,
        sphere_modulus: f64,
        base: f64,
        layers: impl IntoIterator<Item = [f64; 2]>,
        work_of_adhesion: f64,
    ) -> Vec<Self> {
        let layers = layers.into_iter().flat_map(|[thickness, modulus]| {
            [
                Self::length("the thickness of a layer", thickness),
                Self::modulus("the modulus of a layer", modulus),
            ]
        });
        let layers = layers.chain([Self::modulus("the modulus of the base", base)]);
        Self::of_probe(probe, sphere_modulus, work_of_adhesion)
            .chain(layers.flatten())
            .collect()
    }

    /// Names what no contact has of a probe on a half-space, and of the work of adhesion (J/m^2) between
    /// both.
    pub fn of_half_space(half_space: &HalfSpace, work_of_adhesion: f64) -> Vec<Self> {
        let modulus = Self::modulus("the half-space's modulus", half_space.solid.young());
        Self::of_probe(
            &half_space.probe,
            half_space.sphere_modulus,
            work_of_adhesion,
        )
        .chain(modulus)
        .collect()
    }

    /// Names what no contact has of a probe, its reduced modulus (Pa) and its work of adhesion
    /// (J/m^2) to a surface.
    pub fn of_probe(
        probe: &Probe,
        sphere_modulus: f64,
        work_of_adhesion: f64,
    ) -> impl Iterator<Item = Self> {
        let radius = probe.radius();
        let [width, height] = match probe {
            Probe::Profile(profile) => [
                Self::length("the largest r of the profile", profile.end()),
                Self::height(profile),
            ],
            _ => [None, None],
        };
        let found = [
            radius.and_then(|radius| Self::length("the radius of the sphere", radius)),
            width,
            height,
            Self::coefficient(probe),
            Self::modulus("the sphere's modulus", sphere_modulus),
            Self::work_of_adhesion("the work of adhesion", work_of_adhesion),
        ];
        found.into_iter().flatten()
    }

    /// Checks the coefficient of a power law by the slopes at the edges of contacts.
    fn coefficient(probe: &Probe) -> Option<Self> {
        let &Probe::PowerLaw {
            coefficient,
            exponent,
        } = probe
        else {
            return None;
        };
        let [narrow, wide] = CONTACTS.map(|a| [a, probe.slope(a)]);
        let ([a, slope], which) = if wide[1] < FLATTEST {
            (wide, "flatter")
        } else if narrow[1] > STEEPEST {
            (narrow, "steeper")
        } else {
            return None;
        };
        let slope = short(slope);
        let mut reason = format!(
            "makes a slope of {slope} at a radius of {a} m, {which} than any probe: r and c r^n are in m"
        );
        if which == "flatter" {
            let [um, nm] =
                [1e6_f64, 1e9].map(|unit| short(coefficient * unit.powf(exponent - 1.0)));
            reason +=
                &format!("; if both are in um, it is {um} m^(1-n) in m, if in nm {nm} m^(1-n)");
        }
        Some(Self {
            what: "the coefficient of the power law".into(),
            value: coefficient,
            unit: "m^(1-n)",
            reason: reason.into(),
        })
    }

    /// Checks the stiffness of a cantilever or a load cell, N/m.
    pub fn stiffness(value: f64) -> Option<Self> {
        let [least, most] = STIFFNESSES;
        let outside = value > 0.0 && !(least..=most).contains(&value);
        outside.then(|| Self {
            what: "the stiffness".into(),
            value,
            unit: "N/m",
            reason: format!("is outside {least:e} to {most:e} N/m: check its unit").into(),
        })
    }

    /// Checks the height of a measured profile over its largest radius.
    fn height(profile: &Profile) -> Option<Self> {
        let end = profile.end();
        let mut bends = profile.slopes().to_vec();
        bends.push([end, profile.slope(end)]);
        let spans = bends.windows(2);
        let height: f64 = spans
            .map(|ends| 0.5 * (ends[0][1] + ends[1][1]) * (ends[1][0] - ends[0][0]))
            .sum();
        let ratio = height / end;
        (ratio > STEEPEST).then(|| Self {
            what: "the largest z of the profile over its largest r".into(),
            value: ratio,
            unit: "m/m",
            reason: format!(
                "is above {STEEPEST}, that of a cone with a half angle of 1 degree: check the units of r and z"
            )
            .into(),
        })
    }

    /// Checks a length of a body, m.
    ///
    /// ```
    /// use contact::magnitude::Magnitude;
    ///
    /// assert_eq!(Magnitude::length("the film thickness", 30e-6), None);
    /// let found = Magnitude::length("the film thickness", 30.0).expect("it is 30 m");
    /// let reason = "is above 0.1 m: 30 mm, 30 um or 30 nm was probably meant";
    /// assert_eq!(found.to_string(), format!("the film thickness = 30 m {reason}"));
    /// ```
    pub fn length(what: impl Into<Cow<'static, str>>, value: f64) -> Option<Self> {
        let [least, most] = LENGTHS;
        let reason = if 1e-9 * value > most {
            format!("is above {most} m: check it and its unit")
        } else if value > most {
            let value = short(value);
            format!("is above {most} m: {value} mm, {value} um or {value} nm was probably meant")
        } else if value < least && value > 0.0 {
            format!("is below {least:?} m, the size of an atom: check its unit")
        } else {
            return None;
        };
        Some(Self {
            what: what.into(),
            value,
            unit: "m",
            reason: reason.into(),
        })
    }

    /// Checks a modulus, Pa. An infinite one is that of a rigid body.
    pub fn modulus(what: impl Into<Cow<'static, str>>, value: f64) -> Option<Self> {
        let [least, most] = MODULI;
        let side = if value > most && value.is_finite() {
            "above"
        } else if value < least && value > 0.0 {
            "below"
        } else {
            return None;
        };
        Some(Self {
            what: what.into(),
            value,
            unit: "Pa",
            reason: format!(
                "is {side} the moduli of all solids, {least} Pa to {} GPa: check the units",
                most / 1e9
            )
            .into(),
        })
    }

    /// Checks the work of adhesion of a receding line, J/m^2.
    pub fn work_of_adhesion_receding(value: f64) -> Option<Self> {
        Self::work_of_adhesion("the receding work of adhesion", value)
    }

    /// Checks a work of adhesion, J/m^2.
    pub fn work_of_adhesion(what: impl Into<Cow<'static, str>>, value: f64) -> Option<Self> {
        (value > LARGEST_WORK).then(|| Self {
            what: what.into(),
            value,
            unit: "J/m^2",
            reason: format!(
                "is above {LARGEST_WORK} J/m^2, more than any two solids have: mN were probably taken \
                 for N, or mJ/m^2 for J/m^2"
            )
            .into(),
        })
    }
}

/// Writes a number with at most six digits.
fn short(value: f64) -> String {
    let value: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if (1e-3..1e5).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hemisphere by half degrees, whose last slope is that of a wall, and a paraboloid with z in um for nm.
    #[test]
    fn profiles_are_judged_by_their_height() {
        let found = |points: &[[f64; 2]]| {
            let profile = Profile::new(points).expect("convex");
            Magnitude::of_probe(&Probe::Profile(profile), 1e6, 0.04).count()
        };
        let hemisphere: Vec<[f64; 2]> = (0..=180)
            .map(|i| (0.5 * f64::from(i)).to_radians())
            .map(|angle| [1e-6 * angle.sin(), 1e-6 * (1.0 - angle.cos())])
            .collect();
        assert_eq!(found(&hemisphere), 0);
        let paraboloid = |unit: f64| -> Vec<[f64; 2]> {
            let radii = (0..=30).map(|i| 1e-7 * f64::from(i));
            radii.map(|r| [r, unit * r * r / 2e-5]).collect()
        };
        assert_eq!([1.0, 1e3].map(|unit| found(&paraboloid(unit))), [0, 1]);
    }

    /// Spheres of 1 nm to 0.1 m, a rounded pyramid and a blunt tip pass. Coefficients in um do not, nor do ones beyond all
    /// units.
    #[test]
    fn power_laws_are_judged_by_their_slopes() {
        let found = |coefficient: f64, exponent: f64| {
            let probe = Probe::PowerLaw {
                coefficient,
                exponent,
            };
            Magnitude::of_probe(&probe, 1e6, 0.04)
                .map(|found| found.to_string())
                .collect::<Vec<_>>()
        };
        for (coefficient, exponent) in [
            (5.0, 2.0),
            (5e8, 2.0),
            (0.1, 1.05),
            (1e3, 1.5),
            (1e10, 3.0),
            (1e110, 20.0),
        ] {
            assert_eq!(
                found(coefficient, exponent),
                [""; 0],
                "{coefficient} {exponent}"
            );
        }
        assert_eq!(
            found(0.01, 3.0),
            [
                "the coefficient of the power law = 0.01 m^(1-n) makes a slope of 3e-6 at a radius of 0.01 m, flatter than any \
              probe: r and c r^n are in m; if both are in um, it is 1e10 m^(1-n) in m, if in nm 1e16 m^(1-n)"
            ]
        );
        for (coefficient, exponent) in [(0.05, 2.0), (1e300, 3.0)] {
            assert_eq!(
                found(coefficient, exponent).len(),
                1,
                "{coefficient} {exponent}"
            );
        }
    }
}
