//! The stiffness of a sample whose film may be thinner under the tip.

use std::f64::consts::PI;

use contact::Contact;
use contact::Error;

use crate::model::differences::ContactOf;
use crate::{Bodies, Layered};

/// The number of thicknesses of the top layer at which the contacts of a thinned stack are made.
/// With 6 the stiffness between them is within 1e-6 for a layer thinned to half
/// (`tests/fit/contact_stiffness/loss.rs`).
const THICKNESSES: usize = 6;

/// A sample, with its contacts.
pub(super) enum Sample {
    /// One contact for all points.
    One(Contact),
    /// A film of the thickness (m). The quantities of one film depend on `a/t` alone.
    Film(Contact, f64),
    /// Stacks whose top layer is thinner by the depths (m), Chebyshev's points of the first kind.
    Stacks(Vec<(f64, Contact)>),
}

impl Sample {
    /// Makes the contacts of bodies whose film or top layer is thinner by up to `most` (m).
    pub fn new(
        bodies: &Bodies,
        contact_of: &ContactOf<'_>,
        most: f64,
    ) -> Result<Self, crate::Error> {
        if most.is_nan() || most <= 0.0 {
            return Ok(Self::One(contact_of(bodies, None)?));
        }
        Ok(match bodies {
            Bodies::HalfSpace(_) => Self::One(contact_of(bodies, None)?),
            Bodies::Coated(system) => Self::Film(contact_of(bodies, None)?, system.film_thickness),
            Bodies::Layered(layered) if layered.layers.is_empty() => {
                Self::One(contact_of(bodies, None)?)
            }
            Bodies::Layered(layered) => {
                let place = |k: usize| {
                    let angle = PI * (2 * k + 1) as f64 / (2 * THICKNESSES) as f64;
                    0.5 * most * (1.0 - angle.cos())
                };
                let stacks = (0..THICKNESSES).map(|k| {
                    let by = place(k);
                    let contact = contact_of(&Bodies::Layered(thinned(layered, by)), None)?;
                    Ok::<_, crate::Error>((by, contact))
                });
                Self::Stacks(stacks.collect::<Result<_, _>>()?)
            }
        })
    }

    /// Returns the contact of the sample that is not thinned.
    pub fn contact(&self) -> &Contact {
        match self {
            Self::One(contact) | Self::Film(contact, _) => contact,
            Self::Stacks(stacks) => &stacks[0].1,
        }
    }

    /// Returns the stiffness `S = 2 a E2* Eeq` (N/m) at contact radius `a` (m), where the film is
    /// thinner by a depth (m); NaN where nothing of it is left.
    pub fn stiffness(&self, a: f64, thinner: f64) -> Result<f64, Error> {
        match self {
            Self::One(contact) => contact.stiffness(a),
            Self::Film(contact, thickness) => {
                let part = 1.0 - thinner / thickness;
                if part > 0.0 {
                    Ok(part * contact.stiffness(a / part)?)
                } else {
                    Ok(f64::NAN)
                }
            }
            Self::Stacks(stacks) => {
                // The barycentric formula, with the weights of Chebyshev's points.
                let (mut above, mut below) = (0.0, 0.0);
                for (k, (by, contact)) in stacks.iter().enumerate() {
                    let value = contact.stiffness(a)?.ln();
                    if thinner == *by {
                        return Ok(value.exp());
                    }
                    let angle = PI * (2 * k + 1) as f64 / (2 * THICKNESSES) as f64;
                    let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
                    let weight = sign * angle.sin() / (thinner - by);
                    above += weight * value;
                    below += weight;
                }
                Ok((above / below).exp())
            }
        }
    }
}

/// Returns the layers with a top layer that is thinner by a depth (m).
fn thinned(layered: &Layered, by: f64) -> Layered {
    let mut layered = layered.clone();
    if let Some(top) = layered.layers.last_mut() {
        top.layer.thickness -= by;
    }
    layered
}
