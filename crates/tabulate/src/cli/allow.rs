//! What a person means although it is doubtful.

use anyhow::bail;
use clap::ValueEnum;
use contact::magnitude::Magnitude;

/// A doubt that is no error where it is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Allowed {
    /// Numbers that no contact experiment has, such as a sphere of 2 m
    Magnitudes,
    /// Fits that leave out more than a third of the points in contact
    LeftOut,
}

/// Refuses numbers that no contact experiment has, unless they are allowed.
pub fn magnitudes(found: &[Magnitude], allowed: &[Allowed]) -> anyhow::Result<()> {
    if found.is_empty() || allowed.contains(&Allowed::Magnitudes) {
        return Ok(());
    }
    let texts: Vec<String> = found.iter().map(Magnitude::to_string).collect();
    bail!(
        "{}; numbers have units (30um, 5mN) or are in SI units; if these are meant, --allow \
         magnitudes",
        texts.join("; ")
    )
}
