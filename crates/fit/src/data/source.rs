//! The column of a file that holds a quantity: the one that the user names, or the one that its heading
//! tells.

use super::column::{Column, Role, UNIT};
use super::failure::{DataError, Found, list};
use super::heading::Heading;
use super::remedy::{Remedy, another, named};
use super::{Cantilever, Format};
use crate::Direction;
use units::{Dimension, Unit};

/// Where a quantity comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// What the column holds.
    pub role: Role,
    /// The number of the column, from 0.
    pub index: usize,
    /// The unit.
    pub unit: Unit,
    /// The factor to SI units, with the sign.
    pub factor: f64,
    /// The heading.
    pub heading: String,
    /// What names the column: the heading, or what the user gave for it, with the unit that it lacks.
    pub typed: String,
    /// Whether the column has no unit and is taken to be in SI units.
    pub assumed_si: bool,
    /// The deflection for each newton of the force, m, which a separation has beside the height; 0 in other columns.
    pub compliance: f64,
}

/// The headings, and what the user says about them.
pub(super) struct Columns<'a> {
    pub headings: &'a [Heading],
    pub format: &'a Format,
    /// Why a line of the head that names a value of the cantilever tells none.
    pub untold: Option<&'a str>,
}

impl Columns<'_> {
    /// Returns the column that the user names, or the one that is recognised.
    pub(super) fn find(
        &self,
        role: Role,
        direction: Option<Direction>,
    ) -> Result<Option<Source>, DataError> {
        let columns = self.format.columns.iter();
        let named: Vec<Named> = columns
            .filter(|column| column.role == role)
            .map(|column| self.named(column))
            .collect::<Result<_, _>>()?;
        if !named.is_empty() {
            let has = |one: &&Named| role == Role::Segment || one.direction == direction;
            let of: Vec<&Named> = named.iter().filter(has).collect();
            let indices: Vec<usize> = of.iter().map(|one| one.index).collect();
            let Some(index) = unique(role, &indices)? else {
                return Ok(None);
            };
            let source = self.source(role, index, of[0].unit, of[0].negative)?;
            let typed = of[0].typed.clone();
            return Ok(Some(Source { typed, ..source }));
        }
        for name in names(role) {
            let matches =
                |heading: &Heading| heading.direction == direction && is_named(heading, role, name);
            if let Some(index) = unique(role, &self.positions(matches))? {
                let others = |name: &str| self.headings.iter().any(|other| other.name == name);
                let inverted = role.is_inverted(name.0, others);
                return self
                    .source(role, index, self.headings[index].unit, inverted)
                    .map(Some);
            }
        }
        Ok(None)
    }

    pub(super) fn positions(&self, matches: impl Fn(&Heading) -> bool) -> Vec<usize> {
        let headings = self.headings.iter().enumerate();
        headings
            .filter(|(_, heading)| matches(heading))
            .map(|(index, _)| index)
            .collect()
    }

    /// Returns the column that the user names.
    pub(super) fn named(&self, column: &Column) -> Result<Named, DataError> {
        let wanted = Heading::parse(&column.heading);
        let place = unique(column.role, &self.places(column, &wanted))?;
        // What is typed may be the heading with another unit behind it.
        let begins = |heading: &Heading| {
            heading.name == wanted.name
                || !heading.text.is_empty() && column.heading.starts_with(&heading.text)
        };
        let meant = place.or_else(|| self.headings.iter().position(begins));
        if let Some(heading) = meant.map(|index| &self.headings[index]) {
            let of_another = |unit: &Unit| !column.role.accepts(*unit);
            let what = if heading.unit_in_brackets().as_ref().is_some_and(of_another) {
                column.role.dimension().to_string()
            } else if heading.names_another() && column.role != Role::ContactArea {
                format!("the {} itself", column.role.name().replace('_', " "))
            } else {
                String::new()
            };
            if !what.is_empty() {
                return Err(DataError::new(format!(
                    "the column {:?} is named as {}, and by its heading its numbers are not {what}: convert them in the \
                     file (the radius is half of a diameter; a load over a radius times the radius is a load), and write \
                     what they are in the heading",
                    heading.text,
                    column.role.name()
                )));
            }
        }
        let Some(index) = place else {
            let unknown = DataError::new(format!(
                "no column is {:?}, named as {}; the columns are {}",
                column.heading,
                column.role.name(),
                list(&self.found(), ", ")
            ));
            return Err(unknown.with(another(column.role)));
        };
        let heading = &self.headings[index];
        Ok(Named {
            index,
            unit: wanted.unit.or(heading.unit),
            direction: wanted.direction.or(heading.direction),
            negative: column.negative,
            typed: column.heading.clone(),
        })
    }

    /// Returns the columns that the user can mean: those with this heading, else those with this
    /// name, else the one with this number.
    fn places(&self, column: &Column, wanted: &Heading) -> Vec<usize> {
        let exact = self.positions(|heading| heading.text == column.heading);
        if !exact.is_empty() {
            return exact;
        }
        let alike = self.positions(|heading| {
            heading.name == wanted.name
                && heading.direction == wanted.direction
                && (heading.unit.is_none() || wanted.unit.is_none() || heading.unit == wanted.unit)
        });
        if !alike.is_empty() {
            return alike;
        }
        let number = wanted.name.parse().unwrap_or(0);
        let is_there = (1..=self.headings.len()).contains(&number);
        is_there.then(|| number - 1).into_iter().collect()
    }

    /// Returns the source of a role in a column, with its factor to SI units.
    pub(super) fn source(
        &self,
        role: Role,
        index: usize,
        unit: Option<Unit>,
        negative: bool,
    ) -> Result<Source, DataError> {
        let heading = self.headings[index].text.clone();
        let assumed_si = role != Role::Segment && unit.is_none();
        let unit = self.unit(role, index, unit)?;
        let size = if negative { -unit.size } else { unit.size };
        let (factor, compliance) = self.of_cantilever(role, index, unit, size)?;
        Ok(Source {
            role,
            index,
            unit,
            factor: size * factor,
            typed: heading.clone(),
            heading,
            assumed_si,
            compliance,
        })
    }

    /// Returns the unit of a column, which was read as `unit`.
    fn unit(&self, role: Role, index: usize, unit: Option<Unit>) -> Result<Unit, DataError> {
        let heading = &*self.headings[index].text;
        let at = |what: String| DataError::new(what).in_column(index, heading);
        // A heading whose unit is to be told.
        let with_unit = |heading: &str| named(vec![(role, format!("{heading} {UNIT}"))]);
        match unit {
            Some(unit) if role.accepts(unit) => Ok(unit),
            Some(_) => {
                let other = DataError::new(format!(
                    "{heading:?} is named as {}, and is not in a unit of {}",
                    role.name(),
                    role.dimension()
                ));
                Err(other.with(another(role)))
            }
            None if role == Role::Segment || role.is_si(heading) => Ok(Unit::si(role.dimension())),
            None if let Some(unit) = &self.headings[index].unknown => {
                let is_cut = unit.contains(|c: char| c.is_ascii_alphabetic())
                    && !unit.starts_with(char::is_alphanumeric);
                let lost = if is_cut {
                    ": its first letter, such as that of micro, is lost"
                } else {
                    ""
                };
                let unknown = at(format!(
                    "{heading:?}, read as {}, is in {unit:?}, which is not a known unit{lost}; convert the numbers, or \
                     name a unit that {unit:?} stands for, such as {:?}",
                    role.name(),
                    role.example()
                ));
                Err(unknown.with(with_unit(heading)))
            }
            None => {
                let name = match heading {
                    "" => (index + 1).to_string(),
                    text => text.to_owned(),
                };
                let unitless = at(format!(
                    "{name:?}, read as {}, has no unit; name its unit, such as {:?}",
                    role.name(),
                    role.example()
                ));
                Err(unitless.with(with_unit(&name)))
            }
        }
    }

    /// Returns the factor by which the stiffness of the cantilever turns a deflection into a force, and the compliance by
    /// which the force turns a separation into a height. `size` is that of the unit, with the sign.
    fn of_cantilever(
        &self,
        role: Role,
        index: usize,
        unit: Unit,
        size: f64,
    ) -> Result<(f64, f64), DataError> {
        let heading = &self.headings[index].text;
        let at = |what: String| DataError::new(what).in_column(index, heading);
        let Cantilever {
            stiffness,
            sensitivity,
        } = self.format.cantilever;
        let because = |untold: &str| format!(": {untold}");
        let because = self.untold.map(because).unwrap_or_default();
        let no_force = |stiffness: f64, sensitivity: Option<f64>| {
            let of_volts = |value: f64| format!(" with a sensitivity of {value:?} m/V");
            at(format!(
                "a stiffness of {stiffness:?} N/m{} turns no deflection into a force; the stiffness must be \
                 positive and finite, and the sensitivity (m/V) finite and not 0",
                sensitivity.map(of_volts).unwrap_or_default()
            ))
        };
        if role == Role::Separation {
            let Some(stiffness) = stiffness else {
                let lacking = at(format!(
                    "a separation of tip and sample is the height and the deflection together, and the height follows from it by the \
                     force and the stiffness (N/m) of the cantilever, which the file does not name{because}"
                ));
                return Err(lacking.with(Remedy::Cantilever { sensitivity: false }));
            };
            let compliance = stiffness.recip();
            if !(compliance > 0.0 && compliance.is_finite()) {
                return Err(no_force(stiffness, None));
            }
            return Ok((1.0, compliance));
        }
        if role == Role::Deflection {
            let volts = unit.dimension == Dimension::Voltage;
            let (Some(stiffness), Some(sensitivity)) =
                (stiffness, if volts { sensitivity } else { Some(1.0) })
            else {
                let (further, missing) = match volts {
                    true => (" and, in volts, the sensitivity (m/V)", "both"),
                    false => ("", "it"),
                };
                let lacking = at(format!(
                    "a deflection is a force by the stiffness (N/m) of the cantilever{further}, and the file does not \
                     name {missing}{because}"
                ));
                return Err(lacking.with(Remedy::Cantilever { sensitivity: volts }));
            };
            let is_sound = stiffness > 0.0 && sensitivity != 0.0;
            let factor = stiffness * sensitivity;
            if !is_sound || !(size * factor).is_finite() || size * factor == 0.0 {
                return Err(no_force(stiffness, volts.then_some(sensitivity)));
            }
            return Ok((factor, 0.0));
        }
        Ok((1.0, 0.0))
    }

    /// Returns the columns, as far as their headings and the user tell.
    pub(super) fn found(&self) -> Vec<Found> {
        let is_given = |index: usize, role: Role| {
            self.format.columns.iter().any(|column| {
                column.role == role
                    && self.places(column, &Heading::parse(&column.heading)) == [index]
            })
        };
        let role = |(index, heading): (usize, &Heading)| {
            let mut roles = Role::ALL.into_iter();
            roles.find(|&role| {
                is_given(index, role) || names(role).any(|name| is_named(heading, role, name))
            })
        };
        let headings = self.headings.iter().enumerate();
        headings
            .map(|column| Found {
                heading: column.1.clone(),
                role: role(column),
            })
            .collect()
    }
}

/// Returns the only one of the columns that could be a role, if there is one.
pub(super) fn unique(role: Role, indices: &[usize]) -> Result<Option<usize>, DataError> {
    match indices {
        [] => Ok(None),
        [index] => Ok(Some(*index)),
        [first, second, ..] => {
            let (first, second) = (first + 1, second + 1);
            let several = DataError::new(format!(
                "columns {first} and {second} could both be {}; choose one by its number",
                role.name()
            ));
            Err(several.with(named(vec![(role, first.to_string())])))
        }
    }
}

/// Returns the names under which a role is recognised, and whether a name needs a unit: a
/// deflection in newtons is a load, and so is `P`, which may be a pressure.
fn names(role: Role) -> impl Iterator<Item = (&'static str, bool)> {
    let forces = Role::Deflection.headings().iter().chain(&["p"]);
    let forces = forces.filter(move |_| role == Role::Load);
    let own = role.headings().iter().map(|name| (*name, false));
    own.chain(forces.map(|name| (*name, true)))
}

/// Tells whether a heading is recognised as a role by one of its names.
fn is_named(heading: &Heading, role: Role, (name, needs_unit): (&str, bool)) -> bool {
    // `contactRadius` has no spaces.
    let letters = |name: &str| name.replace(' ', "");
    letters(&heading.name) == letters(name)
        && match heading.unit {
            Some(unit) => role.accepts(unit),
            None => !needs_unit,
        }
}

/// A column that the user names.
pub(super) struct Named {
    pub index: usize,
    pub unit: Option<Unit>,
    direction: Option<Direction>,
    negative: bool,
    typed: String,
}
