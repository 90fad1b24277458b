//! The zero of the symbol `S = sphere + film X` that is nearest to 0 in the first quadrant.
//!
//! A film that bends on a softer base has one, and a soft film that is squeezed between stiffer
//! bodies. It is the only one within [`REACH`]: a test looks for others.

use num_complex::Complex64;

use crate::compliance::Compliance;

/// The radius of the quarter disc that holds one zero at most.
pub const REACH: f64 = 2.0;

/// The angle from the imaginary axis, in radians, below which a zero is too close to it for
/// integrals along this axis.
const CLEAR: f64 = 0.1;

/// A zero of `S`.
#[derive(Clone, Copy, Debug)]
pub struct Zero {
    /// Its wave number.
    pub at: Complex64,
    /// `dS/dq` there.
    pub slope: Complex64,
}

/// Looks by Newton's method for the zero of `sphere + film X` within [`REACH`], clear of the
/// imaginary axis. None is within `free` of 0.
///
/// Where none is found though there is one, the imaginary axis is not used.
pub fn nearest_zero(compliance: &Compliance, sphere: f64, film: f64, free: f64) -> Option<Zero> {
    /// The starts: the distance over `free`, and the angle in degrees.
    const STARTS: [(f64, f64); 2] = [(1.2, 60.0), (1.2, 75.0)];
    const MOST_STEPS: usize = 40;
    /// The relative step that leaves rounding only, as the next one is about its square.
    const LAST: f64 = 1e-8;
    // The step to the zero, and the slope of `S` there.
    let newton = |q: Complex64| {
        let [[n, d], [n_prime, d_prime]] = compliance.fraction_and_slopes(q);
        let slope = n_prime * film + d_prime * sphere;
        ((n * film + d * sphere) / slope, slope / d)
    };
    STARTS.into_iter().find_map(|(distance, degrees)| {
        let mut q = Complex64::from_polar(distance * free, degrees.to_radians());
        for _ in 0..MOST_STEPS {
            let (step, _) = newton(q);
            q -= step;
            let within = q.norm() <= REACH && q.re > 0.0 && q.im > 0.0;
            if within && step.norm() <= LAST * q.norm() {
                let (_, slope) = newton(q);
                // A zero at a pole, as far as rounding shows, has no slope.
                let usable = q.re >= CLEAR * q.norm() && slope.is_finite();
                return usable.then_some(Zero { at: q, slope });
            }
            if !(q.norm() <= 2.0 * REACH && q.re >= 0.0) {
                break;
            }
        }
        None
    })
}
