//! The energy release rate at which the contact line is at rest.

/// The energy release rate `G(a) = w (1 + l/(6 a))` at which a contact line of radius `a` is at
/// rest.
///
/// Eq. 8 is `l = 0`. A short cohesive zone of the length `l` raises `G` by a term per length
/// of line; `cohesive_zone` derives it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineEnergy {
    /// The work of adhesion `w`, J/m^2.
    pub work_of_adhesion: f64,
    /// The length `l` of the zone, m.
    pub zone: f64,
}

impl LineEnergy {
    /// The energy of eq. 8, the work of adhesion `w` (J/m^2).
    pub(crate) const fn of_jkr(work_of_adhesion: f64) -> Self {
        Self {
            work_of_adhesion,
            zone: 0.0,
        }
    }

    /// Returns `G(a)`, J/m^2.
    pub(crate) fn at(self, a: f64) -> f64 {
        self.work_of_adhesion * (1.0 + self.zone / (6.0 * a))
    }

    /// Returns `d ln sqrt(a G)/d ln a = 3a/(6a + l)`, without the cancellation of
    /// `(1 + d ln G/d ln a)/2`: at radii far below the zone its sign is that of the slope of the
    /// penetration.
    pub(crate) fn slope_of_edge(self, a: f64) -> f64 {
        3.0 * a / (6.0 * a + self.zone)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_has_all_digits_at_every_radius() {
        assert_eq!(LineEnergy::of_jkr(0.04).slope_of_edge(1e-60), 0.5);
        let with_zone = LineEnergy {
            work_of_adhesion: 0.04,
            zone: 1e-9,
        };
        let slope = with_zone.slope_of_edge(1e-60);
        assert!((slope / 3e-51 - 1.0).abs() < 1e-15, "{slope:e}");
    }
}
