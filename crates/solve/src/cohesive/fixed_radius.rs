//! The contact of a fixed radius under any annulus: everything is linear in `1/R` and in the
//! traction.
//!
//! Lengths are in units of the thickness `h` of the top layer, moduli in the unit of the quantities,
//! and `tau = 2 sigma0`. On the annulus `g(s) = -tau sqrt(c^2 - s^2)` is known; the unknown is `g` on
//! the contact, with the operator `A` of JKR, and right-hand sides
//!
//! ```text
//! A g1 = 1        A g2 = s^2        A g3 = b(s) = (1/e1) (2/pi) int_0^inf (X-1) cos(qs) H(q) dq
//! g = delta g1 - g2/R + tau g3        g(a) = -tau sqrt(c^2 - a^2)
//! ```
//!
//! The last equation, that `g` is continuous, replaces the singularity of JKR and gives the
//! penetration `delta`. Edge values come from the equation at `s = a`,
//! `g(a) = es f(a) - (es/e1) (2/pi) int (X-1) cos(qa) G(q) dq`, with twice the digits of a sum of
//! Legendre polynomials. Load and opening at the outer radius are
//!
//! ```text
//! F = 2 [int_0^a g ds - tau int_a^c sqrt(c^2 - s^2) ds]
//! h(c) = (2/pi) int_a^c phi(s)/sqrt(c^2 - s^2) ds,        phi = theta - delta + s^2/R
//!      = (2/pi) { (1/R) int (s^2-a^2)/sqrt(..) + (tau/es) int [r - sqrt(..)]/sqrt(..) + (1/e1) (2/pi) int_0^inf (X-1) G(q) P(q) dq }
//! ```
//!
//! with `theta` the transform of the displacement and `G` that of `g` over `[0, c]`. `phi` vanishes at
//! `a`: the equation there is subtracted analytically, so that nothing cancels for a thin annulus.

use std::sync::Arc;

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

use crate::cohesive::annulus::{Annulus, TERMS};
use crate::compliance::surface::SurfaceCompliance;
use crate::compliance::symbol::Symbol;
use crate::galerkin::abscissae::Abscissae;
use crate::galerkin::operator::add_products;
use crate::galerkin::quadrature::{PanelWeights, Panels};
use crate::galerkin::slope::dot;
use crate::power_law::coefficients;
use crate::{estimate::larger, galerkin};

/// The accuracy of panels and modes.
const ACCURACY: f64 = 1e-14;

/// A contact of fixed radius.
pub struct FixedRadius<'a> {
    radius: f64,
    symbol: &'a Symbol<Arc<dyn SurfaceCompliance>>,
    factor: Llt<f64>,
    /// `g1` and `g2` as Legendre coefficients.
    fields: [Vec<f64>; 2],
    /// The abscissae for outer radii up to a multiple of the radius.
    waves: Vec<Waves>,
}

/// The wave numbers that resolve the oscillations of annuli up to an outer radius.
struct Waves {
    reach: f64,
    q: Vec<f64>,
    /// `(es/e1) (2/pi) (X-1) dq`.
    weights: Vec<f64>,
    /// `cos(q a)`.
    cosines: Vec<f64>,
    /// The transforms of the basis, one column after the other.
    bessel: Vec<f64>,
    /// The transforms of `g1` and `g2`.
    transforms: [Vec<f64>; 2],
    /// The edge values of `g1` and `g2`.
    edges: [f64; 2],
}

/// The part of a state that is proportional to `1/R`, or to `tau`.
#[derive(Clone, Debug)]
pub struct Part {
    /// The penetration.
    pub penetration: f64,
    /// The load.
    pub load: f64,
    /// The opening at the outer radius.
    pub opening: f64,
    /// `g` on the contact, as Legendre coefficients.
    pub field: Vec<f64>,
    /// `(es/e1) (2/pi) (X-1) G dq` at the wave numbers of the annulus.
    pub spectrum: Vec<f64>,
}

impl Part {
    /// Returns `weights[0] * parts[0] + weights[1] * parts[1]`.
    pub fn sum(parts: &[Self; 2], weights: [f64; 2]) -> Self {
        let number = |of: fn(&Self) -> f64| weights[0] * of(&parts[0]) + weights[1] * of(&parts[1]);
        let list = |of: fn(&Self) -> &Vec<f64>| {
            let pairs = of(&parts[0]).iter().zip(of(&parts[1]));
            pairs
                .map(|(a, b)| weights[0] * a + weights[1] * b)
                .collect()
        };
        Self {
            penetration: number(|part| part.penetration),
            load: number(|part| part.load),
            opening: number(|part| part.opening),
            field: list(|part| &part.field),
            spectrum: list(|part| &part.spectrum),
        }
    }
}

impl<'a> FixedRadius<'a> {
    /// Prepares the contact of a radius. `None` where rounding keeps the matrix from being positive
    /// definite.
    pub fn new(radius: f64, symbol: &'a Symbol<Arc<dyn SurfaceCompliance>>) -> Option<Self> {
        let modes = if symbol.contrast() == 0.0 {
            2
        } else {
            galerkin::modes(radius, ACCURACY)
        };
        let abscissae = abscissae(radius, radius, modes, symbol);
        let mut matrix = Mat::zeros(modes, modes);
        if let Some(abscissae) = &abscissae {
            let excesses = symbol.compliance().sample_all(&abscissae.q).excess;
            for block in abscissae.bessel_values().blocks() {
                let range = block.range();
                let weights: Vec<f64> = excesses[range.clone()]
                    .iter()
                    .zip(&abscissae.weights[range])
                    .map(|(excess, w)| symbol.film() * w * excess)
                    .collect();
                add_products(&mut matrix, block.values, &weights);
            }
        }
        for i in 0..modes {
            matrix[(i, i)] += 1.0;
        }
        let factor = Llt::new(matrix.as_ref(), Side::Lower).ok()?;
        let es = symbol.modulus();
        let solve = |exponent: f64| {
            let scale = es * radius.powf(exponent);
            let right: Vec<f64> = coefficients(exponent, modes).map(|c| scale * c).collect();
            solved(&factor, &right)
        };
        let fields = [0.0, 2.0].map(solve);
        Some(Self {
            radius,
            symbol,
            factor,
            fields,
            waves: Vec::new(),
        })
    }

    /// Returns the parts of the state with the annulus of `tan(phi)` that are proportional to `1/R`
    /// and to `tau`, and the wave numbers of their spectra.
    pub fn parts(&mut self, annulus: &Annulus) -> ([Part; 2], &[f64]) {
        let index = self.waves_for(annulus.outer);
        let waves = &self.waves[index];
        let (radius, es) = (self.radius, self.symbol.modulus());
        let rows = waves.q.len();
        let (h, p) = annulus.transforms(&waves.q, |n| &waves.bessel[n * rows..(n + 1) * rows]);

        let weighted: Vec<f64> = waves.weights.iter().zip(&h).map(|(w, h)| w * h).collect();
        let right: Vec<f64> = (0..self.fields[0].len())
            .map(|n| dot(&waves.bessel[n * rows..(n + 1) * rows], &weighted))
            .collect();
        let traction = solved(&self.factor, &right);
        let transform = waves.transform(radius, &traction);
        let edge: f64 = (0..rows)
            .map(|i| waves.weights[i] * waves.cosines[i] * (h[i] - transform[i]))
            .sum();

        let penetrations = [
            waves.edges[1] / waves.edges[0],
            -(annulus.root() + edge) / waves.edges[0],
        ];
        let field = |i: usize| -> Vec<f64> {
            let others = if i == 0 {
                self.fields[1].iter().map(|g| -g).collect()
            } else {
                traction.clone()
            };
            let flat = self.fields[0].iter().map(|g| penetrations[i] * g);
            flat.zip(others).map(|(a, b)| a + b).collect()
        };
        let spectrum = |i: usize| -> Vec<f64> {
            (0..rows)
                .map(|k| {
                    let other = if i == 0 {
                        -waves.transforms[1][k]
                    } else {
                        transform[k] - h[k]
                    };
                    waves.weights[k] * (penetrations[i] * waves.transforms[0][k] + other)
                })
                .collect()
        };
        let geometry = [
            annulus.opening_of_paraboloid(),
            annulus.opening_of_traction() / es,
        ];
        let outside = [0.0, -annulus.area()];
        let parts = [0, 1].map(|i| {
            let (field, spectrum) = (field(i), spectrum(i));
            let waves = dot(&spectrum, &p);
            Part {
                penetration: penetrations[i],
                load: 2.0 * (radius * field[0] + outside[i]),
                opening: std::f64::consts::FRAC_2_PI * (geometry[i] + waves / es),
                field,
                spectrum,
            }
        });
        (parts, &self.waves[index].q)
    }

    /// Returns the index of the wave numbers for an outer radius, and makes them if there are none.
    fn waves_for(&mut self, outer: f64) -> usize {
        /// The first reach over the contact radius, and every other over that before.
        const FIRST: f64 = 1.15;
        const STEP: f64 = 1.6;
        if let Some(index) = self.waves.iter().position(|waves| outer <= waves.reach) {
            return index;
        }
        let first = FIRST * self.radius;
        let mut reach = self.waves.last().map_or(first, |waves| waves.reach);
        while reach < outer {
            reach *= STEP;
        }
        self.waves.push(Waves::new(self, reach));
        self.waves.len() - 1
    }
}

impl Waves {
    fn new(contact: &FixedRadius<'_>, reach: f64) -> Self {
        let (radius, symbol) = (contact.radius, contact.symbol);
        let modes = contact.fields[0].len().max(TERMS);
        let (mut q, mut weights, mut bessel) = (Vec::new(), Vec::new(), Vec::new());
        if let Some(abscissae) = abscissae(radius, reach, modes, symbol) {
            let rows = abscissae.q.len();
            bessel.resize(rows * modes, 0.0);
            for block in abscissae.bessel_values().blocks() {
                for (n, column) in block.values.chunks_exact(block.rows).enumerate() {
                    bessel[n * rows + block.first..][..block.rows].copy_from_slice(column);
                }
            }
            let excesses = symbol.compliance().sample_all(&abscissae.q).excess;
            weights = excesses
                .iter()
                .zip(&abscissae.weights)
                .map(|(excess, w)| symbol.film() * w / radius * excess)
                .collect();
            q = abscissae.q;
        }
        let mut waves = Self {
            reach,
            cosines: q.iter().map(|q| (q * radius).cos()).collect(),
            q,
            weights,
            bessel,
            transforms: Default::default(),
            edges: [0.0; 2],
        };
        waves.transforms = [0, 1].map(|i| waves.transform(radius, &contact.fields[i]));
        waves.edges = [0, 1].map(|i| {
            let own = symbol.modulus() * radius.powi(2 * i as i32);
            let terms = waves
                .weights
                .iter()
                .zip(&waves.cosines)
                .zip(&waves.transforms[i]);
            own - terms.map(|((w, cosine), g)| w * cosine * g).sum::<f64>()
        });
        waves
    }

    /// Returns the transform `int_0^a g cos(qs) ds` of a field.
    fn transform(&self, radius: f64, field: &[f64]) -> Vec<f64> {
        let rows = self.q.len();
        let mut transform = vec![0.0; rows];
        for (n, g) in field.iter().enumerate() {
            let column = &self.bessel[n * rows..(n + 1) * rows];
            transform
                .iter_mut()
                .zip(column)
                .for_each(|(sum, j)| *sum += radius * g * j);
        }
        transform
    }
}

/// Returns the abscissae of a contact for annuli up to `reach`; none where `X = 1`.
fn abscissae(
    radius: f64,
    reach: f64,
    modes: usize,
    symbol: &Symbol<Arc<dyn SurfaceCompliance>>,
) -> Option<Abscissae> {
    let contrast = symbol.contrast();
    (contrast > 0.0).then(|| {
        let accuracy = ACCURACY / larger(contrast, 1.0);
        let panels = Panels::new(reach, [symbol.compliance()], PanelWeights::Waves, accuracy);
        Abscissae::new(radius, modes, panels)
    })
}

/// Solves `(1 + M) g = right`.
fn solved(factor: &Llt<f64>, right: &[f64]) -> Vec<f64> {
    let mut solution = Mat::from_fn(right.len(), 1, |i, _| right[i]);
    factor.solve_in_place(solution.as_mut());
    solution.col_as_slice(0).to_vec()
}
