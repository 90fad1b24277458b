//! JKR's contact, the limit of a short range: where a search of the pull-off begins.

use std::f64::consts::{FRAC_PI_2, PI};

use contact::Control;

use crate::cohesive::Cohesive;
use crate::cohesive::search::Point;
use crate::galerkin;

/// The relative tolerance of the solves.
const TOLERANCE: f64 = 1e-4;

/// The step in the logarithm of the radius. Two minima that are closer count as one.
const STEP: f64 = 0.25;

/// The largest contact radius, over the thickness of the top layer, that is solved.
const LARGEST_A_OVER_T: f64 = 1000.0;

impl Cohesive {
    /// Returns the length of a short cohesive zone, `(pi/4) es w/sigma0^2`.
    pub(super) fn zone(&self) -> f64 {
        FRAC_PI_2 * self.symbol.modulus() * self.range / self.traction
    }

    /// Returns the contact radius of JKR without load on a half-space like the surface.
    pub(super) fn jkr_scale(&self) -> f64 {
        let work = 0.5 * self.traction * self.range;
        (4.5 * PI * work / (self.symbol.modulus() * self.curvature.powi(2))).cbrt()
    }

    /// Returns the minima of the imposed value along JKR's contacts as the logarithms of their
    /// radii and the values, the lowest one first; and whether the value rises at the largest radius
    /// that is looked at, so that no minimum is beyond.
    pub(super) fn jkr_minima(&self, control: Control) -> (Vec<Point>, bool) {
        let scale = self.jkr_scale();
        // A softer base widens the contact at most to that on a half-space of all the compliance.
        let widest = 2.0 * scale * (1.0 + self.symbol.contrast()).cbrt();
        let largest = widest.min(0.9 / self.curvature).min(LARGEST_A_OVER_T);
        // Below, the contact is that of a half-space, and the value rises as the radius falls.
        let least = (0.1 * scale).min(0.05).min(0.5 * largest);
        let count = ((largest / least).ln() / STEP).ceil() as usize;
        let points: Vec<Point> = (0..=count)
            .map(|i| largest.ln() - STEP * i as f64)
            .map(|log| (log, self.jkr(log.exp(), control)))
            // Rounding leaves no digits of the widest contacts on some bases.
            .filter(|point| point.1.is_finite())
            .collect();
        let mut minima: Vec<Point> = points
            .windows(3)
            .filter(|three| three[1].1 <= three[0].1 && three[1].1 < three[2].1)
            .map(|three| {
                let [above, here, below] = [three[0].1, three[1].1, three[2].1];
                let shift = 0.5 * (below - above) / (below - 2.0 * here + above);
                (three[1].0 + STEP * shift, here)
            })
            .collect();
        minima.sort_by(|a, b| a.1.total_cmp(&b.1));
        let ends = points.len() > 1 && points[0].1 > points[1].1;
        (minima, ends)
    }

    /// Returns the imposed value of JKR's contact at a radius.
    ///
    /// `delta = a^2 Delta0/R - d`, `F = a^3 Pi0/(2R) - 2 a Eeq d`, `d = sqrt(2 pi a es w)/Gamma`
    /// (Barthel, eqs. 2, 8 and 9).
    fn jkr(&self, radius: f64, control: Control) -> f64 {
        let of = galerkin::solve(radius, &self.symbol, &[], TOLERANCE).quantities;
        let work = 0.5 * self.traction * self.range;
        let lowered = (2.0 * PI * radius * self.symbol.modulus() * work).sqrt() / of.gamma;
        let penetration = radius * radius * of.delta0 * self.curvature - lowered;
        let load = 0.5 * radius.powi(3) * of.pi0 * self.curvature - 2.0 * radius * of.eeq * lowered;
        control.imposed(self.load_in_si(load), penetration * self.thickness)
    }
}
