//! The shape of the probe that touches the film.

use std::f64::consts::FRAC_PI_2;

use crate::Error;
use crate::check::positive;
use crate::material::ROUNDING;
use crate::material::profile::Profile;

/// The contact radius (m) below which contacts of a probe without a largest radius are.
const LARGEST: f64 = 1e3;

/// The largest exponent of [`Probe::PowerLaw`].
const LARGEST_EXPONENT: f64 = 20.0;

/// The shape of the probe: its distance `f(r)` from the plane through its lowest point, at the
/// distance `r` from its axis.
///
/// Only the contact without adhesion depends on the shape: the load `F0(a)` and the penetration
/// `delta0(a)`, which the crate `contact` computes. A film, a substrate and the elasticity of the probe
/// enter as for a sphere. The shape is convex, so that the contact is one disc, but for one without adhesion
/// on a film many times stiffer than its substrate, under which the contact may be no disc: that is not modelled.
#[derive(Clone, Debug, PartialEq)]
pub enum Probe {
    /// The paraboloid `f = r^2/(2R)`, which JKR and Barthel's model put in place of a sphere.
    Paraboloid {
        /// The radius of curvature `R`, m.
        radius: f64,
    },
    /// The sphere itself, `f = R - sqrt(R^2 - r^2)`. On a film contacts up to 0.55 R are computed, load
    /// and penetration to 1e-6.
    Sphere {
        /// The radius `R`, m.
        radius: f64,
    },
    /// The power law `f = c r^n`.
    PowerLaw {
        /// The coefficient `c`, in m to the power `1 - n`.
        coefficient: f64,
        /// The exponent `n`, any real number from 1 to 20. Below 1 the tip would be a spike of
        /// infinite slope.
        exponent: f64,
    },
    /// The cone `f = r cot(half_angle)`.
    Cone {
        /// The angle between the axis and the flank, rad, between 0 and pi/2.
        half_angle: f64,
    },
    /// A cone with a round end: `f = r^2/(2R)` up to `r = R cot(half_angle)`, where the flank of
    /// the cone continues it with the same slope.
    RoundedCone {
        /// The radius of curvature `R` of the end, m.
        radius: f64,
        /// The angle between the axis and the flank, rad, between 0 and pi/2.
        half_angle: f64,
    },
    /// A flat cylindrical punch. Its contact has one radius, that of the punch.
    FlatPunch {
        /// The radius of the punch, m.
        radius: f64,
    },
    /// A cone with a flat end: `f = 0` up to the radius of the end, `(r - radius) cot(half_angle)`
    /// beyond.
    FlatEndedCone {
        /// The radius of the flat end, m. A contact is at least as large.
        radius: f64,
        /// The angle between the axis and the flank, rad, between 0 and pi/2.
        half_angle: f64,
    },
    /// A measured shape.
    Profile(Profile),
}

impl Probe {
    /// Returns the radius `R` (m) of the shape: the radius of curvature at the tip, or the radius
    /// of a flat end; `None` for a power law, a cone and a measured profile.
    pub const fn radius(&self) -> Option<f64> {
        match *self {
            Self::Paraboloid { radius }
            | Self::Sphere { radius }
            | Self::RoundedCone { radius, .. }
            | Self::FlatPunch { radius }
            | Self::FlatEndedCone { radius, .. } => Some(radius),
            Self::PowerLaw { .. } | Self::Cone { .. } | Self::Profile(_) => None,
        }
    }

    /// Tells whether this is a paraboloid, which stands for a sphere in small contacts.
    pub const fn is_paraboloid(&self) -> bool {
        matches!(self, Self::Paraboloid { .. })
    }

    /// Tells whether this is a flat punch, all contacts of which have one radius.
    pub const fn is_flat_punch(&self) -> bool {
        matches!(self, Self::FlatPunch { .. })
    }

    /// Returns the name in words.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Paraboloid { .. } => "paraboloid",
            Self::Sphere { .. } => "sphere",
            Self::PowerLaw { .. } => "power law",
            Self::Cone { .. } => "cone",
            Self::RoundedCone { .. } => "rounded cone",
            Self::FlatPunch { .. } => "flat punch",
            Self::FlatEndedCone { .. } => "flat-ended cone",
            Self::Profile(_) => "profile",
        }
    }

    /// Makes the shape of a [name](Probe::name) from its numbers, in the order of the fields; those
    /// of a profile are radius and height in turn. `None` for another name or number of numbers.
    ///
    /// # Errors
    /// Those of [`Profile::new`]; the other shapes are accepted with a system.
    pub fn of_numbers(name: &str, numbers: &[f64]) -> Option<Result<Self, Error>> {
        Some(Ok(match (name, numbers) {
            ("paraboloid", &[radius]) => Self::Paraboloid { radius },
            ("sphere", &[radius]) => Self::Sphere { radius },
            ("power law", &[coefficient, exponent]) => Self::PowerLaw {
                coefficient,
                exponent,
            },
            ("cone", &[half_angle]) => Self::Cone { half_angle },
            ("rounded cone", &[radius, half_angle]) => Self::RoundedCone { radius, half_angle },
            ("flat punch", &[radius]) => Self::FlatPunch { radius },
            ("flat-ended cone", &[radius, half_angle]) => {
                Self::FlatEndedCone { radius, half_angle }
            }
            ("profile", numbers) => {
                let (points, []) = numbers.as_chunks() else {
                    return None;
                };
                return Some(Profile::new(points).map(Self::Profile));
            }
            _ => return None,
        }))
    }

    /// Returns the radius of curvature at the tip, NaN without one.
    pub const fn tip_radius(&self) -> f64 {
        match *self {
            Self::Paraboloid { radius }
            | Self::Sphere { radius }
            | Self::RoundedCone { radius, .. } => radius,
            _ => f64::NAN,
        }
    }

    /// Returns the smallest contact radius that the shape has, and the one below which the others
    /// are.
    pub fn contact_radii(&self) -> [f64; 2] {
        match self {
            Self::Paraboloid { radius } | Self::Sphere { radius } => [0.0, *radius],
            // The radius itself, and its rounding.
            Self::FlatPunch { radius } => [radius * (1.0 - ROUNDING), radius * (1.0 + ROUNDING)],
            Self::FlatEndedCone { radius, .. } => [*radius, LARGEST],
            Self::Profile(profile) => [profile.flat_end(), profile.end()],
            Self::PowerLaw { .. } | Self::Cone { .. } | Self::RoundedCone { .. } => [0.0, LARGEST],
        }
    }

    /// Returns the slope `f'(a)` of the shape at a radius.
    pub fn slope(&self, a: f64) -> f64 {
        match *self {
            Self::Paraboloid { radius } => a / radius,
            Self::Sphere { radius } => a / ((radius - a) * (radius + a)).sqrt(),
            Self::PowerLaw {
                coefficient,
                exponent,
            } => coefficient * exponent * a.powf(exponent - 1.0),
            Self::Cone { half_angle } | Self::FlatEndedCone { half_angle, .. } => {
                half_angle.tan().recip()
            }
            Self::RoundedCone { radius, half_angle } => (a / radius).min(half_angle.tan().recip()),
            Self::FlatPunch { .. } => 0.0,
            Self::Profile(ref profile) => profile.slope(a),
        }
    }

    /// Accepts a shape with positive lengths and possible angles.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let angle = |half_angle: f64| {
            Error::unless(
                half_angle > 0.0 && half_angle < FRAC_PI_2,
                "half angle",
                half_angle,
                "between 0 and pi/2 rad, the angle between the axis and the flank",
            )
        };
        match *self {
            Self::Paraboloid { radius } | Self::Sphere { radius } => {
                positive("sphere_radius", radius)
            }
            Self::PowerLaw {
                coefficient,
                exponent,
            } => {
                positive("coefficient of the power law", coefficient)?;
                Error::unless(
                    (1.0..=LARGEST_EXPONENT).contains(&exponent),
                    "exponent of the power law",
                    exponent,
                    "from 1 to 20",
                )
            }
            Self::Cone { half_angle } => angle(half_angle),
            Self::RoundedCone { radius, half_angle } => {
                positive("radius of the round end", radius)?;
                angle(half_angle)
            }
            Self::FlatPunch { radius } => positive("radius of the punch", radius),
            Self::FlatEndedCone { radius, half_angle } => {
                positive("radius of the flat end", radius)?;
                angle(half_angle)
            }
            Self::Profile(_) => Ok(()),
        }
    }
}
