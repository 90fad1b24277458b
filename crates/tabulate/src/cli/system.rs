//! The sphere, the film and the substrate, as the command line gives them.

use anyhow::Context;
use interp::{Elastic, System};

use super::probe::ProbeArguments;

/// The flags of a system, with the values of Barthel's Tables 1 and 2 as defaults.
#[derive(clap::Args, Clone)]
#[group(skip)]
pub struct SystemArguments {
    /// Thickness of the film, m
    #[arg(long, default_value = "1e-6", allow_negative_numbers = true)]
    pub film_thickness: f64,
    /// Young's modulus of the film, Pa
    #[arg(long, default_value = "3.5e6", allow_negative_numbers = true)]
    pub film_modulus: f64,
    /// Poisson ratio of the film
    #[arg(long, default_value_t = 0.5, allow_negative_numbers = true)]
    pub film_poisson_ratio: f64,
    /// Young's modulus of the substrate, Pa; inf: rigid
    #[arg(long, default_value = "2e11", allow_negative_numbers = true)]
    pub substrate_modulus: f64,
    /// Poisson ratio of the substrate
    #[arg(long, default_value_t = 0.25, allow_negative_numbers = true)]
    pub substrate_poisson_ratio: f64,
    /// Radius of the sphere, of the paraboloid, of the end of a cone or of the punch, m
    #[arg(long, default_value = "1e-3", allow_negative_numbers = true)]
    pub sphere_radius: f64,
    /// Reduced modulus E2* = E2/(1 - nu2^2) of the sphere or other probe, Pa; inf: rigid
    #[arg(long, default_value = "2e6", allow_negative_numbers = true)]
    pub sphere_modulus: f64,
    #[command(flatten)]
    pub shape: ProbeArguments,
    /// Work of adhesion, J/m^2
    #[arg(long, default_value_t = 0.04, allow_negative_numbers = true)]
    pub work_of_adhesion: f64,
}

impl SystemArguments {
    /// Returns the system. An error names the body.
    pub fn system(&self) -> anyhow::Result<System> {
        Ok(System {
            probe: self.shape.probe(self.sphere_radius)?,
            sphere_modulus: self.sphere_modulus,
            film: Elastic::new(self.film_modulus, self.film_poisson_ratio).context("film")?,
            film_thickness: self.film_thickness,
            substrate: Elastic::new(self.substrate_modulus, self.substrate_poisson_ratio)
                .context("substrate")?,
        })
    }
}
