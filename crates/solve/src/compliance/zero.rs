//! The zeros of the symbol `S = sphere + film X` in the first quadrant: a disc that holds none, and the
//! one that is nearest to 0.
//!
//! A film that bends on a softer base has a near one, and a soft film that is squeezed between stiffer
//! bodies. It is the only one within [`REACH`]: a test looks for others.

use num_complex::Complex64;

use crate::compliance::Compliance;

/// The radius of the quarter disc that holds one zero at most.
pub const REACH: f64 = 2.0;

/// The largest radius of a disc without a zero that is looked for.
pub const LARGEST_FREE_RADIUS: f64 = 1.0;

/// A zero of `S`.
#[derive(Clone, Copy, Debug)]
pub struct Zero {
    /// Its wave number.
    pub at: Complex64,
    /// `dS/dq` there.
    pub slope: Complex64,
}

impl Zero {
    /// The angle from the imaginary axis, in radians, below which a zero counts as next to it.
    const NEXT_TO_AXIS: f64 = 0.1;

    /// Returns how near the zero is to the imaginary axis: 1 at the angle [`Self::NEXT_TO_AXIS`] and
    /// beyond, and this angle over that of the zero below.
    pub fn nearness(&self) -> f64 {
        (Self::NEXT_TO_AXIS * self.at.norm() / self.at.re).max(1.0)
    }

    /// Returns whether the zero can be a node beside the imaginary axis. A zero at a pole, as far as
    /// rounding shows, has no slope.
    pub fn can_be_node(&self) -> bool {
        self.nearness() == 1.0 && self.slope.is_finite()
    }
}

/// Returns a radius, at most [`LARGEST_FREE_RADIUS`], such that `S = sphere + film X` has no zero but 0
/// in the quarter disc within it; 0 if the radius would be tiny.
pub fn zero_free_radius(compliance: &Compliance, sphere: f64, film: f64) -> f64 {
    /// Smaller radii are of no use.
    const LEAST: f64 = 1e-9;
    /// The radius is found to 1 %.
    const RATIO: f64 = 1.01;
    let is_free = |radius| is_zero_free(compliance, sphere, film, radius);
    if is_free(LARGEST_FREE_RADIUS) {
        return LARGEST_FREE_RADIUS;
    }
    let (mut free, mut beyond) = (LEAST, LARGEST_FREE_RADIUS);
    if !is_free(free) {
        return 0.0;
    }
    while beyond > RATIO * free {
        let middle = (free * beyond).sqrt();
        if is_free(middle) {
            free = middle;
        } else {
            beyond = middle;
        }
    }
    free
}

/// Returns whether it is certain that `S = sphere + film X` has no zero with
/// `0 < |q| <= radius <= 1` in the quarter plane.
///
/// The numerator of `S` is `c + d q` and higher powers with positive coefficients. The sum of the
/// higher powers is at most its value on the real axis. `|c + d q|` is at least its value on the
/// imaginary axis, or if `d < 0` on the real one. As the higher powers fall faster towards 0, a
/// comparison at `radius` holds for all `q` within.
fn is_zero_free(compliance: &Compliance, sphere: f64, film: f64, radius: f64) -> bool {
    let [n, d] = compliance.fraction(radius);
    let [value, slope, ..] = compliance.leading_of_sum(sphere, film);
    let rest = sphere * d + film * n - value - slope * radius;
    let linear = if slope >= 0.0 {
        value.hypot(slope * radius)
    } else {
        value + slope * radius
    };
    linear > rest
}

/// Looks by Newton's method for the zero of `sphere + film X` within [`REACH`], off the imaginary axis.
/// No zero is nearer to 0 than `free`.
///
/// Where none is found though there is one, the imaginary axis is not used.
pub fn nearest_zero(compliance: &Compliance, sphere: f64, film: f64, free: f64) -> Option<Zero> {
    /// The starts: the distance over `free`, and the angle in degrees.
    const STARTS: [(f64, f64); 2] = [(1.2, 60.0), (1.2, 75.0)];
    const MOST_STEPS: usize = 40;
    /// The angle from the imaginary axis, in radians, below which a zero may lie on the axis. Then it is
    /// not always the only one.
    const OFF_AXIS: f64 = 1e-3;
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
                return (q.re >= OFF_AXIS * q.norm()).then_some(Zero { at: q, slope });
            }
            if !(q.norm() <= 2.0 * REACH && q.re >= 0.0) {
                break;
            }
        }
        None
    })
}

#[cfg(test)]
pub mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use interp::Material;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::compliance::SWITCH;

    /// Returns by how much the argument of a function grows along a part of a path. A part along which it changes by
    /// more than half a radian is halved.
    fn turn(
        function: &impl Fn(Complex64) -> Complex64,
        path: &impl Fn(f64) -> Complex64,
        [from, to]: [f64; 2],
        [first, last]: [Complex64; 2],
    ) -> f64 {
        let turned = (last / first).arg();
        let middle = 0.5 * (from + to);
        // Nothing is left to be halved at a zero on the path itself, or is told by NaN, which fails the assertions of the tests.
        if turned.is_nan() || turned.abs() < 0.5 || middle <= from || middle >= to {
            return turned;
        }
        let value = function(path(middle));
        turn(function, path, [from, middle], [first, value])
            + turn(function, path, [middle, to], [value, last])
    }

    /// Returns how often a function winds around 0 along the boundary of the sector
    /// `arg q <= angle`, `inner <= |q| <= outer`.
    fn winding(
        function: impl Fn(Complex64) -> Complex64,
        angle: f64,
        inner: f64,
        outer: f64,
    ) -> f64 {
        const STEPS: usize = 200;
        let along = |path: &dyn Fn(f64) -> Complex64| -> f64 {
            let at = |i: usize| i as f64 / STEPS as f64;
            let values: Vec<Complex64> = (0..=STEPS).map(|i| function(path(at(i)))).collect();
            (0..STEPS)
                .map(|i| {
                    let ends = [values[i], values[i + 1]];
                    turn(&function, &path, [at(i), at(i + 1)], ends)
                })
                .sum()
        };
        let ray = |angle: f64| {
            move |t: f64| Complex64::from_polar(inner * (outer / inner).powf(t), angle)
        };
        let arc = |radius: f64| move |t: f64| Complex64::from_polar(radius, angle * t);
        (along(&ray(0.0)) + along(&arc(outer)) - along(&ray(angle)) - along(&arc(inner)))
            / (2.0 * PI)
    }

    /// The moduli of the tests.
    const MODULI: [f64; 2] = [1e-16, 1e16];

    /// `S = sphere + film X`.
    #[derive(Debug)]
    pub struct Sum {
        pub compliance: Compliance,
        sphere: f64,
        film: f64,
    }

    impl Sum {
        /// Returns the sum for any material of the solver's domain, the ends of the domain
        /// included.
        pub fn random(random: &mut Pcg64Mcg) -> Self {
            let mut log_uniform =
                |[from, to]: [f64; 2], special: f64| match random.random_range(0..10) {
                    0 => special,
                    1 => from,
                    2 => to,
                    _ => random.random_range(from.ln()..to.ln()).exp(),
                };
            let (e1, e0) = (log_uniform(MODULI, 0.0), log_uniform(MODULI, f64::INFINITY));
            let mut nu = || {
                if random.random_bool(0.3) {
                    0.5
                } else {
                    random.random_range(-0.99..0.5)
                }
            };
            let material = Material::new(e1, nu(), e0, nu()).expect("physical");
            Self {
                compliance: Compliance::new(&material),
                sphere: material.sphere_compliance(),
                film: 1.0 / material.film_modulus(),
            }
        }
    }

    /// Returns the parts of a sum, and its smallest scale.
    fn parts(sum: &Sum) -> (Compliance, f64, f64, f64) {
        let scale = sum.compliance.smallest_scale_of_sum(sum.sphere, sum.film);
        (sum.compliance, sum.sphere, sum.film, scale)
    }

    /// The ray of the Wiener-Hopf method and the panels of the quadrature rely on this.
    #[test]
    fn zeros_and_poles_lie_above_53_degrees() {
        let mut random = Pcg64Mcg::seed_from_u64(1);
        for _ in 0..1000 {
            let sum = Sum::random(&mut random);
            let (compliance, sphere, film, scale) = parts(&sum);
            let symbol = |q: Complex64| compliance.x(q) * film + sphere;
            let turns = winding(symbol, 53.0 * PI / 180.0, 1e-3 * scale.max(1e-20), 12.0);
            assert!(turns.abs() < 1e-6, "{turns} turns: {sum:?}");
        }
    }

    /// The method of the imaginary axis relies on this: the stated disc holds no zero.
    #[test]
    fn a_zero_free_disc_has_no_zeros() {
        let mut random = Pcg64Mcg::seed_from_u64(2);
        let mut free = 0;
        for _ in 0..1000 {
            let sum = Sum::random(&mut random);
            let radius = zero_free_radius(&sum.compliance, sum.sphere, sum.film);
            if radius > 1e-6 {
                free += 1;
                let numerator = |q: Complex64| {
                    let [n, d] = sum.compliance.fraction(q);
                    n * sum.film + d * sum.sphere
                };
                let turns = winding(numerator, FRAC_PI_2, 1e-3 * radius, radius);
                assert!(turns.abs() < 1e-6, "{turns} turns within {radius}: {sum:?}");
            }
        }
        println!("{free} symbols of 1000 have discs without a zero");
        // Measured: 999.
        assert!(free > 900);
    }

    /// The method of the imaginary axis relies on this: within [`REACH`] there is one zero at most, and it
    /// is the one that is found.
    #[test]
    fn there_is_one_zero_within_reach_at_most() {
        let mut random = Pcg64Mcg::seed_from_u64(4);
        let (mut with_zero, mut found) = (0, 0);
        for _ in 0..1000 {
            let sum = Sum::random(&mut random);
            let (compliance, sphere, film, scale) = parts(&sum);
            if scale == 0.0 {
                // `S(0) = 0` between rigid bodies, which the method avoids.
                continue;
            }
            let numerator = |q: Complex64| {
                let [[n, d], _] = compliance.fraction_and_slopes(q);
                let factor = if q.norm() > SWITCH {
                    q * 2.0
                } else {
                    0.0.into()
                };
                (n * film + d * sphere) * factor.exp()
            };
            let turns = winding(numerator, FRAC_PI_2, 1e-3 * scale.max(1e-20), REACH);
            assert!(turns < 1.0 + 1e-6, "{turns} turns: {sum:?}");
            with_zero += usize::from(turns > 0.5);
            let free = zero_free_radius(&compliance, sphere, film);
            if let Some(zero) = nearest_zero(&compliance, sphere, film, free) {
                found += 1;
                assert!(
                    (turns - 1.0).abs() < 1e-6,
                    "{turns} turns, {zero:?}: {sum:?}"
                );
                if !zero.can_be_node() {
                    continue;
                }
                // The slope is that of the numerator over the denominator.
                let sum = |q: Complex64| {
                    let [[n, d], _] = compliance.fraction_and_slopes(q);
                    n * film + d * sphere
                };
                let step = 1e-5 * zero.at;
                let [[_, d], _] = compliance.fraction_and_slopes(zero.at);
                let slope = (sum(zero.at + step) - sum(zero.at - step)) / (2.0 * step * d);
                assert!(
                    (slope / zero.slope - 1.0).norm() < 1e-7,
                    "{zero:?}, {slope}: {compliance:?}"
                );
            }
        }
        println!("{found} zeros found of {with_zero}");
        // Measured: 461 of 662.
        assert!(found > 420);
    }
}
