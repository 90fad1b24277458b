//! `tabulate fit`
//!
//! `fit` holds the flags and `run` the steps. `setting` reads settings of parameters, and `experiments` joins them with the measurements.
//! `fit::report` writes the result as a report, `object` and `table` as JSON and as CSV;
//! `picture` draws it. `elapsed_time` shows how long it takes. `value` asks for a value of the bodies that is missing.

mod elapsed_time;
pub mod experiments;
mod fit;
pub mod free;
pub mod indentation;
mod next_steps;
pub mod object;
mod picture;
pub mod reading;
pub mod relaxing;
mod run;
pub mod setting;
pub mod table;
mod value;

pub use self::fit::{Arguments, kinds, one_of};
pub use self::run::run;
