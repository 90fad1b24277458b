//! Integrals of an exponential over one step.

/// Below this exponent the integrals are summed as series, which lose no digits.
const SERIES: f64 = 0.5;

/// Returns `exp(-z)` and `I_j = int_0^1 exp(-z y) y^j dy` for `j = 0, 1, 2`.
pub(super) fn moments(z: f64) -> (f64, [f64; 3]) {
    let e = (-z).exp();
    if z < SERIES {
        // The recurrence loses no digits in this direction.
        let (mut term, mut n, mut i2) = (1.0, 0.0, 0.0);
        while f64::abs(term) > 1e-17 {
            i2 += term / (n + 3.0);
            n += 1.0;
            term *= -z / n;
        }
        let i1 = 0.5 * (z * i2 + e);
        return (e, [z * i1 + e, i1, i2]);
    }
    let i0 = (1.0 - e) / z;
    let i1 = (i0 - e) / z;
    (e, [i0, i1, (2.0 * i1 - e) / z])
}

/// Returns the coefficients of `dF/dy` of a load that is a cubic polynomial, with `y` from 1 at the
/// beginning of a step to 0 at its end, from load and stiffness there and the `rise` between them.
pub(super) fn slopes((f0, s0): (f64, f64), (f1, s1): (f64, f64), rise: f64) -> [f64; 3] {
    let (d0, d1, d) = (s0 * rise, s1 * rise, f1 - f0);
    [d1, 6.0 * d - 2.0 * d0 - 4.0 * d1, 3.0 * (d0 + d1) - 6.0 * d]
}

/// Returns `1 - int_0^1 exp(-z y) dy`.
pub(super) fn one_less_mean(z: f64) -> f64 {
    if z < SERIES {
        // int_0^1 (1 - exp(-z y)) dy = z int_0^1 exp(-z y) (1 - y) dy
        let (_, [i0, i1, _]) = moments(z);
        return z * (i0 - i1);
    }
    1.0 - mean(z)
}

/// Returns `int_0^1 exp(-z y) dy`.
pub(super) fn mean(z: f64) -> f64 {
    if z < 1e-8 {
        1.0 - 0.5 * z
    } else {
        -(-z).exp_m1() / z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On both sides of the switch, against each other and against the limits.
    #[test]
    fn both_forms_agree_at_the_switch() {
        let (below, above) = (moments(SERIES.next_down()).1, moments(SERIES).1);
        for (below, above) in below.into_iter().zip(above) {
            assert!((below / above - 1.0).abs() < 1e-14, "{below} {above}");
        }
        assert_eq!(moments(0.0).1, [1.0, 0.5, 1.0 / 3.0]);
        for (j, factorial) in [1.0, 1.0, 2.0].into_iter().enumerate() {
            let z: f64 = 1e5;
            assert!((moments(z).1[j] * z.powi(j as i32 + 1) / factorial - 1.0).abs() < 1e-14);
        }
        for z in [0.0, 1e-12, 1e-3, 0.7, 40.0] {
            assert!((mean(z) / moments(z).1[0] - 1.0).abs() < 1e-14, "{z}");
            assert!((one_less_mean(z) - (1.0 - mean(z))).abs() < 1e-15, "{z}");
        }
    }
}
