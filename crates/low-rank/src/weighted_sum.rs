//! Weighted sums of rows, of which interpolation consists.

/// Adds rows, each times its weight, to `sum`.
///
/// Row `i` begins at `rows[i * stride]` and is as long as `sum`. Four rows are added at a time,
/// because the sum is not kept in registers.
pub fn add_rows(sum: &mut [f64], weights: &[f64], rows: &[f64], stride: usize) {
    let length = sum.len();
    let row = |i: usize| &rows[i * stride..][..length];
    let (groups, rest) = weights.as_chunks::<4>();
    for (i, &[p, q, r, s]) in groups.iter().enumerate() {
        let rows = row(4 * i)
            .iter()
            .zip(row(4 * i + 1))
            .zip(row(4 * i + 2).iter().zip(row(4 * i + 3)));
        for (sum, ((&a, &b), (&c, &d))) in sum.iter_mut().zip(rows) {
            *sum += (p * a + q * b) + (r * c + s * d);
        }
    }
    for (i, &weight) in rest.iter().enumerate() {
        for (sum, &value) in sum.iter_mut().zip(row(4 * groups.len() + i)) {
            *sum += weight * value;
        }
    }
}
