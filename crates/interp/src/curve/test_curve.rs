//! A curve of known functions, for the tests of this folder.

use crate::{Curve, Material, Quantities};

/// Functions that are not those of any contact, but have bends and slopes.
pub(crate) fn exact(x: f64) -> Quantities {
    Quantities {
        pi0: 0.3 + x.ln().sin().exp(),
        eeq: x / (1.0 + x),
        gamma: (1.0 / (1.0 + x)).exp(),
        delta0: x.powf(0.1),
    }
}

/// The curve through these functions at `nodes`.
pub fn curve(nodes: &[f64]) -> Curve {
    let material = Material::new(1.75, 0.5, 1e5, 0.25).expect("physical");
    let nodes: Vec<(f64, Quantities)> = nodes.iter().map(|&x| (x, exact(x))).collect();
    Curve::through(&nodes, material).expect("sound nodes")
}

/// `n + 1` nodes from 1e-3 to 1e3, evenly spaced in the logarithm.
pub(crate) fn even(n: i32) -> Vec<f64> {
    (0..=n)
        .map(|i| 10_f64.powf(-3.0 + 6.0 / f64::from(n) * f64::from(i)))
        .collect()
}
