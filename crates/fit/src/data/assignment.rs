//! Which column of a file holds what.

use super::beside;
use super::column::{Column, Role};
use super::failure::{Found, Missing, Problem};
use super::heading::Heading;
use super::unit::{Dimension, Unit};
use super::{Cantilever, Format};
use crate::{Direction, Kind};

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
    /// Whether the column has no unit and is taken to be in SI units.
    pub assumed_si: bool,
}

/// The two columns of the points of one direction, or of all points.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The direction that the headings name.
    pub direction: Option<Direction>,
    /// The abscissa.
    pub abscissa: Source,
    /// The ordinate.
    pub ordinate: Source,
    /// The standard deviations of both, where there are columns of them.
    pub errors: [Option<Source>; 2],
    /// The columns beside them: of a contact stiffness.
    pub beside: Vec<Source>,
}

/// What the columns of a file hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// The kind of the measurement.
    pub kind: Kind,
    /// The pairs of columns.
    pub pairs: Vec<Pair>,
    /// The column of the segment.
    pub segment: Option<usize>,
}

/// A problem, and the column that has it.
pub(super) type Failure = (Option<usize>, Problem);

/// Assigns the columns with these headings. `uncalibrated` is a line that says that the cantilever is
/// not calibrated.
pub fn assign(
    headings: &[Heading],
    format: &Format,
    uncalibrated: Option<u64>,
) -> Result<Assignment, Failure> {
    let columns = Columns {
        headings,
        format,
        uncalibrated,
    };
    let kind = columns.kind()?;
    let mut pairs = Vec::new();
    for direction in DIRECTIONS {
        // Columns without a direction are all points; else each direction has its own.
        if direction.is_some() && pairs.iter().any(|pair: &Pair| pair.direction.is_none()) {
            break;
        }
        pairs.extend(columns.pair(kind, direction)?);
    }
    if pairs.is_empty() {
        let mut roles = columns.missing(kind);
        if roles.is_empty() {
            // Each is there for one direction, and no direction has both.
            roles = self::roles(kind).to_vec();
        }
        return Err(columns.lack(vec![Missing { kind, roles }]));
    }
    let segment = columns.find(Role::Segment, None)?;
    Ok(Assignment {
        kind,
        pairs,
        segment: segment.map(|source| source.index),
    })
}

/// What headings can say about directions.
const DIRECTIONS: [Option<Direction>; 3] =
    [None, Some(Direction::Approach), Some(Direction::Retract)];

/// Returns what the two columns of a kind hold: the abscissa and the ordinate.
pub const fn roles(kind: Kind) -> [Role; 2] {
    match kind {
        Kind::LoadRadius => [Role::ContactRadius, Role::Load],
        Kind::PenetrationRadius => [Role::ContactRadius, Role::Penetration],
        Kind::LoadPenetration => [Role::Penetration, Role::Load],
        Kind::ForceHeight => [Role::Height, Role::Load],
        Kind::StiffnessRadius => [Role::ContactRadius, Role::ContactStiffness],
        Kind::StiffnessLoad => [Role::Load, Role::ContactStiffness],
        Kind::StiffnessDepth => [Role::Penetration, Role::ContactStiffness],
    }
}

/// Returns the names under which a role is recognised, and whether a name needs a unit: a
/// deflection in newtons is a load.
fn names(role: Role) -> impl Iterator<Item = (&'static str, bool)> {
    let forces = (role == Role::Load).then(|| Role::Deflection.headings());
    let own = role.headings().iter().map(|name| (*name, false));
    own.chain(forces.into_iter().flatten().map(|name| (*name, true)))
}

/// Tells whether a heading is recognised as a role by one of its names.
fn is_named(heading: &Heading, role: Role, (name, needs_unit): (&str, bool)) -> bool {
    heading.name == name
        && match heading.unit {
            Some(unit) => role.accepts(unit),
            None => !needs_unit,
        }
}

/// The headings, and what the user says about them.
pub(super) struct Columns<'a> {
    pub headings: &'a [Heading],
    pub format: &'a Format,
    uncalibrated: Option<u64>,
}

impl Columns<'_> {
    /// Returns the kind that the user gives, or the only one that the headings fit.
    fn kind(&self) -> Result<Kind, Failure> {
        if let Some(kind) = self.format.kind {
            return Ok(kind);
        }
        // A kind without use for a column that the user names is not meant.
        let is_meant = |kind: &Kind| {
            let [abscissa, ordinate] = roles(*kind);
            self.format.columns.iter().all(|column| {
                let of = |role: Role| role.error() == Some(column.role);
                column.role == Role::Segment
                    || beside::needed(*kind).contains(&column.role)
                    || beside::optional(*kind).contains(&column.role)
                    || (column.role == Role::ContactArea && *kind == Kind::StiffnessRadius)
                    || of(abscissa)
                    || of(ordinate)
                    || column.role == abscissa
                    || column.role == ordinate
                    || (column.role == Role::Deflection && *kind == Kind::ForceHeight)
            })
        };
        let mut meant: Vec<Kind> = Kind::ALL.into_iter().filter(is_meant).collect();
        if meant.is_empty() {
            meant = Kind::ALL.to_vec();
        }
        // A contact stiffness is measured where there is one, and nothing else is complete.
        let others: Vec<Kind> = meant
            .iter()
            .copied()
            .filter(|one| !one.is_stiffness())
            .collect();
        let has_stiffness = !matches!(self.find(Role::ContactStiffness, None), Ok(None));
        let is_complete = |kind: &Kind| self.missing(*kind).is_empty();
        if !others.is_empty() && (!has_stiffness || others.iter().any(is_complete)) {
            meant = others;
        }
        let mut kinds: Vec<Missing> = meant
            .into_iter()
            .map(|kind| Missing {
                kind,
                roles: self.missing(kind),
            })
            .collect();
        let least = kinds.iter().map(|one| one.roles.len()).min().unwrap_or(0);
        kinds.retain(|one| one.roles.len() == least);
        match &kinds[..] {
            [one] if least == 0 => Ok(one.kind),
            _ if least == 0 => Err((
                None,
                Problem::SeveralKinds {
                    kinds: kinds.iter().map(|one| one.kind).collect(),
                    columns: self.found(),
                },
            )),
            _ => Err(self.lack(kinds)),
        }
    }

    /// Returns the quantities of a kind that no column is recognised as, in any direction.
    fn missing(&self, kind: Kind) -> Vec<Role> {
        let is_there = |role| {
            DIRECTIONS
                .into_iter()
                // Which of two columns it is, is asked later.
                .any(|direction| !matches!(self.find(role, direction), Ok(None)))
        };
        let is_missing = |role: &Role| {
            let by_deflection = *role == Role::Load
                && (kind == Kind::ForceHeight || self.format.kind.is_some())
                && is_there(Role::Deflection);
            let by_area = *role == Role::ContactRadius
                && kind == Kind::StiffnessRadius
                && is_there(Role::ContactArea);
            !is_there(*role) && !by_deflection && !by_area
        };
        let needed = beside::needed(kind).iter().copied();
        let roles = roles(kind).into_iter().chain(needed);
        roles.filter(is_missing).collect()
    }

    /// Returns the columns of abscissa and ordinate in a direction. A column without a direction
    /// serves both; one at least must have it.
    fn pair(&self, kind: Kind, direction: Option<Direction>) -> Result<Option<Pair>, Failure> {
        let [abscissa, ordinate] = roles(kind);
        let of = |role: Role| -> Result<Option<Source>, Failure> {
            Ok(match self.force_or(role, direction)? {
                None if direction.is_some() => self.force_or(role, None)?,
                found => found,
            })
        };
        let abscissa = match of(abscissa)? {
            None if kind == Kind::StiffnessRadius => of(Role::ContactArea)?,
            found => found,
        };
        let (Some(abscissa), Some(ordinate)) = (abscissa, of(ordinate)?) else {
            return Ok(None);
        };
        let Some(beside) = self.beside(kind, direction)? else {
            return Ok(None);
        };
        let errors = [
            self.deviation(&abscissa, false, direction)?,
            self.deviation(&ordinate, true, direction)?,
        ];
        Ok(Some(Pair {
            direction,
            abscissa,
            ordinate,
            errors,
            beside,
        }))
    }

    /// Returns the column of a role; a deflection where there is no load.
    fn force_or(
        &self,
        role: Role,
        direction: Option<Direction>,
    ) -> Result<Option<Source>, Failure> {
        Ok(match self.find(role, direction)? {
            None if role == Role::Load => self.find(Role::Deflection, direction)?,
            found => found,
        })
    }

    /// Returns the column that the user names, or the one that is recognised.
    pub(super) fn find(
        &self,
        role: Role,
        direction: Option<Direction>,
    ) -> Result<Option<Source>, Failure> {
        let unique = |indices: &[usize]| match indices {
            [] => Ok(None),
            [index] => Ok(Some(*index)),
            [first, second, ..] => Err((
                None,
                Problem::Duplicate {
                    role,
                    numbers: [first + 1, second + 1],
                },
            )),
        };
        let columns = self.format.columns.iter();
        let named: Vec<Named> = columns
            .filter(|column| column.role == role)
            .map(|column| self.named(column))
            .collect::<Result<_, _>>()?;
        if !named.is_empty() {
            let has = |one: &&Named| role == Role::Segment || one.direction == direction;
            let of: Vec<&Named> = named.iter().filter(has).collect();
            let indices: Vec<usize> = of.iter().map(|one| one.index).collect();
            return unique(&indices)?
                .map(|index| self.source(role, index, of[0].unit, of[0].negative))
                .transpose();
        }
        for name in names(role) {
            let matches =
                |heading: &Heading| heading.direction == direction && is_named(heading, role, name);
            if let Some(index) = unique(&self.positions(matches))? {
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
    pub(super) fn named(&self, column: &Column) -> Result<Named, Failure> {
        let wanted = Heading::parse(&column.heading);
        let index = match self.places(column, &wanted)[..] {
            [index] => index,
            [] => {
                let problem = Problem::UnknownHeading {
                    role: column.role,
                    wanted: column.heading.clone(),
                    columns: self.found(),
                };
                return Err((None, problem));
            }
            [first, second, ..] => {
                let problem = Problem::Duplicate {
                    role: column.role,
                    numbers: [first + 1, second + 1],
                };
                return Err((None, problem));
            }
        };
        let heading = &self.headings[index];
        Ok(Named {
            index,
            unit: wanted.unit.or(heading.unit),
            direction: wanted.direction.or(heading.direction),
            negative: column.negative,
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
    ) -> Result<Source, Failure> {
        let heading = self.headings[index].text.clone();
        let at = |problem| (Some(index), problem);
        let assumed_si = role != Role::Segment && unit.is_none();
        let unit = match unit {
            Some(unit) if role.accepts(unit) => unit,
            Some(_) => return Err((None, Problem::WrongUnit { role, heading })),
            None if role == Role::Segment || role.is_si(&heading) => Unit::si(role.dimension()),
            None => {
                let heading = if heading.is_empty() {
                    (index + 1).to_string()
                } else {
                    heading
                };
                return Err(at(Problem::NoUnit { role, heading }));
            }
        };
        let Cantilever {
            stiffness,
            sensitivity,
        } = self.format.cantilever;
        let mut factor = if negative { -unit.size } else { unit.size };
        if role == Role::Deflection {
            let volts = unit.dimension == Dimension::Voltage;
            let (Some(stiffness), Some(sensitivity)) =
                (stiffness, if volts { sensitivity } else { Some(1.0) })
            else {
                return Err(at(Problem::NoCantilever {
                    volts,
                    uncalibrated: self.uncalibrated,
                }));
            };
            let is_sound = stiffness > 0.0 && sensitivity != 0.0;
            factor *= stiffness * sensitivity;
            if !is_sound || !factor.is_finite() || factor == 0.0 {
                return Err(at(Problem::NoForce {
                    stiffness,
                    sensitivity: volts.then_some(sensitivity),
                }));
            }
        }
        Ok(Source {
            role,
            index,
            unit,
            factor,
            heading,
            assumed_si,
        })
    }

    /// Returns the error of columns that are not there.
    fn lack(&self, kinds: Vec<Missing>) -> Failure {
        let columns = self.found();
        (None, Problem::MissingColumns { kinds, columns })
    }

    /// Returns the columns, as far as their headings and the user tell.
    fn found(&self) -> Vec<Found> {
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
                heading: column.1.text.clone(),
                unit: column.1.unit,
                role: role(column),
            })
            .collect()
    }
}

/// A column that the user names.
pub(super) struct Named {
    pub index: usize,
    pub unit: Option<Unit>,
    direction: Option<Direction>,
    negative: bool,
}
