//! The loads that the contact model predicts for measured points, with their derivatives with
//! respect to the parameters.

use interp::{Contact, Control, Elastic, Error, Input, System, Table};

use super::data::{Against, Data};

/// A parameter that can be fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// The reduced modulus `E2*` of the sphere.
    SphereModulus,
    /// The work of adhesion `w`.
    WorkOfAdhesion,
    /// Young's modulus `E1` of the film.
    FilmModulus,
    /// The thickness `t` of the film.
    FilmThickness,
    /// The zero of the load where it was measured against the contact radius, else that of the
    /// penetration.
    Offset,
}

impl Parameter {
    /// All parameters, in the order of arrays of derivatives.
    pub const ALL: [Self; 5] = [
        Self::SphereModulus,
        Self::WorkOfAdhesion,
        Self::FilmModulus,
        Self::FilmThickness,
        Self::Offset,
    ];

    /// Returns the name in options and output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SphereModulus => "sphere-modulus",
            Self::WorkOfAdhesion => "work-of-adhesion",
            Self::FilmModulus => "film-modulus",
            Self::FilmThickness => "film-thickness",
            Self::Offset => "offset",
        }
    }

    /// Returns the parameter with the given name.
    pub fn named(name: &str) -> Result<Self, String> {
        let found = Self::ALL
            .into_iter()
            .find(|parameter| parameter.name() == name);
        found.ok_or_else(|| {
            format!(
                "{name:?} is not a parameter; the parameters are {}",
                Self::ALL.map(Self::name).join(", ")
            )
        })
    }

    /// Returns the unit in output.
    pub const fn unit(self, against: Against) -> &'static str {
        match (self, against) {
            (Self::SphereModulus | Self::FilmModulus, _) => "Pa",
            (Self::WorkOfAdhesion, _) => "J/m^2",
            (Self::Offset, Against::ContactRadius) => "N",
            (Self::FilmThickness, _) | (Self::Offset, Against::Penetration) => "m",
        }
    }
}

/// A value of every parameter, with the rest of the system.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub system: System,
    pub work_of_adhesion: f64,
    pub offset: f64,
}

impl State {
    /// Returns the value of one parameter.
    pub fn get(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::SphereModulus => self.system.sphere_modulus,
            Parameter::WorkOfAdhesion => self.work_of_adhesion,
            Parameter::FilmModulus => self.system.film.young(),
            Parameter::FilmThickness => self.system.film_thickness,
            Parameter::Offset => self.offset,
        }
    }

    /// Replaces the value of one parameter.
    pub fn with(mut self, parameter: Parameter, value: f64) -> Result<Self, Error> {
        match parameter {
            Parameter::SphereModulus => self.system.sphere_modulus = value,
            Parameter::WorkOfAdhesion => self.work_of_adhesion = value,
            Parameter::FilmModulus => {
                self.system.film = Elastic::new(value, self.system.film.poisson())?
            }
            Parameter::FilmThickness => self.system.film_thickness = value,
            Parameter::Offset => self.offset = value,
        }
        Ok(self)
    }
}

/// A predicted load.
#[derive(Clone, Copy, Debug)]
pub struct Predicted {
    /// The load, N.
    pub load: f64,
    /// The derivatives of the load with respect to the logarithms of the parameters, and to the
    /// offset itself.
    pub by: [f64; 5],
    /// Whether the contact has separated at this penetration. The load is then that of pull-off.
    pub pulled_off: bool,
}

/// Predicts the load at each measured contact radius or penetration.
///
/// At a penetration it is the load of the contact that unloading under displacement control
/// reaches. Its derivatives are those along the curve of constant penetration,
/// `F_p - F_a delta_p / delta_a`. The contact is stable, so `delta_a > 0`, even where the load is
/// smallest. Derivatives at constant load would be infinite there.
pub fn predict(table: &Table, state: &State, data: &Data) -> Result<Vec<Predicted>, Error> {
    let contact = table.contact_with_gradient(&state.system)?;
    let at = |a: f64| Derivatives::new(&contact, state, a);
    match data.against {
        Against::ContactRadius => data
            .points
            .iter()
            .map(|&(a, _)| Ok(at(a)?.at_radius(state.offset)))
            .collect(),
        Against::Penetration => {
            let equilibria = contact.equilibria(state.work_of_adhesion, Control::Displacement)?;
            let predict = |&(penetration, _): &(f64, f64)| match equilibria
                .unloading(penetration - state.offset)
            {
                Ok(equilibrium) => Ok(at(equilibrium.contact_radius)?.at_penetration()),
                Err(Error::NoContact { .. }) => {
                    Ok(at(equilibria.pull_off()?.contact_radius)?.at_pull_off())
                }
                Err(error) => Err(error),
            };
            data.points.iter().map(predict).collect()
        }
    }
}

/// The load at one contact radius, and the derivatives of load and penetration with respect to the
/// radius and to the parameters.
struct Derivatives {
    load: f64,
    by_radius: interp::Derivatives,
    /// The derivatives with respect to the logarithms of all parameters except the offset.
    by: [interp::Derivatives; 4],
}

impl Derivatives {
    /// Evaluates the contact at contact radius `a` (m).
    fn new(contact: &Contact, state: &State, a: f64) -> Result<Self, Error> {
        const INPUTS: [Input; 4] = [
            Input::SphereModulus,
            Input::WorkOfAdhesion,
            Input::FilmModulus,
            Input::FilmThickness,
        ];
        let gradient = contact.gradient(a, state.work_of_adhesion)?;
        let mut by = [gradient.by(Input::ContactRadius)?; 4];
        let by_radius = by[0];
        for ((by, input), parameter) in by.iter_mut().zip(INPUTS).zip(Parameter::ALL) {
            let interp::Derivatives { load, penetration } = gradient.by(input)?;
            let value = state.get(parameter);
            *by = interp::Derivatives {
                load: load * value,
                penetration: penetration * value,
            };
        }
        Ok(Self {
            load: gradient.load(),
            by_radius,
            by,
        })
    }

    /// Predicts the load at this radius.
    fn at_radius(&self, offset: f64) -> Predicted {
        let [e2, w, e1, t] = self.by.map(|by| by.load);
        Predicted {
            load: self.load + offset,
            by: [e2, w, e1, t, 1.0],
            pulled_off: false,
        }
    }

    /// Predicts the load at the penetration of this radius.
    fn at_penetration(&self) -> Predicted {
        let stiffness = self.by_radius.load / self.by_radius.penetration;
        let [e2, w, e1, t] = self.by.map(|by| by.load - stiffness * by.penetration);
        Predicted {
            load: self.load,
            by: [e2, w, e1, t, -stiffness],
            pulled_off: false,
        }
    }

    /// Predicts the load of pull-off, with the derivatives at constant radius. Those at constant
    /// penetration are infinite there.
    fn at_pull_off(&self) -> Predicted {
        let [e2, w, e1, t] = self.by.map(|by| by.load);
        Predicted {
            load: self.load,
            by: [e2, w, e1, t, 0.0],
            pulled_off: true,
        }
    }
}
