//! Contacts in time where one relaxation function rules all bodies that deform.
//!
//! Lee and Radok's and Ting's reduction of the half-space is exact on films of any thickness, and so
//! is any number of turning points: the contact is arithmetic on the elastic curve. `relaxation`
//! holds the laws, `exponentials` writes them as sums of exponentials, `elastic` is the elastic
//! curve, `program` what is imposed. `approach` and `return_steps`, which share a `setting`, and
//! `growing_load` have many digits, `elements` serves any history (with `memory`, `recovery` and `rim`), `run` chooses
//! among them and refines. `density` and `variation` hold the exponentials of a law and their derivatives with respect
//! to the numbers of `law_parameter`; with them `measured` follows measured points by `approach` and `return_steps`, at
//! the places of `steps`, and differentiates their loads. `unlike` bounds the error by bodies that do not relax.
//! `moments` has functions for them.

mod approach;
mod density;
mod elastic;
mod elements;
mod exponentials;
mod growing_load;
mod history;
mod law_parameter;
mod measured;
#[cfg(test)]
mod measured_tests;
mod memory;
mod moments;
mod program;
mod recovery;
mod relaxation;
mod return_steps;
mod rim;
mod run;
mod setting;
mod steps;
mod unlike;
mod variation;

use self::history::UNLIKE;
pub use self::history::{Course, History, Phase, TimedContact};
pub use self::law_parameter::LawParameter;
pub use self::measured::{HistoryInputs, MeasuredHistory};
pub use self::relaxation::Relaxation;
