//! The contact in SI units: what follows from contact radius and work of adhesion.

use crate::material::system::positive;
use crate::{Curve, Error, HalfSpace, Mechanics, Quantities, Quantity, System, Table};

/// A system with the curve of its material, from a table or a solve, or a half-space without
/// either: all else is arithmetic.
#[derive(Clone, Debug)]
pub struct Contact {
    pub(crate) mechanics: Mechanics,
    pub(crate) bodies: Bodies,
}

/// What touches what.
#[derive(Clone, Debug)]
pub(crate) enum Bodies {
    HalfSpace(HalfSpace),
    Coated { system: System, curve: Curve },
}

/// A contact: how large it is, what presses it, how far the sphere is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Contact radius `a`, m.
    pub contact_radius: f64,
    /// Load `F`, N, positive in compression.
    pub load: f64,
    /// Penetration `delta`, m, positive when the sphere is in.
    pub penetration: f64,
}

impl State {
    /// No contact, no load, and the sphere where its lowest point would just touch.
    pub const ORIGIN: Self = Self {
        contact_radius: 0.0,
        load: 0.0,
        penetration: 0.0,
    };
}

impl Table {
    /// Looks up the material of a system.
    ///
    /// # Errors
    /// Those of [`System::material`] and [`Table::curve`].
    pub fn contact(&self, system: &System) -> Result<Contact, Error> {
        Contact::new(system, self.curve(&system.material()?)?)
    }

    /// The same with derivatives with respect to all that the system consists of, which
    /// [`Contact::gradient`] gives.
    ///
    /// # Errors
    /// As [`Table::contact`].
    pub fn contact_with_gradient(&self, system: &System) -> Result<Contact, Error> {
        Contact::new(system, self.curve_with_gradient(&system.material()?)?)
    }
}

impl Contact {
    /// A system with a curve made for its material, or for the
    /// [equivalent](crate::Material::with_substrate_poisson_ratio) on a substrate with another
    /// Poisson ratio.
    ///
    /// # Errors
    /// Those of [`System::material`]; [`Error::OtherMaterial`] if the curve was made for another
    /// one, by more than rounding (`1e-12`).
    pub fn new(system: &System, curve: Curve) -> Result<Self, Error> {
        let (mechanics, made_for) = (Mechanics::new(system)?, curve.material());
        let material = system
            .material()?
            .with_substrate_poisson_ratio(made_for.nu0())?;
        if !material.is_close_to(made_for) {
            return Err(Error::OtherMaterial {
                curve: made_for.to_array(),
                system: material.to_array(),
            });
        }
        Ok(Self {
            mechanics,
            bodies: Bodies::Coated {
                system: *system,
                curve,
            },
        })
    }

    /// A sphere on a half-space: JKR, to rounding, at any contact radius.
    ///
    /// ```
    /// # fn main() -> Result<(), interp::Error> {
    /// use interp::{Contact, Control, Elastic, HalfSpace};
    ///
    /// let system = HalfSpace { sphere_radius: 1e-3, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
    /// let pull_off = Contact::half_space(&system)?.pull_off(0.04, Control::Load)?;
    /// assert!((pull_off.load / (-1.5 * std::f64::consts::PI * 0.04 * 1e-3) - 1.0).abs() < 1e-14);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// Those of [`HalfSpace::compound_modulus`].
    pub fn half_space(system: &HalfSpace) -> Result<Self, Error> {
        Ok(Self {
            mechanics: Mechanics::half_space(system)?,
            bodies: Bodies::HalfSpace(*system),
        })
    }

    /// The dimensionless quantities as functions of `a/t`; none on a half-space.
    pub fn curve(&self) -> Option<&Curve> {
        match &self.bodies {
            Bodies::HalfSpace(_) => None,
            Bodies::Coated { curve, .. } => Some(curve),
        }
    }

    /// Sphere, film and substrate; none on a half-space.
    pub fn system(&self) -> Option<&System> {
        match &self.bodies {
            Bodies::HalfSpace(_) => None,
            Bodies::Coated { system, .. } => Some(system),
        }
    }

    /// The arithmetic, for quantities from elsewhere.
    pub fn mechanics(&self) -> &Mechanics {
        &self.mechanics
    }

    /// The contact radii (m) among which states are sought: from the smallest of the curve's nodes
    /// to the largest. They begin at 0 where the expansion for thick films is accurate enough below
    /// the nodes, as it is on the embedded table; on a half-space they go from 0 to infinity. In
    /// numbers, 0 is 1e-60 m (or the smallest node's, if that is smaller) and infinity 1e60 m.
    pub fn contact_radius_range(&self) -> [f64; 2] {
        match self.node_radii() {
            Some([from, to]) => [if self.goes_on_to_zero() { 0.0 } else { from }, to],
            None => [0.0, f64::INFINITY],
        }
    }

    /// The smallest and the largest contact radius (m) of the curve's nodes; none on a half-space.
    pub(crate) fn node_radii(&self) -> Option<[f64; 2]> {
        match &self.bodies {
            Bodies::Coated { system, curve } => Some(
                curve
                    .range()
                    .map(|a_over_t| a_over_t * system.film_thickness),
            ),
            Bodies::HalfSpace(_) => None,
        }
    }

    /// Whether there are states of all contact radii below the nodes.
    pub(crate) fn goes_on_to_zero(&self) -> bool {
        self.curve().is_none_or(Curve::goes_on_to_zero)
    }

    /// Load `F` (N, positive in compression) at contact radius `a` (m) and work of adhesion `w`
    /// (J/m^2): eq. 9.
    ///
    /// Each of its two terms has the relative error of the curve.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] or [`Error::Extrapolation`] where the curve does not cover `a/t`,
    /// see [`Curve::quantity`]; [`Error::Unphysical`] for `a <= 0`, `w < 0`, NaN, or a load too
    /// large for f64; [`Error::MissingQuantity`] without `pi0` and, with adhesion, `eeq` and
    /// `gamma`.
    pub fn load(&self, a: f64, w: f64) -> Result<f64, Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let (pi0, eeq_over_gamma) = if w == 0.0 {
            (self.quantity(Quantity::Pi0, a)?, 1.0)
        } else {
            self.load_factors(a)?
        };
        finite(a, self.mechanics.load(a, edge, pi0, eeq_over_gamma))
    }

    /// The loads (N) at many contact radii (m), in the order given, and work of adhesion `w`
    /// (J/m^2): as [`Contact::load`].
    ///
    /// # Errors
    /// As [`Contact::load`] at the first radius that has one, with the loads before it written;
    /// [`Error::InvalidArgument`] if `radii` and `loads` differ in length.
    pub fn load_at_all(&self, radii: &[f64], w: f64, loads: &mut [f64]) -> Result<(), Error> {
        Error::same_length(radii, loads)?;
        for (load, &a) in loads.iter_mut().zip(radii) {
            *load = self.load(a, w)?;
        }
        Ok(())
    }

    /// Load (N) and penetration (m, positive when the sphere moves in) at contact radius `a` (m)
    /// and work of adhesion `w` (J/m^2).
    ///
    /// # Errors
    /// As [`Contact::load`], and [`Error::MissingQuantity`] without `delta0`.
    pub fn load_and_penetration(&self, a: f64, w: f64) -> Result<(f64, f64), Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let quantities = if w == 0.0 {
            let (pi0, delta0) = (
                self.quantity(Quantity::Pi0, a)?,
                self.quantity(Quantity::Delta0, a)?,
            );
            Quantities {
                pi0,
                delta0,
                ..Quantities::homogeneous(1.0)
            }
        } else {
            self.quantities(a)?
        };
        let (load, penetration) = self.mechanics.load_and_penetration(a, edge, &quantities);
        Ok((finite(a, load)?, finite(a, penetration)?))
    }

    /// Contact stiffness `S = 2 a E* Eeq` (N/m) at contact radius `a` (m), eq. 5.
    ///
    /// # Errors
    /// [`Error::OutsideTable`] or [`Error::Extrapolation`] where the curve does not cover `a/t`,
    /// [`Error::MissingQuantity`] without `eeq`; on a half-space [`Error::Unphysical`] unless `a`
    /// is positive and finite, and the stiffness not too large for f64.
    pub fn stiffness(&self, a: f64) -> Result<f64, Error> {
        finite(
            a,
            self.mechanics
                .stiffness(a, self.quantity(Quantity::Eeq, a)?),
        )
    }

    /// Stress intensity `K_I` (Pa m^{1/2}) of the edge at contact radius `a` (m) and work of
    /// adhesion `w` (J/m^2), `sqrt(2 w Es*)`: see [`Mechanics::stress_intensity`], and
    /// [`Mechanics::edge_singularity`] for `g(a)`. In the JKR limit it depends on no radius and on
    /// no film but through `Es*`.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for `a <= 0`, `w < 0`, NaN, or a stress intensity too large for f64.
    pub fn stress_intensity(&self, a: f64, w: f64) -> Result<f64, Error> {
        finite(
            a,
            self.mechanics
                .stress_intensity(a, self.mechanics.edge_singularity(a, w)?),
        )
    }

    /// All four quantities at contact radius `a` (m), normalised as the [`Mechanics`] takes them.
    ///
    /// # Errors
    /// As [`Contact::stiffness`], and [`Error::MissingQuantity`] without any of them.
    pub fn quantities(&self, a: f64) -> Result<Quantities, Error> {
        self.look_up(a, Curve::quantities, Quantities::homogeneous(1.0))
    }

    /// One of them.
    pub(crate) fn quantity(&self, quantity: Quantity, a: f64) -> Result<f64, Error> {
        self.look_up(
            a,
            |curve, x| curve.quantity(quantity, x),
            Quantities::homogeneous(1.0).get(quantity),
        )
    }

    /// `Pi0` and `Eeq/Gamma`, all that the force of eq. 9 needs.
    pub(crate) fn load_factors(&self, a: f64) -> Result<(f64, f64), Error> {
        self.look_up(a, Curve::load_factors, (8.0 / 3.0, 1.0))
    }

    /// The state at contact radius `a` (m) and work of adhesion `w` (J/m^2), if there is one.
    pub(crate) fn state(&self, a: f64, w: f64) -> Result<State, Error> {
        let (load, penetration) = self.load_and_penetration(a, w)?;
        Ok(State {
            contact_radius: a,
            load,
            penetration,
        })
    }

    /// The slopes `dF/d ln a` (N) and `d delta/d ln a` (m) at constant work of adhesion `w`
    /// (J/m^2): the derivatives of `F = F0 - 4 a g Eeq/Gamma` and
    /// `delta = delta0 - 2 g/(E* Gamma)`, where `g` grows like `a^{1/2}`.
    pub(crate) fn slopes(&self, a: f64, w: f64) -> Result<(f64, f64), Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let (one, zero) = (
            Quantities::homogeneous(1.0),
            Quantities::from_array([0.0; 4]),
        );
        let (values, slopes) = if w == 0.0 {
            let both = |quantity| {
                self.look_up(
                    a,
                    |curve, x| Ok((curve.quantity(quantity, x)?, curve.slope(quantity, x)?)),
                    (one.get(quantity), 0.0),
                )
            };
            let [(pi0, pi0_slope), (delta0, delta0_slope)] =
                [both(Quantity::Pi0)?, both(Quantity::Delta0)?];
            (
                Quantities { pi0, delta0, ..one },
                Quantities {
                    pi0: pi0_slope,
                    delta0: delta0_slope,
                    ..zero
                },
            )
        } else {
            self.look_up(a, Curve::quantities_and_slopes, (one, zero))?
        };
        let relative = |quantity| slopes.get(quantity) / values.get(quantity);
        let (load, penetration) = self.mechanics.load_and_penetration(a, edge, &values);
        let f0 = self.mechanics.adhesionless_load(a, values.pi0);
        let delta0 = self.mechanics.adhesionless_penetration(a, values.delta0);
        let gamma = relative(Quantity::Gamma);
        Ok((
            f0 * (3.0 + relative(Quantity::Pi0))
                - (f0 - load) * (1.5 + relative(Quantity::Eeq) - gamma),
            delta0 * (2.0 + relative(Quantity::Delta0)) - (delta0 - penetration) * (0.5 - gamma),
        ))
    }

    /// What the curve says at contact radius `a`, or what holds on any half-space.
    fn look_up<T>(
        &self,
        a: f64,
        curve: impl FnOnce(&Curve, f64) -> Result<T, Error>,
        half_space: T,
    ) -> Result<T, Error> {
        match &self.bodies {
            Bodies::Coated { system, curve: own } => curve(own, a / system.film_thickness),
            Bodies::HalfSpace(_) => positive("contact radius", a).map(|()| half_space),
        }
    }
}

/// Accepts a result at contact radius `a` unless it overflowed.
pub(crate) fn finite(a: f64, result: f64) -> Result<f64, Error> {
    let allowed = "such that load, penetration and stresses are numbers that f64 holds";
    Error::unless(result.is_finite(), "contact radius", a, allowed).map(|()| result)
}
