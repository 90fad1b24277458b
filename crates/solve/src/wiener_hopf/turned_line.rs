//! The fields of the two edges on a line that leaves the real axis, for profiles whose transform is
//! not a Taylor coefficient.
//!
//! The moments of [`moment`](crate::wiener_hopf::moment) integrate `a(z)` and `b(z)` along the real axis
//! to infinity, where they oscillate. From [`CORNER`] on the integral is turned into the upper half
//! plane: `a = Re E_even` and `b = Im E_odd` with `E = e^{iz} S_+ V/S`, and
//!
//! ```text
//! int_c^inf a z^{-p} dz = Re int_line E_even z^{-p} dz,      line: z = c + r e^{i angle}
//! ```
//!
//! along a line parallel to the ray of [`Path::Ray`], below which `S` has no zeros: none of them is
//! left out. There `E` falls like `e^{-Im z}`. Gauss-Legendre panels grow in proportion to `|z|`, as
//! the zeros of `S` lie at angles of 53 degrees and more, up to a length that resolves `e^{iz}`.

use num_complex::Complex64;

use crate::galerkin::quadrature::GaussLegendre;
use crate::wiener_hopf::matrix::Matrix;
use crate::wiener_hopf::path::{Logarithm, Path, RAY, influence};

/// The place at which the line leaves the real axis. The polynomial through the readouts serves up
/// to there: its coefficients would cancel further out, and the integrands vary faster closer to 0.
pub const CORNER: f64 = 1.0;

/// The abscissae of a panel.
const POINTS: usize = 20;
/// The longest panel, which resolves `e^{iz}`.
const LONGEST: f64 = 14.0;

/// One line, divided into nodes for one accuracy and one knee.
#[derive(Debug)]
pub struct TurnedLine {
    /// The nodes `z`.
    pub nodes: Vec<Complex64>,
    /// `e^{iz} dz`.
    pub weights: Vec<Complex64>,
    /// The matrix from `ln S` at the abscissae of the contour to `ln S_+` at the nodes: real parts,
    /// then imaginary parts.
    pub factor: Matrix,
    /// The factor from `ln S` at a node to `ln S_+` there.
    pub own: Vec<Complex64>,
    /// The matrix from the strengths of the contour's nodes to `V` here, in the same layout.
    pub readout: Matrix,
}

impl TurnedLine {
    /// Divides the line for the contour that has the nodes `zeta` and the rule for `ln S_+`.
    pub(super) fn new(path: Path, zeta: &[Complex64], logarithm: &Logarithm) -> Self {
        let direction = Complex64::from_polar(1.0, RAY);
        let end = CORNER + logarithm.digits / direction.im;
        let rule = GaussLegendre::new(POINTS);
        let (mut nodes, mut weights) = (Vec::new(), Vec::new());
        let mut from = CORNER;
        while from < end {
            let half = 0.5 * from.min(LONGEST);
            for (abscissa, weight) in rule.abscissae.iter().zip(&rule.weights) {
                let z = CORNER + direction * (from - CORNER + half * (1.0 + abscissa));
                nodes.push(z);
                weights.push((Complex64::I * z).exp() * direction * (half * weight));
            }
            from += 2.0 * half;
        }
        let mut factor = Vec::new();
        for i in 0..logarithm.kept {
            factor.extend(nodes.iter().map(|&z| logarithm.share(z, i).re));
            factor.extend(nodes.iter().map(|&z| logarithm.share(z, i).im));
        }
        let mut readout = Vec::new();
        for &unit in path.units() {
            for &zeta in zeta {
                readout.extend(nodes.iter().map(|&z| influence(unit, zeta, z).re));
                readout.extend(nodes.iter().map(|&z| influence(unit, zeta, z).im));
            }
        }
        let rows = 2 * nodes.len();
        Self {
            own: nodes.iter().map(|&z| logarithm.own(z)).collect(),
            nodes,
            weights,
            factor: Matrix::from_columns(rows, &factor),
            readout: Matrix::from_columns(rows, &readout),
        }
    }
}
