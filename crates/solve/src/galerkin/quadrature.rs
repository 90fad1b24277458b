//! Gauss-Legendre quadrature over the wave number, on panels that follow the integrand.
//!
//! The integrand is `X(q) - 1` times a product of two spherical Bessel functions of `z = q a/t`.
//! Three lengths matter:
//!
//! * `X` is analytic but for poles that lie more than 50 degrees off the real axis
//!   ([`SINE_OF_FREE_ANGLE`](crate::compliance::SINE_OF_FREE_ANGLE)), the nearest at
//!   `|q| ~ s` ([`SurfaceCompliance::smallest_scale`]). On a panel `[c, 4c]` an `n`-point rule
//!   therefore converges like `2.5^{-2n}`, and panels grow geometrically from `[0, s]`. The poles
//!   of a stack of layers come nearer to the axis, and its panels have more points
//!   ([`SurfaceCompliance::points`]).
//! * The Bessel product oscillates like `cos 2z`. An `n`-point rule on a panel `w` long in `z` has
//!   an error of about `(e w / (4 n))^{2n}` of the integrand's largest value there, which bounds the
//!   width: panels grow as the integrand falls ([`PanelWeights::BesselProducts`]).
//! * `X - 1` dies out like `q^2 e^{-2q}`. The last panel ends where the rest of the integral is
//!   below the tolerance ([`cut_off`]).

use std::f64::consts::{E, PI};

use interp::once::Lazy;

use crate::compliance::surface::{SurfaceCompliance, cut_off, decay};

/// An `n`-point Gauss-Legendre rule on `[-1, 1]`, exact to degree `2n - 1`.
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    /// The abscissae, ascending.
    pub abscissae: Vec<f64>,
    /// The weights.
    pub weights: Vec<f64>,
    /// Eight factors for each abscissa. The values of a function at the abscissae, each multiplied
    /// by the factor number `k` of its abscissa and summed, give the Legendre coefficient of degree
    /// `n - 8 + k`, or of degree 0 where that is negative.
    pub coefficients: Vec<[f64; 8]>,
}

impl GaussLegendre {
    /// Finds the zeros of `P_n` by Newton's method from Tricomi's initial guess. Abscissae and
    /// weights are accurate to a few rounding units for `n <= 1024`.
    pub fn new(n: usize) -> Self {
        let mut rule = Self {
            abscissae: vec![0.0; n],
            weights: vec![0.0; n],
            coefficients: Vec::new(),
        };
        for i in 0..n.div_ceil(2) {
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..6 {
                let mut last = legendre(x).skip(n - 1);
                let [previous, value] =
                    [(); 2].map(|()| last.next().expect("there is one of each degree"));
                slope = n as f64 * (previous - x * value) / (1.0 - x * x);
                x -= value / slope;
            }
            if 2 * i + 1 == n {
                x = 0.0;
            }
            let weight = 2.0 / ((1.0 - x * x) * slope * slope);
            (rule.abscissae[i], rule.abscissae[n - 1 - i]) = (-x, x);
            (rule.weights[i], rule.weights[n - 1 - i]) = (weight, weight);
        }
        let factors = |(&x, &w): (&f64, &f64)| {
            let values: Vec<f64> = legendre(x).take(n).collect();
            std::array::from_fn(|k| {
                let degree = (n + k).saturating_sub(8);
                (degree as f64 + 0.5) * w * values[degree]
            })
        };
        let points = rule.abscissae.iter().zip(&rule.weights);
        rule.coefficients = points.map(factors).collect();
        rule
    }
}

/// Returns the values `P_0(x)`, `P_1(x)` and so on of Legendre's polynomials.
pub fn legendre(x: f64) -> impl Iterator<Item = f64> {
    let next = move |(l, before, now): (f64, f64, f64)| {
        let next = ((2.0 * l + 1.0) * x * now - l * before) / (l + 1.0);
        (l + 1.0, now, next)
    };
    std::iter::successors(Some((0.0, 0.0, 1.0)), move |values| Some(next(*values)))
        .map(|(_, _, value)| value)
}

/// What `X - 1` and `q X'` are integrated with.
#[derive(Clone, Copy, Debug)]
pub enum PanelWeights {
    /// Any products of waves up to `x = a/t`.
    Waves,
    /// The Bessel products at this `x` alone. They fall, so that later panels may be longer.
    BesselProducts,
}

/// The panels in `q` for one `a/t`, and the rule on each of them.
#[derive(Clone, Debug)]
pub struct Panels {
    /// Ends of the panels, ascending from 0.
    pub edges: Vec<f64>,
    /// The rule that serves every panel.
    pub rule: &'static GaussLegendre,
    /// The error of `g.C.g` from the cut-off and from the panels' width, relative to `g(1)^2`.
    pub design_error: f64,
}

/// The rules of 16, 20, 24 and 32 points.
static RULES: Lazy<[GaussLegendre; 4]> = Lazy::new(|| [16, 20, 24, 32].map(GaussLegendre::new));

/// The largest length of a panel over its lower end.
const GROWTH: f64 = 3.0;

/// The factor by which the last panel may be longer.
const STRETCH: f64 = 1.1;

/// The share of the tolerance for the cut-off, and for the panels' width.
const SHARE: f64 = 0.1;

impl Panels {
    /// Chooses panels for `x = a/t` that serve every one of `compliances` to the relative accuracy
    /// `tolerance`.
    pub fn new<'a, C: SurfaceCompliance + 'a>(
        x: f64,
        compliances: impl IntoIterator<Item = &'a C>,
        weights: PanelWeights,
        tolerance: f64,
    ) -> Self {
        let (mut smallest_scale, mut points) = (1.0_f64, 0);
        for compliance in compliances {
            smallest_scale = smallest_scale.min(compliance.smallest_scale());
            // Many points a panel are economical where oscillation limits the panels, few where
            // poles and decay do.
            points = points.max(compliance.points(tolerance, x > 5.0));
        }
        let rule = RULES
            .iter()
            .find(|rule| rule.abscissae.len() == points)
            .expect("there is a rule for every allowed number of points");
        let n = points as f64;
        // The Bessel product is at most 1 where it has not begun to decay, and `1/z^2` beyond.
        let weight = |q: f64| x / (1.0 + x * x * q * q);
        let end = cut_off(SHARE * tolerance, weight);
        // `e^{-2q}` needs panels as narrow as an oscillation at `x = 1` does.
        let width = |from: f64| {
            // The integrand's largest value on a panel is that at the lower end.
            let largest = match weights {
                PanelWeights::Waves => 1.0,
                PanelWeights::BesselProducts => end * decay(from) * weight(from),
            };
            let relative = (SHARE * tolerance / largest).min(1.0);
            4.0 * n / E * relative.powf(0.5 / n) / (1.0 + x * x).sqrt()
        };
        let mut edges = vec![0.0];
        let mut last = 0.0;
        while last < end {
            let length = if last == 0.0 {
                smallest_scale
            } else {
                GROWTH * last
            };
            // A little more range is not worth the points of one more panel.
            let length = if last + STRETCH * length >= end {
                end - last
            } else {
                length
            };
            last = (last + length.min(width(last))).min(end);
            edges.push(last);
        }
        Self {
            edges,
            rule,
            design_error: 2.0 * SHARE * tolerance,
        }
    }
}
