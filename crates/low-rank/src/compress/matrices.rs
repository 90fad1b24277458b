//! Singular value decompositions of unfoldings of tensors.

use faer::{Mat, MatRef};

/// Returns the left singular vectors of a matrix and their singular values, without the last ones,
/// which leave out at most `tail` (Frobenius norm).
///
/// They are those of the triangle of a QR decomposition of the transposed matrix, which is read in
/// blocks of rows. The matrix of scalar products would be faster and have half the digits.
pub(super) fn singular_vectors(matrix: MatRef<'_, f64>, tail: f64) -> (Mat<f64>, Vec<f64>) {
    const BLOCK: usize = 1024;
    let mut triangle: Mat<f64> = Mat::zeros(0, matrix.nrows());
    for first in (0..matrix.ncols()).step_by(BLOCK) {
        let above = triangle.nrows();
        let stacked = Mat::from_fn(
            above + BLOCK.min(matrix.ncols() - first),
            matrix.nrows(),
            |row, i| match row.checked_sub(above) {
                None => triangle[(row, i)],
                Some(row) => matrix[(i, first + row)],
            },
        );
        triangle = stacked.qr().thin_R().to_owned();
    }
    let decomposition = triangle
        .transpose()
        .thin_svd()
        .expect("the values hold no NaN");
    let mut values: Vec<f64> = decomposition.S().column_vector().iter().copied().collect();
    let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
    values.truncate(rank(&squares, tail));
    (
        decomposition.U().subcols(0, values.len()).to_owned(),
        values,
    )
}

/// Returns the entries of a matrix, row by row.
pub(super) fn row_major(matrix: MatRef<'_, f64>) -> impl Iterator<Item = f64> {
    (0..matrix.nrows())
        .flat_map(move |row| (0..matrix.ncols()).map(move |column| matrix[(row, column)]))
}

/// Returns the number of squares, one at least, that are left when the last ones are dropped, whose
/// sum is at most the square of `tail`.
pub(super) fn rank(squares: &[f64], tail: f64) -> usize {
    let mut dropped = 0.0;
    let small = squares.iter().rev().take_while(|&&square| {
        dropped += square;
        dropped <= tail * tail
    });
    (squares.len() - small.count()).max(1)
}

/// Returns the larger of two numbers, NaN if either is NaN: an error that is NaN must not pass for a
/// small one.
pub(super) const fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}
