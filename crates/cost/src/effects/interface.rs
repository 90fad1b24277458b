//! The interface between film and substrate: the error of a film that is taken as bonded where it
//! slides, and the cost of solving the film that slides.

use contact::Contact;
use interp::{Curve, Material, Probe, Quantities, System, Table};

use super::films::films_on_glass;
use crate::clock::Timing;
use solve::stack::{Interface, MOST_A_OVER_TOP, Stack};
use solve::{Error, solve_stack, stack_curve};

/// Returns the quantities of a film that slides on its substrate, in the unit of those of the film
/// that is bonded. Contacts wider than [`MOST_A_OVER_TOP`] have those of this radius.
pub(super) fn sliding(
    a_over_t: f64,
    material: &Material,
    tolerance: f64,
) -> Result<Quantities, Error> {
    // The probe does not matter.
    let system = System::of_material(material, Probe::Paraboloid { radius: 1.0 });
    let stack = Stack::of_film(&system, Interface::Sliding)?;
    let a_over_t = a_over_t.min(MOST_A_OVER_TOP);
    Ok(solve_stack(a_over_t, &stack, system.sphere_modulus, tolerance)?.quantities)
}

/// Returns the time of the curve of a new film that slides, by solves to 1e-8 over three decades of
/// `a/t`, over that in which the embedded table makes the contact of one that is bonded.
pub(super) fn time_ratio(timing: Timing) -> Result<f64, Error> {
    let systems = films_on_glass(8, [1e5, 1e9], &Probe::Paraboloid { radius: 1e-5 })?;
    let table = Table::embedded();
    let solved = |system: &System| -> Result<Curve, Error> {
        let stack = Stack::of_film(system, Interface::Sliding)?;
        stack_curve(&stack, system.sphere_modulus, [0.01, 10.0], 1e-8)
    };
    let bonded = |system: &System| Contact::in_table(table, system);
    timing.ratio(&systems, solved, bonded)
}
