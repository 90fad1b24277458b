//! The bodies of an experiment, and their contact.

use contact::{Contact, Input, Validity};
use interp::{Elastic, HalfSpace, Probe, System, Table};
use solve::stack::{LARGEST_CONTRAST, Layer, Stack};

use super::{
    Interrupt, LayerName, LayerQuantity, Measurement, NamedLayer, Parameter, Reach, Solver,
};
use crate::Error;
use crate::statistics::zero;

/// The bodies in contact: a probe on a film, on a stack of layers, or on a half-space.
///
/// A film is a single layer without a name. The parameters of the film are those of this layer, or of the half-space;
/// those of other layers have their names.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    /// The shape of the probe.
    pub probe: Probe,
    /// The reduced modulus `E2*` of the probe, Pa; infinity is rigid.
    pub sphere_modulus: f64,
    /// The substrate, the base of the layers, or the half-space; with an infinite modulus it is rigid.
    pub base: Elastic,
    /// The layers, from the base up. The probe touches the last one.
    pub layers: Vec<NamedLayer>,
    /// How contacts are made.
    pub solver: Solver,
    /// Up to which contact radii contacts on layers are needed.
    pub reach: Reach,
    /// Whether somebody no longer waits for the contacts.
    pub interrupt: Interrupt,
}

impl Bodies {
    /// Takes a probe on a film on a substrate.
    pub fn coated(system: &System) -> Self {
        Self {
            layers: NamedLayer::of_film(system),
            solver: Solver::Film,
            ..Self::half_space(system.without_film())
        }
    }

    /// Takes a probe on a half-space: JKR, or Hertz without adhesion.
    pub fn half_space(bare: HalfSpace) -> Self {
        Self {
            probe: bare.probe,
            sphere_modulus: bare.sphere_modulus,
            base: bare.solid,
            layers: Vec::new(),
            solver: Solver::HalfSpace,
            reach: Reach::up_to(0.0),
            interrupt: Interrupt::default(),
        }
    }

    /// Takes the base without layers, of which any probe has a contact stiffness. It has no parameter of a film.
    pub fn bare(measurement: &Measurement, base: HalfSpace) -> Self {
        Self {
            solver: Solver::Direct,
            reach: Reach::of(measurement, &base.probe),
            ..Self::half_space(base)
        }
    }

    /// Tells whether the probe is on a film in the table of a fit.
    pub fn are_coated(&self) -> bool {
        self.solver == Solver::Film
    }

    /// Tells whether the probe is on a half-space.
    pub fn are_half_space(&self) -> bool {
        self.solver == Solver::HalfSpace
    }

    /// Tells whether the probe is on a base without layers, that of a reference sample.
    pub fn are_bare(&self) -> bool {
        self.layers.is_empty() && !self.are_half_space()
    }

    /// Tells whether the contacts are those on layers, which have no exact derivatives.
    pub fn are_layered(&self) -> bool {
        !self.are_coated() && !self.are_half_space()
    }

    /// Returns the substrate or the base of the layers; `None` on a half-space.
    pub fn base(&self) -> Option<Elastic> {
        (!self.are_half_space()).then_some(self.base)
    }

    /// Returns the layers on their base.
    ///
    /// # Errors
    /// Those of [`Stack::new`].
    pub fn stack(&self) -> Result<Stack, solve::Error> {
        Stack::new(self.base, self.plain_layers())
    }

    /// Returns the layers as [`Self::stack`] does, on a rigid base where the base is too stiff beside one of them for a stack:
    /// at this contrast no contact tells one from the other. `None` where they are no stack.
    pub(crate) fn stack_or_on_rigid(&self) -> Option<Stack> {
        let layers = self.plain_layers();
        let moduli = layers.iter().map(|layer| layer.solid.young());
        let softest = moduli.fold(f64::INFINITY, f64::min);
        let base = if self.base.young() > LARGEST_CONTRAST * softest {
            Elastic::new(f64::INFINITY, self.base.poisson()).ok()?
        } else {
            self.base
        };
        Stack::new(base, layers).ok()
    }

    fn plain_layers(&self) -> Vec<Layer> {
        self.layers.iter().map(|named| named.layer).collect()
    }

    /// Returns the film on its substrate; `None` of other bodies.
    pub(crate) fn system(&self) -> Option<System> {
        let [NamedLayer { name: None, layer }] = self.layers[..] else {
            return None;
        };
        let is_film = self.are_coated() && layer.interface.is_bonded();
        is_film.then(|| System {
            probe: self.probe.clone(),
            sphere_modulus: self.sphere_modulus,
            film: layer.solid,
            film_thickness: layer.thickness,
            substrate: self.base,
        })
    }

    /// Returns the probe on a half-space of a `solid`.
    pub fn on(&self, solid: Elastic) -> HalfSpace {
        HalfSpace {
            probe: self.probe.clone(),
            sphere_modulus: self.sphere_modulus,
            solid,
        }
    }

    /// Returns the contact radius (m) that every contact must be below.
    pub(crate) const fn largest_radius(&self) -> f64 {
        match &self.probe {
            Probe::Paraboloid { radius } | Probe::Sphere { radius } => *radius,
            Probe::Profile(profile) => profile.end(),
            _ => f64::INFINITY,
        }
    }

    /// Returns the largest contact radius (m) up to which an exact sphere is solved on a film; `None` for other bodies.
    pub(crate) fn end_of_exact_sphere(&self) -> Option<f64> {
        match self.probe {
            Probe::Sphere { radius } if self.are_coated() => {
                Some(Validity::EXACT_SPHERE_A_OVER_R * radius)
            }
            _ => None,
        }
    }

    /// Returns the radius (m) of a paraboloid that makes, on a half-space and without adhesion, a
    /// contact of the radius and the penetration of this probe. `size` is the contact radius or,
    /// if it is `at_penetration`, the penetration. It gives starts of fits only.
    pub(crate) fn paraboloid(&self, size: f64, at_penetration: bool) -> f64 {
        match &self.probe {
            Probe::Paraboloid { radius } | Probe::Sphere { radius } => return *radius,
            // Its load grows like the penetration, that of a paraboloid like the power 3/2: they
            // are as large at this penetration, `2 a delta = 4/3 sqrt(R) delta^(3/2)`.
            Probe::FlatPunch { radius } => return 2.25 * radius * radius / size,
            _ => {}
        }
        let bare = HalfSpace {
            sphere_modulus: f64::INFINITY,
            ..self.on(self.film())
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

    /// Returns the solid that the probe touches: the film, the top layer, or the base without layers.
    pub fn film(&self) -> Elastic {
        self.layers.last().map_or(self.base, |top| top.layer.solid)
    }

    /// Returns the thickness of all layers, m; `None` without layers.
    pub fn thickness(&self) -> Option<f64> {
        let thicknesses = self.layers.iter().map(|named| named.layer.thickness);
        (!self.layers.is_empty()).then(|| thicknesses.sum())
    }

    /// Returns the thickness of the film or of the top layer, m; `None` without layers.
    pub(crate) fn top_thickness(&self) -> Option<f64> {
        self.layers.last().map(|top| top.layer.thickness)
    }

    /// Returns the name of the top layer, if it has one.
    pub(crate) fn top_name(&self) -> Option<LayerName> {
        self.layers.last()?.name
    }

    pub(crate) fn layer(&self, name: LayerName) -> Option<&NamedLayer> {
        self.layers.iter().find(|named| named.name == Some(name))
    }

    /// Tells whether the bodies have the parameters of a film: the only layer has no name, or there is a half-space.
    pub(crate) fn have_film(&self) -> bool {
        match &self.layers[..] {
            [] => self.are_half_space(),
            [only] => only.name.is_none(),
            _ => false,
        }
    }

    /// Lists the parameters of the layers that have a name.
    pub(crate) fn parameters_of_layers(&self) -> Vec<Parameter> {
        let names = self.layers.iter().filter_map(|named| named.name);
        names
            .flat_map(|name| LayerQuantity::ALL.map(|what| Parameter::Layer(name, what)))
            .collect()
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

    /// Replaces the value of one of the parameters. Other parameters change nothing.
    pub(crate) fn replace(
        &mut self,
        parameter: Parameter,
        value: f64,
    ) -> Result<(), interp::Error> {
        let has_film = self.have_film();
        let film = self.layers.first_mut().map(|film| &mut film.layer);
        match parameter {
            Parameter::SphereModulus => self.sphere_modulus = value,
            Parameter::FilmModulus | Parameter::FilmPoissonRatio if has_film => {
                let solid = film.map_or(&mut self.base, |film| &mut film.solid);
                *solid = match parameter {
                    Parameter::FilmModulus => Elastic::new(value, solid.poisson())?,
                    _ => Elastic::new(solid.young(), value)?,
                };
            }
            Parameter::FilmThickness if has_film => {
                if let Some(film) = film {
                    film.thickness = value;
                }
            }
            Parameter::Layer(name, what) => {
                let mut all = self.layers.iter_mut();
                all.try_for_each(|layer| match layer.name == Some(name) {
                    true => layer.set(what, value),
                    false => Ok(()),
                })?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Returns the input of the contact that a parameter is.
    pub(crate) fn input(&self, parameter: Parameter) -> Option<Input> {
        let coated = self.are_coated();
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

    /// Makes the contact, with the derivatives with respect to some parameters. Contacts on layers have none: those of a
    /// fit are differences of contacts.
    ///
    /// # Errors
    /// [`Error::Interrupted`]; [`Error::Layer`] for a layer with a name; [`Error::OtherLayers`]; those of
    /// the solve and of the lookup, and of [`Contact::new`].
    pub(crate) fn contact(&self, table: &Table, by: &[Parameter]) -> Result<Contact, Error> {
        if self.interrupt.is_requested() {
            return Err(Error::Interrupted);
        }
        if let Some(system) = self.system() {
            let inputs: Vec<Input> = by.iter().filter_map(|&one| self.input(one)).collect();
            return Ok(match by {
                [] => Contact::in_table(table, &system)?,
                _ => Contact::in_table_with_derivatives(table, &system, &inputs)?,
            });
        }
        let needs_no_layer = matches!(self.solver, Solver::HalfSpace | Solver::Direct);
        if needs_no_layer && self.layers.is_empty() {
            return Ok(Contact::half_space(&self.on(self.base))?);
        }
        super::solver::on_layers(self)
    }
}
