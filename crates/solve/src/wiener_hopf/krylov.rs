//! Minimal residuals for `(1 - M) v = b` and `(1 + M) v = b` at once.
//!
//! Both systems have one Krylov space, spanned by `b, M b, M^2 b, ...`: one Arnoldi process serves
//! both.

use fearless_simd::{Level, dispatch};

use crate::estimate::larger;
use crate::galerkin::slope::dot;

/// The number of steps for which memory is taken at once. Most contacts need fewer.
const USUAL_STEPS: usize = 16;

/// Solves `(1 - M) v = b` and `(1 + M) v = b`, and returns both `v` in this order.
///
/// `apply(v, out)` overwrites `out` with `M v`. The iteration ends when both residuals are below
/// `tolerance` times `|b|`, or after one step for each unknown.
pub fn solve(
    b: &[f64],
    tolerance: f64,
    mut apply: impl FnMut(&[f64], &mut [f64]),
) -> [Vec<f64>; 2] {
    let n = b.len();
    let norm = dot(b, b).sqrt();
    let mut basis = Vec::with_capacity(USUAL_STEPS * n);
    basis.extend(b.iter().map(|b| b / norm));
    let mut problems = [-1.0, 1.0].map(LeastSquares::new);
    let mut steps = 0;
    let mut next = vec![0.0; n];
    let mut projections = Vec::with_capacity(USUAL_STEPS + 1);
    loop {
        apply(&basis[steps * n..], &mut next);
        steps += 1;
        projections.clear();
        projections.resize(steps + 1, 0.0);
        // Twice is enough: the basis is then orthogonal to rounding.
        for _ in 0..2 {
            dispatch!(Level::new(), _simd => orthogonalise(&basis, &mut next, &mut projections));
        }
        let length = dot(&next, &next).sqrt();
        projections[steps] = length;
        let residual = problems
            .iter_mut()
            .map(|problem| problem.add(&projections))
            .fold(0.0, larger);
        if residual <= tolerance || residual.is_nan() || steps == n || length == 0.0 {
            break;
        }
        basis.extend(next.iter().map(|next| next / length));
    }
    problems.map(|problem| {
        let mut solution = vec![0.0; n];
        for (vector, factor) in basis.chunks_exact(n).zip(problem.coefficients()) {
            solution
                .iter_mut()
                .zip(vector)
                .for_each(|(s, v)| *s += norm * factor * v);
        }
        solution
    })
}

/// Takes from `next` its parts along the vectors of `basis`, and adds them to `projections`.
// Inlined, with all that it calls, into code with vector instructions.
#[inline(always)]
fn orthogonalise(basis: &[f64], next: &mut [f64], projections: &mut [f64]) {
    for (vector, projection) in basis.chunks_exact(next.len()).zip(projections) {
        let part = dot(vector, next);
        *projection += part;
        for (next, v) in next.iter_mut().zip(vector) {
            *next -= part * v;
        }
    }
}

/// The least-squares problem `|e_0 - (1 + sign H) y|` over a growing Hessenberg matrix `H`, reduced
/// by Givens rotations.
struct LeastSquares {
    /// The sign of `H`, 1 or -1.
    sign: f64,
    /// The columns of the triangle, one after the other.
    triangle: Vec<f64>,
    /// The cosine and sine of each rotation.
    rotations: Vec<[f64; 2]>,
    /// The rotated right-hand side; its last element is the residual.
    right: Vec<f64>,
}

impl LeastSquares {
    /// Begins with an empty matrix.
    fn new(sign: f64) -> Self {
        let mut right = Vec::with_capacity(USUAL_STEPS + 1);
        right.push(1.0);
        Self {
            sign,
            triangle: Vec::with_capacity(USUAL_STEPS * (USUAL_STEPS + 3) / 2),
            rotations: Vec::with_capacity(USUAL_STEPS),
            right,
        }
    }

    /// Adds a column of `H` and returns the residual.
    fn add(&mut self, column: &[f64]) -> f64 {
        let (last, begin) = (column.len() - 2, self.triangle.len());
        self.triangle.extend(column.iter().map(|h| self.sign * h));
        let column = &mut self.triangle[begin..];
        column[last] += 1.0;
        for (i, [c, s]) in self.rotations.iter().enumerate() {
            (column[i], column[i + 1]) = (
                c * column[i] + s * column[i + 1],
                c * column[i + 1] - s * column[i],
            );
        }
        let length = (column[last] * column[last] + column[last + 1] * column[last + 1]).sqrt();
        let [c, s] = if length > 0.0 {
            [column[last] / length, column[last + 1] / length]
        } else {
            [1.0, 0.0]
        };
        column[last] = length;
        self.triangle.pop();
        self.rotations.push([c, s]);
        let right = self.right[last];
        self.right[last] = c * right;
        self.right.push(-s * right);
        (s * right).abs()
    }

    /// Returns the solution `y` by back substitution.
    fn coefficients(&self) -> Vec<f64> {
        let n = self.rotations.len();
        let mut y = self.right[..n].to_vec();
        for j in (0..n).rev() {
            let column = &self.triangle[j * (j + 1) / 2..][..=j];
            y[j] /= column[j];
            let y_j = y[j];
            y[..j]
                .iter_mut()
                .zip(column)
                .for_each(|(y, t)| *y -= t * y_j);
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix of rank one is done after two steps, and an exact start ends at once.
    #[test]
    fn a_small_krylov_space_ends_the_process() {
        let mut calls = 0;
        let [minus, plus] = solve(&[1.0, 1.0], 1e-15, |v, out| {
            calls += 1;
            out.copy_from_slice(&[0.5 * v[0], 0.5 * v[1]]);
        });
        assert_eq!(calls, 1);
        for (v, expected) in [(minus, 2.0), (plus, 2.0 / 3.0)] {
            assert!(v.iter().all(|v| (v - expected).abs() < 1e-14), "{v:?}");
        }
    }
}
