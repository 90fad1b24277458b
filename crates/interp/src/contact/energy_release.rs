//! The energy release rate from measured contact radius, load and penetration, any two of them: no
//! work of adhesion is supposed.

use crate::contact::contact::finite;
use crate::contact::root::root;
use crate::material::system::positive;
use crate::{Contact, Error, Quantity};

impl Contact {
    /// Energy release rate `G` (J/m^2) from a measured contact radius `a` (m) and load (N): that of
    /// the edge which takes the load from the adhesionless `F0(a)` to `load`. Negative for a load
    /// above `F0`, which only a contact that grows can bear.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] or [`Error::Extrapolation`] where the curve does not cover `a/t`;
    /// [`Error::Unphysical`] for `a <= 0`, or numbers that are not finite;
    /// [`Error::MissingQuantity`] without `pi0`, `eeq` and `gamma`.
    pub fn energy_release_rate_at_load(&self, a: f64, load: f64) -> Result<f64, Error> {
        positive("contact radius", a)?;
        known("load", load)?;
        let (pi0, eeq_over_gamma) = self.load_factors(a)?;
        let edge = (self.mechanics().adhesionless_load(a, pi0) - load) / (4.0 * a * eeq_over_gamma);
        finite(a, self.mechanics().energy_release_rate(a, edge))
    }

    /// Energy release rate `G` (J/m^2) from a measured contact radius `a` (m) and penetration (m):
    /// that of the edge which takes the penetration from the adhesionless `delta0(a)` to
    /// `penetration`. Negative for a penetration above `delta0`, which only a contact that grows
    /// can have.
    ///
    /// # Errors
    /// As [`Contact::energy_release_rate_at_load`], but [`Error::MissingQuantity`] without `gamma`
    /// and `delta0`.
    pub fn energy_release_rate_at_penetration(
        &self,
        a: f64,
        penetration: f64,
    ) -> Result<f64, Error> {
        positive("contact radius", a)?;
        known("penetration", penetration)?;
        let (gamma, delta0) = (
            self.quantity(Quantity::Gamma, a)?,
            self.quantity(Quantity::Delta0, a)?,
        );
        let flat_punch = self.mechanics().adhesionless_penetration(a, delta0) - penetration;
        finite(
            a,
            self.mechanics()
                .energy_release_rate(a, self.mechanics().edge_of_flat_punch(flat_punch, gamma)),
        )
    }

    /// Contact radius `a` (m) and energy release rate `G >= 0` (J/m^2) from measured load (N) and
    /// penetration (m).
    ///
    /// `F0(a) - S(a) (delta0(a) - delta)` is the load of a contact of radius `a` at this
    /// penetration. Its derivative is `-S' (delta0 - delta)`, because `F0' = S delta0'`: it falls
    /// from its largest value, the adhesionless one, where `delta0 = delta`. So there is one radius
    /// from there on.
    ///
    /// A load short of the largest by `x` has `G` proportional to `x`, and an `a` that is larger
    /// than the adhesionless one in proportion to `x^{1/2}`: without adhesion the radius is known
    /// to half the digits only.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for a load that is larger than without adhesion at this penetration
    /// (above 0 where the penetration is not), or numbers that are not finite;
    /// [`Error::OutsideRadii`] if the contact radius is not in [`Contact::contact_radius_range`];
    /// [`Error::MissingQuantity`] without all four quantities.
    pub fn radius_and_energy_release_rate(
        &self,
        load: f64,
        penetration: f64,
    ) -> Result<(f64, f64), Error> {
        known("load", load)?;
        known("penetration", penetration)?;
        let [u_least, u_most] = self.search_range().map(f64::ln);
        let outside = |name, value| Err(self.outside(name, value));
        let flat_punch = |u: f64| {
            let a = u.exp();
            Ok(self
                .mechanics()
                .adhesionless_penetration(a, self.quantity(Quantity::Delta0, a)?)
                - penetration)
        };
        if flat_punch(u_most)? < 0.0 {
            return outside("penetration", penetration);
        }
        // The adhesionless radius, where there is one in range.
        let adhesionless = flat_punch(u_least)? < 0.0;
        let u_from = if adhesionless {
            root(flat_punch, u_least, u_most)?
        } else {
            u_least
        };
        let excess = |u: f64| {
            let (a, flat_punch) = (u.exp(), flat_punch(u)?);
            let (pi0, eeq) = (
                self.quantity(Quantity::Pi0, a)?,
                self.quantity(Quantity::Eeq, a)?,
            );
            Ok(self.mechanics().adhesionless_load(a, pi0)
                - self.mechanics().stiffness(a, eeq) * flat_punch
                - load)
        };
        if excess(u_from)? < 0.0 {
            let possible = adhesionless || (penetration <= 0.0 && load >= 0.0);
            Error::unless(
                !possible,
                "load",
                load,
                "at most what a contact without adhesion bears at this penetration",
            )?;
            return outside("load", load);
        }
        if excess(u_most)? >= 0.0 {
            return outside("load", load);
        }
        let a = root(excess, u_from, u_most)?.exp();
        Ok((a, self.energy_release_rate_at_penetration(a, penetration)?))
    }
}

/// Accepts a measured value.
fn known(name: &'static str, value: f64) -> Result<(), Error> {
    Error::unless(value.is_finite(), name, value, "finite")
}
