//! The description of a table: its origin, its units and its accuracy.

use serde::{Deserialize, Serialize};

use crate::material::poisson_ratio;
use crate::{Certificate, Error, SubstratePoissonRatio};

/// The description of a table: its origin, its units and its accuracy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The scene's title.
    pub title: String,
    /// The scene, as TOML.
    pub scene: String,
    /// The Poisson ratio of the substrate: one number, or the pair of the film's.
    pub nu0: SubstratePoissonRatio,
    /// The relative tolerance of the table: that of its scene, or that of its truncation when
    /// packed.
    pub tolerance: f64,
    /// The program that made the table, with its version.
    pub created_by: String,
    /// The largest error at sampled points.
    pub certificate: Certificate,
}

impl Description {
    /// Accepts the description of a table.
    ///
    /// # Errors
    /// [`Error::Malformed`] for a `nu0` outside `(-1, 0.5]`, a tolerance outside `(0, 1]`, or a
    /// certificate with errors that are not finite numbers in order.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        if let SubstratePoissonRatio::Fixed(nu0) = self.nu0
            && let Err(error) = poisson_ratio("nu0", nu0)
        {
            return malformed(error.to_string());
        }
        let tolerance = self.tolerance;
        if !(tolerance > 0.0 && tolerance <= 1.0) {
            return malformed(format!(
                "its tolerance is {tolerance:?}, it must be above 0 and at most 1"
            ));
        }
        self.certificate.check()
    }
}
