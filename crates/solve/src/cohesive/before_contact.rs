//! The attraction across a gap, before any contact: a disc of constant traction on the surface.
//!
//! Under the traction `sigma0` on `r < c` the surface rises by
//!
//! ```text
//! -u(r) = tau c [ e(r/c)/es + (1/e1) int_0^inf (X-1) J1(qc) J0(qr)/q dq ],      e(0) = 1, e(1) = 2/pi
//! ```
//!
//! and the gap is `z0` at `r = c`: `delta = c^2/2R + u(c) - z0`, `F = -pi sigma0 c^2`. The contact
//! begins where the gap in the middle, `u(0) - delta`, is 0.

use std::f64::consts::{FRAC_2_PI, PI};
use std::sync::Arc;

use contact::{Control, root};

use crate::Error;
use crate::cohesive::search::{self, Point};
use crate::cohesive::{Cohesive, CohesiveState};
use crate::compliance::surface::SurfaceCompliance;
use crate::compliance::symbol::Symbol;
use crate::galerkin::quadrature::{PanelWeights, Panels};

/// Returns `-u/tau` in the middle and at the edge of a disc of radius `c`.
fn rise(c: f64, symbol: &Symbol<Arc<dyn SurfaceCompliance>>) -> [f64; 2] {
    let es = symbol.modulus();
    let mut rise = [c / es, FRAC_2_PI * c / es];
    if symbol.contrast() == 0.0 {
        return rise;
    }
    const ACCURACY: f64 = 1e-14;
    let panels = Panels::new(
        c,
        [symbol.compliance()],
        PanelWeights::Waves,
        ACCURACY / symbol.contrast().max(1.0),
    );
    for ends in panels.edges.windows(2) {
        let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
        let abscissae = panels.rule.abscissae.iter().map(|t| middle + half * t);
        let abscissae: Vec<f64> = abscissae.collect();
        let excesses = symbol.compliance().sample_all(&abscissae).excess;
        for ((q, w), excess) in abscissae.iter().zip(&panels.rule.weights).zip(excesses) {
            let term = symbol.film() / es * c * half * w * excess * libm::j1(q * c) / q;
            rise[0] += term;
            rise[1] += term * libm::j0(q * c);
        }
    }
    rise
}

impl Cohesive {
    /// Returns the state before the contact in which the attraction acts within the radius `c`, m.
    ///
    /// # Errors
    /// [`Error::Domain`] for a radius that is not positive, beyond the one at which the contact
    /// begins, or beyond [`REACH`](crate::cohesive::REACH); [`Error::NotAContact`] for a result that overflows an f64.
    pub fn without_contact(&self, outer_radius: f64) -> Result<CohesiveState, Error> {
        let last = self.first_contact().unwrap_or_else(|| self.reach());
        Error::check(
            "outer radius",
            outer_radius,
            [f64::MIN_POSITIVE, last * self.thickness],
        )?;
        let (state, _) = self.before_contact(outer_radius / self.thickness);
        if state.load.is_finite() && state.penetration.is_finite() {
            return Ok(state);
        }
        let what = "its load or penetration overflows an f64: check the units";
        Err(self.no_contact(outer_radius / self.thickness, what))
    }

    /// Returns the state before the contact in which the attraction acts within `c`, and the gap in
    /// the middle.
    pub(super) fn before_contact(&self, c: f64) -> (CohesiveState, f64) {
        let [middle, edge] = rise(c, &self.symbol).map(|u| -self.traction * u);
        let penetration = 0.5 * self.curvature * c * c + edge - self.range;
        let load = -0.5 * PI * self.traction * c * c;
        (
            self.in_si([0.0, c], load, penetration),
            middle - penetration,
        )
    }

    /// Returns the smallest radius of the attraction at which the gap in the middle has closed;
    /// `None` if it is beyond the reach.
    ///
    /// On a confined film the gap may close in a small disc, open again in discs that are wide
    /// beside the film, and close once more.
    pub(super) fn first_contact(&self) -> Option<f64> {
        /// The part of the range to which the gap has closed where the steps become short.
        const NEAR: f64 = 0.9;
        let gap = |c: f64| self.before_contact(c).1;
        // The gap is `z0 - c^2/2R - (1-2/pi) tau c/es`, with `S/es` for `1/es` in a mean over the
        // symbol: below this radius none of both terms closes more than a sixteenth of it.
        let rigid = (2.0 * self.range / self.curvature).sqrt();
        let compliance = (1.0 + self.symbol.contrast()) / self.symbol.modulus();
        let soft = self.range / ((1.0 - FRAC_2_PI) * self.traction * compliance);
        let reach = self.reach();
        let mut low = (0.25 * rigid)
            .min(0.06 * soft)
            .max(f64::MIN_POSITIVE)
            .min(reach);
        let mut factor = 2.0;
        while low < reach {
            let high = (factor * low).min(reach);
            let there = gap(high);
            if there <= 0.0 {
                let Ok(c) = root(|c| Ok::<f64, std::convert::Infallible>(gap(c)), low, high);
                return Some(c);
            }
            factor = if there > NEAR * self.range { 2.0 } else { 1.2 };
            low = high;
        }
        None
    }

    /// Returns the radius of the attraction, before the contact, of the lowest imposed value, and
    /// this value, among the radii up to `last`.
    ///
    /// The value falls as the first attraction sets in, in which Dugdale's law is unstable, and may
    /// rise from a radius on.
    pub(super) fn lowest_before_contact(
        &self,
        control: Control,
        last: f64,
    ) -> Result<Point, Error> {
        /// The steps of the search in `ln c`, the smallest radius over the last one, and a step beside
        /// which the value has no structure.
        const STEP: f64 = 0.35;
        const LEAST: f64 = 1e-8;
        const CLOSE: f64 = 1e-3;
        let mut value = |log: f64| {
            let (state, _) = self.before_contact(log.exp());
            Ok(control.imposed(state.load, state.penetration))
        };
        let end = last.ln();
        if control == Control::Load {
            // `-pi sigma0 c^2`
            return Ok((end, value(end)?));
        }
        // Below this radius, on the film alone, the penetration falls as the disc grows.
        let falls = FRAC_2_PI * self.traction / (self.curvature * self.symbol.modulus());
        let least = (0.05 * last).min(0.3 * falls.min(1.0)).max(LEAST * last);
        let count = ((end - least.ln()) / STEP).ceil() as usize;
        let points = (0..=count)
            .map(|i| end - STEP * i as f64)
            .map(|log| Ok((log, value(log)?)))
            .collect::<Result<Vec<Point>, Error>>()?;
        // The minimum may be within the last step: a point close to the end tells.
        let close = (end - CLOSE, value(end - CLOSE)?);
        if close.1 < points[0].1 && close.1 <= points[1].1 {
            return search::minimum(&mut value, [points[1], close, points[0]]);
        }
        let lowest = (0..points.len()).min_by(|&i, &j| points[i].1.total_cmp(&points[j].1));
        match lowest {
            Some(i) if i > 0 && i < count => {
                search::minimum(&mut value, [points[i - 1], points[i], points[i + 1]])
            }
            Some(i) => Ok(points[i]),
            None => Ok((end, value(end)?)),
        }
    }
}
