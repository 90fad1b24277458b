//! Derivatives of load and penetration with respect to all their inputs.

use super::checks::finite_result;
use super::contact::Bodies;
use super::shape::{Pair, Shape};
use crate::material::one_minus_square;
use crate::{Contact, Error, HalfSpace, Normalisation, Quantities, QuantityGradient, System};

/// An input on which the load and the penetration of a contact depend, in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Input {
    /// Contact radius `a`, m.
    ContactRadius,
    /// Work of adhesion `w`, J/m^2.
    WorkOfAdhesion,
    /// Radius `R` of the probe, m: of the sphere or paraboloid, of the end of a cone, or of the
    /// punch.
    SphereRadius,
    /// Reduced modulus `E2*` of the sphere, Pa.
    SphereModulus,
    /// Thickness `t` of the film, m.
    FilmThickness,
    /// Young's modulus `E1` of the film, Pa.
    FilmModulus,
    /// Poisson ratio `nu1` of the film.
    FilmPoisson,
    /// Young's modulus `E0` of the substrate, Pa.
    SubstrateModulus,
    /// Poisson ratio `nu0` of the substrate.
    SubstratePoisson,
}

impl Input {
    /// All nine inputs.
    pub const ALL: [Self; 9] = [
        Self::ContactRadius,
        Self::WorkOfAdhesion,
        Self::SphereRadius,
        Self::SphereModulus,
        Self::FilmThickness,
        Self::FilmModulus,
        Self::FilmPoisson,
        Self::SubstrateModulus,
        Self::SubstratePoisson,
    ];

    /// Returns the name in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ContactRadius => "contact radius",
            Self::WorkOfAdhesion => "work of adhesion",
            Self::SphereRadius => "sphere radius",
            Self::SphereModulus => "sphere modulus",
            Self::FilmThickness => "film thickness",
            Self::FilmModulus => "film modulus",
            Self::FilmPoisson => "film Poisson ratio",
            Self::SubstrateModulus => "substrate modulus",
            Self::SubstratePoisson => "substrate Poisson ratio",
        }
    }
}

/// The derivatives of load and penetration with respect to one [`Input`] at fixed other inputs, in
/// N and m per unit of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives {
    /// The derivative of the load `F`.
    pub load: f64,
    /// The derivative of the penetration `delta`.
    pub penetration: f64,
}

/// Load and penetration at one contact radius and work of adhesion, with their derivatives.
#[derive(Clone, Copy, Debug)]
pub struct ContactGradient {
    load: f64,
    penetration: f64,
    /// The derivatives in the order of [`Input::ALL`]; `None` where one is not known.
    derivatives: [Option<Derivatives>; 9],
}

impl ContactGradient {
    /// Returns the load `F`, N.
    pub const fn load(&self) -> f64 {
        self.load
    }

    /// Returns the penetration `delta`, m.
    pub const fn penetration(&self) -> f64 {
        self.penetration
    }

    /// Returns the derivatives with respect to one `input`.
    ///
    /// They are 0 with respect to the modulus and the Poisson ratio of a rigid body.
    ///
    /// # Errors
    /// [`Error::FixedParameter`] for an input whose derivative needs a parameter of the material
    /// that the table fixes; for an input of the film on a half-space; for the radius of a probe
    /// that has none, and the contact radius of a flat punch, which is that of the punch; and for
    /// the work of adhesion if it is below 2.3e-308 J/m^2, because the load falls like its square root.
    pub fn by(&self, input: Input) -> Result<Derivatives, Error> {
        self.derivatives[input as usize].ok_or(Error::FixedParameter(input.name()))
    }
}

/// The derivatives, with respect to one input, of the logarithms of the factors of which the terms
/// of load and penetration are products.
#[derive(Clone, Copy, Default)]
struct LogDerivatives {
    contact_radius: f64,
    work_of_adhesion: f64,
    sphere_radius: f64,
    /// That of the modulus that normalises the quantities.
    modulus: f64,
    /// That of `es`, which is `Es*` in units of that modulus.
    es: f64,
    /// Those of the four quantities, in the order of [`Quantity::ALL`](crate::Quantity::ALL).
    quantities: [f64; 4],
    /// Those of the parameters of the material: `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and `nu0`.
    parameters: [f64; 4],
}

impl Contact {
    /// Computes load and penetration at contact radius `a` (m) and work of adhesion `w` (J/m^2),
    /// and their derivatives with respect to every [`Input`].
    ///
    /// Load and penetration are those of [`Contact::load_and_penetration`]. The derivatives follow
    /// by the chain rule through eqs. 2 and 4 to 8 and from the derivatives of the table's splines.
    ///
    /// ```
    /// # #[cfg(feature = "embedded")]
    /// # fn main() -> Result<(), interp::Error> {
    /// # use interp::{Elastic, Input, Probe, System, Table};
    /// # let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    /// # let system = System { probe: Probe::Paraboloid { radius: 1e-3 }, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
    /// let contact = Table::embedded().contact_with_gradient(&system)?;
    /// let gradient = contact.gradient(65e-6, 0.04)?;
    /// let [film, sphere] = [(Input::FilmModulus, 3.5e6), (Input::SphereModulus, 2e6)].map(|(input, modulus)| {
    ///     gradient.by(input).map(|derivatives| derivatives.load * modulus)
    /// });
    /// assert!(film?.abs() < 0.05 * sphere?.abs()); // a thin film is hardly seen
    /// # Ok(()) }
    /// # #[cfg(not(feature = "embedded"))]
    /// # fn main() {}
    /// ```
    ///
    /// # Errors
    /// As [`Contact::load_and_penetration`], but always [`Error::OutsideTable`] above the nodes in
    /// `a/t`; [`Error::NoGradient`] on a curve made without derivatives; [`Error::Unphysical`] for
    /// a derivative that overflows an f64; [`Error::OtherMaterial`] on a curve whose derivatives
    /// are those of an equivalent material on another substrate.
    pub fn gradient(&self, a: f64, w: f64) -> Result<ContactGradient, Error> {
        self.same_material()?;
        let terms = self.terms(a, w)?;
        let derivatives = Input::ALL.map(|input| terms.by(input));
        let numbers = derivatives
            .iter()
            .flatten()
            .flat_map(|by| [by.load, by.penetration]);
        numbers
            .chain([terms.load, terms.penetration])
            .try_for_each(|number| finite_result(a, number).map(drop))?;
        Ok(ContactGradient {
            load: terms.load,
            penetration: terms.penetration,
            derivatives,
        })
    }

    /// Accepts a curve whose derivatives are those of the material of the system itself.
    pub(super) fn same_material(&self) -> Result<(), Error> {
        let Bodies::Coated { system, curve } = &self.bodies else {
            return Ok(());
        };
        let (made_for, material) = (curve.differentiated_for()?, system.material()?);
        if material.is_close_to(made_for) {
            Ok(())
        } else {
            Err(Error::OtherMaterial {
                curve: made_for.to_array(),
                system: material.to_array(),
            })
        }
    }

    /// Returns the terms of load and penetration at contact radius `a` and work of adhesion `w`, from
    /// which any derivative follows. [`Self::same_material`] must have accepted the curve.
    pub(super) fn terms(&self, a: f64, w: f64) -> Result<Terms<'_>, Error> {
        let edge = self.mechanics.edge_singularity(a, w)?;
        let (values, gradient) = match &self.bodies {
            Bodies::HalfSpace(_) => (Quantities::homogeneous(1.0), None),
            Bodies::Coated { system, curve } => {
                let curve = self.shape.curve().unwrap_or(curve);
                let gradient = curve.gradient(a / system.film_thickness)?;
                (gradient.values(), Some(gradient))
            }
        };
        let without = match self.shape {
            Shape::Paraboloid { radius, .. } => {
                self.mechanics
                    .adhesionless(a, radius, values.pi0, values.delta0)
            }
            _ => self.adhesionless(a)?,
        };
        let lowered = self.mechanics.lowered_by(a, edge, values.eeq, values.gamma);
        Ok(Terms {
            contact: self,
            a,
            w,
            gradient,
            load: without.load - lowered.load,
            penetration: without.penetration - lowered.penetration,
            without,
            lowered,
            stiffness: self.mechanics.stiffness(a, values.eeq),
        })
    }
}

/// The terms of load and penetration at one contact radius and work of adhesion.
pub(super) struct Terms<'a> {
    contact: &'a Contact,
    a: f64,
    w: f64,
    /// `None` on a half-space.
    gradient: Option<QuantityGradient>,
    load: f64,
    penetration: f64,
    /// Those without adhesion.
    without: Pair,
    /// By how much adhesion lowers them.
    lowered: Pair,
    /// The stiffness of the contact, N/m.
    stiffness: f64,
}

impl Terms<'_> {
    /// Returns the derivatives with respect to one input; `None` if they are not known.
    pub(super) fn by(&self, input: Input) -> Option<Derivatives> {
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
    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Returns the derivative of the logarithm of the stiffness with respect to one input; `None` if
    /// it is not known.
    pub(super) fn stiffness_by(&self, input: Input) -> Option<f64> {
        if input == Input::WorkOfAdhesion {
            return Some(0.0);
        }
        let by = self.logarithms(input)?;
        let [_, eeq, ..] = by.quantities;
        Some(by.contact_radius + by.modulus + eeq)
    }

    /// Returns the derivatives of load and penetration without adhesion with respect to one input;
    /// `None` if they are not known.
    fn without_adhesion(&self, input: Input, by: &LogDerivatives) -> Option<Pair> {
        let Pair { load, penetration } = self.without;
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
                Some(Pair {
                    load: load * logarithms[0],
                    penetration: penetration * logarithms[1],
                })
            }
            Shape::Paraboloid { .. } => {
                let [pi0, _, _, delta0] = by.quantities;
                Some(Pair {
                    load: load * (3.0 * by.contact_radius + by.modulus + pi0 - by.sphere_radius),
                    penetration: penetration
                        * (2.0 * by.contact_radius + delta0 - by.sphere_radius),
                })
            }
            Shape::HalfSpace(transform) => Some(match input {
                Input::ContactRadius => {
                    let b = transform.slope(self.a);
                    Pair {
                        load: self.stiffness * b,
                        penetration: b,
                    }
                }
                // `b(s; R)` is `R` times a function of `s/R`: its derivative is `(b - s b')/R`.
                Input::SphereRadius => {
                    let own = self.a * transform.slope(self.a);
                    let stiffness = self.stiffness;
                    Pair {
                        load: by.sphere_radius * (2.0 * load - stiffness * own),
                        penetration: by.sphere_radius * (penetration - own),
                    }
                }
                _ => Pair {
                    load: load * by.modulus,
                    penetration: 0.0,
                },
            }),
            Shape::Punch => Some(Pair::ZERO),
            Shape::Solved(..) => self.without_adhesion_on_film(input, by).ok(),
        }
    }

    /// Returns the derivatives of load and penetration without adhesion under a shape that is solved
    /// on a film.
    fn without_adhesion_on_film(&self, input: Input, by: &LogDerivatives) -> Result<Pair, Error> {
        let (contact, a) = (self.contact, self.a);
        let Pair { load, penetration } = self.without;
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
                Pair {
                    load: 2.0 * load - slopes.load - size.load,
                    penetration: penetration - slopes.penetration - size.penetration,
                }
                .times(1.0 / t)
            }
            _ => {
                let mut sum = Pair {
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
    fn logarithms(&self, input: Input) -> Option<LogDerivatives> {
        match input {
            Input::ContactRadius if self.contact.is_punch() => None,
            Input::SphereRadius if self.contact.is_punch() => self.by_contact_radius(),
            Input::SphereRadius => Some(LogDerivatives {
                sphere_radius: 1.0 / self.contact.probe().radius()?,
                ..LogDerivatives::default()
            }),
            Input::ContactRadius => self.by_contact_radius(),
            // Below the normal numbers `1 / w` may overflow.
            Input::WorkOfAdhesion => self.w.is_normal().then(|| LogDerivatives {
                work_of_adhesion: 1.0 / self.w,
                ..LogDerivatives::default()
            }),
            _ => self.by_body(input),
        }
    }

    /// Returns the derivatives of the logarithms of the factors with respect to the contact radius.
    fn by_contact_radius(&self) -> Option<LogDerivatives> {
        Some(LogDerivatives {
            contact_radius: 1.0 / self.a,
            ..self.by_body(Input::ContactRadius)?
        })
    }

    /// Returns the derivatives of the logarithms of the factors that depend on the bodies.
    fn by_body(&self, input: Input) -> Option<LogDerivatives> {
        match (&self.contact.bodies, &self.gradient) {
            (Bodies::Coated { system, .. }, Some(gradient)) => {
                coated_derivatives(system, gradient, input, self.a)
            }
            (Bodies::HalfSpace(system), _) => {
                half_space_derivatives(system, self.contact.mechanics.sphere_film_modulus(), input)
            }
            (Bodies::Coated { .. }, None) => None,
        }
    }
}

/// Returns the derivatives with respect to the contact radius (but for its own logarithm), the
/// thickness or an elastic constant of a coated contact.
fn coated_derivatives(
    system: &System,
    gradient: &QuantityGradient,
    input: Input,
    a: f64,
) -> Option<LogDerivatives> {
    let with_a_over_t = |factor: f64| {
        let (values, slopes) = (gradient.values().to_array(), gradient.slopes().to_array());
        Some(LogDerivatives {
            quantities: std::array::from_fn(|i| factor * slopes[i] / values[i]),
            ..LogDerivatives::default()
        })
    };
    match input {
        Input::ContactRadius => with_a_over_t(1.0 / a),
        Input::FilmThickness => with_a_over_t(-1.0 / system.film_thickness),
        _ => elastic_derivatives(
            gradient,
            input,
            [
                system.sphere_modulus,
                system.film.young(),
                system.substrate.young(),
            ],
        ),
    }
}

/// Returns the derivatives of a contact with a half-space. The quantities are constant, and the
/// `compound` modulus `E*` is their unit.
fn half_space_derivatives(
    system: &HalfSpace,
    compound: f64,
    input: Input,
) -> Option<LogDerivatives> {
    let (young, nu0) = (system.solid.young(), system.solid.poisson());
    let share = compound / system.solid.reduced();
    let modulus = match input {
        Input::ContactRadius => 0.0,
        Input::SphereModulus => compound / system.sphere_modulus / system.sphere_modulus,
        Input::SubstrateModulus => share / young,
        Input::SubstratePoisson => share * 2.0 * nu0 / one_minus_square(nu0),
        _ => return None,
    };
    Some(LogDerivatives {
        modulus,
        ..LogDerivatives::default()
    })
}

/// Returns the derivatives with respect to one elastic constant; `None` if they are not known.
fn elastic_derivatives(
    gradient: &QuantityGradient,
    input: Input,
    moduli: [f64; 3],
) -> Option<LogDerivatives> {
    let material = gradient.material();
    // The derivatives of `ln e1_over_e2`, `nu1`, `ln e0_over_e2`, `nu0` and the logarithm of the
    // normalising modulus with respect to the logarithm of the modulus, or to the Poisson ratio.
    let ([e1, nu1, e0, nu0], modulus) = match (input, material.normalisation()) {
        (Input::SphereModulus, Normalisation::Sphere) => ([-1.0, 0.0, -1.0, 0.0], 1.0),
        (Input::FilmModulus, Normalisation::Sphere) => ([1.0, 0.0, 0.0, 0.0], 0.0),
        (Input::FilmPoisson, Normalisation::Sphere) => ([0.0, 1.0, 0.0, 0.0], 0.0),
        (Input::FilmModulus, Normalisation::Film) => ([0.0, 0.0, -1.0, 0.0], 1.0),
        (Input::FilmPoisson, Normalisation::Film) => (
            [0.0, 1.0, 0.0, 0.0],
            2.0 * material.nu1() / one_minus_square(material.nu1()),
        ),
        (Input::SubstrateModulus, _) => ([0.0, 0.0, 1.0, 0.0], 0.0),
        (Input::SubstratePoisson, _) => ([0.0, 0.0, 0.0, 1.0], 0.0),
        // The modulus of a rigid sphere.
        _ => ([0.0; 4], 0.0),
    };
    let [sphere, film, substrate] = moduli;
    let unit = match input {
        Input::SphereModulus => 1.0 / sphere,
        Input::FilmModulus => 1.0 / film,
        Input::SubstrateModulus => 1.0 / substrate,
        _ => 1.0,
    };
    let mut logarithms = LogDerivatives {
        modulus: unit * modulus,
        ..LogDerivatives::default()
    };
    for (parameter, factor) in [e1, nu1, e0, nu0]
        .into_iter()
        .enumerate()
        .filter(|&(_, factor)| factor != 0.0)
    {
        let derivatives = gradient.relative(parameter)?;
        logarithms.parameters[parameter] = unit * factor;
        logarithms.es += unit * factor * gradient.scale(parameter);
        logarithms
            .quantities
            .iter_mut()
            .zip(derivatives)
            .for_each(|(sum, derivative)| *sum += unit * factor * derivative);
    }
    Some(logarithms)
}
