//! The terms of load and penetration at one contact radius, and their derivatives.

use super::logarithms::{LogDerivatives, coated_derivatives, half_space_derivatives};
use super::{Derivatives, Input};
use crate::Contact;
use crate::Error;
use crate::bodies::Bodies;
use crate::shape::Shape;
use interp::LoadAndPenetration;
use interp::{Quantities, QuantityGradient};

impl Contact {
    /// Returns the terms of load and penetration at contact radius `a` and work of adhesion `w`, from
    /// which any derivative follows. [`Self::same_material`] must have accepted the curve.
    pub(crate) fn terms(&self, a: f64, w: f64) -> Result<Terms<'_>, Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let (values, gradient) = match &self.bodies {
            Bodies::HalfSpace(_) => (Quantities::homogeneous(1.0), None),
            Bodies::Coated { system, curve, .. } => {
                let curve = self.shape.curve().unwrap_or(curve);
                let gradient = curve.gradient(a / system.film_thickness)?;
                (gradient.values(), Some(gradient))
            }
        };
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
            load: without.load - lowered.load,
            penetration: without.penetration - lowered.penetration,
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
    gradient: Option<QuantityGradient>,
    /// The derivatives of the logarithms of the quantities with respect to `ln(a/t)`.
    by_a_over_t: [f64; 4],
    pub(super) load: f64,
    pub(super) penetration: f64,
    /// Those without adhesion.
    without: LoadAndPenetration,
    /// By how much adhesion lowers them.
    lowered: LoadAndPenetration,
    /// The stiffness of the contact, N/m.
    stiffness: f64,
}

impl Terms<'_> {
    /// Returns the derivatives with respect to one input; `None` if they are not known.
    #[inline(always)]
    pub(crate) fn by(&self, input: Input) -> Option<Derivatives> {
        let logarithms = self.logarithms(input)?;
        let LogDerivatives {
            contact_radius,
            work_of_adhesion,
            modulus,
            es,
            quantities: [_, eeq, gamma, _],
            ..
        } = logarithms;
        // That of `g = sqrt(pi a w Es* / 2)`.
        let edge = 0.5 * (contact_radius + work_of_adhesion + modulus + es);
        let (without, lowered) = (self.without_adhesion(input, &logarithms)?, self.lowered);
        Some(Derivatives {
            load: without.load - lowered.load * (contact_radius + edge + eeq - gamma),
            penetration: without.penetration - lowered.penetration * (edge - modulus - gamma),
        })
    }

    /// Returns the stiffness of the contact, N/m.
    pub(crate) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Returns the derivative of the logarithm of the stiffness with respect to one input; `None` if
    /// it is not known.
    pub(crate) fn stiffness_by(&self, input: Input) -> Option<f64> {
        if input == Input::WorkOfAdhesion {
            return Some(0.0);
        }
        let by = self.logarithms(input)?;
        let [_, eeq, ..] = by.quantities;
        Some(by.contact_radius + by.modulus + eeq)
    }

    /// Returns the derivatives of load and penetration without adhesion with respect to one input;
    /// `None` if they are not known.
    #[inline(always)]
    fn without_adhesion(&self, input: Input, by: &LogDerivatives) -> Option<LoadAndPenetration> {
        let LoadAndPenetration { load, penetration } = self.without;
        match &self.contact.shape {
            Shape::Paraboloid {
                curve: Some(curve), ..
            } if matches!(input, Input::SphereRadius | Input::FilmThickness) => {
                let Bodies::Coated { system, .. } = &self.contact.bodies else {
                    return None;
                };
                let by_size = curve.by_size(self.a / system.film_thickness).ok()?;
                // The penetration is a length, and the load a modulus times its square. So their
                // logarithms have derivatives with respect to those of the thickness, of the
                // contact radius and of the size of the shape whose sums are 1 and 2.
                let logarithms = match input {
                    Input::SphereRadius => by_size.map(|size| size * by.sphere_radius),
                    _ => {
                        let [pi0, _, _, delta0] = by.quantities;
                        let t = system.film_thickness;
                        [
                            pi0 - (1.0 + by_size[0]) / t,
                            delta0 - (1.0 + by_size[1]) / t,
                        ]
                    }
                };
                Some(LoadAndPenetration {
                    load: load * logarithms[0],
                    penetration: penetration * logarithms[1],
                })
            }
            Shape::Paraboloid { .. } => {
                let [pi0, _, _, delta0] = by.quantities;
                Some(LoadAndPenetration {
                    load: load * (3.0 * by.contact_radius + by.modulus + pi0 - by.sphere_radius),
                    penetration: penetration
                        * (2.0 * by.contact_radius + delta0 - by.sphere_radius),
                })
            }
            Shape::HalfSpace(transform) => Some(match input {
                Input::ContactRadius => {
                    let b = transform.slope(self.a);
                    LoadAndPenetration {
                        load: self.stiffness * b,
                        penetration: b,
                    }
                }
                // `b(s; R)` is `R` times a function of `s/R`: its derivative is `(b - s b')/R`.
                Input::SphereRadius => {
                    let own = self.a * transform.slope(self.a);
                    let stiffness = self.stiffness;
                    LoadAndPenetration {
                        load: by.sphere_radius * (2.0 * load - stiffness * own),
                        penetration: by.sphere_radius * (penetration - own),
                    }
                }
                _ => LoadAndPenetration {
                    load: load * by.modulus,
                    penetration: 0.0,
                },
            }),
            Shape::Punch => Some(LoadAndPenetration::ZERO),
            Shape::Solved(..) => self.without_adhesion_on_film(input, by).ok(),
        }
    }

    /// Returns the derivatives of load and penetration without adhesion under a shape that is solved
    /// on a film.
    fn without_adhesion_on_film(
        &self,
        input: Input,
        by: &LogDerivatives,
    ) -> Result<LoadAndPenetration, Error> {
        let (contact, a) = (self.contact, self.a);
        let LoadAndPenetration { load, penetration } = self.without;
        Ok(match input {
            Input::ContactRadius => {
                let (_, slopes) = contact.adhesionless_and_slopes(a)?;
                slopes.times(1.0 / a)
            }
            Input::SphereRadius => contact.by_size(a)?.times(by.sphere_radius),
            // The penetration is a length, and the load a modulus times its square.
            Input::FilmThickness => {
                let (_, slopes) = contact.adhesionless_and_slopes(a)?;
                let size = contact.by_size(a)?;
                let t = contact.system().map_or(1.0, |system| system.film_thickness);
                LoadAndPenetration {
                    load: 2.0 * load - slopes.load - size.load,
                    penetration: penetration - slopes.penetration - size.penetration,
                }
                .times(1.0 / t)
            }
            _ => {
                let mut sum = LoadAndPenetration {
                    load: load * (by.modulus + by.es),
                    penetration: 0.0,
                };
                let changes = by.parameters.iter().enumerate();
                for (parameter, &factor) in changes.filter(|(_, factor)| **factor != 0.0) {
                    let own = contact.by_parameter(parameter, a)?.times(factor);
                    sum.load += own.load;
                    sum.penetration += own.penetration;
                }
                sum
            }
        })
    }
    /// Returns the derivatives of the logarithms of the factors with respect to one input.
    #[inline(always)]
    fn logarithms(&self, input: Input) -> Option<LogDerivatives> {
        match input {
            Input::ContactRadius if self.contact.is_punch() => None,
            Input::SphereRadius if self.contact.is_punch() => Some(self.by_contact_radius()),
            Input::SphereRadius => Some(LogDerivatives {
                sphere_radius: 1.0 / self.contact.probe().radius()?,
                ..LogDerivatives::default()
            }),
            Input::ContactRadius => Some(self.by_contact_radius()),
            // Below the normal numbers `1 / w` may overflow.
            Input::WorkOfAdhesion => self.w.is_normal().then(|| LogDerivatives {
                work_of_adhesion: 1.0 / self.w,
                ..LogDerivatives::default()
            }),
            _ => self.by_body(input),
        }
    }

    /// Returns the derivatives of the logarithms of the factors with respect to the contact radius.
    #[inline(always)]
    fn by_contact_radius(&self) -> LogDerivatives {
        LogDerivatives {
            contact_radius: 1.0 / self.a,
            quantities: self.by_a_over_t.map(|slope| slope / self.a),
            ..LogDerivatives::default()
        }
    }

    /// Returns the derivatives of the logarithms of the factors that depend on the bodies.
    #[inline(always)]
    fn by_body(&self, input: Input) -> Option<LogDerivatives> {
        match (&self.contact.bodies, &self.gradient) {
            (Bodies::Coated { system, .. }, Some(gradient)) => {
                if input == Input::FilmThickness {
                    let t = system.film_thickness;
                    return Some(LogDerivatives {
                        quantities: self.by_a_over_t.map(|slope| -slope / t),
                        ..LogDerivatives::default()
                    });
                }
                coated_derivatives(system, gradient, input)
            }
            (Bodies::HalfSpace(system), _) => {
                half_space_derivatives(system, self.contact.mechanics.sphere_film_modulus(), input)
            }
            (Bodies::Coated { .. }, None) => None,
        }
    }
}
