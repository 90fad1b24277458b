//! Contacts on layers that somebody may stop waiting for.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use contact::Contact;

use super::layered::{Cause, Layered, LayeredSolver};

/// A solver that refuses every further contact once it is interrupted.
///
/// A fit whose contacts are all refused ends at once: the caller, who has set the flag, drops its
/// result.
#[derive(Clone, Debug)]
pub struct Interruptible {
    /// What makes the contacts.
    pub solver: Arc<dyn LayeredSolver>,
    /// Whether it is interrupted.
    pub interrupted: Arc<AtomicBool>,
}

impl LayeredSolver for Interruptible {
    fn contact(&self, bodies: &Layered) -> Result<Contact, Cause> {
        if self.interrupted.load(Ordering::Relaxed) {
            return Err("the fit is interrupted".into());
        }
        self.solver.contact(bodies)
    }

    fn why_not_receding(&self) -> Option<&'static str> {
        self.solver.why_not_receding()
    }

    fn why_layers_are_fixed(&self) -> Option<&'static str> {
        self.solver.why_layers_are_fixed()
    }
}
