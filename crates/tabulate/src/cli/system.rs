//! The sphere, the film and the substrate, as the command line gives them.
//!
//! Every value is optional. What nobody gives is taken from the paper's example, and the command
//! decides what that means: a fit refuses it, all others name it in a comment line.

use std::io::{self, Write};

use anyhow::{Context, ensure};
use clap::ValueEnum;
use contact::named;
use interp::{Elastic, System};

use super::probe::ProbeArguments;
use super::quantity::{force_per_length, length, modulus, number};

/// The flags of a system.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct SystemArguments {
    /// Thickness of the film, m
    #[arg(long, value_parser = length)]
    film_thickness: Option<f64>,
    /// Young's modulus of the film, Pa
    #[arg(long, value_parser = modulus)]
    film_modulus: Option<f64>,
    /// Poisson ratio of the film
    #[arg(long, value_parser = number)]
    film_poisson_ratio: Option<f64>,
    /// Young's modulus of the substrate, Pa; inf: rigid
    #[arg(long, value_parser = modulus)]
    substrate_modulus: Option<f64>,
    /// Poisson ratio of the substrate. A rigid one needs none
    #[arg(long, value_parser = number)]
    substrate_poisson_ratio: Option<f64>,
    /// Radius of the sphere, of the paraboloid, of the end of a cone or of the punch, m
    #[arg(long, value_parser = length)]
    sphere_radius: Option<f64>,
    /// Reduced modulus E2* = E2/(1 - nu2^2) of the sphere or other probe, Pa; inf: rigid
    #[arg(long, value_parser = modulus)]
    sphere_modulus: Option<f64>,
    #[command(flatten)]
    pub shape: ProbeArguments,
    /// Work of adhesion, J/m^2; 0: none
    #[arg(long, value_parser = force_per_length)]
    work_of_adhesion: Option<f64>,
    /// The specimen that the values not given are taken from
    #[arg(long, value_enum)]
    pub specimen: Option<Specimen>,
}

/// The specimens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Specimen {
    /// Barthel's Tables 1 and 2: an elastomer sphere of 1 mm on an elastomer film of 1 um on
    /// silicon
    Paper,
}

named! {
    /// A value of the bodies that a person knows.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Value {
        SphereRadius = "sphere-radius",
        SphereModulus = "sphere-modulus",
        FilmThickness = "film-thickness",
        FilmModulus = "film-modulus",
        FilmPoissonRatio = "film-poisson-ratio",
        SubstrateModulus = "substrate-modulus",
        SubstratePoissonRatio = "substrate-poisson-ratio",
        WorkOfAdhesion = "work-of-adhesion",
    }
}

impl Value {
    pub fn flag(self) -> String {
        format!("--{}", self.name())
    }

    /// Returns the name in messages of the libraries.
    fn in_messages(self) -> String {
        self.name().replace('-', "_")
    }

    /// Returns the value of Barthel's Tables 1 and 2, as the command line takes it.
    const fn of_paper(self) -> (&'static str, f64) {
        match self {
            Self::SphereRadius => ("1mm", 1e-3),
            Self::SphereModulus => ("2MPa", 2e6),
            Self::FilmThickness => ("1um", 1e-6),
            Self::FilmModulus => ("3.5MPa", 3.5e6),
            Self::FilmPoissonRatio => ("0.5", 0.5),
            Self::SubstrateModulus => ("200GPa", 2e11),
            Self::SubstratePoissonRatio => ("0.25", 0.25),
            Self::WorkOfAdhesion => ("40mJ/m^2", 0.04),
        }
    }

    /// Returns the value given, or that of the paper without one. A negative one is refused.
    pub fn or_of_paper(self, given: Option<f64>) -> anyhow::Result<f64> {
        let (example, of_paper) = self.of_paper();
        let Some(given) = given else {
            return Ok(of_paper);
        };
        let (is_refused, reason) = match self {
            Self::FilmPoissonRatio | Self::SubstratePoissonRatio => return Ok(given),
            Self::WorkOfAdhesion => (given < 0.0, "a work of adhesion is at least 0"),
            Self::SphereRadius | Self::FilmThickness => {
                (given <= 0.0, "a radius or a thickness is above 0")
            }
            _ => (given <= 0.0, "a modulus is above 0"),
        };
        ensure!(
            !is_refused,
            "{}: {} = {given:?} is refused, because {reason}; values are in SI units, or have a \
             unit, such as {example}",
            self.flag(),
            self.in_messages()
        );
        Ok(given)
    }

    /// Tells whether the value is one of the film or of the substrate.
    pub const fn is_of_sample(self) -> bool {
        matches!(
            self,
            Self::FilmThickness
                | Self::FilmModulus
                | Self::FilmPoissonRatio
                | Self::SubstrateModulus
                | Self::SubstratePoissonRatio
        )
    }
}

impl SystemArguments {
    pub const fn given(&self, value: Value) -> Option<f64> {
        match value {
            Value::SphereRadius => self.sphere_radius,
            Value::SphereModulus => self.sphere_modulus,
            Value::FilmThickness => self.film_thickness,
            Value::FilmModulus => self.film_modulus,
            Value::FilmPoissonRatio => self.film_poisson_ratio,
            Value::SubstrateModulus => self.substrate_modulus,
            Value::SubstratePoissonRatio => self.substrate_poisson_ratio,
            Value::WorkOfAdhesion => self.work_of_adhesion,
        }
    }

    /// Returns a value, that of the paper where it is not given.
    pub fn value(&self, value: Value) -> anyhow::Result<f64> {
        value.or_of_paper(self.given(value))
    }

    /// Lists the values that are not given and needed: on a stack none of film and substrate, on a
    /// half-space only the solid of the film.
    pub fn missing(&self, on_stack: bool, half_space: bool) -> Vec<Value> {
        let is_needed = |value: Value| match value {
            Value::SphereRadius => self.shape.has_radius(),
            _ if value.is_of_sample() && on_stack => false,
            Value::FilmThickness | Value::SubstrateModulus => !half_space,
            Value::SubstratePoissonRatio => {
                !half_space && self.substrate_modulus != Some(f64::INFINITY)
            }
            _ => true,
        };
        let missing = |value: &Value| is_needed(*value) && self.given(*value).is_none();
        Value::ALL.into_iter().filter(missing).collect()
    }

    /// Returns the system. An error names the flag or the body.
    pub fn system(&self) -> anyhow::Result<System> {
        let film = [Value::FilmModulus, Value::FilmPoissonRatio];
        let substrate = [Value::SubstrateModulus, Value::SubstratePoissonRatio];
        let solid = |[young, poisson]: [Value; 2], name: &'static str| {
            Elastic::new(self.value(young)?, self.value(poisson)?).context(name)
        };
        Ok(System {
            probe: self
                .shape
                .probe(self.sphere_radius, self.value(Value::SphereRadius)?)?,
            sphere_modulus: self.value(Value::SphereModulus)?,
            film: solid(film, "film")?,
            film_thickness: self.value(Value::FilmThickness)?,
            substrate: solid(substrate, "substrate")?,
        })
    }
}

/// Names the `missing` values, which the paper's example stands in for, in a comment line on
/// standard error.
pub fn name_example(missing: &[Value]) {
    if missing.is_empty() {
        return;
    }
    let values: Vec<String> = missing
        .iter()
        .map(|value| format!("{} = {}", value.in_messages(), value.of_paper().0))
        .collect();
    // `eprintln` panics where standard error is closed.
    let _ = writeln!(
        io::stderr(),
        "# taken from the paper's example (--specimen paper): {}",
        values.join(", ")
    );
}
