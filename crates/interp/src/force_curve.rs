//! Eq. 9 in SI units: the force curve of a sphere on one film.

use crate::check::{finite_input, finite_result};
use crate::{Curve, Error, Mechanics, Probe, Quantities, Quantity, System, Table};

/// The force curve of a sphere, as the model's paraboloid, on one film: eqs. 2 to 9 with the
/// quantities of its material.
///
/// Each function is arithmetic with the values of the curve. The crate `contact` has other probes,
/// equilibria, pull-off and everything else that is asked of a contact.
///
/// ```
/// # #[cfg(feature = "embedded")]
/// # fn main() -> Result<(), interp::Error> {
/// use interp::{Elastic, ForceCurve, Probe, System, Table};
///
/// let system = System {
///     probe: Probe::Paraboloid { radius: 1e-3 },
///     sphere_modulus: 2e6,
///     film: Elastic::new(3.5e6, 0.5)?,
///     film_thickness: 1e-5,
///     substrate: Elastic::new(2e11, 0.25)?,
/// };
/// let curve = ForceCurve::in_table(Table::embedded(), &system)?;
/// let (a, w) = (65e-6, 0.040); // contact radius, m; work of adhesion, J/m^2
/// let load = curve.load(a, w)?;
/// assert!((curve.energy_release_rate(a, load)? / w - 1.0).abs() < 1e-9);
/// # Ok(()) }
/// # #[cfg(not(feature = "embedded"))]
/// # fn main() {}
/// ```
#[derive(Clone, Debug)]
pub struct ForceCurve {
    mechanics: Mechanics,
    curve: Curve,
    film_thickness: f64,
}

impl ForceCurve {
    /// Looks up the curve of a system's material.
    ///
    /// # Errors
    /// [`Error::OtherProbe`] unless the probe is a paraboloid; those of [`System::material`] and of
    /// [`Table::curve`].
    pub fn in_table(table: &Table, system: &System) -> Result<Self, Error> {
        let Probe::Paraboloid { .. } = system.probe else {
            return Err(Error::OtherProbe {
                question: "the force curve of the model's sphere",
                probe: system.probe.name(),
                reason: "the crate `contact` has the other shapes",
            });
        };
        Ok(Self {
            mechanics: Mechanics::new(system)?,
            curve: table.curve(&system.material()?)?,
            film_thickness: system.film_thickness,
        })
    }

    /// Returns the dimensionless quantities as functions of `a/t`.
    pub const fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Returns the load `F` (N, positive in compression), eq. 9, at contact radius `a` (m) and work
    /// of adhesion `w` (J/m^2).
    ///
    /// # Errors
    /// [`Error::OutsideTable`] or [`Error::Extrapolation`] where the curve does not cover `a/t`;
    /// [`Error::BeyondSphere`] for an `a` that is not below the radius of the sphere;
    /// [`Error::Unphysical`] for `a <= 0`, `w < 0`, numbers that are not finite, or a result that
    /// overflows an f64.
    pub fn load(&self, a: f64, w: f64) -> Result<f64, Error> {
        Ok(self.load_and_penetration(a, w)?.0)
    }

    /// Returns the penetration `delta` (m, positive when the sphere moves in) at contact radius `a`
    /// (m) and work of adhesion `w` (J/m^2).
    ///
    /// # Errors
    /// As [`ForceCurve::load`].
    pub fn penetration(&self, a: f64, w: f64) -> Result<f64, Error> {
        Ok(self.load_and_penetration(a, w)?.1)
    }

    /// Returns load (N) and penetration (m) at contact radius `a` (m) and work of adhesion `w`
    /// (J/m^2).
    ///
    /// # Errors
    /// As [`ForceCurve::load`].
    pub fn load_and_penetration(&self, a: f64, w: f64) -> Result<(f64, f64), Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let (load, penetration) = self.mechanics.load_and_penetration(a, edge, &self.at(a)?);
        Ok((finite_result(a, load)?, finite_result(a, penetration)?))
    }

    /// Returns the contact stiffness `S = 2 a E* Eeq` (N/m), eq. 5, at contact radius `a` (m).
    ///
    /// # Errors
    /// As [`ForceCurve::load`].
    pub fn stiffness(&self, a: f64) -> Result<f64, Error> {
        self.mechanics.check_radius(a)?;
        let eeq = self
            .curve
            .quantity(Quantity::Eeq, a / self.film_thickness)?;
        finite_result(a, self.mechanics.stiffness(a, eeq))
    }

    /// Returns the stress intensity `K_I` (Pa m^{1/2}) of the edge at contact radius `a` (m) and work
    /// of adhesion `w` (J/m^2): [`Mechanics::stress_intensity`].
    ///
    /// # Errors
    /// As [`ForceCurve::load`], without those of the curve.
    pub fn stress_intensity(&self, a: f64, w: f64) -> Result<f64, Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        finite_result(a, self.mechanics.stress_intensity(a, edge))
    }

    /// Returns the energy release rate `G` (J/m^2), eq. 8, of a measured contact radius `a` (m) and
    /// `load` (N). It is negative for a load above that without adhesion.
    ///
    /// # Errors
    /// As [`ForceCurve::load`].
    pub fn energy_release_rate(&self, a: f64, load: f64) -> Result<f64, Error> {
        self.mechanics.check_radius(a)?;
        finite_input("load", load)?;
        let q = self.at(a)?;
        let without = self
            .mechanics
            .adhesionless_load(a, self.mechanics.sphere_radius(), q.pi0);
        let edge = (without - load) / (4.0 * a * (q.eeq / q.gamma));
        finite_result(a, self.mechanics.energy_release_rate(a, edge))
    }

    /// Returns the quantities at contact radius `a` (m), which is checked.
    fn at(&self, a: f64) -> Result<Quantities, Error> {
        self.curve.quantities(a / self.film_thickness)
    }
}
