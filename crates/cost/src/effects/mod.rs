//! The effects of a scene: the cost of each, and the error of the load without it.
//!
//! `effect` names the effects, `films` are those that are measured, `load` computes the error of the
//! load, `shape` that of the paraboloid and the time that the sphere itself takes, `cohesive_zone` that
//! of JKR's pull-off and the time of its correction, `interface` a film that slides, `friction` full
//! friction, `relaxation` a modulus that falls in time, `summary` prints the rows.

mod cohesive_zone;
mod effect;
mod films;
mod friction;
mod interface;
mod load;
mod relaxation;
mod rows;
mod shape;
mod summary;

pub use self::cohesive_zone::TABOR;
pub use self::effect::Effect;
pub use self::friction::WIDEST;
pub use self::load::{STRENGTHS, errors};
pub use self::relaxation::EXPONENT;
pub use self::rows::Row;
pub use self::shape::A_OVER_R;
pub use self::summary::markdown;
