//! What a table says of itself.

use serde::{Deserialize, Serialize};

use crate::material::poisson_ratio;
use crate::table::axes::Axes;
use crate::{Certificate, Error, Normalisation, Parameter};

/// What a table says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The scene's title.
    pub title: String,
    /// The scene, as TOML.
    pub scene: String,
    /// The substrate's Poisson ratio, the same in the whole table.
    pub nu0: f64,
    /// The modulus in whose units the values are.
    pub normalisation: Normalisation,
    /// The relative tolerance that the table is to keep: what its scene asks for, or what it was
    /// truncated to.
    pub tolerance: f64,
    /// Program and version.
    pub created_by: String,
    /// The measured accuracy.
    pub certificate: Certificate,
}

impl Description {
    /// Accepts a description of a table with these axes.
    ///
    /// # Errors
    /// [`Error::Malformed`] for another normalisation than the axes have, or a `nu0` or tolerance
    /// that no table has.
    pub(crate) fn check(&self, axes: &Axes) -> Result<(), Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        let [softest_film, _] = axes.ends(Parameter::E1OverE2);
        if (softest_film == 0.0) != (self.normalisation == Normalisation::Film) {
            return malformed(format!(
                "normalised by {} with e1_over_e2 from {softest_film}",
                self.normalisation.symbol()
            ));
        }
        if let Err(error) = poisson_ratio("nu0", self.nu0) {
            return malformed(error.to_string());
        }
        let tolerance = self.tolerance;
        if !(tolerance > 0.0 && tolerance <= 1.0) {
            return malformed(format!(
                "its tolerance is {tolerance:?}, not above 0 and at most 1"
            ));
        }
        Ok(())
    }
}
