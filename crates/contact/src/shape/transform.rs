//! The transform `b(s)` of a shape: the penetration of a contact of radius `s` on a half-space.
//!
//! ```text
//! b(s) = s int_0^s f'(r)/sqrt(s^2 - r^2) dr
//! ```
//!
//! (Sneddon, Int. J. Eng. Sci. 3, 47, 1965). On a half-space of modulus `E*` the contact without
//! adhesion has `delta0 = b(a)` and `F0 = 2 E* [a b(a) - int_0^a b]`. On a film the shape enters
//! through `b`, too.
//!
//! A slope `f'` that is a linear function of `r` between knots `m`, with a jump `J` and a change
//! `k` of its derivative at each, has a closed form. For `s > m` a knot adds
//!
//! ```text
//! b = s [J q + k (p - m q)]     p = sqrt(s^2 - m^2),  q = arccos(m/s)
//! ```
//!
//! A cone, a flat-ended cone, a rounded cone and a measured profile are of this kind.

use std::f64::consts::PI;

use interp::Probe;

/// The ratio of contact radius and sphere radius below which series avoid cancellation.
const SMALL: f64 = 0.3;

/// The transform of a shape.
#[derive(Clone, Debug)]
pub(crate) enum Transform {
    /// That of a sphere of a radius.
    Sphere(f64),
    /// A factor times `s` to a power.
    Power { factor: f64, exponent: f64 },
    /// That of a slope that is linear between knots.
    Knots(Vec<Knot>),
}

/// A radius at which the slope of a shape jumps or bends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    /// The radius, m.
    pub radius: f64,
    /// The jump of the slope.
    pub jump: f64,
    /// The change of the derivative of the slope, 1/m.
    pub bend: f64,
}

impl Knot {
    /// Returns `p`, and `p` kept above rounding for divisions, and `q` at `s`; none below the knot.
    fn at(&self, s: f64) -> Option<[f64; 3]> {
        let m = self.radius;
        (s >= m).then(|| {
            let p = ((s - m) * (s + m)).sqrt();
            [p, p.max(1e-8 * s), p.atan2(m)]
        })
    }
}

impl Transform {
    /// Makes the transform of a shape; none for a flat punch, which has one contact radius.
    pub(crate) fn of(probe: &Probe) -> Option<Self> {
        let knot = |radius: f64, jump: f64, bend: f64| Knot { radius, jump, bend };
        Some(match *probe {
            Probe::Paraboloid { radius } => Self::Power {
                factor: 1.0 / radius,
                exponent: 2.0,
            },
            Probe::Sphere { radius } => Self::Sphere(radius),
            Probe::PowerLaw {
                coefficient,
                exponent,
            } => Self::Power {
                factor: coefficient * kappa(exponent),
                exponent,
            },
            Probe::Cone { half_angle } => {
                Self::Knots(vec![knot(0.0, half_angle.tan().recip(), 0.0)])
            }
            Probe::RoundedCone { radius, half_angle } => {
                let end = radius / half_angle.tan();
                Self::Knots(vec![
                    knot(0.0, 0.0, 1.0 / radius),
                    knot(end, 0.0, -1.0 / radius),
                ])
            }
            Probe::FlatEndedCone { radius, half_angle } => {
                Self::Knots(vec![knot(radius, half_angle.tan().recip(), 0.0)])
            }
            Probe::FlatPunch { .. } => return None,
            Probe::Profile(ref profile) => {
                let slopes = profile.slopes();
                let mut before = 0.0;
                let bends = slopes.windows(2).map(|pair| {
                    let steepness = (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
                    let bend = steepness - before;
                    before = steepness;
                    knot(pair[0][0], 0.0, bend)
                });
                Self::Knots(bends.collect())
            }
        })
    }

    /// Returns `b(s)`, m.
    pub(crate) fn value(&self, s: f64) -> f64 {
        match self {
            Self::Sphere(radius) => s * (s / radius).atanh(),
            Self::Power { factor, exponent } => factor * s.powf(*exponent),
            Self::Knots(knots) => {
                // `p = s - m^2/(s + p)`, so that bends that cancel each other leave no rounding.
                let (mut bend, mut rest) = (0.0, 0.0);
                for knot in knots {
                    if let Some([p, _, q]) = knot.at(s) {
                        let m = knot.radius;
                        bend += knot.bend;
                        rest += knot.jump * q - knot.bend * m * (m / (s + p) + q);
                    }
                }
                s * (bend * s + rest)
            }
        }
    }

    /// Returns `b'(s)`. It is infinite at the edge of a flat end, where it is replaced by a large
    /// number.
    pub(crate) fn slope(&self, s: f64) -> f64 {
        match self {
            Self::Sphere(radius) => {
                let alpha = s / radius;
                alpha.atanh() + alpha / ((1.0 - alpha) * (1.0 + alpha))
            }
            Self::Power { factor, exponent } => factor * exponent * s.powf(exponent - 1.0),
            Self::Knots(knots) => {
                let (mut bend, mut rest) = (0.0, 0.0);
                for knot in knots {
                    if let Some([p, divisor, q]) = knot.at(s) {
                        let m = knot.radius;
                        bend += knot.bend;
                        rest +=
                            knot.jump * (q + m / divisor) - knot.bend * m * (2.0 * m / (s + p) + q);
                    }
                }
                2.0 * bend * s + rest
            }
        }
    }

    /// Returns the integral of `b` from 0 to `s`, m^2.
    pub(crate) fn integral(&self, s: f64) -> f64 {
        match self {
            Self::Sphere(radius) => {
                let alpha = s / radius;
                let part = if alpha < SMALL {
                    let square = alpha * alpha;
                    let term = |k: i32| square.powi(k) / f64::from((2 * k + 1) * (2 * k + 3));
                    alpha * square * (0..16).rev().map(term).sum::<f64>()
                } else {
                    0.5 * (alpha - (1.0 - alpha) * (1.0 + alpha) * alpha.atanh())
                };
                radius * radius * part
            }
            Self::Power { factor, exponent } => factor * s.powf(exponent + 1.0) / (exponent + 1.0),
            Self::Knots(knots) => {
                let (mut bend, mut rest) = (0.0, 0.0);
                for knot in knots {
                    if let Some([p, _, q]) = knot.at(s) {
                        let m = knot.radius;
                        let of_jump = 0.5 * (s * s * q - m * p);
                        bend += knot.bend;
                        rest += (knot.jump - knot.bend * m) * of_jump
                            - knot.bend * m * m / 3.0 * (s + p * (p / (s + p)));
                    }
                }
                bend * s * s * s / 3.0 + rest
            }
        }
    }

    /// Returns the transform with lengths in units of a `length`.
    pub(crate) fn in_units_of(&self, length: f64) -> Self {
        match self {
            // Divided as a contact radius is, so that that of a flat end is exactly its own.
            Self::Knots(knots) => Self::Knots(
                knots
                    .iter()
                    .map(|knot| Knot {
                        radius: knot.radius / length,
                        jump: knot.jump,
                        bend: knot.bend * length,
                    })
                    .collect(),
            ),
            Self::Sphere(radius) => Self::Sphere(radius / length),
            Self::Power { factor, exponent } => Self::Power {
                factor: factor * length.powf(exponent - 1.0),
                exponent: *exponent,
            },
        }
    }

    /// Returns the power of the contact radius in whose units load and penetration are smooth: 0
    /// for a shape with knots.
    pub(crate) const fn order(&self) -> f64 {
        match self {
            Self::Power { exponent, .. } => *exponent,
            Self::Sphere(_) | Self::Knots(_) => 0.0,
        }
    }

    /// Returns the radii at which the shape is not smooth, ascending, m.
    pub(crate) fn knots(&self) -> &[Knot] {
        match self {
            Self::Knots(knots) => knots,
            Self::Sphere(_) | Self::Power { .. } => &[],
        }
    }
}

/// Returns `sqrt(pi) Gamma(n/2 + 1)/Gamma((n + 1)/2)`, the factor of `b = kappa_n c s^n` for
/// `f = c r^n`, to rounding.
pub(crate) fn kappa(n: f64) -> f64 {
    // Upwards by `kappa(n) = kappa(n + 2) (n + 1)/(n + 2)` to where the asymptotic series of the
    // ratio of the Gamma functions converges to rounding.
    let mut factor = 1.0;
    let mut upper = n;
    while upper < 60.0 {
        factor *= (upper + 1.0) / (upper + 2.0);
        upper += 2.0;
    }
    let z = 0.5 * upper;
    let x = 1.0 / z;
    let series = 1.0
        + x * (1.0 / 8.0
            + x * (1.0 / 128.0
                + x * (-5.0 / 1024.0
                    + x * (-21.0 / 32768.0
                        + x * (399.0 / 262_144.0
                            + x * (869.0 / 4_194_304.0 + x * (-39_325.0 / 33_554_432.0)))))));
    factor * (PI * z).sqrt() * series
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use interp::Profile;

    #[test]
    fn kappa_is_that_of_whole_numbers() {
        let exact = [
            (1.0, FRAC_PI_2),
            (2.0, 2.0),
            (3.0, 0.75 * PI),
            (4.0, 8.0 / 3.0),
            (6.0, 3.2),
            (50.0, 8.906_688_596_554_17),
        ];
        for (n, expected) in exact {
            let found = kappa(n);
            assert!((found / expected - 1.0).abs() < 1e-14, "{n}: {found}");
        }
    }

    /// The integral over the slope of the shape, by a substitution that leaves no singularity.
    fn numeric(slope: impl Fn(f64) -> f64, s: f64) -> f64 {
        let count = 200_000;
        let step = FRAC_PI_2 / f64::from(count);
        let sum: f64 = (0..count)
            .map(|i| slope(s * (step * (f64::from(i) + 0.5)).sin()))
            .sum();
        s * sum * step
    }

    #[test]
    fn transforms_are_the_integrals_over_the_slope() {
        let points = [[0.0, 0.0], [0.5, 0.1], [1.0, 0.4], [2.0, 2.0]];
        let profile = Profile::new(&points).expect("convex");
        let slopes: Vec<[f64; 2]> = profile.slopes().to_vec();
        let measured = move |r: f64| {
            let i = (1..slopes.len() - 1)
                .find(|&i| slopes[i][0] > r)
                .unwrap_or(slopes.len() - 1);
            let [before, after] = [slopes[i - 1], slopes[i]];
            before[1] + (after[1] - before[1]) * (r - before[0]) / (after[0] - before[0])
        };
        let half_angle = 1.1_f64;
        let cot = half_angle.tan().recip();
        type Slope = Box<dyn Fn(f64) -> f64>;
        let cases: Vec<(Probe, Slope)> = vec![
            (Probe::Paraboloid { radius: 2.0 }, Box::new(|r| r / 2.0)),
            (
                Probe::Sphere { radius: 2.0 },
                Box::new(|r: f64| r / (4.0 - r * r).sqrt()),
            ),
            (
                Probe::PowerLaw {
                    coefficient: 0.3,
                    exponent: 2.7,
                },
                Box::new(|r: f64| 0.3 * 2.7 * r.powf(1.7)),
            ),
            (Probe::Cone { half_angle }, Box::new(move |_| cot)),
            (
                Probe::RoundedCone {
                    radius: 1.5,
                    half_angle,
                },
                Box::new(move |r: f64| (r / 1.5).min(cot)),
            ),
            (
                Probe::FlatEndedCone {
                    radius: 0.6,
                    half_angle,
                },
                Box::new(move |r: f64| if r > 0.6 { cot } else { 0.0 }),
            ),
            (Probe::Profile(profile), Box::new(measured)),
        ];
        for (probe, slope) in cases {
            let transform = Transform::of(&probe).expect("no punch");
            for s in [0.2, 0.7, 0.9, 1.5, 1.9] {
                let expected = numeric(&slope, s);
                let found = transform.value(s);
                // The midpoint rule sees a jump within a step.
                assert!(
                    (found - expected).abs() < 1e-5,
                    "{probe:?} at {s}: {found}, not {expected}"
                );
                if s < 0.6 && matches!(probe, Probe::FlatEndedCone { .. }) {
                    continue;
                }
                let step = 1e-5;
                let difference =
                    |f: &dyn Fn(f64) -> f64| (f(s + step) - f(s - step)) / (2.0 * step);
                let slope = difference(&|s| transform.value(s));
                assert!((transform.slope(s) / slope - 1.0).abs() < 1e-8, "{probe:?}");
                let value = difference(&|s| transform.integral(s));
                assert!((value / found - 1.0).abs() < 1e-8, "{probe:?} at {s}");
            }
        }
    }

    /// Where `b` is smooth, the small differences keep their digits.
    #[test]
    fn small_and_large_radii_keep_their_digits() {
        let sphere = Transform::Sphere(1.0);
        let paraboloid = Transform::Power {
            factor: 1.0,
            exponent: 2.0,
        };
        let s = 1e-7;
        assert!((sphere.integral(s) / paraboloid.integral(s) - 1.0).abs() < 1e-13);
        let below = sphere.integral(SMALL * (1.0 - 1e-15));
        assert!((sphere.integral(SMALL) / below - 1.0).abs() < 1e-14);
        let [cone, rounded] = [
            Probe::Cone { half_angle: 1.1 },
            Probe::RoundedCone {
                radius: 1.0,
                half_angle: 1.1,
            },
        ]
        .map(|probe| Transform::of(&probe).expect("no punch"));
        let ratio = rounded.value(1e9) / cone.value(1e9);
        assert!((ratio - 1.0).abs() < 1e-8, "{ratio}");
        assert!((rounded.slope(1e9) / cone.slope(1e9) - 1.0).abs() < 1e-9);
    }
}
