//! The bodies in contact, as the command line gives them: a probe on a film on a substrate, or a
//! sphere on a stack of layers.

use std::path::{Path, PathBuf};

use anyhow::ensure;
use clap::ValueHint;
use contact::magnitude::Magnitude;
use contact::{Contact, Validity};
use interp::{HalfSpace, System};

use super::allow::{self, Allowed};
use super::interface::InterfaceArguments;
use super::note;
use super::stack_file::{self, Layers};
use super::system::{self, SystemArguments, Value};
use crate::large_contact::LARGE_CONTACT;
use solve::cohesive::{self, Cohesive};
use solve::stack::MOST_A_OVER_TOP;

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
        ],
    )]
    pub stack: Option<PathBuf>,
    #[command(flatten)]
    pub system: SystemArguments,
    #[command(flatten)]
    pub interface: InterfaceArguments,
    /// No film and no substrate: the probe touches a half-space with the modulus and the Poisson
    /// ratio of the film
    #[arg(long, conflicts_with_all = [
        "table", "stack", "interface", "interface_stiffness", "film_thickness", "substrate_modulus", "substrate_poisson_ratio",
    ])]
    pub half_space: bool,
    /// Accept these, which are errors otherwise
    #[arg(long, value_enum, value_name = "NAME,...", value_delimiter = ',')]
    pub allow: Vec<Allowed>,
}

/// A probe on a film, on a stack or on a half-space.
#[derive(Clone)]
pub struct Bodies {
    /// The probe on the film; of a stack, [`Stack::system`](solve::stack::Stack::system); of a half-space, a film as thick as
    /// the radius of the sphere on a substrate of the same solid.
    pub system: System,
    /// The layers, if they are not one film that is bonded to its substrate.
    pub stack: Option<Layers>,
    /// The probe touches a half-space, without a film.
    pub half_space: bool,
    /// The radius of the sphere or of the end of the probe, m. Some shapes do not use it.
    pub sphere_radius: f64,
    /// The work of adhesion, J/m^2.
    pub work_of_adhesion: f64,
}

impl BodiesArguments {
    /// Returns the files that are read, so that none of them is overwritten.
    pub fn files(&self) -> [Option<&Path>; 2] {
        [self.stack.as_deref(), self.system.shape.profile.as_deref()]
    }

    /// Lists the values that are not given and needed.
    pub fn missing(&self) -> Vec<Value> {
        self.system.missing(self.stack.is_some(), self.half_space)
    }

    /// Returns the bodies, with the values of the paper where none are given, if their numbers, and the work of adhesion
    /// (J/m^2) of a `receding` line, are those of a contact. An error names the file and the body.
    pub fn read_checked(&self, receding: Option<f64>) -> anyhow::Result<Bodies> {
        let bodies = self.read()?;
        self.check(&bodies, receding)?;
        Ok(bodies)
    }

    /// Accepts bodies and the work of adhesion (J/m^2) of a `receding` line if their numbers are those of a contact.
    pub fn check(&self, bodies: &Bodies, receding: Option<f64>) -> anyhow::Result<()> {
        let (system, work) = (&bodies.system, bodies.work_of_adhesion);
        let mut found = match &bodies.stack {
            None if self.half_space => Magnitude::of_half_space(&half_space(system), work),
            Some(layers) if self.stack.is_some() => {
                let named = &layers.named;
                named.magnitudes(&system.probe, system.sphere_modulus, work)
            }
            _ => Magnitude::of_system(system, work),
        };
        found.extend(receding.and_then(Magnitude::work_of_adhesion_receding));
        allow::magnitudes(&found, &self.allow)
    }

    /// Names the values that the paper's example stands in for, in a comment line; but not `unused` ones.
    pub fn name_example(&self, unused: &[Value]) {
        if self.system.specimen.is_none() {
            let mut missing = self.missing();
            missing.retain(|value| !unused.contains(value));
            system::name_example(&missing);
        }
    }

    /// Returns the bodies, with the values of the paper where none are given. An error names the
    /// file and the body.
    pub fn read(&self) -> anyhow::Result<Bodies> {
        let sphere_radius = self.system.value(Value::SphereRadius)?;
        let work_of_adhesion = self.system.value(Value::WorkOfAdhesion)?;
        let (system, stack) = match &self.stack {
            Some(path) => {
                let layers = stack_file::read(path)?;
                let sphere_modulus = self.system.value(Value::SphereModulus)?;
                let shape = &self.system.shape;
                let system = System {
                    probe: shape.probe(self.system.given(Value::SphereRadius), sphere_radius)?,
                    ..layers.stack().system(sphere_radius, sphere_modulus)
                };
                (system, Some(layers))
            }
            None if self.half_space => {
                let system = self.system.system()?;
                let system = System {
                    film_thickness: sphere_radius,
                    substrate: system.film,
                    ..system
                };
                (system, None)
            }
            None => {
                let system = self.system.system()?;
                let stack = self.interface.stack(&system)?;
                (system, stack.map(|named| Layers { named, table: None }))
            }
        };
        Ok(Bodies {
            system,
            stack,
            half_space: self.half_space,
            sphere_radius,
            work_of_adhesion,
        })
    }
}

/// How far the curve of a shape that is integrated over it reaches, over the largest contact radius.
pub const BEYOND: f64 = 1.5;

/// Notes on standard error that contacts between two radii (m), with a work of adhesion (J/m^2), may be no discs.
pub fn note_no_disc(contact: &Contact, radii: [f64; 2], work_of_adhesion: f64) {
    let Some(a) = contact.first_no_disc(radii, work_of_adhesion) else {
        return;
    };
    let [which, how] = if work_of_adhesion == 0.0 {
        [
            "a contact without adhesion",
            ", touches the probe farther outside, or lifts off inside",
        ]
    } else {
        [
            "a contact that a load presses on",
            " and touches the probe farther outside",
        ]
    };
    note(&format!(
        "From a contact radius of about {a:.2e} m on, {which} may be no disc: the film or top layer is so much stiffer than \
         what lies below it that it bends{how}. This is not modelled, and the loads may be wrong. Under a paraboloid and a \
         sphere it is a disc."
    ));
}

impl Bodies {
    /// Notes on standard error that a contact radius (m) is too large for a paraboloid to stand for a
    /// sphere, or that another probe is steep there.
    pub fn note_large_contact(&self, a: f64) {
        let paraboloid = self.system.probe.is_paraboloid();
        if paraboloid && a > Validity::WARNING_A_OVER_R * self.sphere_radius {
            let exact = if self.half_space {
                "--probe sphere takes the shape of the sphere".to_owned()
            } else {
                let limit = Validity::EXACT_SPHERE_A_OVER_R;
                format!("--probe sphere takes the shape of the sphere, up to {limit} R")
            };
            note(&format!(
                "{LARGE_CONTACT} The largest contact radius here is {:.3} R. {exact}, without friction and without \
                 --interaction-range.",
                a / self.sphere_radius,
            ));
        }
        let slope = self.system.probe.slope(a);
        if !paraboloid && slope > Validity::WARNING_SLOPE {
            note(&format!(
                "The model takes the slopes of the probe to be small; at the edge of a contact of radius {a:.3e} m the slope is \
                 {slope:.2}, as of a cone of half angle {:.0} degrees. Half angles count from the axis.",
                slope.recip().atan().to_degrees()
            ));
        }
    }

    /// Notes on standard error that a contact of radius `a` (m) compresses the film by more than [`Validity::SMALL`] of
    /// its thickness, bends it by more than [`Validity::WARNING_BENDING`], or would bear a tenth more with a surface tension
    /// of less than [`Validity::WARNING_SURFACE_TENSION`]. Without a `contact`, one film is solved there; of a stack nothing is said.
    pub fn note_validity(&self, contact: Option<&Contact>, a: f64) {
        /// The part of the radius from which on the curve is solved, and its tolerance: two digits are shown.
        const BEGIN: f64 = 0.9;
        const TOLERANCE: f64 = 1e-4;
        let solved = || {
            let a_over_t = a / self.system.film_thickness;
            let range = [BEGIN * a_over_t, a_over_t];
            let curve = solve::curve(&self.system.material().ok()?, range, TOLERANCE).ok()?;
            Contact::new(&self.system, curve).ok()
        };
        let solved = match contact {
            None if self.stack.is_none() => solved(),
            _ => None,
        };
        let validity = contact
            .or(solved.as_ref())
            .map(|contact| contact.validity(a));
        let Some(Ok(validity)) = validity else {
            return;
        };
        if validity.surface_tension < Validity::WARNING_SURFACE_TENSION {
            note(&format!(
                "The model has no surface tension. One of {:.1e} N/m would raise the load of a contact of radius {a:.3e} m without \
                 adhesion by a tenth at its penetration; gels and elastomers in air have 0.02 to 0.07 N/m, in their liquid far less.",
                validity.surface_tension
            ));
        }
        let Some(film) = validity.film else {
            return;
        };
        if film.bending > Validity::WARNING_BENDING {
            note(&format!(
                "The model is linear. Without adhesion, a contact of radius {a:.3e} m would press the film or top layer, which is \
                 stiffer than what lies below it, down by {:.2} of its thickness. It is then also stretched, which makes it \
                 stiffer and is left out.",
                film.bending
            ));
        }
        if film.strain > Validity::SMALL {
            let layers = self
                .stack
                .as_ref()
                .map_or(1, |layers| layers.stack().layers().len());
            let what = if layers > 1 { "layers" } else { "film" };
            note(&format!(
                "The model is linear: its error is of the size of the strain. Without adhesion, a contact of radius {a:.3e} m \
                 would compress the {what} by {:.0} % of the thickness.",
                1e2 * film.strain
            ));
        }
    }

    /// Returns a contact radius (m) up to which an attraction of a `range` (m) is solved: it acts farther than the
    /// contact, up to where the gap of the paraboloid alone is twice the range at most.
    pub fn reach_of_attraction(&self, range: f64) -> f64 {
        let most = cohesive::REACH * self.top_thickness();
        let gap = 4.0 * range * self.system.probe.radius().unwrap_or(0.0);
        (0.9 * most).min((most * most - gap).max(0.01 * most * most).sqrt())
    }

    /// Returns the contact radius (m) up to which the probe is solved on layers; infinite for one bonded film, and for a
    /// stack that is looked up.
    pub fn reach_of_layers(&self) -> f64 {
        match &self.stack {
            Some(Layers { named, table: None }) => {
                let reach = named.stack.reach(MOST_A_OVER_TOP) * self.system.film_thickness;
                if self.is_integrated() {
                    reach / BEYOND
                } else {
                    reach
                }
            }
            _ => f64::INFINITY,
        }
    }

    /// Tells whether the shape of the probe is integrated over the curve.
    pub fn is_integrated(&self) -> bool {
        let probe = &self.system.probe;
        !probe.is_paraboloid() && !probe.is_flat_punch()
    }

    /// Returns the thickness of the film, or of the top layer (m).
    pub fn top_thickness(&self) -> f64 {
        let top = match &self.stack {
            Some(layers) => layers.stack().shape().top,
            None => 1.0,
        };
        top * self.system.film_thickness
    }

    /// Makes the contact of a `system` of these bodies: solves for its curve in the `range` of `a/t` to a relative
    /// `tolerance`, or looks it up in the table of the layers. That on a half-space is known.
    pub fn contact(
        &self,
        system: &System,
        range: [f64; 2],
        tolerance: f64,
    ) -> Result<Contact, crate::Error> {
        if self.half_space {
            return Ok(Contact::half_space(&half_space(system))?);
        }
        let sphere_modulus = system.sphere_modulus;
        let curve = match &self.stack {
            None => solve::curve(&system.material()?, range, tolerance)?,
            Some(layers) => match &layers.table {
                None => solve::stack_curve(layers.stack(), sphere_modulus, range, tolerance)?,
                Some(table) => layers.stack().curve_in(table, sphere_modulus)?,
            },
        };
        Ok(Contact::new(system, curve)?)
    }

    /// Returns the attraction of a finite `range` (m) between the bodies.
    pub fn cohesive(&self, range: f64) -> anyhow::Result<Cohesive> {
        let Self {
            ref system,
            ref stack,
            sphere_radius,
            work_of_adhesion,
            ..
        } = *self;
        ensure!(
            range != 0.0,
            "interaction range = 0.0: an attraction without range is that of JKR: leave out --interaction-range, or \
             give a distance such as 5nm"
        );
        ensure!(
            work_of_adhesion != 0.0,
            "work of adhesion = 0.0: without adhesion there is no attraction: leave out --interaction-range, or give a \
             --work-of-adhesion such as 40mJ/m^2"
        );
        ensure!(
            range.is_nan() || range <= sphere_radius,
            "interaction range = {range:?} m: it must be at most the radius of the sphere, {sphere_radius:?} m, and is \
             some nanometres in most contacts; check its unit"
        );
        let stack = stack.as_ref().map(Layers::stack);
        Ok(Cohesive::new(system, stack, work_of_adhesion, range)?)
    }
}

/// Returns the probe of a system on a half-space of the solid of its film.
pub fn half_space(system: &System) -> HalfSpace {
    HalfSpace {
        probe: system.probe.clone(),
        sphere_modulus: system.sphere_modulus,
        solid: system.film,
    }
}
