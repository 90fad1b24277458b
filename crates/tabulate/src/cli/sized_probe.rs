//! The probe of the commands that set nothing else of a system: `plot` and `report`.

use contact::magnitude::Magnitude;
use interp::Probe;

use super::allow::{self, Allowed};
use super::probe::ProbeArguments;
use super::quantity::length;
use super::system::Value;

/// The flags of the shape and of its size, for commands that set nothing else of a system.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct SizedProbeArguments {
    #[command(flatten)]
    pub shape: ProbeArguments,
    /// Radius of the sphere, of the paraboloid, of the end of a cone or of the punch, m [default:
    /// 1mm]
    #[arg(long, value_parser = length)]
    sphere_radius: Option<f64>,
    /// Accept these, which are errors otherwise
    #[arg(long, value_enum, value_name = "NAME,...", value_delimiter = ',')]
    allow: Vec<Allowed>,
}

impl SizedProbeArguments {
    /// Returns the shape.
    pub fn probe(&self) -> anyhow::Result<Probe> {
        let radius = Value::SphereRadius.or_of_paper(self.sphere_radius)?;
        let probe = self.shape.probe(self.sphere_radius, radius)?;
        let found = Magnitude::length("the radius of the sphere", radius);
        allow::magnitudes(found.as_slice(), &self.allow)?;
        Ok(probe)
    }

    /// Lists the values of the paper's system that are not given.
    pub fn missing(&self) -> Vec<Value> {
        let is_used = |value: &Value| match value {
            Value::SphereRadius => self.shape.has_radius() && self.sphere_radius.is_none(),
            // The films have several thicknesses.
            Value::FilmThickness => false,
            _ => true,
        };
        Value::ALL.into_iter().filter(is_used).collect()
    }
}
