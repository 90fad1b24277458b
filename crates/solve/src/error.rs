//! The errors of direct solves. Each holds the numbers that explain it.

use std::borrow::Cow;

use interp::Material;

/// How [`Error::NotConverged`] names a stack of layers, and a contact with stick.
pub(crate) const OF_STACK: Cow<'static, str> = Cow::Borrowed(" of this stack of layers");
pub(crate) const WITH_STICK: Cow<'static, str> = Cow::Borrowed(" with stick");

/// Returns how [`Error::NotConverged`] names the film of a material.
pub(crate) fn of_film(material: &Material) -> Cow<'static, str> {
    let [e1, e0] = [material.e1_over_e2(), material.e0_over_e2()];
    let [nu1, nu0] = [material.nu1(), material.nu0()];
    format!(", e1_over_e2 = {e1:?}, nu1 = {nu1:?}, e0_over_e2 = {e0:?}, nu0 = {nu0:?}").into()
}

/// Any failure of a direct solve.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A parameter outside the domain of the solve.
    #[error("{name} = {value:?} is outside the domain of the solve, {from:?} to {to:?}")]
    Domain {
        /// The parameter's name.
        name: &'static str,
        /// The value given.
        value: f64,
        /// The smallest value allowed.
        from: f64,
        /// The largest value allowed.
        to: f64,
    },
    /// A tolerance that the solve has not reached.
    #[error(
        "tolerance {tolerance:.1e} is not reached at a_over_t = {a_over_t:?}{of}: the estimated error is {reached:.1e}; \
         ask for a larger tolerance"
    )]
    NotConverged {
        /// The contact radius over the thickness of the film or stack.
        a_over_t: f64,
        /// The rest of the contact, in words: the material of a film, the stack, or that there is stick.
        of: Cow<'static, str>,
        /// The tolerance.
        tolerance: f64,
        /// The estimated relative error that was reached; infinite where every method failed.
        reached: f64,
    },
    /// A contact that is too wide beside the top layer of a stack.
    #[error("a_over_t = {a_over_t:?} is out of reach of {what}")]
    StackReach {
        /// The contact radius over the thickness of the stack.
        a_over_t: f64,
        /// The largest contact radius within reach, over the thickness of the stack.
        reach: f64,
        /// The stack, and what to do, in words.
        what: String,
    },
    /// A stack without layers.
    #[error(
        "a stack needs at least one layer on its base; a sphere on the bare base is `interp::HalfSpace`"
    )]
    NoLayers,
    /// A layer that a stack cannot have.
    #[error("layer {layer} of {layers}, counted from the base: {what}")]
    Layer {
        /// The number of the layer, from 1 at the base.
        layer: usize,
        /// The number of all layers.
        layers: usize,
        /// A sentence with the value and the allowed range.
        what: String,
    },
    /// An attraction of finite range that has no solution at a contact radius.
    #[error(
        "there is no contact of radius {contact_radius:?} m with this attraction: {what}; take a larger contact radius or a shorter interaction range"
    )]
    NotAContact {
        /// The contact radius, m.
        contact_radius: f64,
        /// The condition that is not fulfilled.
        what: &'static str,
    },
    /// An attraction of finite range under a probe that is no paraboloid.
    #[error(
        "an attraction of finite range is solved for a paraboloid only, not for a {probe}; give no interaction range, or where the tip is round the paraboloid with its radius of curvature"
    )]
    OnlyParaboloid {
        /// The name of the shape.
        probe: &'static str,
    },
    /// An attraction that reaches farther than is solved.
    #[error(
        "at the contact radius {contact_radius:?} m the attraction acts beyond the radius {reach:.3e} m, up to which it is solved; take a smaller contact radius or a shorter interaction range"
    )]
    AnnulusReach {
        /// The contact radius, m.
        contact_radius: f64,
        /// The largest outer radius, m.
        reach: f64,
    },
    /// An attraction whose range is so short that rounding leaves no digits of the annulus in which it
    /// acts.
    #[error(
        "at the contact radius {contact_radius:?} m an attraction over {range:?} m acts in an annulus so narrow that rounding leaves no \
         digits of it; take a longer range, or none: JKR is the limit of short ranges"
    )]
    NarrowAnnulus {
        /// The contact radius, m.
        contact_radius: f64,
        /// The range of the attraction, m.
        range: f64,
    },
    /// A pull-off with an attraction of finite range at a contact wider than is solved, in a sentence with the radii.
    #[error("{0}")]
    PullOffReach(String),
    /// A sphere that sticks to a film with which it couples pressure and shear at the edge.
    #[error(
        "a sphere with stick is solved only where Dundurs' beta of sphere and film is 0: a film of Poisson ratio 0.5 under a rigid sphere \
         or one of Poisson ratio 0.5, or sphere and film of one material. Here beta = {beta:.4} (nu1 = {nu1:?}, nu2 = {nu2:?}). A flat \
         punch with stick is solved for every beta. A sphere without friction is solved, too: how large the difference is, a flat punch \
         tells, which on a half-space is stiffer with stick by the factor artanh(beta)/beta = {factor:.4}"
    )]
    Coupled {
        /// Dundurs' beta.
        beta: f64,
        /// `artanh(beta)/beta`.
        factor: f64,
        /// The Poisson ratio of the film.
        nu1: f64,
        /// The Poisson ratio of the sphere.
        nu2: f64,
    },
    /// An error of a material, of a curve or of a contact.
    #[error(transparent)]
    Contact(#[from] contact::Error),
}

impl From<interp::Error> for Error {
    fn from(error: interp::Error) -> Self {
        Self::Contact(error.into())
    }
}

impl Error {
    /// Accepts a value in `[from, to]`.
    ///
    /// # Errors
    /// [`Error::Domain`] for another value.
    pub fn check(name: &'static str, value: f64, [from, to]: [f64; 2]) -> Result<(), Self> {
        if value >= from && value <= to {
            Ok(())
        } else {
            Err(Self::Domain {
                name,
                value,
                from,
                to,
            })
        }
    }
}
