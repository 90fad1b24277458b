//! What joins one film to its substrate, as the command line gives it.

use clap::ValueEnum;
use interp::System;
use solve::stack::{Interface, Stack};
use units::Dimension;

use super::quantity;
use crate::stack::NamedStack;

/// The name of the film in fits: its parameters are `film.modulus`, `film.thickness` and
/// `film.interface-stiffness`.
pub const FILM: &str = "film";

/// The flags of the interface between film and substrate. A command that takes them has arguments
/// `table` and `stack`.
#[derive(clap::Args)]
#[group(skip)]
pub struct InterfaceArguments {
    /// What joins the film to the substrate [default: bonded]
    ///
    /// A film that slides has no friction on its substrate, as on a lubricant. It is held by
    /// tension where it would rise: a dry film that lifts off is not modelled. It is solved
    /// directly, up to a/t of 1000, and fits call it the layer `film`: film.modulus,
    /// film.thickness. --stack names the interfaces of several layers.
    #[arg(long, value_enum, conflicts_with_all = NO_FILM, conflicts_with = "interface_stiffness")]
    interface: Option<Word>,
    /// Springs between film and substrate, Pa/m: the tangential stiffness, and optionally the normal
    /// one [default: inf]. A layer of glue of shear modulus G and thickness d has G/d. 0 slides, inf
    /// is bonded. In a fit film.interface-stiffness is the tangential one
    #[arg(long, value_name = "KT[,KN]", conflicts_with_all = NO_FILM, value_parser = springs)]
    interface_stiffness: Option<[f64; 2]>,
}

/// The arguments that replace the film, or what solves for it.
const NO_FILM: [&str; 2] = ["table", "stack"];

/// The interfaces that a word names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Word {
    /// No displacement across the interface
    Bonded,
    /// No shear stress
    Sliding,
}

/// Reads the tangential and perhaps the normal stiffness, in Pa/m.
pub fn springs(text: &str) -> Result<[f64; 2], String> {
    pair(text, Some(Dimension::ModulusPerLength))
}

/// Reads one number or two of a dimension, infinity for the second one without it. The checks of a
/// stack do the rest.
pub fn pair(text: &str, dimension: Option<Dimension>) -> Result<[f64; 2], String> {
    let mut parts = text.split(',').map(|part| quantity::read(part, dimension));
    let tangential = parts.next().expect("a text has a first part")?;
    let normal = parts.next().transpose()?.unwrap_or(f64::INFINITY);
    if parts.next().is_some() {
        return Err(format!(
            "{text:?} has more than two stiffnesses: write KT or KT,KN"
        ));
    }
    Ok([tangential, normal])
}

/// Joins a word and springs, of which one at most is given.
pub fn interface(word: Option<Word>, springs: Option<[f64; 2]>) -> Interface {
    match (word, springs) {
        (_, Some([tangential, normal])) => Interface::Springs { tangential, normal },
        (Some(Word::Sliding), None) => Interface::Sliding,
        (Some(Word::Bonded) | None, None) => Interface::Bonded,
    }
}

impl InterfaceArguments {
    /// Tells whether the film is a layer of its own, because it is not bonded.
    pub fn is_layer(&self) -> bool {
        !interface(self.interface, self.interface_stiffness).is_bonded()
    }

    /// Returns the film on its substrate as a stack of one layer; `None` if it is bonded.
    pub fn stack(&self, system: &System) -> anyhow::Result<Option<NamedStack>> {
        let interface = interface(self.interface, self.interface_stiffness);
        self.is_layer()
            .then(|| one_film(system, interface))
            .transpose()
    }
}

/// Returns the film of a system on its substrate as a stack of one layer.
pub fn one_film(system: &System, interface: Interface) -> anyhow::Result<NamedStack> {
    let stack = Stack::of_film(system, interface).map_err(|error| match error {
        solve::Error::Layer { what, .. } => anyhow::anyhow!("the film: {what}"),
        error => error.into(),
    })?;
    Ok(NamedStack {
        stack,
        names: vec![Some(FILM.into())],
    })
}
