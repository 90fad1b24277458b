//! The compliance of what the probe touches, and of the contact with a sphere.
//!
//! `compliance` is the film on its substrate (with `exponential`), `layered` a stack of layers on its base (with `slab`,
//! one layer, `joint`, its lower interface, `minors`, and `excess`, a bound), and `sampled` its interpolation; `surface` is
//! what both have in common. `symbol` adds the sphere, and `zero` finds the zeros of the sum.
//!
//! Galerkin's method knows film or layers by [`SurfaceCompliance`](surface::SurfaceCompliance) alone:
//!
//! | [`SurfaceCompliance`](surface::SurfaceCompliance) | |
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

mod compliance;
pub mod excess;
pub mod exponential;
pub mod joint;
pub mod layered;
pub mod minors;
pub mod sampled;
pub mod slab;
pub mod surface;
pub mod symbol;
pub mod zero;

pub use self::compliance::*;
