//! Interfaces: what joins the lower face of a layer to what lies below it.

/// What joins a layer to the layer below it, or to the base.
///
/// | interface | stresses | displacement of the layer minus that of the body below |
/// |---|---|---|
/// | [`Bonded`](Interface::Bonded) | continuous | 0 |
/// | [`Sliding`](Interface::Sliding) | no shear stress, continuous normal stress | any sideways, 0 normal to the interface |
/// | [`Springs`](Interface::Springs) | continuous | shear stress over `tangential` sideways, normal stress over `normal` |
///
/// Stiffnesses are per area, in Pa/m. A layer of glue of the thickness `d` and the shear modulus
/// `G`, much thinner than the layers that it joins, is the springs `tangential = G/d` and `normal =
/// 2 G (1 - nu)/((1 - 2 nu) d)`; the latter is infinity for an incompressible glue.
///
/// A sliding interface carries tension: a lubricated, a wetted or a van der Waals interface. A dry
/// film that lifts off what lies below it is another contact, which is not solved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Interface {
    /// No displacement across the interface.
    #[default]
    Bonded,
    /// No friction, and no gap.
    Sliding,
    /// Springs.
    Springs {
        /// The stiffness sideways, Pa/m: from 0 to infinity.
        tangential: f64,
        /// The stiffness normal to the interface, Pa/m: above 0, infinity allowed.
        normal: f64,
    },
}

impl Interface {
    /// Returns the plain name of springs that are no springs: two infinite stiffnesses are
    /// [`Interface::Bonded`], and 0 sideways with infinity normal is [`Interface::Sliding`].
    #[must_use]
    pub fn plain(self) -> Self {
        match self {
            Self::Springs {
                tangential: f64::INFINITY,
                normal: f64::INFINITY,
            } => Self::Bonded,
            Self::Springs {
                tangential: 0.0,
                normal: f64::INFINITY,
            } => Self::Sliding,
            other => other,
        }
    }

    /// Tells whether no displacement occurs across the interface.
    pub fn is_bonded(self) -> bool {
        self.plain() == Self::Bonded
    }

    /// Returns the stiffnesses sideways and normal to the interface, Pa/m.
    pub const fn stiffnesses(self) -> [f64; 2] {
        match self {
            Self::Bonded => [f64::INFINITY; 2],
            Self::Sliding => [0.0, f64::INFINITY],
            Self::Springs { tangential, normal } => [tangential, normal],
        }
    }

    /// Accepts an interface in which no normal stiffness is below `least` (Pa/m). The error is a
    /// sentence with the value and the range.
    pub(super) fn check(self, least: f64) -> Result<(), String> {
        let [tangential, normal] = self.stiffnesses();
        if tangential.is_nan() || tangential < 0.0 {
            return Err(format!(
                "the tangential stiffness of its interface is {tangential:?} Pa/m, but must be 0 \
                 (it slides) or more; inf is allowed"
            ));
        }
        if normal == 0.0 {
            return Err(
                "the normal stiffness of its interface is 0.0 Pa/m, but must be > 0: with 0 the \
                 layer does not touch what lies below; a layer that slides has the tangential \
                 stiffness 0 and the normal stiffness inf"
                    .into(),
            );
        }
        if normal.is_nan() || normal <= 0.0 {
            return Err(format!(
                "the normal stiffness of its interface is {normal:?} Pa/m, but must be > 0; inf is \
                 allowed"
            ));
        }
        if normal < least {
            return Err(format!(
                "the normal stiffness of its interface is {normal:?} Pa/m, but must be at least \
                 {least:e}: 1e-12 times Young's modulus of the stiffest layer over the thickness of \
                 all layers"
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INFINITY: f64 = f64::INFINITY;

    #[test]
    fn springs_that_are_no_springs_have_plain_names() {
        let springs = |tangential, normal| Interface::Springs { tangential, normal };
        assert_eq!(springs(INFINITY, INFINITY).plain(), Interface::Bonded);
        assert_eq!(springs(0.0, INFINITY).plain(), Interface::Sliding);
        assert_eq!(springs(-0.0, INFINITY).plain(), Interface::Sliding);
        for other in [
            springs(0.0, 1.0),
            springs(1.0, INFINITY),
            springs(INFINITY, 1.0),
        ] {
            assert_eq!(other.plain(), other);
            assert!(!other.is_bonded());
        }
        assert!(Interface::default().is_bonded() && springs(INFINITY, INFINITY).is_bonded());
    }

    #[test]
    fn stiffnesses_that_no_interface_has_are_refused_by_name() {
        let cases = [
            (
                -1.0,
                INFINITY,
                "tangential stiffness of its interface is -1.0 Pa/m",
            ),
            (
                f64::NAN,
                INFINITY,
                "tangential stiffness of its interface is NaN",
            ),
            (1.0, 0.0, "does not touch"),
            (1.0, -2.0, "normal stiffness of its interface is -2.0 Pa/m"),
            (1.0, f64::NAN, "normal stiffness of its interface is NaN"),
            (1.0, 0.9e-9, "at least 1e-9"),
        ];
        for (tangential, normal, part) in cases {
            let interface = Interface::Springs { tangential, normal };
            let message = interface.check(1e-9).expect_err("refused");
            assert!(message.contains(part), "{message:?} lacks {part:?}");
        }
        for (tangential, normal) in [(0.0, 1.0), (0.0, INFINITY), (1e300, 1e-9), (INFINITY, 1.0)] {
            let interface = Interface::Springs { tangential, normal };
            assert_eq!(interface.check(1e-9), Ok(()));
        }
    }
}
