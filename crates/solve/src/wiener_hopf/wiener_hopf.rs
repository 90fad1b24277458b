//! The Wiener-Hopf method on the finite interval. Its cost does not grow with `a/t`.
//!
//! # The equation on the two edges
//!
//! Let `rho` run over `[-1, 1]`, `z = q a/t` be the wave number in units of `1/a`, and `S(q)` the
//! [`Symbol`] with `S(inf) = 1`. Consider fields that are a delta function at each edge plus a
//! regular function inside, even (`s = +1`) or odd (`s = -1`) in `rho`, on which the operator with
//! symbol `S` gives zero inside. Their transforms `Y(z)` are entire, and with `Phi` analytic in the
//! upper half plane
//!
//! ```text
//! S Y = e^{iz} Phi(z) + s e^{-iz} Phi(-z),      Y -> e^{iz} + s e^{-iz},      Phi -> 1 as z -> i inf
//! ```
//!
//! With the factors `S(z) = S_+(z) S_+(-z)`, `S_+` analytic and free of zeros in the upper half
//! plane,
//!
//! ```text
//! ln S_+(q) = q/(pi i) int_0^inf ln S(t)/(t^2 - q^2) dt                                              (1)
//! ```
//!
//! and `Phi = S_+ V`, the usual splitting into half planes leaves one equation of the second kind
//! for the edges' coupling,
//!
//! ```text
//! V(z) = 1 + s/(2 pi i) int e^{2 i zeta} S_+(zeta)^2/S(zeta) V(zeta)/(zeta + z) d zeta              (2)
//! ```
//!
//! along any line from `-inf` to `inf` in the upper half plane that passes below the zeros of `S`;
//! there `S` is continued from the right for `Re zeta > 0` and from the left for `Re zeta < 0`. The
//! kernel decays like `e^{-2 Im zeta}`: only wave numbers of order `1/a` couple the edges, however
//! thin the film. Two lines are in use ([`Path`]):
//!
//! * **A ray at 32 degrees and its mirror image.** All zeros and poles lie higher.
//!   `V(-conj zeta) = conj V(zeta)`, and a constant may be subtracted from `1/S`, as its integrals
//!   cancel: `1/S(0)` leaves a kernel that is weak where `a/t` is large.
//! * **The imaginary axis**, both sides of it. There `V` is real and `1/S` leaves
//!   `2 i Im 1/S(i p + 0)`: a quarter of the work. Zeros at a height `eta` are left out with an
//!   error like `e^{-2 eta a/t}`, so that `a/t` must be large enough ([`left_out`]), but for the
//!   nearest one, which may be a node of its own ([`ZeroNode`]) unless it is next to the axis.
//!
//! Nodes, weights and all factors of values of `S` are stored in a [`Contour`]. Equation (2) is
//! solved for both parities at once by minimal residuals (`krylov.rs`), in a few steps as its kernel
//! is compact.
//!
//! # The quantities
//!
//! On the real axis `S_+ = sqrt(S) e^{i theta}`, and the two entire functions are
//!
//! ```text
//! a(z) = Re[e^{iz} S_+ V_even]/S = a0 + a1 z^2 + ...,      b(z) = Im[e^{iz} S_+ V_odd]/S,      z b(z) = b1 z^2 + b2 z^4 + ...
//! ```
//!
//! The inverse `A^-1` of the contact's operator commutes with differentiation but for the edges.
//! Its double transform is therefore
//!
//! ```text
//! int int cos(k rho) A^-1 cos(z rho') = 2 es [k b(k) a(z) - z b(z) a(k)]/(k^2 - z^2)
//! ```
//!
//! and the edge value of `A^-1 cos(k rho)` is `es a(k)`. Expanding in `k^2` and `z^2` gives the
//! right-hand sides 1 and `rho^2` at once:
//!
//! ```text
//! Gamma = es a0      Eeq = es a0 b1      Delta0 = -2 a1/a0      Pi0 = 8 es (a0 b2 - a1 b1)
//! ```
//!
//! For film = substrate `a = cos z` and `b = sin z`, which gives 8/3, 1, 1, 1. `a` and `b/z` are
//! entire functions of `z^2` of slow growth; their values at fifteen `z^2` between 0.1 and 40
//! extrapolate to 0. Other powers of `rho` need other functionals of the same two functions
//! ([`moment`](crate::wiener_hopf::moment)).
//!
//! # Accuracy
//!
//! Contours of neighbouring [`LEVELS`] differ by a factor of about 150 in their error. Two of them,
//! the zeros left out and the rounding of the sums that are read out give the stated error. As two
//! contours may agree by chance, the one stated along the ray has a least value ([`by_chance`]).
//! `tests/truth/contacts.rs` measures the stated errors. The rounding of `Pi0` sets the limit: some
//! 1e-13, and up to 1e-10 for a soft incompressible film between rigid bodies, where `S(t/a)` and
//! with it `V` are small.

use crate::compliance::symbol::Symbol;
use crate::compliance::zero::{LARGEST_FREE_RADIUS, REACH, Zero};
use crate::compliance::{FLAT, SINE_OF_FREE_ANGLE};
use crate::estimate::{Estimate, larger};
use crate::wiener_hopf::contour::{Contour, LEVELS};
use crate::wiener_hopf::coupling;
use crate::wiener_hopf::path::Path;
use crate::wiener_hopf::read_out::Fields;
use crate::wiener_hopf::zero_node::ZeroNode;

/// What a path makes of the zeros of `S`.
#[derive(Clone, Copy)]
struct Zeros {
    /// The one that is a node of its own.
    node: Option<Zero>,
    /// The relative error from all others above the path, which are left out.
    left_out: f64,
}

impl Zeros {
    /// Makes of the zeros what a solve to `tolerance` needs. A ray passes below all of them; of those
    /// off the imaginary axis, the nearest one is a node if it counts and is not next to the axis.
    fn above(path: Path, x: f64, symbol: &Symbol, tolerance: f64) -> Self {
        let without_node = |left_out| Self {
            node: None,
            left_out,
        };
        if path == Path::Ray {
            return without_node(0.0);
        }
        let share = SHARE_OF_ZEROS * tolerance;
        let all = left_out(x, SINE_OF_FREE_ANGLE * symbol.zero_free_radius());
        let others = left_out(x, SINE_OF_FREE_ANGLE * REACH);
        if all <= share || others > share {
            return without_node(all);
        }
        let Some(zero) = symbol.nearest_zero() else {
            return without_node(all);
        };
        let both = zero.nearness() * left_out(x, zero.at.im) + others;
        if both > share && zero.can_be_node() {
            Self {
                node: Some(zero),
                left_out: others,
            }
        } else {
            without_node(both)
        }
    }

    /// Returns whether what is left out allows `tolerance`.
    fn allow(&self, tolerance: f64) -> bool {
        self.left_out <= SHARE_OF_ZEROS * tolerance
    }
}

/// The share of the tolerance that the zeros left out may use up.
const SHARE_OF_ZEROS: f64 = 0.05;

/// Returns whether the zeros of `S` that the imaginary axis leaves out allow `tolerance`.
pub fn axis_reaches(x: f64, symbol: &Symbol, tolerance: f64) -> bool {
    Zeros::above(Path::Axis, x, symbol, tolerance).allow(tolerance)
}

/// Returns the relative error of the imaginary axis from zeros of `S` that it leaves out, of which
/// none is below `height`.
///
/// A zero at the height `eta` leaves an error of some `e^{-2 eta x}`. Measured over 4900 materials,
/// the factor is at most 6. Next to the axis `1/S` has a sharp peak, which counts in proportion to
/// [`Zero::nearness`].
fn left_out(x: f64, height: f64) -> f64 {
    10.0 * (-2.0 * height * x).exp()
}

/// Estimates the time of the imaginary axis for one contact roughly, in microseconds, to choose
/// between methods: 0 where no zero needs a node, as it is then faster than any other method.
pub fn axis_cost(x: f64, symbol: &Symbol, tolerance: f64) -> f64 {
    /// The ratio of the strips of both paths, and of the unknowns of a node.
    const UNKNOWNS_OF_RAY: f64 = 5.8;
    // Finding the zero takes longer than this estimate. Where it would have to be higher than this, the
    // search takes as long as it saves on average over random materials.
    let highest = SINE_OF_FREE_ANGLE * LARGEST_FREE_RADIUS;
    if left_out(x, highest) <= SHARE_OF_ZEROS * tolerance {
        let zeros = Zeros::above(Path::Axis, x, symbol, tolerance);
        if zeros.node.is_none() && zeros.allow(tolerance) {
            return 0.0;
        }
    }
    let (unknowns, spheres) = unknowns_of_ray(x, symbol, tolerance);
    let unknowns = unknowns / UNKNOWNS_OF_RAY;
    spheres * (6.0 + 0.08 * unknowns + 0.0012 * unknowns * unknowns)
}

/// Estimates the time of the ray for one contact roughly, in microseconds, to choose between
/// methods: a fit to the times of random contacts.
pub fn ray_cost(x: f64, symbol: &Symbol, tolerance: f64) -> f64 {
    let (unknowns, spheres) = unknowns_of_ray(x, symbol, tolerance);
    0.001 * spheres * unknowns * unknowns
}

/// Estimates the number of unknowns along the ray, and the time of all spheres over that of the
/// first.
fn unknowns_of_ray(x: f64, symbol: &Symbol, tolerance: f64) -> (f64, f64) {
    /// The time of the second sphere over that of the first.
    const SECOND_SPHERE: f64 = 0.7;
    let (scale, spheres) = match softening(x, symbol) {
        Some(share) => (symbol.softened(share).smallest_scale(), 1.0 + SECOND_SPHERE),
        None => (symbol.smallest_scale(), 1.0),
    };
    let scales = 11.0 - 0.7 * (x * scale).min(1.0).ln();
    (scales * (8.0 - tolerance.ln()), spheres)
}

/// The compliance that is added to a sphere between bodies that are nearly rigid, over `S(t/a)`. The
/// error is about its square.
const SOFTENING: f64 = 1e-6;

/// Returns the compliance to be added over `S(inf)`, where the compliance of long waves is
/// negligible; none elsewhere.
fn softening(x: f64, symbol: &Symbol) -> Option<f64> {
    let softening = SOFTENING * symbol.at(1.0 / x);
    (symbol.at(0.0) <= softening).then_some(softening)
}

/// Solves the contact at `x = a/t` with contours of growing accuracy, until two agree to
/// `tolerance` or there are no better ones.
///
/// Where the compliance of long waves, `S(0)`, is negligible against `S` at the contact's own wave
/// numbers, as between rigid bodies, (2) is ill-conditioned: values at `|zeta| << 1` enter it only
/// in proportion to `S(0)`. The quantities are analytic in the sphere's compliance, so that two
/// slightly softer spheres extrapolate to the given one: `2 f(h) - f(2h)` differs from `f(0)` by
/// `h^2 f''`. As `f` is a sum of `c/(l + h)` with `l` above `S(t/a)` or so, this is less than twice
/// the square of `h/S(t/a)`. Measured: 1.5 times. A contour that serves the first sphere serves the
/// second one, whose symbol varies less.
pub fn solve(x: f64, symbol: &Symbol, exponents: &[f64], path: Path, tolerance: f64) -> Estimate {
    const WEIGHTS: [f64; 2] = [2.0, -1.0];
    let Some(softening) = softening(x, symbol) else {
        return converge(x, symbol, exponents, path, tolerance).0;
    };
    let [soft, softer] = [1.0, 2.0].map(|multiple| symbol.softened(multiple * softening));
    let share = tolerance / 3.0;
    let (mut extrapolated, level) = converge(x, &soft, exponents, path, share);
    let softer = if extrapolated.error <= share {
        let zeros = Zeros::above(path, x, &softer, share);
        let softer = on_contour(x, &softer, exponents, path, zeros.node, level);
        Estimate {
            error: larger(extrapolated.error, softer.error + zeros.left_out),
            ..softer
        }
    } else {
        converge(x, &softer, exponents, path, share).0
    };
    let mut others = softer.numbers();
    extrapolated.change(|number| {
        let other = others.next().expect("both hold the same numbers");
        WEIGHTS[0] * number + WEIGHTS[1] * other
    });
    extrapolated.error = WEIGHTS[0].abs() * extrapolated.error
        + WEIGHTS[1].abs() * softer.error
        + 2.0 * SOFTENING.powi(2);
    extrapolated
}

/// The largest error of a contour over its difference from the contour before. Most often it is a
/// hundredth.
const GAIN: f64 = 0.3;

/// A difference of two contours below which it may come from rounding, in which both have their
/// part.
const NOISE: f64 = 3e-11;

/// The logarithm of `S(0)/S(t/a)` from which on most contacts need one more level than the
/// tolerance.
const STRONG: f64 = 0.1;

/// Returns the smallest error to be stated of a contour, as a multiple of `e^{-digits}` of the level that
/// the tolerance asks for.
///
/// The contour before may be accurate by chance, as its error changes sign as the material or `a/t`
/// changes: then both agree, and their difference tells nothing. Of 400,000 contours along the ray, 40 had a
/// true error above the one stated without this term; it was at most 0.49 of `e^{-digits}`. Of 680,000
/// along the axis, none had.
const fn by_chance(path: Path) -> f64 {
    match path {
        Path::Axis => 0.0,
        Path::Ray => 0.6,
    }
}

/// Solves with contours of growing accuracy until two agree. Returns the level of the last one,
/// too.
fn converge(
    x: f64,
    symbol: &Symbol,
    exponents: &[f64],
    path: Path,
    tolerance: f64,
) -> (Estimate, usize) {
    let zeros = Zeros::above(path, x, symbol, tolerance);
    let contrast = (symbol.at(0.0) / symbol.at(1.0 / x)).ln().abs();
    let further = usize::from(contrast > STRONG);
    let first = LEVELS
        .iter()
        .position(|&digits| digits > -tolerance.ln())
        .map_or(LEVELS.len(), |level| level + further)
        .clamp(1, LEVELS.len() - 1);
    let mut best = Estimate {
        error: f64::INFINITY,
        ..on_contour(x, symbol, exponents, path, zeros.node, first - 1)
    };
    let mut last = first;
    for level in first..LEVELS.len() {
        let next = on_contour(x, symbol, exponents, path, zeros.node, level);
        let difference = next.difference(&best);
        let least = by_chance(path) * (-LEVELS[level - further]).exp();
        let of_rule = larger(GAIN * difference, least);
        let error = of_rule + 2.0 * difference.min(NOISE) + next.error + zeros.left_out;
        best = Estimate { error, ..next };
        last = level;
        if error <= tolerance {
            break;
        }
    }
    (best, last)
}

/// Solves with one contour. The error of the estimate is that of rounding only.
fn on_contour(
    x: f64,
    symbol: &Symbol,
    exponents: &[f64],
    path: Path,
    zero: Option<Zero>,
    level: usize,
) -> Estimate {
    /// The knee over the smallest scale.
    const BELOW: f64 = 0.3;
    let contour = Contour::get(path, level, BELOW * x * symbol.smallest_scale());
    let logs = logarithms(x, symbol, contour);
    let log_factors = log_factors(&logs, contour);
    let couplings = coupling::couplings(x, symbol, contour, &log_factors);
    let zero = zero.map(|zero| ZeroNode::new(x, zero, contour, &logs));
    let strengths = coupling::solve(contour, &couplings, zero.as_ref(), (-LEVELS[level]).exp());
    let fields = Fields {
        x,
        symbol,
        contour,
        logs: &logs,
        phases: &log_factors[contour.unknowns()..],
        strengths: &strengths,
        zero: zero.as_ref(),
    };
    fields.read_out(exponents)
}

/// Returns `ln S` at the abscissae of the contour.
fn logarithms(x: f64, symbol: &Symbol, contour: &Contour) -> Vec<f64> {
    let abscissae = contour.abscissae();
    let count = abscissae.partition_point(|t| *t <= FLAT * x);
    let q: Vec<f64> = abscissae[..count].iter().map(|t| t / x).collect();
    let mut logs = symbol.at_all(&q);
    logs.iter_mut().for_each(|s| *s = s.ln());
    logs
}

/// Returns `ln S_+` at the nodes and its phase at the readouts, by (1), without the contribution of
/// `ln S` at the same point ([`Contour::own`]).
fn log_factors(logs: &[f64], contour: &Contour) -> Vec<f64> {
    let mut sums = vec![0.0; contour.rows()];
    contour.factor.multiply(logs, &mut sums);
    sums
}
