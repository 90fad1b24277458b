//! `tabulate cost`

mod cost;
mod effects;
mod lookup;
mod rows;
mod solve;
mod table;

pub use self::cost::{Arguments, run};
pub use self::effects::of_default as measure_effects;
pub use self::lookup::of_default as measure_lookup;
pub use self::solve::measured as measure_solve;
pub use self::table::of_default as measure_table;
