//! Lagrange polynomials as coefficients of powers.

/// Returns the coefficients of `1, t, t^2, ...` of the polynomials that are 1 at one of the `points`
/// and 0 at the others. If all points coincide, the first polynomial is 1 and the others are 0.
pub const fn lagrange<const N: usize>(points: &[f64; N]) -> [[f64; N]; N] {
    let mut all = [[0.0; N]; N];
    if points[0] == points[N - 1] {
        all[0][0] = 1.0;
        return all;
    }
    let mut i = 0;
    while i < N {
        let mut own = [0.0; N];
        own[0] = 1.0;
        let mut j = 0;
        while j < N {
            if j != i {
                // Times `(t - points[j])/(points[i] - points[j])`.
                let distance = points[i] - points[j];
                let mut k = N;
                while k > 0 {
                    k -= 1;
                    let lower = if k > 0 { own[k - 1] } else { 0.0 };
                    own[k] = (lower - points[j] * own[k]) / distance;
                }
            }
            j += 1;
        }
        all[i] = own;
        i += 1;
    }
    all
}
