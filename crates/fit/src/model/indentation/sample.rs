//! The stiffness of a sample whose film may be thinner under the tip.

use std::f64::consts::PI;

use contact::{Contact, Error};

use crate::Bodies;
use crate::model::differences::ContactOf;

/// The number of thicknesses of the top layer at which the contacts of a thinned stack are made.
/// With 6 the stiffness between them is within 1e-6 for a layer thinned to half
/// (`tests/fit/contact_stiffness/loss.rs`).
const THICKNESSES: usize = 6;

/// A sample, with its contacts.
pub(super) struct Sample {
    /// The thickness (m) of a film, whose quantities depend on `a/t` alone; infinite of other bodies.
    thickness: f64,
    /// One contact, or those of stacks whose top layer is thinner by the depths (m), Chebyshev's points of the first
    /// kind.
    contacts: Vec<(f64, Contact)>,
}

impl Sample {
    /// Makes the contacts of bodies whose film or top layer is thinner by up to `most` (m).
    pub fn new(
        bodies: &Bodies,
        contact_of: &ContactOf<'_>,
        most: f64,
    ) -> Result<Self, crate::Error> {
        let thins = bodies.are_layered() && most > 0.0 && !bodies.layers.is_empty();
        let contact = |k: usize| {
            let by = 0.5 * most * (1.0 - angle(k).cos());
            let mut thinner = bodies.clone();
            if let Some(top) = thinner.layers.last_mut() {
                top.layer.thickness -= by;
            }
            Ok::<_, crate::Error>((by, contact_of(&thinner, &[])?))
        };
        Ok(Self {
            thickness: bodies
                .system()
                .map_or(f64::INFINITY, |film| film.film_thickness),
            contacts: if thins {
                (0..THICKNESSES).map(contact).collect::<Result<_, _>>()?
            } else {
                vec![(0.0, contact_of(bodies, &[])?)]
            },
        })
    }

    /// Returns the contact of the sample that is not thinned.
    pub fn contact(&self) -> &Contact {
        &self.contacts[0].1
    }

    /// Returns the stiffness `S = 2 a E2* Eeq` (N/m) at contact radius `a` (m), where the film is
    /// thinner by a depth (m); NaN where nothing of it is left.
    pub fn stiffness(&self, a: f64, thinner: f64) -> Result<f64, Error> {
        if let [(_, contact)] = &self.contacts[..] {
            let part = 1.0 - thinner / self.thickness;
            return if part > 0.0 {
                Ok(part * contact.stiffness(a / part)?)
            } else {
                Ok(f64::NAN)
            };
        }
        // The barycentric formula, with the weights of Chebyshev's points.
        let (mut above, mut below) = (0.0, 0.0);
        for (k, (by, contact)) in self.contacts.iter().enumerate() {
            let value = contact.stiffness(a)?.ln();
            if thinner == *by {
                return Ok(value.exp());
            }
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let weight = sign * angle(k).sin() / (thinner - by);
            above += weight * value;
            below += weight;
        }
        Ok((above / below).exp())
    }
}

/// Returns the angle of one of Chebyshev's points.
fn angle(k: usize) -> f64 {
    PI * (2 * k + 1) as f64 / (2 * THICKNESSES) as f64
}
