//! The energy release rate at which the contact line is at rest.

/// The energy release rate `G(a) = w (1 + l/(6 a))` at which a contact line of radius `a` is at
/// rest.
///
/// Eq. 8 is `l = 0`. A short zone of attraction of the length `l` raises `G` by a term per length
/// of line; `finite_range` derives it.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineEnergy {
    work_of_adhesion: f64,
    zone: f64,
}

impl LineEnergy {
    /// The energy of eq. 8, the work of adhesion `w` (J/m^2).
    pub(super) const fn of_jkr(work_of_adhesion: f64) -> Self {
        Self::with_zone(work_of_adhesion, 0.0)
    }

    /// The energy with the work of adhesion `w` (J/m^2) and a zone of the length `l` (m).
    pub(super) const fn with_zone(work_of_adhesion: f64, zone: f64) -> Self {
        Self {
            work_of_adhesion,
            zone,
        }
    }

    /// Returns the work of adhesion `w`, J/m^2.
    pub(super) const fn work_of_adhesion(self) -> f64 {
        self.work_of_adhesion
    }

    /// Returns `G(a)`, J/m^2.
    pub(super) fn at(self, a: f64) -> f64 {
        self.work_of_adhesion * (1.0 + self.zone / (6.0 * a))
    }

    /// Returns `d ln G/d ln a`.
    pub(super) fn slope(self, a: f64) -> f64 {
        -self.zone / (6.0 * a + self.zone)
    }
}
