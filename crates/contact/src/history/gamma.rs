//! The gamma function.

use std::f64::consts::PI;

/// Lanczos' coefficients for `g = 7` and nine terms (Godfrey's, relative error 1e-15).
const COEFFICIENTS: [f64; 9] = [
    0.999_999_999_999_809_9,
    676.520_368_121_885_1,
    -1_259.139_216_722_402_8,
    771.323_428_777_653_1,
    -176.615_029_162_140_6,
    12.507_343_278_686_905,
    -0.138_571_095_265_720_12,
    9.984_369_578_019_572e-6,
    1.505_632_735_149_311_6e-7,
];

/// Returns `Gamma(x)` for a positive `x`.
pub(super) fn gamma(x: f64) -> f64 {
    if x < 0.5 {
        return PI / ((PI * x).sin() * gamma(1.0 - x));
    }
    let x = x - 1.0;
    let terms = COEFFICIENTS[1..].iter().enumerate();
    let sum: f64 = COEFFICIENTS[0] + terms.map(|(i, c)| c / (x + 1.0 + i as f64)).sum::<f64>();
    let t = x + 7.5;
    (2.0 * PI).sqrt() * t.powf(x + 0.5) * (-t).exp() * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_and_half_numbers() {
        let cases = [
            (1.0, 1.0),
            (5.0, 24.0),
            (0.5, PI.sqrt()),
            (1.5, 0.5 * PI.sqrt()),
        ];
        for (x, exact) in cases {
            assert!((gamma(x) / exact - 1.0).abs() < 1e-14, "{x}");
        }
        // Gamma(x) ~ 1/x - Euler's constant
        assert!((gamma(1e-3) - (1e3 - 0.577_215_664_9 + 0.989_055_995e-3)).abs() < 1e-6);
    }
}
