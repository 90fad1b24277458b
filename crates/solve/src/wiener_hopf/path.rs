//! The lines of the Wiener-Hopf method, and the trapezoidal rule on them.
//!
//! Integrals run from 0 to infinity along a line through the origin. With `|zeta| = e^l` and the
//! map
//!
//! ```text
//! l(u) = ln knee + u - c s(-u)^2,      s(y) = ln(1 + e^y)
//! ```
//!
//! the trapezoidal rule in `u` converges exponentially. Above the knee its nodes are equally spaced
//! in `ln |zeta|`. Below, the integrands are smooth but for logarithms and powers of `zeta` and
//! count in proportion to `|zeta|`: there the nodes thin out. For an error of `e^{-digits}` the
//! step is `2 pi strip / digits`, where `strip` is the angle between the line and the nearest
//! singularity. `digits` sets both ends of the line as well.

use std::f64::consts::PI;

use num_complex::Complex64;

use crate::compliance::FLAT;
use crate::domain::A_OVER_T;

/// The lines that the edges' coupling is integrated along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// The imaginary axis, where all unknowns are real. It leaves out the zeros of `S` off the
    /// axis.
    Axis,
    /// A ray and its mirror image below all zeros and poles of `S`. It leaves out nothing.
    Ray,
}

/// The rule that divides a line into nodes.
pub struct Rule {
    /// The angle to the nearest singularity, which sets the step.
    strip: f64,
    /// The constant `c` of the map, by which nodes thin out below the knee.
    thinning: f64,
}

impl Path {
    /// Returns the direction of the right half. It is exactly `i` for the axis, as parts that must
    /// cancel would remain in a direction that is off by 6e-17.
    pub fn direction(self) -> Complex64 {
        match self {
            Self::Axis => Complex64::I,
            Self::Ray => Complex64::from_polar(1.0, RAY),
        }
    }

    /// Returns the units of the parts of a node's strength `y`. On the imaginary axis its real part
    /// has no influence.
    pub fn units(self) -> &'static [Complex64] {
        match self {
            Self::Axis => &[Complex64::I],
            Self::Ray => &[Complex64::ONE, Complex64::I],
        }
    }

    /// Returns the radius where the kernel has fallen to `e^{-digits}`.
    pub fn end(self, digits: f64) -> f64 {
        0.5 * digits / self.direction().im
    }

    /// Returns the rule for the nodes.
    ///
    /// Beyond the strip, `e^{2 i zeta}` grows towards the real axis and `S` has zeros towards the
    /// imaginary one. Strip and thinning were determined with the contacts of
    /// `tests/data/contacts.csv`: larger values would begin to cost digits.
    pub fn rule(self) -> Rule {
        match self {
            Self::Axis => Rule {
                strip: 1.3,
                thinning: 0.35,
            },
            Self::Ray => Rule {
                strip: 0.45,
                thinning: 0.18,
            },
        }
    }
}

/// The angle of the ray, in radians: 32 degrees. The zeros and poles of `S` lie above 53 degrees
/// ([`SINE_OF_FREE_ANGLE`](crate::compliance::SINE_OF_FREE_ANGLE)).
pub const RAY: f64 = 0.55;

/// The rule for the integrals of `ln S`, which is smooth up to the zeros and poles of `S`.
const LOGARITHM: Rule = Rule {
    strip: 0.8,
    thinning: 0.3,
};

/// Returns the share of a strength `unit` at the node `zeta`, and of its mirror image, in `V(q)`.
pub fn influence(unit: Complex64, zeta: Complex64, q: Complex64) -> Complex64 {
    unit / (q + zeta) - unit.conj() / (q - zeta.conj())
}

/// The trapezoidal rule for `ln S_+`.
#[derive(Debug)]
pub struct Logarithm {
    /// The abscissae `t` of `ln S`, ascending.
    pub abscissae: Vec<f64>,
    /// The length that each one represents.
    steps: Vec<f64>,
    /// The number of abscissae at which `S` may differ from 1.
    pub kept: usize,
    /// `e^{-digits}` is the error of the rule.
    pub digits: f64,
}

impl Logarithm {
    pub fn new(digits: f64, knee: f64) -> Self {
        // The far end of the integral of 1 beyond the last abscissa of `ln S` is not zero.
        let last = FLAT * A_OVER_T[1];
        let (mut abscissae, mut steps) = LOGARITHM.nodes(digits, knee, last * digits.exp());
        abscissae.reverse();
        steps.reverse();
        let kept = abscissae.partition_point(|&t| t <= last);
        Self {
            abscissae,
            steps,
            kept,
            digits,
        }
    }

    /// Returns the factor of `ln S` at abscissa `i` in `ln S_+(q)`.
    pub fn share(&self, q: Complex64, i: usize) -> Complex64 {
        let (t, step) = (self.abscissae[i], self.steps[i]);
        q / (PI * Complex64::I) * step / (t * t - q * q)
    }

    /// Returns the factor of `ln S(q)` in `ln S_+(q)`, which removes the pole at `t = q` from the
    /// integrand.
    pub fn own(&self, q: Complex64) -> Complex64 {
        let sum: Complex64 = (0..self.abscissae.len()).map(|i| self.share(q, i)).sum();
        0.5 - sum
    }
}

impl Rule {
    /// Returns by how much the sum over the [nodes](Self::nodes) counts too little of the residue
    /// of a pole at `radius` right of the imaginary axis, where the line is this axis and the pole
    /// is below it: all of it but what the rule has of it by its finite step.
    ///
    /// With the nodes at `u_0 - j h` and the pole at `u` the share is `1/(1 - e^{-2 pi i (u - u_0)/h})`.
    pub fn share_of_pole(&self, digits: f64, knee: f64, end: f64, radius: Complex64) -> Complex64 {
        const STEPS: usize = 5;
        let log = (radius / knee).ln();
        let mut u = log;
        for _ in 0..STEPS {
            let bend = (1.0 + (-u).exp()).ln();
            u -= (u - self.thinning * bend * bend - log)
                / (1.0 + 2.0 * self.thinning * bend / (1.0 + u.exp()));
        }
        let turns = (u - (end / knee).ln()) / self.step(digits);
        1.0 / (1.0 - (-2.0 * PI * Complex64::I * turns).exp())
    }

    /// Returns the step in `u` for an error of `e^{-digits}`.
    fn step(&self, digits: f64) -> f64 {
        2.0 * PI * self.strip / digits
    }

    /// Returns the nodes, descending from `end`, and the length that each one represents.
    pub fn nodes(&self, digits: f64, knee: f64, end: f64) -> (Vec<f64>, Vec<f64>) {
        let h = self.step(digits);
        let mut nodes = (Vec::new(), Vec::new());
        let mut u = (end / knee).ln();
        loop {
            let bend = if u > -30.0 { (-u).exp().ln_1p() } else { -u };
            let log = u - self.thinning * bend * bend;
            if log < -digits {
                return nodes;
            }
            let radius = knee * log.exp();
            nodes.0.push(radius);
            nodes
                .1
                .push(radius * h * (1.0 + 2.0 * self.thinning * bend / (1.0 + u.exp())));
            u -= h;
        }
    }
}
