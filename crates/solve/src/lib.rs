//! The solver: from a material and `a/t` to the four quantities, with an estimate of their error.
//!
//! `compliance` is the film on its substrate, `layered` a stack of layers on its base (with `slab`,
//! one layer, `joint`, its lower interface, `minors`, `exponential`, `excess`, a bound, and `sampled`, its
//! interpolation); `symbol` adds the sphere.
//! `solution` accepts a contact within the `domain` and lets `method` choose: `galerkin` (with
//! `quadrature`, `bessel`, `sine`, `abscissae`, `operator` and `slope`) for thick films, `wiener_hopf`
//! (with `path`, `contour`, `zero`, `zero_node`, `matrix`, `krylov` and `read_out`) for thin ones. Both
//! return an `estimate`. `stacked` does so for a stack, under one sphere or many. A probe with the profile `r^n`
//! (`power_law`) is one more column of Galerkin's method, and one more functional of the result
//! (`moment`, `turned_line`) of the Wiener-Hopf method. `batch` solves many materials at one `a/t`,
//! `adaptive_curve` one material along `a/t`.
//!
//! # The face of what the sphere touches
//!
//! Galerkin's method knows film or layers by [`SurfaceCompliance`] alone:
//!
//! | [`SurfaceCompliance`] | |
//! |---|---|
//! | `sample(q)`, `sample_all(q)` | the excess `X - 1` and the slope `q X'`, without cancellation |
//! | `smallest_scale()` | the wave number of the nearest pole of `X`: the first panel |
//! | `points(tolerance, oscillates)` | points on a panel, more of them where poles are near |
//! | `largest_excess()` | a bound of `|X - 1|`; 0 where `X = 1` everywhere |
//!
//! The cut-off of `surface`, beyond which `X` is 1, serves all of them. The Wiener-Hopf method asks
//! for more, which [`Compliance`] has for one film only:
//!
//! | [`Compliance`] | |
//! |---|---|
//! | `x(q)` | the value `X(q)`, real or complex |
//! | `smallest_scale_of_sum(sphere, film)` | the smallest scale of `S = sphere + film X` |
//! | `fraction(q)`, `fraction_and_slopes(q)`, `leading_of_sum(sphere, film)` | numerator and denominator, for the zeros of `S` |
//! | `SINE_OF_FREE_ANGLE` | the sector in which `S` has neither zeros nor poles, for the ray and the panels |

#![forbid(unsafe_code)]

mod abscissae;
mod adaptive_curve;
mod batch;
mod bessel;
pub mod cohesive;
mod compliance;
mod contour;
mod domain;
mod error;
mod estimate;
mod excess;
mod exponential;
mod galerkin;
mod joint;
mod krylov;
mod layered;
mod matrix;
mod method;
mod minors;
mod moment;
mod operator;
pub mod parallel;
mod path;
mod power_law;
mod quadrature;
mod read_out;
mod sampled;
mod sine;
mod slab;
mod slope;
mod solution;
pub mod stack;
mod stacked;
pub mod stick;
mod surface;
mod symbol;
mod turned_line;
mod wiener_hopf;
mod zero;
mod zero_node;

pub use adaptive_curve::{CURVE_TOLERANCE, curve};
pub use batch::Batch;
pub use compliance::Compliance;
pub use domain::{A_OVER_T, TOLERANCE};
pub use error::Error;
pub use estimate::larger;
pub use layered::LayeredCompliance;
pub use method::Method;
pub use power_law::{EXPONENTS, PowerLaw};
pub use quadrature::{GaussLegendre, PanelWeights, Panels};
pub use solution::{Solution, solve, solve_power_laws};
pub use stacked::{check_reach, solve_stack_under_spheres};
pub use stacked::{solve_stack, solve_stack_power_laws, stack_curve};
pub use surface::{Sample, SurfaceCompliance};
