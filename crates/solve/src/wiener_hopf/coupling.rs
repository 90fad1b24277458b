//! Equation (2) of `wiener_hopf.rs`, the coupling of the two edges, and its solution.

use num_complex::Complex64;

use crate::compliance::symbol::Symbol;
use crate::wiener_hopf::contour::Contour;
use crate::wiener_hopf::krylov;
use crate::wiener_hopf::path::Path;
use crate::wiener_hopf::zero_node::ZeroNode;

/// Returns the factors of `V` at the nodes in (2): `e^{2 i zeta} S_+^2/S d zeta/(2 pi i)`; on the
/// imaginary axis the imaginary parts alone, as the rest has no influence there.
pub fn couplings(
    x: f64,
    symbol: &Symbol,
    contour: &Contour,
    log_factors: &[f64],
) -> Vec<Complex64> {
    /// The `S(0)` up to which no constant is subtracted: it would add more than it removes.
    const SMALL: f64 = 0.3;
    let nodes = contour.nodes.iter();
    match contour.path {
        Path::Axis => {
            let p: Vec<f64> = nodes.map(|zeta| zeta.im / x).collect();
            let inverses = symbol.inverses_on_axis(&p);
            let factors = contour.weights.iter().zip(log_factors);
            factors
                .zip(inverses)
                .map(|((weight, log), inverse)| {
                    Complex64::new(0.0, weight.re * (2.0 * log).exp() * inverse)
                })
                .collect()
        }
        Path::Ray => {
            let long_waves = symbol.at(0.0);
            let constant = if long_waves > SMALL {
                1.0 / long_waves
            } else {
                0.0
            };
            let coupling = |(j, (&zeta, weight)): (usize, (&Complex64, &Complex64))| {
                let s = symbol.at(zeta / x);
                let log_factor =
                    Complex64::new(log_factors[j], log_factors[contour.nodes.len() + j])
                        + contour.own[j] * s.ln();
                weight * (2.0 * log_factor).exp() * (1.0 / s - constant)
            };
            nodes
                .zip(&contour.weights)
                .enumerate()
                .map(coupling)
                .collect()
        }
    }
}

/// Overwrites `strengths` with the strengths of the nodes, the values `v` of `V` there times
/// `couplings`, in the layout of the unknowns.
fn strengths(path: Path, couplings: &[Complex64], v: &[f64], strengths: &mut Vec<f64>) {
    strengths.clear();
    match path {
        Path::Axis => {
            strengths.extend(v.iter().zip(couplings).map(|(v, coupling)| v * coupling.im))
        }
        Path::Ray => {
            let (re, im) = v.split_at(couplings.len());
            let parts = || couplings.iter().zip(re.iter().zip(im));
            strengths.extend(parts().map(|(c, (re, im))| c.re * re - c.im * im));
            strengths.extend(parts().map(|(c, (re, im))| c.re * im + c.im * re));
        }
    }
}

/// The strengths of the nodes of one parity.
pub struct Strengths {
    /// Those of the contour, in the layout of the unknowns.
    pub nodes: Vec<f64>,
    /// That of the zero; 0 without one.
    pub zero: Complex64,
}

/// Solves (2) and returns the strengths of the nodes, for the even and for the odd fields.
pub fn solve(
    contour: &Contour,
    couplings: &[Complex64],
    zero: Option<&ZeroNode>,
    accuracy: f64,
) -> [Strengths; 2] {
    /// The residual over the accuracy of the contour, as far as rounding allows.
    const SHARE: f64 = 0.01;
    let unknowns = contour.unknowns();
    let mut one = vec![1.0; contour.nodes.len()];
    one.resize(unknowns, 0.0);
    if zero.is_some() {
        one.extend([1.0, 0.0]);
    }
    let mut work = Vec::with_capacity(unknowns);
    let solutions = krylov::solve(&one, (SHARE * accuracy).max(f64::EPSILON), |v, out| {
        let (v, v_of_zero) = v.split_at(unknowns);
        let (out, out_of_zero) = out.split_at_mut(unknowns);
        strengths(contour.path, couplings, v, &mut work);
        contour.kernel.multiply(&work, out);
        if let Some(zero) = zero {
            let value = zero.couple(zero.strength(v_of_zero), &work, out);
            out_of_zero.copy_from_slice(&[value.re, value.im]);
        }
    });
    solutions.map(|v| {
        let (v, v_of_zero) = v.split_at(unknowns);
        let mut nodes = Vec::with_capacity(unknowns);
        strengths(contour.path, couplings, v, &mut nodes);
        Strengths {
            nodes,
            zero: zero.map_or(Complex64::ZERO, |zero| zero.strength(v_of_zero)),
        }
    })
}
