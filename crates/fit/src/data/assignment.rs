//! Which column of a file holds what.

use super::column::{Column, Role};
use super::failure::Problem;
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

/// Assigns the columns with these headings.
pub fn assign(headings: &[Heading], format: &Format) -> Result<Assignment, Failure> {
    let columns = Columns { headings, format };
    let kind = columns.kind()?;
    let roles = roles(kind);
    let mut pairs = Vec::new();
    if let Some(pair) = columns.pair(roles, None)? {
        pairs.push(pair);
    } else {
        for direction in [Direction::Approach, Direction::Retract] {
            pairs.extend(columns.pair(roles, Some(direction))?);
        }
    }
    if pairs.is_empty() {
        return Err(columns.missing(roles));
    }
    // A direction without deviations beside one that has them.
    for (k, of) in roles.into_iter().enumerate() {
        let mut has = pairs.iter().map(|pair| pair.errors[k].is_some());
        if has.clone().any(|has| has) && !has.all(|has| has) {
            let role = of.error().unwrap_or(of);
            return Err((None, columns.absent(role, None)));
        }
    }
    let segment = columns.find(Role::Segment, None)?;
    Ok(Assignment {
        kind,
        pairs,
        segment: segment.map(|source| source.index),
    })
}

/// Returns what the two columns of a kind hold: the abscissa and the ordinate.
pub const fn roles(kind: Kind) -> [Role; 2] {
    match kind {
        Kind::LoadRadius => [Role::ContactRadius, Role::Load],
        Kind::PenetrationRadius => [Role::ContactRadius, Role::Penetration],
        Kind::LoadPenetration => [Role::Penetration, Role::Load],
        Kind::ForceHeight => [Role::Height, Role::Load],
    }
}

/// Tells whether a name of a load means a deflection unless its unit says otherwise.
pub(super) fn is_deflection(role: Role, name: &str) -> bool {
    role == Role::Load && Role::Deflection.headings().contains(&name)
}

/// The headings, and what the user says about them.
pub(super) struct Columns<'a> {
    pub headings: &'a [Heading],
    pub format: &'a Format,
}

impl Columns<'_> {
    /// Returns the kind that the user gives, or the only one that the headings fit.
    fn kind(&self) -> Result<Kind, Failure> {
        if let Some(kind) = self.format.kind {
            return Ok(kind);
        }
        let directions = [None, Some(Direction::Approach), Some(Direction::Retract)];
        let has = |role| {
            directions
                .iter()
                // Which of two columns it is, is asked later.
                .any(|&direction| !matches!(self.find(role, direction), Ok(None)))
        };
        let fits = |kind: &Kind| {
            let [abscissa, ordinate] = roles(*kind);
            let named = |column: &Column| {
                let of = |role: Role| role.error() == Some(column.role);
                column.role == Role::Segment
                    || of(abscissa)
                    || of(ordinate)
                    || column.role == abscissa
                    || column.role == ordinate
                    || (column.role == Role::Deflection && *kind == Kind::ForceHeight)
            };
            has(abscissa)
                && (has(ordinate) || (*kind == Kind::ForceHeight && has(Role::Deflection)))
                && self.format.columns.iter().all(named)
        };
        let fitting: Vec<Kind> = Kind::ALL.into_iter().filter(fits).collect();
        match fitting[..] {
            [kind] => Ok(kind),
            _ => Err((
                None,
                Problem::UnknownKind {
                    fitting,
                    headings: self.texts(),
                },
            )),
        }
    }

    /// Returns the columns of abscissa and ordinate in a direction. A column without a direction
    /// serves both; one at least must have it.
    fn pair(
        &self,
        [abscissa, ordinate]: [Role; 2],
        direction: Option<Direction>,
    ) -> Result<Option<Pair>, Failure> {
        let of = |role: Role| -> Result<Option<Source>, Failure> {
            Ok(match self.force_or(role, direction)? {
                None if direction.is_some() => self.force_or(role, None)?,
                found => found,
            })
        };
        let (Some(abscissa), Some(ordinate)) = (of(abscissa)?, of(ordinate)?) else {
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
    fn find(&self, role: Role, direction: Option<Direction>) -> Result<Option<Source>, Failure> {
        let named = self
            .format
            .columns
            .iter()
            .filter(|column| column.role == role);
        let mut any = false;
        for column in named {
            any = true;
            let (index, unit) = self.named(column)?;
            if self.headings[index].direction == direction || role == Role::Segment {
                return self.source(role, index, unit, column.negative).map(Some);
            }
        }
        if any {
            return Ok(None);
        }
        for name in role.headings() {
            let matches = |heading: &Heading| {
                heading.name == *name
                    && heading.direction == direction
                    && heading
                        .unit
                        .map_or(!is_deflection(role, name), |unit| role.accepts(unit))
            };
            let mut indices = self.positions(matches);
            let Some(first) = indices.next() else {
                continue;
            };
            if let Some(second) = indices.next() {
                let problem = Problem::Duplicate {
                    role: role.name(),
                    numbers: [first + 1, second + 1],
                };
                return Err((None, problem));
            }
            return self
                .source(role, first, self.headings[first].unit, false)
                .map(Some);
        }
        Ok(None)
    }

    pub(super) fn positions(
        &self,
        matches: impl Fn(&Heading) -> bool,
    ) -> impl Iterator<Item = usize> {
        self.headings
            .iter()
            .enumerate()
            .filter(move |(_, heading)| matches(heading))
            .map(|(index, _)| index)
    }

    /// Returns the column that the user names, and its unit.
    pub(super) fn named(&self, column: &Column) -> Result<(usize, Option<Unit>), Failure> {
        let wanted = Heading::parse(&column.heading);
        let exact = |heading: &Heading| heading.text == column.heading;
        let alike = |heading: &Heading| {
            heading.name == wanted.name
                && heading.direction == wanted.direction
                && (heading.unit.is_none() || wanted.unit.is_none() || heading.unit == wanted.unit)
        };
        let unique = |found: Vec<usize>| match found[..] {
            [] => Ok(None),
            [index] => Ok(Some(index)),
            [first, second, ..] => Err((
                None,
                Problem::Duplicate {
                    role: column.role.name(),
                    numbers: [first + 1, second + 1],
                },
            )),
        };
        let by_name = match unique(self.positions(exact).collect())? {
            None => unique(self.positions(alike).collect())?,
            found => found,
        };
        let number = || {
            let number: usize = wanted.name.parse().ok()?;
            (1..=self.headings.len())
                .contains(&number)
                .then(|| number - 1)
        };
        let Some(index) = by_name.or_else(number) else {
            let problem = Problem::UnknownHeading {
                role: column.role.name(),
                wanted: column.heading.clone(),
                headings: self.texts(),
            };
            return Err((None, problem));
        };
        Ok((index, wanted.unit.or(self.headings[index].unit)))
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
            Some(_) => {
                return Err((None, self.absent(role, Some(heading))));
            }
            None if role == Role::Segment || role.is_si(&heading) => Unit::si(role.dimension()),
            None => {
                let problem = Problem::NoUnit {
                    role: role.name(),
                    heading: if heading.is_empty() {
                        (index + 1).to_string()
                    } else {
                        heading
                    },
                    example: role.example(),
                };
                return Err(at(problem));
            }
        };
        let Cantilever {
            stiffness,
            sensitivity,
        } = self.format.cantilever;
        let mut factor = if negative { -unit.size } else { unit.size };
        if role == Role::Deflection {
            let missing = |what| at(Problem::NoCantilever(what));
            factor *= stiffness.ok_or_else(|| missing("the stiffness: --stiffness N/m"))?;
            if unit.dimension == Dimension::Voltage {
                factor *= sensitivity
                    .ok_or_else(|| missing("the sensitivity, too: --sensitivity m/V"))?;
            }
        }
        Ok(Source {
            role,
            index,
            factor,
            heading,
            assumed_si,
        })
    }

    /// Returns the error of columns that are not there.
    fn missing(&self, roles: [Role; 2]) -> Failure {
        let role = roles
            .into_iter()
            .find(|&role| matches!(self.force_or(role, None), Ok(None)))
            .unwrap_or(roles[0]);
        let is_wrong = |heading: &&Heading| {
            role.headings().contains(&heading.name.as_str())
                && heading.unit.is_some_and(|unit| !role.accepts(unit))
        };
        let wrong = self.headings.iter().find(is_wrong);
        (
            None,
            self.absent(role, wrong.map(|heading| heading.text.clone())),
        )
    }

    /// Returns the problem of a column that is not there, or in a wrong unit.
    fn absent(&self, role: Role, wrong: Option<String>) -> Problem {
        Problem::MissingColumn {
            role: role.name(),
            dimension: role.dimension(),
            wrong,
            headings: self.texts(),
        }
    }

    fn texts(&self) -> Vec<String> {
        self.headings
            .iter()
            .map(|heading| heading.text.clone())
            .collect()
    }
}
