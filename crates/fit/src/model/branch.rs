//! The branches on which measured points lie.

/// What a measured point is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// The contact with the work of adhesion of approach.
    Advancing,
    /// The contact with the work of adhesion of retract.
    Receding,
    /// The contact of the radius at which the approach ended, whose line does not move: the
    /// beginning of a retract under adhesion hysteresis.
    Pinned,
    /// No contact: the baseline.
    Baseline,
    /// Nothing. The point is left out of the fit, because it is in a jump, because the data do not
    /// tell its branch, or because it is so close to the end of the branch that its force depends
    /// on the parameters in no linear way.
    LeftOut,
}

impl Branch {
    /// Returns the name, as in CSV.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Advancing => "advancing",
            Self::Receding => "receding",
            Self::Pinned => "pinned",
            Self::Baseline => "baseline",
            Self::LeftOut => "left-out",
        }
    }
}
