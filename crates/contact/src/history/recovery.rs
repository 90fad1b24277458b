//! How an element moves outside the contact, exactly, and the change from and to its memories in contact.

use super::exponentials::{Creep, Exponentials};

/// An element outside the contact, where `N = 0`: `psi` is a constant and a sum of exponentials, whose rates are those
/// of the creep compliance.
impl Creep {
    /// Returns the amplitudes of an element that is released with `psi` and its memories.
    pub fn released(&self, law: &Exponentials, psi: f64, memories: &[f64]) -> Vec<f64> {
        let amplitude = |(rate, compliance): (&f64, &f64)| {
            let terms = law.weights.iter().zip(&law.rates).zip(memories);
            let sum: f64 = terms
                .map(|((weight, own), memory)| weight * (psi - memory) / (own - rate))
                .sum();
            (sum + law.impulse * psi) * compliance * rate
        };
        self.rates
            .iter()
            .zip(&self.amplitudes)
            .map(amplitude)
            .collect()
    }

    /// Returns the memories of an element with some amplitudes.
    pub fn memories(&self, law: &Exponentials, amplitudes: &[f64]) -> Vec<f64> {
        let memory = |own: &f64| {
            let terms = self.rates.iter().zip(amplitudes);
            terms
                .map(|(rate, amplitude)| -amplitude * rate / (own - rate))
                .sum()
        };
        law.rates.iter().map(memory).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Maxwell chain with an impulse and without: what is released and touches at once remembers the same.
    #[test]
    fn a_release_and_a_touch_change_nothing() {
        for (constant, impulse) in [(0.2, 0.0), (0.2, 1e-3), (0.0, 1e-3)] {
            let law = Exponentials {
                constant,
                weights: vec![0.3, 0.1, 0.4],
                rates: vec![0.1, 1.0, 20.0],
                impulse,
                second_impulse: 0.0,
                error: 0.0,
            };
            let recovery = law.creep();
            // Two memories are any, and the third such that nothing acts on the element.
            let (psi, mut memories) = (1.0, vec![0.5, -0.3, 0.0]);
            let terms = law.weights.iter().zip(&memories);
            let acting = constant * psi + terms.map(|(w, m)| w * m).sum::<f64>();
            if impulse == 0.0 {
                memories[2] = -acting / law.weights[2];
            }
            let amplitudes = recovery.released(&law, psi, &memories);
            for (a, b) in recovery.memories(&law, &amplitudes).iter().zip(&memories) {
                assert!((a - b).abs() < 1e-12, "{constant} {impulse}: {a} {b}");
            }
            let sum: f64 = amplitudes.iter().sum();
            assert!(constant == 0.0 || (sum - psi).abs() < 1e-12, "{sum}");
        }
    }
}
