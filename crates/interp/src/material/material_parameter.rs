//! The parameters of a material with respect to which its curve has derivatives.

/// A parameter of a [`Material`](crate::Material).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaterialParameter {
    /// `E1/E2*`.
    E1OverE2,
    /// Poisson ratio of the film.
    Nu1,
    /// `E0/E2*`.
    E0OverE2,
    /// Poisson ratio of the substrate.
    Nu0,
}

impl MaterialParameter {
    /// All parameters.
    pub const ALL: [Self; 4] = [Self::E1OverE2, Self::Nu1, Self::E0OverE2, Self::Nu0];

    /// Returns the name used in the API, on the command line and in CSV.
    pub const fn name(self) -> &'static str {
        ["e1_over_e2", "nu1", "e0_over_e2", "nu0"][self as usize]
    }
}
