//! What measured values tell of a contact, without a fit.
//!
//! `energy_release` starts from a measured load or penetration, `work_of_adhesion` from a measured pull-off, and `jkr_fit` fits a
//! straight line to contact radii and loads.

mod energy_release;
mod jkr_fit;
mod work_of_adhesion;

pub use self::jkr_fit::{FilmBias, JkrFit, JkrPoint};
pub use self::work_of_adhesion::work_of_adhesion_at_pull_off;
