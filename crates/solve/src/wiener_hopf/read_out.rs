//! The quantities from the fields of the two edges, with the rounding error of the sums.

use interp::Quantities;
use num_complex::Complex64;

use crate::compliance::symbol::Symbol;
use crate::estimate::{Estimate, larger};
use crate::power_law::PowerLaw;
use crate::wiener_hopf::contour::{Contour, READOUTS};
use crate::wiener_hopf::coupling::Strengths;
use crate::wiener_hopf::moment::Moment;
use crate::wiener_hopf::path::Path;
use crate::wiener_hopf::zero_node::ZeroNode;

/// The solution of the equation of the edges for one contact.
pub struct Fields<'a> {
    /// `a/t`.
    pub x: f64,
    /// `S`.
    pub symbol: &'a Symbol,
    /// The contour.
    pub contour: &'static Contour,
    /// `ln S` at the abscissae of the contour.
    pub logs: &'a [f64],
    /// The phases of `S_+` at the readouts, without [`Contour::own`].
    pub phases: &'a [f64],
    /// The strengths of the nodes, for the even and for the odd fields.
    pub strengths: &'a [Strengths; 2],
    /// The node of a zero of `S`.
    pub zero: Option<&'a ZeroNode>,
}

/// The fields on the line times their weights: `int E z^{-p} dz = sum E_j z_j^{-p}`.
struct LineFields {
    /// `E_even` at the nodes.
    even: Vec<Complex64>,
    /// `E_odd`.
    odd: Vec<Complex64>,
}

/// A sum and the size of its terms. The rounding error is proportional to the size.
#[derive(Clone, Copy, Default)]
struct Sum {
    value: f64,
    size: f64,
}

impl Sum {
    /// Adds `weight` times `term`.
    fn add(&mut self, weight: f64, term: Self) {
        self.value += weight * term.value;
        self.size += weight.abs() * term.size;
    }

    /// Divides value and size by `divisor`.
    fn over(self, divisor: f64) -> Self {
        Self {
            value: self.value / divisor,
            size: self.size / divisor.abs(),
        }
    }

    /// Returns the size over the value.
    fn relative(self) -> f64 {
        (self.size / self.value).abs()
    }

    /// Returns `self * other`.
    fn times(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            size: self.size * other.value.abs() + self.value.abs() * other.size,
        }
    }
}

impl Fields<'_> {
    /// Returns the quantities, and the contacts of the power laws with the `exponents`. The error
    /// is that of rounding only.
    pub fn read_out(&self, exponents: &[f64]) -> Estimate {
        let (values, readouts) = (self.values(), &self.contour.readouts);
        let mut a0 = Sum::default();
        let mut pole = Sum::default();
        for (m, [a, b]) in values.iter().enumerate() {
            let weight = readouts.coefficients[0][m];
            a0.add(weight, *a);
            pole.add(weight * readouts.z[m], *b);
        }
        // a(z)/z is an odd field too, but for its pole at 0. Equation (2) excludes the pole in
        // proportion to S(0) only: where S(0) is small, b comes with a share of a(z)/z. z b(z) at 0
        // gives the share, which is subtracted unless it is rounding.
        let share = if pole.value.abs() > ROUNDING * pole.size {
            pole.over(a0.value)
        } else {
            Sum::default()
        };
        // a and b/z.
        let regular: [[Sum; 2]; READOUTS] = std::array::from_fn(|m| {
            let (z, [a, b]) = (readouts.z[m], values[m]);
            let mut regular = Sum::default();
            regular.add(1.0 / z, b);
            regular.add(-a.value / (z * z), share);
            [a, regular]
        });

        let mut line = None;
        let mut moments = |exponent: f64| {
            let moment = Moment::new(exponent, self.contour);
            let mut sums = [Sum::default(); 2];
            for (weight, values) in moment.readouts.iter().zip(&regular) {
                sums.iter_mut()
                    .zip(values)
                    .for_each(|(sum, value)| sum.add(*weight, *value));
            }
            if let Some(weights) = &moment.line {
                let line = line.get_or_insert_with(|| self.on_turned_line());
                add_line(&mut sums, line, weights, share.value, self.contour);
            }
            sums
        };
        let [_, b1] = moments(0.0);
        let es = self.symbol.modulus();
        let mut rounding = a0.relative() + b1.relative();
        let mut power_law = |exponent: f64| {
            let [a, b] = moments(exponent);
            let (first, second) = (a.times(b1), a0.times(b));
            let load = first.value - second.value;
            rounding = larger(rounding, (first.size + second.size) / load.abs());
            rounding = larger(rounding, a0.relative() + a.relative());
            PowerLaw {
                exponent,
                pi: 4.0 * es * load,
                delta: a.value / a0.value,
            }
        };
        let paraboloid = power_law(2.0);
        let power_laws = exponents
            .iter()
            .map(|&exponent| power_law(exponent))
            .collect();
        let ratio = self.symbol.at(0.0) / self.symbol.at(1.0 / self.x);
        let long_waves = of_long_waves(self.contour.path, ratio);
        Estimate {
            quantities: Quantities {
                pi0: paraboloid.pi,
                eeq: es * a0.value * b1.value,
                gamma: es * a0.value,
                delta0: paraboloid.delta,
            },
            power_laws,
            error: ROUNDING * (rounding + long_waves),
            modes: self.contour.unknowns(),
        }
    }

    /// Returns `a` and `b` at the readouts, with the size of their terms, which may be larger.
    fn values(&self) -> [[Sum; 2]; READOUTS] {
        let contour = self.contour;
        let z = &contour.readouts.z;
        // What the nodes add to `V`; they subtract it from the odd one.
        let [even, odd] = self.strengths.each_ref().map(|strengths| {
            let mut sums = [0.0; 2 * READOUTS];
            contour.readout.multiply(&strengths.nodes, &mut sums);
            sums
        });
        let v = |m: usize| {
            let [mut even, mut odd] =
                [&even, &odd].map(|sums| Complex64::new(sums[2 * m], sums[2 * m + 1]));
            if let Some(zero) = self.zero {
                let [of_even, of_odd] = self.strengths.each_ref().map(|one| one.zero);
                even += zero.influence(of_even, Complex64::from(z[m]));
                odd += zero.influence(of_odd, Complex64::from(z[m]));
            }
            [1.0 + even, 1.0 - odd]
        };
        let symbols = self.symbol.at_all(&z.map(|z| z / self.x));
        std::array::from_fn(|m| {
            let (z, s, [even, odd]) = (z[m], symbols[m], v(m));
            let amplitude = 1.0 / s.sqrt();
            let phase = z + self.phases[m] + contour.own[contour.nodes.len() + m].im * s.ln();
            let wave = Complex64::from_polar(amplitude, phase);
            // The root of the square is faster than the modulus, and nothing overflows.
            let size = |v: Complex64| amplitude * (1.0 + v.norm_sqr().sqrt());
            [
                Sum {
                    value: (wave * even).re,
                    size: size(even),
                },
                Sum {
                    value: (wave * odd).im,
                    size: size(odd),
                },
            ]
        })
    }

    /// Returns the fields on the contour's turned line.
    fn on_turned_line(&self) -> LineFields {
        let line = self.contour.turned_line();
        let n = line.nodes.len();
        let mut log_factors = vec![0.0; 2 * n];
        line.factor.multiply(self.logs, &mut log_factors);
        let waves: Vec<Complex64> = (0..n)
            .map(|j| {
                let s = self.symbol.at(line.nodes[j] / self.x);
                let log_factor =
                    Complex64::new(log_factors[j], log_factors[n + j]) + line.own[j] * s.ln();
                line.weights[j] * log_factor.exp() / s
            })
            .collect();
        let [even, odd] =
            [(&self.strengths[0], 1.0), (&self.strengths[1], -1.0)].map(|(strengths, sign)| {
                let mut v = vec![0.0; 2 * n];
                line.readout.multiply(&strengths.nodes, &mut v);
                let of_zero = |j: usize| {
                    self.zero.map_or(Complex64::ZERO, |zero| {
                        zero.influence(strengths.zero, line.nodes[j])
                    })
                };
                let value = |j: usize| Complex64::new(v[j], v[n + j]) + of_zero(j);
                let field = |j: usize| waves[j] * (1.0 + sign * value(j));
                (0..n).map(field).collect()
            });
        LineFields { even, odd }
    }
}

/// Adds the integrals along the turned line to the moments of `a` and of `b/z`, of which the
/// `share` of `a/z^2` is subtracted.
fn add_line(
    sums: &mut [Sum; 2],
    line: &LineFields,
    weights: &[Vec<Complex64>; 2],
    share: f64,
    contour: &Contour,
) {
    let nodes = &contour.turned_line().nodes;
    for (j, (even, odd)) in line.even.iter().zip(&line.odd).enumerate() {
        let a = weights[0][j] * even;
        let b = weights[1][j] * odd;
        let pole = share * weights[1][j] / nodes[j] * even;
        let terms = [(a.re, a.norm()), (b.im - pole.re, b.norm() + pole.norm())];
        sums.iter_mut()
            .zip(terms)
            .for_each(|(sum, (value, size))| sum.add(1.0, Sum { value, size }));
    }
}

/// The rounding error of the sums at the readouts, relative to the size of their terms.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Returns what long waves add to the size of the terms, where their compliance is `ratio` times that of
/// the contact's own wave numbers.
///
/// Long waves of a stiff film on a soft base add rounding errors, though the contact hardly acts on them.
/// Along the ray those of a soft film add some that grow like the logarithm of the ratio, as far as was
/// measured. The factor is a fit: of 88,000 random contacts the true errors are at most 0.89 of the stated
/// ones; without this term, up to 1.4 times the stated ones.
fn of_long_waves(path: Path, ratio: f64) -> f64 {
    const OF_SOFT: f64 = 60.0;
    match path {
        Path::Ray if ratio < 1.0 => ratio - OF_SOFT * ratio.ln(),
        _ => ratio,
    }
}
