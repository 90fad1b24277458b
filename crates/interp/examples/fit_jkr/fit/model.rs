//! What the contact model predicts for a measured point, and how that depends on the parameters.

use interp::{Contact, Elastic, Error, System, Table};

use super::data::Against;

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
    /// The zero of the load where it was measured against the contact radius, else that of the penetration.
    Offset,
}

impl Parameter {
    /// In the order of arrays of derivatives.
    pub const ALL: [Self; 5] = [Self::SphereModulus, Self::WorkOfAdhesion, Self::FilmModulus, Self::FilmThickness, Self::Offset];

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
            Parameter::FilmModulus => self.system.film = Elastic::new(value, self.system.film.poisson())?,
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

/// Load and penetration at one contact radius, with their derivatives.
struct Point {
    load: f64,
    penetration: f64,
    /// Of load and penetration with respect to the contact radius.
    by_radius: [f64; 2],
    /// With respect to the logarithms of the parameters, but for the offset.
    by: [[f64; 2]; 4],
}

/// The contact at one state.
pub struct Model {
    state: State,
    contact: Contact,
    /// Stand-in for analytic derivatives: contacts with each of `E2*`, `E1`, `t` lower and higher.
    neighbours: [[Contact; 2]; 3],
}

const STEP: f64 = 1e-4;

impl Model {
    pub fn new(table: &Table, state: State) -> Result<Self, Error> {
        let neighbour = |parameter, factor: f64| table.contact(&state.with(parameter, factor * state.get(parameter))?.system);
        let pair = |parameter| Ok::<_, Error>([neighbour(parameter, 1.0 - STEP)?, neighbour(parameter, 1.0 + STEP)?]);
        let neighbours = [pair(Parameter::SphereModulus)?, pair(Parameter::FilmModulus)?, pair(Parameter::FilmThickness)?];
        Ok(Self { state, contact: table.contact(&state.system)?, neighbours })
    }

    /// The load that is measured at a contact radius or penetration (m).
    ///
    /// At a given penetration it is that of the stable contact. The derivatives there are those of the load along the curve of constant penetration,
    /// `F_p - F_a delta_p / delta_a`: in a test under displacement control `delta_a > 0` everywhere, also where the load is least.
    pub fn predict(&self, against: Against, abscissa: f64) -> Result<Predicted, Error> {
        match against {
            Against::ContactRadius => {
                let Point { load, by: [e2, w, e1, t], .. } = self.at(abscissa)?;
                Ok(Predicted { load: load + self.state.offset, by: [e2[0], w[0], e1[0], t[0], 1.0], pulled_off: false })
            }
            Against::Penetration => {
                let (point, pulled_off) = self.at_penetration(abscissa - self.state.offset)?;
                // At the fold the derivatives at constant penetration are infinite.
                let stiffness = if pulled_off { 0.0 } else { point.by_radius[0] / point.by_radius[1] };
                let along = |[load, penetration]: [f64; 2]| load - stiffness * penetration;
                let [e2, w, e1, t] = point.by.map(along);
                Ok(Predicted { load: point.load, by: [e2, w, e1, t, -stiffness], pulled_off })
            }
        }
    }

    fn at(&self, a: f64) -> Result<Point, Error> {
        let w = self.state.work_of_adhesion;
        let values =
            |contact: &Contact, a: f64, w: f64| contact.load_and_penetration(a, w).map(|(load, penetration)| [load, penetration]);
        let slope = |low: [f64; 2], high: [f64; 2]| [0, 1].map(|i| (high[i] - low[i]) / (2.0 * STEP));
        let (low, high) = (1.0 - STEP, 1.0 + STEP);
        let [load, penetration] = values(&self.contact, a, w)?;
        let by_radius = slope(values(&self.contact, low * a, w)?, values(&self.contact, high * a, w)?).map(|value| value / a);
        let by_work = slope(values(&self.contact, a, low * w)?, values(&self.contact, a, high * w)?);
        let neighbours = |[low, high]: &[Contact; 2]| Ok::<_, Error>(slope(values(low, a, w)?, values(high, a, w)?));
        let [e2, e1, t] = &self.neighbours;
        Ok(Point { load, penetration, by_radius, by: [neighbours(e2)?, by_work, neighbours(e1)?, neighbours(t)?] })
    }

    /// The stable contact at a penetration, by Newton's method from larger radii; that of the least penetration, and true, where there is none.
    fn at_penetration(&self, penetration: f64) -> Result<(Point, bool), Error> {
        let State { system, work_of_adhesion: w, .. } = self.state;
        let radius = system.sphere_radius;
        let mut a = (radius * penetration.abs()).sqrt() + (radius * radius * w / system.sphere_modulus).cbrt();
        let mut point = self.at(a)?;
        while point.penetration < penetration || point.by_radius[1] <= 0.0 {
            a *= 2.0;
            point = self.at(a)?;
        }
        for _ in 0..200 {
            let step = (point.penetration - penetration) / point.by_radius[1];
            let next = (a - step).max(0.5 * a);
            let there = self.at(next)?;
            if there.by_radius[1] <= 0.0 {
                return Ok((self.fold(next, a)?, true));
            }
            (a, point) = (next, there);
            if step.abs() <= 1e-12 * a {
                break;
            }
        }
        Ok((point, false))
    }

    /// The contact of the least penetration, between a radius below and one above it.
    fn fold(&self, mut low: f64, mut high: f64) -> Result<Point, Error> {
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.at(middle)?.by_radius[1] > 0.0 { high = middle } else { low = middle }
        }
        self.at(high)
    }
}
