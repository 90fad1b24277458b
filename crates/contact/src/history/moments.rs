//! Integrals of an exponential over one step.

/// Below this exponent the integrals are summed as series, which lose no digits.
const SERIES: f64 = 0.5;

/// Returns `exp(-z)` and `I_j = int_0^1 exp(-z y) y^j dy` for `j = 0, 1, 2`.
pub(super) fn moments(z: f64) -> (f64, [f64; 3]) {
    if z < SERIES {
        let mut integrals = [0.0; 3];
        let (mut term, mut n) = (1.0_f64, 0.0);
        while term.abs() > 1e-18 {
            for (j, integral) in integrals.iter_mut().enumerate() {
                *integral += term / (n + 1.0 + j as f64);
            }
            n += 1.0;
            term *= -z / n;
        }
        return ((-z).exp(), integrals);
    }
    let e = (-z).exp();
    let i0 = (1.0 - e) / z;
    let i1 = (i0 - e) / z;
    (e, [i0, i1, (2.0 * i1 - e) / z])
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
        }
    }
}
