//! Other shapes than the paraboloid from `Gamma` and `Eeq` of a curve: even powers of `r`, and the
//! sphere as a sum of them.
//!
//! # The ladder
//!
//! For the shape `f = c r^n` with `b = c kappa_n s^n` (see the page `contact/shape/transform.rs` of
//! the source) let `delta0 = c kappa_n a^n Delta_n`, and let `mu_n` be the moment of order `n` of
//! the transform `g1` of the flat punch's stress on the unit interval, so that `mu_0 = Eeq`. With
//! `x = a/t`, for even `n`,
//!
//! ```text
//! (x^n Delta_n)'     = n (n - 1) es x^(n-1) mu_(n-2)/Gamma^2
//! (x^(n+1) mu_n)'    = x^n Gamma^2 Delta_n/es
//! ```
//!
//! The proof goes on from that of `curve/derived.rs`, in its notation. Without adhesion
//! `dg/da = delta0' g1` for every shape. Two derivatives with respect to `r` commute with `A` but
//! for terms of the edges, `A d2g/dr2 = -b'' + edges`. As there, the equation at the edge gives
//! `(delta0' g1(a)^2)'` of a shape with a constant `b''`; for any other it gives
//!
//! ```text
//! delta0' = (es/Gamma^2) [b'(0) g1(0) + int_0^a b''(s) g1(s; a) ds]
//! ```
//!
//! because `b''` takes the place of the right-hand side 1, and the flux `Gamma^2 delta0'/es`
//! through the edge is the product of both right-hand sides, `int b'' g1`. With `b'' ~ s^(n-2)` it
//! is the first line. The second line is step 1 of `derived.rs` for the right-hand sides 1 and
//! `r^n`. As `Delta_2 = Delta0`, both lines in turn give `mu_2`, `Delta_4`, `mu_4`, and so on. All
//! integrands are positive: nothing cancels.
//!
//! # The sphere
//!
//! With `b'' = sum_k beta_k s^(2k)` the first line is `delta0' = (es/Gamma^2) sum_k beta_k a^(2k+1)
//! mu_2k`, and `F0' = S delta0'`. So only these two sums are integrated, and `delta0` and `F0` are
//! continuous although the `beta_k` are others on every piece. For small `a/R` they are the
//! first terms of the series of `b = s artanh(s/R)`; above, those of the polynomial in `s^2` that
//! equals `b'/s` at six Chebyshev points of the contact.
//!
//! The results are stored as `Pi0` and `Delta0` of the paraboloid that would have this load and this
//! penetration, so that a lookup takes the same time.

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use crate::curve::grid::{Grid, Position};
use crate::curve::piecewise::{VALUE, Values, evaluate_all};
use crate::curve::series::{Series, economised, ends, integral, product, quotient, transposed};
use crate::{Error, Quantities, Quantity};

/// The largest number of even powers in `b''`.
pub(crate) const MOST_TERMS: usize = 6;
/// The number of coefficients of a series on a piece.
const TERMS: usize = 12;

/// The largest ratio of contact radius and sphere radius for which the economised polynomial is
/// accurate.
pub(crate) const LARGEST_A_OVER_R: f64 = 0.8;

/// The largest `a/R` of a piece for which so many terms of the series of the sphere suffice, to
/// 1e-10.
const FEW_TERMS: [(f64, usize); 5] = [(3e-3, 2), (0.02, 3), (0.05, 4), (0.1, 5), (0.15, 6)];

/// The Chebyshev points of the second kind on `[0, 1]`, `(1 - cos(pi j/5))/2`, and their roots.
const POINTS: [f64; MOST_TERMS] = [
    0.0,
    0.095_491_502_812_526_27,
    0.345_491_502_812_526_27,
    0.654_508_497_187_473_7,
    0.904_508_497_187_473_7,
    1.0,
];
const ROOTS: [f64; MOST_TERMS] = [
    0.0,
    0.309_016_994_374_947_45,
    0.587_785_252_292_473_1,
    0.809_016_994_374_947_5,
    0.951_056_516_295_153_5,
    1.0,
];

/// A shape whose `b` consists of even powers. Lengths are in units of the film's thickness.
#[derive(Clone, Copy, Debug)]
pub(crate) enum EvenShape {
    /// A sphere of this radius.
    Sphere(f64),
    /// `b = factor s^(2k + 2)`.
    Power { factor: f64, k: usize },
}

/// The coefficients of `b'' = sum_k beta_k s^(2k)` on a piece.
#[derive(Clone, Copy, Debug)]
struct Weights {
    terms: usize,
    beta: [f64; MOST_TERMS],
}

impl EvenShape {
    /// Returns the radius of the paraboloid whose `Pi0` and `Delta0` stand for the results.
    pub(crate) const fn unit_radius(self) -> f64 {
        match self {
            Self::Sphere(radius) => radius,
            Self::Power { .. } => 1.0,
        }
    }

    /// Returns the largest contact radius.
    const fn largest(self) -> f64 {
        match self {
            Self::Sphere(radius) => LARGEST_A_OVER_R * radius,
            Self::Power { .. } => f64::INFINITY,
        }
    }

    /// Returns the coefficients for contact radii up to `end`, in units of `1/unit` of the
    /// thickness.
    fn weights(self, end: f64, unit: f64) -> Weights {
        let mut beta = [0.0; MOST_TERMS];
        match self {
            Self::Power { factor, k } => {
                let n = (2 * k + 2) as f64;
                beta[k] = factor * n * (n - 1.0) / unit.powi(2 * k as i32 + 1);
                Weights { terms: k + 1, beta }
            }
            Self::Sphere(radius) => {
                let radius = radius * unit;
                let alpha = end / radius;
                let few = FEW_TERMS.into_iter().find(|(largest, _)| alpha <= *largest);
                // The coefficients of `R b'/s` as a polynomial in `(s/end)^2`, or `(s/R)^2`.
                let (scale, terms) = if let Some((_, terms)) = few {
                    for (k, beta) in beta.iter_mut().enumerate().take(terms) {
                        *beta = (2 * k + 2) as f64 / (2 * k + 1) as f64;
                    }
                    (radius, terms)
                } else {
                    let end = end.min(Self::Sphere(radius).largest());
                    beta = interpolated(end / radius);
                    (end, MOST_TERMS)
                };
                let (mut power, square) = (1.0 / radius, scale * scale);
                for (k, beta) in beta.iter_mut().enumerate() {
                    *beta *= (2 * k + 1) as f64 * power;
                    power /= square;
                }
                Weights { terms, beta }
            }
        }
    }
}

/// The coefficients of the polynomials that are 1 at one of [`POINTS`] and 0 at the others.
const LAGRANGE: [[f64; MOST_TERMS]; MOST_TERMS] = {
    let mut all = [[0.0; MOST_TERMS]; MOST_TERMS];
    let mut j = 0;
    while j < MOST_TERMS {
        let own = &mut all[j];
        own[0] = 1.0;
        let mut i = 0;
        while i < MOST_TERMS {
            if i != j {
                // Times `(u - POINTS[i])/(POINTS[j] - POINTS[i])`.
                let scale = 1.0 / (POINTS[j] - POINTS[i]);
                let mut k = MOST_TERMS - 1;
                while k > 0 {
                    own[k] = scale * (own[k - 1] - POINTS[i] * own[k]);
                    k -= 1;
                }
                own[0] *= -scale * POINTS[i];
            }
            i += 1;
        }
        j += 1;
    }
    all
};

/// Returns the coefficients of the polynomial in `u` that equals `R b'/s = artanh(v)/v + 1/(1 -
/// v^2)`, `v = alpha sqrt(u)`, at the Chebyshev points of the second kind on `0 <= u <= 1`.
fn interpolated(alpha: f64) -> [f64; MOST_TERMS] {
    // The value at 0 is 2.
    let mut coefficients = LAGRANGE[0].map(|coefficient| 2.0 * coefficient);
    for j in 1..MOST_TERMS {
        let v = alpha * ROOTS[j];
        let value = v.atanh() / v + 1.0 / ((1.0 - v) * (1.0 + v));
        for (sum, coefficient) in coefficients.iter_mut().zip(LAGRANGE[j]) {
            *sum += value * coefficient;
        }
    }
    coefficients
}

/// Load and penetration of a shape, or their slopes with respect to `ln a`, in units of the grid:
/// `F0/(E* es)` and `delta0`.
#[derive(Clone, Copy, Debug)]
struct Sums {
    load: f64,
    penetration: f64,
}

/// The contact up to the first node: a thick film, whose kernel is `alpha + beta (rho^2 + s^2)`, see
/// the page `curve/thick_film.rs` of the source.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beginning {
    /// `alpha` and `beta` at the first node.
    alpha: f64,
    beta: f64,
    /// The first node, in units of the grid.
    first: f64,
}

/// The kernel at one contact radius.
#[derive(Clone, Copy, Debug)]
struct Kernel {
    alpha: f64,
    beta: f64,
    y: f64,
}

impl Kernel {
    /// Returns the moments of order 0 and 2 of the solution for the right-hand side `rho^n`.
    fn solve(&self, n: f64) -> [f64; 2] {
        let Self { alpha, beta, .. } = *self;
        let (a, b) = (1.0 + alpha + beta / 3.0, beta);
        let (c, d) = (alpha / 3.0 + beta / 5.0, 1.0 + beta / 3.0);
        let (f0, f2) = (1.0 / (n + 1.0), 1.0 / (n + 3.0));
        let determinant = a * d - b * c;
        [
            (d * f0 - b * f2) / determinant,
            (a * f2 - c * f0) / determinant,
        ]
    }

    /// Returns the value at the edge of the solution for the right-hand side `rho^n`.
    fn edge(&self, n: f64) -> f64 {
        let [m0, m2] = self.solve(n);
        1.0 - (self.alpha + self.beta) * m0 - self.beta * m2
    }

    /// Returns `y^n Delta_n`.
    fn penetration(&self, n: usize) -> f64 {
        self.y.powi(n as i32) * self.edge(n as f64) / self.edge(0.0)
    }

    /// Returns `y^(n+1) mu_n/es`.
    fn moment(&self, n: usize) -> f64 {
        let [m0, m2] = self.solve(0.0);
        let order = n as f64;
        let moment = (1.0 - self.alpha * m0 - self.beta * m2) / (order + 1.0)
            - self.beta * m0 / (order + 3.0);
        self.y.powi(n as i32 + 1) * moment
    }

    /// Returns load and penetration of a shape.
    fn sums(&self, weights: &Weights) -> Sums {
        let stiffness = self.moment(0);
        let mut sums = Sums {
            load: 0.0,
            penetration: 0.0,
        };
        for (k, beta) in weights.beta.iter().enumerate().take(weights.terms) {
            let n = 2 * k + 2;
            let factor = beta / (n * (n - 1)) as f64;
            let penetration = self.penetration(n);
            sums.penetration += factor * penetration;
            sums.load += 4.0 * factor * (penetration * stiffness - self.moment(n));
        }
        sums
    }

    /// Returns the slopes of load and penetration of a shape with respect to `ln a`.
    fn slopes(&self, weights: &Weights) -> Sums {
        let beta = weights.beta.iter().enumerate().take(weights.terms);
        let flux: f64 = beta.map(|(k, beta)| beta * self.moment(2 * k)).sum();
        let penetration = self.y * flux / self.edge(0.0).powi(2);
        Sums {
            load: 4.0 * self.moment(0) * penetration,
            penetration,
        }
    }

    /// Returns the departure of the penetration from that on a half-space per `alpha`: `1 - int b/(a
    /// b)`.
    fn share(&self, weights: &Weights) -> f64 {
        let square = self.y * self.y;
        let (mut value, mut mean, mut power) = (0.0, 0.0, 1.0);
        for (k, beta) in weights.beta.iter().enumerate().take(weights.terms) {
            let n = (2 * k + 2) as f64;
            let term = power * beta / (n * (n - 1.0));
            value += term;
            mean += term / (n + 1.0);
            power *= square;
        }
        1.0 - mean / value
    }
}

impl Beginning {
    /// Finds the kernel from the quantities at the first node, which are over `es`.
    fn new([pi0, eeq]: [f64; 2], first: f64) -> Self {
        let u = 0.375 * pi0 - 1.0;
        Self {
            alpha: 1.0 / eeq - 1.0 - u,
            beta: 1.5 * u,
            first,
        }
    }

    /// Returns the kernel at a contact radius up to the first node, in units of the grid.
    fn at(&self, y: f64) -> Kernel {
        let ratio = y / self.first;
        Kernel {
            alpha: ratio * self.alpha,
            beta: ratio.powi(3) * self.beta,
            y,
        }
    }
}

/// What a curve of even powers has besides its pieces.
#[derive(Clone, Debug)]
pub(crate) struct EvenPowers {
    shape: EvenShape,
    /// The units of the grid per film thickness.
    unit: f64,
    beginning: Beginning,
    /// The sphere-film modulus in the unit of the quantities.
    es: f64,
    /// The derivatives of the logarithms of load and penetration with respect to that of all lengths
    /// of the shape, at a fixed contact radius, in the places of `Pi0` and `Delta0`; none without
    /// derivatives.
    by_size: Option<Arc<[Values]>>,
}

impl EvenPowers {
    /// Returns the quantities, and their slopes, at an `a/t` up to the first node, in which only
    /// `Pi0` and `Delta0` are those of the shape.
    pub(crate) fn below(
        &self,
        x: f64,
        mut values: Quantities,
        mut slopes: Quantities,
    ) -> (Quantities, Quantities) {
        let y = x * self.unit;
        let weights = self.shape.weights(y, self.unit);
        let kernel = self.beginning.at(y);
        let (of, by) = (kernel.sums(&weights), kernel.slopes(&weights));
        let radius = self.shape.unit_radius() * self.unit;
        let [load, penetration] = [self.es * radius / (y * y * y), radius / (y * y)];
        values.pi0 = load * of.load;
        values.delta0 = penetration * of.penetration;
        slopes.pi0 = load * by.load - 3.0 * values.pi0;
        slopes.delta0 = penetration * by.penetration - 2.0 * values.delta0;
        (values, slopes)
    }

    /// Returns the departure of `Delta0` from that on a half-space, relative to that, at an `a/t` up
    /// to the first node, over the departure at the first node.
    pub(crate) fn share_below(&self, x: f64) -> f64 {
        let share = |y: f64| {
            let weights = self.shape.weights(y, self.unit);
            self.beginning.at(y).share(&weights)
        };
        let y = x * self.unit;
        y / self.beginning.first * share(y) / share(self.beginning.first)
    }

    /// Returns `Delta0` of the shape on a half-space, at an `a/t` up to the first node.
    pub(crate) fn on_half_space(&self, x: f64) -> f64 {
        let y = x * self.unit;
        let weights = self.shape.weights(y, self.unit);
        let kernel = Kernel {
            alpha: 0.0,
            beta: 0.0,
            y,
        };
        self.shape.unit_radius() * self.unit / (y * y) * kernel.sums(&weights).penetration
    }

    /// Returns the derivatives of the logarithms of load and penetration with respect to that of all
    /// lengths of the shape, at a fixed contact radius.
    pub(crate) fn by_size(&self, x: f64, position: Option<Position>) -> Result<[f64; 2], Error> {
        let pieces = self.by_size.as_ref().ok_or(Error::NoGradient)?;
        if let Some(position) = position {
            let [load, _, _, penetration] = evaluate_all(&pieces[position.piece], position);
            return Ok([load, penetration]);
        }
        let y = x * self.unit;
        let weights = self.shape.weights(y, self.unit);
        let kernel = self.beginning.at(y);
        let (of, by) = (kernel.sums(&weights), kernel.sums(&dilated(weights)));
        Ok([by.load / of.load, by.penetration / of.penetration])
    }
}

/// Returns the weights of the derivative of a shape with respect to the logarithm of all its
/// lengths, `b - s b'`.
fn dilated(mut weights: Weights) -> Weights {
    for (k, beta) in weights.beta.iter_mut().enumerate() {
        *beta *= -((2 * k + 1) as f64);
    }
    weights
}

/// The pieces of a curve, from which those of other shapes follow.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) pieces: &'a [Values],
    /// The first and the last node in `a/t`.
    pub(crate) range: [f64; 2],
    /// The sphere-film modulus in the unit of the quantities.
    pub(crate) es: f64,
}

impl Source<'_> {
    /// Returns the pieces of the curve of a shape, with `Pi0` and `Delta0` of the shape, and what
    /// else its curve has.
    pub(crate) fn of_shape(&self, shape: EvenShape) -> (Arc<[Values]>, EvenPowers) {
        let beginning = self.beginning();
        let pieces = self.integrated(shape, &beginning, |weights| weights);
        let even = EvenPowers {
            shape,
            unit: self.grid.factor,
            beginning,
            es: self.es,
            by_size: None,
        };
        (pieces, even)
    }

    /// Adds the derivatives with respect to the size of the shape.
    pub(crate) fn with_derivatives(&self, of_shape: &[Values], even: EvenPowers) -> EvenPowers {
        let by_size = self.integrated(even.shape, &even.beginning, dilated);
        let relative = by_size.iter().zip(of_shape).map(|(by, of)| ratio(by, of));
        EvenPowers {
            by_size: Some(relative.collect()),
            ..even
        }
    }

    /// Returns the pieces of the derivatives of the logarithms of `Pi0` and `Delta0` of a shape with
    /// respect to a parameter of the material. `by` holds those of the curve's own quantities over
    /// `es`.
    pub(crate) fn by_parameter<const N: usize>(
        &self,
        shape: EvenShape,
        of_shape: &[Values],
        by: &[[[f64; 4]; N]],
    ) -> Arc<[[[f64; 4]; N]]> {
        /// The step of the differences. Their error is of the order of its square.
        const STEP: f64 = 1e-4;
        let [more, less] = [STEP, -STEP].map(|step| {
            let changed: Vec<Values> = self
                .pieces
                .iter()
                .zip(by)
                .map(|(piece, by)| scaled(piece, by, step))
                .collect();
            let changed = Source {
                pieces: &changed,
                ..*self
            };
            changed.integrated(shape, &changed.beginning(), |weights| weights)
        });
        let mut relative: Vec<[[f64; 4]; N]> = by.to_vec();
        for (i, relative) in relative.iter_mut().enumerate() {
            let difference: Values = std::array::from_fn(|k| {
                std::array::from_fn(|q| (more[i][k][q] - less[i][k][q]) / (2.0 * STEP))
            });
            let quotient = ratio(&difference, &of_shape[i]);
            let quotient: [[f64; 4]; N] = dispatch!(Level::new(), simd => {
                let series = quotient.map(|row| f64x4::simd_from(simd, row));
                economised::<_, VALUE, N>(simd, &series).map(|row| *row.as_array())
            });
            for (own, new) in relative.iter_mut().zip(quotient) {
                for quantity in [Quantity::Pi0, Quantity::Delta0] {
                    own[quantity as usize] = new[quantity as usize];
                }
            }
        }
        relative.into()
    }

    /// Returns the thick film with which the ladder begins.
    fn beginning(&self) -> Beginning {
        let position = self.grid.locate(self.range[0]);
        let [pi0, eeq, ..] = evaluate_all(&self.pieces[position.piece], position);
        Beginning::new(
            [pi0 / self.es, eeq / self.es],
            self.range[0] * self.grid.factor,
        )
    }

    /// Integrates the ladder of a shape, with changed weights, and returns the pieces. Those beyond
    /// the largest contact of the shape keep the values of the paraboloid.
    fn integrated(
        &self,
        shape: EvenShape,
        beginning: &Beginning,
        change: impl Fn(Weights) -> Weights,
    ) -> Arc<[Values]> {
        let unit = self.grid.factor;
        let most = shape.largest() * unit;
        let ends: Vec<[f64; 2]> = self
            .grid
            .pieces(self.range[1])
            .map(|(_, ends)| ends)
            .take_while(|[from, _]| *from < most)
            .collect();
        let mut pieces: Arc<[Values]> = self.pieces.into();
        let own = Arc::make_mut(&mut pieces);
        let first = change(shape.weights(beginning.first, unit));
        let mut running = Running::new(&beginning.at(beginning.first), &first);
        let radius = shape.unit_radius() * unit;
        for (group, ends) in ends.chunks(4).enumerate() {
            let lanes = std::array::from_fn(|lane| lane.min(ends.len() - 1));
            let group = Group {
                ends: lanes.map(|lane: usize| ends[lane]),
                weights: lanes.map(|lane| change(shape.weights(ends[lane][1], unit))),
                pieces: lanes.map(|lane| &self.pieces[4 * group + lane]),
                start: (group == 0).then(|| self.grid.locate(self.range[0]).t),
                number: group,
            };
            let new = dispatch!(Level::new(), simd => {
                group.integrated(simd, self.es, radius, &mut running)
            });
            let group = own[4 * group.number..].iter_mut().zip(new);
            for (own, new) in group.take(ends.len()) {
                for (row, [load, penetration]) in own.iter_mut().zip(new) {
                    row[Quantity::Pi0 as usize] = load;
                    row[Quantity::Delta0 as usize] = penetration;
                }
            }
        }
        pieces
    }
}

/// Returns the quotients of `Pi0` and `Delta0`, as polynomials on a piece.
fn ratio(numerator: &Values, denominator: &Values) -> Values {
    let mut terms = *numerator;
    for k in 0..VALUE {
        for quantity in [Quantity::Pi0 as usize, Quantity::Delta0 as usize] {
            let sum: f64 = (1..=k)
                .map(|i| denominator[i][quantity] * terms[k - i][quantity])
                .sum();
            terms[k][quantity] = (numerator[k][quantity] - sum) / denominator[0][quantity];
        }
    }
    terms
}

/// Returns the quantities times `1 + step by`, as polynomials on a piece.
fn scaled<const N: usize>(piece: &Values, by: &[[f64; 4]; N], step: f64) -> Values {
    std::array::from_fn(|k| {
        std::array::from_fn(|q| {
            let change: f64 = (0..=k.min(N - 1)).map(|i| by[i][q] * piece[k - i][q]).sum();
            piece[k][q] + step * change
        })
    })
}

/// The values of the integrals at the end of the last piece.
struct Running {
    /// Those of `y^(2k+1) mu_2k/es`.
    moments: [f64; MOST_TERMS],
    /// Those of `y^2k Delta_2k`.
    penetrations: [f64; MOST_TERMS],
    /// Those of load and penetration of the shape.
    sums: [f64; 2],
    /// The number of terms that are known.
    terms: usize,
}

impl Running {
    fn new(kernel: &Kernel, weights: &Weights) -> Self {
        let sums = kernel.sums(weights);
        Self {
            moments: std::array::from_fn(|k| kernel.moment(2 * k)),
            penetrations: std::array::from_fn(|k| kernel.penetration(2 * k)),
            sums: [sums.load, sums.penetration],
            terms: MOST_TERMS,
        }
    }

    /// Guesses the integrals of terms that were not needed before, at the contact radius `y`. They
    /// grow so fast that their values there soon do not matter.
    fn extend(&mut self, terms: usize, y: f64) {
        for k in self.terms..terms {
            let n = (2 * k) as f64;
            self.moments[k] = self.moments[k - 1] * y * y * (n - 1.0) / (n + 1.0);
            self.penetrations[k] = self.moments[k - 1] * y * (n - 1.0);
        }
        self.terms = terms;
    }
}

/// Four pieces.
struct Group<'a> {
    /// Their ends, in units of the grid.
    ends: [[f64; 2]; 4],
    weights: [Weights; 4],
    pieces: [&'a Values; 4],
    /// The place of the first node on the first piece, in the first group.
    start: Option<f64>,
    number: usize,
}

impl Group<'_> {
    /// Returns the series of `Pi0` and `Delta0` of the shape on the pieces.
    #[inline(always)]
    fn integrated<S: Simd>(
        &self,
        simd: S,
        es: f64,
        radius: f64,
        running: &mut Running,
    ) -> [[[f64; 2]; VALUE]; 4] {
        let vector = |values: [f64; 4]| f64x4::simd_from(simd, values);
        let half = vector(self.ends.map(|[from, to]| 0.5 * (to - from)));
        let middle = vector(self.ends.map(|[from, to]| 0.5 * (from + to)));
        let zero = f64x4::splat(simd, 0.0);
        let (mut stiffness, mut gamma, mut penetration): (
            Series<S, TERMS>,
            Series<S, TERMS>,
            Series<S, TERMS>,
        ) = ([zero; TERMS], [zero; TERMS], [zero; TERMS]);
        let inverse_es = f64x4::splat(simd, 1.0 / es);
        for k in 0..VALUE {
            let rows = self.pieces.map(|piece| f64x4::from_slice(simd, &piece[k]));
            let [_, eeq, own, delta0] = transposed(rows);
            stiffness[k] = eeq * inverse_es;
            gamma[k] = own * inverse_es;
            penetration[k] = delta0;
        }
        times_linear(&mut stiffness, middle, half);
        times_linear(&mut penetration, middle, half);
        times_linear(&mut penetration, middle, half);
        let square = product(&gamma, &gamma);
        let mut one = [zero; TERMS];
        one[0] = f64x4::splat(simd, 1.0);
        let inverse = quotient(simd, &one, &square);

        let terms = self.weights.iter().map(|weights| weights.terms);
        let terms = terms.max().unwrap_or(1);
        if terms > running.terms {
            running.extend(terms, self.ends[0][0]);
        }
        running.terms = terms;
        let beta = |k: usize| vector(self.weights.each_ref().map(|weights| weights.beta[k]));
        // The sum of the weighted moments. The moment of order 0 is that of the stiffness.
        let mut flux = stiffness;
        scale(&mut flux, beta(0));
        let mut moment = stiffness;
        for k in 1..terms {
            if k > 1 {
                let n = (2 * k) as f64;
                let rate = product(&moment, &inverse);
                let factor = half * f64x4::splat(simd, n * (n - 1.0));
                penetration = integral(simd, &rate, factor);
                self.continued(simd, &mut penetration, &mut running.penetrations[k]);
            }
            moment = integral(simd, &product(&square, &penetration), half);
            self.continued(simd, &mut moment, &mut running.moments[k]);
            let beta = beta(k);
            for (sum, term) in flux.iter_mut().zip(&moment) {
                *sum = beta.mul_add(*term, *sum);
            }
        }
        let rate = product(&flux, &inverse);
        let mut penetration = integral(simd, &rate, half);
        self.continued(simd, &mut penetration, &mut running.sums[1]);
        let work = product(&stiffness, &rate);
        let mut load = integral(simd, &work, half * f64x4::splat(simd, 4.0));
        self.continued(simd, &mut load, &mut running.sums[0]);

        let inverse = f64x4::splat(simd, 1.0) / middle;
        let slope = half * inverse;
        for _ in 0..2 {
            divide_by_linear(&mut penetration, inverse, slope);
        }
        for _ in 0..3 {
            divide_by_linear(&mut load, inverse, slope);
        }
        scale(&mut penetration, f64x4::splat(simd, radius));
        scale(&mut load, f64x4::splat(simd, es * radius));
        let penetration: Series<S, VALUE> = economised(simd, &penetration);
        let load: Series<S, VALUE> = economised(simd, &load);
        std::array::from_fn(|lane| std::array::from_fn(|k| [load[k][lane], penetration[k][lane]]))
    }

    /// Adds the constants with which an integral goes on from piece to piece.
    #[inline(always)]
    fn continued<S: Simd>(&self, simd: S, integral: &mut Series<S, TERMS>, at: &mut f64) {
        let [from, to] = ends(integral);
        let (mut from, to) = (*from.as_array(), *to.as_array());
        if let Some(t) = self.start {
            from[0] = integral
                .iter()
                .rev()
                .fold(0.0, |sum, term| sum * t + term[0]);
        }
        let constants: [f64; 4] = std::array::from_fn(|lane| {
            let constant = *at - from[lane];
            *at = constant + to[lane];
            constant
        });
        integral[0] = f64x4::simd_from(simd, constants);
    }
}

/// Multiplies a series by `middle + half t`.
#[inline(always)]
fn times_linear<S: Simd>(series: &mut Series<S, TERMS>, middle: f64x4<S>, half: f64x4<S>) {
    for k in (1..TERMS).rev() {
        series[k] = half.mul_add(series[k - 1], middle * series[k]);
    }
    series[0] *= middle;
}

/// Divides a series by `(1 + slope t)/inverse`.
#[inline(always)]
fn divide_by_linear<S: Simd>(series: &mut Series<S, TERMS>, inverse: f64x4<S>, slope: f64x4<S>) {
    series[0] *= inverse;
    for k in 1..TERMS {
        series[k] = (-slope).mul_add(series[k - 1], series[k] * inverse);
    }
}

/// Multiplies a series by a number.
#[inline(always)]
fn scale<S: Simd>(series: &mut Series<S, TERMS>, factor: f64x4<S>) {
    for term in series {
        *term *= factor;
    }
}
