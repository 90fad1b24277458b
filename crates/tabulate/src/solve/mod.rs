//! The solver: from a material and `a/t` to the four quantities, with an estimate of their error.
//!
//! `compliance` is the film on its substrate, `layered` (with `slab`, one layer, and `sampled`, its
//! interpolation) a stack of layers on its base; `symbol` adds the sphere. `solution` accepts a
//! contact within the `domain` and lets `method` choose: `galerkin` (with `quadrature`, `bessel`,
//! `abscissae` and `operator`) for thick films, `wiener_hopf` (with `contour` and `krylov`) for
//! thin ones. Both return an `estimate`. `stacked` does so for a stack. `batch` solves many
//! materials at one `a/t`, `adaptive_curve` one material along `a/t`.
//!
//! # The face of what the sphere touches
//!
//! Galerkin's method knows film or layers by [`SurfaceCompliance`] alone:
//!
//! | [`SurfaceCompliance`] | |
//! |---|---|
//! | `sample(q)`, `sample_all(q)` | the excess `X - 1` and the slope `q X'`, without cancellation |
//! | `smallest_scale()` | the wave number of the nearest pole of `X`: the first panel |
//! | `rule(tolerance, oscillates)` | points and growth of panels, away from the poles |
//! | `largest_excess()` | a bound of `|X - 1|`; 0 where `X = 1` everywhere |
//!
//! The cut-off of `surface`, beyond which `X` is 1, serves all of them. The Wiener-Hopf method asks
//! for more, which [`Compliance`] has for one film only:
//!
//! | [`Compliance`] | |
//! |---|---|
//! | `x(q)` | the value `X(q)`, real or complex |
//! | `smallest_scale_of_sum(sphere, film)` | the smallest scale of `S = sphere + film X` |
//! | `zero_free_radius(sphere, film)` | the disc in which `S` has no zero, for the imaginary axis |
//! | `SINE_OF_FREE_ANGLE` | the sector in which `S` has neither zeros nor poles, for the ray and the panels |

mod abscissae;
mod adaptive_curve;
pub(crate) mod batch;
mod bessel;
mod compliance;
mod contour;
mod domain;
pub(crate) mod estimate;
mod galerkin;
mod krylov;
mod layered;
mod method;
mod operator;
mod quadrature;
mod sampled;
mod slab;
mod solution;
mod stacked;
mod surface;
mod symbol;
mod wiener_hopf;

pub use adaptive_curve::{CURVE_TOLERANCE, curve};
pub use compliance::Compliance;
pub use domain::{A_OVER_T, TOLERANCE};
pub(crate) use estimate::larger;
pub use layered::LayeredCompliance;
pub use method::Method;
pub(crate) use quadrature::{GaussLegendre, Panels};
pub use solution::{Solution, solve};
pub use stacked::{MOST_A_OVER_TOP, solve_stack, stack_curve};
pub use surface::{PanelRule, Sample, SurfaceCompliance};
