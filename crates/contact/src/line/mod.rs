//! Contact lines that move by other laws than eq. 8.
//!
//! `crack_tip` is the law, `contact_line` moves a line slowly, and `dynamics` in time, by the steps of `implicit_step`.

mod contact_line;
mod crack_tip;
mod dynamics;
mod implicit_step;

pub use self::contact_line::ContactLine;
pub(crate) use self::crack_tip::energies_in_order;
pub use self::crack_tip::{CrackTip, Hysteresis, RateDependent};
pub use self::dynamics::TimedState;
pub(crate) use self::dynamics::check_tolerance;
