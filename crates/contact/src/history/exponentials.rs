//! A relaxation function as a sum of exponentials, and its creep compliance.
//!
//! All laws are completely monotone: integrals of exponentials with a positive density over the
//! logarithm of the rate. The trapezoidal rule makes a sum of them, whose error falls exponentially
//! with the step. `t^-alpha = (1/Gamma(alpha)) int exp(alpha x - t e^x) dx`, and its relative error
//! at any time is `2 |Gamma(alpha + 2 pi i/step)|/Gamma(alpha)`.

use super::Relaxation;
use crate::root;

/// `constant + sum weight exp(-rate t) + impulse delta(t)` in place of `phi(t)`, for times in a
/// range.
#[derive(Clone, Debug, Default)]
pub(super) struct Exponentials {
    pub constant: f64,
    pub weights: Vec<f64>,
    /// Ascending, 1/s.
    pub rates: Vec<f64>,
    /// The integral over time of all terms that have died out at the shortest time, s.
    pub impulse: f64,
    /// The integral of time times these terms, s^2.
    pub second_impulse: f64,
    /// The largest relative error found in the range of times.
    pub error: f64,
}

/// The weight of a term that cannot be told from 0, in parts of that of all slower ones.
const NEGLIGIBLE: f64 = 1e-13;
/// The product of a rate and a time beyond which an exponential is 0.
const FORGOTTEN: f64 = 45.0;
/// The number of times at which the sum is compared with the law.
const COMPARISONS: i32 = 16;

impl Exponentials {
    /// Adds the largest relative error found.
    pub(super) fn compared_with(
        self,
        law: &Relaxation,
        [shortest, longest]: [f64; 2],
        tolerance: f64,
    ) -> Self {
        let own = self;
        let ratio = (longest / shortest).powf(1.0 / f64::from(COMPARISONS));
        let error = (0..=COMPARISONS).filter_map(|i| {
            let t = shortest * ratio.powi(i);
            Some((own.value(t) / law.closed_form(t)? - 1.0).abs())
        });
        let error = error.fold(0.0, f64::max);
        Self {
            error: if error > 0.0 { error } else { tolerance },
            ..own
        }
    }

    /// Takes a law that is a sum of exponentials; of other laws the constant alone.
    pub(super) fn of_terms(law: &Relaxation) -> Self {
        let (relaxed, mut terms) = match law {
            Relaxation::Prony { relaxed, terms } => (*relaxed, terms.clone()),
            _ => (0.0, Vec::new()),
        };
        terms.sort_by(|a, b| b[1].total_cmp(&a[1]));
        // Between equal rates there is no pole.
        terms.dedup_by(|next, term| {
            let equal = 1.0 / next[1] == 1.0 / term[1];
            term[0] += if equal { next[0] } else { 0.0 };
            equal
        });
        Self {
            constant: relaxed,
            weights: terms.iter().map(|[weight, _]| *weight).collect(),
            rates: terms.iter().map(|[_, time]| 1.0 / time).collect(),
            ..Self::default()
        }
    }

    /// Returns `weight exp(-rate time)` and the rate of the terms that have not died out after a time.
    pub fn after(&self, time: f64) -> impl Iterator<Item = (f64, f64)> {
        let terms = self.weights.iter().zip(&self.rates);
        let alive = terms.take_while(move |(_, rate)| **rate * time <= FORGOTTEN);
        alive.map(move |(weight, rate)| (weight * (-rate * time).exp(), *rate))
    }

    /// Leaves out the terms that cannot be told from 0 beside the slower ones: zero and pole of such a term
    /// coincide in the transform of the law.
    pub fn without_negligible(mut self) -> Self {
        let mut slower = self.constant;
        let keep = |&(weight, _): &(f64, f64)| {
            slower += weight;
            weight > NEGLIGIBLE * slower
        };
        let terms = self.weights.into_iter().zip(self.rates);
        (self.weights, self.rates) = terms.filter(keep).unzip();
        self
    }

    /// Returns the number of exponentials.
    pub fn len(&self) -> usize {
        self.rates.len()
    }

    /// Returns `phi(t)` at a positive time.
    pub fn value(&self, t: f64) -> f64 {
        let terms = self.weights.iter().zip(&self.rates);
        self.constant
            + terms
                .map(|(weight, rate)| weight * (-rate * t).exp())
                .sum::<f64>()
    }

    /// Returns storage and loss modulus at an angular frequency.
    pub fn complex(&self, omega: f64) -> [f64; 2] {
        let mut sum = [self.constant, self.impulse * omega];
        for (weight, rate) in self.weights.iter().zip(&self.rates) {
            // i omega/(rate + i omega)
            let ratio = rate / omega;
            let square = 1.0 + ratio * ratio;
            sum[0] += weight / square;
            sum[1] += weight * ratio / square;
        }
        sum
    }

    /// Returns the creep compliance, a Kelvin chain: with
    /// `h(p) = constant + sum weight p/(p+rate) + impulse p`, the transform of the compliance is `1/(p h)`. Its poles are real and lie
    /// between the rates.
    pub fn creep(&self) -> Creep {
        let Self {
            constant, impulse, ..
        } = *self;
        let (weights, rates) = (&self.weights, &self.rates);
        let (mut retardations, mut amplitudes) = (Vec::new(), Vec::new());
        let mut push = |below: Option<usize>, above: Option<usize>| {
            let (rate, slope) = self.pole(below, above);
            retardations.push(rate);
            amplitudes.push(1.0 / (rate * slope));
        };
        if constant > 0.0 && !rates.is_empty() {
            push(None, Some(0));
        }
        for k in 1..rates.len() {
            push(Some(k - 1), Some(k));
        }
        if impulse > 0.0 && !rates.is_empty() {
            push(Some(rates.len() - 1), None);
        }
        let terms = || weights.iter().zip(rates);
        let flow = if constant > 0.0 {
            0.0
        } else {
            1.0 / (impulse + terms().map(|(weight, rate)| weight / rate).sum::<f64>())
        };
        // An impulse is infinitely stiff at first.
        let instantaneous = if impulse > 0.0 {
            0.0
        } else {
            1.0 / (constant + weights.iter().sum::<f64>())
        };
        Creep {
            instantaneous,
            flow,
            amplitudes,
            rates: retardations,
        }
    }

    /// Returns the zero `p = -rate` of `h` between two neighbouring rates (or 0, or infinity), and
    /// `h'` there.
    fn pole(&self, below: Option<usize>, above: Option<usize>) -> (f64, f64) {
        // Differences to one of the two rates keep their digits where the zero is close to it.
        let h = |origin: f64, offset: f64| {
            let at = origin + offset;
            let mut sum = self.constant - self.impulse * at;
            for (weight, rate) in self.weights.iter().zip(&self.rates) {
                sum += weight * at / ((origin - rate) + offset);
            }
            sum
        };
        let slope = |origin: f64, offset: f64| {
            let mut sum = self.impulse;
            for (weight, rate) in self.weights.iter().zip(&self.rates) {
                let distance = (rate - origin) - offset;
                sum += weight * rate / (distance * distance);
            }
            sum
        };
        let low = below.map_or(0.0, |k| self.rates[k]);
        let high = above.map_or(f64::MAX.sqrt(), |k| self.rates[k]);
        // h falls from infinity above `low` (from a positive constant above 0) to minus infinity.
        let middle = if below.is_some() && above.is_some() {
            0.5 * (low + high)
        } else if above.is_some() {
            0.5 * high
        } else {
            2.0 * low
        };
        let (origin, sign) = if h(low, middle - low) <= 0.0 {
            (low, 1.0)
        } else if above.is_some() {
            (high, -1.0)
        } else {
            (0.0, 1.0)
        };
        let widest = if above.is_some() || origin == low {
            (middle - origin).abs()
        } else {
            high
        };
        let least = (1e-300_f64).max(1e-30 * widest);
        let f = |u: f64| Ok::<_, std::convert::Infallible>(h(origin, sign * u.exp()));
        let from = if above.is_none() && origin == 0.0 {
            middle.ln()
        } else {
            least.ln()
        };
        let Ok(u) = root(f, from, widest.ln());
        let offset = sign * u.exp();
        (origin + offset, slope(origin, offset))
    }
}

/// The creep compliance `instantaneous + flow t + sum amplitude (1 - exp(-rate t))`.
#[derive(Clone, Debug)]
pub(super) struct Creep {
    pub instantaneous: f64,
    pub flow: f64,
    pub amplitudes: Vec<f64>,
    pub rates: Vec<f64>,
}

impl Creep {
    pub fn value(&self, t: f64) -> f64 {
        let terms = self.amplitudes.iter().zip(&self.rates);
        let grown = terms.map(|(amplitude, rate)| -amplitude * (-rate * t).exp_m1());
        self.instantaneous + self.flow * t + grown.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> Vec<Relaxation> {
        let mut laws = vec![
            Relaxation::Prony {
                relaxed: 0.3,
                terms: vec![[0.7, 0.6]],
            },
            Relaxation::Prony {
                relaxed: 0.0,
                terms: vec![[0.5, 1e-3], [0.5, 2.0]],
            },
        ];
        for exponent in [0.01, 0.05, 0.3, 0.5, 0.8, 0.99] {
            laws.push(Relaxation::PowerLaw {
                exponent,
                time: 0.1,
            });
            laws.push(Relaxation::ModifiedPowerLaw {
                relaxed: 0.1,
                exponent,
                time: 0.1,
            });
        }
        laws
    }

    #[test]
    fn sums_hold_their_tolerance() {
        for law in laws() {
            for (shortest, tolerance) in [(1e-4, 1e-5), (1e-4, 1e-8), (1e-4, 1e-12), (1e-12, 1e-5)]
            {
                let sum = Exponentials::new(&law, [shortest, 10.0], tolerance);
                println!(
                    "{law:?} {tolerance:e}: {} terms, {:.1e}",
                    sum.len(),
                    sum.error
                );
                assert!(
                    sum.error <= 3.0 * tolerance,
                    "{law:?} {tolerance:e}: {:.1e}",
                    sum.error
                );
            }
        }
    }

    /// `int_0^t phi dt'` keeps its digits through the impulse, although the sum begins at 1e-4.
    #[test]
    fn integrals_of_singular_laws_from_zero() {
        for exponent in [0.1, 0.5, 0.9] {
            let law = Relaxation::PowerLaw {
                exponent,
                time: 1.0,
            };
            let sum = Exponentials::new(&law, [1e-4, 10.0], 1e-10);
            for t in [1e-4_f64, 1e-2, 10.0] {
                let exact = t.powf(1.0 - exponent) / (1.0 - exponent);
                let terms = sum.weights.iter().zip(&sum.rates);
                let own: f64 = sum.constant * t
                    + sum.impulse
                    + terms.map(|(w, s)| -w * (-s * t).exp_m1() / s).sum::<f64>();
                assert!(
                    (own / exact - 1.0).abs() < 1e-9,
                    "{exponent} {t}: {own} {exact}"
                );
            }
        }
    }

    /// Creep compliance and modulus of a power law have closed forms.
    #[test]
    fn kelvin_chains() {
        for exponent in [0.05, 0.3, 0.5, 0.8] {
            let law = Relaxation::PowerLaw {
                exponent,
                time: 0.1,
            };
            let chain = Exponentials::new(&law, [1e-5, 10.0], 1e-12).creep();
            for t in [1e-4_f64, 1e-2, 0.1, 3.0, 10.0] {
                let exact = law.creep(t).expect("a time");
                let error = chain.value(t) / exact - 1.0;
                assert!(error.abs() < 1e-9, "{exponent} {t}: {error:.1e}");
            }
        }
        // The standard linear solid, of two equal times: J = 1/inf - (1/inf - 1) exp(-inf t/tau).
        let law = Relaxation::Prony {
            relaxed: 0.3,
            terms: vec![[0.4, 0.6], [0.3, 0.6]],
        };
        for t in [0.0, 0.1, 2.0, 50.0] {
            let exact = 1.0 / 0.3 - (1.0 / 0.3 - 1.0) * (-0.3_f64 * t / 0.6).exp();
            assert!((law.creep(t).expect("a time") - exact).abs() < 1e-13, "{t}");
        }
        // A Maxwell fluid: J = 1 + t/tau.
        let law = Relaxation::Prony {
            relaxed: 0.0,
            terms: vec![[1.0, 0.5]],
        };
        assert!((law.creep(2.0).expect("a time") - 5.0).abs() < 1e-13);
    }

    /// `E_(1/2)(-x) = exp(x^2) erfc(x)`, in 15 digits from mpmath.
    #[test]
    fn fractional_zener_of_one_half() {
        let law = Relaxation::FractionalZener {
            relaxed: 0.0,
            exponent: 0.5,
            time: 1.0,
        };
        let cases = [
            (0.01, 0.896_456_979_969_126_8),
            (1.0, 0.427_583_576_155_807),
            (100.0, 0.056_140_992_743_822_6),
        ];
        for (t, exact) in cases {
            let own = law.modulus(t).expect("a time");
            assert!((own / exact - 1.0).abs() < 1e-11, "{t}: {own} {exact}");
            // J = 1 + (t/tau)^n/Gamma(1 + n)
            let creep = law.creep(t).expect("a time")
                / (1.0 + 2.0 * (t / std::f64::consts::PI).sqrt())
                - 1.0;
            assert!(creep.abs() < 1e-11, "{t}: {creep:e}");
        }
    }

    /// With the exponents near 0 and 1 the law tends to 1/2 and to an exponential.
    #[test]
    fn fractional_zener_at_its_ends() {
        let of = |exponent| Relaxation::FractionalZener {
            relaxed: 0.0,
            exponent,
            time: 1.0,
        };
        assert!((of(1e-3).modulus(1.0).expect("a time") - 0.5).abs() < 1e-3);
        let near = of(0.99).modulus(1.0).expect("a time");
        assert!((near - (-1.0_f64).exp()).abs() < 1e-2, "{near}");
    }
}
