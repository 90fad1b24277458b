//! The branches on which measured points lie.

named! {
    /// What a measured point is compared with.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Branch {
        /// The contact with the work of adhesion of approach.
        Advancing = "advancing",
        /// The contact with the work of adhesion of retract.
        Receding = "receding",
        /// The contact of the radius at which the approach ended, whose line does not move: the
        /// beginning of a retract under adhesion hysteresis.
        Pinned = "pinned",
        /// No contact: the baseline.
        Baseline = "baseline",
        /// Nothing. The point is left out of the fit, because it is in a jump, because the data do not
        /// tell its branch, or because it is so close to the end of the branch that its force depends
        /// on the parameters in no linear way.
        LeftOut = "left-out",
    }
}

impl Branch {
    /// The branches of contacts.
    pub(crate) const CONTACTS: [Self; 2] = [Self::Advancing, Self::Receding];

    /// Tells whether the point is in contact.
    pub(crate) fn is_contact(self) -> bool {
        Self::CONTACTS.contains(&self)
    }

    /// Returns the branch whose contact a point has: a pinned point is a receding one whose line does not move.
    pub(crate) const fn of_contact(self) -> Self {
        match self {
            Self::Pinned => Self::Receding,
            own => own,
        }
    }
}
