//! Quadrature for the Wiener-Hopf method: nodes, weights and matrices that depend neither on the
//! material nor on `a/t`.
//!
//! In the variable `zeta = q a/t` the integrals of `wiener_hopf.rs`
//! differ between contacts only by the values of the symbol `S`. One solve is therefore a few
//! products with the matrices stored here, along the lines of [`path`](crate::wiener_hopf::path).

use std::f64::consts::PI;

use interp::once::Once;
use num_complex::Complex64;

use crate::wiener_hopf::matrix::Matrix;
use crate::wiener_hopf::path::{Logarithm, Path, influence};
use crate::wiener_hopf::turned_line::TurnedLine;

/// The accuracies (`digits`) for which contours are made, ascending. The errors of neighbours
/// differ by a factor of at least 150.
pub const LEVELS: [f64; 7] = [11.0, 16.0, 21.0, 26.0, 31.0, 37.0, 43.0];

/// The distance of neighbouring knees in `ln |zeta|`.
const KNEE_STEP: f64 = 3.0;
/// The number of knees. Features below the last one do not count in double precision.
const KNEES: usize = 13;

/// The number of abscissae `z` at which the two functions of the edge are read out. The functions
/// are entire in `z^2` and grow like `cos z`; this number gives 15 digits.
pub const READOUTS: usize = 15;

/// One path, divided into nodes for one accuracy and one knee.
#[derive(Debug)]
pub struct Contour {
    /// The path.
    pub path: Path,
    /// The nodes `zeta`.
    pub nodes: Vec<Complex64>,
    /// `e^{2 i zeta} d zeta / (2 pi i)`.
    pub weights: Vec<Complex64>,
    /// The matrix from the strengths `y` of the nodes to `V` at the nodes,
    /// `y/(q + zeta) - conj(y)/(q - conj(zeta))`. Both sides have the length [`Self::unknowns`].
    pub kernel: Matrix,
    /// The abscissae of the readouts.
    pub readouts: Readouts,
    /// The matrix from the strengths to `V` at the readouts: real and imaginary part of one after the
    /// other.
    pub readout: Matrix,
    /// The matrix from `ln S` at the abscissae to `ln S_+`, with [`Self::rows`] rows.
    pub factor: Matrix,
    /// The factor from `ln S` at a point to `ln S_+` at that point: nodes, then readouts.
    pub own: Vec<Complex64>,
    /// The abscissae and steps of the whole integral of `ln S`.
    logarithm: Logarithm,
    /// The knee.
    knee: f64,
    /// The line for profiles that are not even powers of the radius, made when it is needed.
    turned_line: Once<TurnedLine>,
}

/// The readouts `z`, and the polynomial in `z^2` through the values of an even function there.
#[derive(Debug)]
pub struct Readouts {
    /// The readouts, ascending.
    pub z: [f64; READOUTS],
    /// Row `i` holds the weights of the values in the coefficient of `z^{2i}`.
    pub coefficients: [[f64; READOUTS]; READOUTS],
}

impl Readouts {
    /// Chooses Chebyshev points of `z^2` and moves them away from `abscissae`, which ascend.
    ///
    /// The interval is a compromise: where `S` is small, rounding counts as `z^-3` close to 0, and
    /// it is extrapolated further from a shorter interval.
    fn between(abscissae: &[f64]) -> Self {
        const FROM: f64 = 0.1;
        const TO: f64 = 40.0;
        let z: [f64; READOUTS] = std::array::from_fn(|i| {
            let chebyshev = (PI * (i as f64 + 0.5) / READOUTS as f64).cos();
            let z = (0.5 * (FROM + TO) - 0.5 * (TO - FROM) * chebyshev).sqrt();
            let above = abscissae.partition_point(|&t| t <= z);
            let [below, above] = [abscissae[above - 1], abscissae[above]];
            below + (above - below) * (0.25 + 0.5 * (z - below) / (above - below))
        });
        let square = z.map(|z| z * z);
        let mut coefficients = [[0.0; READOUTS]; READOUTS];
        for (m, &own) in square.iter().enumerate() {
            // Lagrange's polynomial of readout m: the product of (1 - u/u_j)/(1 - u_m/u_j). Its
            // coefficients alternate in sign, and no sum of this loop cancels.
            let mut product = [0.0; READOUTS];
            product[0] = 1.0;
            for other in (0..READOUTS).filter(|&j| j != m).map(|j| square[j]) {
                let scale = other / (other - own);
                for i in (1..READOUTS).rev() {
                    product[i] = scale * (product[i] - product[i - 1] / other);
                }
                product[0] *= scale;
            }
            for (row, value) in coefficients.iter_mut().zip(product) {
                row[m] = value;
            }
            // The slope with fewer rounding errors.
            let others = (0..READOUTS).filter(|&j| j != m).map(|j| square[j]);
            coefficients[1][m] = -product[0] * others.map(|other| 1.0 / other).sum::<f64>();
        }
        Self { z, coefficients }
    }
}

impl Contour {
    /// Returns the contour of accuracy `LEVELS[level]` with a knee at or a little below `knee`.
    ///
    /// Each contour is made once and kept. An ordinary table needs a few megabytes of contours. All
    /// contours, for every corner of the domain, would take half a gigabyte.
    pub fn get(path: Path, level: usize, knee: f64) -> &'static Self {
        static CONTOURS: [[[Once<Contour>; KNEES]; LEVELS.len()]; 2] =
            [const { [const { [const { Once::new() }; KNEES] }; LEVELS.len()] }; 2];
        let n = ((-knee.ln() / KNEE_STEP).ceil().max(0.0) as usize).min(KNEES - 1);
        CONTOURS[path as usize][level][n]
            .get_or_init(|| Self::new(path, LEVELS[level], (-KNEE_STEP * n as f64).exp()))
    }

    /// Divides `path` for an error of `e^{-digits}`.
    fn new(path: Path, digits: f64, knee: f64) -> Self {
        let direction = path.direction();
        let (radii, steps) = path.rule().nodes(digits, knee, path.end(digits));
        let nodes: Vec<Complex64> = radii.iter().map(|radius| direction * radius).collect();
        let weight = |(zeta, step): (&Complex64, &f64)| {
            (2.0 * Complex64::I * zeta).exp() * direction * step / (2.0 * PI * Complex64::I)
        };
        let weights = nodes.iter().zip(&steps).map(weight).collect();

        let logarithm = Logarithm::new(digits, knee);
        let readouts = Readouts::between(&logarithm.abscissae);
        let z = readouts.z.map(Complex64::from);
        let points: Vec<Complex64> = nodes.iter().copied().chain(z).collect();
        let own = points.iter().map(|&q| logarithm.own(q)).collect();
        let mut factor = Vec::new();
        for i in 0..logarithm.kept {
            factor.extend(nodes.iter().map(|&q| logarithm.share(q, i).re));
            if path == Path::Ray {
                factor.extend(nodes.iter().map(|&q| logarithm.share(q, i).im));
            }
            factor.extend(z.iter().map(|&q| logarithm.share(q, i).im));
        }

        let (mut kernel, mut readout) = (Vec::new(), Vec::new());
        for unit in path.units() {
            for &zeta in &nodes {
                let influence = |q: Complex64| influence(*unit, zeta, q);
                kernel.extend(nodes.iter().map(|&q| influence(q).re));
                if path == Path::Ray {
                    kernel.extend(nodes.iter().map(|&q| influence(q).im));
                }
                readout.extend(z.iter().map(|&q| influence(q)).flat_map(|v| [v.re, v.im]));
            }
        }
        let unknowns = nodes.len() * path.units().len();
        Self {
            path,
            nodes,
            weights,
            kernel: Matrix::from_columns(unknowns, &kernel),
            readouts,
            readout: Matrix::from_columns(2 * READOUTS, &readout),
            factor: Matrix::from_columns(unknowns + READOUTS, &factor),
            own,
            logarithm,
            knee,
            turned_line: Once::new(),
        }
    }

    /// Returns the abscissae `t` at which `ln S` is needed, ascending.
    pub fn abscissae(&self) -> &[f64] {
        &self.logarithm.abscissae[..self.logarithm.kept]
    }

    /// Returns `ln S_+` at a point `q` that is further from the real axis than the strip of the rule
    /// for `ln S`.
    pub fn log_factor(&self, logs: &[f64], q: Complex64) -> Complex64 {
        let shares = logs.iter().enumerate();
        shares
            .map(|(i, log)| log * self.logarithm.share(q, i))
            .sum()
    }

    /// Returns the share of the residue of a pole at `zeta` that the sum over the nodes leaves out
    /// ([`share_of_pole`](crate::wiener_hopf::path::Rule::share_of_pole)).
    pub fn share_of_pole(&self, zeta: Complex64) -> Complex64 {
        let (digits, path) = (self.logarithm.digits, self.path);
        let radius = zeta / path.direction();
        path.rule()
            .share_of_pole(digits, self.knee, path.end(digits), radius)
    }

    /// Returns the line on which `S Y` is needed for profiles that are not even powers of the
    /// radius.
    pub fn turned_line(&self) -> &TurnedLine {
        self.turned_line
            .get_or_init(|| TurnedLine::new(self.path, &self.nodes, &self.logarithm))
    }

    /// Returns the number of real unknowns. `V` is real on the imaginary axis; elsewhere it has two
    /// parts, all real parts first.
    pub fn unknowns(&self) -> usize {
        self.nodes.len() * self.path.units().len()
    }

    /// Returns the number of values of `ln S_+`: first at the nodes, in the layout of the unknowns,
    /// then the phases at the readouts.
    pub fn rows(&self) -> usize {
        self.unknowns() + READOUTS
    }
}
