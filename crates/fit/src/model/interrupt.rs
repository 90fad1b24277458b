//! Contacts that somebody may stop waiting for.

use std::fmt;
use std::sync::Arc;

/// Asked before every contact of [bodies](crate::Bodies), and at the end of a fit: once the answer is
/// yes, no contact is made, and the fit soon ends as [`Error::Interrupted`](crate::Error::Interrupted).
/// The answer must then stay yes. The default answers no.
#[derive(Clone, Default)]
pub struct Interrupt(Option<Arc<dyn Fn() -> bool + Send + Sync>>);

impl Interrupt {
    /// Asks a function, on the threads of the fit.
    pub fn when(is_requested: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(is_requested)))
    }

    /// Asks whether the contacts are no longer waited for.
    pub(super) fn is_requested(&self) -> bool {
        self.0.as_ref().is_some_and(|ask| ask())
    }
}

/// All are alike: whoever waits, the contacts are the same.
impl PartialEq for Interrupt {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}
