//! The shapes of probes, each with the way in which its load and penetration are found.

use std::sync::Arc;

use interp::LoadAndPenetration;
use interp::{Curve, Elastic, MaterialParameter, Probe, Quantities, Quantity, System};

use super::even_powers::{EvenPowers, EvenShape, LARGEST_A_OVER_R};
use super::solved::Solved;
use super::transform::{Transform, kappa};
use crate::Contact;
use crate::Error;
use crate::bodies::Bodies;

/// How load and penetration without adhesion are found.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    /// From `Pi0` and `Delta0`, as for a paraboloid of a radius (m).
    Paraboloid {
        radius: f64,
        /// The shape of even powers whose load and penetration those of this paraboloid are; none for
        /// the paraboloid itself.
        even: Option<EvenPowers>,
    },
    /// From the field of the flat punch, on a film.
    Solved(Arc<Solved>),
    /// In closed form, on a half-space.
    HalfSpace(Transform),
    /// They are 0 at the only contact radius, that of a flat punch.
    Punch,
}

/// The quantities on a half-space in units of its compound modulus.
const HOMOGENEOUS: Quantities = Quantities::homogeneous(1.0);
/// The exponents of power laws that follow from even powers.
const EVEN: [f64; 3] = [4.0, 6.0, 8.0];

impl Shape {
    /// The shape of a paraboloid.
    const fn paraboloid(radius: f64) -> Self {
        Self::Paraboloid { radius, even: None }
    }

    /// Returns the largest contact radius (m) that is computed on a film, if the probe itself has
    /// larger ones.
    pub(crate) fn largest_radius(&self, system: &System) -> Option<f64> {
        match (self, &system.probe) {
            (Self::Solved(solved), _) => Some(solved.last() * system.film_thickness),
            (_, Probe::Sphere { radius }) => Some(LARGEST_A_OVER_R * radius),
            _ => None,
        }
    }

    /// Returns the curve to look up, if it is not that of the material.
    pub(crate) const fn curve(&self) -> Option<&Curve> {
        match self {
            Self::Paraboloid {
                even: Some(even), ..
            } => Some(even.curve()),
            _ => None,
        }
    }

    /// Chooses how the shape of a probe is computed on a film.
    pub(crate) fn on_film(system: &System, curve: &Curve) -> Result<Self, Error> {
        let probe = &system.probe;
        let even = |shape: EvenShape, radius: f64| {
            let even = Some(EvenPowers::new(curve, shape)?);
            Ok(Self::Paraboloid { radius, even })
        };
        let paraboloid = match *probe {
            Probe::Paraboloid { .. } => true,
            Probe::PowerLaw { exponent, .. } => exponent == 2.0,
            _ => false,
        };
        if curve.stick().is_some() && probe.is_flat_punch() {
            return Err(Error::Sticks {
                question: "the contact of a flat punch",
                reason: "friction multiplies its load at a penetration by one number, eeq_s/eeq: take a curve without \
                         friction, and this number from a solve of the punch that sticks",
            });
        }
        if curve.stick().is_some() && !paraboloid {
            return Err(Error::Sticks {
                question: "the contact of another probe than a paraboloid",
                reason: "other shapes follow from the flat punch without friction only; take the \
                         paraboloid with the radius of the tip, or a curve without friction",
            });
        }
        let t = system.film_thickness;
        match *probe {
            Probe::Paraboloid { radius } => Ok(Self::paraboloid(radius)),
            Probe::Sphere { radius } => even(EvenShape::Sphere(radius / t), radius),
            Probe::PowerLaw {
                coefficient,
                exponent: 2.0,
            } => Ok(Self::paraboloid(0.5 / coefficient)),
            Probe::PowerLaw {
                coefficient,
                exponent,
            } if EVEN.contains(&exponent) => {
                let factor = coefficient * kappa(exponent) * t.powf(exponent - 1.0);
                let k = (0.5 * exponent) as usize - 1;
                even(EvenShape::Power { factor, k }, t)
            }
            _ => {
                let Some(transform) = Transform::of(probe) else {
                    return Ok(Self::Punch);
                };
                let most = match probe {
                    Probe::Profile(profile) => profile.end() / t,
                    _ => f64::INFINITY,
                };
                let solved = Solved::new(curve, transform.in_units_of(t), most)?;
                Ok(Self::Solved(Arc::new(solved)))
            }
        }
    }

    /// Chooses how the shape of a probe is computed on a half-space.
    pub(crate) fn on_half_space(probe: &Probe) -> Self {
        match (probe, Transform::of(probe)) {
            (Probe::Paraboloid { radius }, _) => Self::paraboloid(*radius),
            (_, Some(transform)) => Self::HalfSpace(transform),
            (_, None) => Self::Punch,
        }
    }
}

/// Returns the derivatives of the logarithms of quantities from their slopes.
fn relative(values: &Quantities, slopes: &Quantities) -> Quantities {
    let [values, slopes] = [values.to_array(), slopes.to_array()];
    Quantities::from_array(std::array::from_fn(|i| slopes[i] / values[i]))
}

impl Contact {
    /// Returns load and penetration at contact radius `a` (m) without adhesion. The radius must have
    /// been checked, here and below.
    pub(crate) fn adhesionless(&self, a: f64) -> Result<LoadAndPenetration, Error> {
        match &self.shape {
            Shape::Paraboloid { radius, .. } => {
                let pi0 = self.quantity(Quantity::Pi0, a)?;
                let delta0 = self.quantity(Quantity::Delta0, a)?;
                Ok(self.mechanics.adhesionless(a, *radius, pi0, delta0))
            }
            Shape::HalfSpace(transform) => Ok(self.on_half_space(transform, a)),
            Shape::Solved(solved) => Ok(self.on_film(solved, a)?.0),
            Shape::Punch => Ok(LoadAndPenetration::ZERO),
        }
    }

    /// Returns the load at contact radius `a` (m) without adhesion.
    pub(crate) fn adhesionless_load(&self, a: f64) -> Result<f64, Error> {
        if let Shape::Paraboloid { radius, .. } = self.shape {
            let pi0 = self.quantity(Quantity::Pi0, a)?;
            return Ok(self.mechanics.adhesionless_load(a, radius, pi0));
        }
        Ok(self.adhesionless(a)?.load)
    }

    /// Returns the penetration at contact radius `a` (m) without adhesion.
    pub(crate) fn adhesionless_penetration(&self, a: f64) -> Result<f64, Error> {
        if let Shape::Paraboloid { radius, .. } = self.shape {
            return Ok(a * a * self.quantity(Quantity::Delta0, a)? / radius);
        }
        Ok(self.adhesionless(a)?.penetration)
    }

    /// Returns the load at contact radius `a` (m) without adhesion, and `Eeq/Gamma`, which eq. 9
    /// needs.
    pub(crate) fn load_factors(&self, a: f64) -> Result<(f64, f64), Error> {
        if let Shape::Paraboloid { radius, .. } = self.shape {
            let (pi0, eeq_over_gamma) = self.evaluate(a, Curve::load_factors, (8.0 / 3.0, 1.0))?;
            return Ok((
                self.mechanics.adhesionless_load(a, radius, pi0),
                eeq_over_gamma,
            ));
        }
        let (without, values) = self.adhesionless_and_quantities(a)?;
        Ok((without.load, values.eeq / values.gamma))
    }

    /// Returns load and penetration at contact radius `a` (m) without adhesion, and the quantities
    /// there, of which only `Eeq` and `Gamma` do not depend on the shape.
    pub(crate) fn adhesionless_and_quantities(
        &self,
        a: f64,
    ) -> Result<(LoadAndPenetration, Quantities), Error> {
        let values = self.evaluate(a, Curve::quantities, HOMOGENEOUS)?;
        let without = match &self.shape {
            Shape::Paraboloid { radius, .. } => {
                self.mechanics
                    .adhesionless(a, *radius, values.pi0, values.delta0)
            }
            _ => self.adhesionless(a)?,
        };
        Ok((without, values))
    }

    /// Returns load and penetration at contact radius `a` (m) without adhesion, and their
    /// derivatives with respect to `ln a`.
    pub(crate) fn adhesionless_and_slopes(
        &self,
        a: f64,
    ) -> Result<(LoadAndPenetration, LoadAndPenetration), Error> {
        if let Shape::Paraboloid { .. } = self.shape {
            let homogeneous = (HOMOGENEOUS, Quantities::from_array([0.0; 4]));
            let (values, slopes) = self.evaluate(a, Curve::adhesionless_and_slopes, homogeneous)?;
            return self.with_slopes(a, &values, &slopes);
        }
        let eeq = self.quantity(Quantity::Eeq, a)?;
        let values = Quantities { eeq, ..HOMOGENEOUS };
        self.with_slopes(a, &values, &Quantities::from_array([0.0; 4]))
    }

    /// Returns load and penetration at contact radius `a` (m) without adhesion, their derivatives
    /// with respect to `ln a`, the quantities, and the derivatives of the logarithms of these.
    #[inline]
    pub(crate) fn everything_and_slopes(
        &self,
        a: f64,
    ) -> Result<
        (
            LoadAndPenetration,
            LoadAndPenetration,
            Quantities,
            Quantities,
        ),
        Error,
    > {
        let homogeneous = (HOMOGENEOUS, Quantities::from_array([0.0; 4]));
        let (values, slopes) = self.evaluate(a, Curve::quantities_and_slopes, homogeneous)?;
        let (without, by_radius) = self.with_slopes(a, &values, &slopes)?;
        Ok((without, by_radius, values, relative(&values, &slopes)))
    }

    /// Returns the quantities at contact radius `a` (m), and the derivatives of their logarithms with
    /// respect to `ln a`.
    pub(crate) fn quantities_and_relative_slopes(
        &self,
        a: f64,
    ) -> Result<(Quantities, Quantities), Error> {
        let homogeneous = (HOMOGENEOUS, Quantities::from_array([0.0; 4]));
        let (values, slopes) = self.evaluate(a, Curve::quantities_and_slopes, homogeneous)?;
        Ok((values, relative(&values, &slopes)))
    }

    /// Returns lower bounds of the derivatives of load and penetration without adhesion with respect
    /// to `ln a` at contact radius `a` (m); `None` unless they take less time than the derivatives, and
    /// for a film that is stiffer than its substrate, under which the bounds do not hold.
    pub(crate) fn least_slopes(&self, a: f64) -> Result<Option<LoadAndPenetration>, Error> {
        let (Shape::Solved(solved), Bodies::Coated { system, .. }) = (&self.shape, &self.bodies)
        else {
            return Ok(None);
        };
        if system.film.reduced() > system.substrate.reduced() {
            return Ok(None);
        }
        let penetration = a * solved.least_slope(a / system.film_thickness)?;
        let load = self
            .mechanics
            .stiffness(a, self.quantity(Quantity::Eeq, a)?)
            * penetration;
        Ok(Some(LoadAndPenetration { load, penetration }))
    }

    /// Returns load and penetration without adhesion and their derivatives with respect to `ln a`
    /// from the quantities and their slopes. Of these, a paraboloid needs `Pi0` and `Delta0`, and every other shape `Eeq`, because `F0' = S delta0'`.
    #[inline]
    fn with_slopes(
        &self,
        a: f64,
        values: &Quantities,
        slopes: &Quantities,
    ) -> Result<(LoadAndPenetration, LoadAndPenetration), Error> {
        let (value, penetration) = match &self.shape {
            Shape::Paraboloid { radius, .. } => {
                let value = self
                    .mechanics
                    .adhesionless(a, *radius, values.pi0, values.delta0);
                let by_radius = LoadAndPenetration {
                    load: value.load * (3.0 + slopes.pi0 / values.pi0),
                    penetration: value.penetration * (2.0 + slopes.delta0 / values.delta0),
                };
                return Ok((value, by_radius));
            }
            Shape::HalfSpace(transform) => {
                (self.on_half_space(transform, a), a * transform.slope(a))
            }
            Shape::Solved(solved) => self.on_film(solved, a)?,
            Shape::Punch => return Err(self.makes_no_sense("a change of the contact radius")),
        };
        let by_radius = LoadAndPenetration {
            load: self.mechanics.stiffness(a, values.eeq) * penetration,
            penetration,
        };
        Ok((value, by_radius))
    }

    /// Returns load and penetration on a half-space: `2 E* (a b - int b)` and `b`.
    fn on_half_space(&self, transform: &Transform, a: f64) -> LoadAndPenetration {
        let b = transform.value(a);
        let modulus = self.mechanics.sphere_film_modulus();
        LoadAndPenetration {
            load: 2.0 * modulus * (a * b - transform.integral(a)),
            penetration: b,
        }
    }

    /// Returns load and penetration on a film, and the derivative of the penetration with respect to
    /// `ln a`.
    fn on_film(&self, solved: &Solved, a: f64) -> Result<(LoadAndPenetration, f64), Error> {
        let t = self.film_thickness();
        let values = solved.values(a / t)?;
        let pair = LoadAndPenetration {
            load: self.mechanics.sphere_film_modulus() * t * t * values.load,
            penetration: t * values.penetration,
        };
        Ok((pair, a * values.slope))
    }

    /// Returns the derivatives of load and penetration without adhesion with respect to a parameter
    /// of the material, at a fixed modulus of sphere and film, or, without one, to the logarithm of all lengths of the
    /// shape.
    ///
    /// It is not inlined, because shapes that do not need it would take its registers.
    #[inline(never)]
    pub(crate) fn by(
        &self,
        parameter: Option<MaterialParameter>,
        a: f64,
    ) -> Result<LoadAndPenetration, Error> {
        match (&self.shape, self.curve()) {
            (Shape::Solved(solved), Some(curve)) => {
                let t = self.film_thickness();
                let [penetration, load] = match parameter {
                    Some(parameter) => solved.by_parameter(curve, parameter, a / t)?,
                    None => solved.by_size(a / t)?,
                };
                Ok(LoadAndPenetration {
                    load: self.mechanics.sphere_film_modulus() * t * t * load,
                    penetration: t * penetration,
                })
            }
            _ => Ok(LoadAndPenetration::ZERO),
        }
    }

    /// Returns the thickness of the film, m; infinity on a half-space.
    fn film_thickness(&self) -> f64 {
        self.system()
            .map_or(f64::INFINITY, |system| system.film_thickness)
    }

    /// Returns whether the probe is a flat punch, whose contact has one radius.
    pub(crate) const fn is_punch(&self) -> bool {
        matches!(self.shape, Shape::Punch)
    }

    /// Returns the radii (m) at which the shape bends, ascending; none for a shape without bends
    /// off its axis.
    pub(crate) fn bends(&self) -> Vec<f64> {
        let (transform, unit) = match &self.shape {
            Shape::HalfSpace(transform) => (transform, 1.0),
            Shape::Solved(solved) => (solved.transform(), self.film_thickness()),
            _ => return Vec::new(),
        };
        let radii = transform.knots().iter().map(|knot| unit * knot.radius);
        radii.filter(|radius| *radius > 0.0).collect()
    }

    /// Returns whether the smallest contact has a positive radius, as that of a flat end.
    pub(crate) const fn has_flat_end(&self) -> bool {
        self.mechanics.radii()[0] > 0.0
    }

    /// Makes the error of a question that makes no sense for a flat punch.
    pub(crate) fn makes_no_sense(&self, question: &'static str) -> Error {
        interp::Error::OtherProbe {
            question,
            probe: self.mechanics.probe(),
            reason: "its contact has one radius, that of the punch; ask for `Contact::pull_off`, \
                     `Contact::stiffness` or the equilibria at a load or penetration",
        }
        .into()
    }

    /// Returns the solid that touches the probe, and the modulus of the probe.
    pub(crate) const fn touched(&self) -> (Elastic, f64) {
        match &self.bodies {
            Bodies::Coated { system, .. } => (system.film, system.sphere_modulus),
            Bodies::HalfSpace(system) => (system.solid, system.sphere_modulus),
        }
    }

    /// Returns the bodies' probe.
    pub(crate) const fn probe(&self) -> &Probe {
        match &self.bodies {
            Bodies::Coated { system, .. } => &system.probe,
            Bodies::HalfSpace(system) => &system.probe,
        }
    }
}
