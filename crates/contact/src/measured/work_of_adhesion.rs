//! The work of adhesion of a measured pull-off load.

use std::f64::consts::{LN_10, PI};

use interp::Error as Refused;

use crate::{Contact, Control, Error, root};

/// The largest number of steps of the search for two works of adhesion with the one wanted between them.
const MOST_STEPS: usize = 60;
/// The work of adhesion (J/m^2) from which on that of a probe without a radius is searched.
const USUAL: f64 = 0.05;
/// The powers of ten by which the search begins below and above it, where it has no answer.
const DECADES: i32 = 12;
/// The largest difference of the logarithm of a load from that of the load wanted.
const CLOSE: f64 = 1e-5;
/// The difference of the logarithm of the work of adhesion on both sides of a jump of the load.
const BESIDE: f64 = 1e-6;

impl Contact {
    /// Returns the work of adhesion (J/m^2) of a measured pull-off load (N, negative): the one with which
    /// [`Contact::pull_off`] under this control is at this load.
    ///
    /// The largest tension of a measured curve is the pull-off load of [`Control::Load`], whatever the machine imposes.
    /// With another control the load is that of the last state before the bodies separate.
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// # use interp::{Elastic, HalfSpace, Probe};
    /// # use contact::{Contact, Control};
    /// let solid = Elastic::new(1e6, 0.5)?;
    /// let probe = Probe::Paraboloid { radius: 1e-5 };
    /// let contact = Contact::half_space(&HalfSpace { probe, sphere_modulus: f64::INFINITY, solid })?;
    /// let w = contact.work_of_adhesion_at_pull_off(-1e-6, Control::Load)?;
    /// assert!((w / (1e-6 / (1.5 * std::f64::consts::PI * 1e-5)) - 1.0).abs() < 1e-9); // JKR
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] for a load that is not negative and finite; [`Error::NoWorkOfAdhesion`] for a load
    /// that no work of adhesion has; otherwise as [`Contact::pull_off`] at the works of adhesion near the one that is
    /// searched.
    pub fn work_of_adhesion_at_pull_off(&self, load: f64, control: Control) -> Result<f64, Error> {
        let radius = self.mechanics.sphere_radius();
        let radius = radius.is_finite().then_some(radius);
        work_of_adhesion_at_pull_off(load, radius, |w| Ok(self.pull_off(w, control)?.load))
    }
}

/// Returns the work of adhesion (J/m^2) with which the load at the pull-off (N, negative), a function of the work of
/// adhesion, is `load`. The search begins with that of JKR for the `radius` of the probe (m), if it has one.
///
/// The load grows with the work of adhesion as a power of it: nearly in proportion under a sphere, with the square under a
/// cone, with the root under a flat punch. Where the last stable state changes to another contact radius, the load jumps.
///
/// # Errors
/// [`interp::Error::Unphysical`] for a load that is not negative and finite; [`Error::NoWorkOfAdhesion`] for a load within
/// a jump, or that is not reached; otherwise those of `pull_off`.
pub fn work_of_adhesion_at_pull_off<E: From<Error>>(
    load: f64,
    radius: Option<f64>,
    pull_off: impl Fn(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let unless = |holds, allowed| {
        Refused::unless(holds, "pull-off load", load, allowed).map_err(Error::from)
    };
    unless(load < 0.0 && load.is_finite(), "< 0 and finite")?;
    // How far the logarithm of the load is from the one wanted, at the logarithm of a work of adhesion.
    let excess = |u: f64| Ok::<f64, E>((pull_off(u.exp())? / load).ln());
    let start = radius.map_or(USUAL, |radius| load / (-1.5 * PI * radius));
    let ((mut near, mut of_near), refused) = begin(&excess, start.ln())?;
    unless(of_near.is_finite(), "that of a pull-off in tension")?;
    // A little farther than a load in proportion.
    let mut step = -1.05 * of_near;
    for _ in 0..MOST_STEPS {
        match excess(near + step) {
            Ok(found) if (found < 0.0) == (of_near < 0.0) && found != 0.0 => {
                (near, of_near) = (near + step, found);
                step *= 2.0;
            }
            Ok(_) => break,
            Err(error) if step.abs() < 1e-3 => return Err(refused.unwrap_or(error)),
            // The one wanted may be nearer than a work of adhesion without an answer.
            Err(_) => step /= 4.0,
        }
    }
    let found = root(excess, near, near + step)?;
    if excess(found)?.abs() <= CLOSE {
        return Ok(found.exp());
    }
    Err(E::from(Error::NoWorkOfAdhesion {
        load,
        work_of_adhesion: found.exp(),
        above: pull_off((found - BESIDE).exp())?,
        below: pull_off((found + BESIDE).exp())?,
    }))
}

/// Returns the place of `first`, or the next one by powers of ten at which a function has an answer, and the answer; and
/// the error at `first`, if there is none.
fn begin<E>(f: &impl Fn(f64) -> Result<f64, E>, first: f64) -> Result<((f64, f64), Option<E>), E> {
    let refused = match f(first) {
        Ok(found) => return Ok(((first, found), None)),
        Err(refused) => refused,
    };
    let others = (1..=DECADES).flat_map(|decades| [-decades, decades]);
    let mut places = others.map(|decades| first + f64::from(decades) * LN_10);
    match places.find_map(|place| Some((place, f(place).ok()?))) {
        Some(begun) => Ok((begun, Some(refused))),
        None => Err(refused),
    }
}
