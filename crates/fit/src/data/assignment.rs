//! Which column of a file holds what.

use super::column::{Column, Role};
use super::failure::{DataError, Found, Missing, list};
use super::heading::{Heading, Reduced};
use super::remedy::{Named, Remedy, any};
use super::source::{Columns, Source};
use super::{Format, beside};
use crate::{Direction, Kind};

/// The two columns of the points of one direction, or of all points.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The direction that the headings name.
    pub direction: Option<Direction>,
    pub abscissa: Source,
    pub ordinate: Source,
    /// The standard deviations of both, where there are columns of them.
    pub errors: [Option<Source>; 2],
    /// The columns beside them: of a contact stiffness.
    pub beside: Vec<Source>,
}

impl Pair {
    /// Returns the columns of abscissa and ordinate.
    pub const fn sources(&self) -> [&Source; 2] {
        [&self.abscissa, &self.ordinate]
    }
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

/// Assigns the columns with these headings. `untold` says why a line of the head that names a value of
/// the cantilever tells none.
pub fn assign(
    headings: &[Heading],
    format: &Format,
    untold: Option<&str>,
) -> Result<Assignment, DataError> {
    let columns = Columns {
        headings,
        format,
        untold,
    };
    // A heading that is not there is an error, also where the kind needs no such column.
    for column in &format.columns {
        columns.named(column)?;
    }
    let kind = columns.kind()?;
    let mut pairs = Vec::new();
    for direction in Direction::OF_POINTS {
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

impl Columns<'_> {
    /// Returns the kind that the user gives, or the only one that the headings fit.
    fn kind(&self) -> Result<Kind, DataError> {
        if let Some(kind) = self.format.kind {
            return Ok(kind);
        }
        // A kind without use for a column that the user names is not meant.
        let is_meant = |kind: &Kind| {
            let own = roles(*kind);
            let mut used = [&own[..], beside::needed(*kind), beside::optional(*kind)].concat();
            used.push(Role::Segment);
            used.extend(own.into_iter().filter_map(Role::error));
            used.extend(kind.at_radii().then_some(Role::ContactArea));
            if *kind == Kind::ForceHeight {
                used.extend([Role::Deflection, Role::Separation]);
            }
            let mut columns = self.format.columns.iter();
            columns.all(|column| used.contains(&column.role))
        };
        let mut meant: Vec<Kind> = Kind::ALL.into_iter().filter(is_meant).collect();
        if meant.is_empty() {
            meant = Kind::ALL.to_vec();
        }
        // Without a contact stiffness the kinds of one are not meant, if there are others.
        let is_other = |kind: &Kind| !kind.is_stiffness();
        let has_stiffness = !matches!(self.find(Role::ContactStiffness, None), Ok(None));
        if !has_stiffness && meant.iter().any(is_other) {
            meant.retain(is_other);
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
        // Beside other quantities a separation is one more column.
        let of_separation =
            |one: &Missing| one.kind == Kind::ForceHeight && one.roles == [Role::Height];
        if kinds.iter().any(of_separation) && self.is_there(Role::Separation) {
            return Ok(Kind::ForceHeight);
        }
        match &kinds[..] {
            [one] if least == 0 => Ok(one.kind),
            _ if least == 0 => {
                let kinds: Vec<Kind> = kinds.iter().map(|one| one.kind).collect();
                let several = DataError::new(format!(
                    "the columns can be read as more than one kind of measurement, {}; the columns are {}",
                    list(
                        &kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>(),
                        ", "
                    ),
                    list(&self.found(), ", ")
                ));
                Err(several.with(Remedy::Kind(kinds)))
            }
            _ => Err(self.lack(kinds)),
        }
    }

    /// Returns the quantities of a kind that no column is recognised as, in any direction.
    fn missing(&self, kind: Kind) -> Vec<Role> {
        let is_missing = |role: &Role| {
            let by_deflection = *role == Role::Load
                && (kind == Kind::ForceHeight || self.format.kind.is_some())
                && self.is_there(Role::Deflection);
            let by_separation = *role == Role::Height
                && self.format.kind.is_some()
                && self.is_there(Role::Separation);
            let by_area = *role == Role::ContactRadius
                && self.takes_area(kind)
                && self.is_there(Role::ContactArea);
            !self.is_there(*role) && !by_deflection && !by_separation && !by_area
        };
        let needed = beside::needed(kind).iter().copied();
        let roles = roles(kind).into_iter().chain(needed);
        roles.filter(is_missing).collect()
    }

    /// Tells whether there is a column of a role, in any direction. Which of two columns it is, is asked later.
    fn is_there(&self, role: Role) -> bool {
        let mut directions = Direction::OF_POINTS.into_iter();
        directions.any(|direction| !matches!(self.find(role, direction), Ok(None)))
    }

    /// Tells whether a contact area gives the radius. Beside a load or a penetration it may be computed
    /// from them: there the user says so.
    fn takes_area(&self, kind: Kind) -> bool {
        let is_area = |column: &Column| column.role == Role::ContactArea;
        kind == Kind::StiffnessRadius
            || kind.at_radii()
                && (self.format.kind.is_some() || self.format.columns.iter().any(is_area))
    }

    /// Returns the columns of abscissa and ordinate in a direction. A column without a direction
    /// serves both; one at least must have it.
    fn pair(&self, kind: Kind, direction: Option<Direction>) -> Result<Option<Pair>, DataError> {
        let [abscissa, ordinate] = roles(kind);
        let alone = |role: Role, direction| match self.find(role, direction)? {
            // A deflection where there is no load, and a separation where there is no height.
            None if role == Role::Load => self.find(Role::Deflection, direction),
            None if role == Role::Height => self.find(Role::Separation, direction),
            found => Ok::<_, DataError>(found),
        };
        let of = |role: Role| match alone(role, direction)? {
            None if direction.is_some() => alone(role, None),
            found => Ok::<_, DataError>(found),
        };
        let abscissa = match of(abscissa)? {
            None if self.takes_area(kind) => of(Role::ContactArea)?,
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

    /// Returns the error of columns that are not there.
    fn lack(&self, kinds: Vec<Missing>) -> DataError {
        let columns = self.found();
        let to_convert = columns.iter().any(Found::is_to_convert);
        let lacking = match &kinds[..] {
            [one] => one.to_string(),
            kinds => format!(
                "the headings fit no kind of measurement: {}",
                list(kinds, "; ")
            ),
        };
        let convert = if to_convert {
            "; convert the numbers of a column that is a diameter, a square or a multiple, or in an \
             unknown unit, and name the quantity and its unit in the heading"
        } else {
            ""
        };
        let error = DataError::new(format!(
            "{lacking}; the columns are {}{convert}",
            list(&columns, ", ")
        ));
        let candidates = |one: &Missing| one.candidates(&columns);
        // What is missing may be among the columns that are to be converted.
        if to_convert && kinds.iter().all(|one| candidates(one).contains(&None)) {
            return error;
        }
        // The kinds for which most columns can be told.
        let told = |one: &Missing| candidates(one).iter().flatten().count();
        let most = kinds.iter().map(told).max();
        let likely = kinds.iter().filter(|one| Some(told(one)) == most);
        let way = |one: &Missing| {
            let candidates = candidates(one).into_iter();
            let heading = |(role, found): (&Role, Option<&Found>)| match found {
                Some(found) if found.heading.reduced() == Some(Reduced::Separation) => {
                    (Role::Separation, found.heading.text.clone())
                }
                Some(found) => (found.role.unwrap_or(*role), found.heading.text.clone()),
                None => (*role, any()),
            };
            let mut found = candidates.clone().flatten();
            Named {
                kind: (kinds.len() > 1).then_some(one.kind),
                columns: one.roles.iter().zip(candidates).map(heading).collect(),
                reduced: found.find_map(|found| found.heading.reduced()),
            }
        };
        error.with(Remedy::Columns(likely.map(way).collect()))
    }
}
