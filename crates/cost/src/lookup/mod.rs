//! One lookup: time and error of every form of it, beside direct solves and the closed forms in
//! use.
//!
//! An error is that of the load at a given contact radius, once without adhesion and once with
//! adhesion that halves the load. For the series for thin layers, it is that of the load at a given
//! penetration, without adhesion. The true load is that of the solve at the tightest tolerance that
//! is not refused.
//!
//! `form` measures the forms that hold in the whole box of a table (`linear` has two of them),
//! `layer` the series for thin layers. `load` compares loads, `timer` measures times, `summary`
//! prints the rows, `measure` measures them all.

mod form;
mod layer;
mod linear;
mod load;
mod measure;
mod rows;
mod summary;
mod timer;

pub use self::measure::{POINTS, SEED, measure, solves};
pub use self::rows::{FURTHER, Family, NEW, Point, Row};
pub use self::summary::markdown;
