//! The Wiener-Hopf method, for thin films.
//!
//! `wiener_hopf` chooses among contours until two agree. A `contour` divides a `path` into nodes, with what does not depend
//! on the material, in a `matrix` each. `coupling` solves the equation of the two edges there by `krylov`'s minimal residuals,
//! with a `zero_node` for a zero of the symbol, and `read_out` takes the quantities from the solution. Other powers of the
//! radius are a `moment`, which may need a `turned_line`.

pub mod contour;
pub mod coupling;
pub mod krylov;
pub mod matrix;
pub mod moment;
pub mod path;
pub mod read_out;
pub mod turned_line;
mod wiener_hopf;
pub mod zero_node;

pub use self::wiener_hopf::*;
