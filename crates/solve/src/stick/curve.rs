//! Curves of a sphere that sticks, for the contacts of the crate `contact`.
//!
//! The part of the contact that a work of adhesion drives depends on its history. While the contact
//! grows with the work of adhesion `w_a`, a point joins it with the displacement that it has, and
//! the load is eq. 9 with `Pi_s`, `Delta_s`, `Gamma_g` and `Eeq_g`. The contact recedes when a stuck
//! punch, pulled by `delta_2` in addition, has raised the energy release rate to `w_r >= w_a`. With
//! `r = w_a/w_r` the receding contact is eq. 9, too, with `w_r` and
//!
//! ```text
//! 1/Gamma   = r^{1/2}/Gamma_g + T              T = [(Gamma_eff^2 - r Gamma_t^2)^{1/2} - r^{1/2} Gamma_s]/Gamma_eff^2
//! Eeq/Gamma = r^{1/2} Eeq_g/Gamma_g + Eeq_s T
//! ```
//!
//! With `r = 1`, one work of adhesion, it retraces the growing contact. With `r = 0`, a contact that
//! was pressed on without attraction, it is eq. 9 with `Eeq_s` and `Gamma_eff` (Borodich, Galanov,
//! Suarez-Alvarez, J. Mech. Phys. Solids 68, 14, 2014, on a half-space).

use interp::{Curve, Quantities};

use crate::Error;
use crate::adaptive_curve::{CURVE_TOLERANCE, check_order};
use crate::estimate::difference;
use crate::stick::growth::Grown;
use crate::stick::sticking::{GrownContact, Sticking, not_converged};

/// The share of the tolerance of a curve for the solves, and for the spline.
const SHARE: f64 = 0.5;

/// The first distance of the spline's nodes in `ln(a/t)`.
const FIRST_DISTANCE: f64 = 0.04;

/// The distance of nodes below which the error is that of rounding.
const LEAST_DISTANCE: f64 = 1e-3;

impl Grown {
    /// Returns the quantities of eq. 9 for a contact that has grown with the part `ratio` of the
    /// work of adhesion with which it recedes, from 0 to 1.
    pub fn receding(&self, ratio: f64) -> Quantities {
        let root = ratio.sqrt();
        let [s, t] = [self.gamma_s, self.gamma_t];
        let square = s * s + t * t;
        let pull = ((square - ratio * t * t).sqrt() - root * s) / square;
        let lowered = root / self.gamma_g + pull;
        Quantities {
            pi0: self.pi_s,
            eeq: (root * self.eeq_g / self.gamma_g + self.eeq_s * pull) / lowered,
            gamma: 1.0 / lowered,
            delta0: self.delta_s,
        }
    }
}

/// The curves of one sphere that sticks to one film or stack of layers.
pub struct StickCurves {
    grown: GrownContact,
    range: [f64; 2],
    tolerance: f64,
    /// The curve of a contact that was pressed on without attraction, and of one with one work of
    /// adhesion.
    ends: [Curve; 2],
}

impl StickCurves {
    /// Solves the contact of a sphere over the `a_over_t` between two ends to a relative
    /// `tolerance` of all quantities. One solve serves every ratio of the works of adhesion.
    ///
    /// # Errors
    /// [`Error::Contact`] for ends that descend; [`Error::Domain`] for ends outside the domain or a tolerance outside `[1e-10, 1e-2]`, and as
    /// [`Sticking::grown`].
    pub fn new(sticking: &Sticking, a_over_t: [f64; 2], tolerance: f64) -> Result<Self, Error> {
        let [from, to] = a_over_t;
        Error::check(
            "tolerance",
            tolerance,
            [100.0 * CURVE_TOLERANCE[0], CURVE_TOLERANCE[1]],
        )?;
        check_order(a_over_t)?;
        Error::check("a_over_t", from, [1e-6, to / (1.0 + 1e-6)])?;
        let grown = sticking.grown(to, 2.0, SHARE * tolerance);
        let grown = grown.map_err(|error| match error {
            Error::NotConverged { reached, .. } => not_converged(to, tolerance, reached / SHARE),
            other => other,
        })?;
        let ends = splines(&grown, a_over_t, tolerance, [0.0, 1.0])?;
        Ok(Self {
            grown,
            range: a_over_t,
            tolerance,
            ends,
        })
    }

    /// Returns the curve of contacts that have grown with the part `ratio` of the work of adhesion
    /// with which they recede: 1 is one work of adhesion, 0 a contact that was pressed on without
    /// attraction.
    ///
    /// # Errors
    /// [`Error::Domain`] for a ratio outside `[0, 1]`: a line that recedes at a smaller energy than
    /// it advances with is not solved.
    pub fn receding(&self, ratio: f64) -> Result<Curve, Error> {
        Error::check(
            "work of adhesion of the advancing line over that of the receding line",
            ratio,
            [0.0, 1.0],
        )?;
        let [pressed, one] = &self.ends;
        let curve = if ratio == 0.0 {
            pressed.clone()
        } else if ratio == 1.0 {
            one.clone()
        } else {
            let [curve] = splines(&self.grown, self.range, self.tolerance, [ratio])?;
            curve
        };
        Ok(curve.with_stick(pressed))
    }

    /// Returns the numbers of the contact at one `a/t`, up to the last of the curves.
    ///
    /// # Errors
    /// As [`GrownContact::at`].
    pub fn at(&self, a_over_t: f64) -> Result<Grown, Error> {
        self.grown.at(a_over_t)
    }
}

/// Makes the splines of several ratios, with nodes as close as the tolerance needs.
fn splines<const N: usize>(
    grown: &GrownContact,
    [from, to]: [f64; 2],
    tolerance: f64,
    ratios: [f64; N],
) -> Result<[Curve; N], Error> {
    let length = (to / from).ln();
    let at = |share: f64| (from * (length * share).exp()).clamp(from, to);
    let quantities = |x: f64| {
        let grown = grown.evaluate(x);
        ratios.map(|ratio| grown.receding(ratio))
    };
    // Six nodes at least, so that the spline is quintic.
    let mut distance = FIRST_DISTANCE.min(0.2 * length);
    loop {
        let pieces = (length / distance).ceil() as usize;
        let nodes: Vec<_> = (0..=pieces)
            .map(|i| at(i as f64 / pieces as f64))
            .map(|x| (x, quantities(x)))
            .collect();
        let curves = Curve::through_each(&nodes, *grown.sticking.material())?;
        // Between the nodes, where a spline is farthest from what it follows.
        let mut error: f64 = 0.0;
        for i in 0..pieces {
            let x = at((i as f64 + 0.5) / pieces as f64);
            for (curve, known) in curves.iter().zip(quantities(x)) {
                error = error.max(difference(&curve.quantities(x)?, &known));
            }
        }
        if error <= SHARE * tolerance {
            return Ok(curves.map(|curve| grown.sticking.mark(curve)));
        }
        if distance < LEAST_DISTANCE.min(1e-3 * length) {
            return Err(not_converged(to, tolerance, error / SHARE));
        }
        distance *= 0.8 * (SHARE * tolerance / error).powf(1.0 / 6.0).clamp(0.2, 1.0);
    }
}
