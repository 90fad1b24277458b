//! The slope of the force curve where the contact line moves.

use crate::Contact;
use crate::Error;
use crate::line_energy::LineEnergy;
use interp::Curve;
use interp::check::finite_result;

impl Contact {
    /// Returns the slope `K = dF/d delta` (N/m) of the force curve at contact radius `a` (m) and work
    /// of adhesion `w` (J/m^2), where the contact line moves in equilibrium.
    ///
    /// It is the stiffness of slow loading. Where the line stays, as under a small fast oscillation,
    /// the stiffness is [`Contact::stiffness`], `S`. With `p = |delta_fp|` and primes for `d/da`,
    ///
    /// ```text
    /// K = S - S' p / (delta0' - p'),    S' = S (1/a + Eeq'/Eeq),    p' = p (1/(2a) - Gamma'/Gamma)
    /// ```
    ///
    /// which follows from eqs. 8 and 9 and from `F0' = S delta0'`, for every probe. Without adhesion
    /// `K = S`. `K` is 0 at the pull-off under a load, infinite at that under a penetration, and
    /// negative between them. With full friction `F0' = S delta0'` holds for the `S` of a flat punch that sticks, which is not
    /// that of eq. 9, and `K` is the quotient of the slopes of load and penetration.
    ///
    /// Measured accuracy: 1e-13 of `S` against JKR's closed form on a half-space; on films 2.4e-6 of the
    /// larger of `S` and `|K|` against differences of force curves, which have a similar error, for
    /// every shape (`tests/contact/moving_stiffness.rs`). To this comes the error of the curve.
    ///
    /// # Errors
    /// As [`Contact::load_and_penetration`]; [`interp::Error::OtherProbe`] for a flat punch, whose contact
    /// line cannot move; [`interp::Error::Unphysical`] where the slope is infinite.
    pub fn moving_stiffness(&self, a: f64, w: f64) -> Result<f64, Error> {
        self.mechanics().edge_singularity(a, w)?;
        let (_, slopes, values, relative) = self.everything_and_slopes(a)?;
        let energy = LineEnergy::of_jkr(w);
        let [lowered, by_radius] = self.lowered_and_slopes(a, energy, &values, &relative)?;
        let slopes = slopes.minus(by_radius);
        if self.curve().and_then(Curve::stick).is_some() {
            return Ok(finite_result(a, slopes.load / slopes.penetration)?);
        }
        let pinned = self.mechanics().stiffness(a, values.eeq);
        if w == 0.0 {
            return Ok(finite_result(a, pinned)?);
        }
        let lost = pinned * (1.0 + relative.eeq) * lowered.penetration / slopes.penetration;
        Ok(finite_result(a, pinned - lost)?)
    }
}
