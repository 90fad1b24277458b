//! Weighted sums of rows, all that the interpolation along the material axes consists of.

/// Adds the weighted sum of rows, one each `stride` numbers, as long as the sum. [f64; 4] at once,
/// because the sum is not kept in registers.
pub(crate) fn add_rows(sum: &mut [f64], weights: &[f64], rows: &[f64], stride: usize) {
    let length = sum.len();
    let row = |i: usize| &rows[i * stride..][..length];
    let (fours, rest) = weights.as_chunks::<4>();
    for (i, &[p, q, r, s]) in fours.iter().enumerate() {
        let rows = row(4 * i)
            .iter()
            .zip(row(4 * i + 1))
            .zip(row(4 * i + 2).iter().zip(row(4 * i + 3)));
        for (sum, ((&a, &b), (&c, &d))) in sum.iter_mut().zip(rows) {
            *sum += (p * a + q * b) + (r * c + s * d);
        }
    }
    for (i, &weight) in rest.iter().enumerate() {
        for (sum, &value) in sum.iter_mut().zip(row(4 * fours.len() + i)) {
            *sum += weight * value;
        }
    }
}
