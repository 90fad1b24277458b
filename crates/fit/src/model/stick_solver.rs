//! Contacts with full friction by direct solves.

use contact::Contact;
use solve::stick::{MOST_OF_TIP, StickCurves, Sticking};

use super::direct_solver::{stack_of, system_on};
use super::layered::{Cause, Layered, LayeredSolver};

/// The relative tolerance of the quantities.
const TOLERANCE: f64 = 1e-8;

/// Where curves begin: the contact radius over the thickness of the top layer.
const BEGIN: f64 = 1e-4;

/// The contact radius over the thickness of the top layer up to which curves go that may end
/// earlier. Wider contacts take much longer.
const OVER_TOP: f64 = 10.0;

/// Makes the contact of a sphere that sticks to a film or to layers: a `solver` of
/// [`fit::Layered`](crate::Layered). A film is a single layer without a name.
///
/// Points stick when they are touched. The work of adhesion of the experiment is the one with which
/// the contact recedes; it has grown with [`advancing`](Self::advancing) times this work, and a fit
/// that finds the work keeps the ratio. The quantities are within 1e-8, up to contact radii of 30
/// times the thickness of the top layer.
///
/// # Errors
/// Those of [`Sticking::grown`](solve::stick::Sticking::grown): Dundurs' beta of sphere and top
/// layer must be 0; and those of
/// [`StickCurves::receding`](solve::stick::StickCurves::receding) for the ratio.
#[derive(Clone, Copy, Debug)]
pub struct StickSolver {
    /// The Poisson ratio of the sphere; a rigid sphere needs none.
    pub sphere_poisson_ratio: f64,
    /// The work of adhesion with which the contact has grown over that with which it recedes, 0 to 1:
    /// 1 is a contact with one work of adhesion, 0 one that was pressed on without attraction. Below
    /// 1 the states are those of a contact that recedes, and no approach is described.
    pub advancing: f64,
}

impl LayeredSolver for StickSolver {
    fn contact(&self, layered: &Layered) -> Result<Contact, Cause> {
        let stack = stack_of(layered)?;
        let thickness = stack.thickness();
        let top = stack.shape().top;
        let expected = layered.reach.expected / thickness;
        let end = (layered.reach.needed / thickness)
            .max(expected.min(OVER_TOP * top))
            .min(MOST_OF_TIP * top);
        let nu2 = self.sphere_poisson_ratio;
        let sticking = Sticking::on_stack(&stack, layered.sphere_modulus, nu2)?;
        let range = [(BEGIN * top).min(0.1 * end), end];
        let curves = StickCurves::new(&sticking, range, TOLERANCE)?;
        Ok(Contact::new(
            &system_on(layered, &stack),
            curves.receding(self.advancing)?,
        )?)
    }

    fn why_not_receding(&self) -> Option<&'static str> {
        Some(
            "with full friction the contact depends on the ratio of both works of adhesion, which a fit \
             keeps: give this ratio to the solver, and points of retract only",
        )
    }
}
