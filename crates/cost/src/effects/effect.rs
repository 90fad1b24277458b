//! The effects.

use contact::named;
use serde::{Deserialize, Serialize};

named! {
    /// A part of the model that a scene can leave out.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Effect {
        /// The film. Without it the sphere touches the bare substrate: this is JKR, which needs no
        /// table.
        Film = "film",
        /// The sphere's compliance. Without it `e1_over_e2 = 0`, and all moduli are in units of the
        /// film's.
        SphereCompliance = "sphere compliance",
        /// The substrate's compliance. Without it `e0_over_e2 = inf`.
        SubstrateCompliance = "substrate compliance",
        /// The film's compressibility. Without it `nu1 = 0.5`, with the Young's modulus unchanged.
        FilmCompressibility = "film compressibility",
        /// Adhesion. Without it `w = 0`, and the table holds neither `eeq` nor `gamma`.
        Adhesion = "adhesion",
        /// The penetration. Without it the table does not hold `delta0`; the load does not change.
        Penetration = "penetration",
        /// The shape of the sphere itself. Without it the sphere is a paraboloid. It needs no other
        /// table.
        Shape = "shape",
        /// The range of the attraction. Without it the contact is JKR's. It needs no other table.
        FiniteRange = "finite range",
        /// The interface between film and substrate: the film slides. Without it the film is bonded. It
        /// needs no table.
        Interface = "interface",
        /// Full friction. Without it the surfaces slide freely, as in the table. It is solved directly.
        Friction = "friction",
        /// Relaxation: a modulus that falls in time. Without it the load follows the elastic curve. It
        /// needs no other table.
        Relaxation = "relaxation",
    }
}

impl Effect {
    /// Returns the assumption that replaces the effect.
    pub const fn instead(self) -> &'static str {
        match self {
            Self::Film => "JKR on the bare substrate",
            Self::SphereCompliance => "e1_over_e2 = 0",
            Self::SubstrateCompliance => "e0_over_e2 = inf",
            Self::FilmCompressibility => "nu1 = 0.5",
            Self::Adhesion => "w = 0",
            Self::Penetration => "no delta0",
            Self::Shape => "paraboloid for the sphere, a = 0.3 R",
            Self::FiniteRange => "JKR at a Tabor parameter of 5",
            Self::Interface => "bonded film where it slides",
            Self::Friction => "no friction, in place of full friction",
            Self::Relaxation => "elastic, where the modulus falls as t^-0.2",
        }
    }

    /// Whether a contact with the effect takes the same table. The effect costs time at each lookup
    /// instead.
    pub const fn needs_no_table(self) -> bool {
        matches!(
            self,
            Self::Shape | Self::FiniteRange | Self::Interface | Self::Friction | Self::Relaxation
        )
    }
}
