//! The columns beside abscissa and ordinate: the time; and those that a contact stiffness has, the load
//! at a depth, and the phase or the loss part of the stiffness.

use super::column::Role;
use super::failure::DataError;
use super::source::{Columns, Source};
use crate::{Direction, Kind};

/// What stands beside a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Beside {
    /// The load, N; NaN without a column.
    pub load: f64,
    /// The phase of the stiffness, rad; NaN without a column.
    pub phase: f64,
    /// The time, s; NaN without a column, and where the cell holds no number.
    pub time: f64,
}

/// Lists the roles that a kind needs beside its abscissa and its ordinate.
pub(super) const fn needed(kind: Kind) -> &'static [Role] {
    match kind {
        Kind::StiffnessDepth => &[Role::Load],
        _ => &[],
    }
}

/// Lists the roles that a kind can have beside those that it needs.
pub(super) const fn optional(kind: Kind) -> &'static [Role] {
    if kind.is_stiffness() {
        &[Role::PhaseShift, Role::LossStiffness]
    } else {
        &[Role::Time]
    }
}

impl Columns<'_> {
    /// Returns the columns beside those of a pair in a direction; `None` where a needed one is
    /// missing.
    pub(super) fn beside(
        &self,
        kind: Kind,
        direction: Option<Direction>,
    ) -> Result<Option<Vec<Source>>, DataError> {
        let find = |role: Role| match self.find(role, direction)? {
            None if direction.is_some() => self.find(role, None),
            found => Ok(found),
        };
        let mut found = Vec::new();
        for &role in needed(kind) {
            let Some(source) = find(role)? else {
                return Ok(None);
            };
            found.push(source);
        }
        for &role in optional(kind) {
            // Of phase and loss stiffness, which tell one quantity, the first.
            if found.len() == needed(kind).len() {
                let is_named = self.format.columns.iter().any(|one| one.role == role);
                found.extend(match find(role) {
                    // Points need no time: what is doubtful is not read.
                    Err(_) if role == Role::Time && !is_named => None,
                    other => other?,
                });
            }
        }
        Ok(Some(found))
    }
}

/// Returns what stands beside a point of a storage stiffness (N/m), from the values of the columns;
/// `None` where a value is missing.
pub(super) fn beside(
    sources: &[Source],
    storage: f64,
    mut value: impl FnMut(&Source) -> Result<Option<f64>, DataError>,
) -> Result<Option<Beside>, DataError> {
    let mut found = Beside {
        load: f64::NAN,
        phase: f64::NAN,
        time: f64::NAN,
    };
    for source in sources {
        if source.role == Role::Time {
            found.time = value(source).ok().flatten().unwrap_or(f64::NAN);
            continue;
        }
        let Some(value) = value(source)? else {
            return Ok(None);
        };
        match source.role {
            Role::PhaseShift => found.phase = value,
            Role::LossStiffness => found.phase = value.atan2(storage),
            _ => found.load = value,
        }
    }
    Ok(Some(found))
}
