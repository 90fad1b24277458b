//! What is known of an indentation beside its contact stiffness.

use super::area::AreaFunction;

/// What is known of a measurement of contact stiffness beside its points. Other kinds do not use it.
///
/// The stiffness is that of a contact line that stays, `S = 2 beta a E2* Eeq`, which a small fast
/// oscillation measures. The instrument reads `1/S_measured = 1/S + Cf` and, as a depth,
/// `h_measured = h + Cf P`, with the compliance `Cf` of its frame. The contact radius `a` is
///
/// | [`Kind`](crate::Kind) | `a` from |
/// |---|---|
/// | `StiffnessRadius` | the abscissa |
/// | `StiffnessLoad` without a hardness | `F(a) = load`, on loading |
/// | `StiffnessLoad` with a hardness `H` | `a = sqrt(P/(pi H))` |
/// | `StiffnessDepth` | the [area function](AreaFunction) at the [contact depth](ContactDepth) |
#[derive(Clone, Debug, PartialEq)]
pub struct Indentation {
    /// The factor `beta` of indenters that are not bodies of revolution: 1.034 of a Berkovich
    /// pyramid (King, Int. J. Solids Struct. 23, 1657, 1987), 1.012 of Vickers' pyramid.
    pub beta: f64,
    /// The factor `epsilon` of [`ContactDepth::OliverPharr`]: 0.75 of paraboloids and pyramids, 0.72
    /// of cones, 1 of flat punches.
    pub epsilon: f64,
    /// The area function.
    pub area: AreaFunction,
    /// The contact depth.
    pub contact_depth: ContactDepth,
    /// The part `k` of the contact depth by which the film is thinner under the tip, `t - k h_c`:
    /// the film itself, or the top layer of a stack. Mencik takes 1/3 (J. Mater. Res. 12, 2475,
    /// 1997).
    pub thinning: f64,
    /// The hardness `H`, Pa, one for all points; `None`: the contact is elastic.
    pub hardness: Option<f64>,
    /// The depth `h0` (m) by which the tip is blunter than its area function, which adds to the
    /// contact depth.
    pub tip_rounding: f64,
    /// The compliance `Cf` of the frame, m/N.
    pub frame_compliance: f64,
    /// The load of each point, N, which [`Kind::StiffnessDepth`](crate::Kind::StiffnessDepth) needs.
    pub loads: Vec<f64>,
    /// The phase of each point, rad: that of the complex stiffness, of which the ordinate is the
    /// storage part. Empty where none is measured, and then the bodies are elastic.
    pub phases: Vec<f64>,
    /// The loss tangent of the film or top layer in synthetic data, 0 to 1; 0 makes no phases. Fits
    /// find their own and do not use it.
    pub loss_tangent: f64,
}

named! {
    /// How the contact depth follows from the depth `h`, the load `P` and the measured stiffness `S`.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ContactDepth {
        /// `h_c = h - epsilon P/S + h0` (Oliver and Pharr, J. Mater. Res. 7, 1564, 1992): the surface
        /// sinks in.
        OliverPharr = "oliver-pharr",
        /// `h_c = 1.2 (h - P/S + h0)` (Loubet, Bauer, Tonck, Bec and Gauthier-Manuel, 1993), for metals
        /// that pile up.
        Loubet = "loubet",
    }
}

impl ContactDepth {
    /// Returns the factors `f` and `e` of the form that all have, `h_c = f (h - e P/S + h0)`.
    pub(super) const fn factors(self, epsilon: f64) -> [f64; 2] {
        match self {
            Self::OliverPharr => [1.0, epsilon],
            Self::Loubet => [1.2, 1.0],
        }
    }

    /// Returns the other definition.
    pub(crate) const fn other(self) -> Self {
        match self {
            Self::OliverPharr => Self::Loubet,
            Self::Loubet => Self::OliverPharr,
        }
    }
}

impl Indentation {
    /// A body of revolution with the area of a perfect Berkovich pyramid, an elastic contact, and an
    /// instrument without a compliance.
    pub const NEW: Self = Self {
        beta: 1.0,
        epsilon: 0.75,
        area: AreaFunction::BERKOVICH,
        contact_depth: ContactDepth::OliverPharr,
        thinning: 0.0,
        hardness: None,
        tip_rounding: 0.0,
        frame_compliance: 0.0,
        loads: Vec::new(),
        phases: Vec::new(),
        loss_tangent: 0.0,
    };
}
