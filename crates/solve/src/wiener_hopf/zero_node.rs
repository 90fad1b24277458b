//! A zero of `S` as one more node of the imaginary axis.
//!
//! The line of integration of equation (2) of `wiener_hopf.rs` passes below the
//! zeros of `S`, the imaginary axis above those that are off it. A zero `zeta` between them, and its
//! mirror image, add their residues
//!
//! ```text
//! s [y/(z + zeta) - conj(y)/(z - conj(zeta))],      y = e^{2 i zeta} S_+(zeta)^2/S'(zeta) V(zeta)
//! ```
//!
//! to `V(z)`, as a node of the strength `y` does. `V(zeta)` is one more complex unknown. The pole
//! near the line also costs the sum over the nodes its accuracy. What the sum has of the residue
//! by its finite step is known, and is taken from it
//! ([`share_of_pole`](crate::wiener_hopf::path::Rule::share_of_pole)).

use num_complex::Complex64;

use crate::compliance::zero::Zero;
use crate::wiener_hopf::contour::Contour;
use crate::wiener_hopf::path::influence;

/// The node of one zero, for one contact on one contour along the imaginary axis.
pub struct ZeroNode {
    zeta: Complex64,
    /// The strength over `V`.
    coupling: Complex64,
    /// The influence of the real and the imaginary part of the strength on each node of the
    /// contour, which is real.
    on_nodes: Vec<[f64; 2]>,
    /// The influence of the strength of each of them here.
    of_nodes: Vec<Complex64>,
}

impl ZeroNode {
    /// Places a node at `zero` for a contact at `x = a/t`. `logs` holds `ln S` at the abscissae of
    /// the contour.
    pub fn new(x: f64, zero: Zero, contour: &Contour, logs: &[f64]) -> Self {
        let zeta = zero.at * x;
        let log = 2.0 * (Complex64::I * zeta + contour.log_factor(logs, zeta));
        let units = [Complex64::ONE, Complex64::I];
        let nodes = || contour.nodes.iter();
        Self {
            zeta,
            coupling: log.exp() * x / zero.slope * contour.share_of_pole(zeta),
            on_nodes: nodes()
                .map(|&node| units.map(|unit| influence(unit, zeta, node).re))
                .collect(),
            of_nodes: nodes()
                .map(|&node| influence(Complex64::I, node, zeta))
                .collect(),
        }
    }

    /// Returns the strength of the node from the real and the imaginary part of `V` there.
    pub fn strength(&self, v: &[f64]) -> Complex64 {
        self.coupling * Complex64::new(v[0], v[1])
    }

    /// Returns the influence of the node with this `strength` at `q`.
    pub fn influence(&self, strength: Complex64, q: Complex64) -> Complex64 {
        influence(strength, self.zeta, q)
    }

    /// Completes a product with the matrix of the coupling: adds the influence of this node to the
    /// values at the nodes of the contour, of these `strengths`, and returns the value here.
    pub fn couple(&self, strength: Complex64, strengths: &[f64], values: &mut [f64]) -> Complex64 {
        for (value, [re, im]) in values.iter_mut().zip(&self.on_nodes) {
            *value += re * strength.re + im * strength.im;
        }
        let of_nodes = strengths.iter().zip(&self.of_nodes);
        self.influence(strength, self.zeta)
            + of_nodes.map(|(y, of_node)| y * of_node).sum::<Complex64>()
    }
}
