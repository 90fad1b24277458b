//! The description of a table: its origin, its units and its accuracy.

use serde::{Deserialize, Serialize};

use crate::material::poisson_ratio;
use crate::table::axes::Axes;
use crate::{Certificate, Error, Normalisation, Parameter};

/// The description of a table: its origin, its units and its accuracy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The scene's title.
    pub title: String,
    /// The scene, as TOML.
    pub scene: String,
    /// The Poisson ratio of the substrate, one for the whole table.
    pub nu0: f64,
    /// The modulus in whose units the values are.
    pub normalisation: Normalisation,
    /// The relative tolerance of the table: that of its scene, or that of its truncation when
    /// packed.
    pub tolerance: f64,
    /// The program that made the table, with its version.
    pub created_by: String,
    /// The largest error at sampled points.
    pub certificate: Certificate,
}

impl Description {
    /// Accepts the description of a table with these axes.
    ///
    /// # Errors
    /// [`Error::Malformed`] for a normalisation that contradicts `axes`, a `nu0` outside
    /// `(-1, 0.5]` or a tolerance outside `(0, 1]`.
    pub(crate) fn check(&self, axes: &Axes) -> Result<(), Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        let [softest_film, _] = axes.ends(Parameter::E1OverE2);
        if (softest_film == 0.0) != (self.normalisation == Normalisation::Film) {
            return malformed(format!(
                "it is normalised by {} with e1_over_e2 from {softest_film:?}: E1* belongs to 0 \
                 (rigid sphere), E2* to all others",
                self.normalisation.symbol()
            ));
        }
        if let Err(error) = poisson_ratio("nu0", self.nu0) {
            return malformed(error.to_string());
        }
        let tolerance = self.tolerance;
        if !(tolerance > 0.0 && tolerance <= 1.0) {
            return malformed(format!(
                "its tolerance is {tolerance:?}, it must be above 0 and at most 1"
            ));
        }
        Ok(())
    }
}
