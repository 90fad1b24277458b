//! The terms of load and penetration at one contact radius, and their derivatives.

use super::{Derivatives, Input, elastic};
use crate::Contact;
use crate::Error;
use crate::bodies::Bodies;
use crate::shape::Shape;
use interp::{LoadAndPenetration, MaterialParameter, Quantities, QuantityGradient};

impl Contact {
    /// Returns the terms of load and penetration at contact radius `a` and work of adhesion `w`, from
    /// which any derivative follows. [`Self::same_material`] must have accepted the curve. `gradient` is
    /// where the terms keep that of the quantities, which would take long to copy.
    #[inline(always)]
    pub(crate) fn terms<'a>(
        &'a self,
        a: f64,
        w: f64,
        gradient: &'a mut Option<QuantityGradient>,
    ) -> Result<Terms<'a>, Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        if let Bodies::Coated { system, curve, .. } = &self.bodies {
            let curve = self.shape.curve().unwrap_or(curve);
            *gradient = Some(curve.gradient(a / system.film_thickness)?);
        }
        let gradient = gradient.as_ref();
        let values = gradient.map_or(Quantities::homogeneous(1.0), QuantityGradient::values);
        let without = match &self.shape {
            Shape::Paraboloid { radius, .. } => {
                self.mechanics
                    .adhesionless(a, *radius, values.pi0, values.delta0)
            }
            _ => self.adhesionless(a)?,
        };
        let lowered = self.mechanics.lowered_by(a, edge, values.eeq, values.gamma);
        let by_a_over_t = gradient.map_or([0.0; 4], |gradient| {
            let [values, slopes] = [gradient.values().to_array(), gradient.slopes().to_array()];
            std::array::from_fn(|i| slopes[i] / values[i])
        });
        Ok(Terms {
            contact: self,
            a,
            w,
            gradient,
            by_a_over_t,
            without,
            lowered,
            stiffness: self.mechanics.stiffness(a, values.eeq),
        })
    }
}

/// The terms of load and penetration at one contact radius and work of adhesion.
pub(crate) struct Terms<'a> {
    contact: &'a Contact,
    a: f64,
    w: f64,
    /// `None` on a half-space.
    gradient: Option<&'a QuantityGradient>,
    /// The derivatives of the logarithms of the quantities with respect to `ln(a/t)`.
    by_a_over_t: [f64; 4],
    /// Load and penetration without adhesion.
    without: LoadAndPenetration,
    /// By how much adhesion lowers them.
    lowered: LoadAndPenetration,
    /// The stiffness of the contact, N/m.
    pub(crate) stiffness: f64,
}

impl Terms<'_> {
    /// Returns the derivatives with respect to one input; `None` if they are not known.
    #[inline(always)]
    pub(crate) fn by(&self, input: Input) -> Option<Derivatives> {
        match input {
            Input::ContactRadius if self.contact.is_punch() => None,
            Input::ContactRadius | Input::FilmThickness if self.has_no_slopes() => None,
            Input::SphereRadius if self.contact.is_punch() && self.has_no_slopes() => None,
            Input::SphereRadius if self.contact.is_punch() => self.by_contact_radius(),
            Input::ContactRadius => self.by_contact_radius(),
            Input::SphereRadius => self.by_sphere_radius(),
            // Below the normal numbers `1 / w` may overflow.
            Input::WorkOfAdhesion => {
                (self.w.is_normal()).then(|| self.lowered.times(-0.5 / self.w))
            }
            Input::FilmThickness => self.by_thickness(),
            _ => {
                // The edge singularity grows like the root of the modulus.
                let by_modulus = LoadAndPenetration {
                    load: self.without.load - 0.5 * self.lowered.load,
                    penetration: 0.5 * self.lowered.penetration,
                };
                self.by_elastic_constant(input, by_modulus, |parameter| {
                    self.by_parameter(parameter)
                })
            }
        }
    }

    /// Returns what [`Self::by`] does. Loops over inputs call it: in a loop `by` would compute what any
    /// input needs before the first one.
    #[inline(never)]
    pub(crate) fn by_one(&self, input: Input) -> Option<Derivatives> {
        self.by(input)
    }

    /// Returns load and penetration.
    pub(super) fn pair(&self) -> LoadAndPenetration {
        self.without.minus(self.lowered)
    }

    /// Whether the quantities are those of a single a/t, which does not tell how they grow with it.
    fn has_no_slopes(&self) -> bool {
        self.by_a_over_t[0].is_nan()
    }

    /// Returns the derivative of the logarithm of the stiffness under a flat punch with respect to one
    /// input; `None` if it is not known.
    pub(crate) fn stiffness_by(&self, input: Input) -> Option<f64> {
        let [_, by_a_over_t, ..] = self.by_a_over_t;
        match input {
            Input::WorkOfAdhesion => Some(0.0),
            Input::ContactRadius => None,
            Input::SphereRadius | Input::FilmThickness if self.has_no_slopes() => None,
            Input::SphereRadius => Some((1.0 + by_a_over_t) / self.a),
            Input::FilmThickness => Some(-by_a_over_t / self.thickness()?),
            _ => {
                let stiffness = |load| LoadAndPenetration {
                    load,
                    ..LoadAndPenetration::ZERO
                };
                let by = |parameter| {
                    let [_, eeq, ..] = self.gradient?.relative(parameter)?;
                    Some(stiffness(eeq))
                };
                Some(self.by_elastic_constant(input, stiffness(1.0), by)?.load)
            }
        }
    }

    /// Returns the derivatives with respect to an elastic constant from those with respect to the
    /// logarithm of the modulus that normalises and to a parameter of the material.
    #[inline(always)]
    fn by_elastic_constant(
        &self,
        input: Input,
        by_modulus: LoadAndPenetration,
        by_parameter: impl Fn(MaterialParameter) -> Option<LoadAndPenetration>,
    ) -> Option<LoadAndPenetration> {
        match &self.contact.bodies {
            Bodies::Coated { system, .. } => {
                elastic::of_coated(system, input, by_modulus, by_parameter)
            }
            Bodies::HalfSpace(system) => {
                let compound = self.contact.mechanics.sphere_film_modulus();
                elastic::of_half_space(system, compound, input, by_modulus)
            }
        }
    }

    /// Returns the derivatives with respect to the contact radius, under a flat punch that of the
    /// punch.
    #[inline(always)]
    fn by_contact_radius(&self) -> Option<LoadAndPenetration> {
        let (a, lowered) = (self.a, self.lowered);
        let [pi0, eeq, gamma, delta0] = self.by_a_over_t;
        let without = match &self.contact.shape {
            Shape::Paraboloid { .. } => LoadAndPenetration {
                load: self.without.load * (3.0 + pi0),
                penetration: self.without.penetration * (2.0 + delta0),
            },
            Shape::HalfSpace(transform) => {
                let penetration = a * transform.slope(a);
                LoadAndPenetration {
                    load: self.stiffness * penetration,
                    penetration,
                }
            }
            Shape::Punch => LoadAndPenetration::ZERO,
            Shape::Solved(_) => self.contact.adhesionless_and_slopes(a).ok()?.1,
        };
        // The edge singularity `g = sqrt(pi a w Es* / 2)` grows like the root of the radius.
        let sum = LoadAndPenetration {
            load: without.load - lowered.load * (1.5 + eeq - gamma),
            penetration: without.penetration - lowered.penetration * (0.5 - gamma),
        };
        Some(sum.times(1.0 / a))
    }

    /// Returns the derivatives with respect to the radius of a probe that is not a flat punch.
    #[inline(always)]
    fn by_sphere_radius(&self) -> Option<LoadAndPenetration> {
        let LoadAndPenetration { load, penetration } = self.without;
        let by_size = match &self.contact.shape {
            Shape::Paraboloid {
                even: Some(even), ..
            } => {
                let [of_load, of_penetration] = even.by_size(self.a / self.thickness()?)?;
                LoadAndPenetration {
                    load: load * of_load,
                    penetration: penetration * of_penetration,
                }
            }
            Shape::Paraboloid { .. } => self.without.times(-1.0),
            // `b(s; R)` is `R` times a function of `s/R`: its derivative is `(b - s b')/R`.
            Shape::HalfSpace(transform) => {
                let own = self.a * transform.slope(self.a);
                LoadAndPenetration {
                    load: 2.0 * load - self.stiffness * own,
                    penetration: penetration - own,
                }
            }
            Shape::Punch => LoadAndPenetration::ZERO,
            Shape::Solved(_) => self.contact.by(None, self.a).ok()?,
        };
        Some(by_size.times(1.0 / self.contact.probe().radius()?))
    }

    /// Returns the derivatives with respect to the thickness of the film.
    #[inline(always)]
    fn by_thickness(&self) -> Option<LoadAndPenetration> {
        let t = self.thickness()?;
        let LoadAndPenetration { load, penetration } = self.without;
        let [pi0, eeq, gamma, delta0] = self.by_a_over_t;
        // The penetration is a length, and the load a modulus times its square. So their logarithms
        // have derivatives with respect to those of the thickness, of the contact radius and of the
        // size of the shape whose sums are 1 and 2.
        let without = match &self.contact.shape {
            Shape::Paraboloid {
                even: Some(even), ..
            } => {
                let [of_load, of_penetration] = even.by_size(self.a / self.thickness()?)?;
                LoadAndPenetration {
                    load: -load * (pi0 + 1.0 + of_load),
                    penetration: -penetration * (delta0 + 1.0 + of_penetration),
                }
            }
            Shape::Paraboloid { .. } => LoadAndPenetration {
                load: -load * pi0,
                penetration: -penetration * delta0,
            },
            Shape::Solved(_) => {
                let (_, slopes) = self.contact.adhesionless_and_slopes(self.a).ok()?;
                let size = self.contact.by(None, self.a).ok()?;
                LoadAndPenetration {
                    load: 2.0 * load - slopes.load - size.load,
                    penetration: penetration - slopes.penetration - size.penetration,
                }
            }
            Shape::HalfSpace(_) | Shape::Punch => LoadAndPenetration::ZERO,
        };
        let sum = LoadAndPenetration {
            load: without.load + self.lowered.load * (eeq - gamma),
            penetration: without.penetration - self.lowered.penetration * gamma,
        };
        Some(sum.times(1.0 / t))
    }

    /// Returns the derivatives with respect to a parameter of the material, at a fixed
    /// modulus that normalises.
    #[inline(always)]
    fn by_parameter(&self, parameter: MaterialParameter) -> Option<LoadAndPenetration> {
        let gradient = self.gradient?;
        let [pi0, eeq, gamma, delta0] = gradient.relative(parameter)?;
        let es = gradient.scale(parameter);
        let LoadAndPenetration { load, penetration } = self.without;
        let without = match &self.contact.shape {
            Shape::Paraboloid { .. } => LoadAndPenetration {
                load: load * pi0,
                penetration: penetration * delta0,
            },
            Shape::Solved(_) => {
                let own = self.contact.by(Some(parameter), self.a).ok()?;
                LoadAndPenetration {
                    load: load * es + own.load,
                    ..own
                }
            }
            Shape::HalfSpace(_) | Shape::Punch => LoadAndPenetration::ZERO,
        };
        let edge = 0.5 * es - gamma;
        Some(LoadAndPenetration {
            load: without.load - self.lowered.load * (edge + eeq),
            penetration: without.penetration - self.lowered.penetration * edge,
        })
    }

    /// Returns the thickness of the film, m.
    fn thickness(&self) -> Option<f64> {
        Some(self.contact.system()?.film_thickness)
    }
}
