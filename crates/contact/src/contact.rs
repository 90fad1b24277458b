//! A system with the curve of its material: load, penetration, stiffness and stress intensity at a
//! contact radius.

use std::sync::OnceLock;

use super::line_energy::LineEnergy;
use crate::Error;
use crate::Input;
use crate::bodies::Bodies;
use crate::gradient::parameters_of;
use crate::shape::Shape;
use interp::LoadAndPenetration;
use interp::check::finite_result;
use interp::{Curve, HalfSpace, Mechanics, Quantities, Quantity, System, Table};

/// A contact of a probe with a coated substrate, or with a half-space.
///
/// On a coated substrate it holds the system and the curve of its material, from a table or from a
/// solve. A half-space needs no curve. Each function is arithmetic with the values of the curve.
///
/// ```
/// # fn main() -> Result<(), contact::Error> {
/// use contact::{Contact, Control};
/// use interp::{Elastic, Probe, System, Table};
///
/// let system = |probe| {
///     Ok::<_, interp::Error>(System {
///         probe,
///         sphere_modulus: f64::INFINITY, // rigid
///         film: Elastic::new(2e4, 0.5)?,
///         film_thickness: 1e-5,
///         substrate: Elastic::new(5e10, 0.2)?,
///     })
/// };
/// let sphere = Contact::in_table(Table::embedded(), &system(Probe::Sphere { radius: 5e-6 })?)?;
/// let cone = Contact::in_table(Table::embedded(), &system(Probe::Cone { half_angle: 1.2 })?)?;
/// for contact in [sphere, cone] {
///     let pull_off = contact.pull_off(1e-4, Control::Displacement)?;
///     println!("{:e} N at {:e} m", pull_off.load, pull_off.penetration);
/// }
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Contact {
    pub(crate) mechanics: Mechanics,
    pub(crate) bodies: Bodies,
    pub(crate) shape: Shape,
    /// The contact of a quartic with the same bodies, made at the first question about the size of the shape; none where
    /// it is not known.
    pub(crate) quartic: OnceLock<Option<Box<Self>>>,
}

/// A state of a contact: its radius, its load and its penetration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Contact radius `a`, m.
    pub contact_radius: f64,
    /// Load `F`, N, positive in compression.
    pub load: f64,
    /// Penetration `delta`, m, positive when the sphere has moved in.
    pub penetration: f64,
}

impl State {
    /// The state without contact and without load in which the lowest point of the sphere would
    /// just touch.
    pub const ORIGIN: Self = Self {
        contact_radius: 0.0,
        load: 0.0,
        penetration: 0.0,
    };
}

impl Contact {
    /// Looks up the curve of a system's material, and returns the contact.
    ///
    /// # Errors
    /// As [`System::material`], [`Table::curve`] and [`Contact::new`].
    pub fn in_table(table: &Table, system: &System) -> Result<Self, Error> {
        Self::new(system, table.curve(&system.material()?)?)
    }

    /// Looks up the curve of a system's material with its derivatives, and returns the contact.
    ///
    /// [`Contact::gradient`] needs these derivatives.
    ///
    /// # Errors
    /// As [`Contact::in_table`].
    pub fn in_table_with_gradient(table: &Table, system: &System) -> Result<Self, Error> {
        Self::in_table_with_derivatives(table, system, &Input::ALL)
    }

    /// Looks up the curve of a system's material with the derivatives that [`Contact::derivatives`] with
    /// respect to some `inputs` need, and returns the contact. It takes less time than with all of
    /// them.
    ///
    /// # Errors
    /// As [`Contact::in_table`].
    pub fn in_table_with_derivatives(
        table: &Table,
        system: &System,
        inputs: &[Input],
    ) -> Result<Self, Error> {
        let wanted = parameters_of(system, inputs);
        Self::new(
            system,
            table.curve_with_derivatives(&system.material()?, &wanted)?,
        )
    }

    /// Joins a system with a curve made for its material.
    ///
    /// The curve may also be that of an equivalent material, which makes the same contact on a
    /// substrate with another Poisson ratio
    /// ([`Material::with_substrate_poisson_ratio`](interp::Material::with_substrate_poisson_ratio)).
    ///
    /// # Errors
    /// As [`System::material`]; [`Error::OtherMaterial`] if the material of the curve differs by
    /// more than rounding (`1e-12`). Under another probe than a paraboloid [`Error::Sticks`] on a curve with full
    /// friction; under one that is no flat punch either, as [`Curve::accept_integrals`].
    pub fn new(system: &System, curve: Curve) -> Result<Self, Error> {
        let (mechanics, made_for) = (Mechanics::new(system)?, curve.material());
        let material = system.material()?;
        if !material.is_equivalent_to(made_for) {
            return Err(Error::OtherMaterial {
                curve: made_for.to_array(),
                system: material.to_array(),
            });
        }
        let shape = Shape::on_film(system, &curve)?;
        let mechanics = match shape.largest_radius(system) {
            Some(most) => mechanics.with_largest_radius(most),
            None => mechanics,
        };
        Ok(Self {
            mechanics,
            bodies: Bodies::Coated {
                system: system.clone(),
                differentiated: curve
                    .differentiated_for()
                    .is_ok_and(|made_for| material.is_close_to(made_for)),
                curve,
            },
            shape,
            quartic: OnceLock::new(),
        })
    }

    /// Makes the contact of a probe on a half-space: JKR under a paraboloid, and closed forms under
    /// every other probe, to rounding.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// use interp::{Elastic, HalfSpace, Probe};
    /// use contact::{Contact, Control};
    ///
    /// let system = HalfSpace { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, solid: Elastic::new(2e11, 0.25)? };
    /// let pull_off = Contact::half_space(&system)?.pull_off(0.04, Control::Load)?;
    /// assert!((pull_off.load / (-1.5 * std::f64::consts::PI * 0.04 * 1e-3) - 1.0).abs() < 1e-14);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// As [`HalfSpace::compound_modulus`].
    pub fn half_space(system: &HalfSpace) -> Result<Self, Error> {
        Ok(Self {
            mechanics: Mechanics::half_space(system)?,
            bodies: Bodies::HalfSpace(system.clone()),
            shape: Shape::on_half_space(&system.probe),
            quartic: OnceLock::new(),
        })
    }

    /// Returns the dimensionless quantities as functions of `a/t`; `None` on a half-space.
    pub fn curve(&self) -> Option<&Curve> {
        match &self.bodies {
            Bodies::HalfSpace(_) => None,
            Bodies::Coated { curve, .. } => Some(curve),
        }
    }

    /// Returns probe, film and substrate; `None` on a half-space.
    pub fn system(&self) -> Option<&System> {
        match &self.bodies {
            Bodies::HalfSpace(_) => None,
            Bodies::Coated { system, .. } => Some(system),
        }
    }

    /// Returns the arithmetic of the contact, for quantities that are not those of its curve.
    pub fn mechanics(&self) -> &Mechanics {
        &self.mechanics
    }

    /// Returns the load `F` (N, positive in compression) at contact radius `a` (m) and work of
    /// adhesion `w` (J/m^2).
    ///
    /// It is eq. 9. Each of its two terms has the relative error of the curve.
    ///
    /// # Errors
    /// [`interp::Error::OutsideTable`] or [`interp::Error::Extrapolation`] where the curve does not cover `a/t`, as
    /// [`Curve::quantity`]; as [`Mechanics::check_radius`] for an `a` that the probe does not have, as with `a`
    /// and `w` in the wrong order; [`interp::Error::Unphysical`] for `w < 0`,
    /// infinity, NaN, or a load that overflows an f64; [`interp::Error::MissingQuantity`] without `pi0`
    /// and, if `w > 0`, without `eeq` and `gamma`.
    pub fn load(&self, a: f64, w: f64) -> Result<f64, Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        if w == 0.0 {
            return Ok(finite_result(a, self.adhesionless_load(a)?)?);
        }
        let (without, eeq_over_gamma) = self.load_factors(a)?;
        let lowered = Mechanics::load_lowered_by(a, edge, eeq_over_gamma);
        Ok(finite_result(a, without - lowered)?)
    }

    /// Returns load (N) and penetration (m, positive when the sphere moves in) at contact radius
    /// `a` (m) and work of adhesion `w` (J/m^2).
    ///
    /// # Errors
    /// As [`Contact::load`], and [`interp::Error::MissingQuantity`] without `delta0`.
    pub fn load_and_penetration(&self, a: f64, w: f64) -> Result<(f64, f64), Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let LoadAndPenetration { load, penetration } = if w == 0.0 {
            self.adhesionless(a)?
        } else {
            let (without, q) = self.adhesionless_and_quantities(a)?;
            without.minus(self.mechanics.lowered_by(a, edge, q.eeq, q.gamma))
        };
        Ok((finite_result(a, load)?, finite_result(a, penetration)?))
    }

    /// Returns the contact stiffness `S = 2 a E* Eeq` (N/m) at contact radius `a` (m), eq. 5: the
    /// slope of the load against the penetration while the contact radius stays.
    ///
    /// With full friction ([`Curve::with_stick`]) it is that of a flat punch that sticks.
    ///
    /// # Errors
    /// [`interp::Error::OutsideTable`] or [`interp::Error::Extrapolation`] where the curve does not cover `a/t`;
    /// [`interp::Error::MissingQuantity`] without `eeq`; as [`Mechanics::check_radius`] for `a`;
    /// [`interp::Error::Unphysical`] for a stiffness that overflows an f64.
    pub fn stiffness(&self, a: f64) -> Result<f64, Error> {
        self.mechanics.check_radius(a)?;
        let eeq = self.evaluate(
            a,
            |curve, x| curve.stick().unwrap_or(curve).quantity(Quantity::Eeq, x),
            Quantities::homogeneous(1.0).eeq,
        )?;
        Ok(finite_result(a, self.mechanics.stiffness(a, eeq))?)
    }

    /// Refuses a `question` whose answer needs a contact without friction.
    pub(crate) fn without_stick(
        &self,
        question: &'static str,
        reason: &'static str,
    ) -> Result<(), Error> {
        match self.curve().and_then(Curve::stick) {
            Some(_) => Err(Error::Sticks { question, reason }),
            None => Ok(()),
        }
    }

    /// Returns the stress intensity `K_I = sqrt(2 w Es*)` (Pa m^{1/2}) of the edge at contact
    /// radius `a` (m) and work of adhesion `w` (J/m^2).
    ///
    /// In the JKR limit `K_I` does not depend on the radius, and on the film only through `Es*`.
    /// [`Mechanics::stress_intensity`] gives its definition, [`Mechanics::edge_singularity`] gives
    /// `g(a)`.
    ///
    /// # Errors
    /// As [`Mechanics::edge_singularity`].
    pub fn stress_intensity(&self, a: f64, w: f64) -> Result<f64, Error> {
        Ok(finite_result(
            a,
            self.mechanics
                .stress_intensity(a, self.mechanics.edge_singularity(a, w)?),
        )?)
    }

    /// Returns all four quantities at contact radius `a` (m), in the normalisation that
    /// [`Mechanics`] expects.
    ///
    /// # Errors
    /// As [`Contact::stiffness`], and [`interp::Error::MissingQuantity`] unless the curve holds all four.
    pub fn quantities(&self, a: f64) -> Result<Quantities, Error> {
        self.mechanics.check_radius(a)?;
        match &self.bodies {
            Bodies::Coated { system, curve, .. } => {
                Ok(curve.quantities(a / system.film_thickness)?)
            }
            Bodies::HalfSpace(_) => Ok(Quantities::homogeneous(1.0)),
        }
    }

    /// Returns one quantity at contact radius `a` (m).
    pub(crate) fn quantity(&self, quantity: Quantity, a: f64) -> Result<f64, Error> {
        self.evaluate(
            a,
            |curve, x| curve.quantity(quantity, x),
            Quantities::homogeneous(1.0).get(quantity),
        )
    }

    /// Returns the state at contact radius `a` (m) and work of adhesion `w` (J/m^2).
    pub(crate) fn state(&self, a: f64, w: f64) -> Result<State, Error> {
        let (load, penetration) = self.load_and_penetration(a, w)?;
        Ok(State {
            contact_radius: a,
            load,
            penetration,
        })
    }

    /// Returns the state at contact radius `a` (m) with an energy of the contact line, and the
    /// slopes `dF/d ln a` (N) and `d delta/d ln a` (m) along the states of this energy.
    ///
    /// They are the derivatives of `F = F0 - 4 a g Eeq/Gamma` and
    /// `delta = delta0 - 2 g/(E* Gamma)`, where `g` grows like `(a G(a))^{1/2}`.
    #[inline]
    pub(crate) fn state_and_slopes(
        &self,
        a: f64,
        energy: LineEnergy,
    ) -> Result<(State, [f64; 2]), Error> {
        if energy.at(a) == 0.0 {
            self.mechanics.check_radius(a)?;
            let (without, slopes) = self.adhesionless_and_slopes(a)?;
            let state = Self::finite_state(a, without)?;
            return Ok((state, [slopes.load, slopes.penetration]));
        }
        let (without, slopes, values, relative) = self.everything_and_slopes(a)?;
        let [lowered, by_radius] = self.lowered_and_slopes(a, energy, &values, &relative)?;
        let state = Self::finite_state(a, without.minus(lowered))?;
        let slopes = slopes.minus(by_radius);
        Ok((state, [slopes.load, slopes.penetration]))
    }

    /// Returns by how much the energy of the contact line lowers load (N) and penetration (m) at
    /// contact radius `a` (m), and the derivatives with respect to `ln a`, from the quantities and the
    /// derivatives of their logarithms.
    #[inline]
    pub(crate) fn lowered_and_slopes(
        &self,
        a: f64,
        energy: LineEnergy,
        values: &Quantities,
        relative: &Quantities,
    ) -> Result<[LoadAndPenetration; 2], Error> {
        let edge = self.mechanics.edge_singularity(a, energy.at(a))?;
        let lowered = self.mechanics.lowered_by(a, edge, values.eeq, values.gamma);
        let of_edge = energy.slope_of_edge(a);
        let slopes = LoadAndPenetration {
            load: lowered.load * (1.0 + of_edge + relative.eeq - relative.gamma),
            penetration: lowered.penetration * (of_edge - relative.gamma),
        };
        Ok([lowered, slopes])
    }

    /// Returns a state unless it is infinite or NaN.
    fn finite_state(a: f64, of: LoadAndPenetration) -> Result<State, Error> {
        Ok(State {
            contact_radius: a,
            load: finite_result(a, of.load)?,
            penetration: finite_result(a, of.penetration)?,
        })
    }

    /// Evaluates the curve of the shape at the `a/t` of contact radius `a` (m), or returns the constant
    /// `half_space`. The radius must have been checked.
    pub(crate) fn evaluate<T>(
        &self,
        a: f64,
        curve: impl FnOnce(&Curve, f64) -> Result<T, interp::Error>,
        half_space: T,
    ) -> Result<T, Error> {
        match &self.bodies {
            Bodies::Coated {
                system, curve: own, ..
            } => Ok(curve(
                self.shape.curve().unwrap_or(own),
                a / system.film_thickness,
            )?),
            Bodies::HalfSpace(_) => Ok(half_space),
        }
    }
}
