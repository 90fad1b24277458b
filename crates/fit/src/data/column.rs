//! A column, as the user names it.

use std::str::FromStr;

use units::{Dimension, Unit};

/// What stands in place of a unit that the user has to fill in.
pub(super) const UNIT: &str = "[UNIT]";

named! {
    /// What a column holds.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Role {
        /// The contact radius.
        ContactRadius = "contact_radius",
        /// The load or force, positive in compression.
        Load = "load",
        /// The penetration.
        Penetration = "penetration",
        /// The height of the cantilever's base, smaller when it is closer to the sample.
        Height = "height",
        /// The deflection of the cantilever, positive in compression.
        Deflection = "deflection",
        /// The separation of tip and sample: the height and the deflection, force/stiffness.
        Separation = "separation",
        /// The segment: approach, retract or pause.
        Segment = "segment",
        /// The standard deviation of the contact radius.
        ContactRadiusError = "contact_radius_error",
        /// The standard deviation of the load or force.
        LoadError = "load_error",
        /// The standard deviation of the penetration.
        PenetrationError = "penetration_error",
        /// The standard deviation of the height.
        HeightError = "height_error",
        /// The contact stiffness; where there is a phase, its storage part.
        ContactStiffness = "contact_stiffness",
        /// The contact area, in place of the contact radius.
        ContactArea = "contact_area",
        /// The phase between contact stiffness and oscillation, the angle of the complex stiffness.
        PhaseShift = "phase_shift",
        /// The loss part of the contact stiffness.
        LossStiffness = "loss_stiffness",
        /// The standard deviation of the contact stiffness.
        ContactStiffnessError = "contact_stiffness_error",
        /// The time.
        Time = "time",
    }
}

impl Role {
    /// Returns the role of the standard deviations of this quantity, if they can be given.
    pub const fn error(self) -> Option<Self> {
        Some(match self {
            Self::ContactRadius => Self::ContactRadiusError,
            Self::Load => Self::LoadError,
            Self::Penetration => Self::PenetrationError,
            Self::Height => Self::HeightError,
            Self::ContactStiffness => Self::ContactStiffnessError,
            _ => return None,
        })
    }

    /// Returns the dimension of the numbers, first the usual one.
    pub const fn dimension(self) -> Dimension {
        match self {
            Self::Load | Self::LoadError => Dimension::Force,
            Self::ContactStiffness | Self::LossStiffness | Self::ContactStiffnessError => {
                Dimension::ForcePerLength
            }
            Self::ContactArea => Dimension::Area,
            Self::PhaseShift => Dimension::Angle,
            Self::Time => Dimension::Time,
            _ => Dimension::Length,
        }
    }

    /// Tells whether the numbers can be in a unit.
    pub fn accepts(self, unit: Unit) -> bool {
        unit.dimension == self.dimension()
            || (self == Self::Deflection && unit.dimension == Dimension::Voltage)
    }

    /// Returns a unit that is usual.
    pub const fn example(self) -> &'static str {
        match self {
            Self::Load | Self::LoadError => "mN",
            Self::ContactRadius | Self::ContactRadiusError => "um",
            Self::ContactStiffness | Self::LossStiffness | Self::ContactStiffnessError => "N/m",
            Self::ContactArea => "nm^2",
            Self::PhaseShift => "deg",
            Self::Time => "s",
            _ => "nm",
        }
    }

    /// Tells whether a heading without a unit is in SI units: the names that this program and the
    /// Python package afmformats write.
    pub(super) fn is_si(self, heading: &str) -> bool {
        let names: &[&str] = match self {
            Self::ContactRadius => &["contact_radius"],
            Self::Load => &["load", "force"],
            Self::Penetration => &["penetration"],
            Self::Height => &["height", "height (measured)", "height (piezo)"],
            Self::ContactStiffness => &["contact_stiffness"],
            Self::ContactArea => &["contact_area"],
            Self::PhaseShift => &["phase_shift"],
            Self::LossStiffness => &["loss_stiffness"],
            Self::Time => &["time"],
            _ => &[],
        };
        names.contains(&heading)
    }
}

/// A column that the user names: `load=Force [mN]`, `height=-Z (um)`, `contact_radius=3 [um]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// What it holds.
    pub role: Role,
    /// Whether its numbers count in the opposite sense.
    pub negative: bool,
    /// Its heading, with a unit if the file has none, or its number, from 1.
    pub heading: String,
}

impl FromStr for Column {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let example = "write NAME=HEADING, such as \"load=Force [mN]\"";
        let (name, heading) = text
            .split_once('=')
            .ok_or_else(|| format!("{text:?} has no =: {example}"))?;
        let word = name.trim().to_lowercase().replace(['-', ' '], "_");
        let word = if word == "force" { "load" } else { &word };
        let role = Role::of_name(word);
        let names = Role::ALL.map(Role::name).join(", ");
        let role =
            role.ok_or_else(|| format!("{name:?} is not a column; the columns are {names}"))?;
        let heading = heading.trim();
        if heading.ends_with(UNIT) {
            let unit = role.example();
            return Err(format!(
                "{text:?} still has {UNIT}: put the unit of the numbers in its place, such as [{unit}]"
            ));
        }
        let positive = heading.strip_prefix('-');
        let heading = positive.unwrap_or(heading).trim();
        if heading.is_empty() {
            return Err(format!("{text:?} has no heading: {example}"));
        }
        Ok(Self {
            role,
            negative: positive.is_some(),
            heading: heading.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_is_named_by_its_heading_or_number() {
        for (text, role, negative, heading) in [
            ("load=Force [mN]", Role::Load, false, "Force [mN]"),
            ("force = F=m a", Role::Load, false, "F=m a"),
            ("height=-Z (um)", Role::Height, true, "Z (um)"),
            ("contact-radius=3", Role::ContactRadius, false, "3"),
        ] {
            let found: Column = text.parse().expect(text);
            let found = (found.role, found.negative, &*found.heading);
            assert_eq!(found, (role, negative, heading));
        }
        for (text, word) in [
            ("load", "has no ="),
            ("lode=x", "lode"),
            ("load=-", "no heading"),
            (
                "load=F [UNIT]",
                "unit of the numbers in its place, such as [mN]",
            ),
        ] {
            let error = text.parse::<Column>().unwrap_err();
            assert!(error.contains(word), "{error}");
        }
    }
}
