//! The system of Tables 1 and 2 of Barthel, *Adhesive contact of a compliant sphere to an elastic
//! coated substrate: the thin film limit*: an elastomer lens on an incompressible film on silicon.

use contact::Contact;
use figures::chart::Point;
use interp::{Elastic, Probe, Quantity, System};

use crate::Error;
use solve::stack::{Interface, Stack};
use solve::{curve, stack_curve};

/// The work of adhesion, J/m^2 (Table 2).
pub const WORK_OF_ADHESION: f64 = 0.04;

/// The paper's sphere (Table 2).
pub const PROBE: Probe = Probe::Paraboloid { radius: 1e-3 };

/// The range of `a/t` in Figs. 2 and 3.
pub const A_OVER_T: [f64; 2] = [1e-3, 1e3];

/// The range of `a/t` of a contact, in which a sharp tip on a thick film has its pull-off.
const WIDE: [f64; 2] = [1e-5, 1e3];

/// The relative tolerance of the curves, far below the width of a line.
const TOLERANCE: f64 = 1e-8;

/// Returns the system of Table 1 with the radius of Table 2 and a film of `film_thickness` (m).
///
/// # Errors
/// None: the constants are physical.
pub fn system(film_thickness: f64) -> Result<System, Error> {
    let [film, substrate] = [Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?];
    Ok(System {
        probe: PROBE,
        sphere_modulus: 2e6,
        film,
        film_thickness,
        substrate,
    })
}

/// Computes the line of a quantity of Table 1 against `a/t` in Figs. 2 and 3, from direct solves, and its limits on a
/// thick and on a thin film.
///
/// # Errors
/// Those of [`curve`].
pub fn line(quantity: Quantity) -> Result<(Vec<Point>, [f64; 2]), Error> {
    let material = system(1e-6)?.material()?;
    let curve = curve(&material, A_OVER_T, TOLERANCE)?;
    let point = |a_over_t| Ok([a_over_t, curve.quantity(quantity, a_over_t)?]);
    let points: Result<_, Error> = spaced(A_OVER_T, 301).map(point).collect();
    let limits = [material.thick_film_limit(), material.thin_film_limit()];
    Ok((points?, limits.map(|limit| limit.get(quantity))))
}

/// Computes the contact of a `probe` with a film of `film_thickness` (m) that an `interface` joins to
/// the substrate, from direct solves.
///
/// # Errors
/// Those of [`curve`], of [`stack_curve`] and of [`Contact::new`].
pub fn contact(probe: &Probe, film_thickness: f64, interface: Interface) -> Result<Contact, Error> {
    let system = System {
        probe: probe.clone(),
        ..system(film_thickness)?
    };
    let curve = if interface.is_bonded() {
        curve(&system.material()?, WIDE, TOLERANCE)?
    } else {
        let stack = Stack::of_film(&system, interface)?;
        stack_curve(&stack, system.sphere_modulus, WIDE, TOLERANCE)?
    };
    Ok(Contact::new(&system, curve)?)
}

/// Returns `count` numbers between two, evenly spaced in their logarithms, with both ends.
pub(super) fn spaced([from, to]: [f64; 2], count: usize) -> impl Iterator<Item = f64> {
    (0..count)
        .map(move |i| (from * (to / from).powf(i as f64 / (count - 1) as f64)).clamp(from, to))
}
