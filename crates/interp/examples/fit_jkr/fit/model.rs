//! What the contact model predicts for a measured point, and how that depends on the parameters.

use interp::{Contact, Control, Elastic, Error, Input, System, Table};

use super::data::{Against, Data};

/// What may be fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// `E2*`.
    SphereModulus,
    /// `w`.
    WorkOfAdhesion,
    /// `E1`, Young's modulus.
    FilmModulus,
    /// `t`.
    FilmThickness,
    /// The zero of the load where it was measured against the contact radius, else that of the
    /// penetration.
    Offset,
}

impl Parameter {
    /// In the order of arrays of derivatives.
    pub const ALL: [Self; 5] = [
        Self::SphereModulus,
        Self::WorkOfAdhesion,
        Self::FilmModulus,
        Self::FilmThickness,
        Self::Offset,
    ];

    /// The name in options and output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SphereModulus => "sphere-modulus",
            Self::WorkOfAdhesion => "work-of-adhesion",
            Self::FilmModulus => "film-modulus",
            Self::FilmThickness => "film-thickness",
            Self::Offset => "offset",
        }
    }

    /// The parameter of this name.
    pub fn named(name: &str) -> Result<Self, String> {
        let found = Self::ALL
            .into_iter()
            .find(|parameter| parameter.name() == name);
        found.ok_or_else(|| {
            format!(
                "no parameter {name:?} but {}",
                Self::ALL.map(Self::name).join(", ")
            )
        })
    }

    /// The unit in output.
    pub const fn unit(self, against: Against) -> &'static str {
        match (self, against) {
            (Self::SphereModulus | Self::FilmModulus, _) => "Pa",
            (Self::WorkOfAdhesion, _) => "J/m^2",
            (Self::Offset, Against::ContactRadius) => "N",
            (Self::FilmThickness, _) | (Self::Offset, Against::Penetration) => "m",
        }
    }
}

/// A value of every parameter, and what is known of the system.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub system: System,
    pub work_of_adhesion: f64,
    pub offset: f64,
}

impl State {
    /// The value of one parameter.
    pub fn get(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::SphereModulus => self.system.sphere_modulus,
            Parameter::WorkOfAdhesion => self.work_of_adhesion,
            Parameter::FilmModulus => self.system.film.young(),
            Parameter::FilmThickness => self.system.film_thickness,
            Parameter::Offset => self.offset,
        }
    }

    /// With another value of one parameter.
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
    /// N.
    pub load: f64,
    /// Its derivatives with respect to the logarithms of the parameters, and to the offset itself.
    pub by: [f64; 5],
    /// Whether the sphere has come off at this penetration; the load is then that of pull-off.
    pub pulled_off: bool,
}

/// The loads that are measured at contact radii or penetrations.
///
/// At a penetration it is that of the contact which unloading under displacement control reaches.
/// Its derivatives there are those along the curve of constant penetration,
/// `F_p - F_a delta_p / delta_a`: the contact is stable, so `delta_a > 0`, also where the load is
/// least. At fixed load they would be infinite there.
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

/// Load and penetration at one contact radius, and how they depend on it and on the parameters.
struct Derivatives {
    load: f64,
    by_radius: interp::Derivatives,
    /// With respect to the logarithms of the parameters but the offset.
    by: [interp::Derivatives; 4],
}

impl Derivatives {
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

    fn at_radius(&self, offset: f64) -> Predicted {
        let [e2, w, e1, t] = self.by.map(|by| by.load);
        Predicted {
            load: self.load + offset,
            by: [e2, w, e1, t, 1.0],
            pulled_off: false,
        }
    }

    fn at_penetration(&self) -> Predicted {
        let stiffness = self.by_radius.load / self.by_radius.penetration;
        let [e2, w, e1, t] = self.by.map(|by| by.load - stiffness * by.penetration);
        Predicted {
            load: self.load,
            by: [e2, w, e1, t, -stiffness],
            pulled_off: false,
        }
    }

    /// As the derivatives at constant penetration are infinite at pull-off, those at constant
    /// radius.
    fn at_pull_off(&self) -> Predicted {
        let [e2, w, e1, t] = self.by.map(|by| by.load);
        Predicted {
            load: self.load,
            by: [e2, w, e1, t, 0.0],
            pulled_off: true,
        }
    }
}
