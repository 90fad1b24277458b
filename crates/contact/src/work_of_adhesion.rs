//! The work of adhesion of a measured pull-off load.

use interp::Error as Refused;

use crate::{Contact, Control, Error, root};

/// The largest number of steps of the search for two works of adhesion with the one wanted between them.
const MOST_STEPS: usize = 60;
/// The work of adhesion (J/m^2) from which on that of a probe without a radius is searched.
const USUAL: f64 = 0.05;

impl Contact {
    /// Returns the work of adhesion (J/m^2) of a measured pull-off load (N, negative): the one with which
    /// [`Contact::pull_off`] under this control is at this load.
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
    /// [`interp::Error::Unphysical`] for a load that is not negative and finite; otherwise as
    /// [`Contact::pull_off`] at the works of adhesion near the one that is searched.
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
/// cone, with the root under a flat punch.
///
/// # Errors
/// [`interp::Error::Unphysical`] for a load that is not negative and finite; otherwise those of `pull_off`.
pub fn work_of_adhesion_at_pull_off<E: From<Refused>>(
    load: f64,
    radius: Option<f64>,
    pull_off: impl Fn(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let holds = load < 0.0 && load.is_finite();
    Refused::unless(holds, "pull-off load", load, "< 0 and finite")?;
    // How far the logarithm of the load is from the one wanted, at the logarithm of a work of adhesion.
    let excess = |u: f64| Ok::<f64, E>((pull_off(u.exp())? / load).ln());
    let start = radius.map_or(USUAL, |radius| {
        load / (-1.5 * std::f64::consts::PI * radius)
    });
    let mut near = start.ln();
    let mut of_near = excess(near)?;
    let tensile = "that of a pull-off in tension";
    Refused::unless(of_near.is_finite(), "pull-off load", load, tensile)?;
    // A little farther than a load in proportion.
    let mut step = -1.05 * of_near;
    for _ in 0..MOST_STEPS {
        match excess(near + step) {
            Ok(found) if (found < 0.0) == (of_near < 0.0) && found != 0.0 => {
                (near, of_near) = (near + step, found);
                step *= 2.0;
            }
            Ok(_) => break,
            Err(error) if step.abs() < 1e-3 => return Err(error),
            // The one wanted may be nearer than a work of adhesion without an answer.
            Err(_) => step /= 4.0,
        }
    }
    Ok(root(excess, near, near + step)?.exp())
}
