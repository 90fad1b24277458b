//! Probe, film and substrate of an experiment, and their contact.

use contact::{Contact, Input, Validity};
use interp::{Elastic, HalfSpace, Probe, System, Table};
use solve::stack::{Interface, Stack};

use super::{LayerName, LayerQuantity, Layered, NamedLayer, Parameter};
use crate::Error;
use crate::statistics::zero;

/// The bodies in contact.
#[derive(Clone, Debug, PartialEq)]
pub enum Bodies {
    /// A probe on a film on a substrate.
    Coated(System),
    /// A probe on a half-space: JKR, or Hertz without adhesion. The parameters of the film are
    /// those of the half-space.
    HalfSpace(HalfSpace),
    /// A probe on a stack of layers. The parameters of the film do not apply; those of the layers
    /// do.
    Layered(Layered),
}

impl Bodies {
    /// Returns the shape of the probe.
    pub const fn probe(&self) -> &Probe {
        match self {
            Self::Coated(system) => &system.probe,
            Self::HalfSpace(half_space) => &half_space.probe,
            Self::Layered(layered) => &layered.probe,
        }
    }

    /// Returns the probe, to be changed.
    pub const fn probe_mut(&mut self) -> &mut Probe {
        match self {
            Self::Coated(system) => &mut system.probe,
            Self::HalfSpace(half_space) => &mut half_space.probe,
            Self::Layered(layered) => &mut layered.probe,
        }
    }

    /// Returns the reduced modulus of the probe, Pa.
    pub(crate) const fn sphere_modulus(&self) -> f64 {
        match self {
            Self::Coated(system) => system.sphere_modulus,
            Self::HalfSpace(half_space) => half_space.sphere_modulus,
            Self::Layered(layered) => layered.sphere_modulus,
        }
    }

    /// Returns the substrate or the base of the layers; `None` on a half-space.
    pub const fn base(&self) -> Option<Elastic> {
        match self {
            Self::Coated(system) => Some(system.substrate),
            Self::HalfSpace(_) => None,
            Self::Layered(layered) => Some(layered.base),
        }
    }

    /// Returns the layers on the base, where a film is bonded; `None` on a half-space, and for layers that
    /// cannot be.
    pub(crate) fn stack(&self) -> Option<Stack> {
        match self {
            Self::Coated(system) => Stack::of_film(system, Interface::Bonded).ok(),
            Self::HalfSpace(_) => None,
            Self::Layered(layered) => layered.stack().ok(),
        }
    }

    /// Returns the contact radius (m) that every contact must be below.
    pub(crate) const fn largest_radius(&self) -> f64 {
        match self.probe() {
            Probe::Paraboloid { radius } | Probe::Sphere { radius } => *radius,
            Probe::Profile(profile) => profile.end(),
            _ => f64::INFINITY,
        }
    }

    /// Returns the largest contact radius (m) up to which an exact sphere is solved on a film; `None` for other bodies.
    pub(crate) fn end_of_exact_sphere(&self) -> Option<f64> {
        match (self, self.probe()) {
            (Self::Coated(_), Probe::Sphere { radius }) => {
                Some(Validity::EXACT_SPHERE_A_OVER_R * radius)
            }
            _ => None,
        }
    }

    /// Returns the radius (m) of a paraboloid that makes, on a half-space and without adhesion, a
    /// contact of the radius and the penetration of this probe. `size` is the contact radius or,
    /// if it is `at_penetration`, the penetration. It gives starts of fits only.
    pub(crate) fn paraboloid(&self, size: f64, at_penetration: bool) -> f64 {
        match self.probe() {
            Probe::Paraboloid { radius } | Probe::Sphere { radius } => return *radius,
            // Its load grows like the penetration, that of a paraboloid like the power 3/2: they
            // are as large at this penetration, `2 a delta = 4/3 sqrt(R) delta^(3/2)`.
            Probe::FlatPunch { radius } => return 2.25 * radius * radius / size,
            _ => {}
        }
        let bare = HalfSpace {
            probe: self.probe().clone(),
            sphere_modulus: f64::INFINITY,
            solid: self.film(),
        };
        let penetration = |a: f64| {
            let contact = Contact::half_space(&bare).ok()?;
            let (_, penetration) = contact.load_and_penetration(a, 0.0).ok()?;
            Some(penetration)
        };
        if !at_penetration {
            return penetration(size).map_or(f64::NAN, |penetration| size * size / penetration);
        }
        let most = self.largest_radius().min(1e2);
        // A radius below a flat end has no penetration, and one at the end of a profile no contact.
        let excess = |u: f64| penetration(u.exp()).map_or(-size, |found| found - size);
        let u = zero(excess, 1e-15_f64.ln(), (most * (1.0 - 1e-12)).ln());
        u.exp().powi(2) / size
    }

    /// Returns the film, the solid of a half-space, or the top layer.
    pub fn film(&self) -> Elastic {
        match self {
            Self::Coated(system) => system.film,
            Self::HalfSpace(half_space) => half_space.solid,
            Self::Layered(layered) => layered.surface(),
        }
    }

    /// Returns the thickness of the film or of all layers, m; `None` on a half-space and on a base
    /// without layers.
    pub(crate) fn thickness(&self) -> Option<f64> {
        let of_top = self.top_thickness();
        match self {
            Self::Layered(layered) => of_top.map(|_| layered.thickness()),
            _ => of_top,
        }
    }

    /// Returns the thickness of the film or of the top layer, m; `None` on a half-space.
    pub(crate) fn top_thickness(&self) -> Option<f64> {
        match self {
            Self::Coated(system) => Some(system.film_thickness),
            Self::HalfSpace(_) => None,
            Self::Layered(layered) => layered.layers.last().map(|top| top.layer.thickness),
        }
    }

    /// Returns the name of the top layer of a stack, if it has one.
    pub(crate) fn top_name(&self) -> Option<LayerName> {
        match self {
            Self::Layered(layered) => layered.layers.last()?.name,
            _ => None,
        }
    }

    /// Returns the modulus of the film, or of the top layer if it has a name.
    pub fn modulus_of_top(&self) -> Parameter {
        let of_layer = |name| Parameter::Layer(name, LayerQuantity::Modulus);
        self.top_name().map_or(Parameter::FilmModulus, of_layer)
    }

    /// Returns the modulus of the film or of the sphere that makes a `compound` one with the reduced
    /// modulus `other` of the other body, Pa; without the other body, if the compound is no softer.
    pub(crate) fn modulus_beside(&self, parameter: Parameter, compound: f64, other: f64) -> f64 {
        let compliance = 1.0 / compound - 1.0 / other;
        let reduced = if compliance > 0.0 {
            1.0 / compliance
        } else {
            compound
        };
        match parameter {
            Parameter::SphereModulus => reduced,
            _ => reduced * (1.0 - self.film().poisson().powi(2)),
        }
    }

    /// Tells whether the contacts of these bodies have exact derivatives.
    pub(crate) const fn has_derivatives(&self) -> bool {
        !matches!(self, Self::Layered(_))
    }

    /// Returns these bodies with another value of one of their parameters. Other parameters change
    /// nothing.
    pub(crate) fn with(mut self, parameter: Parameter, value: f64) -> Result<Self, interp::Error> {
        let (sphere_modulus, film, thickness) = match &mut self {
            Self::Coated(system) => (
                &mut system.sphere_modulus,
                Some(&mut system.film),
                Some(&mut system.film_thickness),
            ),
            Self::HalfSpace(bare) => (&mut bare.sphere_modulus, Some(&mut bare.solid), None),
            Self::Layered(layered) => {
                if let Parameter::Layer(name, what) = parameter {
                    let all = layered.layers.iter_mut();
                    all.filter(|layer| layer.name == Some(name))
                        .try_for_each(|layer| layer.set(what, value))?;
                }
                let (film, thickness) = match &mut layered.layers[..] {
                    [NamedLayer { name: None, layer }] => {
                        (Some(&mut layer.solid), Some(&mut layer.thickness))
                    }
                    _ => (None, None),
                };
                (&mut layered.sphere_modulus, film, thickness)
            }
        };
        match (parameter, film, thickness) {
            (Parameter::SphereModulus, ..) => *sphere_modulus = value,
            (Parameter::FilmModulus, Some(film), _) => {
                *film = Elastic::new(value, film.poisson())?;
            }
            (Parameter::FilmPoissonRatio, Some(film), _) => {
                *film = Elastic::new(film.young(), value)?;
            }
            (Parameter::FilmThickness, _, Some(thickness)) => *thickness = value,
            _ => {}
        }
        Ok(self)
    }

    /// Returns the input of the contact that a parameter is.
    pub(crate) const fn input(&self, parameter: Parameter) -> Option<Input> {
        let coated = matches!(self, Self::Coated(_));
        Some(match parameter {
            Parameter::SphereModulus => Input::SphereModulus,
            Parameter::FilmModulus if coated => Input::FilmModulus,
            Parameter::FilmModulus => Input::SubstrateModulus,
            Parameter::FilmPoissonRatio if coated => Input::FilmPoisson,
            Parameter::FilmPoissonRatio => Input::SubstratePoisson,
            Parameter::FilmThickness => Input::FilmThickness,
            _ => return None,
        })
    }

    /// Makes the contact, with the derivatives with respect to some parameters. Contacts on layers have none.
    pub(crate) fn contact(&self, table: &Table, by: &[Parameter]) -> Result<Contact, Error> {
        Ok(match self {
            Self::Coated(system) if by.is_empty() => Contact::in_table(table, system)?,
            Self::Coated(system) => {
                let inputs: Vec<Input> = by.iter().filter_map(|&one| self.input(one)).collect();
                Contact::in_table_with_derivatives(table, system, &inputs)?
            }
            Self::HalfSpace(half_space) => Contact::half_space(half_space)?,
            Self::Layered(layered) => super::solver::contact(layered)?,
        })
    }
}
