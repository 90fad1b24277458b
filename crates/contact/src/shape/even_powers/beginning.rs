//! Load and penetration on a thick film, with which the ladder begins.

use super::weights::Weights;

/// Load and penetration of a shape, or their slopes with respect to `ln a`, in units of the grid:
/// `F0/(E* es)` and `delta0`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub(super) load: f64,
    pub(super) penetration: f64,
}

/// The contact up to the first node: a thick film, whose kernel is `alpha + beta (rho^2 + s^2)`, see
/// the page `interp/src/curve/thick_film.rs` of the source.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    /// `alpha` and `beta` at the first node.
    alpha: f64,
    beta: f64,
    /// The first node, in units of the grid.
    pub(super) first: f64,
}

/// The kernel at one contact radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    pub(super) alpha: f64,
    pub(super) beta: f64,
    pub(super) y: f64,
}

impl Kernel {
    /// Returns the moments of order 0 and 2 of the solution for the right-hand side `rho^n`.
    fn solve(&self, n: f64) -> [f64; 2] {
        let Self { alpha, beta, .. } = *self;
        let (a, b) = (1.0 + alpha + beta / 3.0, beta);
        let (c, d) = (alpha / 3.0 + beta / 5.0, 1.0 + beta / 3.0);
        let (f0, f2) = (1.0 / (n + 1.0), 1.0 / (n + 3.0));
        let determinant = a * d - b * c;
        [
            (d * f0 - b * f2) / determinant,
            (a * f2 - c * f0) / determinant,
        ]
    }

    /// Returns the value at the edge of the solution for the right-hand side `rho^n`.
    fn edge(&self, n: f64) -> f64 {
        let [m0, m2] = self.solve(n);
        1.0 - (self.alpha + self.beta) * m0 - self.beta * m2
    }

    /// Returns `y^n Delta_n`.
    pub(super) fn penetration(&self, n: usize) -> f64 {
        self.y.powi(n as i32) * self.edge(n as f64) / self.edge(0.0)
    }

    /// Returns `y^(n+1) mu_n/es`.
    pub(super) fn moment(&self, n: usize) -> f64 {
        let [m0, m2] = self.solve(0.0);
        let order = n as f64;
        let moment = (1.0 - self.alpha * m0 - self.beta * m2) / (order + 1.0)
            - self.beta * m0 / (order + 3.0);
        self.y.powi(n as i32 + 1) * moment
    }

    /// Returns load and penetration of a shape.
    pub(super) fn sums(&self, weights: &Weights) -> Sums {
        let stiffness = self.moment(0);
        let mut sums = Sums::default();
        for (k, beta) in weights.beta.iter().enumerate().take(weights.terms) {
            let n = 2 * k + 2;
            let factor = beta / (n * (n - 1)) as f64;
            let penetration = self.penetration(n);
            sums.penetration += factor * penetration;
            sums.load += 4.0 * factor * (penetration * stiffness - self.moment(n));
        }
        sums
    }

    /// Returns the slopes of load and penetration of a shape with respect to `ln a`.
    pub(super) fn slopes(&self, weights: &Weights) -> Sums {
        let beta = weights.beta.iter().enumerate().take(weights.terms);
        let flux: f64 = beta.map(|(k, beta)| beta * self.moment(2 * k)).sum();
        let penetration = self.y * flux / self.edge(0.0).powi(2);
        Sums {
            load: 4.0 * self.moment(0) * penetration,
            penetration,
        }
    }

    /// Returns the departure of the penetration from that on a half-space per `alpha`: `1 - int b/(a
    /// b)`.
    pub(super) fn share(&self, weights: &Weights) -> f64 {
        let square = self.y * self.y;
        let (mut value, mut mean, mut power) = (0.0, 0.0, 1.0);
        for (k, beta) in weights.beta.iter().enumerate().take(weights.terms) {
            let n = (2 * k + 2) as f64;
            let term = power * beta / (n * (n - 1.0));
            value += term;
            mean += term / (n + 1.0);
            power *= square;
        }
        1.0 - mean / value
    }
}

impl Beginning {
    /// Finds the kernel from the quantities at the first node, which are over `es`.
    pub(super) fn new([pi0, eeq]: [f64; 2], first: f64) -> Self {
        let u = 0.375 * pi0 - 1.0;
        Self {
            alpha: 1.0 / eeq - 1.0 - u,
            beta: 1.5 * u,
            first,
        }
    }

    /// Returns the kernel at a contact radius up to the first node, in units of the grid.
    pub(super) fn at(&self, y: f64) -> Kernel {
        let ratio = y / self.first;
        Kernel {
            alpha: ratio * self.alpha,
            beta: ratio.powi(3) * self.beta,
            y,
        }
    }
}
