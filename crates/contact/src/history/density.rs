//! The density of the exponentials of a law over the logarithm of their rates, and the trapezoidal
//! rule that sums them.

use std::f64::consts::PI;

use libm::tgamma;

use super::Relaxation;
use super::exponentials::Exponentials;

/// The density of the exponentials of a law over `x = ln(rate unit)`.
pub(super) struct Density<'a> {
    value: Box<dyn Fn(f64) -> f64 + 'a>,
    /// The part of the modulus that is left in the end.
    relaxed: f64,
    /// The time in whose inverse the rates are measured, s.
    unit: f64,
    /// The exponents of the density towards slow and fast rates.
    exponents: [f64; 2],
    /// The half width of the strip about the real axis in which it is analytic.
    strip: f64,
    /// The largest `x` at which it counts.
    end: f64,
}

/// The density below which terms do not count.
const NEGLIGIBLE: f64 = 1e-17;

/// The rates of a sum of exponentials: `exp(i step)/unit`.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    step: f64,
    /// The number of the fastest of the slow terms, which one exponential stands for.
    slow: i64,
    /// The number of the fastest term.
    fast: i64,
    /// The time in whose inverse the rates are measured, s.
    unit: f64,
    /// The rate of the exponential that stands for the slow terms, 1/s; `None`: such that the sum has
    /// their second moment.
    slow_rate: Option<f64>,
}

impl Grid {
    /// Returns the same rates for a law with other parameters: those of `sum`.
    pub fn of_rates(&self, sum: &Exponentials) -> Self {
        Self {
            slow_rate: Some(sum.rates[0]),
            ..self.clone()
        }
    }
}

impl<'a> Density<'a> {
    /// Returns the density of a law; `None` of one that is a sum.
    pub fn of(law: &Relaxation) -> Option<Self> {
        Some(match *law {
            Relaxation::Prony { .. } => return None,
            Relaxation::PowerLaw { exponent, time } => Self {
                value: Box::new(move |x| (exponent * x).exp() / tgamma(exponent)),
                relaxed: 0.0,
                unit: time,
                exponents: [exponent, exponent],
                strip: 0.5 * PI,
                end: f64::INFINITY,
            },
            Relaxation::ModifiedPowerLaw {
                relaxed,
                exponent,
                time,
            } => Self {
                value: Box::new(move |x| (exponent * x - x.exp()).exp() / tgamma(exponent)),
                relaxed,
                unit: time,
                exponents: [exponent, exponent],
                strip: 0.5 * PI,
                end: 4.0,
            },
            Relaxation::FractionalZener {
                relaxed,
                exponent,
                time,
            } => {
                let (sin, cos) = (PI * exponent).sin_cos();
                Self {
                    value: Box::new(move |x| {
                        // With the power below 1, so that nothing overflows.
                        let power = (-exponent * x.abs()).exp();
                        sin / PI * power / (1.0 + 2.0 * power * cos + power * power)
                    }),
                    relaxed,
                    unit: time,
                    exponents: [exponent, -exponent],
                    strip: (PI * (1.0 - exponent) / exponent).min(0.5 * PI),
                    end: f64::INFINITY,
                }
            }
        })
    }

    /// Returns the rates for times in `[shortest, longest]` and a relative error of about
    /// `tolerance`. Their unit is that of the law.
    pub fn grid(&self, [shortest, longest]: [f64; 2], tolerance: f64) -> Grid {
        /// The step, over the whole duration, below which a shorter one adds nothing but terms.
        const SHORTEST: f64 = 1e-20;
        let shortest = shortest.max(SHORTEST * longest);
        let step = 2.0 * PI * self.strip / (9.0 / tolerance).ln();
        let index = |rate: f64| (rate * self.unit).ln() / step;
        // Terms of slower rates are nearly constant, to third order in rate times time.
        let slow = (index((6.0 * tolerance).cbrt() / longest).floor() as i64)
            .min((self.end / step) as i64 - 1);
        // Terms of faster rates act at once.
        let fast = (index(1.0 / (tolerance * shortest)).ceil()).min(self.end / step) as i64;
        Grid {
            step,
            slow,
            fast,
            unit: self.unit,
            slow_rate: None,
        }
    }

    /// Returns the rates of [`Density::grid`] in units of the longest time, so that they do not depend on
    /// the time of the law, up to those that die out within the shortest time.
    pub fn absolute_grid(&self, times: [f64; 2], tolerance: f64) -> Grid {
        let shift = (self.unit / times[1]).ln();
        let absolute = Self {
            value: Box::new(|_| 0.0),
            unit: times[1],
            end: self.end - shift,
            ..*self
        };
        absolute.grid_of_steps(times, tolerance)
    }

    /// Returns the rates of [`Density::grid`] up to those that die out within the shortest time.
    pub fn grid_of_steps(&self, times: [f64; 2], tolerance: f64) -> Grid {
        /// The least rate times the shortest time beyond which exponentials act as impulses of two orders.
        const FASTEST: f64 = 50.0;
        let grid = self.grid(times, tolerance);
        // The third order of the impulse is left out.
        let third = tolerance.powf(-1.0 / (3.0 - self.exponents[1]));
        let fastest = (third.max(FASTEST) * self.unit / times[0]).ln() / grid.step;
        Grid {
            fast: grid.fast.min(fastest.ceil() as i64),
            ..grid
        }
    }

    /// Sums the exponentials at the rates of a grid, and adds a constant for the slowest of them.
    pub fn sum(&self, grid: &Grid) -> Exponentials {
        /// The most terms beyond the ends that are added up one by one.
        const MOST: usize = 10_000_000;
        let Grid {
            step, slow, fast, ..
        } = *grid;
        let shift = (self.unit / grid.unit).ln();
        let scale = 1.0 - self.relaxed;
        let weight = |i: i64| scale * step * (self.value)(i as f64 * step + shift);
        let rate = |i: i64| (i as f64 * step).exp() / grid.unit;
        let mut moments = [0.0; 3];
        let mut i = slow;
        for _ in 0..MOST {
            let (own, rate) = (weight(i), rate(i));
            // From here on the density is a power of the rate, and the sums are geometric.
            let x = i as f64 * step + shift;
            let is_power = x < -40.0 / self.exponents[0].min(1.0)
                || (self.end.is_infinite() && self.exponents[1] > 0.0)
                || (self.end.is_finite() && x < -40.0);
            let rest = |j: f64| {
                if is_power {
                    -(-(self.exponents[0] + j) * step).exp_m1()
                } else {
                    1.0
                }
            };
            moments[0] += own / rest(0.0);
            moments[1] += own * rate / rest(1.0);
            moments[2] += own * rate * rate / rest(2.0);
            if is_power {
                break;
            }
            i -= 1;
        }
        let [m0, m1, m2] = moments;
        let slow_rate = grid.slow_rate.unwrap_or(m2 / m1);
        let mut weights = vec![m1 / slow_rate];
        let mut rates = vec![slow_rate];
        for i in slow + 1..=fast {
            weights.push(weight(i));
            rates.push(rate(i));
        }
        // Beyond the fastest rate the density is a power of the rate or falls to 0.
        let mut impulses = [0.0; 2];
        if self.end.is_infinite() && self.exponents[1] > 0.0 {
            let (own, rate) = (weight(fast + 1), rate(fast + 1));
            let rest = |j: f64| -((self.exponents[1] - j) * step).exp_m1();
            impulses = [own / rate / rest(1.0), own / (rate * rate) / rest(2.0)];
        } else {
            let mut i = fast + 1;
            while i as f64 * step + shift <= self.end {
                let (own, rate) = (weight(i), rate(i));
                impulses[0] += own / rate;
                impulses[1] += own / (rate * rate);
                if own / rate <= NEGLIGIBLE * impulses[0] || own == 0.0 {
                    break;
                }
                i += 1;
            }
        }
        Exponentials {
            constant: self.relaxed + m0 - weights[0],
            weights,
            rates,
            impulse: impulses[0],
            second_impulse: impulses[1],
            error: 0.0,
        }
    }
}

impl Exponentials {
    /// Takes the law for times in `[shortest, longest]` with a relative error of about `tolerance`.
    pub fn new(law: &Relaxation, times: [f64; 2], tolerance: f64) -> Self {
        match Density::of(law) {
            None => Self::of_terms(law),
            Some(density) => density
                .sum(&density.grid(times, tolerance))
                .compared_with(law, times, tolerance),
        }
    }

    /// Takes the law for integrals over functions that are smooth over the shortest time before each
    /// time at which they are evaluated: faster exponentials act as impulses of two orders.
    pub fn of_steps(law: &Relaxation, times: [f64; 2], tolerance: f64) -> Self {
        match Density::of(law) {
            None => Self::of_terms(law),
            Some(density) => density
                .sum(&density.grid_of_steps(times, tolerance))
                .compared_with(law, times, tolerance),
        }
    }
}
