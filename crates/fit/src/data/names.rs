//! The headings that are recognised, as programs of instruments write them.

use super::column::Role;

impl Role {
    /// Returns the headings that are recognised, in lower case without unit and direction, the
    /// preferred one first.
    pub(super) const fn headings(self) -> &'static [&'static str] {
        match self {
            Self::ContactRadius => &["contact radius", "radius of contact", "radius", "a"],
            Self::Load => &[
                "load",
                "force",
                // Nanoindenters of MTS, Agilent, Keysight and KLA. Their raw load still has the
                // spring of the indenter in it.
                "load on sample",
                // Hysitron.
                "indent act load",
                "force on sample",
                "force on surface",
                "load on surface",
                "normal load",
                "normal force",
                "applied load",
                "applied force",
                "f",
                // Anton Paar.
                "fn",
            ],
            Self::Penetration => &[
                "penetration",
                "penetration depth",
                "indentation",
                "indentation depth",
                "displacement into surface",
                "indent disp",
                "displacement into sample",
                "depth into surface",
                "displacement",
                "depth",
                // Anton Paar.
                "pd",
                "delta",
                "\u{3b4}",
            ],
            Self::Height => &[
                "height measured",
                "measured height",
                "measuredheight",
                "height sensor",
                // JPK.
                "capacitive sensor height",
                "capacitivesensorheight",
                "straingaugeheight",
                "head height measured",
                "height measured smoothed",
                "head height measured smoothed",
                "smoothedmeasuredheight",
                "smoothedcapacitivesensorheight",
                "smoothedstraingaugeheight",
                "z sensor",
                "zsensor",
                "z sense",
                "zsnsr",
                // Nanosurf.
                "z axis sensor",
                // Park.
                "z detector",
                "height",
                "z height",
                "height piezo",
                "piezo height",
                "piezo position",
                "piezo",
                "z piezo",
                "z scan",
                // Bruker.
                "calc ramp",
                "z",
            ],
            Self::Deflection => &[
                "deflection",
                "defl",
                // Asylum Research.
                "deflv",
                "calc defl",
                "deflection error",
                "cantilever deflection",
                "vertical deflection",
                "vdeflection",
                // The difference of the photodiode's halves, top less bottom, of AFM Workshop.
                "t b",
                // Optics11.
                "cantilever",
            ],
            Self::Separation => &[
                "separation",
                // Bruker.
                "tip sample separation",
                "tip separation",
                // Asylum Research.
                "sep",
            ],
            Self::Segment => &["segment", "segment type", "phase", "direction"],
            Self::ContactStiffness => &[
                "contact stiffness",
                // MTS, Agilent, Keysight and KLA.
                "harmonic contact stiffness",
                "harmonic stiffness",
                // Hysitron.
                "storage stiff",
                "storage stiffness",
                "dynamic stiffness",
                "stiffness",
                "s dp dh",
            ],
            Self::ContactArea => &["contact area", "area of contact", "projected contact area"],
            Self::PhaseShift => &["phase shift", "phase angle", "harmonic phase angle"],
            Self::Time => &[
                "time",
                // JPK. Its segment time begins anew in each segment.
                "series time",
                "seriestime",
                "time on sample",
                "test time",
                "elapsed time",
                "t",
            ],
            Self::LossStiffness => &["loss stiff", "loss stiffness"],
            // Recognised by the name of their quantity: see `deviation`.
            Self::ContactRadiusError
            | Self::LoadError
            | Self::PenetrationError
            | Self::HeightError
            | Self::ContactStiffnessError => &[],
        }
    }

    /// Tells whether the numbers under a heading grow towards the sample, where a height grows away
    /// from it. `others` tells whether there is a heading with another name.
    pub(super) fn is_inverted(self, name: &str, others: impl Fn(&str) -> bool) -> bool {
        self == Self::Height
            && match name {
                // AFM Workshop and Asylum Research.
                "z sense" | "zsnsr" => true,
                // Optics11 writes both.
                "piezo" => others("cantilever"),
                _ => false,
            }
    }
}
