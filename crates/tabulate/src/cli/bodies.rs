//! The bodies in contact, as the command line gives them: a probe on a film on a substrate, or a
//! sphere on a stack of layers.

use std::path::{Path, PathBuf};

use clap::ValueHint;
use interp::System;

use super::stack_file::{self, NamedLayers};
use super::system::SystemArguments;
use crate::cohesive::Cohesive;

/// The flags of the bodies. A command that takes them has an argument `table`.
#[derive(clap::Args)]
#[group(skip)]
pub struct BodiesArguments {
    #[arg(
        long,
        value_name = "STACK.toml|TABLE",
        help = format!("{}. It replaces film and substrate", stack_file::HELP),
        value_hint = ValueHint::FilePath,
        conflicts_with_all = [
            "table", "film_thickness", "film_modulus", "film_poisson_ratio", "substrate_modulus", "substrate_poisson_ratio",
            "probe", "half_angle", "exponent", "coefficient", "profile",
        ],
    )]
    stack: Option<PathBuf>,
    #[command(flatten)]
    pub system: SystemArguments,
}

/// The flags of the bodies, and the range of the attraction between them.
#[derive(clap::Args)]
#[group(skip)]
pub struct AttractingArguments {
    #[command(flatten)]
    pub bodies: BodiesArguments,
    /// Distance over which the attraction acts, m: a constant stress, the work of adhesion over
    /// this distance, wherever the gap is smaller (Dugdale's law). Without it the distance is 0 (JKR)
    #[arg(
        long,
        value_name = "M",
        conflicts_with = "table",
        allow_negative_numbers = true
    )]
    pub interaction_range: Option<f64>,
}

/// A probe on a film or on a stack.
pub struct Bodies {
    /// The probe on the film; of a stack, [`Stack::system`](crate::stack::Stack::system).
    pub system: System,
    /// The layers, if they are not one film.
    pub stack: Option<NamedLayers>,
}

impl BodiesArguments {
    /// Returns the files that are read, so that none of them is overwritten.
    pub fn files(&self) -> [Option<&Path>; 2] {
        [self.stack.as_deref(), self.system.shape.profile.as_deref()]
    }

    /// Returns the bodies. An error names the file and the body.
    pub fn read(&self) -> anyhow::Result<Bodies> {
        let Some(path) = &self.stack else {
            return Ok(Bodies {
                system: self.system.system()?,
                stack: None,
            });
        };
        let named = stack_file::read(path)?;
        let SystemArguments {
            sphere_radius,
            sphere_modulus,
            ..
        } = self.system;
        Ok(Bodies {
            system: named.stack.system(sphere_radius, sphere_modulus),
            stack: Some(named),
        })
    }
}

impl AttractingArguments {
    /// Returns the attraction of a finite `range` (m) between the bodies.
    pub fn cohesive(&self, bodies: &Bodies, range: f64) -> anyhow::Result<Cohesive> {
        let SystemArguments {
            sphere_radius,
            sphere_modulus,
            work_of_adhesion,
            ..
        } = self.bodies.system;
        Ok(match &bodies.stack {
            Some(NamedLayers { stack, .. }) => Cohesive::on_stack(
                stack,
                sphere_radius,
                sphere_modulus,
                work_of_adhesion,
                range,
            )?,
            None => Cohesive::new(&bodies.system, work_of_adhesion, range)?,
        })
    }
}
