//! The energy release rate from any two measured values of contact radius, load and penetration. No
//! work of adhesion is assumed.

use crate::Contact;
use crate::Error;
use crate::root::root;
use interp::Quantity;
use interp::check::{finite_input, finite_result};

/// The difference of a load from that of a flat punch, over the two, which is taken for rounding.
const RIM: f64 = 1e-10;

impl Contact {
    /// Returns the energy release rate `G` (J/m^2) of a measured contact radius `a` (m) and `load`
    /// (N).
    ///
    /// It belongs to the edge singularity that lowers the load from the adhesionless `F0(a)` to
    /// `load`. It is negative for a `load` above `F0`, under which the contact grows.
    ///
    /// # Errors
    /// [`interp::Error::OutsideTable`] or [`interp::Error::Extrapolation`] where the curve does not cover `a/t`;
    /// as [`interp::Mechanics::check_radius`] for `a`; [`interp::Error::Unphysical`] for numbers that are not finite;
    /// [`interp::Error::MissingQuantity`] without `pi0`, `eeq` and `gamma`.
    pub fn energy_release_rate_at_load(&self, a: f64, load: f64) -> Result<f64, Error> {
        self.mechanics().check_radius(a)?;
        finite_input("load", load)?;
        let (without, eeq_over_gamma) = self.load_factors(a)?;
        let edge = (without - load) / (4.0 * a * eeq_over_gamma);
        Ok(finite_result(
            a,
            self.mechanics().energy_release_rate(a, edge),
        )?)
    }

    /// Returns the energy release rate `G` (J/m^2) of a measured contact radius `a` (m) and
    /// `penetration` (m).
    ///
    /// It belongs to the edge singularity that lowers the penetration from the adhesionless
    /// `delta0(a)` to `penetration`. It is negative for a `penetration` above `delta0`, at which
    /// the contact grows.
    ///
    /// # Errors
    /// As [`Contact::energy_release_rate_at_load`], but [`interp::Error::MissingQuantity`] without `gamma`
    /// and `delta0`.
    pub fn energy_release_rate_at_penetration(
        &self,
        a: f64,
        penetration: f64,
    ) -> Result<f64, Error> {
        self.mechanics().check_radius(a)?;
        finite_input("penetration", penetration)?;
        let gamma = self.quantity(Quantity::Gamma, a)?;
        let flat_punch = self.adhesionless_penetration(a)? - penetration;
        Ok(finite_result(
            a,
            self.mechanics()
                .energy_release_rate(a, self.mechanics().edge_of_flat_punch(flat_punch, gamma)),
        )?)
    }

    /// Returns the contact radius `a` (m) and the energy release rate `G >= 0` (J/m^2) of a
    /// measured `load` (N) and `penetration` (m).
    ///
    /// `F0(a) - S(a) (delta0(a) - delta)` is the load of a contact of radius `a` at the penetration
    /// `delta`. Its derivative is `-S' (delta0 - delta)`, because `F0' = S delta0'`. So it falls
    /// from its largest value, the adhesionless one, which it has where `delta0 = delta`, and one
    /// radius above that one belongs to `load`.
    ///
    /// For a load smaller than the largest by `x`, `G` is proportional to `x`, and `a` exceeds the
    /// adhesionless radius in proportion to `x^{1/2}`. So without adhesion the radius is accurate
    /// to half the digits only.
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] for a `load` that is larger than without adhesion at this
    /// `penetration` (larger than 0 if the `penetration` is not positive), or numbers that are not
    /// finite; [`Error::OutsideRadii`] if the contact radius is not in
    /// [`Contact::contact_radius_range`]; [`interp::Error::MissingQuantity`] without all four quantities;
    /// [`interp::Error::OtherProbe`] under a flat punch; [`Error::Sticks`] with full friction.
    pub fn radius_and_energy_release_rate(
        &self,
        load: f64,
        penetration: f64,
    ) -> Result<(f64, f64), Error> {
        finite_input("load", load)?;
        finite_input("penetration", penetration)?;
        if self.is_punch() {
            return Err(self.makes_no_sense("a contact radius from load and penetration"));
        }
        self.without_stick(
            "a contact radius from load and penetration",
            "it is unique without friction only; measure the contact radius, too",
        )?;
        let [u_least, u_most] = self.search_range()?.map(f64::ln);
        let radius = |u: f64| self.radius_at(u);
        let outside = |name, value| Err(self.outside(name, value));
        let flat_punch =
            |u: f64| Ok::<_, Error>(self.adhesionless_penetration(radius(u))? - penetration);
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
            let (a, flat_punch) = (radius(u), flat_punch(u)?);
            let eeq = self.quantity(Quantity::Eeq, a)?;
            let pulled = self.mechanics().stiffness(a, eeq) * flat_punch;
            Ok::<_, Error>(self.adhesionless_load(a)? - pulled - load)
        };
        let least = excess(u_from)?;
        if !adhesionless && self.begins_at_flat_end() {
            // A contact that ends at the rim of a flat end is a flat punch; what is left of the two loads is rounding.
            let rim = radius(u_least);
            let pulled = self.stiffness(rim)? * flat_punch(u_least)?;
            if least.abs() <= RIM * (load.abs() + pulled.abs()) {
                return Ok((
                    rim,
                    self.energy_release_rate_at_penetration(rim, penetration)?,
                ));
            }
        }
        if least < 0.0 {
            let possible = adhesionless || (penetration <= 0.0 && load >= 0.0);
            interp::Error::unless(
                !possible,
                "load",
                load,
                "at most the load of a contact without adhesion at this penetration: check its sign",
            )?;
            return outside("load", load);
        }
        if excess(u_most)? >= 0.0 {
            return outside("load", load);
        }
        let a = radius(root(excess, u_from, u_most)?);
        Ok((a, self.energy_release_rate_at_penetration(a, penetration)?))
    }
}
